// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "forest_greedy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Edges per bucket: their nodes and the heap over them fit the cache. */
constexpr std::size_t kPerBucket = 128;
constexpr std::size_t kMostBuckets = 1U << 16U;
/** Groups of up to so many nodes have their x log x in a table. */
constexpr std::uint32_t kTabulated = 4096;

/** How many edges ahead something is sent for. */
constexpr std::size_t kFar = 24;
constexpr std::size_t kNear = 16;
constexpr std::size_t kSoon = 8;

float
roundedUp(double key)
{
  return std::nextafter(static_cast<float>(key), std::numeric_limits<float>::max());
}

} // namespace

ForestGreedy::ForestGreedy(const WeightedGraph& graph,
                           std::vector<std::uint32_t> candidates,
                           std::size_t members)
    : graph_(graph),
      members_(members),
      groups_left_(members),
      nodes_(graph.nodes),
      waiting_(std::move(candidates)),
      lists_(std::clamp(waiting_.size() / kPerBucket, std::size_t{1}, kMostBuckets))
{
  for (std::uint32_t size = 0; size < kTabulated; ++size)
    size_terms_.push_back(xLogX(size));
  const std::vector<double> weights = nodeWeights(graph);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].loop = {weights[i], xLogX(weights[i])};
    nodes_[i].group = nodes_[i].next = i;
    total_weight_ += weights[i];
  }
  if (waiting_.empty())
    total_weight_ = 1.0; // there is nothing to gain, and no entropy
  rateWaiting();
}

void
ForestGreedy::run(std::size_t groups, double lambda)
{
  groups_wanted_ = groups;
  // The keys that are known remain right: all groups are single nodes still.
  scale_ = lambda * total_weight_ / static_cast<double>(members_);
  while (!waiting_.empty() && !done()) {
    distributeWaiting();
    for (std::size_t bucket = 0; bucket < lists_.size() && !done(); ++bucket)
      openBucket(bucket);
    if (!done())
      rateWaiting();
  }
}

double
ForestGreedy::sizeTerm(std::uint32_t size) const
{
  return size < kTabulated ? size_terms_[size] : xLogX(size);
}

double
ForestGreedy::keyOf(const WeightedEdge& edge,
                    const Node& group_a,
                    const Node& group_b) const
{
  const double balance = sizeTerm(group_a.size) + sizeTerm(group_b.size) -
                         sizeTerm(group_a.size + group_b.size) + sizeTerm(2);
  return scaledEdgeGain(nodes_[edge.a].loop, nodes_[edge.b].loop, edge.weight) +
         scale_ * balance;
}

/** Find the keys of all waiting edges and drop those inside of a group. */
void
ForestGreedy::rateWaiting()
{
  waiting_keys_.clear();
  waiting_keys_.reserve(waiting_.size());
  std::size_t kept = 0;
  for (const std::uint32_t number : waiting_) {
    const WeightedEdge& edge = graph_.edges[number];
    const std::uint32_t a = groupOf(edge.a);
    const std::uint32_t b = groupOf(edge.b);
    if (a == b)
      continue;
    const double key = keyOf(edge, nodes_[a], nodes_[b]);
    first_gain_ = std::max(first_gain_, key);
    waiting_keys_.push_back(roundedUp(key));
    waiting_[kept++] = number;
  }
  waiting_.resize(kept);
}

/** Spread the waiting edges over buckets from their highest key to their lowest. */
void
ForestGreedy::distributeWaiting()
{
  const auto [low, high] =
      std::minmax_element(waiting_keys_.begin(), waiting_keys_.end());
  highest_ = *high;
  const double range = static_cast<double>(*high) - *low;
  // A little more than the range, so that the lowest key has its bucket.
  buckets_per_key_ =
      range > 0.0 ? static_cast<double>(lists_.size()) / (range * (1.0 + 1e-9)) : 0.0;
  for (std::size_t k = 0; k < waiting_.size(); ++k)
    lists_.push(std::min(bucketOf(waiting_keys_[k]), lists_.size() - 1), waiting_[k]);
  waiting_.clear();
}

/** Number of a bucket, or beyond the last where the key is below all buckets. */
std::size_t
ForestGreedy::bucketOf(double key) const
{
  const double place = (highest_ - key) * buckets_per_key_;
  if (!(place > 0.0))
    return 0;
  return static_cast<std::size_t>(std::min(place, static_cast<double>(lists_.size())));
}

void
ForestGreedy::openBucket(std::size_t bucket)
{
  lists_.take(bucket, opened_);
  considerOpened(bucket);
  while (!heap_.empty() && !done()) {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Candidate best = heap_.back();
    heap_.pop_back();
    const WeightedEdge& edge = graph_.edges[best.edge];
    const std::uint32_t a = groupOf(edge.a);
    const std::uint32_t b = groupOf(edge.b);
    if (std::max(nodes_[a].changed, nodes_[b].changed) > best.rated)
      consider(bucket, best.edge);
    else
      select(best.edge);
  }
}

/** Consider the edges of a bucket while what is needed of those that follow is on its
 * way to the cache: the edge, then its nodes, then the nodes that name their groups.
 * (In a function of their own, compilers take prefetches for nothing.) */
void
ForestGreedy::considerOpened(std::size_t bucket)
{
  const WeightedEdge* edges = graph_.edges.data();
  const std::size_t count = opened_.size();
  for (std::size_t k = 0; k < count + kFar; ++k) {
    if (k < count)
      __builtin_prefetch(&edges[opened_[k]]);
    if (k >= kFar - kNear && k - (kFar - kNear) < count) {
      const WeightedEdge& edge = edges[opened_[k - (kFar - kNear)]];
      __builtin_prefetch(&nodes_[edge.a]);
      __builtin_prefetch(&nodes_[edge.b]);
    }
    if (k >= kFar - kSoon && k - (kFar - kSoon) < count) {
      const WeightedEdge& edge = edges[opened_[k - (kFar - kSoon)]];
      __builtin_prefetch(&nodes_[groupOf(edge.a)]);
      __builtin_prefetch(&nodes_[groupOf(edge.b)]);
    }
    if (k >= kFar)
      consider(bucket, opened_[k - kFar]);
  }
}

/** Put an edge where its key belongs, in the order of this bucket or in a later one. */
void
ForestGreedy::consider(std::size_t bucket, std::uint32_t number)
{
  const WeightedEdge& edge = graph_.edges[number];
  const std::uint32_t a = groupOf(edge.a);
  const std::uint32_t b = groupOf(edge.b);
  if (a == b)
    return;
  const double key = keyOf(edge, nodes_[a], nodes_[b]);
  const std::size_t place = bucketOf(key);
  if (place >= lists_.size())
    waiting_.push_back(number);
  else if (place > bucket)
    lists_.push(place, number);
  else {
    heap_.push_back({key, number, static_cast<std::uint32_t>(selected_.size())});
    std::push_heap(heap_.begin(), heap_.end(), Later());
  }
}

void
ForestGreedy::select(std::uint32_t number)
{
  const WeightedEdge& edge = graph_.edges[number];
  const std::uint32_t a = groupOf(edge.a);
  const std::uint32_t b = groupOf(edge.b);
  SelfLoop& loop_a = nodes_[edge.a].loop;
  SelfLoop& loop_b = nodes_[edge.b].loop;
  scaled_rate_ += scaledEdgeGain(loop_a, loop_b, edge.weight);
  loop_a.shorten(edge.weight);
  loop_b.shorten(edge.weight);
  selected_.push_back(number);
  --groups_left_;
  if (nodes_[a].size < nodes_[b].size)
    join(b, a);
  else
    join(a, b);
}

/** Rename the smaller of two groups: a node gets no more than log2 n names. Direct
 * names spare every look at an edge two walks up a tree. */
void
ForestGreedy::join(std::uint32_t large, std::uint32_t small)
{
  nodes_[large].size += nodes_[small].size;
  nodes_[large].changed = static_cast<std::uint32_t>(selected_.size());
  std::uint32_t node = small;
  do {
    nodes_[node].group = large;
    node = nodes_[node].next;
  } while (node != small);
  std::swap(nodes_[large].next, nodes_[small].next); // two rings become one
}

} // namespace nurbs
} // namespace pcl
