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

/** Buckets for so many edges. */
std::size_t
numBuckets(std::size_t edges)
{
  return std::clamp(edges / kPerBucket, std::size_t{1}, kMostBuckets);
}

} // namespace

ForestGreedy::ForestGreedy(const EdgeView& edges, const std::vector<bool>& member)
    : edges_(edges),
      nodes_(edges.nodes()),
      lists_(numBuckets(edges.size()), edges.size())
{
  for (std::uint32_t size = 0; size < kTabulated; ++size)
    size_terms_.push_back(xLogX(size));
  for (const bool taken : member)
    members_ += taken ? 1 : 0;
  groups_left_ = members_;
  selected_.reserve(members_);
  // A step from a node to itself loses at most the entropy of a coin.
  setRange(0.0, 2.0 * std::log(2.0) * startLoops());
  enqueueAll(member);
}

/** Let the walk stay where it is.
 * \return largest weight of a node */
double
ForestGreedy::startLoops()
{
  for (std::size_t number = 0; number < edges_.size(); ++number) {
    const WeightedEdge edge = edges_[number];
    if (!(edge.weight > 0.0F))
      continue;
    nodes_[edge.a].loop.weight += edge.weight;
    nodes_[edge.b].loop.weight += edge.weight;
  }
  double heaviest = 0.0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    SelfLoop& loop = nodes_[i].loop;
    loop.term = xLogX(loop.weight);
    nodes_[i].group = nodes_[i].next = i;
    total_weight_ += loop.weight;
    heaviest = std::max(heaviest, loop.weight);
  }
  return heaviest;
}

void
ForestGreedy::enqueueAll(const std::vector<bool>& member)
{
  for (std::uint32_t number = 0; number < edges_.size(); ++number) {
    const WeightedEdge edge = edges_[number];
    if (!(edge.weight > 0.0F) || !member[edge.a])
      continue;
    const double bound = gainBound(edge); // the balance of single nodes is 0
    if (bound > first_gain_)
      first_gain_ = std::max(first_gain_, gainOf(edge));
    enqueue(number, bound);
  }
}

void
ForestGreedy::run(std::size_t groups, double lambda)
{
  groups_wanted_ = groups;
  // The bounds that are known remain right: all groups are single nodes still.
  scale_ = lambda * total_weight_ / static_cast<double>(members_);
  openBuckets();
  while (!waiting_.empty() && !done()) {
    enqueueWaiting();
    openBuckets();
  }
  lists_ = BucketLists(0, 0);
}

void
ForestGreedy::openBuckets()
{
  for (std::size_t bucket = 0; bucket < lists_.size() && !done(); ++bucket)
    openBucket(bucket);
}

inline double
ForestGreedy::sizeTerm(std::uint32_t size) const
{
  return size < kTabulated ? size_terms_[size] : xLogX(size);
}

inline double
ForestGreedy::balanceOf(const Node& group_a, const Node& group_b) const
{
  return scale_ * (sizeTerm(group_a.size) + sizeTerm(group_b.size) -
                   sizeTerm(group_a.size + group_b.size) + sizeTerm(2));
}

double
ForestGreedy::gainOf(const WeightedEdge& edge) const
{
  return scaledEdgeGain(nodes_[edge.a].loop, nodes_[edge.b].loop, edge.weight);
}

/** Hardly more than gainOf(), and no less. */
inline double
ForestGreedy::gainBound(const WeightedEdge& edge) const
{
  const SelfLoop& a = nodes_[edge.a].loop;
  const SelfLoop& b = nodes_[edge.b].loop;
  const double w = edge.weight;
  const FastXLogX& f = fast_x_log_x_;
  return a.term - f(a.weight - w) + b.term - f(b.weight - w) - 2.0 * f(w) +
         FastXLogX::kError * (a.weight + b.weight);
}

/** Spread the waiting edges over buckets from their highest key to their lowest. */
void
ForestGreedy::enqueueWaiting()
{
  std::vector<std::uint32_t> again;
  again.swap(waiting_);
  std::vector<double> keys; // and a little more
  keys.reserve(again.size());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::uint32_t number : again) {
    const WeightedEdge edge = edges_[number];
    const std::uint32_t a = groupOf(edge.a);
    const std::uint32_t b = groupOf(edge.b);
    if (a == b)
      continue;
    keys.push_back(gainBound(edge) + balanceOf(nodes_[a], nodes_[b]));
    low = std::min(low, keys.back());
    high = std::max(high, keys.back());
    again[keys.size() - 1] = number;
  }
  setRange(low, high);
  for (std::size_t k = 0; k < keys.size(); ++k)
    enqueue(again[k], keys[k]);
}

void
ForestGreedy::setRange(double low, double high)
{
  highest_ = high;
  buckets_per_key_ =
      high > low ? static_cast<double>(lists_.size()) / (high - low) : 0.0;
}

/** Put an edge in the list of its bucket; what is in range has one. */
void
ForestGreedy::enqueue(std::uint32_t edge, double key)
{
  lists_.push(std::min(bucketOf(key), lists_.size() - 1), edge);
}

/** Number of a bucket, or beyond the last where the key is below all buckets. */
inline std::size_t
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
    const WeightedEdge edge = edges_[best.edge];
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
  const std::size_t count = opened_.size();
  for (std::size_t k = 0; k < count + kFar; ++k) {
    if (k < count)
      for (const void* place : edges_.places(opened_[k]))
        __builtin_prefetch(place);
    if (k >= kFar - kNear && k - (kFar - kNear) < count) {
      const WeightedEdge edge = edges_[opened_[k - (kFar - kNear)]];
      __builtin_prefetch(&nodes_[edge.a]);
      __builtin_prefetch(&nodes_[edge.b]);
    }
    if (k >= kFar - kSoon && k - (kFar - kSoon) < count) {
      const WeightedEdge edge = edges_[opened_[k - (kFar - kSoon)]];
      __builtin_prefetch(&nodes_[groupOf(edge.a)]);
      __builtin_prefetch(&nodes_[groupOf(edge.b)]);
    }
    if (k >= kFar)
      consider(bucket, opened_[k - kFar]);
  }
}

/** Let an edge wait for a later bucket than the open one, if its key belongs there. */
inline bool
ForestGreedy::postpone(std::size_t bucket, std::uint32_t edge, double key)
{
  const std::size_t place = bucketOf(key);
  if (place <= bucket)
    return false;
  if (place < lists_.size())
    lists_.push(place, edge);
  else
    waiting_.push_back(edge);
  return true;
}

/** Put an edge where its key belongs, in the order of this bucket or in a later one. */
void
ForestGreedy::consider(std::size_t bucket, std::uint32_t number)
{
  const WeightedEdge edge = edges_[number];
  const std::uint32_t a = groupOf(edge.a);
  const std::uint32_t b = groupOf(edge.b);
  if (a == b)
    return;
  const double balance = balanceOf(nodes_[a], nodes_[b]);
  if (postpone(bucket, number, gainBound(edge) + balance))
    return;
  const double key = gainOf(edge) + balance;
  if (postpone(bucket, number, key))
    return;
  heap_.push_back({key, number, static_cast<std::uint32_t>(selected_.size())});
  std::push_heap(heap_.begin(), heap_.end(), Later());
}

void
ForestGreedy::select(std::uint32_t number)
{
  const WeightedEdge edge = edges_[number];
  const std::uint32_t a = groupOf(edge.a);
  const std::uint32_t b = groupOf(edge.b);
  SelfLoop& loop_a = nodes_[edge.a].loop;
  SelfLoop& loop_b = nodes_[edge.b].loop;
  const double before = loop_a.term + loop_b.term;
  loop_a.shorten(edge.weight);
  loop_b.shorten(edge.weight);
  scaled_rate_ += before - loop_a.term - loop_b.term - 2.0 * xLogX(edge.weight);
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
