// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "arc_parameters.h"

#include <pcl/surface/nurbs/knot_operations.h>
#include <pcl/surface/nurbs/segment_fitter.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using KnotPair = std::pair<KnotVector, KnotVector>;

/** Plane of largest extent; its normal points to the origin, where a sensor would be.
 */
Eigen::Isometry3d
principalFrame(const Eigen::Matrix3Xd& positions)
{
  const Eigen::Vector3d centre = positions.rowwise().mean();
  const Eigen::Matrix3Xd centred = positions.colwise() - centre;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(centred *
                                                             centred.transpose());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  Eigen::Vector3d normal = eigen.eigenvectors().col(0);
  if (normal.dot(centre) > 0.0)
    normal = -normal;
  frame.linear().col(0) = eigen.eigenvectors().col(2);
  frame.linear().col(1) = normal.cross(eigen.eigenvectors().col(2));
  frame.linear().col(2) = normal;
  frame.translation() = centre;
  return frame;
}

/** Whether nearly all local planes can be seen from the normal of the base plane. */
bool
isHeightField(const LocalPlanes& planes, const Eigen::Vector3d& normal)
{
  constexpr double kSteep = 0.3; // cosine
  constexpr double kFew = 0.05;
  const Eigen::ArrayXd cosine = (planes.normals.transpose() * normal).array().abs();
  return static_cast<double>((cosine < kSteep).count()) <=
         kFew * static_cast<double>(cosine.size());
}

/** Knots that are fixed by the options, else those given as found. */
KnotVector
fixedOr(const std::optional<KnotVector>& fixed,
        KnotVector found,
        double low,
        double high,
        bool map)
{
  if (!fixed)
    return found;
  if (map)
    return fixed->rescaled(low, high);
  if (low < fixed->domainMin() || high > fixed->domainMax())
    throw std::invalid_argument("segment fit: parameters outside of the fixed knots");
  return *fixed;
}

class SegmentFit {
public:
  SegmentFit(const SegmentPoints& segment, const SegmentFitOptions& options)
      : segment_(segment), options_(options), points_(segment.points)
  {
    search_ = options.search;
    search_.degree_u = options.degree_u;
    search_.degree_v = options.degree_v;
    if (points_.positions.cols() == 0 || !points_.positions.allFinite())
      throw std::invalid_argument("segment fit: no points, or one is not finite");
  }

  SurfaceFit
  run()
  {
    SurfaceFit fit = fitBy(chosen());
    if (options_.optimize_weights)
      fit = withWeights(fit);
    fit.report.criterion = search_report_.criterion;
    fit.report.salient = search_report_.salient;
    return fit;
  }

private:
  Parameterization
  chosen() const
  {
    if (options_.parameterization != Parameterization::Auto)
      return options_.parameterization;
    if (options_.camera)
      return Parameterization::Perspective;
    const Eigen::Isometry3d plane =
        options_.base ? *options_.base : principalFrame(points_.positions);
    if (isHeightField(segment_.planes, plane.linear().col(2)))
      return Parameterization::Plane;
    return points_.parameters.cols() > 0 ? Parameterization::Grid
                                         : Parameterization::Cylinder;
  }

  SurfaceFit
  fitBy(Parameterization parameterization)
  {
    switch (parameterization) {
    case Parameterization::Perspective:
      return fitHeights(cameraFrame());
    case Parameterization::Cylinder:
      return fitCylinder();
    case Parameterization::Grid:
      return fitGiven(true);
    case Parameterization::Given:
      return fitGiven(false);
    case Parameterization::Plane:
    case Parameterization::Auto:
      break;
    }
    return fitHeights(HeightFieldFrame::plane(
        options_.base ? *options_.base : principalFrame(points_.positions)));
  }

  HeightFieldFrame
  cameraFrame() const
  {
    if (!options_.camera)
      throw std::invalid_argument("segment fit: a camera is needed");
    const PinholeCamera& c = *options_.camera;
    return HeightFieldFrame::perspective(c.fx, c.fy, c.cx, c.cy, c.T_world_camera);
  }

  /** Searched or default knots, overruled by what is fixed. */
  template <typename Search>
  KnotPair
  chooseKnots(bool map, Search search)
  {
    constexpr int kDefaultDegree = 3;
    const ParameterBox box = ParameterBox::around(points_.parameters);
    KnotPair found;
    if (options_.adaptive && !(options_.knots_u && options_.knots_v)) {
      found = search();
    }
    else {
      const auto degree = [](int fixed) { return fixed > 0 ? fixed : kDefaultDegree; };
      found.first =
          KnotVector::bezier(degree(options_.degree_u), box.low(0), box.high(0));
      found.second =
          KnotVector::bezier(degree(options_.degree_v), box.low(1), box.high(1));
    }
    return {
        fixedOr(options_.knots_u, std::move(found.first), box.low(0), box.high(0), map),
        fixedOr(
            options_.knots_v, std::move(found.second), box.low(1), box.high(1), map)};
  }

  SurfaceFit
  fitHeights(const HeightFieldFrame& frame)
  {
    points_.parameters.resize(2, points_.positions.cols());
    for (Eigen::Index k = 0; k < points_.positions.cols(); ++k)
      points_.parameters.col(k) = frame.toLocal(points_.positions.col(k)).head<2>();
    if (!points_.parameters.allFinite())
      throw std::domain_error("segment fit: a point cannot be seen by the camera");
    const KnotPair knots = chooseKnots(true, [&] {
      return chooseHeightFieldKnots(frame, points_, search_, search_report_);
    });
    if (!options_.constraints.empty())
      return fitParametric(
          knots.first, knots.second, points_, options_.fit, options_.constraints);
    return fitHeightField(frame, knots.first, knots.second, points_, options_.fit);
  }

  SurfaceFit
  fitGiven(bool map)
  {
    if (points_.parameters.cols() != points_.positions.cols())
      throw std::invalid_argument("segment fit: one (u, v) per point is needed");
    const KnotPair knots = chooseKnots(
        map, [&] { return chooseParametricKnots(points_, search_, search_report_); });
    return fitParametric(
        knots.first, knots.second, points_, options_.fit, options_.constraints);
  }

  /** The radius decides which knots are needed; the circle itself costs none. */
  SurfaceFit
  fitCylinder()
  {
    const Eigen::Isometry3d frame =
        options_.base ? *options_.base
                      : fitCylinderAxis(points_.positions, segment_.planes).frame;
    const ArcPoints arc = arcParameters(points_.positions, frame, options_.closed);
    points_.parameters = arc.parameters;
    FitPoints unrolled = points_;
    unrolled.positions.topRows(2) = arc.parameters;
    unrolled.positions.row(2) = arc.radii.transpose();
    const KnotPair knots = chooseKnots(true, [&] {
      return chooseHeightFieldKnots(
          HeightFieldFrame(), unrolled, search_, search_report_);
    });
    const NurbsCurve3 base = refinedArc(arc.arc, knots.first);
    const int n_v = knots.second.numControlPoints();
    Eigen::VectorXd weights(base.homogeneousPoints().cols() * n_v);
    for (Eigen::Index i = 0; i < base.homogeneousPoints().cols(); ++i)
      weights.segment(i * n_v, n_v).setConstant(base.homogeneousPoints()(3, i));
    SurfaceFitOptions fit_options = options_.fit;
    const auto fit = [&](const std::vector<BorderConstraint>& constraints) {
      return fitParametric(
          base.knots(), knots.second, points_, fit_options, constraints, weights);
    };
    if (!options_.closed)
      return fit(options_.constraints);
    fit_options.distance = FitDistance::Parametric;
    const SurfaceFit open = fit(options_.constraints);
    fit_options.distance = options_.fit.distance;
    return fit(seamConstraints(open.surface));
  }

  /** The unit arc with the degree and the inner knots of the radius. */
  static NurbsCurve3
  refinedArc(const NurbsCurve3& arc, const KnotVector& knots)
  {
    constexpr double kSameKnot = 1e-9;
    const NurbsCurve3 raised =
        elevateDegree(arc, std::max(0, knots.degree() - arc.knots().degree()));
    std::vector<double> added;
    for (double knot : knots.values())
      if (knot > knots.domainMin() && knot < knots.domainMax() &&
          raised.knots().multiplicity(knot, kSameKnot) == 0)
        added.push_back(knot);
    return refineKnots(raised, added);
  }

  /** Both ends on their mean curve. */
  std::vector<BorderConstraint>
  seamConstraints(const NurbsSurface& open) const
  {
    NurbsSurface::HomogeneousPoints points = open.homogeneousPoints();
    const int n_v = open.numControlPointsV();
    const Eigen::Matrix4Xd seam = 0.5 * (points.leftCols(n_v) + points.rightCols(n_v));
    points.leftCols(n_v) = seam;
    points.rightCols(n_v) = seam;
    const NurbsSurface closed(open.knotsU(), open.knotsV(), std::move(points));
    std::vector<BorderConstraint> constraints = options_.constraints;
    constraints.push_back({Border::UMin, closed, Border::UMin, Continuity::C0});
    constraints.push_back({Border::UMax, closed, Border::UMax, Continuity::C0});
    return constraints;
  }

  SurfaceFit
  withWeights(const SurfaceFit& start)
  {
    FitPoints points = points_;
    orthogonalDistances(
        start.surface, points.positions, points.parameters, options_.fit.threads);
    return fitRational(start.surface, points, options_.fit);
  }

  const SegmentPoints& segment_;
  const SegmentFitOptions& options_;
  FitPoints points_;
  KnotSearchOptions search_;
  FitReport search_report_;
};

} // namespace

SurfaceFit
fitSegment(const SegmentPoints& segment, const SegmentFitOptions& options)
{
  return SegmentFit(segment, options).run();
}

} // namespace nurbs
} // namespace pcl
