// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/simulated_drive.h>

namespace pcl {
namespace nurbs {

/** A town at one time, the bodies near a place posed. */
class TownView {
public:
  /** Bodies that may be within reach of a place about a time. */
  TownView(const Town& town, const Eigen::Vector3d& place, double reach, double time);

  /** Pose the bodies at a time. */
  void
  moveTo(double time);

  /** The first meeting of a ray with anything. */
  BeamHit
  cast(const Beam& ray, double near, double far) const;

  /** |cos| of the angle between a ray and the normal of the surface it meets. */
  double
  cosine(const Beam& ray, const BeamHit& hit) const;

  const TownSurface&
  surface(const BeamHit& hit) const
  {
    return town_.surface(hit.surface);
  }

private:
  struct Body {
    const Mover* mover;
    std::optional<Eigen::Isometry3d> pose;
  };

  const Town& town_;
  std::vector<Body> bodies_;
};

/** What a sensor sees with; poses are those of the sensor. */
struct SensorView {
  const SimulatedDrive& drive;
  const SimulationOptions& options;
  std::size_t index;
  int threads;
};

/** A scan without any return, of so many points. */
SimulatedScan
emptyScan(int width, int height, double stamp);

SimulatedScan
scanWithLaser(const SensorView& view, const LaserModel& laser);

SimulatedScan
scanWithCamera(const SensorView& view, const DepthCameraModel& camera);

} // namespace nurbs
} // namespace pcl
