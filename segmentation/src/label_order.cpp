// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "label_order.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace pcl {
namespace nurbs {

void
orderBySize(std::uint32_t count, std::vector<std::uint32_t>& labels)
{
  std::vector<std::size_t> sizes(count + 1, 0);
  for (const std::uint32_t label : labels)
    ++sizes[label];
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), std::uint32_t{1});
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return sizes[a] > sizes[b];
  });
  std::vector<std::uint32_t> renamed(count + 1, 0);
  for (std::uint32_t rank = 0; rank < count; ++rank)
    renamed[order[rank]] = rank + 1;
  for (std::uint32_t& label : labels)
    label = renamed[label];
}

} // namespace nurbs
} // namespace pcl
