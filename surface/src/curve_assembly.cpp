// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/knot_operations.h>

#include "spline_conversion.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl {
namespace nurbs {
namespace {

using detail::HomogeneousSpline;

/** Inner knots of all curves; those closer than \a tolerance have one entry. */
std::vector<double>
commonInnerKnots(const std::vector<KnotVector>& all, double tolerance)
{
  std::vector<double> inner;
  for (const KnotVector& knots : all) {
    const std::vector<double> breaks = knots.breaks();
    inner.insert(inner.end(), breaks.begin() + 1, breaks.end() - 1);
  }
  std::sort(inner.begin(), inner.end());
  std::vector<double> common;
  for (double u : inner)
    if (common.empty() || u - common.back() > tolerance)
      common.push_back(u);
  return common;
}

/** Replace each inner knot by the common one that stands for it. */
KnotVector
snapped(const KnotVector& knots, const std::vector<double>& common)
{
  std::vector<double> values(knots.values());
  for (double& u : values)
    if (detail::isInside(knots, u))
      u = *(std::upper_bound(common.begin(), common.end(), u) - 1);
  return {knots.degree(), std::move(values)};
}

/** Knots that \a knots lacks to have each of \a common as often as wanted. */
std::vector<double>
missingKnots(const KnotVector& knots, const std::map<double, int>& wanted)
{
  std::vector<double> missing;
  for (const auto& [u, copies] : wanted)
    missing.insert(
        missing.end(), static_cast<std::size_t>(copies - knots.multiplicity(u)), u);
  return missing;
}

/** Clamped copy of a given degree. */
template <int Dim>
NurbsCurve<Dim>
prepared(const NurbsCurve<Dim>& curve, int degree)
{
  return elevateDegree(clampKnots(curve), degree - curve.degree());
}

} // namespace

template <int Dim>
NurbsCurve<Dim>
join(const NurbsCurve<Dim>& first, const NurbsCurve<Dim>& second, double tolerance)
{
  const int degree = std::max(first.degree(), second.degree());
  const NurbsCurve<Dim> head = prepared(first, degree);
  const NurbsCurve<Dim> tail = prepared(second, degree);
  const typename NurbsCurve<Dim>::Point end =
      head.controlPoint(head.numControlPoints() - 1);
  const typename NurbsCurve<Dim>::Point start = tail.controlPoint(0);
  detail::require((end - start).norm() <= tolerance,
                  "the curves to join do not meet within the tolerance");

  HomogeneousSpline left = detail::toSpline(head);
  HomogeneousSpline right = detail::toSpline(tail);
  left.points /= head.weight(head.numControlPoints() - 1); // weight 1 at the joint
  right.points /= tail.weight(0);
  left.points.col(left.points.cols() - 1).template head<Dim>() = 0.5 * (end + start);
  const double joint = left.knots.domainMax();
  right.knots = right.knots.rescaled(joint, joint + right.knots.domainLength());
  const HomogeneousSpline joined = detail::concatenated(left, right, true);
  return {joined.knots, joined.points};
}

template <int Dim>
std::vector<NurbsCurve<Dim>>
makeCompatible(const std::vector<NurbsCurve<Dim>>& curves, double knot_tolerance)
{
  detail::require(!curves.empty(), "there is no curve to make compatible");
  int degree = 1;
  for (const NurbsCurve<Dim>& curve : curves)
    degree = std::max(degree, curve.degree());
  std::vector<NurbsCurve<Dim>> raised;
  std::vector<KnotVector> all;
  for (const NurbsCurve<Dim>& curve : curves) {
    raised.push_back(prepared(curve, degree));
    all.push_back(raised.back().knots().rescaled(curves[0].knots().domainMin(),
                                                 curves[0].knots().domainMax()));
  }
  const std::vector<double> common =
      commonInnerKnots(all, knot_tolerance * all[0].domainLength());
  std::map<double, int> wanted;
  for (KnotVector& knots : all) {
    knots = snapped(knots, common);
    for (double u : common)
      wanted[u] = std::max(wanted[u], knots.multiplicity(u));
  }
  for (std::size_t i = 0; i < raised.size(); ++i) {
    const HomogeneousSpline spline{all[i], raised[i].homogeneousPoints(), Dim + 1};
    raised[i] =
        toCurve(detail::refined(spline, missingKnots(all[i], wanted)), curves[i]);
  }
  return raised;
}

/// Explicit instances for one dimension of curves.
#define PCL_NURBS_INSTANTIATE(Dim)                                                     \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> join(                              \
      const NurbsCurve<Dim>&, const NurbsCurve<Dim>&, double);                         \
  template PCL_NURBS_SURFACE_EXPORT std::vector<NurbsCurve<Dim>> makeCompatible(       \
      const std::vector<NurbsCurve<Dim>>&, double);

PCL_NURBS_INSTANTIATE(2)
PCL_NURBS_INSTANTIATE(3)

} // namespace nurbs
} // namespace pcl
