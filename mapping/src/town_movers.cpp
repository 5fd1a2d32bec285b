// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector3d;

constexpr double kLean = 0.45; // of a car's windows

/** The windows of a car: four slanting sides under a roof. Most of the light goes on
 * into the dark or is thrown elsewhere; what comes back differs from pane to pane. */
void
addCabin(TownParts& parts,
         SurfaceKind kind,
         const Vector3d& low,
         const Vector3d& high,
         CounterRandom& random)
{
  const auto corner = [&](double x, double y, bool top) {
    const double in = top ? kLean : 0.0;
    return Vector3d(x > 0.0 ? high.x() - in : low.x() + in,
                    y > 0.0 ? high.y() - 0.3 * in : low.y() + 0.3 * in,
                    top ? high.z() : low.z());
  };
  const auto side = [&](double xa, double ya, double xb, double yb) {
    parts.use(kind, 0.001 * std::pow(30.0, random.uniform()));
    parts.add(RuledPatch::bilinear(corner(xa, ya, false),
                                   corner(xb, yb, false),
                                   corner(xa, ya, true),
                                   corner(xb, yb, true)));
  };
  side(1, 1, 1, -1);
  side(-1, 1, -1, -1);
  side(1, 1, -1, 1);
  side(1, -1, -1, -1);
}

void
addWheels(TownParts& parts, double length, double width)
{
  constexpr double kRadius = 0.31;
  for (const double x : {-0.31 * length, 0.31 * length})
    for (const double side : {-1.0, 1.0}) {
      const Vector3d inner(x, side * (0.5 * width - 0.18), kRadius);
      const Vector3d out(0.0, side * 0.2, 0.0);
      parts.addCylinder(inner, out, kRadius, kRadius);
      parts.addDisc(inner + out, out, kRadius);
    }
}

} // namespace

void
addCar(TownParts& parts, SurfaceKind kind, CounterRandom& random)
{
  const double length = random.uniform(3.8, 4.8);
  const double width = random.uniform(1.65, 1.8);
  const double belt = random.uniform(0.85, 1.0);
  const double roof = belt + random.uniform(0.45, 0.85);
  parts.use(kind, 0.12);
  addWheels(parts, length, width);
  parts.use(kind, random.uniform(0.15, 0.8));
  parts.addBox({-0.5 * length, -0.5 * width, 0.22}, {0.5 * length, 0.5 * width, belt});
  const Vector3d low(-0.46 * length, -0.48 * width, belt);
  const Vector3d high(0.28 * length, 0.48 * width, roof);
  const Vector3d roof_corner(low.x() + kLean, low.y() + 0.3 * kLean, roof);
  parts.addRectangle(roof_corner,
                     {high.x() - low.x() - 2.0 * kLean, 0.0, 0.0},
                     {0.0, high.y() - low.y() - 0.6 * kLean, 0.0});
  addCabin(parts, kind, low, high, random);
}

void
addPedestrian(TownParts& parts, CounterRandom& random)
{
  const double height = random.uniform(1.55, 1.9);
  const double hip = 0.48 * height;
  const double shoulder = 0.83 * height;
  parts.use(SurfaceKind::Pedestrian, random.uniform(0.2, 0.6));
  for (const double side : {-0.1, 0.1})
    parts.addCylinder({1.2 * side, side, 0.0}, {-1.2 * side, 0.0, hip}, 0.06, 0.09);
  parts.addCylinder({0.0, 0.0, hip}, {0.0, 0.0, shoulder - hip}, 0.15, 0.19);
  for (const double side : {-0.24, 0.24})
    parts.addCylinder(
        {0.3 * side, side, hip}, {-0.3 * side, 0.0, shoulder - hip}, 0.04, 0.055);
  parts.addSphere({0.0, 0.0, height - 0.12}, 0.12);
}

namespace {

constexpr double kCarReach = 3.4; // longest, widest and highest car, from its foot
constexpr double kWalkerReach = 2.0;

/** Makes bodies along a drive. */
class MoverMaker {
public:
  MoverMaker(TownParts& parts, const TownPath& path, std::uint64_t seed)
      : parts_(parts), path_(path), random_(seed, 90)
  {
  }

  void
  addOncoming(double time)
  {
    Mover mover = begin();
    addCar(parts_, SurfaceKind::MovingCar, random_);
    mover.radius = kCarReach;
    mover.speed = -random_.uniform(5.0, 11.0);
    mover.lateral = RoadShape::kOncoming;
    schedule(mover, time, 14.0);
  }

  /** A car ahead of the drive, slowly coming nearer or drawing away. */
  void
  addLeading(double time)
  {
    Mover mover = begin();
    addCar(parts_, SurfaceKind::MovingCar, random_);
    mover.radius = kCarReach;
    mover.speed = random_.uniform(-0.4, 0.4);
    mover.follows = true;
    schedule(mover, time, 12.0);
    mover.arc = random_.uniform(16.0, 30.0);
  }

  void
  addWalker(double time)
  {
    Mover mover = begin();
    addPedestrian(parts_, random_);
    mover.radius = kWalkerReach;
    mover.speed = random_.uniform(0.8, 1.7) * (random_.chance(0.5) ? 1.0 : -1.0);
    const double side = random_.chance(0.5) ? 1.0 : -1.0;
    mover.lateral =
        RoadShape::kMiddle + side * (RoadShape::kHalfWidth +
                                     random_.uniform(0.8, RoadShape::kSidewalk - 0.3));
    schedule(mover, time, 30.0);
  }

  double
  gap(double least, double most)
  {
    return random_.uniform(least, most);
  }

  std::vector<Mover> movers;

private:
  Mover
  begin()
  {
    parts_.beginObject(Eigen::Isometry3d::Identity());
    Mover mover;
    mover.first_surface = static_cast<std::uint32_t>(parts_.primitives.size());
    return mover;
  }

  /** The drive passes it at a time; it is there some seconds before and after. */
  void
  schedule(Mover& mover, double time, double half)
  {
    mover.num_surfaces =
        static_cast<std::uint32_t>(parts_.primitives.size()) - mover.first_surface;
    mover.time = time;
    mover.begin = time - half;
    mover.end = time + half;
    mover.arc = path_.arcAt(time);
    movers.push_back(mover);
  }

  TownParts& parts_;
  const TownPath& path_;
  CounterRandom random_;
};

} // namespace

std::vector<Mover>
makeMovers(TownParts& parts,
           const TownPath& path,
           const Trajectory& drive,
           std::uint64_t seed)
{
  MoverMaker maker(parts, path, seed);
  const double begin = drive.front().stamp;
  const double end = drive.back().stamp;
  for (double time = begin + 3.0; time < end + 8.0; time += maker.gap(6.0, 20.0))
    maker.addOncoming(time);
  for (double time = begin + 25.0; time < end; time += maker.gap(40.0, 90.0))
    maker.addLeading(time);
  for (double time = begin + 1.0; time < end + 12.0; time += maker.gap(1.5, 6.0))
    maker.addWalker(time);
  return std::move(maker.movers);
}

} // namespace nurbs
} // namespace pcl
