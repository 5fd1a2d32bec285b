// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

  /** Sort what was added. Keys of one bucket are spread evenly over its width, so that
   * bins of theirs leave little to be sorted. O(n) then, O(n log n) at worst. */
  void
  sort()
  {
    constexpr std::size_t kFew = 16;
    constexpr double kNarrow = 1e-200; // its inverse is finite
    if (sorted_.empty())
      return;
    const auto [least, most] = std::minmax_element(
        sorted_.begin(), sorted_.end(), [](const Candidate& a, const Candidate& b) {
          return a.key < b.key;
        });
    const double width = most->key - least->key;
    if (sorted_.size() < kFew || !(width > kNarrow && std::isfinite(width)))
      std::sort(sorted_.begin(), sorted_.end());
    else
      sortBins(spreadOverBins(least->key, most->key));
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
  /** Order by as many bins of equal width as there are candidates.
   * \return where each bin ends */
  const std::vector<std::uint32_t>&
  spreadOverBins(double low, double high)
  {
    const std::size_t bins = sorted_.size();
    const double per_key = static_cast<double>(bins - 1) / (high - low);
    const auto bin_of = [&](const Candidate& candidate) {
      return std::min(static_cast<std::size_t>((candidate.key - low) * per_key),
                      bins - 1);
    };
    ends_.assign(bins + 1, 0);
    for (const Candidate& candidate : sorted_)
      ++ends_[bin_of(candidate) + 1];
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    spread_.resize(bins, {0.0, 0, 0});
    for (const Candidate& candidate : sorted_)
      spread_[ends_[bin_of(candidate)]++] = candidate;
    sorted_.swap(spread_);
    return ends_;
  }

  void
  sortBins(const std::vector<std::uint32_t>& ends)
  {
    auto first = sorted_.begin();
    for (const std::uint32_t end : ends) {
      const auto last = sorted_.begin() + static_cast<std::ptrdiff_t>(end);
      std::sort(first, last);
      first = last;
    }
  }

  static Candidate
  takeLast(std::vector<Candidate>& candidates)
  {
    const Candidate last = candidates.back();
    candidates.pop_back();
    return last;
  }

  std::vector<Candidate> sorted_; // the best last
  std::vector<Candidate> put_back_;
  std::vector<Candidate> spread_;   // to spread over
  std::vector<std::uint32_t> ends_; // of bins
};

} // namespace nurbs
} // namespace pcl
