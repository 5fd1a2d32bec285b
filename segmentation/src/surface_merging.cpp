// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_merging.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::uint32_t kNoLink = 0xFFFFFFFFU;

} // namespace

void
SurfaceMerging::add(const SurfaceNodes& nodes, const std::vector<NodeLink>& links)
{
  const auto first = static_cast<std::uint32_t>(groups_.size());
  sets_.grow(nodes.count());
  groups_.resize(nodes.count());
  link_to_.resize(nodes.count(), kNoLink);
#pragma omp parallel for num_threads(threads_)
  for (std::uint32_t node = first; node < nodes.count(); ++node) {
    groups_[node].sums = nodes.sums(node);
    groups_[node].model = criterion_.best(nodes.sums(node));
  }
  // Nodes that merged before may share a neighbour: one link for each pair of groups.
  std::vector<NodeLink> between = links;
  for (NodeLink& link : between) {
    link.a = sets_.find(link.a);
    link.b = sets_.find(link.b);
    if (link.a > link.b)
      std::swap(link.a, link.b);
  }
  std::stable_sort(
      between.begin(), between.end(), [](const NodeLink& p, const NodeLink& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
      });
  for (std::size_t k = 0; k < between.size(); ++k) {
    const NodeLink& link = between[k];
    if (k > 0 && between[k - 1].a == link.a && between[k - 1].b == link.b) {
      links_.back().border += link.border;
      links_.back().weight += link.weight;
      continue;
    }
    const auto number = static_cast<std::uint32_t>(links_.size());
    groups_[link.a].links.push_back(number);
    groups_[link.b].links.push_back(number);
    links_.push_back({link.a, link.b, link.border, link.weight});
  }
}

double
SurfaceMerging::transition(std::uint32_t node, const Link& link) const
{
  double all = 0.0;
  for (const std::uint32_t other : groups_[node].links)
    if (links_[other].alive)
      all += links_[other].weight;
  return all > 0.0 ? link.weight / all : 0.0;
}

void
SurfaceMerging::joinLikeliest(std::uint32_t first)
{
  std::priority_queue<Candidate> queue;
  const auto single = [&](std::uint32_t node) {
    return node >= first && groups_[node].changes == 0;
  };
  const auto offer = [&](std::uint32_t number) {
    const Link& link = links_[number];
    if (!link.alive || single(link.a) == single(link.b))
      return;
    const std::uint32_t node = single(link.a) ? link.a : link.b;
    queue.push({transition(node, link), number, node});
  };
  for (std::uint32_t number = 0; number < links_.size(); ++number)
    offer(number);
  while (!queue.empty()) {
    const Candidate next = queue.top();
    queue.pop();
    const Link& link = links_[next.link];
    if (!link.alive || !single(next.node))
      continue;
    const std::uint32_t into = link.a == next.node ? link.b : link.a;
    const Group& group = groups_[next.node];
    if (!criterion_.fits(group.sums, groups_[into].model.surface, group.model.misfit))
      continue;
    const std::vector<std::uint32_t> offers = group.links;
    unite(next.link);
    for (const std::uint32_t number : offers)
      offer(number);
  }
  for (std::uint32_t root = 0; root < groups_.size(); ++root)
    if (sets_.find(root) == root && groups_[root].changes > 0)
      groups_[root].model = criterion_.best(groups_[root].sums);
}

std::optional<CostedModel>
SurfaceMerging::evaluate(std::uint32_t number, double& priority)
{
  Link& link = links_[number];
  const Group& a = groups_[link.a];
  const Group& b = groups_[link.b];
  link.changes = changesOf(link);
  link.points = a.sums.count() + b.sums.count();
  double saving = 0.0;
  std::optional<CostedModel> model =
      criterion_.merged(a.sums, a.model, b.sums, b.model, link.border, saving);
  priority = saving / link.points;
  return model;
}

void
SurfaceMerging::push(std::uint32_t number)
{
  double priority = 0.0;
  if (evaluate(number, priority))
    queue(number, priority);
}

void
SurfaceMerging::queue(std::uint32_t number, double priority)
{
  links_[number].queued = true;
  queue_.push({priority, number, 0});
}

void
SurfaceMerging::pushChanged()
{
  std::vector<std::uint32_t> changed;
  for (std::uint32_t number = 0; number < links_.size(); ++number) {
    const Link& link = links_[number];
    if (link.alive && !link.queued &&
        (link.points == 0.0 || link.changes != changesOf(link)))
      changed.push_back(number);
  }
  std::vector<double> priority(changed.size());
  std::vector<std::uint8_t> pays(changed.size());
#pragma omp parallel for num_threads(threads_)
  for (std::size_t k = 0; k < changed.size(); ++k)
    pays[k] = evaluate(changed[k], priority[k]) ? 1 : 0;
  for (std::size_t k = 0; k < changed.size(); ++k)
    if (pays[k] != 0)
      queue(changed[k], priority[k]);
}

void
SurfaceMerging::pushGrown(std::uint32_t root)
{
  constexpr double kGrowth = 1.25;
  for (const std::uint32_t number : groups_[root].links) {
    const Link& link = links_[number];
    if (!link.queued && groups_[link.a].sums.count() + groups_[link.b].sums.count() >
                            kGrowth * link.points)
      push(number);
  }
}

bool
SurfaceMerging::mergeOnce()
{
  // A link that waits in the queue is looked at again when its turn comes, one that did
  // not pay when its groups have grown, and at last when nothing else is left.
  if (queue_.empty())
    pushChanged();
  while (!queue_.empty()) {
    const std::uint32_t number = queue_.top().link;
    queue_.pop();
    Link& link = links_[number];
    link.queued = false;
    if (link.alive && link.changes != changesOf(link))
      push(number);
    else if (link.alive) {
      merge(number);
      return true;
    }
    if (queue_.empty())
      pushChanged();
  }
  return false;
}

void
SurfaceMerging::merge(std::uint32_t number)
{
  double priority = 0.0;
  const std::optional<CostedModel> model = evaluate(number, priority);
  const std::uint32_t root = unite(number);
  groups_[root].model = *model; // as when it was queued: nothing has changed
  pushGrown(root);
}

void
SurfaceMerging::mergeWhileBetter()
{
  while (mergeOnce()) {
  }
}

std::uint32_t
SurfaceMerging::unite(std::uint32_t number)
{
  Link& link = links_[number];
  link.alive = false;
  const std::uint32_t root = sets_.join(link.a, link.b);
  const std::uint32_t other = root == link.a ? link.b : link.a;
  groups_[root].sums += groups_[other].sums;
  groups_[root].changes += groups_[other].changes + 1;
  combineLinks(other, root);
  groups_[other] = Group();
  groups_[other].changes = 1; // no single node any more
  return root;
}

void
SurfaceMerging::combineLinks(std::uint32_t from, std::uint32_t into)
{
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t number : groups_[into].links)
    if (links_[number].alive) {
      const Link& link = links_[number];
      link_to_[link.a == into ? link.b : link.a] = number;
      kept.push_back(number);
    }
  for (const std::uint32_t number : groups_[from].links) {
    Link& link = links_[number];
    if (!link.alive)
      continue;
    const std::uint32_t far = link.a == from ? link.b : link.a;
    const std::uint32_t twin = link_to_[far];
    if (twin != kNoLink) {
      links_[twin].border += link.border;
      links_[twin].weight += link.weight;
      link.alive = false;
      continue;
    }
    (link.a == from ? link.a : link.b) = into;
    kept.push_back(number);
  }
  for (const std::uint32_t number : kept) {
    const Link& link = links_[number];
    link_to_[link.a == into ? link.b : link.a] = kNoLink;
  }
  groups_[into].links = std::move(kept);
}

double
SurfaceMerging::totalCost()
{
  double cost = 0.0;
  for (std::uint32_t root = 0; root < groups_.size(); ++root)
    if (sets_.find(root) == root)
      cost += groups_[root].model.cost;
  for (const Link& link : links_)
    if (link.alive)
      cost += criterion_.borderSaving(link.border);
  return cost;
}

} // namespace nurbs
} // namespace pcl
