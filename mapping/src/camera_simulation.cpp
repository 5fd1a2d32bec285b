// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/counter_random.h>

#include "sensor_simulation.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Measures the rows of an image, each for itself. */
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
    std::vector<Eigen::Vector3d> directions;
    std::vector<BeamHit> hits;
    for (int column = 0; column < camera_.width; ++column) {
      const Eigen::Vector3d pixel = pixelRay(column, row);
      const double stretch = pixel.norm();
      directions.emplace_back(pose_.linear() * (pixel / stretch));
      hits.push_back({camera_.max_depth * stretch, BeamHit::kNothing});
    }
    town_.castFan(pose_.translation(), directions, 0.0, hits);
    const std::vector<bool> shadows = shadowsOf(directions, hits);
    for (int column = 0; column < camera_.width; ++column) {
      const auto k = static_cast<std::size_t>(column);
      if (hits[k].surface != BeamHit::kNothing && !shadows[k])
        measure(column, row, {pose_.translation(), directions[k]}, hits[k]);
    }
  }

private:
  /** Through a pixel, of depth 1. */
  Eigen::Vector3d
  pixelRay(int column, int row) const
  {
    const PinholeIntrinsics& lens = camera_.intrinsics;
    return {(column - lens.cx) / lens.fx, (row - lens.cy) / lens.fy, 1.0};
  }

  void
  measure(int column, int row, const Beam& ray, const BeamHit& hit)
  {
    const Eigen::Vector3d pixel = pixelRay(column, row);
    const auto i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width) +
        static_cast<std::size_t>(column);
    double depth = hit.distance / pixel.norm();
    if (depth < camera_.min_depth)
      return;
    if (view_.options.noise) {
      if (town_.cosine(ray, hit) < camera_.least_cosine)
        return;
      depth = noisyDepth(depth, i);
    }
    pcl::PointXYZI& point = (*result_.scan.cloud)[i];
    point.getVector3fMap() = (depth * pixel).cast<float>();
    point.intensity = town_.surface(hit).reflectivity;
    result_.surfaces[i] = hit.surface;
    result_.true_points[i] = ray.at(hit.distance);
  }

  /** Where something stands between what a row shows and the projector. */
  std::vector<bool>
  shadowsOf(const std::vector<Eigen::Vector3d>& directions,
            const std::vector<BeamHit>& hits) const
  {
    constexpr double kOffSurface = 1e-3;
    std::vector<bool> result(hits.size(), false);
    if (!view_.options.noise)
      return result;
    std::vector<Eigen::Vector3d> light;
    std::vector<BeamHit> blocked;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const Eigen::Vector3d way =
          pose_.translation() + hits[k].distance * directions[k] - projector_;
      const double distance = way.norm();
      light.emplace_back(way / distance);
      blocked.push_back({distance - kOffSurface, BeamHit::kNothing});
    }
    town_.castFan(projector_, light, 0.0, blocked);
    for (std::size_t k = 0; k < hits.size(); ++k)
      result[k] = blocked[k].surface != BeamHit::kNothing;
    return result;
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
