// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace pcl {
namespace nurbs {

class PolygonIndex;

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
   * units of the domain
   * \throws std::invalid_argument if the chain is empty or does not close */
  explicit TrimLoop(std::vector<NurbsCurve2> curves, double closing_tolerance = 1e-9);

  /** \brief Loop of straight edges through \a corners (closed implicitly): one curve of
   * degree 1.
   * \throws std::invalid_argument for fewer than three corners */
  static TrimLoop
  polygon(const std::vector<Eigen::Vector2d>& corners);

  /** \brief The border of a surface's domain, counter-clockwise from its least corner:
   * four straight curves, each with the parameter of the side as its own. */
  static TrimLoop
  ofDomain(const NurbsSurface& surface);

  const std::vector<NurbsCurve2>&
  curves() const
  {
    return curves_;
  }

  /** \brief Corners of a polygon that stays within \a tolerance (domain units) of the
   * loop; first corner not repeated. Exact for loops of straight edges. Curves are
   * halved until points between the corners are within the tolerance, so the result is
   * the same for both senses up to rounding.
   * \throws std::invalid_argument unless the tolerance is positive */
  std::vector<Eigen::Vector2d>
  flattened(double tolerance) const;

  /** \brief Area inside of the loop in the domain: positive if counter-clockwise. Exact
   * (Gauss-Legendre on every span) for polynomial curves. */
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

  /** \brief Take over a surface and the loops that bound it; no loops, no bounds. */
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
   * of the trimming loops, border included up to rounding (1e-12 of the domain's
   * diagonal). Curved loops count with an error below 1e-6 of that diagonal.
   *
   * Looks only at the edges that share a band of v with the point: about 0.1 us for
   * 5000 edges around a pixel mask, O(n) only if all edges cross the line of v. */
  bool
  contains(double u, double v) const;

  /** \brief Area of the trimmed part in the unit of the control points squared.
   *
   * Green's theorem turns the integral of |S_u x S_v| into one over the loops, which
   * are taken as they are, not flattened; the loops must not overlap.
   * \param[in] relative_tolerance the integration is refined until it changes by less
   * \throws std::invalid_argument unless the tolerance is positive */
  double
  area(double relative_tolerance = 1e-6) const;

private:
  NurbsSurface surface_;
  std::vector<TrimLoop> loops_;
  std::shared_ptr<const PolygonIndex> index_; // built once, shared by copies
};

} // namespace nurbs
} // namespace pcl
