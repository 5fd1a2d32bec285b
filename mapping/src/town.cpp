// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/town.h>

#include "town_parts.h"
#include "town_path.h"
#include "town_plots.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

void
requireUsable(const Trajectory& drive, const TownOptions& options)
{
  constexpr double kLongest = 2e5;
  constexpr double kHighest = 50.0;
  if (drive.empty())
    throw std::invalid_argument("Town: the drive has no pose");
  if (!(options.sensor_height > 0.0 && options.sensor_height <= kHighest))
    throw std::invalid_argument("Town: the sensor must be 0 to 50 m above the ground");
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (!drive[k].T_world_body.matrix().allFinite() || !std::isfinite(drive[k].stamp))
      throw std::invalid_argument("Town: pose " + std::to_string(k) + " is not finite");
    if (k > 0 && drive[k].stamp < drive[k - 1].stamp)
      throw std::invalid_argument("Town: time runs backwards at pose " +
                                  std::to_string(k));
  }
  if (pathLengths(drive).back() > kLongest)
    throw std::invalid_argument("Town: the drive is longer than 200 km");
}

/** All that stands still. */
void
addScene(TownParts& parts, const TownPath& path, const TownOptions& options)
{
  if (options.scene == TownScene::Tunnel)
    addTunnel(parts, path);
  else if (options.scene == TownScene::Square)
    addSquare(parts, path);
  else {
    TownPlots plots;
    addGround(parts, path, options.seed);
    addBuildings(parts, path, plots, options.seed);
    addFurniture(parts, path, plots, options.seed);
  }
}

} // namespace

const std::string&
surfaceKindName(SurfaceKind kind)
{
  static const std::array<std::string, 18> names = {"road",
                                                    "curb",
                                                    "sidewalk",
                                                    "ground",
                                                    "wall",
                                                    "window",
                                                    "door",
                                                    "arch",
                                                    "cornice",
                                                    "roof",
                                                    "dome",
                                                    "column",
                                                    "parked car",
                                                    "moving car",
                                                    "pedestrian",
                                                    "pole",
                                                    "trunk",
                                                    "leaves"};
  return names.at(static_cast<std::size_t>(kind));
}

Town::Town(const Trajectory& drive, const TownOptions& options) : drive_(drive)
{
  requireUsable(drive, options);
  if (options.scene == TownScene::Square)
    for (StampedPose& pose : drive_)
      pose.T_world_body.translation().z() =
          drive.front().T_world_body.translation().z();
  path_ = std::make_unique<TownPath>(drive_, options.sensor_height);
  TownParts parts;
  addScene(parts, *path_, options);
  const auto still = static_cast<std::ptrdiff_t>(parts.primitives.size());
  if (options.movers && options.scene == TownScene::Streets)
    movers_ = makeMovers(parts, *path_, drive_, options.seed);
  surfaces_ = std::move(parts.surfaces);
  moving_.assign(parts.primitives.begin() + still, parts.primitives.end());
  parts.primitives.resize(static_cast<std::size_t>(still));
  tree_ = std::make_unique<PrimitiveTree>(std::move(parts.primitives));
}

Town::~Town() = default;

const Primitive&
Town::primitive(std::uint32_t id) const
{
  const std::size_t still = tree_->primitives().size();
  return id < still ? tree_->primitives()[id] : moving_.at(id - still);
}

std::optional<Eigen::Isometry3d>
Town::bodyPose(std::uint32_t id, double time) const
{
  if (id >= surfaces_.size())
    throw std::out_of_range("Town: there is no surface " + std::to_string(id));
  for (const Mover& mover : movers_)
    if (id >= mover.first_surface && id - mover.first_surface < mover.num_surfaces)
      return moverPose(mover, time);
  return Eigen::Isometry3d::Identity();
}

std::optional<Eigen::Isometry3d>
Town::moverPose(const Mover& mover, double time) const
{
  if (time < mover.begin || time > mover.end)
    return std::nullopt;
  double arc = mover.arc + mover.speed * (time - mover.time);
  if (mover.follows)
    arc += path_->arcAt(time);
  const double end = path_->nodes().back().arc;
  if (arc <= 0.0 || arc >= end)
    return std::nullopt;
  const bool against = mover.speed < 0.0 && !mover.follows;
  const Eigen::Vector2d along = path_->direction(arc);
  return uprightFrame(path_->place(arc, mover.lateral),
                      against ? Eigen::Vector2d(-along) : along);
}

} // namespace nurbs
} // namespace pcl
