// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>
#include <pcl/segmentation/grid_points.h>
#include <pcl/segmentation/sensor_noise.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Largest number of terms of a ViewPolynomial. */
constexpr int kMostViewTerms = 10;

/** \brief A point as the polynomials of a ViewChart see it. */
struct ViewSample {
  Eigen::Vector3d direction;                /**< e */
  std::array<double, kMostViewTerms> basis; /**< all terms at e */
  double value;                             /**< what they model */
  double weight;                            /**< 1 / variance of the value */
};

/** \brief A surface as a polynomial of the viewing direction; see ViewChart. */
struct PCL_NURBS_SEGMENTATION_EXPORT ViewPolynomial {
  int terms = 0; /**< how many coefficients are in use; the others are zero */
  std::array<double, kMostViewTerms> coefficients{};

  double
  operator()(const std::array<double, kMostViewTerms>& basis) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < basis.size(); ++k)
      sum += coefficients[k] * basis[k];
    return sum;
  }
};

/** \brief Common domain in which all surfaces of a cloud are functions: viewing
 * direction -> inverse depth.
 *
 * Over the viewing direction a plane is exactly linear in the inverse depth, and what
 * the sensor's noise makes of the inverse depth is nearly constant over a surface. A
 * camera has e = (x/z, y/z, 1) and 1/z with the terms of 1, 2 or 3 degrees (3, 6 or
 * 10), a laser the unit ray e and 1/r with the 3 linear and 6 quadratic terms of e. A
 * height field has its own plane and the height, scaled and shifted so that both are of
 * order one; a mere lattice is taken for a height field over its frame.
 *
 * As the domain is one for all, sums over different sets of points add.
 * \ingroup segmentation
 */
class PCL_NURBS_SEGMENTATION_EXPORT ViewChart {
public:
  /** \brief The domain of a cloud; keeps a reference to it.
   *
   * The noise is that of the sensor and a small share of what the depth changes by
   * from a point to the next: directions err as well, which tells on surfaces at
   * grazing angle; and at least a small share of the point spacing, for what lies
   * between samples is unknown anyway. O(cells).
   * \param[in] threads number of threads; the result does not depend on it
   * \throws std::invalid_argument when the graph belongs to other points */
  ViewChart(const GridPoints& points,
            const SensorNoise& noise,
            const GridGraph& graph,
            int threads = 1);

  /** \brief Multiply the noise.
   * \throws std::invalid_argument unless the factor is positive */
  void
  scaleNoise(double factor);

  /** \brief Measure by how much of a cell directions err, along rows and along columns,
   * instead of the small share that is assumed: points of steep surfaces leave the line
   * of their neighbours by it. O(cells).
   * \throws std::invalid_argument when the graph belongs to other points */
  void
  measureDirections(const GridGraph& graph, int threads = 1);

  /** \brief A valid cell's point. O(1). */
  ViewSample
  sample(std::size_t cell) const;

  /** \brief All terms at a direction. */
  std::array<double, kMostViewTerms>
  basis(const Eigen::Vector3d& direction) const;

  /** \brief Direction e of a valid cell. */
  Eigen::Vector3d
  direction(std::size_t cell) const;

  /** \brief Standard deviation of a valid cell's value. */
  double
  sigma(std::size_t cell) const
  {
    return noise_scale_ * static_cast<double>(sigmas_[cell]);
  }

  /** \brief Deviation of each cell's depth that errors of its direction cause. */
  const std::vector<float>&
  directionNoise() const
  {
    return direction_noise_;
  }

  /** \brief Point, in the grid's frame, of a surface at a direction of any length. */
  Eigen::Vector3d
  position(const ViewPolynomial& surface, const Eigen::Vector3d& direction) const;

  /** \brief Unit normal, in the grid's frame, of a surface at a direction; in an
   * angular grid away from the sensor, else along the depth. */
  Eigen::Vector3d
  normal(const ViewPolynomial& surface, const Eigen::Vector3d& direction) const;

  /** \brief Numbers of terms to choose from, increasing; the first is a plane. */
  const std::vector<int>&
  termChoices() const
  {
    return choices_;
  }

private:
  /** Place a height field's domain over its points. */
  void
  centre();

  /** Direction of a point of a height field. */
  Eigen::Vector3d
  inPlane(const Eigen::Vector3d& local) const;

  /** Find the deviations again. */
  void
  updateSigmas(int threads);

  double
  unscaledSigma(std::size_t cell) const;

  const GridPoints& points_;
  SensorNoise noise_;
  double noise_scale_ = 1.0;
  bool angular_;
  bool spherical_;
  Eigen::Matrix3d frame_;
  double spacing_; // of neighbours, constant part
  double spacing_per_depth_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(); // of a height field
  double scale_ = 1.0;
  std::vector<int> choices_;
  std::array<std::vector<float>, 2> slopes_; // of the depth along rows and columns
  std::vector<float> direction_noise_;       // of the depth, per cell
  std::vector<float> sigmas_; // of the value, per cell, without noise_scale_
};

/** \brief Sums over points from which the best polynomials follow: normal equations.
 * They add.
 * \ingroup segmentation */
class PCL_NURBS_SEGMENTATION_EXPORT ViewSums {
public:
  void
  add(const ViewSample& sample);

  ViewSums&
  operator+=(const ViewSums& other);

  /** \brief Number of points. */
  double
  count() const
  {
    return sums_[kCount];
  }

  /** \brief Least-squares polynomial with the first \a terms terms. Undetermined
   * coefficients are small, not wild. O(terms^3). */
  ViewPolynomial
  fit(int terms) const;

  /** \brief Sum of squared residuals in units of the noise. O(terms^2). */
  double
  misfit(const ViewPolynomial& surface) const;

  /** \brief Weighted mean direction; shorter than 1 for a laser. O(1). */
  Eigen::Vector3d
  meanDirection() const;

  /** \brief Element of the normal matrix; column <= row. */
  double
  normal(std::size_t row, std::size_t column) const
  {
    return sums_[row * (row + 1) / 2 + column];
  }

  /** \brief Element of the right side. */
  double
  right(std::size_t row) const
  {
    return sums_[kRight + row];
  }

  /** \brief Sum of squares of the values in units of the noise. */
  double
  squares() const
  {
    return sums_[kSquares];
  }

private:
  // Lower triangle of the normal matrix by rows, then right side, values, weight,
  // count.
  static constexpr std::size_t kTriangle = kMostViewTerms * (kMostViewTerms + 1) / 2;
  static constexpr std::size_t kRight = kTriangle;
  static constexpr std::size_t kSquares = kRight + kMostViewTerms;
  static constexpr std::size_t kDirection = kSquares + 1;
  static constexpr std::size_t kWeight = kDirection + 3;
  static constexpr std::size_t kCount = kWeight + 1;

  std::array<double, kCount + 1> sums_{};
};

/** \brief Fits of one set of points with different numbers of terms: what the smaller
 * ones cost is not spent again. Refers to the sums.
 * \ingroup segmentation */
class PCL_NURBS_SEGMENTATION_EXPORT ViewFit {
public:
  explicit ViewFit(const ViewSums& sums);

  /** \brief Sum of squared residuals of the best polynomial. O(terms^3) at first. */
  double
  misfit(int terms);

  /** \brief The best polynomial. O(terms^2) after misfit(). */
  ViewPolynomial
  solve(int terms);

private:
  using Row = std::array<double, kMostViewTerms>;

  /** Extend the Cholesky factor of the normal matrix. */
  void
  extend(std::size_t terms);

  const ViewSums& sums_;
  std::size_t done_ = 0;
  std::array<Row, kMostViewTerms> factor_; // below the diagonal
  Row inverse_;                            // of the diagonal
  Row reduced_;                            // right side
  std::array<double, kMostViewTerms + 1> misfit_;
};

} // namespace nurbs
} // namespace pcl
