// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/nurbs/exports.h>

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief Parameters of MotionThreshold, metres. */
struct MotionThresholdOptions {
  /** Standard deviation assumed before anything is known. */
  double initial = 1.0;
  /** Smaller deviations are the sensor's noise, not the motion's. */
  double min_motion = 0.1;
  /** The threshold is never smaller ... */
  double min_threshold = 0.5;
  /** ... or larger than this. */
  double max_threshold = 3.0;
  /** Range at which a turn is counted as way. */
  double max_range = 100.0;
};

/** \brief How far apart points of a pair may be, from how far off the predictions of
 * the motion have been (Vizzo et al., KISS-ICP, RA-L 2023, eq. 6-8).
 * \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT MotionThreshold {
public:
  explicit MotionThreshold(const MotionThresholdOptions& options = {});

  /** \brief Note what a prediction was off by: predicted^-1 * measured. */
  void
  addDeviation(const Eigen::Isometry3d& deviation);

  /** \brief Three standard deviations of a point's place, within the limits. */
  double
  value() const;

private:
  MotionThresholdOptions options_;
  double sum_of_squares_;
  double count_ = 1.0;
};

} // namespace nurbs
} // namespace pcl
