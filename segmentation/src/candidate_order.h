// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** An edge that may be the next, by the key of its last rating. */
struct Candidate {
  double key;
  std::uint64_t tie;

  /** \param[in] key exact
   * \param[in] number of the edge: of equal keys the first edge is taken first
   * \param[in] place of the edge among the opened ones */
  Candidate(double key, std::uint32_t number, std::uint32_t place)
      : key(key), tie(std::uint64_t{~number} << 32U | place)
  {
  }

  std::uint32_t
  place() const
  {
    return static_cast<std::uint32_t>(tie);
  }

  /** Whether another is taken first; without branches, which nobody could foresee. */
  bool
  operator<(const Candidate& other) const
  {
    return (key < other.key) | ((key == other.key) & (tie < other.tie));
  }
};

/** Candidates from the best to the worst: many that are sorted at once, and a heap of
 * the few that are put back. */
class CandidateOrder {
public:
  /** Add a candidate before the first is taken. */
  void
  add(const Candidate& candidate)
  {
    sorted_.push_back(candidate);
  }

  void
  sort()
  {
    std::sort(sorted_.begin(), sorted_.end());
  }

  bool
  empty() const
  {
    return sorted_.empty() && put_back_.empty();
  }

  /** Whether a candidate comes before all that are here. */
  bool
  isBest(const Candidate& candidate) const
  {
    return (sorted_.empty() || sorted_.back() < candidate) &&
           (put_back_.empty() || put_back_.front() < candidate);
  }

  /** Take the best one out; there is one. */
  Candidate
  take()
  {
    if (put_back_.empty() || (!sorted_.empty() && put_back_.front() < sorted_.back()))
      return takeLast(sorted_);
    std::pop_heap(put_back_.begin(), put_back_.end());
    return takeLast(put_back_);
  }

  void
  putBack(const Candidate& candidate)
  {
    put_back_.push_back(candidate);
    std::push_heap(put_back_.begin(), put_back_.end());
  }

private:
  static Candidate
  takeLast(std::vector<Candidate>& candidates)
  {
    const Candidate last = candidates.back();
    candidates.pop_back();
    return last;
  }

  std::vector<Candidate> sorted_; // the best last
  std::vector<Candidate> put_back_;
};

} // namespace nurbs
} // namespace pcl
