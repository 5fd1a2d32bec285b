// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "scan_files.h"

namespace pcl {
namespace nurbs {

/** List scans by the numbers that are their names; a missing one in between is a fault.
 */
void
listNumbered(ScanFiles& files, const std::filesystem::path& folder);

/** The first of some paths that exists; empty when none does. */
std::filesystem::path
firstThatExists(const std::vector<std::filesystem::path>& candidates);

/** Give scans the times of a file; nothing for an empty path. */
void
addTimes(ScanFiles& files, const std::filesystem::path& times);

} // namespace nurbs
} // namespace pcl
