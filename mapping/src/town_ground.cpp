// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"
#include "town_path.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCrown = 0.09; // middle of the road above its edges
constexpr double kCurb = 0.12;
constexpr double kCurbSlant = 0.02;
constexpr double kSidewalkRise = 0.03;
constexpr double kSkirt = 0.6; // the side of a sidewalk goes into the ground

/** Points of one cross-section of the road, by metres from its middle. */
struct CrossSection {
  explicit CrossSection(const TownPath::Node& node)
      : middle(node.ground), left(-node.along.y(), node.along.x(), 0.0)
  {
    middle += RoadShape::kMiddle * left;
  }

  Vector3d
  at(double lateral, double rise) const
  {
    return middle + lateral * left + rise * Vector3d::UnitZ();
  }

  Vector3d middle;
  Vector3d left;
};

void
addRoad(TownParts& parts, const CrossSection& start, const CrossSection& end)
{
  // The control point of a parabola is as far beyond its top again.
  const auto parabola = [](const CrossSection& section) {
    return std::array<Vector3d, 3>{section.at(RoadShape::kHalfWidth, -kCrown),
                                   section.at(0.0, kCrown),
                                   section.at(-RoadShape::kHalfWidth, -kCrown)};
  };
  parts.use(SurfaceKind::Road, 0.42);
  parts.add(RuledPatch{parabola(start), parabola(end)});
}

/** Curb, sidewalk and its outer side; \a side is 1 on the left. */
void
addSidewalk(TownParts& parts,
            const CrossSection& start,
            const CrossSection& end,
            double side)
{
  const double edge = side * RoadShape::kHalfWidth;
  const double inner = edge + side * kCurbSlant;
  const double outer = edge + side * RoadShape::kSidewalk;
  const double low = -kCrown;
  const double high = low + kCurb + kSidewalkRise;
  const auto strip = [&](double from, double rise_from, double to, double rise_to) {
    parts.add(RuledPatch::bilinear(start.at(from, rise_from),
                                   start.at(to, rise_to),
                                   end.at(from, rise_from),
                                   end.at(to, rise_to)));
  };
  parts.use(SurfaceKind::Curb, 0.5);
  strip(edge, low, inner, low + kCurb);
  parts.use(SurfaceKind::Sidewalk, 0.45);
  strip(inner, low + kCurb, outer, high);
  strip(outer, high, outer, high - kSkirt);
}

void
addStreets(TownParts& parts, const TownPath& path)
{
  constexpr double kIntoOtherRoad = -0.3;
  const auto& nodes = path.nodes();
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (!path.hasRoad(i))
      continue;
    const CrossSection start(nodes[i]);
    const CrossSection end(nodes[i + 1]);
    addRoad(parts, start, end);
    for (const double side : {1.0, -1.0}) {
      const double edge = side * (RoadShape::kHalfWidth + 0.5 * RoadShape::kSidewalk);
      const Vector2d place = 0.5 * (start.at(edge, 0.0) + end.at(edge, 0.0)).head<2>();
      if (path.roadClearance(place) - 0.5 * RoadShape::kSidewalk > kIntoOtherRoad)
        addSidewalk(parts, start, end, side);
    }
  }
}

/** Corners of the ground's lattice, heights made when they are first asked for. */
class GroundLattice {
public:
  static constexpr double kCell = 4.0;
  using Index = std::pair<std::int64_t, std::int64_t>;

  GroundLattice(const TownPath& path, std::uint64_t seed) : path_(path), seed_(seed) {}

  /** The corner, and whether it is near enough to the path to be needed. */
  std::pair<Vector3d, bool>
  corner(const Index& index)
  {
    const auto known = corners_.find(index);
    if (known != corners_.end())
      return known->second;
    return corners_.emplace(index, make(index)).first->second;
  }

private:
  std::pair<Vector3d, bool>
  make(const Index& index) const
  {
    constexpr double kReach = 62.0;
    constexpr double kBelowRoad = 0.4;
    constexpr double kRoughness = 0.05;
    const Vector2d place = kCell * Vector2d(static_cast<double>(index.first),
                                            static_cast<double>(index.second));
    const TownPath::Ground ground = path_.groundAt(place);
    CounterRandom random(seed_,
                         static_cast<std::uint64_t>(index.first),
                         static_cast<std::uint64_t>(index.second));
    const bool open = path_.roadClearance(place) > RoadShape::kSidewalk;
    const double rise = open ? kRoughness * random.normal() : -kBelowRoad;
    return {Vector3d(place.x(), place.y(), ground.height + rise),
            ground.distance < kReach};
  }

  const TownPath& path_;
  std::uint64_t seed_;
  std::map<Index, std::pair<Vector3d, bool>> corners_;
};

void
addCells(TownParts& parts, const TownPath& path, std::uint64_t seed)
{
  constexpr std::int64_t kReach = 16; // cells
  GroundLattice lattice(path, seed);
  std::map<GroundLattice::Index, bool> done;
  const auto addCell = [&](std::int64_t x, std::int64_t y) {
    if (!done.emplace(GroundLattice::Index(x, y), true).second)
      return;
    const auto a = lattice.corner({x, y});
    const auto b = lattice.corner({x + 1, y});
    const auto c = lattice.corner({x, y + 1});
    const auto d = lattice.corner({x + 1, y + 1});
    if (a.second || b.second || c.second || d.second)
      parts.add(RuledPatch::bilinear(a.first, b.first, c.first, d.first));
  };
  parts.use(SurfaceKind::Ground, 0.5);
  for (std::size_t i = 0; i < path.nodes().size(); i += 3) {
    const Vector3d& ground = path.nodes()[i].ground;
    const auto x =
        static_cast<std::int64_t>(std::floor(ground.x() / GroundLattice::kCell));
    const auto y =
        static_cast<std::int64_t>(std::floor(ground.y() / GroundLattice::kCell));
    for (std::int64_t dx = -kReach; dx <= kReach; ++dx)
      for (std::int64_t dy = -kReach; dy <= kReach; ++dy)
        addCell(x + dx, y + dy);
  }
}

} // namespace

void
addGround(TownParts& parts, const TownPath& path, std::uint64_t seed)
{
  parts.beginObject(Eigen::Isometry3d::Identity());
  addStreets(parts, path);
  parts.beginObject(Eigen::Isometry3d::Identity());
  addCells(parts, path, seed);
}

void
addTunnel(TownParts& parts, const TownPath& path)
{
  constexpr double kWall = 3.5;
  constexpr double kTop = 7.0; // of the vault's middle control point
  constexpr double kRoom = 3.0;
  parts.beginObject(Eigen::Isometry3d::Identity());
  const auto& nodes = path.nodes();
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (!path.hasRoad(i))
      continue;
    const CrossSection start(nodes[i]);
    const CrossSection end(nodes[i + 1]);
    addRoad(parts, start, end);
    parts.use(SurfaceKind::Wall, 0.4);
    for (const double edge : {RoadShape::kHalfWidth, -RoadShape::kHalfWidth})
      if (path.driveClearance(start.at(edge, 0.0).head<2>()) > kRoom &&
          path.driveClearance(end.at(edge, 0.0).head<2>()) > kRoom)
        parts.add(RuledPatch::bilinear(start.at(edge, -kCrown),
                                       start.at(edge, kWall),
                                       end.at(edge, -kCrown),
                                       end.at(edge, kWall)));
    const auto arch = [&](const CrossSection& section) {
      return std::array<Vector3d, 3>{section.at(RoadShape::kHalfWidth, kWall),
                                     section.at(0.0, kTop),
                                     section.at(-RoadShape::kHalfWidth, kWall)};
    };
    parts.use(SurfaceKind::Arch, 0.4);
    parts.add(RuledPatch{arch(start), arch(end)});
  }
}

void
addSquare(TownParts& parts, const TownPath& path)
{
  constexpr double kMargin = 200.0;
  const auto& nodes = path.nodes();
  Eigen::AlignedBox2d box;
  for (const TownPath::Node& node : nodes)
    box.extend(node.ground.head<2>());
  const Vector2d corner = box.min() - Vector2d::Constant(kMargin);
  const Vector2d size = box.sizes() + Vector2d::Constant(2.0 * kMargin);
  parts.beginObject(Eigen::Isometry3d::Identity());
  parts.use(SurfaceKind::Ground, 0.4);
  parts.addRectangle({corner.x(), corner.y(), nodes.front().ground.z()},
                     {size.x(), 0.0, 0.0},
                     {0.0, size.y(), 0.0});
}

} // namespace nurbs
} // namespace pcl
