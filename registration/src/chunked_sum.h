// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** Items per chunk: fixed, so that sums do not depend on the number of threads. */
constexpr std::size_t kChunk = 256;

/** Call work(begin, end, chunk) for all chunks of a range, in several threads. */
template <typename Work>
void
forChunks(std::size_t size, int threads, Work work)
{
  const auto chunks = static_cast<std::ptrdiff_t>((size + kChunk - 1) / kChunk);
#pragma omp parallel for schedule(dynamic) num_threads(threads) if (threads > 1)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * kChunk;
    work(begin, std::min(begin + kChunk, size), static_cast<std::size_t>(c));
  }
}

/** Sum of add(i, partial) over a range. */
template <typename Sum, typename Add>
Sum
chunkedSum(std::size_t size, int threads, Add add)
{
  std::vector<Sum> partial((size + kChunk - 1) / kChunk);
  forChunks(size, threads, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    for (std::size_t i = begin; i < end; ++i)
      add(i, partial[chunk]);
  });
  Sum total;
  for (const Sum& sum : partial)
    total += sum;
  return total;
}

} // namespace nurbs
} // namespace pcl
