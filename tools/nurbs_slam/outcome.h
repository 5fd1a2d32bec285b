// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "settings.h"

#include <pcl/mapping/trajectory_metrics.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace pcl_nurbs_tools {

/** Estimate and truth at the same times, the estimate moved onto the truth. */
struct Comparison {
  pcl::nurbs::TrajectoryPair pair; /**< empty without truth */
  /** How: "se3", or "first pose" where the rotation is not determined. */
  std::string alignment;
};

/** A drive beside its truth, in the frame that the data set gives its poses in. */
struct Outcome {
  pcl::nurbs::Trajectory estimate; /**< one pose per scan that was used */
  pcl::nurbs::Trajectory odometry; /**< the same before the pose graph */
  /** One pose per scan from the first to the last one that was used: those in between
   * that were not are interpolated. */
  pcl::nurbs::Trajectory every_scan;
  pcl::nurbs::Trajectory truth; /**< of the scans that have one; may be empty */
  Comparison compared;
  Comparison compared_odometry;
};

Outcome
outcomeOf(const SlamSettings& settings,
          const pcl::nurbs::ScanSource& source,
          const pcl::nurbs::SlamResult& result);

/** Figures of a run for report.json. */
nlohmann::json
reportOf(const SlamSettings& settings,
         const pcl::nurbs::ScanSource& source,
         const pcl::nurbs::SlamResult& result,
         const Outcome& outcome);

/** Write all results of a pipeline; one that cannot be written does not keep the others
 * from it.
 * \throws ToolError(kCannotWrite) naming the first such file */
void
writeOutcome(const SlamSettings& settings,
             const pcl::nurbs::PoseGraph& graph,
             const nlohmann::json& report,
             const Outcome& outcome);

} // namespace pcl_nurbs_tools
