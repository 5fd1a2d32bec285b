// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/bounding_box.h>

#include "bezier_extraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

template <typename Shape>
auto
boxOfHomogeneous(const Shape& points)
{
  constexpr int kDim = Shape::RowsAtCompileTime - 1;
  Eigen::AlignedBox<double, kDim> box;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    box.extend(points.col(i).template head<kDim>() / points(kDim, i));
  return box;
}

/** Largest value of a linear form over Bézier pieces, never too small and too large by
 * at most the tolerance. */
class Extent {
public:
  Extent(const Eigen::Vector3d& direction, double tolerance)
      : direction_(direction), tolerance_(tolerance)
  {
  }

  double
  of(const std::vector<BezierPatch>& pieces)
  {
    for (const BezierPatch& piece : pieces)
      reachCorners(piece);
    for (const BezierPatch& piece : pieces)
      visit(piece, kMaxSplits);
    return std::max(reached_, bound_);
  }

private:
  static constexpr int kMaxSplits = 60;

  double
  value(const BezierPatch& piece, int i, int j) const
  {
    return direction_.dot(piece.cartesian(i, j));
  }

  void
  reachCorners(const BezierPatch& piece)
  {
    for (int i : {0, piece.degree_u})
      for (int j : {0, piece.degree_v})
        reached_ = std::max(reached_, value(piece, i, j));
  }

  void
  visit(const BezierPatch& piece, int splits_left)
  {
    double upper = value(piece, 0, 0);
    double curved_u = 0.0;
    double curved_v = 0.0;
    for (int i = 0; i <= piece.degree_u; ++i)
      for (int j = 0; j <= piece.degree_v; ++j) {
        const double here = value(piece, i, j);
        upper = std::max(upper, here);
        if (i > 1)
          curved_u = std::max(
              curved_u,
              std::abs(here - 2.0 * value(piece, i - 1, j) + value(piece, i - 2, j)));
        if (j > 1)
          curved_v = std::max(
              curved_v,
              std::abs(here - 2.0 * value(piece, i, j - 1) + value(piece, i, j - 2)));
      }
    if (upper <= reached_ + tolerance_ || splits_left == 0) {
      bound_ = std::max(bound_, upper);
      return;
    }
    // Only the curved direction separates the control points from the surface.
    BezierPatch low;
    BezierPatch high;
    piece.split(curved_u >= curved_v ? Direction::U : Direction::V, low, high);
    reachCorners(low);
    reachCorners(high);
    visit(low, splits_left - 1);
    visit(high, splits_left - 1);
  }

  Eigen::Vector3d direction_;
  double tolerance_;
  double reached_ = -std::numeric_limits<double>::infinity();
  double bound_ = -std::numeric_limits<double>::infinity();
};

Eigen::AlignedBox3d
tightBoxOfPieces(const std::vector<BezierPatch>& pieces,
                 double diagonal,
                 double relative_tolerance)
{
  if (!(relative_tolerance >= 1e-13))
    throw std::invalid_argument("tightBox: the tolerance must be at least 1e-13");
  const double tolerance = relative_tolerance * diagonal;
  Eigen::AlignedBox3d box;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    box.max()(axis) = Extent(unit, tolerance).of(pieces);
    box.min()(axis) = -Extent(-unit, tolerance).of(pieces);
  }
  return box;
}

} // namespace

Eigen::AlignedBox3d
controlBox(const NurbsSurface& surface)
{
  return boxOfHomogeneous(surface.homogeneousPoints());
}

template <int Dim>
Eigen::AlignedBox<double, Dim>
controlBox(const NurbsCurve<Dim>& curve)
{
  return boxOfHomogeneous(curve.homogeneousPoints());
}

Eigen::AlignedBox3d
tightBox(const NurbsSurface& surface, double relative_tolerance)
{
  return tightBoxOfPieces(extractBezier(surface),
                          controlBox(surface).diagonal().norm(),
                          relative_tolerance);
}

template <int Dim>
Eigen::AlignedBox<double, Dim>
tightBox(const NurbsCurve<Dim>& curve, double relative_tolerance)
{
  const Eigen::AlignedBox3d box = tightBoxOfPieces(
      extractBezier(curve), controlBox(curve).diagonal().norm(), relative_tolerance);
  return {box.min().template head<Dim>(), box.max().template head<Dim>()};
}

template Eigen::AlignedBox<double, 2>
controlBox<2>(const NurbsCurve<2>&);
template Eigen::AlignedBox<double, 3>
controlBox<3>(const NurbsCurve<3>&);
template Eigen::AlignedBox<double, 2>
tightBox<2>(const NurbsCurve<2>&, double);
template Eigen::AlignedBox<double, 3>
tightBox<3>(const NurbsCurve<3>&, double);

} // namespace nurbs
} // namespace pcl
