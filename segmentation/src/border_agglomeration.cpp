// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_agglomeration.h"

#include <tuple>

namespace pcl {
namespace nurbs {

bool
BorderAgglomeration::Candidate::operator<(const Candidate& other) const
{
  return std::tie(share, length, other.a, other.b) <
         std::tie(other.share, other.length, a, b);
}

void
BorderAgglomeration::add(std::uint32_t a,
                         std::uint32_t b,
                         std::size_t length,
                         bool smooth)
{
  Border& sum = border(a, b);
  sum.all += length;
  sum.smooth += smooth ? length : 0;
  neighbours_[a].insert(b);
  neighbours_[b].insert(a);
}

void
BorderAgglomeration::push(std::uint32_t a, std::uint32_t b, double least_share)
{
  const Border& sum = border(a, b);
  if (sum.share() >= least_share)
    queue_.push({sum.share(), sum.all, std::min(a, b), std::max(a, b)});
}

void
BorderAgglomeration::moveBorders(std::uint32_t from,
                                 std::uint32_t into,
                                 double least_share)
{
  borders_.erase(std::minmax(from, into));
  neighbours_[from].erase(into);
  neighbours_[into].erase(from);
  for (const std::uint32_t other : neighbours_[from]) {
    const Border moved = border(from, other);
    borders_.erase(std::minmax(from, other));
    neighbours_[other].erase(from);
    neighbours_[other].insert(into);
    neighbours_[into].insert(other);
    Border& sum = border(into, other);
    sum.all += moved.all;
    sum.smooth += moved.smooth;
    push(into, other, least_share);
  }
  neighbours_[from].clear();
}

void
BorderAgglomeration::joinInto(DisjointSets& sets, double least_share)
{
  for (const auto& [pair, sum] : borders_)
    push(pair.first, pair.second, least_share);
  while (!queue_.empty()) {
    const Candidate next = queue_.top();
    queue_.pop();
    const auto found = borders_.find({next.a, next.b});
    if (found == borders_.end() || found->second.all != next.length ||
        found->second.share() != next.share)
      continue; // one of them was joined to another since
    sets.join(next.a, next.b);
    moveBorders(next.b, next.a, least_share); // roots are the smallest members
  }
}

} // namespace nurbs
} // namespace pcl
