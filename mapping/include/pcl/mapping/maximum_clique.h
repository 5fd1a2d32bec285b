// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>

#include <boost/dynamic_bitset.hpp>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Neighbours of each vertex of an undirected graph: bit j of entry i.
 * Symmetric, no vertex is its own neighbour.
 * \ingroup mapping */
using NeighbourSets = std::vector<boost::dynamic_bitset<>>;

/** \brief A largest set of vertices that are all neighbours of each other. */
struct MaximumClique {
  std::vector<std::size_t> vertices; /**< rising */
  /** None is larger; false if the search ended before that was known. */
  bool proven = false;
};

/** \brief Find a maximum clique by branch and bound: vertices are coloured greedily,
 * the number of colours bounds what a branch can reach (Tomita and Seki, An efficient
 * branch-and-bound algorithm for finding a maximum clique, 2003), and a greedy clique
 * by degree comes first. The same for the same input.
 * \param[in] neighbours the graph
 * \param[in] max_steps branches looked at before the best clique found so far is
 * returned; exponentially many may be needed to prove a clique the largest
 * \throws std::invalid_argument if the sets are not n bits each, not symmetric, or a
 * vertex is its own neighbour */
PCL_NURBS_MAPPING_EXPORT MaximumClique
maximumClique(const NeighbourSets& neighbours, std::size_t max_steps = 100000);

} // namespace nurbs
} // namespace pcl
