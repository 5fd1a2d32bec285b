// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/kitti_calibration.h>
#include <pcl/mapping/simulator/simulated_drive.h>

#include "pose_interpolation.h"
#include "sensor_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

namespace pcl {
namespace nurbs {
namespace {

void
requireUsable(const LaserModel& laser)
{
  if (laser.elevations.empty() || laser.columns < 1 || laser.columns > (1 << 16))
    throw std::invalid_argument("SimulatedDrive: the laser has no beams or columns");
  if (!(laser.min_range >= 0.0 && laser.max_range > laser.min_range) ||
      !std::isfinite(laser.max_range))
    throw std::invalid_argument("SimulatedDrive: the laser has no range");
}

void
requireUsable(const DepthCameraModel& camera)
{
  constexpr std::int64_t kMostPixels = std::int64_t{1} << 26U;
  if (camera.width < 1 || camera.height < 1 ||
      static_cast<std::int64_t>(camera.width) * camera.height > kMostPixels)
    throw std::invalid_argument("SimulatedDrive: the image has no pixels or too many");
  if (!(camera.min_depth >= 0.0 && camera.max_depth > camera.min_depth) ||
      !std::isfinite(camera.max_depth))
    throw std::invalid_argument("SimulatedDrive: the camera has no range");
}

/** Poses of the sensor, their rotations made orthonormal to rounding. */
Trajectory
sensorPoses(const Trajectory& drive, const Eigen::Isometry3d& T_body_sensor)
{
  Trajectory result = drive;
  for (StampedPose& pose : result) {
    pose.T_world_body = pose.T_world_body * T_body_sensor;
    pose.T_world_body.linear() =
        Eigen::Quaterniond(pose.T_world_body.linear()).normalized().toRotationMatrix();
  }
  return result;
}

} // namespace

TownView::TownView(const Town& town,
                   const Eigen::Vector3d& place,
                   double reach,
                   double time)
    : town_(town)
{
  constexpr double kMargin = 10.0; // for motion during a scan
  for (const Mover& mover : town.movers()) {
    const auto pose = town.moverPose(mover, time);
    if (pose && (pose->translation() - place).norm() < reach + mover.radius + kMargin)
      bodies_.push_back({&mover, pose});
  }
}

void
TownView::moveTo(double time)
{
  for (Body& body : bodies_)
    body.pose = town_.moverPose(*body.mover, time);
}

void
TownView::castAtBody(const Body& body, const Beam& ray, double near, BeamHit& hit) const
{
  const Eigen::Vector3d way = ray.origin - body.pose->translation();
  const double radius = body.mover->radius;
  const double ahead = way.dot(ray.direction);
  if (way.squaredNorm() - ahead * ahead > radius * radius)
    return;
  const Eigen::Matrix3d turn = body.pose->linear().transpose();
  const Beam local{turn * way, turn * ray.direction};
  for (std::uint32_t k = 0; k < body.mover->num_surfaces; ++k) {
    const std::uint32_t id = body.mover->first_surface + k;
    const double distance = intersect(town_.primitive(id), local, near, hit.distance);
    if (distance < hit.distance)
      hit = {distance, id};
  }
}

void
TownView::castFan(const Eigen::Vector3d& origin,
                  const std::vector<Eigen::Vector3d>& directions,
                  double near,
                  std::vector<BeamHit>& hits) const
{
  constexpr double kRounding = 1e-3; // metres
  town_.tree().castFan(origin, directions, near, hits);
  const Eigen::Vector3d normal = directions.front().cross(directions.back());
  const Eigen::Vector3d unit = normal.normalized(); // zero for a single direction
  double spread = 0.0;                              // of the rays about their plane
  for (const Eigen::Vector3d& direction : directions)
    spread = std::max(spread, std::abs(unit.dot(direction)));
  for (const Body& body : bodies_) {
    if (!body.pose)
      continue;
    const Eigen::Vector3d way = body.pose->translation() - origin;
    const double reach = body.mover->radius + kRounding;
    if (std::abs(unit.dot(way)) > reach + spread * (way.norm() + reach))
      continue;
    for (std::size_t i = 0; i < directions.size(); ++i)
      castAtBody(body, {origin, directions[i]}, near, hits[i]);
  }
}

double
TownView::cosine(const Beam& ray, const BeamHit& hit) const
{
  const Primitive& primitive = town_.primitive(hit.surface);
  const Eigen::Vector3d point = ray.at(hit.distance);
  if (hit.surface < town_.tree().primitives().size())
    return std::abs(ray.direction.dot(normalAt(primitive, point)));
  const auto owner =
      std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& body) {
        return hit.surface - body.mover->first_surface < body.mover->num_surfaces;
      });
  const Eigen::Isometry3d& pose = *owner->pose;
  return std::abs(
      ray.direction.dot(pose.linear() * normalAt(primitive, pose.inverse() * point)));
}

SimulatedScan
emptyScan(int width, int height, double stamp)
{
  SimulatedScan result;
  result.scan.stamp = stamp;
  result.scan.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZI>>(
      static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (pcl::PointXYZI& point : *result.scan.cloud)
    point.x = point.y = point.z = kNaN;
  result.scan.cloud->is_dense = false;
  result.surfaces.assign(result.scan.cloud->size(), BeamHit::kNothing);
  result.true_points.assign(result.scan.cloud->size(), Eigen::Vector3d::Constant(kNaN));
  return result;
}

SimulatedDrive::SimulatedDrive(const Trajectory& drive,
                               Sensor sensor,
                               const SimulationOptions& options)
    : sensor_(std::move(sensor)), options_(options)
{
  std::visit([](const auto& model) { requireUsable(model); }, sensor_);
  if (options.threads < 0)
    throw std::invalid_argument("SimulatedDrive: the number of threads is negative");
  town_ = std::make_unique<Town>(drive, options.town);
  truth_ = sensorPoses(town_->drive(), options.T_body_sensor);
  if (const auto* laser = std::get_if<LaserModel>(&sensor_))
    hidden_ = beamsOnOwnBody(*laser);
}

SimulatedDrive::~SimulatedDrive() = default;

double
SimulatedDrive::stamp(std::size_t index) const
{
  if (index >= truth_.size())
    throw std::invalid_argument("SimulatedDrive: there is no scan " +
                                std::to_string(index));
  return truth_[index].stamp;
}

Scan
SimulatedDrive::read(std::size_t index) const
{
  return simulate(index).scan;
}

Eigen::Isometry3d
SimulatedDrive::calibration() const
{
  const bool laser = std::holds_alternative<LaserModel>(sensor_);
  return laser ? nominalKittiCalibration() : Eigen::Isometry3d::Identity();
}

SimulatedScan
SimulatedDrive::simulate(std::size_t index) const
{
  stamp(index); // throws when there is no such scan
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  const int threads = options_.threads > 0 ? options_.threads : std::max(1, cores);
  const SensorView view{*this, options_, index, threads, hidden_};
  if (const auto* laser = std::get_if<LaserModel>(&sensor_))
    return scanWithLaser(view, *laser);
  return scanWithCamera(view, std::get<DepthCameraModel>(sensor_));
}

Eigen::Isometry3d
SimulatedDrive::sensorPose(double time) const
{
  if (truth_.size() < 2)
    return truth_.front().T_world_body;
  const auto after = std::upper_bound(
      truth_.begin() + 1,
      truth_.end() - 1,
      time,
      [](double t, const StampedPose& pose) { return t < pose.stamp; });
  return interpolatePose(*(after - 1), *after, time);
}

} // namespace nurbs
} // namespace pcl
