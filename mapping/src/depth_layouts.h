// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "scan_files.h"

namespace pcl {
namespace nurbs {

/** Name of the i-th image's file of poses in Microsoft's layout: frame-N.pose.txt for
 * frame-N.depth.png; empty for images of another name. */
std::filesystem::path
poseFileOf(const std::filesystem::path& image);

/** List the depth images of a folder: by depth.txt or associations.txt, else by their
 * names in frames/, depth/ or the folder itself.
 * \throws InputError when there are none */
void
listImages(ScanFiles& files, const std::filesystem::path& folder);

/** The camera by intrinsics.txt, camera-intrinsics.txt or a JSON file of Open3D's;
 * nothing without one. \throws InputError when it makes no sense */
std::optional<PinholeIntrinsics>
readIntrinsics(const std::filesystem::path& folder);

/** Depth per metre by the layout: 1000 for Microsoft's names and Redwood's files, else
 * TUM's 5000. */
double
depthScaleOf(const ScanFiles& files, const std::filesystem::path& folder);

/** Give scans the poses of a file: TUM's format by time, KITTI's and Redwood's .log by
 * number. */
void
addDepthTruth(ScanFiles& files, const std::filesystem::path& poses);

/** Give scans the poses of the layout's own files, if there are any. */
void
addDepthTruthOfLayout(ScanFiles& files, const std::filesystem::path& folder);

} // namespace nurbs
} // namespace pcl
