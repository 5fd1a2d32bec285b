// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "bezier_extraction.h"

namespace pcl {
namespace nurbs {
namespace {

/** A non-empty knot span and the matrix that takes its p + 1 control points to those of
 * the Bézier piece. */
struct SpanExtraction {
  int span;
  double low;
  double high;
  Eigen::MatrixXd matrix;
};

/** Row of the extraction matrix of Bézier point \a k: the blossom with k arguments at
 * the end of the span and the others at its start, by de Boor's triangle. */
Eigen::RowVectorXd
blossomRow(const KnotVector& knots, int span, int k)
{
  const int p = knots.degree();
  Eigen::MatrixXd d = Eigen::MatrixXd::Identity(p + 1, p + 1);
  for (int level = 1; level <= p; ++level) {
    const double argument = level <= p - k ? knots[span] : knots[span + 1];
    for (int i = p; i >= level; --i) {
      const double low = knots[span - p + i];
      const double alpha = (argument - low) / (knots[span + i - level + 1] - low);
      d.row(i) = (1.0 - alpha) * d.row(i - 1) + alpha * d.row(i);
    }
  }
  return d.row(p);
}

std::vector<SpanExtraction>
extractions(const KnotVector& knots)
{
  std::vector<SpanExtraction> result;
  const int p = knots.degree();
  for (int span = p; span < knots.numControlPoints(); ++span) {
    if (!(knots[span] < knots[span + 1]))
      continue;
    Eigen::MatrixXd matrix(p + 1, p + 1);
    for (int k = 0; k <= p; ++k)
      matrix.row(k) = blossomRow(knots, span, k);
    result.push_back({span, knots[span], knots[span + 1], std::move(matrix)});
  }
  return result;
}

/** Halve one row of Bézier points that are \a stride apart. */
void
splitRow(const Eigen::Vector4d* row,
         int degree,
         int stride,
         Eigen::Vector4d* low,
         Eigen::Vector4d* high)
{
  std::array<Eigen::Vector4d, kMaxDegree + 1> triangle;
  for (int i = 0; i <= degree; ++i)
    triangle[i] = row[i * stride];
  for (int level = 0; level <= degree; ++level) {
    low[level * stride] = triangle[0];
    high[(degree - level) * stride] = triangle[degree - level];
    for (int i = 0; i < degree - level; ++i)
      triangle[i] = 0.5 * (triangle[i] + triangle[i + 1]);
  }
}

void
copyFrame(const BezierPatch& from, BezierPatch& to)
{
  to.degree_u = from.degree_u;
  to.degree_v = from.degree_v;
  to.u_min = from.u_min;
  to.u_max = from.u_max;
  to.v_min = from.v_min;
  to.v_max = from.v_max;
}

} // namespace

Eigen::Vector4d
BezierPatch::evaluate(double s, double t) const
{
  const auto reduce = [](auto& row, int degree, double at) {
    for (int level = degree; level > 0; --level)
      for (int i = 0; i < level; ++i)
        row[i] = (1.0 - at) * row[i] + at * row[i + 1];
    return row[0];
  };
  std::array<Eigen::Vector4d, kMaxDegree + 1> column;
  for (int i = 0; i <= degree_u; ++i) {
    std::array<Eigen::Vector4d, kMaxDegree + 1> row;
    for (int j = 0; j <= degree_v; ++j)
      row[j] = (*this)(i, j);
    column[i] = reduce(row, degree_v, t);
  }
  return reduce(column, degree_u, s);
}

void
BezierPatch::split(Direction direction, BezierPatch& low, BezierPatch& high) const
{
  copyFrame(*this, low);
  copyFrame(*this, high);
  const int row = degree_v + 1;
  if (direction == Direction::U) {
    low.u_max = high.u_min = 0.5 * (u_min + u_max);
    for (int j = 0; j <= degree_v; ++j)
      splitRow(&points[j], degree_u, row, &low.points[j], &high.points[j]);
    return;
  }
  low.v_max = high.v_min = 0.5 * (v_min + v_max);
  for (int i = 0; i <= degree_u; ++i)
    splitRow(
        &points[i * row], degree_v, 1, &low.points[i * row], &high.points[i * row]);
}

Direction
BezierPatch::longerDirection() const
{
  double along_u = 0.0;
  double along_v = 0.0;
  for (int i = 0; i <= degree_u; ++i)
    for (int j = 0; j <= degree_v; ++j) {
      if (i > 0)
        along_u += (cartesian(i, j) - cartesian(i - 1, j)).norm() / (degree_v + 1);
      if (j > 0)
        along_v += (cartesian(i, j) - cartesian(i, j - 1)).norm() / (degree_u + 1);
    }
  return along_u >= along_v ? Direction::U : Direction::V;
}

std::vector<BezierPatch>
extractBezier(const NurbsSurface& surface)
{
  const std::vector<SpanExtraction> spans_v = extractions(surface.knotsV());
  const int p = surface.knotsU().degree();
  const int q = surface.knotsV().degree();
  std::vector<BezierPatch> result;
  for (const SpanExtraction& u : extractions(surface.knotsU()))
    for (const SpanExtraction& v : spans_v) {
      BezierPatch& patch = result.emplace_back();
      patch.degree_u = p;
      patch.degree_v = q;
      patch.u_min = u.low;
      patch.u_max = u.high;
      patch.v_min = v.low;
      patch.v_max = v.high;
      for (int a = 0; a <= p; ++a) {
        Eigen::Matrix4Xd row = Eigen::Matrix4Xd::Zero(4, q + 1);
        for (int i = 0; i <= p; ++i)
          row +=
              u.matrix(a, i) *
              surface.homogeneousPoints().middleCols(
                  (u.span - p + i) * surface.numControlPointsV() + v.span - q, q + 1);
        row *= v.matrix.transpose();
        for (int b = 0; b <= q; ++b)
          patch(a, b) = row.col(b);
      }
    }
  return result;
}

template <int Dim>
std::vector<BezierPatch>
extractBezier(const NurbsCurve<Dim>& curve)
{
  const int p = curve.degree();
  std::vector<BezierPatch> result;
  for (const SpanExtraction& span : extractions(curve.knots())) {
    BezierPatch& patch = result.emplace_back();
    patch.degree_u = p;
    patch.u_min = span.low;
    patch.u_max = span.high;
    const typename NurbsCurve<Dim>::HomogeneousPoints points =
        curve.homogeneousPoints().middleCols(span.span - p, p + 1) *
        span.matrix.transpose();
    for (int a = 0; a <= p; ++a) {
      patch(a, 0).setZero();
      patch(a, 0).template head<Dim>() = points.col(a).template head<Dim>();
      patch(a, 0)(3) = points(Dim, a);
    }
  }
  return result;
}

template std::vector<BezierPatch>
extractBezier<2>(const NurbsCurve<2>&);
template std::vector<BezierPatch>
extractBezier<3>(const NurbsCurve<3>&);

} // namespace nurbs
} // namespace pcl
