// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "candidate_order.h"
#include "edge_batch.h"
#include "edge_view.h"
#include "group_balance.h"
#include "key_buckets.h"

#include <pcl/segmentation/random_walk.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Greedy selection of entropyRateSuperpixels(). An edge's key is its gain times the
 * total weight, less what a first edge gains in balance:
 *
 * key = 2W gain(H) + GroupBalance(m, n)
 *
 * for groups of m and n nodes. Keys only fall, so the queue is a monotone one:
 * edges wait in buckets of their last known keys, and only the bucket whose turn it is
 * has exact keys and an order. Where an edge waits it needs no more than an upper bound
 * of its key, which EdgeBatch gives. */
class ForestGreedy {
public:
  /** \param[in] edges valid graph
   * \param[in] member nodes that take part, all of a connected part or none */
  ForestGreedy(const EdgeView& edges, const std::vector<bool>& member);

  std::size_t
  numMembers() const
  {
    return members_;
  }

  /** Largest gain in entropy rate of a first edge. */
  double
  firstGain() const
  {
    return first_gain_ > 0.0 ? first_gain_ / total_weight_ : 0.0;
  }

  /** Select edges until so many groups are left.
   * \param[in] groups number of groups
   * \param[in] lambda factor of the balance term */
  void
  run(std::size_t groups, double lambda);

  /** Selected edges in their order. */
  const std::vector<std::uint32_t>&
  selected() const
  {
    return selected_;
  }

  double
  entropyRate() const
  {
    return selected_.empty() ? 0.0 : scaled_rate_ / total_weight_;
  }

  /** The node that names the group of a node. O(1). */
  std::uint32_t
  groupOf(std::uint32_t node) const
  {
    return nodes_[node].group;
  }

private:
  /** What looks at edges need of their ends. */
  struct Node {
    double loop = 0.0;       // weight of the step to itself
    std::uint32_t group = 0; // the node that names its group
    std::uint32_t next = 0;  // in the ring of the group's nodes
  };

  /** An exact gain, and what it and the balance were found from. */
  struct Rating {
    std::uint32_t nodes; // of both groups
    double loop_a;
    double loop_b;
    double gain;
  };

  double
  startLoops();

  void
  enqueueAll(const std::vector<bool>& member);

  void
  enqueueFirst(const std::vector<QueuedEdge>& edges);

  void
  enqueueAgain(std::vector<QueuedEdge>& edges);

  void
  openBuckets();

  void
  openBucket(std::size_t bucket);

  void
  orderOpened(std::size_t bucket);

  void
  consider(std::size_t bucket, const Candidate& candidate);

  std::size_t
  gather(const std::vector<QueuedEdge>& edges, std::size_t first);

  void
  prefetch(const std::vector<QueuedEdge>& edges, std::size_t k) const;

  double
  boundOf(std::size_t k) const;

  double
  gainOf(const QueuedEdge& edge) const;

  void
  select(const QueuedEdge& edge, double gain);

  void
  join(std::uint32_t large, std::uint32_t small);

  bool
  done() const
  {
    return groups_left_ <= groups_wanted_;
  }

  EdgeView edges_;
  std::size_t members_ = 0;
  std::size_t groups_left_ = 0;
  std::size_t groups_wanted_ = 1;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> sizes_; // of groups, at the nodes that name them
  double unit_ = 1.0;                // largest weight of a loop at first
  double total_weight_ = 0.0;
  double scaled_rate_ = 0.0;
  double first_gain_ = 0.0;
  GroupBalance balance_;
  KeyBuckets queue_;
  EdgeBatch batch_{};
  std::vector<QueuedEdge> opened_; // edges of the open bucket, and for each
  std::vector<Rating> rated_;      // its last exact rating
  CandidateOrder order_;
  std::vector<std::uint32_t> selected_;
};

} // namespace nurbs
} // namespace pcl
