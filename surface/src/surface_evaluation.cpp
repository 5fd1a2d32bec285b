// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Point and low derivatives of a surface, the inner loop of everything else: degrees 1
// to 3 in both directions run through code unrolled for that degree.

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "fixed_degree_basis.h"

namespace pcl {
namespace nurbs {
namespace {

/** Homogeneous point and partial derivatives, named like SurfaceJet2. */
struct HomogeneousJet {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Vector4d du = Eigen::Vector4d::Zero();
  Eigen::Vector4d dv = Eigen::Vector4d::Zero();
  Eigen::Vector4d duu = Eigen::Vector4d::Zero();
  Eigen::Vector4d duv = Eigen::Vector4d::Zero();
  Eigen::Vector4d dvv = Eigen::Vector4d::Zero();
};

/** Tensor-product sum with derivatives up to \a Order (0, 1 or 2) in each direction.
 * \param[in] points homogeneous control point of the first non-zero functions
 * \param[in] stride control points from one index i to the next
 * \param[in] p,q degrees; constants after inlining where the caller knows them */
template <int Order, typename Basis>
inline void
sumJet(const double* points,
       std::ptrdiff_t stride,
       int p,
       int q,
       const Basis& basis_u,
       const Basis& basis_v,
       HomogeneousJet& jet)
{
  for (int i = 0; i <= p; ++i, points += 4 * stride) {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    Eigen::Vector4d row_v = Eigen::Vector4d::Zero();
    Eigen::Vector4d row_vv = Eigen::Vector4d::Zero();
    for (int j = 0; j <= q; ++j) {
      const Eigen::Map<const Eigen::Vector4d> point(points + 4 * j);
      row += basis_v[0][j] * point;
      if constexpr (Order >= 1)
        row_v += basis_v[1][j] * point;
      if constexpr (Order >= 2)
        row_vv += basis_v[2][j] * point;
    }
    jet.value += basis_u[0][i] * row;
    if constexpr (Order >= 1) {
      jet.du += basis_u[1][i] * row;
      jet.dv += basis_u[0][i] * row_v;
    }
    if constexpr (Order >= 2) {
      jet.duu += basis_u[2][i] * row;
      jet.duv += basis_u[1][i] * row_v;
      jet.dvv += basis_u[0][i] * row_vv;
    }
  }
}

/** Where an evaluation reads its knots and control points. */
struct Spans {
  Spans(const NurbsSurface& surface, double u, double v)
      : span_u(surface.knotsU().findSpan(u)),
        span_v(surface.knotsV().findSpan(v)),
        stride(surface.numControlPointsV()),
        points(surface.homogeneousPoints().data() +
               4 * ((span_u - surface.knotsU().degree()) * stride + span_v -
                    surface.knotsV().degree()))
  {
  }

  int span_u;
  int span_v;
  std::ptrdiff_t stride;
  const double* points;
};

template <int Degree, int Order>
void
fixedDegreeJet(
    const NurbsSurface& surface, const Spans& at, double u, double v, HomogeneousJet& h)
{
  double basis_u[Order + 1][Degree + 1];
  double basis_v[Order + 1][Degree + 1];
  fixedDegreeBasis<Degree, Order>(
      surface.knotsU().values().data() + at.span_u, u, basis_u);
  fixedDegreeBasis<Degree, Order>(
      surface.knotsV().values().data() + at.span_v, v, basis_v);
  sumJet<Order>(at.points, at.stride, Degree, Degree, basis_u, basis_v, h);
}

template <int Order>
void
anyDegreeJet(
    const NurbsSurface& surface, const Spans& at, double u, double v, HomogeneousJet& h)
{
  const int p = surface.knotsU().degree();
  const int q = surface.knotsV().degree();
  double basis_u[Order + 1][kMaxDegree + 1];
  double basis_v[Order + 1][kMaxDegree + 1];
  anyDegreeBasis<Order>(p, surface.knotsU().values().data() + at.span_u, u, basis_u);
  anyDegreeBasis<Order>(q, surface.knotsV().values().data() + at.span_v, v, basis_v);
  sumJet<Order>(at.points, at.stride, p, q, basis_u, basis_v, h);
}

template <int Order>
HomogeneousJet
homogeneousJet(const NurbsSurface& surface, double u, double v)
{
  const Spans at(surface, u, v);
  HomogeneousJet h;
  const int p = surface.knotsU().degree();
  const int degree = p == surface.knotsV().degree() ? p : 0;
  if (degree == 3)
    fixedDegreeJet<3, Order>(surface, at, u, v, h);
  else if (degree == 2)
    fixedDegreeJet<2, Order>(surface, at, u, v, h);
  else if (degree == 1)
    fixedDegreeJet<1, Order>(surface, at, u, v, h);
  else
    anyDegreeJet<Order>(surface, at, u, v, h);
  return h;
}

} // namespace

Eigen::Vector3d
NurbsSurface::evaluate(double u, double v) const
{
  const HomogeneousJet h = homogeneousJet<0>(*this, u, v);
  return h.value.head<3>() / h.value(3);
}

SurfaceJet1
NurbsSurface::evaluateJet1(double u, double v) const
{
  const HomogeneousJet h = homogeneousJet<1>(*this, u, v);
  const double scale = 1.0 / h.value(3);
  SurfaceJet1 result;
  result.position = scale * h.value.head<3>();
  result.du = scale * (h.du.head<3>() - h.du(3) * result.position);
  result.dv = scale * (h.dv.head<3>() - h.dv(3) * result.position);
  return result;
}

SurfaceJet2
NurbsSurface::evaluateJet2(double u, double v) const
{
  const HomogeneousJet h = homogeneousJet<2>(*this, u, v);
  const double scale = 1.0 / h.value(3);
  SurfaceJet2 s;
  s.position = scale * h.value.head<3>();
  s.du = scale * h.du.head<3>();
  s.dv = scale * h.dv.head<3>();
  s.duu = scale * h.duu.head<3>();
  s.duv = scale * h.duv.head<3>();
  s.dvv = scale * h.dvv.head<3>();
  if (!rational_)
    return s;
  const double w_u = scale * h.du(3); // quotient rule, equation 4.20
  const double w_v = scale * h.dv(3);
  s.du -= w_u * s.position;
  s.dv -= w_v * s.position;
  s.duu -= 2.0 * w_u * s.du + scale * h.duu(3) * s.position;
  s.dvv -= 2.0 * w_v * s.dv + scale * h.dvv(3) * s.position;
  s.duv -= w_u * s.dv + w_v * s.du + scale * h.duv(3) * s.position;
  return s;
}

} // namespace nurbs
} // namespace pcl
