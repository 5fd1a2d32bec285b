// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/primitive_tree.h>
#include <pcl/mapping/trajectory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What a surface of a town belongs to. */
enum class SurfaceKind : std::uint8_t {
  Road,
  Curb,
  Sidewalk,
  Ground,
  Wall,
  Window,
  Door,
  Arch,
  Cornice,
  Roof,
  Dome,
  Column,
  ParkedCar,
  MovingCar,
  Pedestrian,
  Pole,
  Trunk,
  Leaves
};

/** \brief Name of a kind in lower case, e.g. "parked car". */
PCL_NURBS_MAPPING_EXPORT const std::string&
surfaceKindName(SurfaceKind kind);

/** \brief What a surface is made of and where it belongs. */
struct TownSurface {
  SurfaceKind kind = SurfaceKind::Wall;
  /** Share of light that it scatters, 0 to 1; of a pane, what comes back from behind.
   */
  float reflectivity = 0.5F;
  /** Surfaces of one building, car, ... have the same number. */
  std::uint32_t object = 0;
};

/** \brief What surrounds a drive. The last two have nothing to hold on to along the
 * way, and nothing that moves: tests for odometry. */
enum class TownScene {
  Streets, /**< a town */
  Tunnel,  /**< smooth walls and a vault over the road, open where other legs cross */
  Square   /**< a level plane without anything on it; poses are put at one height */
};

/** \brief What is built. */
struct TownOptions {
  TownScene scene = TownScene::Streets;
  std::uint64_t seed = 1;
  /** Height of the driven poses above the ground, metres. */
  double sensor_height = 1.89;
  /** Whether there are cars and pedestrians that move. */
  bool movers = true;
};

class TownPath;
struct Mover;

/** \brief A procedural town along a drive: roads with crown and curbs, facades with
 * windows, arched doors and cornices, domes, columns, roofs, cars, pedestrians, poles
 * and trees, all of exact surfaces.
 *
 * Where the drive comes back to a street it finds the same street. Positioning data
 * often disagree there in height (by metres in some public ones), so the heights of the
 * poses are evened out first: drive() is what the town was built along. The world's z
 * axis points up. The same drive and options give the same town. Const members are
 * thread-safe. \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT Town {
public:
  /** \brief Build.
   * \param[in] drive poses of the sensor in a world whose z axis points up, at least
   * one \param[in] options what is built \throws std::invalid_argument when there is no
   * pose, one is not finite, times run backwards, or an option makes no sense */
  explicit Town(const Trajectory& drive, const TownOptions& options = {});

  ~Town();
  Town(const Town&) = delete;
  Town&
  operator=(const Town&) = delete;

  /** \brief The poses, their heights evened out. */
  const Trajectory&
  drive() const
  {
    return drive_;
  }

  /** \brief Surfaces that stand still, in the world's frame. */
  const PrimitiveTree&
  tree() const
  {
    return *tree_;
  }

  /** \brief Number of all surfaces; those that stand still come first. */
  std::uint32_t
  numSurfaces() const
  {
    return static_cast<std::uint32_t>(surfaces_.size());
  }

  /** \brief What a surface is.
   * \throws std::out_of_range when there is no such surface */
  const TownSurface&
  surface(std::uint32_t id) const
  {
    return surfaces_.at(id);
  }

  /** \brief The geometry of a surface, of one that moves in the frame of its body.
   * \throws std::out_of_range when there is no such surface */
  const Primitive&
  primitive(std::uint32_t id) const;

  /** \brief Frame of a surface's body in the world at a time: the identity for one that
   * stands still, nothing for one that is not there at that time.
   * \throws std::out_of_range when there is no such surface */
  std::optional<Eigen::Isometry3d>
  bodyPose(std::uint32_t id, double time) const;

  /** \brief Bodies that move. */
  const std::vector<Mover>&
  movers() const
  {
    return movers_;
  }

  /** \brief Frame of a moving body at a time; nothing when it is not there. */
  std::optional<Eigen::Isometry3d>
  moverPose(const Mover& mover, double time) const;

private:
  Trajectory drive_;
  std::unique_ptr<const TownPath> path_;
  std::unique_ptr<const PrimitiveTree> tree_;
  std::vector<Mover> movers_;
  std::vector<Primitive> moving_;
  std::vector<TownSurface> surfaces_;
};

/** \brief A body that moves along the road. \ingroup mapping */
struct Mover {
  std::uint32_t first_surface = 0;
  std::uint32_t num_surfaces = 0;
  double radius = 0.0; /**< of a sphere around the origin of its frame that holds it */
  double begin = 0.0;  /**< it is there from this time on, seconds */
  double end = 0.0;
  double time = 0.0;    /**< when it is at \a arc */
  double arc = 0.0;     /**< metres along the drive's path */
  double speed = 0.0;   /**< along the path; negative against the drive, m/s */
  double lateral = 0.0; /**< metres to the left of the path */
  bool follows = false; /**< \a arc counts from where the drive is at each time */
};

} // namespace nurbs
} // namespace pcl
