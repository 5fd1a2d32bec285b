// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "settings.h"

namespace pcl_nurbs_tools {

/** Check ranges of options, and that files are named once with known extensions.
 * \throws ToolError(kUsage) naming what is wrong */
void
checkSettings(const Settings& settings);

} // namespace pcl_nurbs_tools
