// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"

namespace pcl_nurbs_tools {

/** nurbs_eval trajectory; argv[0] is the command's name.
 * \throws ToolError and what reading throws */
void
evaluateTrajectory(int argc, char** argv);

} // namespace pcl_nurbs_tools
