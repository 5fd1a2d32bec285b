// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/view_polynomial.h>

#include "direction_noise.h"
#include "grid_steps.h"

#include <pcl/segmentation/grid_graph.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Share of the point spacing that is granted as noise even to exact points. */
constexpr double kSpacingShare = 0.05;
/** The same as a share of the depth, for grids that know no spacing. */
constexpr double kDepthShare = 1e-5;

struct Box {
  Eigen::Vector3d least =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;
};

Box
boundsOf(const GridPoints& points, const Eigen::Matrix3d& frame)
{
  Box box;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (points.valid(cell)) {
      const Eigen::Vector3d local = frame * points.point(cell).cast<double>();
      box.least = box.least.cwiseMin(local);
      box.most = box.most.cwiseMax(local);
    }
  return box;
}

} // namespace

ViewChart::ViewChart(const GridPoints& points,
                     const SensorNoise& noise,
                     const GridGraph& graph,
                     int threads)
    : points_(points),
      noise_(noise),
      angular_(isInverseDepthGrid(points.geometry)),
      spherical_(points.geometry.projection == GridProjection::spherical),
      frame_(points.geometry.frame),
      choices_(spherical_ ? std::vector<int>{3, 9} : std::vector<int>{3, 6, 10}),
      slopes_(measureDepthSlopes(points, graph, threads)),
      direction_noise_(depthNoiseOfDirections(slopes_, {}))
{
  const GridSpacing spacing(points.geometry, GridGraph::kRight);
  const bool lattice = points.geometry.projection == GridProjection::lattice;
  spacing_ = lattice ? 0.0 : static_cast<double>(spacing.constant);
  spacing_per_depth_ = angular_ ? static_cast<double>(spacing.per_depth) : 0.0;
  if (!angular_)
    centre();
  updateSigmas(threads);
}

void
ViewChart::centre()
{
  const Box box = boundsOf(points_, frame_);
  if (!(box.most - box.least).allFinite())
    return; // without points there is nothing to centre
  origin_ = 0.5 * (box.least + box.most);
  scale_ = std::max((box.most - box.least).head<2>().maxCoeff(), 1e-12);
}

void
ViewChart::scaleNoise(double factor)
{
  if (!(factor > 0.0))
    throw std::invalid_argument("ViewChart: the noise's factor must be positive");
  noise_scale_ *= factor;
}

void
ViewChart::measureDirections(const GridGraph& graph, int threads)
{
  const auto scaled = [this](double value) { return noise_scale_ * value; };
  const DirectionNoise measured = measureDirectionNoise(
      points_,
      graph,
      {scaled(noise_.constant), scaled(noise_.quadratic), noise_.reference},
      threads);
  const auto share = [this](double value) {
    return std::max(kLeastDirectionNoise, value / noise_scale_);
  };
  const DirectionNoise granted{share(measured.along_rows),
                               share(measured.along_columns)};
  if (std::max(granted.along_rows, granted.along_columns) <= kLeastDirectionNoise)
    return;
  direction_noise_ = depthNoiseOfDirections(slopes_, granted);
  updateSigmas(threads);
}

void
ViewChart::updateSigmas(int threads)
{
  sigmas_.resize(points_.size());
#pragma omp parallel for num_threads(threads)
  for (std::size_t cell = 0; cell < sigmas_.size(); ++cell)
    sigmas_[cell] =
        points_.valid(cell) ? static_cast<float>(unscaledSigma(cell)) : 0.0F;
}

double
ViewChart::unscaledSigma(std::size_t cell) const
{
  const double depth = points_.depth[cell];
  const double sensor = noise_.sigma(depth);
  const double direction = static_cast<double>(direction_noise_[cell]);
  const double shape = kSpacingShare * (spacing_ + spacing_per_depth_ * depth) +
                       kDepthShare * (angular_ ? depth : scale_);
  const double all = std::sqrt(sensor * sensor + direction * direction + shape * shape);
  return angular_ ? all / (depth * depth) : all;
}

Eigen::Vector3d
ViewChart::direction(std::size_t cell) const
{
  const Eigen::Vector3d local = frame_ * points_.point(cell).cast<double>();
  if (angular_)
    return local / static_cast<double>(points_.depth[cell]);
  return inPlane(local);
}

Eigen::Vector3d
ViewChart::inPlane(const Eigen::Vector3d& local) const
{
  Eigen::Vector3d e = (local - origin_) / scale_;
  e.z() = 1.0;
  return e;
}

std::array<double, kMostViewTerms>
ViewChart::basis(const Eigen::Vector3d& e) const
{
  const double x = e.x();
  const double y = e.y();
  const double z = e.z();
  if (spherical_)
    return {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z, 0.0};
  return {1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
}

ViewSample
ViewChart::sample(std::size_t cell) const
{
  const double depth = points_.depth[cell];
  const Eigen::Vector3d local = frame_ * points_.point(cell).cast<double>();
  const double value = angular_ ? 1.0 / depth : depth - origin_.z();
  const Eigen::Vector3d e = angular_ ? Eigen::Vector3d(value * local) : inPlane(local);
  const double deviation = sigma(cell);
  return {e, basis(e), value, 1.0 / (deviation * deviation)};
}

Eigen::Vector3d
ViewChart::position(const ViewPolynomial& surface, const Eigen::Vector3d& e) const
{
  const Eigen::Vector3d where = spherical_ ? e.normalized() : e;
  const double value = surface(basis(where));
  if (angular_)
    return where / value;
  return origin_ + Eigen::Vector3d(scale_ * where.x(), scale_ * where.y(), value);
}

Eigen::Vector3d
ViewChart::normal(const ViewPolynomial& surface, const Eigen::Vector3d& e) const
{
  const double value = surface(basis(e));
  Eigen::Vector3d slope;
  const int axes = spherical_ ? 3 : 2;
  constexpr double kStep = 1e-5;
  slope.setZero();
  for (int axis = 0; axis < axes; ++axis) { // exact up to rounding: cubic at most
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    slope(axis) = (surface(basis(e + step)) - surface(basis(e - step))) / (2.0 * kStep);
  }
  if (!angular_)
    return Eigen::Vector3d(-slope.x() / scale_, -slope.y() / scale_, 1.0).normalized();
  // The tangent plane n.p = 1 has the inverse depth n.e.
  if (spherical_)
    return (slope + (value - slope.dot(e)) * e).normalized();
  slope.z() = value - slope.dot(e);
  return slope.normalized();
}

} // namespace nurbs
} // namespace pcl
