// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d
randomDirection(CounterRandom& random)
{
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(0.0, 2.0 * M_PI);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

/** Small discs in all directions within an ellipsoid: nothing that one surface fits. */
void
addLeaves(TownParts& parts,
          const Vector3d& center,
          const Vector3d& half,
          int count,
          CounterRandom& random)
{
  parts.use(SurfaceKind::Leaves, 0.45);
  for (int k = 0; k < count; ++k) {
    const Vector3d direction = randomDirection(random);
    const double depth = std::cbrt(random.uniform(0.2, 1.0));
    parts.addDisc(center + depth * half.cwiseProduct(direction),
                  randomDirection(random),
                  random.uniform(0.08, 0.24));
  }
}

void
addTree(TownParts& parts, CounterRandom& random)
{
  const double radius = random.uniform(0.1, 0.25);
  const double height = random.uniform(1.8, 3.0);
  parts.use(SurfaceKind::Trunk, 0.4);
  parts.addCylinder({0.0, 0.0, -0.4}, {0.0, 0.0, height + 0.4}, radius, 0.7 * radius);
  const double size = random.uniform(1.2, 2.2);
  addLeaves(
      parts, {0.0, 0.0, height + 0.7 * size}, {size, size, 1.1 * size}, 130, random);
}

void
addPole(TownParts& parts, CounterRandom& random)
{
  parts.use(SurfaceKind::Pole, 0.5);
  if (random.chance(0.5)) { // a lamp
    parts.addCylinder({0.0, 0.0, -0.3}, {0.0, 0.0, 6.3}, 0.11, 0.07);
    return;
  }
  parts.addCylinder({0.0, 0.0, -0.3}, {0.0, 0.0, 3.0}, 0.035, 0.035);
  parts.use(SurfaceKind::Pole, 0.95); // a retroreflecting sign
  parts.addDisc({-0.04, 0.0, 2.35}, {1.0, 0.0, 0.0}, 0.33);
}

/** A round building with columns around it and a dome. */
void
addPavilion(TownParts& parts, CounterRandom& random)
{
  const double radius = random.uniform(1.0, 1.5);
  const double height = random.uniform(2.2, 2.8);
  parts.use(SurfaceKind::Dome, 0.6);
  parts.addCylinder({0.0, 0.0, -0.5}, {0.0, 0.0, height + 0.5}, radius, radius);
  parts.addDome({0.0, 0.0, height}, radius);
  parts.use(SurfaceKind::Column, 0.6);
  for (int k = 0; k < 6; ++k) {
    const double angle = k * M_PI / 3.0;
    const Vector3d foot(
        (radius + 0.25) * std::cos(angle), (radius + 0.25) * std::sin(angle), -0.5);
    parts.addCylinder(foot, {0.0, 0.0, height + 0.5}, 0.12, 0.1);
  }
}

/** Places things along one line beside the path where nothing else is. */
class Row {
public:
  Row(TownParts& parts, const TownPath& path, std::uint64_t seed, std::uint64_t number)
      : parts_(parts), path_(path), random_(seed, number)
  {
  }

  /** Things \a make builds at gaps between \a least and \a most metres. */
  template <typename Make>
  void
  place(double lateral,
        double least,
        double most,
        double road_clearance,
        double drive_clearance,
        const Make& make)
  {
    const double end = path_.nodes().back().arc;
    for (double arc = random_.uniform(0.0, most); arc < end;
         arc += random_.uniform(least, most)) {
      const Vector3d place = path_.place(arc, lateral);
      const Vector2d flat = place.head<2>();
      if (path_.roadClearance(flat) < road_clearance ||
          path_.driveClearance(flat) < drive_clearance)
        continue;
      parts_.beginObject(uprightFrame(place, path_.direction(arc)));
      make(parts_, random_);
    }
  }

private:
  TownParts& parts_;
  const TownPath& path_;
  CounterRandom random_;
};

void
addHedge(TownParts& parts, CounterRandom& random)
{
  addLeaves(parts, {0.0, 0.0, 0.6}, {1.8, 0.5, 0.8}, 110, random);
}

} // namespace

void
addFurniture(TownParts& parts, const TownPath& path, std::uint64_t seed)
{
  constexpr double kMiddle = RoadShape::kMiddle;
  constexpr double kEdge = RoadShape::kHalfWidth;
  constexpr double kOnRoad = -2.0; // clearance of what stands on its own road's side
  const auto car = [](TownParts& p, CounterRandom& random) {
    if (random.chance(0.4))
      addCar(p, SurfaceKind::ParkedCar, random);
  };
  std::uint64_t number = 10;
  for (const double side : {1.0, -1.0}) {
    Row(parts, path, seed, number++)
        .place(kMiddle + side * RoadShape::kParking, 5.6, 7.5, kOnRoad, 2.1, car);
    Row(parts, path, seed, number++)
        .place(kMiddle + side * (kEdge + 0.4), 14.0, 40.0, 0.2, 2.5, addPole);
    Row(parts, path, seed, number++)
        .place(kMiddle + side * (kEdge + 2.6), 9.0, 30.0, 2.0, 4.0, addTree);
    Row(parts, path, seed, number++)
        .place(kMiddle + side * (kEdge + 2.9), 6.0, 40.0, 2.0, 4.0, addHedge);
    Row(parts, path, seed, number++)
        .place(kMiddle + side * (kEdge + 4.2), 120.0, 200.0, 3.0, 4.0, addPavilion);
  }
}

} // namespace nurbs
} // namespace pcl
