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
  explicit BucketLists(std::size_t buckets) : heads_(buckets, kNone) {}

  std::size_t
  size() const
  {
    return heads_.size();
  }

  void
  push(std::size_t bucket, std::uint32_t number)
  {
    std::uint32_t head = heads_[bucket];
    if (head == kNone || chunks_[head].count == kPerChunk) {
      const std::uint32_t fresh = takeChunk();
      chunks_[fresh].next = head;
      chunks_[fresh].count = 0;
      head = heads_[bucket] = fresh;
    }
    Chunk& chunk = chunks_[head];
    chunk.numbers[chunk.count++] = number;
  }

  /** Move a list to a vector; its order is arbitrary but the same every time. */
  void
  take(std::size_t bucket, std::vector<std::uint32_t>& numbers)
  {
    numbers.clear();
    for (std::uint32_t head = heads_[bucket]; head != kNone;) {
      const Chunk& chunk = chunks_[head];
      numbers.insert(
          numbers.end(), chunk.numbers.begin(), chunk.numbers.begin() + chunk.count);
      free_.push_back(head);
      head = chunk.next;
    }
    heads_[bucket] = kNone;
  }

private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  static constexpr std::uint32_t kPerChunk = 30;

  struct Chunk {
    std::uint32_t next;
    std::uint32_t count;
    std::array<std::uint32_t, kPerChunk> numbers;
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
  std::vector<std::uint32_t> heads_;
};

} // namespace nurbs
} // namespace pcl
