// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace pcl {
namespace nurbs {

/** Items per chunk: fixed, so that sums do not depend on the number of threads. */
constexpr std::size_t kChunk = 256;

/** Call work(begin, end, chunk) for all chunks of a range, in several threads.
 *
 * Threads are started for each call (some 20 us) rather than kept: OpenMP's wait for
 * work by spinning, which on a busy machine costs more than the work itself. */
template <typename Work>
void
forChunks(std::size_t size, int threads, Work work)
{
  const std::size_t chunks = (size + kChunk - 1) / kChunk;
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t c = next++; c < chunks; c = next++)
      work(c * kChunk, std::min((c + 1) * kChunk, size), c);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(threads), chunks); ++i)
    others.emplace_back(run);
  run();
  for (std::thread& other : others)
    other.join();
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
