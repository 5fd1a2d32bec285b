// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/sensor_models.h>

#include <array>
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

/** Degrees, as KITTI's raw scans of 2011_09_30 have them: the points of a beam lie on a
 * cone to 0.3 mm, whose slope this is. They differ by a tenth of a degree from the 1/3
 * and 1/2 degree steps of the data sheet. */
constexpr std::array<double, 64> kBeamsOfKitti = {
    1.94,   1.57,   1.30,   0.87,   0.58,   0.18,   -0.09,  -0.45,  -0.80,  -1.20,
    -1.49,  -1.83,  -2.21,  -2.55,  -2.87,  -3.24,  -3.54,  -3.94,  -4.22,  -4.59,
    -4.91,  -5.25,  -5.61,  -5.96,  -6.33,  -6.68,  -7.00,  -7.29,  -7.68,  -8.06,
    -8.31,  -8.71,  -9.03,  -9.57,  -10.06, -10.47, -10.96, -11.60, -12.12, -12.56,
    -13.04, -13.49, -14.05, -14.60, -15.19, -15.66, -16.18, -16.55, -17.19, -17.73,
    -18.32, -18.80, -19.32, -19.74, -20.22, -20.79, -21.32, -21.94, -22.44, -22.86,
    -23.32, -23.97, -24.51, -25.00};

/** The roof of an estate car and what is fixed to it, around a laser in its middle. The
 * sizes give the blind spots that all scans of KITTI's car have. */
std::vector<Eigen::AlignedBox3d>
roofOfEstateCar()
{
  std::vector<Eigen::AlignedBox3d> parts;
  const auto addRoof = [&](double from, double to, double half_width, double height) {
    parts.emplace_back(Eigen::Vector3d(from, -half_width, -1.1),
                       Eigen::Vector3d(to, half_width, height));
  };
  const auto addPart = [&](const Eigen::Vector3d& center, const Eigen::Vector3d& half) {
    parts.emplace_back(center - half, center + half);
  };
  addRoof(-2.13, -1.2, 0.8, -0.755);
  addRoof(1.6, 2.2, 0.42, -0.88); // its edge bends back to the sides
  addRoof(1.6, 2.2, 0.6, -0.92);
  addRoof(1.6, 2.2, 0.8, -0.99);
  addPart({0.4, -0.98, -0.4}, {0.08, 0.07, 0.085}); // a round antenna
  addPart({0.4, -0.98, -0.4}, {0.165, 0.05, 0.045});
  for (const double side : {-1.0, 1.0}) {
    addPart({-1.24, 0.465 * side, -0.37}, {0.03, 0.09, 0.03}); // posts
    addPart({-1.24, 0.465 * side, -0.45}, {0.02, 0.05, 0.09});
    addPart({-0.65, 0.755 * side, -0.455}, {0.03, 0.03, 0.06}); // rails
    addPart({-0.76, 0.66 * side, -0.5}, {0.03, 0.05, 0.05});
    addPart({1.0, 0.63 * side, -0.565}, {0.03, 0.08, 0.035});
  }
  return parts;
}

} // namespace

LaserModel
LaserModel::hdl64()
{
  LaserModel model;
  model.name = "HDL-64E";
  for (const double elevation : kBeamsOfKitti)
    model.elevations.push_back(elevation * kDegree);
  model.columns = 2160; // 20833 firings a second, 9.64 turns a second
  model.max_range = 80.0;
  model.range_noise = 0.011;
  model.beam_offset = 0.035;
  model.beam_angle = 0.03 * kDegree;
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
