// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "orthogonal_problem.h"

#include "cell_rows.h"
#include "foot_point.h"
#include "robust_loss.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

/** Denominator of a rational surface at a parameter. */
double
evaluateWeight(const NurbsSurface& surface, const Eigen::Vector2d& uv)
{
  const KnotVector& u = surface.knotsU();
  const KnotVector& v = surface.knotsV();
  const int span_u = u.findSpan(uv.x());
  const int span_v = v.findSpan(uv.y());
  BasisValues basis_u;
  BasisValues basis_v;
  u.evaluateBasis(span_u, uv.x(), basis_u);
  v.evaluateBasis(span_v, uv.y(), basis_v);
  double weight = 0.0;
  for (int i = 0; i <= u.degree(); ++i)
    for (int j = 0; j <= v.degree(); ++j)
      weight += basis_u[static_cast<std::size_t>(i)] *
                basis_v[static_cast<std::size_t>(j)] *
                surface.weight(span_u - u.degree() + i, span_v - v.degree() + j);
  return weight;
}

double
diagonal(const Eigen::Matrix3Xd& positions)
{
  const double length =
      (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).norm();
  return length > 0.0 ? length : 1.0;
}

/** Unit normal and two unit tangents as columns. */
Eigen::Matrix3d
surfaceFrame(const SurfaceJet1& jet)
{
  Eigen::Matrix3d frame;
  frame.col(0) = jet.du.cross(jet.dv).normalized();
  frame.col(1) = jet.du.normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

} // namespace

HeightUnknowns::HeightUnknowns(const HeightFieldFrame& frame,
                               KnotVector knots_u,
                               KnotVector knots_v)
    : frame_(frame), knots_u_(std::move(knots_u)), knots_v_(std::move(knots_v))
{
}

NurbsSurface
HeightUnknowns::surface(const Eigen::MatrixXd& unknowns) const
{
  return frame_.surface(knots_u_, knots_v_, unknowns.row(0).transpose());
}

void
HeightUnknowns::sensitivity(const NurbsSurface& /*surface*/,
                            const Eigen::Vector2d& uv,
                            const Eigen::Vector3d& foot,
                            const Eigen::Vector3d& direction,
                            double* factors) const
{
  const Eigen::Vector4d local(uv.x(), uv.y(), frame_.toLocal(foot).z(), 1.0);
  const double weight = frame_.matrix().row(3).dot(local);
  factors[0] = direction.dot(frame_.derivativeByHeight(foot, weight));
}

HomogeneousUnknowns::HomogeneousUnknowns(const NurbsSurface& start, bool weights_too)
    : start_(start), weights_too_(weights_too)
{
}

NurbsSurface
HomogeneousUnknowns::surface(const Eigen::MatrixXd& unknowns) const
{
  NurbsSurface::HomogeneousPoints points = start_.homogeneousPoints();
  points.topRows(unknowns.rows()) = unknowns;
  return {start_.knotsU(), start_.knotsV(), std::move(points)};
}

void
HomogeneousUnknowns::sensitivity(const NurbsSurface& surface,
                                 const Eigen::Vector2d& uv,
                                 const Eigen::Vector3d& foot,
                                 const Eigen::Vector3d& direction,
                                 double* factors) const
{
  Eigen::Map<Eigen::Vector3d> moved(factors);
  moved = direction / evaluateWeight(surface, uv);
  if (weights_too_)
    factors[3] = -moved.dot(foot);
}

/** What each point contributes, in the order of the points. */
struct OrthogonalProblem::PointTerms {
  Eigen::MatrixXd factors;  // channels x (rows of all points): sqrt(weight) m_a
  Eigen::VectorXd residual; // per row: sqrt(weight) direction . (point - foot)
  Eigen::VectorXd cost;     // per point: rho
};

OrthogonalProblem::OrthogonalProblem(const SurfaceUnknowns& unknowns,
                                     const NurbsSurface& start,
                                     const Eigen::Matrix3Xd& positions,
                                     const Eigen::Matrix2Xd& parameters,
                                     const Eigen::VectorXd& sigma,
                                     const SurfaceFitOptions& options)
    : unknowns_(unknowns),
      knots_u_(start.knotsU()),
      knots_v_(start.knotsV()),
      positions_(positions),
      parameters_(parameters),
      sigma_(sigma),
      options_(options),
      extent_(diagonal(positions))
{
}

void
OrthogonalProblem::evaluatePoints(const NurbsSurface& surface,
                                  Eigen::Matrix2Xd& parameters,
                                  PointTerms& terms) const
{
  constexpr int kSteps = 3; // the residual is small beside the radius of curvature
  constexpr double kLastStep = 1e-8; // the derivatives are used as well
  constexpr double kDomainMargin = 0.5;
  const Eigen::Index count = positions_.cols();
  const int rows = rowsPerPoint();
  const double margin = unknowns_.channels() == 1 ? 0.0 : kDomainMargin;
  terms.factors.resize(unknowns_.channels(), rows * count);
  terms.residual.resize(rows * count);
  terms.cost.resize(count);
#pragma omp parallel for schedule(static)                                              \
    num_threads(options_.threads) if (options_.threads > 1)
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Vector3d point = positions_.col(k);
    const SurfaceJet1 jet =
        projectFrom(surface, point, kSteps, margin, kLastStep, parameters.col(k));
    const Eigen::Vector2d uv = parameters.col(k);
    const Eigen::Matrix3d frame = surfaceFrame(jet); // normal, then two tangents
    const Eigen::Vector3d offset = point - jet.position;
    const double distance = frame.col(0).dot(offset);
    // The cost also counts what is left along the surface where a foot is held at the
    // margin or has not settled: a step must not win by moving feet out of reach.
    const double s = offset.squaredNorm() / (sigma_(k) * sigma_(k));
    const LossValue loss = evaluateLoss(options_.loss, options_.loss_scale, s);
    for (int row = 0; row < rows; ++row) {
      const double root = std::sqrt(loss.slope) / sigma_(k);
      const Eigen::Index at = rows * k + row;
      double* factors = terms.factors.data() + at * terms.factors.rows();
      unknowns_.sensitivity(surface, uv, jet.position, frame.col(row), factors);
      terms.factors.col(at) *= root;
      terms.residual(at) = row == 0 ? root * distance : 0.0;
    }
    terms.cost(k) = loss.rho;
  }
  if (rows > 1)
    dampSliding(terms);
}

double
OrthogonalProblem::costOf(double distance) const
{
  return 0.5 * std::pow(distance * extent_, 2) *
         sigma_.array().square().inverse().sum();
}

void
OrthogonalProblem::dampSliding(PointTerms& terms) const
{
  constexpr double kLargestWeight = 1e-3;
  const Eigen::Index count = positions_.cols();
  const double distance =
      std::sqrt(0.5 * terms.residual.squaredNorm() / costOf(1.0)); // of the extent
  const double weight = std::min(kLargestWeight, damping_ * distance);
  for (Eigen::Index k = 0; k < count; ++k)
    terms.factors.middleCols(rowsPerPoint() * k + 1, rowsPerPoint() - 1) *=
        std::sqrt(weight);
}

PointRows
OrthogonalProblem::momentRows(const CellPoints& points,
                              const PointTerms& terms,
                              int channels) const
{
  PointRows rows;
  rows.channels = channels;
  const auto count = static_cast<Eigen::Index>(points.order.size());
  rows.gram.resize(count, channels * (channels + 1) / 2);
  rows.moments.resize(count, channels);
  rows.squares.resize(count, 1);
  const int r = rowsPerPoint();
  for (Eigen::Index k = 0; k < count; ++k) {
    const int n = points.order[static_cast<std::size_t>(k)];
    const auto factors = terms.factors.middleCols(r * n, r);
    for (int a = 0, pair = 0; a < channels; ++a) {
      rows.moments(k, a) = factors.row(a).dot(terms.residual.segment(r * n, r));
      for (int b = a; b < channels; ++b, ++pair)
        rows.gram(k, pair) = factors.row(a).dot(factors.row(b));
    }
    rows.squares(k, 0) = terms.cost(n);
  }
  return rows;
}

void
OrthogonalProblem::reduce(const Eigen::MatrixXd& unknowns,
                          const Eigen::Matrix2Xd& parameters,
                          const PointTerms& terms,
                          bool derivatives,
                          std::vector<TriangularCell>& cells) const
{
  const CellPoints points(knots_u_, knots_v_, parameters);
  const int channels = unknowns_.channels();
  const bool plain = derivatives && unknowns_.illConditioned();
  PointRows rows = momentRows(points, terms, derivatives && !plain ? channels : 0);
  if (plain) // the rows themselves carry the squares, a loss may cost more
    for (Eigen::Index k = 0; k < rows.squares.size(); ++k) {
      const int n = points.order[static_cast<std::size_t>(k)];
      const double square = std::pow(terms.residual(rowsPerPoint() * n), 2);
      rows.squares(k) = std::max(0.0, rows.squares(k) - square);
    }
  std::vector<CellEquations> equations = reduceCells(points, rows, options_.threads);
  if (options_.fairness > 0.0) {
    const Eigen::Index size =
        channels * (points.cells_u.degree() + 1) * (points.cells_v.degree() + 1);
    for (CellEquations& cell : equations)
      if (plain) {
        cell.gram.setZero(size, size);
        cell.rhs.setZero(size, 1);
      }
    addFairnessAround(points,
                      {options_.fairness * information_, 0.0},
                      unknowns - start_,
                      derivatives,
                      equations);
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    cells[cell] = factorizeCell(equations[cell]);
  if (!plain)
    return;
  const std::vector<TriangularCell> exact = reduceRows(
      points, {rowsPerPoint(), terms.factors, terms.residual}, options_.threads);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    cells[cell] = stackCells(exact[cell], cells[cell]);
}

void
OrthogonalProblem::linearize(const Eigen::MatrixXd& unknowns,
                             bool derivatives,
                             std::vector<TriangularCell>& cells)
{
  try {
    const NurbsSurface surface = unknowns_.surface(unknowns);
    Eigen::Matrix2Xd parameters = parameters_;
    PointTerms terms;
    evaluatePoints(surface, parameters, terms);
    if (start_.size() == 0) { // for good: the cost must not change its mind
      information_ = terms.factors.squaredNorm();
      start_ = unknowns;
    }
    reduce(unknowns, parameters, terms, derivatives, cells);
    if (derivatives)
      parameters_ = std::move(parameters);
  } catch (const std::logic_error&) { // no surface there: a cost that Ceres must reject
    for (TriangularCell& cell : cells)
      cell.rest.setConstant(1, std::numeric_limits<double>::quiet_NaN());
  }
}

} // namespace nurbs
} // namespace pcl
