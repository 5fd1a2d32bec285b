// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Lists of numbers in chunks of one pool: about 5 bytes per number whatever the
 * lengths of the lists, and reading is sequential. */
class BucketLists {
public:
  /** \param[in] buckets number of lists
   * \param[in] numbers how many numbers there may be at a time */
  BucketLists(std::size_t buckets, std::size_t numbers) : heads_(buckets)
  {
    chunks_.reserve(numbers / kPerChunk + buckets);
  }

  std::size_t
  size() const
  {
    return heads_.size();
  }

  void
  push(std::size_t bucket, std::uint32_t number)
  {
    Head& head = heads_[bucket];
    if (head.count == kPerChunk) {
      const std::uint32_t fresh = takeChunk();
      chunks_[fresh].next = head.chunk;
      head = {fresh, 0};
    }
    chunks_[head.chunk].numbers[head.count++] = number;
  }

  /** Move a list to a vector; its order is arbitrary but the same every time. */
  void
  take(std::size_t bucket, std::vector<std::uint32_t>& numbers)
  {
    numbers.clear();
    Head& head = heads_[bucket];
    while (head.chunk != kNone) {
      const Chunk& chunk = chunks_[head.chunk];
      numbers.insert(
          numbers.end(), chunk.numbers.begin(), chunk.numbers.begin() + head.count);
      free_.push_back(head.chunk);
      head = {chunk.next, kPerChunk};
    }
  }

private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  static constexpr std::uint32_t kPerChunk = 31;

  struct Chunk {
    std::uint32_t next;
    std::array<std::uint32_t, kPerChunk> numbers;
  };

  /** First chunk of a list, the only one that may have room. A list without chunks
   * looks full. */
  struct Head {
    std::uint32_t chunk = kNone;
    std::uint32_t count = kPerChunk;
  };

  std::uint32_t
  takeChunk()
  {
    if (free_.empty()) {
      chunks_.emplace_back();
      return static_cast<std::uint32_t>(chunks_.size() - 1);
    }
    const std::uint32_t chunk = free_.back();
    free_.pop_back();
    return chunk;
  }

  std::vector<Chunk> chunks_;
  std::vector<std::uint32_t> free_;
  std::vector<Head> heads_;
};

} // namespace nurbs
} // namespace pcl
