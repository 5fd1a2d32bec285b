// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/random_walk.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Options of entropyRateSuperpixels(). */
struct SuperpixelOptions {
  /** Number of groups K. */
  std::size_t number = 1000;
  /** Weight lambda' of equal sizes against homogeneous groups. */
  double balance = 0.5;
  /** Connected parts of the graph with fewer nodes are left out: they could be nothing
   * but small groups, and would use up the number of groups. */
  std::size_t min_part = 1;
};

/** \brief Result of entropyRateSuperpixels(). */
struct Superpixels {
  std::vector<std::uint32_t> labels; /**< per node: 0 = none, 1.. by decreasing size */
  std::uint32_t count = 0;
  std::vector<std::uint32_t> edges; /**< selected edges A in the order of selection */
  double entropy_rate = 0.0;        /**< H(A) */
  double balance = 0.0;             /**< B(A) */
  double lambda = 0.0;              /**< factor of B that the options lead to */

  double
  objective() const
  {
    return entropy_rate + lambda * balance;
  }
};

/** \brief Superpixels by entropy rate: greedy maximisation of H(A) + lambda B(A) over
 * edge sets A without cycles until K groups are left (Liu, Tuzel, Ramalingam,
 * Chellappa, "Entropy Rate Superpixel Segmentation", CVPR 2011).
 *
 * H is the entropy rate of the walk along A (EdgeSubsetWalk), B the entropy of the
 * distribution of group sizes minus the number of groups, and lambda = lambda' K beta
 * with beta the ratio of the largest gains of H and B by a first edge. Both terms are
 * monotone and submodular, so that gains only ever fall: an edge is looked at again
 * when the gain it had last comes up, and never after its ends are in one group. The
 * selection is that of the greedy algorithm that looks at every edge every time; of
 * equal gains the edge that comes first is taken.
 *
 * Edges without weight join nothing. A graph of more than K connected parts ends with a
 * group for each of them. O(edges log edges) time and about 14 bytes per edge and 36
 * per node, input included. Runs in one thread.
 * \param[in] graph weighted graph
 * \param[in] options number of groups and balance
 * \throws std::invalid_argument when the graph is not valid (requireValidGraph()), the
 * number of groups is 0, the balance is negative, infinite or not a number, or there
 * are 2^32 edges or nodes
 * \ingroup segmentation */
PCL_NURBS_SEGMENTATION_EXPORT Superpixels
entropyRateSuperpixels(const WeightedGraph& graph, const SuperpixelOptions& options);

/** \brief Superpixels of the points of a grid, as entropyRateSuperpixels() of
 * toWeightedGraph (graph, min_weight) without its empty cells.
 * \param[in] points organized points
 * \param[in] graph their graph, with weights
 * \param[in] min_weight edges with a smaller weight are removed
 * \param[in] options number of groups and balance
 * \return labels are per cell, 0 for empty ones; an edge's number is that of its first
 *         cell times the number of directions, plus the direction
 * \throws std::invalid_argument also when the graph belongs to other points
 */
PCL_NURBS_SEGMENTATION_EXPORT Superpixels
gridSuperpixels(const GridPoints& points,
                const GridGraph& graph,
                float min_weight,
                const SuperpixelOptions& options);

} // namespace nurbs
} // namespace pcl
