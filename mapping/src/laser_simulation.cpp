// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/counter_random.h>

#include "sensor_simulation.h"

#include <cmath>
#include <limits>

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

/** One beam's reading. */
struct Reading {
  double range;
  double intensity;
};

/** Whether enough light comes back. */
bool
isSeen(const LaserModel& laser,
       const TownSurface& surface,
       double cosine,
       double range,
       CounterRandom& random)
{
  const double closeness = laser.signal_range / range;
  const double signal =
      surface.reflectivity * std::sqrt(cosine) * closeness * closeness;
  const double fourth = signal * signal * signal * signal;
  const double passed = (1.0 - laser.random_loss) * (1.0 - surface.loss);
  const double seen = passed * fourth / (1.0 + fourth);
  return random.chance(seen);
}

Reading
noisyReading(const LaserModel& laser,
             double range,
             double intensity,
             CounterRandom& random)
{
  const double measured = range + laser.range_noise * random.normal();
  const double light = intensity + laser.intensity_noise * random.normal();
  return {measured, std::min(1.0, std::max(0.0, light))};
}

/** Measures the columns of a scan, each for itself. */
class LaserScan {
public:
  LaserScan(const SensorView& view, const LaserModel& laser, SimulatedScan& result)
      : view_(view), laser_(laser), result_(result)
  {
  }

  void
  measureColumn(int column, TownView& town)
  {
    const double offset =
        view_.options.motion_distortion ? laser_.columnTime(column) : 0.0;
    const double time = result_.scan.stamp + offset;
    if (view_.options.motion_distortion)
      town.moveTo(time);
    const Eigen::Isometry3d pose = view_.drive.sensorPose(time);
    const double azimuth = 2.0 * M_PI * ((column + 0.5) / laser_.columns - 0.5);
    const Eigen::Vector3d ahead(std::cos(azimuth), -std::sin(azimuth), 0.0);
    const std::size_t rows = laser_.elevations.size();
    beams_.clear();
    directions_.clear();
    for (const double elevation : laser_.elevations) {
      beams_.push_back(std::cos(elevation) * ahead +
                       std::sin(elevation) * Eigen::Vector3d::UnitZ());
      directions_.emplace_back(pose.linear() * beams_.back());
    }
    hits_.assign(rows, {laser_.max_range, BeamHit::kNothing});
    town.castFan(pose.translation(), directions_, laser_.min_range, hits_);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t i = row * static_cast<std::size_t>(laser_.columns) +
                            static_cast<std::size_t>(column);
      measure({pose.translation(), directions_[row]}, beams_[row], hits_[row], town, i);
      if (!result_.scan.point_times.empty())
        result_.scan.point_times[i] = static_cast<float>(offset);
    }
  }

private:
  void
  measure(const Beam& ray,
          const Eigen::Vector3d& beam,
          const BeamHit& hit,
          const TownView& town,
          std::size_t i)
  {
    if (hit.surface == BeamHit::kNothing)
      return;
    const double cosine = town.cosine(ray, hit);
    const TownSurface& surface = town.surface(hit);
    Reading reading{hit.distance, surface.reflectivity * std::sqrt(cosine)};
    if (view_.options.noise) {
      CounterRandom random(view_.options.town.seed, view_.index, i);
      if (!isSeen(laser_, surface, cosine, hit.distance, random))
        return;
      reading = noisyReading(laser_, reading.range, reading.intensity, random);
    }
    pcl::PointXYZI& point = (*result_.scan.cloud)[i];
    point.getVector3fMap() = (reading.range * beam).cast<float>();
    point.intensity = static_cast<float>(reading.intensity);
    result_.surfaces[i] = hit.surface;
    result_.true_points[i] = ray.at(hit.distance);
  }

  const SensorView& view_;
  const LaserModel& laser_;
  SimulatedScan& result_;
  std::vector<Eigen::Vector3d> beams_;      // in the sensor's frame
  std::vector<Eigen::Vector3d> directions_; // in the world
  std::vector<BeamHit> hits_;
};

} // namespace

LaserModel
LaserModel::hdl64()
{
  LaserModel model;
  model.name = "HDL-64E";
  model.elevations = evenElevations(2.0, 1.0 / 3.0, 32);
  const std::vector<double> lower = evenElevations(-8.83, 0.5, 32);
  model.elevations.insert(model.elevations.end(), lower.begin(), lower.end());
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

SimulatedScan
scanWithLaser(const SensorView& view, const LaserModel& laser)
{
  const double stamp = view.drive.stamp(view.index);
  SimulatedScan result =
      emptyScan(laser.columns, static_cast<int>(laser.elevations.size()), stamp);
  result.scan.geometry = laser.geometry();
  if (view.options.motion_distortion)
    result.scan.point_times.assign(result.surfaces.size(), 0.0F);
  const TownView town(view.drive.town(),
                      view.drive.sensorPose(stamp).translation(),
                      laser.max_range,
                      stamp);
#pragma omp parallel num_threads(view.threads)
  {
    TownView own = town;
    LaserScan scan(view, laser, result);
#pragma omp for schedule(dynamic, 16)
    for (int column = 0; column < laser.columns; ++column)
      scan.measureColumn(column, own);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
