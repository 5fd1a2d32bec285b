// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "bucket_lists.h"
#include "edge_view.h"
#include "fast_x_log_x.h"

#include <pcl/segmentation/random_walk.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Greedy selection of entropyRateSuperpixels(). An edge's key is its gain times the
 * total weight, less what a first edge gains in balance:
 *
 * key = 2W gain(H) + scale [f(m) + f(n) - f(m + n) + f(2)],  f(x) = x log x,
 *
 * for groups of m and n nodes of M. Keys only fall, so the queue is a monotone one:
 * edges wait in buckets of their last known keys, and only the bucket whose turn it is
 * has exact keys and an order. Where an edge waits it needs no more than an upper bound
 * of its key, which FastXLogX gives. */
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
  /** All that is known of a node, in half a cache line. */
  struct alignas(32) Node {
    SelfLoop loop;
    std::uint32_t group = 0;   // the node that names its group and keeps its
    std::uint32_t size = 1;    // size and the
    std::uint32_t changed = 0; // number of edges selected when it last grew
    std::uint32_t next = 0;    // in the ring of the group's nodes
  };

  struct Candidate {
    double key;
    std::uint32_t edge;
    std::uint32_t rated; // number of edges selected when the key was found
  };

  /** Whether a is taken after b. */
  struct Later {
    bool
    operator()(const Candidate& a, const Candidate& b) const
    {
      return a.key != b.key ? a.key < b.key : a.edge > b.edge;
    }
  };

  double
  balanceOf(const Node& group_a, const Node& group_b) const;

  double
  gainOf(const WeightedEdge& edge) const;

  double
  gainBound(const WeightedEdge& edge) const;

  double
  sizeTerm(std::uint32_t size) const;

  double
  startLoops();

  void
  enqueueAll(const std::vector<bool>& member);

  void
  setRange(double low, double high);

  void
  enqueue(std::uint32_t edge, double key);

  bool
  postpone(std::size_t bucket, std::uint32_t edge, double key);

  void
  enqueueWaiting();

  std::size_t
  bucketOf(double key) const;

  void
  openBucket(std::size_t bucket);

  void
  considerOpened(std::size_t bucket);

  void
  consider(std::size_t bucket, std::uint32_t edge);

  void
  select(std::uint32_t edge);

  void
  join(std::uint32_t large, std::uint32_t small);

  void
  openBuckets();

  bool
  done() const
  {
    return groups_left_ <= groups_wanted_;
  }

  EdgeView edges_;
  FastXLogX fast_x_log_x_;
  std::size_t members_ = 0;
  std::size_t groups_left_ = 0;
  std::size_t groups_wanted_ = 1;
  std::vector<Node> nodes_;
  double total_weight_ = 0.0;
  double scaled_rate_ = 0.0;
  double first_gain_ = 0.0;
  std::vector<double> size_terms_;
  double scale_ = 0.0;
  std::vector<std::uint32_t> waiting_; // edges whose keys are below all buckets
  double highest_ = 0.0;
  double buckets_per_key_ = 0.0;
  BucketLists lists_;
  std::vector<std::uint32_t> opened_;
  std::vector<Candidate> heap_;
  std::vector<std::uint32_t> selected_;
};

} // namespace nurbs
} // namespace pcl
