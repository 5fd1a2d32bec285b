// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** A rectangle on the ground: from a corner along x (the front) and to the back. */
struct Plot {
  Vector2d corner;
  Vector2d along;
  double width = 0.0;
  double depth = 0.0;

  Vector2d
  back() const
  {
    return {-along.y(), along.x()};
  }

  std::array<Vector2d, 4>
  corners() const
  {
    const Vector2d x = width * along;
    const Vector2d y = depth * back();
    return {corner, corner + x, corner + x + y, corner + y};
  }
};

/** Whether one of two plots' sides separates them. */
bool
isApart(const Plot& one, const Plot& other)
{
  const auto separates = [](const Plot& a, const Plot& b, const Vector2d& axis) {
    const auto range = [&](const Plot& plot) {
      double low = 1e300;
      double high = -1e300;
      for (const Vector2d& corner : plot.corners()) {
        low = std::min(low, axis.dot(corner));
        high = std::max(high, axis.dot(corner));
      }
      return std::make_pair(low, high);
    };
    const auto ra = range(a);
    const auto rb = range(b);
    return ra.second <= rb.first || rb.second <= ra.first;
  };
  return separates(one, other, one.along) || separates(one, other, one.back()) ||
         separates(one, other, other.along) || separates(one, other, other.back());
}

/** Finds room for plots along one side of the path. */
class Builder {
public:
  Builder(TownParts& parts, const TownPath& path) : parts_(parts), path_(path) {}

  /** \a side is 1 on the left. */
  void
  buildAlong(double side, CounterRandom& random)
  {
    const double end = path_.nodes().back().arc;
    for (double arc = 0.0; arc < end;) {
      const double width = random.uniform(8.0, 17.0);
      const double setback =
          random.chance(0.5) ? random.uniform(0.1, 1.0) : random.uniform(2.5, 6.0);
      if (random.chance(0.8) && build(arc, width, side, setback, random)) {
        arc += width + (random.chance(0.6) ? 0.02 : random.uniform(2.0, 9.0));
        continue;
      }
      const bool walled = random.chance(0.5) && buildWall(arc, width, side);
      arc += walled ? width : 3.0;
    }
  }

private:
  /** The plot whose front lies between two places beside the path. */
  Plot
  plotAt(double arc, double width, double side, double setback) const
  {
    const double edge = side * RoadShape::kMiddle + RoadShape::kHalfWidth +
                        RoadShape::kSidewalk + setback;
    const Vector2d start = path_.place(arc, side * edge).head<2>();
    const Vector2d end = path_.place(arc + width, side * edge).head<2>();
    Plot plot;
    plot.width = (end - start).norm();
    plot.along = plot.width > 0.0 ? Vector2d((end - start) / plot.width)
                                  : Vector2d(Vector2d::UnitX());
    plot.corner = start;
    if (side < 0.0) { // the back, to the left of the front, is away from the road
      plot.corner = end;
      plot.along = -plot.along;
    }
    return plot;
  }

  /** Whether no road, no driven line and no other plot is on it. */
  bool
  isFree(const Plot& plot) const
  {
    constexpr double kMargin = RoadShape::kSidewalk + 0.05;
    const auto corners = plot.corners();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2d edge = corners[(k + 1) % 4] - corners[k];
      const int steps = 1 + static_cast<int>(edge.norm() / 2.0);
      for (int i = 0; i < steps; ++i) {
        const Vector2d place = corners[k] + edge * i / steps;
        if (path_.roadClearance(place) < kMargin || path_.driveClearance(place) < 3.0)
          return false;
      }
    }
    return std::none_of(plots_.begin(), plots_.end(), [&](const Plot& other) {
      const double reach = plot.width + plot.depth + other.width + other.depth;
      return (plot.corner - other.corner).norm() < reach && !isApart(plot, other);
    });
  }

  Eigen::Isometry3d
  frameOf(const Plot& plot) const
  {
    const Vector2d middle = plot.corner + 0.5 * plot.width * plot.along;
    return uprightFrame(
        {plot.corner.x(), plot.corner.y(), path_.groundAt(middle).height}, plot.along);
  }

  bool
  build(double arc, double width, double side, double setback, CounterRandom& random)
  {
    Plot plot = plotAt(arc, width, side, setback);
    for (const double depth : {random.uniform(8.0, 12.0), 5.0}) {
      plot.depth = depth;
      if (plot.width < 6.0 || !isFree(plot))
        continue;
      plots_.push_back(plot);
      parts_.beginObject(frameOf(plot));
      addHouse(parts_, plot.width, plot.depth, random);
      return true;
    }
    return false;
  }

  /** A garden wall with an arched gate every four metres. */
  bool
  buildWall(double arc, double width, double side)
  {
    constexpr double kHeight = 2.6;
    constexpr double kThickness = 0.3;
    constexpr double kBay = 4.0;
    Plot plot = plotAt(arc, width, side, 0.4);
    plot.depth = kThickness;
    if (plot.width < 6.0 || !isFree(plot))
      return false;
    plots_.push_back(plot);
    parts_.beginObject(frameOf(plot));
    parts_.use(SurfaceKind::Wall, 0.45);
    OpeningGrid gates;
    gates.columns = static_cast<int>(plot.width / kBay);
    gates.rows = 1;
    gates.size = {1.1, 1.4};
    gates.pitch = {kBay, kHeight};
    gates.first = {1.4, 0.3};
    gates.arched = true;
    const Vector3d along(plot.width, 0.0, 0.0);
    const Vector3d up(0.0, 0.0, kHeight + 0.3);
    const Vector3d in(0.0, kThickness, 0.0);
    parts_.addRectangle({0.0, 0.0, -0.3}, along, up, gates);
    parts_.addRectangle({0.0, kThickness, -0.3}, along, up, gates);
    parts_.addRectangle({0.0, 0.0, kHeight}, along, in);
    for (const double x : {0.0, plot.width})
      parts_.addRectangle({x, 0.0, -0.3}, in, up);
    return true;
  }

  TownParts& parts_;
  const TownPath& path_;
  std::vector<Plot> plots_;
};

} // namespace

void
addBuildings(TownParts& parts, const TownPath& path, std::uint64_t seed)
{
  Builder builder(parts, path);
  CounterRandom left(seed, 1);
  CounterRandom right(seed, 2);
  builder.buildAlong(1.0, left);
  builder.buildAlong(-1.0, right);
}

} // namespace nurbs
} // namespace pcl
