// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "grid_steps.h"

#include <pcl/segmentation/grid_geometry.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace pcl {
namespace {

/** Index of the entry of a monotonic table that is nearest to a value. */
double
nearestEntry(const std::vector<double>& table, double value)
{
  const bool rising = table.front() < table.back();
  const auto before = [rising](double a, double b) { return rising ? a < b : a > b; };
  auto upper = std::lower_bound(table.begin(), table.end(), value, before);
  if (upper == table.end())
    --upper;
  if (upper != table.begin() &&
      std::abs(*std::prev(upper) - value) < std::abs(*upper - value))
    --upper;
  return static_cast<double>(upper - table.begin());
}

/** Value of a table of at least one entry between and beyond its entries, linearly. */
double
interpolate(const std::vector<double>& table, double place)
{
  if (table.size() == 1)
    return table.front();
  const double last = static_cast<double>(table.size()) - 2.0;
  const auto before =
      static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last));
  return table[before] +
         (place - static_cast<double>(before)) * (table[before + 1] - table[before]);
}

} // namespace

Eigen::Matrix3d
GridGeometry::cameraFrame()
{
  return Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d
GridGeometry::vehicleFrame()
{
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return axes;
}

Eigen::Matrix3d
GridGeometry::mapFrame()
{
  return Eigen::Vector3d(1, -1, -1).asDiagonal();
}

GridGeometry
GridGeometry::pinhole(int width, int height, const PinholeIntrinsics& intrinsics)
{
  if (width < 1 || height < 1 || intrinsics.fx == 0.0 || intrinsics.fy == 0.0)
    throw std::invalid_argument("GridGeometry: a camera needs pixels and focal length");
  GridGeometry grid;
  grid.projection = GridProjection::perspective;
  grid.width = width;
  grid.height = height;
  grid.step_u = 1.0 / intrinsics.fx;
  grid.step_v = 1.0 / intrinsics.fy;
  grid.first_u = -intrinsics.cx / intrinsics.fx;
  grid.first_v = -intrinsics.cy / intrinsics.fy;
  return grid;
}

PinholeIntrinsics
GridGeometry::intrinsics() const
{
  if (projection != GridProjection::perspective)
    throw std::domain_error("GridGeometry: only a perspective grid has intrinsics");
  return {1.0 / step_u, 1.0 / step_v, -first_u / step_u, -first_v / step_v};
}

Eigen::Vector3d
GridGeometry::chart(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d local = frame * point;
  switch (projection) {
  case GridProjection::perspective:
    return {local.x() / local.z(), local.y() / local.z(), local.z()};
  case GridProjection::spherical:
    return {std::atan2(local.x(), local.z()),
            std::atan2(local.y(), std::hypot(local.x(), local.z())),
            local.norm()};
  default:
    return local;
  }
}

Eigen::Vector2d
GridGeometry::cell(double u, double v) const
{
  double column = (u - first_u) / step_u;
  if (wrap)
    column -= width * std::floor((column + 0.5) / width);
  const double row = row_v.empty() ? (v - first_v) / step_v : nearestEntry(row_v, v);
  return {column, row};
}

Eigen::Vector2d
GridGeometry::chartOfCell(double column, double row) const
{
  return {first_u + column * step_u,
          row_v.empty() ? first_v + row * step_v : interpolate(row_v, row)};
}

Eigen::Vector3d
GridGeometry::ray(double u, double v) const
{
  switch (projection) {
  case GridProjection::perspective:
    return frame.transpose() * Eigen::Vector3d(u, v, 1.0).normalized();
  case GridProjection::spherical:
    return frame.transpose() * Eigen::Vector3d(std::cos(v) * std::sin(u),
                                               std::sin(v),
                                               std::cos(v) * std::cos(u));
  case GridProjection::plane:
    return frame.row(2);
  default:
    throw std::domain_error("GridGeometry: a lattice has no directions");
  }
}

Eigen::Vector3d
GridGeometry::direction(double column, double row) const
{
  const Eigen::Vector2d place = chartOfCell(column, row);
  return ray(place.x(), place.y());
}

double
GridGeometry::columnSpacing(double depth) const
{
  return std::abs(step_u) * (nurbs::isInverseDepthGrid(*this) ? depth : 1.0);
}

double
GridGeometry::rowSpacing(double depth) const
{
  return std::abs(step_v) * (nurbs::isInverseDepthGrid(*this) ? depth : 1.0);
}

} // namespace pcl
