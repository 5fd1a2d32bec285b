// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A closed chain of curves in the (u, v) domain of a surface.
 *
 * The end of each curve is the start of the next, the last one closes on the first. An
 * outer loop runs counter-clockwise, a hole clockwise, so the surface is on the left.
 * \ingroup surface
 */
class PCL_NURBS_SURFACE_EXPORT TrimLoop {
public:
  /** \brief Take over a chain of curves.
   * \param[in] curves at least one curve
   * \param[in] closing_tolerance largest gap between an end and the next start, in
   * units of the domain \throws std::invalid_argument if the chain is empty or does not
   * close */
  explicit TrimLoop(std::vector<NurbsCurve2> curves, double closing_tolerance = 1e-9);

  /** \brief Loop of straight edges through \a corners (closed implicitly): one curve of
   * degree 1.
   * \throws std::invalid_argument for fewer than three corners */
  static TrimLoop
  polygon(const std::vector<Eigen::Vector2d>& corners);

  const std::vector<NurbsCurve2>&
  curves() const
  {
    return curves_;
  }

  /** \brief Corners of a polygon that stays within \a tolerance (domain units) of the
   * loop; first corner not repeated. Exact for loops of straight edges. */
  std::vector<Eigen::Vector2d>
  flattened(double tolerance) const;

  /** \brief Area inside of the loop in the domain: positive if counter-clockwise. */
  double
  signedArea() const;

  /** \brief The same loop in the opposite sense. */
  TrimLoop
  reversed() const;

private:
  std::vector<NurbsCurve2> curves_;
};

/** \brief A surface and the part of its domain that belongs to it.
 *
 * A parameter is inside if the loops wind around it (non-zero winding number); no loop
 * means the whole domain. Immutable, const members are thread-safe.
 * \ingroup surface
 */
class PCL_NURBS_SURFACE_EXPORT TrimmedSurface {
public:
  TrimmedSurface() = default;

  explicit TrimmedSurface(NurbsSurface surface, std::vector<TrimLoop> loops = {});

  const NurbsSurface&
  surface() const
  {
    return surface_;
  }

  const std::vector<TrimLoop>&
  loops() const
  {
    return loops_;
  }

  bool
  isTrimmed() const
  {
    return !loops_.empty();
  }

  /** \brief Whether the parameter (u, v) lies on the surface: inside of the domain and
   * of the trimming loops (border included up to rounding). O(log n) for a polygon of n
   * edges. */
  bool
  contains(double u, double v) const;

  /** \brief Area of the trimmed part in the unit of the control points squared. */
  double
  area(double relative_tolerance = 1e-6) const;

private:
  NurbsSurface surface_;
  std::vector<TrimLoop> loops_;
  // Flattened edges sorted for contains(); built once by the constructor.
  struct Edge {
    double v_low, v_high; // extent in v
    Eigen::Vector2d from, to;
  };
  std::vector<Edge> edges_;
};

} // namespace nurbs
} // namespace pcl
