// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/exports.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Highest polynomial degree of a curve, and of a surface in each direction.
 * Fixed so that evaluation needs no allocation. */
constexpr int kMaxDegree = 9;

/** \brief Values of the degree + 1 basis functions that are not zero at a parameter. */
using BasisValues = std::array<double, kMaxDegree + 1>;

/** \brief Row k holds the k-th derivatives of the basis functions that are not zero. */
using BasisDerivatives = std::array<BasisValues, kMaxDegree + 1>;

/** \brief A polynomial degree together with a non-decreasing sequence of knots.
 *
 * With degree p and m + 1 knots there are n + 1 = m - p basis functions; they are a
 * partition of unity on the domain [u_p, u_{n+1}]. End knots may be clamped (p + 1
 * equal knots), unclamped or periodic (knot spacing that repeats with the domain
 * length); nothing below assumes clamped ends unless it says so.
 *
 * Immutable after construction, so sharing between threads is safe.
 * Notation and algorithm numbers: Piegl & Tiller, The NURBS Book, 2nd ed., chapter 2.
 * \ingroup surface
 */
class PCL_NURBS_SURFACE_EXPORT KnotVector {
public:
  /** \brief Degree 1 with the knots {0, 0, 1, 1}. */
  KnotVector();

  /** \brief Take over a degree and its knots.
   * \param[in] degree polynomial degree p, 1 <= p <= kMaxDegree
   * \param[in] knots at least 2 (p + 1) finite values, non-decreasing; interior
   *            multiplicity at most p + 1 (p + 1 allows a jump), domain not empty
   * \throws std::invalid_argument naming the condition that does not hold
   */
  KnotVector(int degree, std::vector<double> knots);

  /** \brief Clamped knots without interior knots: a single polynomial span. */
  static KnotVector
  bezier(int degree, double first = 0.0, double last = 1.0);

  /** \brief Clamped knots with \a spans spans of equal length on [first, last]. */
  static KnotVector
  clampedUniform(int degree, int spans, double first = 0.0, double last = 1.0);

  /** \brief Clamped knots with simple interior knots at the inner \a breaks.
   * \param[in] degree polynomial degree
   * \param[in] breaks at least two strictly increasing values; first and last are the
   *            ends of the domain
   */
  static KnotVector
  clamped(int degree, const std::vector<double>& breaks);

  /** \brief Uniform unclamped knots on [first, last] whose spacing continues past both
   * ends: with the first \a degree control points repeated at the end, the curve closes
   * with degree - 1 continuous derivatives.
   * \param[in] degree polynomial degree
   * \param[in] spans number of spans, at least 1
   * \param[in] first start of the domain
   * \param[in] last end of the domain
   */
  static KnotVector
  periodicUniform(int degree, int spans, double first = 0.0, double last = 1.0);

  int
  degree() const
  {
    return degree_;
  }

  /** \brief Number of control points that go with these knots. */
  int
  numControlPoints() const
  {
    return static_cast<int>(knots_.size()) - degree_ - 1;
  }

  /** \brief Number of knots. */
  int
  size() const
  {
    return static_cast<int>(knots_.size());
  }

  double
  operator[](int i) const
  {
    return knots_[static_cast<std::size_t>(i)];
  }

  const std::vector<double>&
  values() const
  {
    return knots_;
  }

  double
  domainMin() const
  {
    return knots_[static_cast<std::size_t>(degree_)];
  }

  double
  domainMax() const
  {
    return knots_[static_cast<std::size_t>(numControlPoints())];
  }

  double
  domainLength() const
  {
    return domainMax() - domainMin();
  }

  /** \brief The parameter of the domain that is nearest to \a u. */
  double
  clampToDomain(double u) const;

  /** \brief Index i of the span [u_i, u_{i+1}) that holds \a u; the last non-empty span
   * at the end of the domain (algorithm A2.1). Parameters outside of the domain get its
   * first or last span. O(log n). */
  int
  findSpan(double u) const;

  /** \brief Basis functions that are not zero in \a span (algorithm A2.2).
   * \param[in] span index from findSpan()
   * \param[in] u parameter
   * \param[out] values values[r] is N_{span - p + r, p}(u), r = 0..p
   */
  void
  evaluateBasis(int span, double u, BasisValues& values) const;

  /** \brief Derivatives 0..order of the basis functions that are not zero in \a span
   * (algorithm A2.3). Rows above the degree are zero.
   * \param[in] span index from findSpan()
   * \param[in] u parameter
   * \param[in] order highest derivative, 0 <= order <= kMaxDegree
   * \param[out] derivatives derivatives[k][r] is the k-th derivative of N_{span-p+r,p}
   */
  void
  evaluateBasisDerivatives(int span,
                           double u,
                           int order,
                           BasisDerivatives& derivatives) const;

  /** \brief How many knots are equal to \a u up to \a tolerance. */
  int
  multiplicity(double u, double tolerance = 0.0) const;

  /** \brief Distinct knots inside of the domain, its ends included, increasing. */
  std::vector<double>
  breaks() const;

  /** \brief Mean of the p knots that belong to control point \a i (Greville abscissa):
   * control values equal to them reproduce the parameter itself. */
  double
  greville(int i) const;

  /** \brief Whether both ends have p + 1 equal knots. */
  bool
  isClamped() const;

  /** \brief Whether knot spacing repeats with the length of the domain, so that a
   * closed curve can be smooth over its ends. */
  bool
  isPeriodic(double relative_tolerance = 1e-12) const;

  /** \brief Knots of the reversed direction, domain unchanged. */
  KnotVector
  reversed() const;

  /** \brief Knots mapped affinely so that the domain becomes [first, last]. */
  KnotVector
  rescaled(double first, double last) const;

  bool
  operator==(const KnotVector& other) const
  {
    return degree_ == other.degree_ && knots_ == other.knots_;
  }

  bool
  operator!=(const KnotVector& other) const
  {
    return !(*this == other);
  }

private:
  int degree_;
  std::vector<double> knots_;
};

} // namespace nurbs
} // namespace pcl
