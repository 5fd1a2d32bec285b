// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/scan_matching.h>

#include "chunked_sum.h"
#include "match_pairs.h"
#include "match_statistics.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kMinPairs = 6;
/** Noise found in the residuals counts as at least so many voxels: where most of the
 * target is one exact plane, all that is curved would be an outlier. */
constexpr double kMinScale = 0.02;
constexpr double kKernelSigmas = 3.0;
/** Iterations in which pairs are found anew, and as a share of all where these are
 * more. */
constexpr int kMostPairings = 30;
constexpr double kPairingShare = 0.375;
/** The kernel begins with so many voxels and shrinks by a factor per iteration, so that
 * a rough guess is not taken for outliers (graduated non-convexity). */
constexpr double kFirstWidth = 1.0;
constexpr double kShrink = 0.6;

struct NormalEquations {
  TangentMatrix matrix = TangentMatrix::Zero();
  /** The part of the matrix that holds nothing: noise of normals, and nearest points on
   * edges, which go along with the scan. */
  TangentMatrix apparent = TangentMatrix::Zero();
  Tangent gradient = Tangent::Zero();
  double weight = 0.0;
  double weighted_range = 0.0;

  void
  operator+=(const NormalEquations& other)
  {
    matrix += other.matrix;
    apparent += other.apparent;
    gradient += other.gradient;
    weight += other.weight;
    weighted_range += other.weighted_range;
  }
};

NormalEquations
linearize(const MatchPairs& pairs,
          const ScanPoints& scan,
          const Eigen::Matrix3d& rotation,
          const RobustKernel& kernel,
          int threads)
{
  const auto add = [&](std::size_t i, NormalEquations& sum) {
    if (!pairs.pairs()[i].found)
      return;
    const PairTerm& term = pairs.term(i);
    const double weight = kernel.weight(term.square);
    const Eigen::Matrix<double, 3, 6> jacobian = pointJacobian(scan[i]);
    const Eigen::Matrix<double, 6, 3> weighted =
        weight * jacobian.transpose() * term.metric;
    sum.matrix.noalias() += weighted * jacobian;
    sum.gradient.noalias() += weighted * term.residual;
    const LocalSurface& surface = pairs.pairs()[i].surface;
    if (surface.flat())
      sum.apparent += weight * normalNoise(jacobian, rotation, surface);
    else if (!surface.scattered)
      sum.apparent.noalias() += weighted * jacobian;
    else {
      const Eigen::Matrix3d free = rotation.transpose() *
                                   (Eigen::Matrix3d::Identity() - surface.held) *
                                   rotation;
      const TangentMatrix slides = weighted * free * jacobian;
      sum.apparent += 0.5 * (slides + slides.transpose());
    }
    sum.weight += weight;
    sum.weighted_range += weight * scan[i].cast<double>().squaredNorm();
  };
  return chunkedSum<NormalEquations>(scan.size(), threads, add);
}

/** The Gauss-Newton step in those directions that have support; the others keep the
 * guess rather than follow noise (Zhang et al., ICRA 2016). */
Tangent
solve(const NormalEquations& sums, double min_support)
{
  Tangent scale = Tangent::Ones();
  scale.tail<3>() /= std::sqrt(std::max(sums.weighted_range / sums.weight, 1e-12));
  const auto balanced = [&](const TangentMatrix& matrix) -> TangentMatrix {
    return scale.asDiagonal() * matrix * scale.asDiagonal() / sums.weight;
  };
  const Eigen::SelfAdjointEigenSolver<TangentMatrix> solver(
      balanced(sums.matrix - sums.apparent));
  const TangentMatrix whole = balanced(sums.matrix);
  const Tangent gradient = scale.cwiseProduct(sums.gradient) / sums.weight;
  const auto unsupported =
      (solver.eigenvalues().array() < min_support).count(); // they are sorted
  const Eigen::MatrixXd basis = solver.eigenvectors().rightCols(6 - unsupported);
  const Eigen::MatrixXd reduced = basis.transpose() * whole * basis;
  const Tangent step = -basis * reduced.ldlt().solve(basis.transpose() * gradient);
  return scale.cwiseProduct(step);
}

RobustKernel
kernelFor(const MatchPairs& pairs,
          RobustKernel kernel,
          double voxel_size,
          int iteration)
{
  if (kernel.type == RobustKernelType::None || kernel.width > 0.0)
    return kernel;
  const double scale = std::max(pairs.scale(), kMinScale * voxel_size);
  kernel.width = std::max(kKernelSigmas * scale,
                          kFirstWidth * voxel_size * std::pow(kShrink, iteration));
  return kernel;
}

/** How far a pair may be apart and still count for something. */
double
reachOf(const RobustKernel& kernel, const MatchOptions& options, double voxel_size)
{
  constexpr double kWidths = 4.0; // where Geman and McClure's weight is 1 / 289
  constexpr double kVoxels = 2.0;
  if (kernel.type != RobustKernelType::GemanMcClure)
    return options.max_distance;
  return std::min(options.max_distance,
                  std::max(kVoxels * voxel_size, kWidths * kernel.width));
}

void
check(const ScanPoints& scan,
      const ScanPoints& normals,
      const Eigen::Isometry3d& guess,
      const MatchOptions& options)
{
  if (!guess.matrix().allFinite())
    throw std::invalid_argument("matchScan: the initial guess is not finite");
  if (options.metric == MatchMetric::PlaneToPlane && normals.size() != scan.size())
    throw std::invalid_argument("matchScan: one normal per point is needed");
  if (options.threads < 1 || options.max_iterations < 1)
    throw std::invalid_argument("matchScan: threads and iterations must be positive");
}

} // namespace

MatchResult
matchScan(const VoxelMap& map,
          const ScanPoints& scan,
          const ScanPoints& normals,
          const Eigen::Isometry3d& guess,
          const MatchOptions& options)
{
  check(scan, normals, guess, options);
  MatchResult result;
  result.pose = guess;
  MatchPairs pairs(map, scan, normals, options);
  const double size = map.options().voxel_size;
  const int pairings =
      std::max(kMostPairings, static_cast<int>(kPairingShare * options.max_iterations));
  for (; result.iterations < options.max_iterations && !result.converged;
       ++result.iterations) {
    // Pairs that are kept end a cycle between two ways of pairing.
    pairs.update(result.pose, result.iterations >= pairings);
    if (pairs.found() < kMinPairs)
      return result;
    const RobustKernel kernel =
        kernelFor(pairs, options.kernel, size, result.iterations);
    pairs.setReach(reachOf(kernel, options, size));
    const Tangent step =
        solve(linearize(pairs, scan, result.pose.linear(), kernel, options.threads),
              options.min_support);
    result.pose = orthonormal(result.pose * exponential(step));
    result.converged = step.head<3>().norm() < options.translation_epsilon &&
                       step.tail<3>().norm() < options.rotation_epsilon;
  }
  pairs.update(result.pose, false);
  if (pairs.found() >= kMinPairs)
    describeMatch(pairs,
                  scan,
                  kernelFor(pairs, options.kernel, size, result.iterations),
                  options,
                  size,
                  result);
  if (result.degeneracy.unsupported == 6) { // too few pairs, or all with one point
    result.converged = false;
    result.covariance.setZero();
  }
  return result;
}

ScanPoints
surfaceNormals(const VoxelMap& map, const ScanPoints& points, int threads)
{
  ScanPoints normals(points.size());
  const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i)
      normals[i] =
          localSurface(map.surface(points[i].cast<double>())).normal.cast<float>();
  };
  forChunks(points.size(), threads, work);
  return normals;
}

} // namespace nurbs
} // namespace pcl
