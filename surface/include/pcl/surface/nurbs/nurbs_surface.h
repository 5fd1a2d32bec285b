// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>
#include <pcl/surface/nurbs/nurbs_curve.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The two parametric directions of a surface. */
enum class Direction { U, V };

/** \brief Point and first partial derivatives of a surface at one parameter. */
struct SurfaceJet1 {
  Eigen::Vector3d position;
  Eigen::Vector3d du;
  Eigen::Vector3d dv;
};

/** \brief Point and partial derivatives up to the second order. */
struct SurfaceJet2 {
  Eigen::Vector3d position;
  Eigen::Vector3d du;
  Eigen::Vector3d dv;
  Eigen::Vector3d duu;
  Eigen::Vector3d duv;
  Eigen::Vector3d dvv;
};

/** \brief Partial derivatives of a surface up to a total order; (k, l) is
 * \f$\partial^{k+l} S / \partial u^k \partial v^l\f$. */
class SurfaceDerivatives {
public:
  explicit SurfaceDerivatives(int order)
      : order_(order), values_(static_cast<std::size_t>((order + 1) * (order + 1)))
  {
  }

  int
  order() const
  {
    return order_;
  }

  Eigen::Vector3d&
  operator()(int k, int l)
  {
    return values_[static_cast<std::size_t>(k * (order_ + 1) + l)];
  }

  const Eigen::Vector3d&
  operator()(int k, int l) const
  {
    return values_[static_cast<std::size_t>(k * (order_ + 1) + l)];
  }

private:
  int order_;
  std::vector<Eigen::Vector3d> values_;
};

/** \brief A rational tensor-product B-spline surface S(u, v) in space.
 *
 * Control points are held in homogeneous form (w P, w), one column each; the control
 * point (i, j) is column i * numControlPointsV() + j. All const members are safe to
 * call from several threads. Notation and algorithm numbers: Piegl & Tiller, The NURBS
 * Book, 2nd ed., chapter 4.
 * \ingroup surface */
class PCL_NURBS_SURFACE_EXPORT NurbsSurface {
public:
  using HomogeneousPoints = Eigen::Matrix<double, 4, Eigen::Dynamic>;

  /** \brief The unit square of the xy plane. */
  NurbsSurface();

  /** \brief Take over knots and homogeneous control points.
   * \throws std::invalid_argument if the counts do not match, a value is not finite or
   * a weight is not positive */
  NurbsSurface(KnotVector knots_u,
               KnotVector knots_v,
               HomogeneousPoints homogeneous_points);

  /** \brief Surface from Cartesian control points; no weights mean all are 1.
   * \param[in] knots_u knots of the first direction
   * \param[in] knots_v knots of the second direction
   * \param[in] points control points, column i * n_v + j holds (i, j), in metres
   * \param[in] weights as many weights as points, or none */
  static NurbsSurface
  fromControlPoints(KnotVector knots_u,
                    KnotVector knots_v,
                    const Eigen::Matrix3Xd& points,
                    const Eigen::VectorXd& weights = Eigen::VectorXd());

  const KnotVector&
  knotsU() const
  {
    return knots_u_;
  }

  const KnotVector&
  knotsV() const
  {
    return knots_v_;
  }

  const KnotVector&
  knots(Direction direction) const
  {
    return direction == Direction::U ? knots_u_ : knots_v_;
  }

  int
  numControlPointsU() const
  {
    return knots_u_.numControlPoints();
  }

  int
  numControlPointsV() const
  {
    return knots_v_.numControlPoints();
  }

  int
  numControlPoints() const
  {
    return static_cast<int>(points_.cols());
  }

  const HomogeneousPoints&
  homogeneousPoints() const
  {
    return points_;
  }

  Eigen::Vector3d
  controlPoint(int i, int j) const
  {
    const auto column = points_.col(i * numControlPointsV() + j);
    return column.head<3>() / column(3);
  }

  double
  weight(int i, int j) const
  {
    return points_(3, i * numControlPointsV() + j);
  }

  /** \brief Whether the weights are not all equal. */
  bool
  isRational() const
  {
    return rational_;
  }

  /** \brief Point at (u, v) (algorithm A4.3), in the unit of the control points.
   * Outside of the domain the border span is extrapolated. O(p q), no allocation. */
  Eigen::Vector3d
  evaluate(double u, double v) const;

  /** \brief Point and first derivatives at (u, v). O(p q), no allocation. */
  SurfaceJet1
  evaluateJet1(double u, double v) const;

  /** \brief Point, first and second derivatives at (u, v). O(p q), no allocation. */
  SurfaceJet2
  evaluateJet2(double u, double v) const;

  /** \brief All partial derivatives with k + l <= order (algorithm A4.4). */
  SurfaceDerivatives
  derivatives(double u, double v, int order) const;

  /** \brief Unit normal S_u x S_v / |S_u x S_v|. Where it vanishes (a pole) the limit
   * from the inside of the domain is taken; zero if there is none. */
  Eigen::Vector3d
  normal(double u, double v) const;

  /** \brief Curve of constant \a u or \a v: isoCurve(Direction::U, u) runs along v. */
  NurbsCurve3
  isoCurve(Direction fixed, double parameter) const;

  /** \brief The same surface under an affine map (exact). */
  NurbsSurface
  transformed(const Eigen::Affine3d& transform) const;

  /** \brief The same surface with u and v exchanged (the normal flips). */
  NurbsSurface
  transposed() const;

  /** \brief The same surface with one direction reversed (the normal flips). */
  NurbsSurface
  reversed(Direction direction) const;

private:
  KnotVector knots_u_;
  KnotVector knots_v_;
  HomogeneousPoints points_;
  bool rational_ = false;
};

} // namespace nurbs
} // namespace pcl
