// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/primitives.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Where a ray meets a set of surfaces first. */
struct BeamHit {
  static constexpr std::uint32_t kNothing = 0xFFFFFFFFU;

  double distance = 0.0;
  std::uint32_t surface = kNothing; /**< index; kNothing if the ray meets none */
};

/** \brief Hierarchy of boxes over primitives: the first meeting of a ray in O(log n).
 *
 * Built top-down by the surface-area heuristic over bins. Const members are
 * thread-safe; the same primitives give the same tree. \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT PrimitiveTree {
public:
  /** \brief Build over primitives, which are taken over; there may be none. */
  explicit PrimitiveTree(std::vector<Primitive> primitives);

  const std::vector<Primitive>&
  primitives() const
  {
    return primitives_;
  }

  /** \brief The first meeting of a ray between two distances. */
  BeamHit
  cast(const Beam& ray, double near, double far) const;

  /** \brief The first meetings of many rays from one point, which costs much less than
   * one by one when neighbours have similar directions: a column of a laser, a row of
   * an image. The distances are those of cast(), to the bit.
   * \param[in] origin of the rays
   * \param[in] directions of unit length
   * \param[in] near least distance
   * \param[in,out] hits a hit per ray, which is replaced by one that is nearer; so
   * hits[i].distance is how far ray i goes
   * \throws std::invalid_argument when there is not one hit per direction */
  void
  castFan(const Eigen::Vector3d& origin,
          const std::vector<Eigen::Vector3d>& directions,
          double near,
          std::vector<BeamHit>& hits) const;

private:
  /** Deepest level of a tree. */
  static constexpr std::size_t kDeepest = 128;

  /** An inner node has its children next to each other; a leaf is one primitive. Boxes
   * are in single precision, grown by more than its rounding. */
  struct Node {
    Eigen::Array3f low;
    Eigen::Array3f high;
    std::uint32_t first; /**< of the children, or the leaf's place in order_ */
    std::uint32_t count; /**< 1 for a leaf, 0 for an inner node */
  };

  class Builder;
  class FanTraversal;

  std::vector<Primitive> primitives_; // in the order given
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

} // namespace nurbs
} // namespace pcl
