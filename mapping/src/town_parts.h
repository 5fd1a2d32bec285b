// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/counter_random.h>
#include <pcl/mapping/simulator/town.h>

#include <vector>

namespace pcl {
namespace nurbs {

class TownPath;
class TownPlots;

/** Collects the surfaces of a town, object by object, each built in a frame of its own
 * (x to the right along the front, y away from it, z up). */
class TownParts {
public:
  /** The surfaces that follow belong to a new object. */
  void
  beginObject(const Eigen::Isometry3d& frame)
  {
    frame_ = frame;
    ++object_;
  }

  /** Kind and reflectivity of the surfaces that follow. */
  void
  use(SurfaceKind kind, double reflectivity)
  {
    kind_ = kind;
    reflectivity_ = static_cast<float>(reflectivity);
  }

  void
  add(const Primitive& primitive);

  /** Rectangle at \a corner, along the two axes as far as they are long. */
  void
  addRectangle(const Eigen::Vector3d& corner,
               const Eigen::Vector3d& along_x,
               const Eigen::Vector3d& along_y,
               const OpeningGrid& openings = {});

  /** The isosceles triangle in that rectangle. */
  void
  addGable(const Eigen::Vector3d& corner,
           const Eigen::Vector3d& along_x,
           const Eigen::Vector3d& along_y);

  /** The sides and the top of a box between two corners. */
  void
  addBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /** Cylinder, or cone with another radius at the top, from a foot along an axis. */
  void
  addCylinder(const Eigen::Vector3d& foot,
              const Eigen::Vector3d& axis,
              double radius,
              double radius_top,
              const AngleRange& sweep = {});

  void
  addDisc(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double radius);

  /** The upper half of a sphere. */
  void
  addDome(const Eigen::Vector3d& center, double radius);

  void
  addSphere(const Eigen::Vector3d& center, double radius);

  std::vector<Primitive> primitives;
  std::vector<TownSurface> surfaces;

private:
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
  SurfaceKind kind_ = SurfaceKind::Wall;
  float reflectivity_ = 0.5F;
  std::uint32_t object_ = 0;
};

/** Frame at a place whose x axis has a direction of the ground plane. */
Eigen::Isometry3d
uprightFrame(const Eigen::Vector3d& place, const Eigen::Vector2d& x_axis);

/** Roads, curbs, sidewalks and the ground between them. */
void
addGround(TownParts& parts, const TownPath& path, std::uint64_t seed);

/** A road between smooth walls under a vault. */
void
addTunnel(TownParts& parts, const TownPath& path);

/** A level plane around the path, at the height of its first node. */
void
addSquare(TownParts& parts, const TownPath& path);

/** Houses, garages, garden walls and clipped hedges on both sides; their plots are
 * taken. */
void
addBuildings(TownParts& parts,
             const TownPath& path,
             TownPlots& plots,
             std::uint64_t seed);

/** Parked cars, poles, trees, hedges and pavilions, where no plot is taken. */
void
addFurniture(TownParts& parts,
             const TownPath& path,
             const TownPlots& plots,
             std::uint64_t seed);

/** A hedge clipped to a box with its front from the origin along x, and leaves
 * around it. */
void
addClippedHedge(TownParts& parts,
                double length,
                double depth,
                double height,
                CounterRandom& random);

/** A house with its front from the origin along x. */
void
addHouse(TownParts& parts, double width, double depth, CounterRandom& random);

/** The same with bare walls: a shed, a barn, a block of flats. */
void
addPlainHouse(TownParts& parts, double width, double depth, CounterRandom& random);

/** A car that looks along x, the middle of its foot at the origin. */
void
addCar(TownParts& parts, SurfaceKind kind, CounterRandom& random);

/** A person who looks along x, at the origin. */
void
addPedestrian(TownParts& parts, CounterRandom& random);

/** Cars and pedestrians; \a parts collects their surfaces. */
std::vector<Mover>
makeMovers(TownParts& parts,
           const TownPath& path,
           const Trajectory& drive,
           std::uint64_t seed);

} // namespace nurbs
} // namespace pcl
