// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Edge of an undirected graph: W_ab = W_ba = weight. */
struct WeightedEdge {
  std::uint32_t a;
  std::uint32_t b;
  float weight;
};

/** \brief Weighted undirected graph on the nodes 0..nodes-1, at most one edge per pair
 * of nodes. Weights are finite and not negative. A plain value.
 * \ingroup segmentation
 */
struct WeightedGraph {
  std::size_t nodes = 0;
  std::vector<WeightedEdge> edges;
};

/** \brief Check the weights of a lattice. O(cells).
 * \throws std::invalid_argument when one is negative, infinite or not a number
 */
PCL_NURBS_SEGMENTATION_EXPORT void
requireValidWeights(const GridGraph& graph);

/** \brief The edges of a lattice as a list, cell by cell; the nodes are its cells.
 * O(cells).
 * \param[in] graph lattice with weights
 * \param[in] min_weight edges with a smaller weight are left out, and so are those
 *            without any
 * \throws std::invalid_argument when weights are not valid (requireValidWeights())
 */
PCL_NURBS_SEGMENTATION_EXPORT WeightedGraph
toWeightedGraph(const GridGraph& graph, float min_weight = 0.0F);

/** \brief Check a graph; so do all functions below. O(edges).
 * \throws std::invalid_argument when an edge ends outside of the graph or where it
 *         begins, or a weight is negative, infinite or not a number
 */
PCL_NURBS_SEGMENTATION_EXPORT void
requireValidGraph(const WeightedGraph& graph);

/** \brief W_i = sum_j W_ij for each node. O(nodes + edges), as all functions below.
 */
PCL_NURBS_SEGMENTATION_EXPORT std::vector<double>
nodeWeights(const WeightedGraph& graph);

/** \brief Probabilities of the two steps along an edge. */
struct StepProbabilities {
  double forward;  /**< P_ab = W_ab / W_a */
  double backward; /**< P_ba = W_ab / W_b */
};

/** \brief Transition probabilities of the random walk, P_ij = W_ij / W_i, per edge; 0
 * along edges of no weight. */
PCL_NURBS_SEGMENTATION_EXPORT std::vector<StepProbabilities>
stepProbabilities(const WeightedGraph& graph);

/** \brief Stationary distribution of the random walk, mu_i = W_i / sum_k W_k; zero
 * everywhere in a graph without weight. */
PCL_NURBS_SEGMENTATION_EXPORT std::vector<double>
stationaryDistribution(const WeightedGraph& graph);

/** \brief Entropy rate of the random walk, in nats per step:
 *
 * H = - sum_i mu_i sum_j P_ij log P_ij
 *
 * (Norouzzadeh Ravari and Taghirad, eq. 7; Cover and Thomas, "Elements of Information
 * Theory", section 4.3); 0 in a graph without weight. */
PCL_NURBS_SEGMENTATION_EXPORT double
entropyRate(const WeightedGraph& graph);

/** \brief Two convex functions of the weights whose difference g - h is the entropy
 * rate. */
struct ConvexPair {
  double g; /**< sum_i mu_i log mu_i */
  double
      h; /**< sum_ij (W_ij / 2W) log (W_ij / 2W) over ordered pairs, 2W = sum_k W_k */
};

/** \brief The entropy rate as a difference of convex functions of the normalised
 * weights (Norouzzadeh Ravari and Taghirad, eq. 8 and 9). */
PCL_NURBS_SEGMENTATION_EXPORT ConvexPair
convexPair(const WeightedGraph& graph);

/** \brief Entropy rate of the walk along some of the edges only: mu is that of the
 * whole graph, and what the other edges would have carried stays where it is, as a step
 * from a node to itself (Liu, Tuzel, Ramalingam, Chellappa, "Entropy Rate Superpixel
 * Segmentation", CVPR 2011).
 * \param[in] graph whole graph
 * \param[in] selected one flag per edge
 * \throws std::invalid_argument also when there is not one flag per edge
 */
PCL_NURBS_SEGMENTATION_EXPORT double
entropyRate(const WeightedGraph& graph, const std::vector<bool>& selected);

/** \brief x log x, continued to zero. */
inline double
xLogX(double x)
{
  return x > 0.0 ? x * std::log(x) : 0.0;
}

/** \brief Step of a walk from a node to itself. */
struct SelfLoop {
  double weight = 0.0; /**< s */
  double term = 0.0;   /**< s log s */

  /** \brief By how much \a term falls when an edge takes over a part of the weight. */
  double
  loss(double part) const
  {
    return term - xLogX(weight - part);
  }

  /** \brief Let an edge take over a part of the weight. */
  void
  shorten(double part)
  {
    weight = weight > part ? weight - part : 0.0; // rounding may leave less than 0
    term = xLogX(weight);
  }
};

/** \brief Gain in entropy rate by an edge between nodes with such loops, times the
 * total weight: f(s_a) - f(s_a - w) + f(s_b) - f(s_b - w) - 2 f(w), f(x) = x log x. */
inline double
scaledEdgeGain(const SelfLoop& a, const SelfLoop& b, double weight)
{
  return a.loss(weight) + b.loss(weight) - 2.0 * xLogX(weight);
}

/** \brief The walk of entropyRate(graph, selected) while edges are added one by one.
 *
 * With s_i the weight of the step from node i to itself, 2W = sum_k W_k and
 * f(x) = x log x, H = 1/2W sum_i [f(W_i) - f(s_i) - sum_j f(W_ij)], so that the gain of
 * an edge is closed: scaledEdgeGain() / 2W. It is never negative, and it falls as s_a
 * and s_b do: H is monotone and submodular. 16 bytes per node.
 * \ingroup segmentation
 */
class PCL_NURBS_SEGMENTATION_EXPORT EdgeSubsetWalk {
public:
  /** \brief Start without edges: the walk stays where it is, H = 0. O(nodes + edges).
   */
  explicit EdgeSubsetWalk(const WeightedGraph& graph);

  /** \brief By how much the entropy rate would rise with an edge of the graph that is
   * not selected; 0 for one without weight. O(1). */
  double
  gain(const WeightedEdge& edge) const;

  /** \brief Select an edge of the graph that is not yet selected. O(1). */
  void
  add(const WeightedEdge& edge);

  /** \brief Entropy rate of what is selected. */
  double
  entropyRate() const
  {
    return rate_;
  }

private:
  std::vector<SelfLoop> loops_;
  double total_ = 0.0;
  double rate_ = 0.0;
};

} // namespace nurbs
} // namespace pcl
