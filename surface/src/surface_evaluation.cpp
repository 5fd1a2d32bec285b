// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "jet_kernel.h"

namespace pcl {
namespace nurbs {
namespace {

/** Homogeneous point and partial derivatives up to \a Order in each direction. */
template <int Order>
class HomogeneousJet {
public:
  HomogeneousJet(const NurbsSurface& surface, double u, double v)
  {
    const KnotVector& knots_u = surface.knotsU();
    const KnotVector& knots_v = surface.knotsV();
    const int span_u = knots_u.findSpan(u);
    const int span_v = knots_v.findSpan(v);
    PlainSpan at;
    at.p = knots_u.degree();
    at.q = knots_v.degree();
    at.stride = surface.numControlPointsV();
    at.knots_u = knots_u.values().data() + span_u;
    at.knots_v = knots_v.values().data() + span_v;
    at.points = surface.homogeneousPoints().data() +
                4 * ((span_u - at.p) * at.stride + span_v - at.q);
    evaluatePlainJet(at, u, v, Order, rows_);
  }

  Eigen::Map<const Eigen::Vector3d>
  cartesian(JetRow row) const
  {
    return Eigen::Map<const Eigen::Vector3d>(rows_[row]);
  }

  double
  weight(JetRow row) const
  {
    return rows_[row][3];
  }

private:
  double rows_[(Order + 1) * (Order + 2) / 2][4];
};

} // namespace

Eigen::Vector3d
NurbsSurface::evaluate(double u, double v) const
{
  const HomogeneousJet<0> h(*this, u, v);
  return (1.0 / h.weight(kValue)) * h.cartesian(kValue);
}

SurfaceJet1
NurbsSurface::evaluateJet1(double u, double v) const
{
  const HomogeneousJet<1> h(*this, u, v);
  const double scale = 1.0 / h.weight(kValue);
  SurfaceJet1 result;
  result.position = scale * h.cartesian(kValue);
  result.du = scale * h.cartesian(kDu);
  result.dv = scale * h.cartesian(kDv);
  if (!rational_)
    return result;
  result.du -= scale * h.weight(kDu) * result.position;
  result.dv -= scale * h.weight(kDv) * result.position;
  return result;
}

SurfaceJet2
NurbsSurface::evaluateJet2(double u, double v) const
{
  const HomogeneousJet<2> h(*this, u, v);
  const double scale = 1.0 / h.weight(kValue);
  SurfaceJet2 s;
  s.position = scale * h.cartesian(kValue);
  s.du = scale * h.cartesian(kDu);
  s.dv = scale * h.cartesian(kDv);
  s.duu = scale * h.cartesian(kDuu);
  s.duv = scale * h.cartesian(kDuv);
  s.dvv = scale * h.cartesian(kDvv);
  if (!rational_)
    return s;
  const double w_u = scale * h.weight(kDu); // quotient rule, equation 4.20
  const double w_v = scale * h.weight(kDv);
  s.du -= w_u * s.position;
  s.dv -= w_v * s.position;
  s.duu -= 2.0 * w_u * s.du + scale * h.weight(kDuu) * s.position;
  s.dvv -= 2.0 * w_v * s.dv + scale * h.weight(kDvv) * s.position;
  s.duv -= w_u * s.dv + w_v * s.du + scale * h.weight(kDuv) * s.position;
  return s;
}

} // namespace nurbs
} // namespace pcl
