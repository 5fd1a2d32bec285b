// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>
#include <pcl/segmentation/view_polynomial.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What a merge of two groups must lower. chi2 is the misfit in units of the
 * noise divided by the points per independent sample, n the number of such samples and
 * k the number of coefficients; summed over groups. */
enum class GroupingCriterion {
  AIC,  /**< chi2 + 2 k (Akaike 1974, known noise) */
  AICc, /**< AIC with the small-sample term 2 k (k + 1) / (n - k - 1) */
  BIC,  /**< chi2 + k ln n (Schwarz 1978) */
  /** Twice the length, in nats, of what a map has to store: coefficients, patches and
   * borders, and what the surfaces leave of the points. */
  DescriptionLength
};

/** \brief Options of groupSurfaces(). */
struct SurfaceGroupingOptions {
  GroupingCriterion criterion = GroupingCriterion::DescriptionLength;
  /** Neighbouring readings err alike: so many count as one. 0 to measure it in the
   * cloud: 1 for independent noise, 10 to 100 for the pixels of a depth camera. */
  double points_per_sample = 0.0;
  /** Storage of a coefficient, a patch and a border pixel (nats); DescriptionLength
   * alone looks at them. */
  double coefficient_cost = 3.0;
  double patch_cost = 30.0;
  double border_cost = 0.25;
  /** A group whose points are on average farther from a common model than so many
   * standard deviations is not merged, whatever the criterion says: small things would
   * drown in large ones. */
  double fit_sigmas = 2.0;
  /** How far from a group's model a single point may be. */
  double point_sigmas = 4.0;
  /** Edges with a smaller weight are removed. */
  float min_weight = 1e-4F;
  /** A depth jump leaves the line of its neighbours by so many standard deviations. */
  float jump_sigmas = 3.0F;
  /** Groups whose models meet at a smaller angle (radians) are one smooth surface. */
  double crease_angle = 0.4;
  /** Whether such groups are joined. */
  bool join_smooth = true;
  /** Whether parts of one surface that an occluder or a hole separates are joined; not
   * where most rays between them went through that surface. */
  bool join_separated = true;
  /** Smaller groups are dropped (points). */
  std::size_t min_size = 100;
  /** Number of threads; the result does not depend on it. */
  int threads = 1;
};

/** \brief One group of groupSurfaces(). segmentBorders() tells which of them touch. */
struct SurfaceGroup {
  std::size_t size = 0;               /**< points */
  std::vector<ViewPolynomial> models; /**< of its parts, the largest first */
  double rms = 0.0;                   /**< residual in units of the noise */
};

/** \brief Group the points of a grid into surfaces: Algorithm 1 of Norouzzadeh Ravari
 * and Taghirad, "NURBS-based Representation of Urban Environments for Mobile Robots",
 * with group models that merge in constant time.
 *
 * (1) Edges of low weight or over a depth jump are removed. (2) Coarse to fine: blocks
 * of cells that are one smooth piece are nodes of a graph; neighbours merge, best gain
 * per point first, while the criterion falls. Blocks of the next finer rate join the
 * group to which a random walker goes most likely (largest P_ij), if they fit its
 * model, or form groups of their own. (3) Groups that meet without a step or fold are
 * one surface, and so are parts that an occluder separates and one model explains. (4)
 * Single points join the group beside them that explains them, and borders are moved to
 * where the models of both sides intersect.
 *
 * O(cells + nodes log nodes), the same result for any number of threads.
 *
 * \param[in] points organized points
 * \param[in] graph their graph, with weights
 * \param[in] noise depth noise of the sensor
 * \param[in] options see there
 * \param[out] labels per cell: 0 = none, 1.. by decreasing size of the group
 * \param[out] groups the groups by label - 1, if wanted
 * \return number of groups
 * \throws std::invalid_argument when the graph belongs to other points or an option is
 * out of range
 * \ingroup segmentation
 */
PCL_NURBS_SEGMENTATION_EXPORT std::uint32_t
groupSurfaces(const GridPoints& points,
              const GridGraph& graph,
              const SensorNoise& noise,
              const SurfaceGroupingOptions& options,
              std::vector<std::uint32_t>& labels,
              std::vector<SurfaceGroup>* groups = nullptr);

} // namespace nurbs
} // namespace pcl
