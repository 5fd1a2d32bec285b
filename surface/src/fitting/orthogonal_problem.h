// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "ceres_cells.h"
#include "fairness.h"

#include <pcl/surface/nurbs/fit_options.h>
#include <pcl/surface/nurbs/height_field_frame.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How unknowns make a surface, and how a surface point moves with them. */
class SurfaceUnknowns {
public:
  virtual ~SurfaceUnknowns() = default;

  /** \brief Unknowns per control point. */
  virtual int
  channels() const = 0;

  /** \brief Whether the points hardly determine some directions of the unknowns, so
   * that the condition of the problem must not be squared. */
  virtual bool
  illConditioned() const
  {
    return false;
  }

  /** \brief Surface of channels() x (control points) unknowns.
   * \throws std::invalid_argument or std::domain_error if there is none */
  virtual NurbsSurface
  surface(const Eigen::MatrixXd& unknowns) const = 0;

  /** \brief Factors m_a: the surface point moves along \a direction by the sum over
   * control points i and channels a of m_a B_i dx_{i,a}.
   * \param[in] surface present surface
   * \param[in] uv parameters of the surface point
   * \param[in] foot surface point
   * \param[in] direction unit vector
   * \param[out] factors channels() values */
  virtual void
  sensitivity(const NurbsSurface& surface,
              const Eigen::Vector2d& uv,
              const Eigen::Vector3d& foot,
              const Eigen::Vector3d& direction,
              double* factors) const = 0;
};

/** \brief One height per control point of a projective frame. */
class HeightUnknowns : public SurfaceUnknowns {
public:
  HeightUnknowns(const HeightFieldFrame& frame, KnotVector knots_u, KnotVector knots_v);

  int
  channels() const override
  {
    return 1;
  }

  NurbsSurface
  surface(const Eigen::MatrixXd& unknowns) const override;

  void
  sensitivity(const NurbsSurface& surface,
              const Eigen::Vector2d& uv,
              const Eigen::Vector3d& foot,
              const Eigen::Vector3d& direction,
              double* factors) const override;

private:
  HeightFieldFrame frame_;
  KnotVector knots_u_;
  KnotVector knots_v_;
};

/** \brief Homogeneous control points: (w x, w y, w z) with fixed weights, or w as well.
 */
class HomogeneousUnknowns : public SurfaceUnknowns {
public:
  /** \param[in] start knots and weights
   * \param[in] weights_too whether weights are unknown */
  HomogeneousUnknowns(const NurbsSurface& start, bool weights_too);

  int
  channels() const override
  {
    return weights_too_ ? 4 : 3;
  }

  bool
  illConditioned() const override
  {
    return weights_too_;
  }

  NurbsSurface
  surface(const Eigen::MatrixXd& unknowns) const override;

  void
  sensitivity(const NurbsSurface& surface,
              const Eigen::Vector2d& uv,
              const Eigen::Vector3d& foot,
              const Eigen::Vector3d& direction,
              double* factors) const override;

private:
  NurbsSurface start_;
  bool weights_too_;
};

/** \brief Robust orthogonal distances as costs of knot cells. Foot points are
 * eliminated (variable projection): they are found anew wherever Ceres looks, so only
 * the unknowns of the surface are left.
 *
 * A point inside gives one row, along the normal. With several unknowns per control
 * point the surface could also slide along itself, which no normal sees: two tangential
 * rows with a small weight and no residual damp that without moving the minimum. Their
 * weight falls with the distances (as the Levenberg-Marquardt parameter of Yamashita
 * and Fukushima 2001 does), so that exact points are found at a fast rate although many
 * surfaces solve the problem. There
 * the foot may also leave the domain, where the surface is extrapolated, so that the
 * problem stays smooth at the border; extendedDomain() then takes these feet in.
 *
 * Fairness is that of the way from the start: with free sliding the energy of the
 * surface itself would pull even exact surfaces off their points. */
class OrthogonalProblem : public CellLinearizer {
public:
  /** \param[in] unknowns meaning of the unknowns
   * \param[in] start surface with the knots of the problem
   * \param[in] positions points, metres
   * \param[in] parameters starts of their foot points
   * \param[in] sigma standard deviation of each, metres
   * \param[in] options loss, fairness and threads */
  OrthogonalProblem(const SurfaceUnknowns& unknowns,
                    const NurbsSurface& start,
                    const Eigen::Matrix3Xd& positions,
                    const Eigen::Matrix2Xd& parameters,
                    const Eigen::VectorXd& sigma,
                    const SurfaceFitOptions& options);

  void
  linearize(const Eigen::MatrixXd& unknowns,
            bool derivatives,
            std::vector<TriangularCell>& cells) override;

  /** \brief Weight of sliding relative to the distances left over the extent of the
   * points; 1 at first. Less is faster where it does not overshoot. */
  void
  setDamping(double damping)
  {
    damping_ = damping;
  }

  /** \brief Cost of points that all are \a distance times their extent away. */
  double
  costOf(double distance) const;

  /** \brief Foot points at the last unknowns whose derivatives were asked for. */
  const Eigen::Matrix2Xd&
  parameters() const
  {
    return parameters_;
  }

private:
  struct PointTerms;

  int
  rowsPerPoint() const
  {
    return unknowns_.channels() == 1 ? 1 : 3;
  }

  void
  evaluatePoints(const NurbsSurface& surface,
                 Eigen::Matrix2Xd& parameters,
                 PointTerms& terms) const;

  void
  dampSliding(PointTerms& terms) const;

  PointRows
  momentRows(const CellPoints& points, const PointTerms& terms, int channels) const;

  void
  reduce(const Eigen::MatrixXd& unknowns,
         const Eigen::Matrix2Xd& parameters,
         const PointTerms& terms,
         bool derivatives,
         std::vector<TriangularCell>& cells) const;

  const SurfaceUnknowns& unknowns_;
  KnotVector knots_u_;
  KnotVector knots_v_;
  const Eigen::Matrix3Xd& positions_;
  Eigen::Matrix2Xd parameters_;
  const Eigen::VectorXd& sigma_;
  const SurfaceFitOptions& options_;
  double damping_ = 1.0;
  double information_ =
      0.0;                // of all points on the unknowns, what fairness is relative to
  Eigen::MatrixXd start_; // unknowns of the first evaluation
  double extent_;         // diagonal of the points' box, metres
};

/** \brief The same surface over a domain that holds all parameters: the border spans
 * are extrapolated, inner knots stay.
 * \throws std::domain_error if a weight would not be positive there */
NurbsSurface
extendedDomain(const NurbsSurface& surface, const Eigen::Matrix2Xd& parameters);

} // namespace nurbs
} // namespace pcl
