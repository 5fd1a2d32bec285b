// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "settings.h"

namespace pcl_nurbs_tools {

/** Every setting that a file or the command line may change, by name. */
SettingsTable
settingsTable(SlamSettings& settings);

} // namespace pcl_nurbs_tools
