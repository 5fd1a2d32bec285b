// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/sensor_models.h>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kDegree = M_PI / 180.0;

std::vector<double>
evenElevations(double top, double step, int count)
{
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    result.push_back((top - k * step) * kDegree);
  return result;
}

/** The roof of an estate car and what is fixed to it, around a laser in its middle. The
 * sizes give the blind spots that all scans of KITTI's car have. */
std::vector<Eigen::AlignedBox3d>
roofOfEstateCar()
{
  std::vector<Eigen::AlignedBox3d> parts = {
      {Eigen::Vector3d(-2.2, -0.8, -1.0), Eigen::Vector3d(-1.2, 0.8, -0.75)},
      {Eigen::Vector3d(1.5, -0.75, -1.1), Eigen::Vector3d(2.2, 0.75, -0.845)},
      {Eigen::Vector3d(0.31, -1.08, -0.45), Eigen::Vector3d(0.65, -0.9, -0.31)}};
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d post(-1.17, 0.59 * side, -0.5);
    const Eigen::Vector3d rail(-0.59, 0.81 * side, -0.46);
    const Eigen::Vector3d half_post(0.05, 0.08, 0.205);
    const Eigen::Vector3d half_rail(0.05, 0.045, 0.1);
    parts.emplace_back(post - half_post, post + half_post);
    parts.emplace_back(rail - half_rail, rail + half_rail);
  }
  return parts;
}

} // namespace

LaserModel
LaserModel::hdl64()
{
  LaserModel model;
  model.name = "HDL-64E";
  model.elevations = evenElevations(2.0, 1.0 / 3.0, 32);
  const std::vector<double> lower = evenElevations(-8.83, 0.5, 32);
  model.elevations.insert(model.elevations.end(), lower.begin(), lower.end());
  model.range_noise = 0.011;
  model.beam_offset = 0.02;
  model.beam_gain = 0.15;
  model.random_loss = 0.003;
  model.signal_range = 160.0;
  model.own_body = roofOfEstateCar();
  return model;
}

LaserModel
LaserModel::hdl32()
{
  LaserModel model;
  model.name = "HDL-32E";
  model.elevations = evenElevations(32.0 / 3.0, 4.0 / 3.0, 32);
  return model;
}

LaserModel
LaserModel::vlp16()
{
  LaserModel model;
  model.name = "VLP-16";
  model.elevations = evenElevations(15.0, 2.0, 16);
  model.columns = 1800;
  model.range_noise = 0.03;
  model.max_range = 100.0;
  return model;
}

GridGeometry
LaserModel::geometry() const
{
  GridGeometry grid;
  grid.projection = GridProjection::spherical;
  grid.width = columns;
  grid.height = static_cast<int>(elevations.size());
  grid.wrap = true;
  grid.frame = GridGeometry::vehicleFrame();
  grid.step_u = 2.0 * M_PI / columns;
  grid.first_u = -M_PI + 0.5 * grid.step_u;
  for (const double elevation : elevations)
    grid.row_v.push_back(-elevation);
  return grid;
}

} // namespace nurbs
} // namespace pcl
