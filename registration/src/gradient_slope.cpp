// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "gradient_slope.h"

#include "chunked_sum.h"
#include "match_statistics.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Steps of differences, in standard deviations of the residuals: few, as the kernel
 * has a width of three ... */
constexpr double kStep = 0.3;
/** ... and at least so many voxels. */
constexpr double kMinStep = 0.006;
/** Differences are looked at for so many points; for fewer where planes hold most. */
constexpr std::size_t kMostPoints = 4000;
constexpr std::size_t kMostBesidePlanes = 300;

struct Sum {
  TangentMatrix matrix = TangentMatrix::Zero();

  void
  operator+=(const Sum& other)
  {
    matrix += other.matrix;
  }
};

/** Derivatives of the gradients of single pairs. */
class Slopes {
public:
  Slopes(const MatchPairs& pairs,
         const ScanPoints& scan,
         const Eigen::Isometry3d& pose,
         const RobustKernel& kernel,
         double step)
      : pairs_(pairs), scan_(scan), pose_(pose), kernel_(kernel), step_(step)
  {
  }

  /** Of a distance to a plane. */
  TangentMatrix
  exact(std::size_t i) const
  {
    const PairTerm& term = pairs_.term(i);
    const Eigen::Matrix<double, 3, 6> jacobian = pointJacobian(scan_[i]);
    return kernel_.curvature(term.square) *
           (jacobian.transpose() * term.metric * jacobian);
  }

  TangentMatrix
  difference(std::size_t i) const
  {
    const Eigen::Vector3d place = pose_ * scan_[i].cast<double>();
    // A distance that counts little may change much until the kernel sees it.
    const double size = pairs_.term(i).metric.norm();
    if (size == 0.0) // counts nothing
      return TangentMatrix::Zero();
    const double step = step_ / std::sqrt(size);
    Eigen::Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d way = step * pose_.linear().col(k);
      slope.col(k) =
          (gradient(i, place + way) - gradient(i, place - way)) / (2.0 * step);
    }
    const Eigen::Matrix<double, 3, 6> jacobian = pointJacobian(scan_[i]);
    return 0.5 * jacobian.transpose() * (slope + slope.transpose()) * jacobian;
  }

private:
  Eigen::Vector3d
  gradient(std::size_t i, const Eigen::Vector3d& place) const
  {
    const auto term = pairs_.termAt(i, place, pose_.linear());
    if (!term)
      return Eigen::Vector3d::Zero();
    return kernel_.weight(term->square) * (term->metric * term->residual);
  }

  const MatchPairs& pairs_;
  const ScanPoints& scan_;
  const Eigen::Isometry3d& pose_;
  const RobustKernel& kernel_;
  double step_;
};

} // namespace

TangentMatrix
gradientSlope(const MatchPairs& pairs,
              const ScanPoints& scan,
              const Eigen::Isometry3d& pose,
              const RobustKernel& kernel,
              const MatchOptions& options,
              double voxel_size)
{
  const bool to_planes = options.metric == MatchMetric::PointToPlane;
  std::vector<std::size_t> planes;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const MatchPair& pair = pairs.pairs()[i];
    if (!pair.found || (to_planes && pair.surface.edge()))
      continue;
    (to_planes && pair.surface.flat() ? planes : others).push_back(i);
  }
  const Slopes slopes(pairs,
                      scan,
                      pose,
                      kernel,
                      std::max(kStep * pairs.scale(), kMinStep * voxel_size));
  TangentMatrix sum =
      chunkedSum<Sum>(planes.size(), options.threads, [&](std::size_t k, Sum& part) {
        part.matrix += slopes.exact(planes[k]);
      }).matrix;
  const std::size_t stride =
      others.size() / (to_planes ? kMostBesidePlanes : kMostPoints) + 1;
  const std::size_t chosen = (others.size() + stride - 1) / stride;
  if (chosen == 0)
    return sum;
  const auto add = [&](std::size_t k, Sum& part) {
    part.matrix += slopes.difference(others[k * stride]);
  };
  const double share = static_cast<double>(chosen) / static_cast<double>(others.size());
  return sum + chunkedSum<Sum>(chosen, options.threads, add).matrix / share;
}

} // namespace nurbs
} // namespace pcl
