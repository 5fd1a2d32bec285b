// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "segmentation_scores.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pcl {
namespace nurbs {
namespace bench {
namespace {

/** How many cells a true and a found region share. */
struct Overlaps {
  Overlaps(const LabelImage& truth, const LabelImage& found, std::size_t least)
  {
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (truth[i] != 0) {
        ++cells;
        ++true_size[truth[i]];
        unlabelled += found[i] == 0 ? 1 : 0;
        if (found[i] != 0) {
          ++found_size[found[i]];
          ++common[{truth[i], found[i]}];
        }
      }
    const auto drop_small = [least](std::map<std::uint32_t, std::size_t>& sizes) {
      for (auto at = sizes.begin(); at != sizes.end();)
        at = at->second < least ? sizes.erase(at) : std::next(at);
    };
    all_found_size = found_size;
    drop_small(true_size);
    drop_small(found_size);
  }

  std::size_t cells = 0;
  std::size_t unlabelled = 0;
  std::map<std::uint32_t, std::size_t> true_size;
  std::map<std::uint32_t, std::size_t> found_size;
  std::map<std::uint32_t, std::size_t> all_found_size;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> common;
};

bool
covers(std::size_t part, std::size_t whole, double tolerance)
{
  return static_cast<double>(part) >= tolerance * static_cast<double>(whole);
}

/** Regions of one side that several of the other side make up. */
int
madeUp(const Overlaps& overlaps,
       bool true_wholes,
       double tolerance,
       const std::set<std::uint32_t>& done,
       std::set<std::uint32_t>& used_wholes,
       std::set<std::uint32_t>& used_parts)
{
  const auto& wholes = true_wholes ? overlaps.true_size : overlaps.found_size;
  const auto& parts = true_wholes ? overlaps.found_size : overlaps.true_size;
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  std::map<std::uint32_t, std::size_t> covered;
  for (const auto& [pair, count] : overlaps.common) {
    const std::uint32_t whole = true_wholes ? pair.first : pair.second;
    const std::uint32_t part = true_wholes ? pair.second : pair.first;
    const auto size = parts.find(part);
    if (wholes.count(whole) == 0 || size == parts.end() ||
        !covers(count, size->second, tolerance))
      continue;
    members[whole].push_back(part);
    covered[whole] += count;
  }
  int result = 0;
  for (const auto& [whole, list] : members)
    if (done.count(whole) == 0 && list.size() > 1 &&
        covers(covered[whole], wholes.at(whole), tolerance)) {
      ++result;
      used_wholes.insert(whole);
      used_parts.insert(list.begin(), list.end());
    }
  return result;
}

RegionCounts
countRegions(const Overlaps& overlaps, double tolerance)
{
  RegionCounts counts;
  counts.truth = static_cast<int>(overlaps.true_size.size());
  std::set<std::uint32_t> used_true;
  std::set<std::uint32_t> used_found;
  for (const auto& [pair, count] : overlaps.common) {
    const auto truth = overlaps.true_size.find(pair.first);
    const auto found = overlaps.found_size.find(pair.second);
    if (truth == overlaps.true_size.end() || found == overlaps.found_size.end() ||
        !covers(count, truth->second, tolerance) ||
        !covers(count, found->second, tolerance))
      continue;
    ++counts.correct;
    used_true.insert(pair.first);
    used_found.insert(pair.second);
  }
  const std::set<std::uint32_t> correct_true = used_true;
  const std::set<std::uint32_t> correct_found = used_found;
  counts.over = madeUp(overlaps, true, tolerance, correct_true, used_true, used_found);
  counts.under =
      madeUp(overlaps, false, tolerance, correct_found, used_found, used_true);
  counts.missed = counts.truth - static_cast<int>(used_true.size());
  counts.noise = static_cast<int>(overlaps.found_size.size()) -
                 static_cast<int>(used_found.size());
  return counts;
}

/** Cells whose right or lower neighbour has another label; with a true label both. */
std::vector<bool>
bordersOf(std::size_t width, const LabelImage& truth, const LabelImage& labels)
{
  std::vector<bool> border(labels.size(), false);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (truth[i] == 0)
      continue;
    const bool right = (i + 1) % width != 0 && truth[i + 1] != 0;
    const bool down = i + width < labels.size() && truth[i + width] != 0;
    border[i] = (right && labels[i + 1] != labels[i]) ||
                (down && labels[i + width] != labels[i]);
  }
  return border;
}

double
boundaryRecall(std::size_t width, const LabelImage& truth, const LabelImage& found)
{
  constexpr std::ptrdiff_t kNear = 2;
  const std::vector<bool> wanted = bordersOf(width, truth, truth);
  const std::vector<bool> drawn = bordersOf(width, truth, found);
  const auto columns = static_cast<std::ptrdiff_t>(width);
  const auto rows = static_cast<std::ptrdiff_t>(truth.size()) / columns;
  const auto near = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
    for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(0, row - kNear);
         r <= std::min(rows - 1, row + kNear);
         ++r)
      for (std::ptrdiff_t c = std::max<std::ptrdiff_t>(0, column - kNear);
           c <= std::min(columns - 1, column + kNear);
           ++c)
        if (drawn[static_cast<std::size_t>(r * columns + c)])
          return true;
    return false;
  };
  std::size_t all = 0;
  std::size_t recalled = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i]) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      ++all;
      recalled += near(at % columns, at / columns) ? 1 : 0;
    }
  return all == 0 ? 1.0 : static_cast<double>(recalled) / static_cast<double>(all);
}

} // namespace

Scores
compare(std::size_t width,
        const LabelImage& truth,
        const LabelImage& found,
        double tolerance,
        std::size_t least)
{
  const Overlaps overlaps(truth, found, least);
  Scores scores;
  scores.regions = countRegions(overlaps, tolerance);
  scores.boundary_recall = boundaryRecall(width, truth, found);
  std::size_t wrong_side = overlaps.unlabelled;
  std::map<std::uint32_t, std::size_t> most;
  for (const auto& [pair, count] : overlaps.common) {
    most[pair.second] = std::max(most[pair.second], count);
    wrong_side += std::min(count, overlaps.all_found_size.at(pair.second) - count);
  }
  std::size_t right = 0;
  for (const auto& [label, count] : most)
    right += count;
  const auto cells = static_cast<double>(std::max<std::size_t>(overlaps.cells, 1));
  scores.undersegmentation = static_cast<double>(wrong_side) / cells;
  scores.accuracy = static_cast<double>(right) / cells;
  return scores;
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
