// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/ray_intersection.h>

#include "patch_tree.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief One query of RayIntersector: walks the hierarchy and solves the pieces. */
class RaySearch {
public:
  /** \param[in] nearest_only drop what lies behind a hit already found */
  RaySearch(const NurbsSurface& surface,
            const PatchTree& tree,
            const Ray& ray,
            bool nearest_only);

  /** \brief Hits in the order of t, each once. */
  std::vector<RayHit>
  run();

private:
  /** What is known about a piece in ray coordinates. */
  enum class Content { Nothing, OneAtMost, Unknown };

  void
  visit(const PatchTree::Node& node);

  void
  solveLeaf(int leaf);

  Content
  contentOf(const BezierPatch& patch) const;

  bool
  solve(const BezierPatch& patch);

  void
  settle(const BezierPatch& patch);

  /** Gauss-Newton inside of a piece; returns the distance left to the ray. */
  double
  approach(const BezierPatch& patch, Eigen::Vector2d& uv) const;

  Eigen::Vector4d
  toRayFrame(const Eigen::Vector4d& homogeneous) const;

  void
  report(const Eigen::Vector2d& uv, bool contact);

  void
  mergeEqual();

  const NurbsSurface& surface_;
  const PatchTree& tree_;
  double length_;             // of the direction given; inside, t is a length
  Eigen::Vector3d direction_; // unit
  double base_t_;
  Eigen::Vector3d base_;               // point of the line next to the surface
  Eigen::Matrix<double, 2, 3> across_; // unit vectors normal to the ray
  double t_min_;
  double t_max_;
  bool nearest_only_;
  std::vector<RayHit> hits_;
};

} // namespace nurbs
} // namespace pcl
