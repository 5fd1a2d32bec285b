// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/maximum_clique.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using Set = boost::dynamic_bitset<>;

void
check(const NeighbourSets& neighbours)
{
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (neighbours[i].size() != neighbours.size())
      throw std::invalid_argument("a set of neighbours needs a bit for each vertex");
    if (neighbours[i][i])
      throw std::invalid_argument("a vertex must not be its own neighbour");
    for (std::size_t j = neighbours[i].find_first(); j != Set::npos;
         j = neighbours[i].find_next(j))
      if (!neighbours[j][i])
        throw std::invalid_argument("neighbourhood must be mutual");
  }
}

class CliqueSearch {
public:
  CliqueSearch(const NeighbourSets& neighbours, std::size_t max_steps)
      : neighbours_(neighbours), steps_left_(max_steps)
  {
  }

  MaximumClique
  run()
  {
    Set all(neighbours_.size());
    all.set();
    best_ = greedy(all);
    extend(all);
    std::sort(best_.begin(), best_.end());
    return {best_, !exhausted_};
  }

private:
  struct Coloured {
    std::size_t vertex;
    std::size_t
        colour; // from 1; a clique among it and those before has at most so many
  };

  /** Take the candidate with most neighbours among the candidates, again and again. */
  std::vector<std::size_t>
  greedy(Set candidates) const
  {
    std::vector<std::size_t> clique;
    while (candidates.any()) {
      std::size_t best = candidates.find_first();
      std::size_t most = (neighbours_[best] & candidates).count();
      for (std::size_t v = candidates.find_next(best); v != Set::npos;
           v = candidates.find_next(v)) {
        const std::size_t degree = (neighbours_[v] & candidates).count();
        if (degree > most) {
          most = degree;
          best = v;
        }
      }
      clique.push_back(best);
      candidates &= neighbours_[best];
    }
    return clique;
  }

  /** Vertices of a colour are no neighbours of each other. */
  std::vector<Coloured>
  colour(Set uncoloured) const
  {
    std::vector<Coloured> result;
    for (std::size_t number = 1; uncoloured.any(); ++number) {
      Set same = uncoloured;
      for (std::size_t v = same.find_first(); v != Set::npos; v = same.find_next(v)) {
        result.push_back({v, number});
        uncoloured.reset(v);
        same -= neighbours_[v];
      }
    }
    return result;
  }

  void
  extend(Set candidates)
  {
    std::vector<Coloured> order = colour(candidates);
    for (auto next = order.rbegin(); next != order.rend(); ++next) {
      if (current_.size() + next->colour <= best_.size())
        return;
      if (steps_left_ == 0) {
        exhausted_ = true;
        return;
      }
      --steps_left_;
      current_.push_back(next->vertex);
      const Set deeper = candidates & neighbours_[next->vertex];
      if (deeper.any())
        extend(deeper);
      else if (current_.size() > best_.size())
        best_ = current_;
      current_.pop_back();
      candidates.reset(next->vertex);
    }
  }

  const NeighbourSets& neighbours_;
  std::size_t steps_left_;
  bool exhausted_ = false;
  std::vector<std::size_t> current_;
  std::vector<std::size_t> best_;
};

} // namespace

MaximumClique
maximumClique(const NeighbourSets& neighbours, std::size_t max_steps)
{
  check(neighbours);
  return CliqueSearch(neighbours, max_steps).run();
}

} // namespace nurbs
} // namespace pcl
