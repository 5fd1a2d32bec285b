// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/circuits.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2.0 * M_PI;

/** Superellipse: a rectangle of 3:2 with rounded corners for a large power. */
Vector2d
superellipse(double phase, double size, double power)
{
  const double c = std::cos(phase);
  const double s = std::sin(phase);
  const double radius = std::pow(
      std::pow(std::abs(c), power) + std::pow(std::abs(s), power), -1.0 / power);
  return 0.5 * size * radius * Vector2d(c, 2.0 / 3.0 * s);
}

/** The curve of a lemniscate, as high as half its width. */
Vector2d
eight(double phase, double size)
{
  return 0.5 * size * Vector2d(std::sin(phase), std::sin(phase) * std::cos(phase));
}

Vector3d
curve(const CircuitOptions& options, double phase)
{
  const Vector2d flat = options.shape == CircuitShape::Eight
                            ? eight(phase, options.size)
                        : options.shape == CircuitShape::Oval
                            ? superellipse(phase - M_PI_2, options.size, 2.0)
                            : superellipse(phase - M_PI_2, options.size, 7.0);
  // Hills that depend on the place only, so that legs which meet do so in height.
  const double wave = kTurn / options.size;
  const double hill = 0.01 * options.size *
                      (std::sin(wave * flat.x() + 1.0) * std::cos(wave * flat.y()));
  return {flat.x(), flat.y(), hill};
}

/** Points of the curve at equal phases and the length up to each. */
struct Samples {
  explicit Samples(const CircuitOptions& options)
  {
    constexpr int kCount = 20000;
    for (int k = 0; k <= kCount; ++k) {
      points.push_back(curve(options, kTurn * k / kCount));
      lengths.push_back(
          k == 0 ? 0.0
                 : lengths.back() + (points.back() - points[points.size() - 2]).norm());
    }
  }

  Vector3d
  at(double length) const
  {
    const double along = length - lengths.back() * std::floor(length / lengths.back());
    const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, along);
    const auto k = static_cast<std::size_t>(after - lengths.begin());
    const double share = (along - lengths[k - 1]) / (lengths[k] - lengths[k - 1]);
    return points[k - 1] + share * (points[k] - points[k - 1]);
  }

  std::vector<Vector3d> points;
  std::vector<double> lengths;
};

Eigen::Isometry3d
poseAt(const Samples& samples, double length)
{
  constexpr double kReach = 0.5;
  const Vector3d way = samples.at(length + kReach) - samples.at(length - kReach);
  const Eigen::AngleAxisd yaw(std::atan2(way.y(), way.x()), Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(-std::atan2(way.z(), way.head<2>().norm()),
                                Vector3d::UnitY());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (yaw * pitch).toRotationMatrix();
  pose.translation() = samples.at(length);
  return pose;
}

/** Number of poses that laps of a length take. */
int
numPoses(const CircuitOptions& options, double lap)
{
  constexpr double kMostPoses = 1e6;
  const double count = options.laps * lap / (options.speed * options.period);
  if (!(count < kMostPoses))
    throw std::invalid_argument("makeCircuit: more than a million poses");
  return static_cast<int>(count) + 1;
}

Trajectory
straightDrive(const CircuitOptions& options)
{
  const bool moves = options.shape == CircuitShape::Line;
  Trajectory result(static_cast<std::size_t>(numPoses(options, options.size)));
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k].stamp = static_cast<double>(k) * options.period;
    const double way = moves ? options.speed * result[k].stamp : 0.0;
    result[k].T_world_body.translation() = Vector3d(way, 0.0, options.height);
  }
  return result;
}

Trajectory
closedDrive(const CircuitOptions& options)
{
  const Samples samples(options);
  const double step = options.speed * options.period;
  const Eigen::Isometry3d start = poseAt(samples, 0.0);
  const Eigen::AngleAxisd level(-std::atan2(start.linear()(1, 0), start.linear()(0, 0)),
                                Vector3d::UnitZ());
  Trajectory result(
      static_cast<std::size_t>(numPoses(options, samples.lengths.back())));
  for (std::size_t k = 0; k < result.size(); ++k) {
    StampedPose& pose = result[k];
    pose.stamp = static_cast<double>(k) * options.period;
    pose.T_world_body = poseAt(samples, static_cast<double>(k) * step);
    pose.T_world_body.translation() -= start.translation();
    pose.T_world_body = level * pose.T_world_body;
    pose.T_world_body.translation().z() += options.height;
  }
  return result;
}

} // namespace

Trajectory
makeCircuit(const CircuitOptions& options)
{
  const bool sensible = options.size >= 60.0 && options.size <= 1e5 &&
                        options.speed > 0.0 && options.period > 0.0 &&
                        options.height > 0.0 && options.laps > 0.0 &&
                        std::isfinite(options.height);
  if (!sensible)
    throw std::invalid_argument("makeCircuit: size, speed, period, height or laps");
  const bool closed =
      options.shape != CircuitShape::Line && options.shape != CircuitShape::Standstill;
  return closed ? closedDrive(options) : straightDrive(options);
}

} // namespace nurbs
} // namespace pcl
