// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/differential_geometry.h>

#include "regular_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

FundamentalForms
formsOf(const NurbsSurface& surface, const SurfaceJet2& s)
{
  FundamentalForms forms;
  forms.e = s.du.squaredNorm();
  forms.f = s.du.dot(s.dv);
  forms.g = s.dv.squaredNorm();
  forms.normal = unitNormal(surface, s.du, s.dv);
  forms.l = s.duu.dot(forms.normal);
  forms.m = s.duv.dot(forms.normal);
  forms.n = s.dvv.dot(forms.normal);
  return forms;
}

/** Curvatures at a regular point: the shape operator in the orthonormal frame that
 * starts with S_u is symmetric, so its eigenvalues are real and well conditioned. */
SurfaceCurvature
regularCurvature(const SurfaceJet2& s, const FundamentalForms& forms)
{
  const double length_u = std::sqrt(forms.e);
  const Eigen::Vector3d x = s.du / length_u;
  const Eigen::Vector3d y = forms.normal.cross(x);
  // S_v = a x + b y, so y = (S_v - a / |S_u| S_u) / b as a parameter direction.
  const double a = s.dv.dot(x);
  const double b = s.dv.dot(y);
  const double ratio = a / length_u;
  const double xx = forms.l / forms.e;
  const double xy = (forms.m - ratio * forms.l) / (length_u * b);
  const double yy =
      (forms.n - 2.0 * ratio * forms.m + ratio * ratio * forms.l) / (b * b);
  SurfaceCurvature result;
  result.regular = true;
  result.mean = 0.5 * (xx + yy);
  result.gaussian = xx * yy - xy * xy;
  const double radius = std::hypot(0.5 * (xx - yy), xy);
  result.maximum = result.mean + radius;
  result.minimum = result.mean - radius;
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  result.maximum_direction = std::cos(angle) * x + std::sin(angle) * y;
  result.minimum_direction = forms.normal.cross(result.maximum_direction);
  return result;
}

SurfaceCurvature
curvatureAt(const NurbsSurface& surface, double u, double v)
{
  const SurfaceJet2 jet = surface.evaluateJet2(u, v);
  const FundamentalForms forms = formsOf(surface, jet);
  return forms.normal.isZero() ? SurfaceCurvature() : regularCurvature(jet, forms);
}

/** Limit at a degenerate point from two points on the way to the middle of the domain,
 * far enough from it for second derivatives to survive the cancellation there. */
SurfaceCurvature
limitCurvature(const NurbsSurface& surface, double u, double v)
{
  const double to_u =
      0.5 * (surface.knotsU().domainMin() + surface.knotsU().domainMax()) - u;
  const double to_v =
      0.5 * (surface.knotsV().domainMin() + surface.knotsV().domainMax()) - v;
  constexpr double kStep = 1e-4;
  const auto at = [&](double step) {
    return curvatureAt(surface, u + step * to_u, v + step * to_v);
  };
  SurfaceCurvature result = at(kStep);
  const SurfaceCurvature farther = at(2.0 * kStep);
  if (!result.regular || !farther.regular)
    return {};
  result.mean = 2.0 * result.mean - farther.mean;
  result.maximum = 2.0 * result.maximum - farther.maximum;
  result.minimum = 2.0 * result.minimum - farther.minimum;
  result.gaussian = result.maximum * result.minimum;
  result.regular = false;
  return result;
}

} // namespace

FundamentalForms
fundamentalForms(const NurbsSurface& surface, double u, double v)
{
  return formsOf(surface, surface.evaluateJet2(u, v));
}

SurfaceCurvature
curvature(const NurbsSurface& surface, double u, double v)
{
  const SurfaceCurvature result = curvatureAt(surface, u, v);
  return result.regular ? result : limitCurvature(surface, u, v);
}

double
curvature(const NurbsCurve2& curve, double u)
{
  const std::vector<Eigen::Vector2d> d = curve.derivatives(u, 2);
  const double speed = d[1].norm();
  return speed > 0.0 ? (d[1].x() * d[2].y() - d[1].y() * d[2].x()) / std::pow(speed, 3)
                     : 0.0;
}

double
curvature(const NurbsCurve3& curve, double u)
{
  const std::vector<Eigen::Vector3d> d = curve.derivatives(u, 2);
  const double speed = d[1].norm();
  return speed > 0.0 ? d[1].cross(d[2]).norm() / std::pow(speed, 3) : 0.0;
}

double
torsion(const NurbsCurve3& curve, double u)
{
  const std::vector<Eigen::Vector3d> d = curve.derivatives(u, 3);
  const Eigen::Vector3d binormal = d[1].cross(d[2]);
  const double length = binormal.norm();
  constexpr double kStraight = 1e-10;
  if (length <= kStraight * d[1].norm() * d[2].norm())
    return 0.0;
  return binormal.dot(d[3]) / (length * length);
}

} // namespace nurbs
} // namespace pcl
