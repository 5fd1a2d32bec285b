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
constexpr std::size_t kPerBucket = 256;
constexpr std::size_t kMostBuckets = 1U << 16U;
/** Groups of up to so many nodes have their x log x in a table. */
constexpr std::uint32_t kTabulated = 4096;

float
roundedUp(double key)
{
  return std::nextafter(static_cast<float>(key), std::numeric_limits<float>::max());
}

} // namespace

ForestGreedy::ForestGreedy(const WeightedGraph& graph,
                           std::vector<std::uint32_t> candidates,
                           std::size_t nodes)
    : graph_(graph),
      nodes_(nodes),
      groups_left_(nodes),
      walk_(graph),
      sets_(graph.nodes),
      groups_(graph.nodes),
      waiting_(std::move(candidates)),
      lists_(std::clamp(waiting_.size() / kPerBucket, std::size_t{1}, kMostBuckets))
{
  for (std::uint32_t size = 0; size < kTabulated; ++size)
    size_terms_.push_back(xLogX(size));
  rateWaiting();
}

double
ForestGreedy::firstGain() const
{
  double most = 0.0;
  for (const std::uint32_t edge : waiting_)
    most = std::max(most, walk_.gain(graph_.edges[edge]));
  return most;
}

void
ForestGreedy::run(std::size_t groups, double lambda)
{
  groups_wanted_ = groups;
  // The keys that are known remain right: all groups are single nodes still.
  scale_ = lambda * walk_.totalWeight() / static_cast<double>(nodes_);
  while (!waiting_.empty() && !done()) {
    distributeWaiting();
    for (std::size_t bucket = 0; bucket < lists_.size() && !done(); ++bucket)
      openBucket(bucket);
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
                    std::uint32_t root_a,
                    std::uint32_t root_b) const
{
  const std::uint32_t m = groups_[root_a].size;
  const std::uint32_t n = groups_[root_b].size;
  const double balance = sizeTerm(m) + sizeTerm(n) - sizeTerm(m + n) + sizeTerm(2);
  return walk_.scaledGain(edge) + scale_ * balance;
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
    const std::uint32_t a = sets_.find(edge.a);
    const std::uint32_t b = sets_.find(edge.b);
    if (a == b)
      continue;
    waiting_keys_.push_back(roundedUp(keyOf(edge, a, b)));
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
  return static_cast<std::size_t>(
      std::min(place, static_cast<double>(lists_.size())));
}

void
ForestGreedy::openBucket(std::size_t bucket)
{
  lists_.take(bucket, opened_);
  for (const std::uint32_t edge : opened_)
    consider(bucket, edge);
  while (!heap_.empty() && !done()) {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Candidate best = heap_.back();
    heap_.pop_back();
    const WeightedEdge& edge = graph_.edges[best.edge];
    const std::uint32_t a = sets_.find(edge.a);
    const std::uint32_t b = sets_.find(edge.b);
    if (std::max(groups_[a].changed, groups_[b].changed) > best.rated)
      consider(bucket, best.edge);
    else
      select(best.edge);
  }
}

/** Put an edge where its key belongs, in the order of this bucket or in a later one. */
void
ForestGreedy::consider(std::size_t bucket, std::uint32_t number)
{
  const WeightedEdge& edge = graph_.edges[number];
  const std::uint32_t a = sets_.find(edge.a);
  const std::uint32_t b = sets_.find(edge.b);
  if (a == b)
    return;
  const double key = keyOf(edge, a, b);
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
  const std::uint32_t a = sets_.find(edge.a);
  const std::uint32_t b = sets_.find(edge.b);
  const std::uint32_t size = groups_[a].size + groups_[b].size;
  walk_.add(edge);
  selected_.push_back(number);
  groups_[sets_.join(a, b)] = {size, static_cast<std::uint32_t>(selected_.size())};
  --groups_left_;
}

} // namespace nurbs
} // namespace pcl
