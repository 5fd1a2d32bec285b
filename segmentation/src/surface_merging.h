// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "disjoint_sets.h"
#include "surface_criterion.h"
#include "surface_nodes.h"

#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

namespace pcl {
namespace nurbs {

/** Groups of nodes that merge; a group is named by its root, its smallest node. */
class SurfaceMerging {
public:
  struct Group {
    ViewSums sums;
    CostedModel model;
    std::uint32_t changes = 0; /**< how often it has merged */
    std::vector<std::uint32_t> links;
  };

  /** \param[in] threads number of threads; the result does not depend on it */
  explicit SurfaceMerging(const SurfaceCriterion& criterion, int threads = 1)
      : criterion_(criterion), threads_(threads)
  {
  }

  /** Add the nodes from those known on, each a group of its own, and their links. */
  void
  add(const SurfaceNodes& nodes, const std::vector<NodeLink>& links);

  /** Let single nodes from \a first on join the group to which a random walker steps
   * most likely, if they fit its model; most likely steps first. */
  void
  joinLikeliest(std::uint32_t first);

  /** Merge neighbours while that lowers the criterion, best saving per point first. */
  void
  mergeWhileBetter();

  /** One step of mergeWhileBetter().
   * \return false when no merge pays */
  bool
  mergeOnce();

  std::uint32_t
  find(std::uint32_t node)
  {
    return sets_.find(node);
  }

  /** \param[in] root of the group */
  const Group&
  group(std::uint32_t root) const
  {
    return groups_[root];
  }

  /** Criterion over all groups, up to what the borders to no group cost (nats). O(nodes
   * + links); for tests of what merges do to it. */
  double
  totalCost();

private:
  struct Link {
    std::uint32_t a;
    std::uint32_t b;
    double border;
    double weight;
    double points = 0.0;       // of both groups when it was looked at last, 0: never
    std::uint32_t changes = 0; // the same
    bool queued = false;
    bool alive = true;
  };

  struct Candidate {
    double priority;
    std::uint32_t link;
    std::uint32_t node; // that joins, when nodes join

    bool
    operator<(const Candidate& other) const
    {
      return priority != other.priority ? priority < other.priority : link > other.link;
    }
  };

  std::uint32_t
  changesOf(const Link& link) const
  {
    return groups_[link.a].changes + groups_[link.b].changes;
  }

  double
  transition(std::uint32_t node, const Link& link) const;

  std::optional<CostedModel>
  evaluate(std::uint32_t link, double& priority);

  void
  push(std::uint32_t link);

  void
  queue(std::uint32_t link, double priority);

  void
  pushChanged();

  void
  pushGrown(std::uint32_t root);

  void
  merge(std::uint32_t link);

  std::uint32_t
  unite(std::uint32_t link);

  void
  combineLinks(std::uint32_t from, std::uint32_t into);

  const SurfaceCriterion& criterion_;
  int threads_;
  DisjointSets sets_;
  std::vector<Group> groups_;
  std::vector<Link> links_;
  std::priority_queue<Candidate> queue_;
  std::vector<std::uint32_t> link_to_; // scratch: link of the present group to each
};

} // namespace nurbs
} // namespace pcl
