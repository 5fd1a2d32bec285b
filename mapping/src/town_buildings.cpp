// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"
#include "town_plots.h"

#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** How a stretch of one side of a street is built up. */
struct Block {
  double end = 0.0;            /**< arc length */
  double setback = 0.0;        /**< of the fronts from the sidewalk, metres */
  double variation = 0.0;      /**< of the setback */
  double share_built = 0.0;    /**< of the front */
  double share_touching = 0.0; /**< of houses without a gap to the next */
};

Block
nextBlock(double arc, CounterRandom& random)
{
  const double style = random.uniform();
  Block block;
  if (style < 0.22) // old town: houses at the sidewalk
    block = {0.0, random.uniform(0.1, 0.6), 0.4, 0.97, 0.85};
  else if (style < 0.78) // front gardens
    block = {0.0, random.uniform(2.5, 7.0), 1.5, 0.92, 0.35};
  else if (style < 0.92) // an avenue
    block = {0.0, random.uniform(6.0, 13.0), 1.5, 0.85, 0.3};
  else // hardly built
    block = {0.0, random.uniform(4.0, 12.0), 3.0, 0.4, 0.0};
  block.end = arc + random.uniform(50.0, 140.0);
  return block;
}

/** Finds room for plots along one side of the path. */
class Builder {
public:
  Builder(TownParts& parts, const TownPath& path, TownPlots& plots)
      : parts_(parts), path_(path), plots_(plots)
  {
  }

  /** Strips across the path that stay free, with a view between the houses. \a side is
   * 1 on the left. */
  void
  leaveSideStreets(double side, CounterRandom& random)
  {
    const double end = path_.nodes().back().arc;
    for (double arc = random.uniform(20.0, 100.0); arc < end;
         arc += random.uniform(80.0, 220.0)) {
      Plot plot = plotAt(arc, random.uniform(8.0, 13.0), side, 0.0);
      plot.depth = random.uniform(22.0, 45.0);
      plots_.add(plot);
    }
  }

  void
  buildFront(double side, CounterRandom& random)
  {
    const double end = path_.nodes().back().arc;
    Block block = nextBlock(0.0, random);
    for (double arc = 0.0; arc < end;) {
      if (arc > block.end)
        block = nextBlock(arc, random);
      const double width = random.uniform(8.0, 17.0);
      const double setback = block.setback + random.uniform(0.0, block.variation);
      if (random.chance(block.share_built) &&
          build(arc, width, side, setback, random)) {
        const bool touching = random.chance(block.share_touching);
        const double gap = touching ? 0.02 : random.uniform(2.0, 9.0);
        if (setback > 2.0)
          buildBoundary(arc, width, side, random);
        if (!touching)
          closeGap(arc + width, gap, side, setback, random);
        arc += width + gap;
        continue;
      }
      const bool walled = random.chance(0.25) && buildWall(arc, width, side);
      arc += walled ? width : random.uniform(3.0, 8.0);
    }
  }

  /** Plain buildings behind the gardens of the houses at the street. */
  void
  buildBackground(double side, double nearest, double farthest, CounterRandom& random)
  {
    const double end = path_.nodes().back().arc;
    for (double arc = 0.0; arc < end; arc += random.uniform(2.0, 6.0)) {
      Plot plot = plotAt(
          arc, random.uniform(6.0, 22.0), side, random.uniform(nearest, farthest));
      plot.depth = random.uniform(4.0, 10.0);
      if (plot.width < 4.0 || !isFree(plot))
        continue;
      plots_.add(plot);
      parts_.beginObject(frameOf(plot));
      addPlainHouse(parts_, plot.width, plot.depth, random);
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
    return plots_.isFree(plot);
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
      plots_.add(plot);
      parts_.beginObject(frameOf(plot));
      addHouse(parts_, plot.width, plot.depth, random);
      return true;
    }
    return false;
  }

  /** A low wall or a clipped hedge between a front garden and the sidewalk, with room
   * for a way in. */
  void
  buildBoundary(double arc, double width, double side, CounterRandom& random)
  {
    constexpr double kWayIn = 2.4;
    const double style = random.uniform();
    const double height = random.uniform(0.7, 1.7);
    if (style > 0.75)
      return;
    Plot plot = plotAt(arc, width - kWayIn, side, 0.15);
    const bool hedge = style < 0.6;
    plot.depth = hedge ? 0.7 : 0.25;
    if (plot.width >= 2.0)
      buildClosure(plot, hedge, height, random);
  }

  /** Something between a house and the next: a garage, a wall or a high hedge. */
  void
  closeGap(double arc, double gap, double side, double setback, CounterRandom& random)
  {
    constexpr double kJoint = 0.1;
    const double style = random.uniform();
    const double back = setback + random.uniform(0.3, 4.0);
    const double height = random.uniform(1.7, 2.6);
    Plot plot = plotAt(arc + kJoint, gap - 2.0 * kJoint, side, back);
    const bool garage = style < 0.25 && plot.width > 2.6;
    plot.depth = garage ? 5.0 : 0.6;
    const bool hedge = !garage && style < 0.65;
    if (style <= 0.85 && plot.width >= 1.0)
      buildClosure(plot, hedge, height, random);
  }

  /** A clipped hedge, or a box of walls, on a plot if it is free. */
  void
  buildClosure(const Plot& plot, bool hedge, double height, CounterRandom& random)
  {
    if (!isFree(plot))
      return;
    plots_.add(plot);
    parts_.beginObject(frameOf(plot));
    if (hedge) {
      addClippedHedge(parts_, plot.width, plot.depth, height, random);
      return;
    }
    parts_.use(SurfaceKind::Wall, random.uniform(0.3, 0.55));
    parts_.addBox({0.0, 0.0, -0.5}, {plot.width, plot.depth, height});
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
    plots_.add(plot);
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
  TownPlots& plots_;
};

} // namespace

void
addBuildings(TownParts& parts,
             const TownPath& path,
             TownPlots& plots,
             std::uint64_t seed)
{
  Builder builder(parts, path, plots);
  CounterRandom left(seed, 1);
  CounterRandom right(seed, 2);
  builder.leaveSideStreets(1.0, left);
  builder.leaveSideStreets(-1.0, right);
  builder.buildFront(1.0, left);
  builder.buildFront(-1.0, right);
  for (const auto& [nearest, farthest] :
       {std::pair{4.0, 9.0}, {16.0, 32.0}, {38.0, 54.0}}) {
    builder.buildBackground(1.0, nearest, farthest, left);
    builder.buildBackground(-1.0, nearest, farthest, right);
  }
}

} // namespace nurbs
} // namespace pcl
