// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/counter_random.h>

#include "sensor_simulation.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Measures the pixels of an image, each for itself. */
class CameraImage {
public:
  CameraImage(const SensorView& view,
              const DepthCameraModel& camera,
              const TownView& town,
              SimulatedScan& result)
      : view_(view),
        camera_(camera),
        town_(town),
        result_(result),
        pose_(view.drive.sensorPose(result.scan.stamp)),
        projector_(pose_ * Eigen::Vector3d(camera.base, 0.0, 0.0))
  {
  }

  void
  measureRow(int row)
  {
    for (int column = 0; column < camera_.width; ++column)
      measure(column, row);
  }

private:
  void
  measure(int column, int row)
  {
    const PinholeIntrinsics& lens = camera_.intrinsics;
    const Eigen::Vector3d pixel(
        (column - lens.cx) / lens.fx, (row - lens.cy) / lens.fy, 1.0);
    const double stretch = pixel.norm();
    const Beam ray{pose_.translation(), pose_.linear() * (pixel / stretch)};
    const BeamHit hit =
        town_.cast(ray, camera_.min_depth * stretch, camera_.max_depth * stretch);
    const auto i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width) +
        static_cast<std::size_t>(column);
    if (hit.surface == BeamHit::kNothing)
      return;
    double depth = hit.distance / stretch;
    if (view_.options.noise) {
      if (town_.cosine(ray, hit) < camera_.least_cosine ||
          isInShadow(ray.at(hit.distance)))
        return;
      depth = noisyDepth(depth, i);
    }
    pcl::PointXYZI& point = (*result_.scan.cloud)[i];
    point.getVector3fMap() = (depth * pixel).cast<float>();
    point.intensity = town_.surface(hit).reflectivity;
    result_.surfaces[i] = hit.surface;
    result_.true_points[i] = ray.at(hit.distance);
  }

  /** Whether something stands between a point and the projector. */
  bool
  isInShadow(const Eigen::Vector3d& point) const
  {
    constexpr double kOffSurface = 1e-3;
    const Eigen::Vector3d way = point - projector_;
    const double distance = way.norm();
    const BeamHit hit =
        town_.cast({projector_, way / distance}, 0.0, distance - kOffSurface);
    return hit.surface != BeamHit::kNothing;
  }

  double
  noisyDepth(double depth, std::size_t pixel) const
  {
    const double at_one_metre = camera_.intrinsics.fx * camera_.base;
    CounterRandom random(view_.options.town.seed, view_.index, pixel);
    const double disparity =
        at_one_metre / depth + camera_.disparity_noise * random.normal();
    const double step = camera_.disparity_step;
    return at_one_metre /
           (step > 0.0 ? std::round(disparity / step) * step : disparity);
  }

  const SensorView& view_;
  const DepthCameraModel& camera_;
  const TownView& town_;
  SimulatedScan& result_;
  Eigen::Isometry3d pose_;
  Eigen::Vector3d projector_;
};

} // namespace

DepthCameraModel
DepthCameraModel::kinect()
{
  DepthCameraModel model;
  model.name = "Kinect";
  return model;
}

SimulatedScan
scanWithCamera(const SensorView& view, const DepthCameraModel& camera)
{
  const double stamp = view.drive.stamp(view.index);
  SimulatedScan result = emptyScan(camera.width, camera.height, stamp);
  result.scan.geometry =
      GridGeometry::pinhole(camera.width, camera.height, camera.intrinsics);
  const double stretch = 1.5; // from the depth of a corner to its distance, at most
  const TownView town(view.drive.town(),
                      view.drive.sensorPose(stamp).translation(),
                      stretch * camera.max_depth,
                      stamp);
  CameraImage image(view, camera, town, result);
#pragma omp parallel for num_threads(view.threads) schedule(dynamic, 8)
  for (int row = 0; row < camera.height; ++row)
    image.measureRow(row);
  return result;
}

} // namespace nurbs
} // namespace pcl
