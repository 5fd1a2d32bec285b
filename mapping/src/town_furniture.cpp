// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"
#include "town_plots.h"

#include <algorithm>
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
          double leaf,
          int count,
          CounterRandom& random)
{
  parts.use(SurfaceKind::Leaves, 0.45);
  for (int k = 0; k < count; ++k) {
    const Vector3d direction = randomDirection(random);
    const double depth = std::cbrt(random.uniform(0.2, 1.0));
    parts.addDisc(center + depth * half.cwiseProduct(direction),
                  randomDirection(random),
                  random.uniform(0.5 * leaf, 1.5 * leaf));
  }
}

/** A tree with a crown of a radius. */
void
addTree(TownParts& parts, double size, CounterRandom& random)
{
  const double radius = size * random.uniform(0.07, 0.12);
  const double height = random.uniform(1.3, 2.8);
  parts.use(SurfaceKind::Trunk, 0.4);
  parts.addCylinder({0.0, 0.0, -0.6}, {0.0, 0.0, height + 0.6}, radius, 0.7 * radius);
  addLeaves(parts,
            {0.0, 0.0, height + 0.8 * size},
            {size, size, 1.2 * size},
            0.1 * size,
            180,
            random);
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

void
addHedge(TownParts& parts, CounterRandom& random)
{
  addLeaves(parts, {0.0, 0.0, 0.6}, {1.8, 0.5, 0.8}, 0.16, 110, random);
}

void
addBush(TownParts& parts, CounterRandom& random)
{
  const double size = random.uniform(0.7, 1.9);
  const double height = size * random.uniform(0.8, 1.3);
  addLeaves(
      parts, {0.0, 0.0, 0.8 * height}, {size, size, height}, 0.13 * size, 130, random);
}

} // namespace

void
addClippedHedge(
    TownParts& parts, double length, double depth, double height, CounterRandom& random)
{
  constexpr double kLeavesPerArea = 10.0;
  constexpr double kRoughness = 0.12; // from the dense inside to the outer leaves
  parts.use(SurfaceKind::Leaves, 0.45);
  parts.addBox({kRoughness, kRoughness, -0.3},
               {length - kRoughness, depth - kRoughness, height - kRoughness});
  const int count = static_cast<int>(kLeavesPerArea * length * (2.0 * height + depth));
  for (int k = 0; k < count; ++k) {
    const double around = random.uniform(0.0, 2.0 * height + depth);
    const double x = random.uniform(0.0, length);
    const double y = std::min(std::max(around - height, 0.0), depth);
    const double z =
        height - std::max(std::abs(around - height - 0.5 * depth) - 0.5 * depth, 0.0);
    parts.addDisc({x, y, z}, randomDirection(random), random.uniform(0.06, 0.16));
  }
}

namespace {

/** Where things of a kind stand beside the path. */
struct RowRules {
  double nearest = 0.0; /**< metres from the middle of the road, left positive */
  double farthest = 0.0;
  double least_gap = 0.0; /**< between one and the next along the path */
  double most_gap = 0.0;
  double road_clearance = 0.0;
  double drive_clearance = 0.0;
  double plot_clearance = 0.0;
  double half_length = 0.0; /**< along the path, as far as the drive has to be clear */
};

/** Places things beside the path where nothing else is. */
class Rows {
public:
  Rows(TownParts& parts,
       const TownPath& path,
       const TownPlots& plots,
       std::uint64_t seed)
      : parts_(parts), path_(path), plots_(plots), seed_(seed)
  {
  }

  /** A row of what \a make builds. */
  template <typename Make>
  void
  place(const RowRules& rules, const Make& make)
  {
    CounterRandom random(seed_, number_++);
    const double end = path_.nodes().back().arc;
    for (double arc = random.uniform(0.0, rules.most_gap); arc < end;
         arc += random.uniform(rules.least_gap, rules.most_gap)) {
      const double lateral = random.uniform(rules.nearest, rules.farthest);
      Vector3d place = path_.place(arc, RoadShape::kMiddle + lateral);
      const Vector2d flat = place.head<2>();
      if (path_.roadClearance(flat) < rules.road_clearance ||
          driveClearance(flat, arc, rules.half_length) < rules.drive_clearance ||
          plots_.clearance(flat, 5.0) < rules.plot_clearance)
        continue;
      if (std::abs(lateral) > RoadShape::kHalfWidth + RoadShape::kSidewalk)
        place.z() = path_.groundAt(flat).height;
      parts_.beginObject(uprightFrame(place, path_.direction(arc)));
      make(parts_, random);
    }
  }

private:
  /** Of the middle and both ends of a thing along the path. */
  double
  driveClearance(const Vector2d& place, double arc, double half_length) const
  {
    const Vector2d reach = half_length * path_.direction(arc);
    return std::min({path_.driveClearance(place - reach),
                     path_.driveClearance(place),
                     path_.driveClearance(place + reach)});
  }

  TownParts& parts_;
  const TownPath& path_;
  const TownPlots& plots_;
  std::uint64_t seed_;
  std::uint64_t number_ = 10;
};

void
addStreetSide(Rows& rows, double side)
{
  constexpr double kEdge = RoadShape::kHalfWidth;
  constexpr double kOnRoad = -2.0; // clearance of what stands on its own road's side
  const auto at = [&](double lateral) { return side * lateral; };
  rows.place({at(RoadShape::kParking),
              at(RoadShape::kParking),
              5.6,
              7.5,
              kOnRoad,
              2.1,
              0.0,
              2.4},
             [](TownParts& parts, CounterRandom& random) {
               if (random.chance(0.17))
                 addCar(parts, SurfaceKind::ParkedCar, random);
             });
  rows.place({at(kEdge + 0.4), at(kEdge + 0.4), 14.0, 40.0, 0.2, 2.5, 0.0}, addPole);
  rows.place({at(kEdge + 2.3), at(kEdge + 3.2), 9.0, 30.0, 2.0, 4.0, 0.8},
             [](TownParts& parts, CounterRandom& random) {
               addTree(parts, random.uniform(1.2, 2.4), random);
             });
  rows.place({at(kEdge + 2.9), at(kEdge + 2.9), 3.6, 12.0, 2.0, 4.0, 0.6}, addHedge);
  rows.place({at(kEdge + 4.2), at(kEdge + 6.0), 120.0, 200.0, 3.0, 4.0, 2.0},
             addPavilion);
  rows.place({at(kEdge + 3.2), at(kEdge + 9.0), 1.5, 5.0, 2.0, 4.0, 0.7}, addBush);
  rows.place({at(kEdge + 7.0), at(kEdge + 38.0), 1.5, 4.0, 4.0, 6.0, 1.2},
             [](TownParts& parts, CounterRandom& random) {
               if (random.chance(0.5))
                 addBush(parts, random);
               else
                 addTree(parts, random.uniform(2.2, 4.2), random);
             });
}

} // namespace

void
addFurniture(TownParts& parts,
             const TownPath& path,
             const TownPlots& plots,
             std::uint64_t seed)
{
  Rows rows(parts, path, plots, seed);
  for (const double side : {1.0, -1.0})
    addStreetSide(rows, side);
}

} // namespace nurbs
} // namespace pcl
