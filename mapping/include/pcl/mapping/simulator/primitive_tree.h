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

  /** \brief The first meeting between two distances. */
  BeamHit
  cast(const Beam& ray, double near, double far) const;

private:
  /** An inner node has its children next to each other; a leaf its primitives. Boxes
   * are in single precision, grown by more than its rounding, with a fourth coordinate
   * that holds everything: four numbers fit a register. */
  struct Node {
    Eigen::Array4f low;
    Eigen::Array4f high;
    std::uint32_t first; /**< of the children, or of the leaf's places in order_ */
    std::uint32_t count; /**< of a leaf's primitives, 0 for an inner node */
  };

  class Builder;

  std::vector<Primitive> primitives_; // in the order given
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

} // namespace nurbs
} // namespace pcl
