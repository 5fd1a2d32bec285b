// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector3d;

constexpr double kGroundFloor = 3.4;
constexpr double kFloor = 3.0;
constexpr double kGlass = 0.1; // what comes back from curtains behind a pane

/** A part of the front wall with openings of one kind in columns and rows. */
struct FrontPart {
  double left = 0.0;
  double bottom = 0.0;
  double bay = 3.0; /**< width of a column */
  double storey = kFloor;
  OpeningGrid openings; /**< first: from the corner of this part */
  double recess = 0.2;
  SurfaceKind filling = SurfaceKind::Window;
  double filling_reflectivity = kGlass;
};

/** The sides of an opening, from the wall to its filling, with a vault over an arched
 * one. */
void
addReveal(TownParts& parts, const FrontPart& front, const Vector3d& corner)
{
  const double width = front.openings.size.x();
  const double height = front.openings.size.y();
  const Vector3d in(0.0, front.recess, 0.0);
  const Vector3d up(0.0, 0.0, height);
  const Vector3d across(width, 0.0, 0.0);
  parts.addRectangle(corner, in, up);
  parts.addRectangle(corner + across, in, up);
  parts.addRectangle(corner, across, in);
  if (!front.openings.arched) {
    parts.addRectangle(corner + up, across, in);
    return;
  }
  FrustumPatch vault; // about the y axis, angles from the right over the top
  vault.frame.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  vault.frame.translation() = corner + up + 0.5 * across;
  vault.radius_bottom = vault.radius_top = 0.5 * width;
  vault.height = front.recess;
  vault.sweep = {-M_PI, 0.0};
  parts.use(SurfaceKind::Arch, 0.5);
  parts.add(vault);
  TorusPatch moulding;
  moulding.frame = vault.frame;
  moulding.radius_major = 0.5 * width + 0.12;
  moulding.radius_minor = 0.07;
  moulding.around = vault.sweep;
  parts.add(moulding);
}

void
addFront(TownParts& parts, const FrontPart& front, double wall_reflectivity)
{
  const OpeningGrid& grid = front.openings;
  const Vector3d corner(front.left, 0.0, front.bottom);
  const Vector3d across(grid.columns * front.bay, 0.0, 0.0);
  const Vector3d up(0.0, 0.0, grid.rows * front.storey);
  parts.use(SurfaceKind::Wall, wall_reflectivity);
  parts.addRectangle(corner, across, up, grid);
  for (int column = 0; column < grid.columns; ++column)
    for (int row = 0; row < grid.rows; ++row) {
      const double x = grid.first.x() + column * grid.pitch.x();
      const double z = grid.first.y() + row * grid.pitch.y();
      parts.use(SurfaceKind::Wall, wall_reflectivity);
      addReveal(parts, front, corner + Vector3d(x, 0.0, z));
    }
  parts.use(front.filling, front.filling_reflectivity);
  parts.addRectangle(corner + Vector3d(0.0, front.recess, 0.0), across, up);
}

/** Windows of one size in the middle of their bays. */
FrontPart
windows(double left, double bottom, double bay, double storey, int columns, int rows)
{
  FrontPart part;
  part.left = left;
  part.bottom = bottom;
  part.bay = bay;
  part.storey = storey;
  OpeningGrid& grid = part.openings;
  grid.columns = columns;
  grid.rows = rows;
  grid.size = {0.42 * bay, 1.55};
  grid.first = {0.29 * bay, 0.95};
  grid.pitch = {bay, storey};
  return part;
}

void
addDoorBay(TownParts& parts, double left, double bay, double wall_reflectivity)
{
  FrontPart part = windows(left, 0.0, bay, kGroundFloor, 1, 1);
  part.openings.size = {1.3, 2.1};
  part.openings.first = {0.5 * (bay - 1.3), 0.02};
  part.openings.arched = true;
  part.recess = 0.35;
  part.filling = SurfaceKind::Door;
  part.filling_reflectivity = 0.3;
  addFront(parts, part, wall_reflectivity);
}

void
addGableRoof(TownParts& parts, double width, double depth, double height)
{
  constexpr double kSlope = 0.8;
  constexpr double kEaves = 0.35;
  const double rise = 0.5 * kSlope * depth;
  const Vector3d along(width + 2.0 * kEaves, 0.0, 0.0);
  const Vector3d slope(0.0, 0.5 * depth + kEaves, rise + kSlope * kEaves);
  const double eaves = height - kSlope * kEaves;
  parts.use(SurfaceKind::Roof, 0.25);
  parts.addRectangle({-kEaves, -kEaves, eaves}, along, slope);
  parts.addRectangle(
      {-kEaves, depth + kEaves, eaves}, along, Vector3d(0.0, -slope.y(), slope.z()));
  parts.use(SurfaceKind::Wall, 0.5);
  for (const double x : {0.0, width})
    parts.addGable({x, 0.0, height}, {0.0, depth, 0.0}, {0.0, 0.0, rise});
}

/** Flat, with a dome on a drum in the middle. */
void
addDomedRoof(TownParts& parts, double width, double depth, double height)
{
  const double radius = 0.36 * std::min(width, depth);
  const Vector3d middle(0.5 * width, 0.5 * depth, height);
  parts.use(SurfaceKind::Roof, 0.25);
  parts.addRectangle({0.0, 0.0, height}, {width, 0.0, 0.0}, {0.0, depth, 0.0});
  parts.use(SurfaceKind::Dome, 0.5);
  parts.addCylinder(middle, {0.0, 0.0, 1.5}, radius, radius);
  parts.addDome(middle + Vector3d(0.0, 0.0, 1.5), radius);
}

/** Four columns with plinths and a beam in front of the entrance. */
void
addPortico(TownParts& parts, double width)
{
  constexpr double kOut = 1.5;
  const double span = std::min(width - 1.0, 7.0);
  const double left = 0.5 * (width - span);
  parts.use(SurfaceKind::Column, 0.6);
  for (int k = 0; k < 4; ++k) {
    const double x = left + 0.4 + k * (span - 0.8) / 3.0;
    parts.addBox({x - 0.32, -kOut - 0.32, -0.3}, {x + 0.32, -kOut + 0.32, 0.35});
    parts.addCylinder({x, -kOut, 0.35}, {0.0, 0.0, 2.7}, 0.25, 0.2);
  }
  parts.addBox({left, -kOut - 0.35, 3.05}, {left + span, -kOut + 0.35, 3.55});
}

void
addCornices(TownParts& parts, double width, int floors)
{
  parts.use(SurfaceKind::Cornice, 0.5);
  for (int floor = 0; floor < floors; ++floor) {
    const double radius = floor + 1 < floors ? 0.08 : 0.18;
    const double z = kGroundFloor + floor * kFloor;
    const Vector3d left(0.0, 0.0, z);
    const Vector3d along(width, 0.0, 0.0);
    parts.addCylinder(left, along, radius, radius);
    parts.addDisc(left, along, radius);
    parts.addDisc(left + along, along, radius);
  }
}

void
addOtherWalls(TownParts& parts, double width, double depth, double height)
{
  constexpr double kBelow = 2.0; // walls go on into sloping ground
  const Vector3d up(0.0, 0.0, height + kBelow);
  for (const double x : {0.0, width})
    parts.addRectangle({x, 0.0, -kBelow}, {0.0, depth, 0.0}, up);
  parts.addRectangle({0.0, depth, -kBelow}, {width, 0.0, 0.0}, up);
  parts.addRectangle({0.0, 0.0, -kBelow}, {width, 0.0, 0.0}, {0.0, 0.0, kBelow});
}

} // namespace

void
addHouse(TownParts& parts, double width, double depth, CounterRandom& random)
{
  const int floors = 1 + static_cast<int>(random.uniform(1.0, 4.0));
  const int bays = std::max(2, static_cast<int>(width / random.uniform(2.6, 3.4)));
  const double bay = width / bays;
  const int door = static_cast<int>(random.uniform(0.0, bays));
  const double paint = random.uniform(0.25, 0.6);
  const bool shutters = random.chance(0.3);
  const double height = kGroundFloor + (floors - 1) * kFloor;
  const auto addWindows =
      [&](double left, double bottom, double storey, int n, int rows) {
        if (n < 1 || rows < 1)
          return;
        FrontPart part = windows(left, bottom, bay, storey, n, rows);
        part.recess = shutters ? 0.08 : 0.18;
        part.filling_reflectivity = shutters ? 0.5 : kGlass;
        addFront(parts, part, paint);
      };
  addWindows(0.0, 0.0, kGroundFloor, door, 1);
  addDoorBay(parts, door * bay, bay, paint);
  addWindows((door + 1) * bay, 0.0, kGroundFloor, bays - door - 1, 1);
  addWindows(0.0, kGroundFloor, kFloor, bays, floors - 1);
  parts.use(SurfaceKind::Wall, paint);
  addOtherWalls(parts, width, depth, height);
  addCornices(parts, width, floors);
  if (random.chance(0.12)) {
    addDomedRoof(parts, width, depth, height);
    addPortico(parts, width);
  }
  else
    addGableRoof(parts, width, depth, height);
}

void
addPlainHouse(TownParts& parts, double width, double depth, CounterRandom& random)
{
  const double height = random.uniform(2.5, 12.0);
  parts.use(SurfaceKind::Wall, random.uniform(0.25, 0.6));
  addOtherWalls(parts, width, depth, height);
  parts.addRectangle({0.0, 0.0, 0.0}, {width, 0.0, 0.0}, {0.0, 0.0, height});
  addGableRoof(parts, width, depth, height);
}

} // namespace nurbs
} // namespace pcl
