// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/scan_matching.h>

namespace pcl {
namespace nurbs {

/** A scan is lost with a smaller share of it on the map. */
constexpr double kLostShare = 0.25;
/** With so much of a scan on the map there is no better place for it. */
constexpr double kSureShare = 0.7;

/** What is known about a scan before it is aligned. */
struct ScanPrediction {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /** Where the scan before was. */
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  /** Share of a scan that usually lies on the map; 0 when that is not known. */
  double usual_share = 0.0;
};

struct ScanAlignment {
  MatchResult match;
  /** Whether other places were tried, too. */
  bool searched = false;
};

/** Align a scan with a map from where it is predicted; when that leads to a doubtful
 * place, also from others that a search gives.
 *
 * \param[in] options of the alignments; trials end after fewer iterations */
ScanAlignment
alignScan(const VoxelMap& map,
          const ScanPoints& scan,
          const ScanPrediction& prediction,
          const MatchOptions& options);

} // namespace nurbs
} // namespace pcl
