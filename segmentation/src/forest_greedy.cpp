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

/** How many edges ahead nodes are sent for, and the sizes of their groups. */
constexpr std::size_t kFar = 20;
constexpr std::size_t kSoon = 10;

SelfLoop
loopOf(double weight)
{
  return {weight, xLogX(weight)};
}

} // namespace

ForestGreedy::ForestGreedy(const EdgeView& edges, const std::vector<bool>& member)
    : edges_(edges),
      nodes_(edges.nodes()),
      sizes_(edges.nodes(), 1),
      queue_(edges.size())
{
  for (const bool taken : member)
    members_ += taken ? 1 : 0;
  groups_left_ = members_;
  selected_.reserve(members_);
  unit_ = startLoops();
  // A step from a node to itself loses at most the entropy of a coin.
  queue_.setRange(0.0, 2.0 * std::log(2.0) * unit_);
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
    nodes_[edge.a].loop += edge.weight;
    nodes_[edge.b].loop += edge.weight;
  }
  double heaviest = 0.0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].group = nodes_[i].next = i;
    total_weight_ += nodes_[i].loop;
    heaviest = std::max(heaviest, nodes_[i].loop);
  }
  return heaviest;
}

void
ForestGreedy::enqueueAll(const std::vector<bool>& member)
{
  std::vector<QueuedEdge> edges;
  for (std::uint32_t number = 0; number < edges_.size(); ++number) {
    const WeightedEdge edge = edges_[number];
    if (edge.weight > 0.0F && member[edge.a])
      edges.push_back({number, edge.b, edge.weight});
    if (edges.size() == EdgeBatch::kMost || number + 1 == edges_.size()) {
      enqueueFirst(edges);
      edges.clear();
    }
  }
}

/** Enqueue edges between single nodes, whose balance is 0. */
void
ForestGreedy::enqueueFirst(const std::vector<QueuedEdge>& edges)
{
  gather(edges, 0);
  batch_.boundGains();
  for (std::size_t k = 0; k < batch_.count; ++k) {
    const QueuedEdge& edge = edges[batch_.place[k]];
    const double bound = boundOf(k);
    if (bound > first_gain_)
      first_gain_ = std::max(first_gain_, gainOf(edge));
    queue_.push(edge, bound);
  }
}

void
ForestGreedy::run(std::size_t groups, double lambda)
{
  groups_wanted_ = groups;
  // The bounds that are known remain right: all groups are single nodes still.
  balance_.setScale(lambda * total_weight_ / static_cast<double>(members_));
  openBuckets();
  for (std::vector<QueuedEdge> waiting = queue_.takeWaiting();
       !waiting.empty() && !done();
       waiting = queue_.takeWaiting()) {
    enqueueAgain(waiting);
    openBuckets();
  }
  queue_ = KeyBuckets(0);
}

void
ForestGreedy::openBuckets()
{
  for (std::size_t bucket = 0; bucket < queue_.size() && !done(); ++bucket)
    openBucket(bucket);
}

/** Spread edges over buckets from their highest key to their lowest. */
void
ForestGreedy::enqueueAgain(std::vector<QueuedEdge>& edges)
{
  std::vector<double> bounds;
  bounds.reserve(edges.size());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t first = 0; first < edges.size();) {
    first = gather(edges, first);
    batch_.boundGains();
    for (std::size_t k = 0; k < batch_.count; ++k) {
      edges[bounds.size()] = edges[batch_.place[k]];
      bounds.push_back(boundOf(k));
      low = std::min(low, bounds.back());
      high = std::max(high, bounds.back());
    }
  }
  queue_.setRange(low, high);
  for (std::size_t k = 0; k < bounds.size(); ++k)
    queue_.push(edges[k], bounds[k]);
}

void
ForestGreedy::openBucket(std::size_t bucket)
{
  queue_.take(bucket, opened_);
  rated_.resize(opened_.size());
  orderOpened(bucket);
  while (!done() && !order_.empty())
    consider(bucket, order_.take());
}

/** Bound the keys of the opened edges together, and order those that may belong here by
 * their exact ones. */
void
ForestGreedy::orderOpened(std::size_t bucket)
{
  for (std::size_t first = 0; first < opened_.size();) {
    first = gather(opened_, first);
    batch_.boundGains();
    for (std::size_t k = 0; k < batch_.count; ++k) {
      const std::uint32_t place = batch_.place[k];
      const QueuedEdge& edge = opened_[place];
      if (queue_.postpone(bucket, edge, boundOf(k)))
        continue;
      const double gain = gainOf(edge);
      const double key = gain + batch_.balance[k];
      if (queue_.postpone(bucket, edge, key))
        continue;
      rated_[place] = {batch_.nodes[k],
                       nodes_[edges_.source(edge.number)].loop,
                       nodes_[edge.target].loop,
                       gain};
      order_.add({key, edge.number, place});
    }
  }
  order_.sort();
}

/** Select an opened edge if no other can be before it, or put it back where its exact
 * key belongs. A key changes only when one of its groups grows. */
void
ForestGreedy::consider(std::size_t bucket, const Candidate& candidate)
{
  const std::uint32_t place = candidate.place();
  const QueuedEdge& edge = opened_[place];
  const std::uint32_t a = groupOf(edges_.source(edge.number));
  const std::uint32_t b = groupOf(edge.target);
  if (a == b)
    return;
  const std::uint32_t nodes = sizes_[a] + sizes_[b];
  Rating& rating = rated_[place];
  if (rating.nodes == nodes)
    return select(edge, rating.gain);
  const double loop_a = nodes_[edges_.source(edge.number)].loop;
  const double loop_b = nodes_[edge.target].loop;
  if (rating.loop_a != loop_a || rating.loop_b != loop_b)
    rating = {nodes, loop_a, loop_b, gainOf(edge)};
  rating.nodes = nodes;
  const double key = rating.gain + balance_(sizes_[a], sizes_[b]);
  if (queue_.postpone(bucket, edge, key))
    return;
  const Candidate again(key, edge.number, place);
  if (order_.isBest(again))
    return select(edge, rating.gain);
  order_.putBack(again);
}

/** Fill the batch with those of the next edges that still join two groups.
 * \param[in] first where to begin
 * \return where to go on */
std::size_t
ForestGreedy::gather(const std::vector<QueuedEdge>& edges, std::size_t first)
{
  const std::size_t last = std::min(edges.size(), first + EdgeBatch::kMost);
  const double per_unit = 1.0 / unit_;
  batch_.count = 0;
  for (std::size_t k = first; k < last; ++k) {
    prefetch(edges, k);
    const Node& a = nodes_[edges_.source(edges[k].number)];
    const Node& b = nodes_[edges[k].target];
    if (a.group == b.group)
      continue;
    const std::uint32_t size_a = sizes_[a.group];
    const std::uint32_t size_b = sizes_[b.group];
    const std::size_t place = batch_.count++;
    batch_.place[place] = static_cast<std::uint32_t>(k);
    batch_.weight[place] = static_cast<float>(per_unit * edges[k].weight);
    batch_.loop_a[place] = static_cast<float>(per_unit * a.loop);
    batch_.loop_b[place] = static_cast<float>(per_unit * b.loop);
    batch_.nodes[place] = size_a + size_b;
    batch_.balance[place] = balance_(size_a, size_b);
  }
  return last;
}

/** Have the nodes of edges that follow sent to the cache, then the sizes of their
 * groups: edges in order of their keys are anywhere. */
inline void
ForestGreedy::prefetch(const std::vector<QueuedEdge>& edges, std::size_t k) const
{
  if (k + kFar < edges.size()) {
    const QueuedEdge& edge = edges[k + kFar];
    __builtin_prefetch(&nodes_[edges_.source(edge.number)]);
    __builtin_prefetch(&nodes_[edge.target]);
  }
  if (k + kSoon < edges.size()) {
    const QueuedEdge& edge = edges[k + kSoon];
    __builtin_prefetch(&sizes_[groupOf(edges_.source(edge.number))]);
    __builtin_prefetch(&sizes_[groupOf(edge.target)]);
  }
}

/** Hardly more than the key of an edge of the batch, and no less. */
inline double
ForestGreedy::boundOf(std::size_t k) const
{
  return unit_ * static_cast<double>(batch_.gain[k]) + batch_.balance[k];
}

double
ForestGreedy::gainOf(const QueuedEdge& edge) const
{
  return scaledEdgeGain(loopOf(nodes_[edges_.source(edge.number)].loop),
                        loopOf(nodes_[edge.target].loop),
                        edge.weight);
}

void
ForestGreedy::select(const QueuedEdge& edge, double gain)
{
  Node& end_a = nodes_[edges_.source(edge.number)];
  Node& end_b = nodes_[edge.target];
  const std::uint32_t a = end_a.group;
  const std::uint32_t b = end_b.group;
  const double weight = edge.weight;
  end_a.loop = std::max(end_a.loop - weight, 0.0); // rounding may leave less than 0
  end_b.loop = std::max(end_b.loop - weight, 0.0);
  scaled_rate_ += gain;
  selected_.push_back(edge.number);
  --groups_left_;
  if (sizes_[a] < sizes_[b])
    join(b, a);
  else
    join(a, b);
}

/** Rename the smaller of two groups: a node gets no more than log2 n names. Direct
 * names spare every look at an edge two walks up a tree. */
void
ForestGreedy::join(std::uint32_t large, std::uint32_t small)
{
  sizes_[large] += sizes_[small];
  std::uint32_t node = small;
  do {
    nodes_[node].group = large;
    node = nodes_[node].next;
  } while (node != small);
  std::swap(nodes_[large].next, nodes_[small].next); // two rings become one
}

} // namespace nurbs
} // namespace pcl
