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

  /** The first meetings of rays from one point with anything, as
   * PrimitiveTree::castFan(). It is fast for rays that lie about one plane. */
  void
  castFan(const Eigen::Vector3d& origin,
          const std::vector<Eigen::Vector3d>& directions,
          double near,
          std::vector<BeamHit>& hits) const;

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

  void
  castAtBody(const Body& body, const Beam& ray, double near, BeamHit& hit) const;

  const Town& town_;
  std::vector<Body> bodies_;
};

/** Which beams of a scan meet the vehicle itself, beam by beam and column by column;
 * empty if it has no parts. */
std::vector<bool>
beamsOnOwnBody(const LaserModel& laser);

/** What a sensor sees with; poses are those of the sensor. */
struct SensorView {
  const SimulatedDrive& drive;
  const SimulationOptions& options;
  std::size_t index;
  int threads;
  const std::vector<bool>& hidden; /**< as beamsOnOwnBody() */
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
