// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/counter_random.h>

#include "sensor_simulation.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** In the sensor's frame; \a azimuth to the right of ahead. */
Eigen::Vector3d
beamDirection(double azimuth, double elevation)
{
  const double level = std::cos(elevation);
  return {level * std::cos(azimuth), -level * std::sin(azimuth), std::sin(elevation)};
}

double
columnAzimuth(const LaserModel& laser, int column)
{
  return 2.0 * M_PI * ((column + 0.5) / laser.columns - 0.5);
}

/** Whether a beam from the origin meets a box. */
bool
meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& beam)
{
  const Eigen::Array3d one = box.min().array() / beam.array();
  const Eigen::Array3d other = box.max().array() / beam.array();
  const double in = one.min(other).maxCoeff();
  return in > 0.0 && in <= one.max(other).minCoeff();
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
  return random.chance((1.0 - laser.random_loss) * fourth / (1.0 + fourth));
}

/** Errors that a beam has in all scans. */
struct BeamErrors {
  double offset = 0.0;
  double gain = 1.0;
  double elevation = 0.0;
  double azimuth = 0.0;

  BeamErrors(const LaserModel& laser, std::uint64_t seed, std::size_t row)
  {
    constexpr std::uint64_t kStream = 0xCA11B; // no scan has that number
    CounterRandom random(seed, kStream, row);
    offset = laser.beam_offset * random.normal();
    gain = std::max(0.2, 1.0 + laser.beam_gain * random.normal());
    elevation = laser.beam_angle * random.normal();
    azimuth = laser.beam_angle * random.normal();
  }
};

Reading
noisyReading(const LaserModel& laser,
             const BeamErrors& beam,
             Reading reading,
             CounterRandom& random)
{
  const double range =
      reading.range + beam.offset + laser.range_noise * random.normal();
  const double light =
      beam.gain * reading.intensity + laser.intensity_noise * random.normal();
  return {range, std::min(1.0, std::max(0.0, light))};
}

/** Measures the columns of a scan, each for itself. */
class LaserScan {
public:
  LaserScan(const SensorView& view, const LaserModel& laser, SimulatedScan& result)
      : view_(view), laser_(laser), result_(result)
  {
    for (std::size_t row = 0; row < laser.elevations.size(); ++row) {
      const double elevation = laser.elevations[row];
      const BeamErrors errors(laser, view.options.town.seed, row);
      believed_.push_back(beamDirection(0.0, elevation));
      true_.push_back(view.options.noise
                          ? beamDirection(errors.azimuth, elevation + errors.elevation)
                          : believed_.back());
      errors_.push_back(errors);
    }
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
    const std::size_t rows = laser_.elevations.size();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(-columnAzimuth(laser_, column), Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    const Eigen::Matrix3d turn_world = pose.linear() * turn;
    beams_.clear();
    directions_.clear();
    for (std::size_t row = 0; row < rows; ++row) {
      beams_.emplace_back(turn * believed_[row]);
      directions_.emplace_back((turn_world * true_[row]).normalized());
    }
    hits_.assign(rows, {laser_.max_range, BeamHit::kNothing});
    for (std::size_t row = 0; row < rows; ++row)
      if (!view_.hidden.empty() && view_.hidden[placeOf(row, column)])
        hits_[row].distance = 0.0;
    town.castFan(pose.translation(), directions_, laser_.min_range, hits_);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t i = placeOf(row, column);
      if (hits_[row].surface != BeamHit::kNothing)
        measure({pose.translation(), directions_[row]}, row, town, i);
      if (!result_.scan.point_times.empty())
        result_.scan.point_times[i] = static_cast<float>(offset);
    }
  }

private:
  std::size_t
  placeOf(std::size_t row, int column) const
  {
    return row * static_cast<std::size_t>(laser_.columns) +
           static_cast<std::size_t>(column);
  }

  void
  measure(const Beam& ray, std::size_t row, const TownView& town, std::size_t i)
  {
    const BeamHit& hit = hits_[row];
    const double cosine = town.cosine(ray, hit);
    const TownSurface& surface = town.surface(hit);
    Reading reading{hit.distance, surface.reflectivity * std::sqrt(cosine)};
    if (view_.options.noise) {
      CounterRandom random(view_.options.town.seed, view_.index, i);
      if (!isSeen(laser_, surface, cosine, hit.distance, random))
        return;
      reading = noisyReading(laser_, errors_[row], reading, random);
    }
    pcl::PointXYZI& point = (*result_.scan.cloud)[i];
    point.getVector3fMap() = (reading.range * beams_[row]).cast<float>();
    point.intensity = static_cast<float>(reading.intensity);
    result_.surfaces[i] = hit.surface;
    result_.true_points[i] = ray.at(hit.distance);
  }

  const SensorView& view_;
  const LaserModel& laser_;
  SimulatedScan& result_;
  std::vector<Eigen::Vector3d> believed_;   // of a column ahead, where points are put
  std::vector<Eigen::Vector3d> true_;       // of the same, where beams go
  std::vector<Eigen::Vector3d> beams_;      // of this column, in the sensor's frame
  std::vector<Eigen::Vector3d> directions_; // in the world
  std::vector<BeamHit> hits_;
  std::vector<BeamErrors> errors_;
};

} // namespace

std::vector<bool>
beamsOnOwnBody(const LaserModel& laser)
{
  std::vector<bool> result;
  if (laser.own_body.empty())
    return result;
  for (const double elevation : laser.elevations)
    for (int column = 0; column < laser.columns; ++column) {
      const Eigen::Vector3d beam =
          beamDirection(columnAzimuth(laser, column), elevation);
      result.push_back(std::any_of(laser.own_body.begin(),
                                   laser.own_body.end(),
                                   [&](const auto& box) { return meets(box, beam); }));
    }
  return result;
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
