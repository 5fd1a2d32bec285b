// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/counter_random.h>
#include <pcl/mapping/simulator/primitives.h>

#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

inline Eigen::Vector3d
randomPoint(CounterRandom& random, double size)
{
  return {random.uniform(-size, size),
          random.uniform(-size, size),
          random.uniform(-size, size)};
}

inline Eigen::Isometry3d
randomFrame(CounterRandom& random, double size)
{
  Eigen::Isometry3d frame =
      frameFromAxis(randomPoint(random, size), randomPoint(random, 1.0));
  frame.rotate(Eigen::AngleAxisd(random.uniform(0.0, 6.0), Eigen::Vector3d::UnitZ()));
  return frame;
}

inline Beam
randomBeam(CounterRandom& random, double size)
{
  const Eigen::Vector3d from = 3.0 * randomPoint(random, size);
  return {from, (randomPoint(random, size) - from).normalized()};
}

/** One of each kind of surface, placed at random. */
inline std::vector<Primitive>
randomPrimitives(CounterRandom& random, double size)
{
  PlanePatch wall;
  wall.frame = randomFrame(random, size);
  wall.size_x = random.uniform(1.0, 3.0);
  wall.size_y = random.uniform(1.0, 3.0);
  wall.openings.columns = wall.openings.rows = 2;
  wall.openings.first = {0.1, 0.1};
  wall.openings.size = {0.25, 0.15};
  wall.openings.pitch = {0.45, 0.45};
  wall.openings.arched = random.chance(0.5);
  PlanePatch gable = wall;
  gable.frame = randomFrame(random, size);
  gable.outline = PlanePatch::Outline::Gable;
  PlanePatch disc = wall;
  disc.frame = randomFrame(random, size);
  disc.outline = PlanePatch::Outline::Disc;
  RuledPatch ruled;
  const Eigen::Isometry3d place = randomFrame(random, size);
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = static_cast<double>(k);
    ruled.start[k] = place * Eigen::Vector3d(x, 0.0, random.uniform(-0.6, 0.6));
    ruled.end[k] = place * Eigen::Vector3d(x, 2.0, random.uniform(-0.6, 0.6));
  }
  RuledPatch bilinear = RuledPatch::bilinear(randomPoint(random, size),
                                             randomPoint(random, size),
                                             randomPoint(random, size),
                                             randomPoint(random, size));
  FrustumPatch cone;
  cone.frame = randomFrame(random, size);
  cone.radius_bottom = random.uniform(0.2, 1.0);
  cone.radius_top = random.uniform(0.2, 1.0);
  cone.height = random.uniform(0.5, 3.0);
  cone.sweep = {-0.5, random.uniform(1.0, 5.5)};
  FrustumPatch pipe = cone;
  pipe.frame = randomFrame(random, size);
  pipe.radius_top = pipe.radius_bottom;
  pipe.sweep = {};
  SpherePatch dome;
  dome.frame = randomFrame(random, size);
  dome.radius = random.uniform(0.5, 1.5);
  dome.latitude = {random.uniform(-1.2, 0.0), random.uniform(0.2, 1.2)};
  TorusPatch ring;
  ring.frame = randomFrame(random, size);
  ring.radius_major = random.uniform(0.6, 1.5);
  ring.radius_minor = random.uniform(0.05, 0.5);
  ring.around = {0.3, random.uniform(2.0, 6.0)};
  return {wall, gable, disc, ruled, bilinear, cone, pipe, dome, ring};
}

} // namespace test
} // namespace nurbs
} // namespace pcl
