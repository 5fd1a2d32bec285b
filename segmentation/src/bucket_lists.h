// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Lists of small values in chunks of one pool: each value takes little more than its
 * size whatever the lengths of the lists, and reading is sequential.
 * \tparam Value of 4 to 16 bytes */
template <typename Value>
class BucketLists {
public:
  /** \param[in] buckets number of lists
   * \param[in] values how many values there may be at a time */
  BucketLists(std::size_t buckets, std::size_t values) : heads_(buckets)
  {
    chunks_.reserve(values / kPerChunk + buckets);
  }

  std::size_t
  size() const
  {
    return heads_.size();
  }

  void
  push(std::size_t bucket, const Value& value)
  {
    Head& head = heads_[bucket];
    if (head.count == kPerChunk) {
      const std::uint32_t fresh = takeChunk();
      chunks_[fresh].next = head.chunk;
      head = {fresh, 0};
    }
    chunks_[head.chunk].values[head.count++] = value;
  }

  /** Move a list to a vector; its order is arbitrary but the same every time. The next
   * list is sent to the cache. */
  void
  take(std::size_t bucket, std::vector<Value>& values)
  {
    values.clear();
    Head& head = heads_[bucket];
    while (head.chunk != kNone) {
      const Chunk& chunk = chunks_[head.chunk];
      prefetch(chunk.next);
      values.insert(
          values.end(), chunk.values.begin(), chunk.values.begin() + head.count);
      free_.push_back(head.chunk);
      head = {chunk.next, kPerChunk};
    }
    if (bucket + 1 < size())
      prefetch(heads_[bucket + 1].chunk);
  }

private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  static constexpr std::size_t kChunkBytes = 508;
  static constexpr std::size_t kCacheLine = 64;
  static constexpr std::uint32_t kPerChunk = kChunkBytes / sizeof(Value);

  struct Chunk {
    std::uint32_t next;
    std::array<Value, kPerChunk> values;
  };

  /** First chunk of a list, the only one that may have room. A list without chunks
   * looks full. */
  struct Head {
    std::uint32_t chunk = kNone;
    std::uint32_t count = kPerChunk;
  };

  void
  prefetch(std::uint32_t chunk) const
  {
    if (chunk == kNone)
      return;
    const char* const first = reinterpret_cast<const char*>(&chunks_[chunk]);
    for (std::size_t byte = 0; byte < sizeof(Chunk); byte += kCacheLine)
      __builtin_prefetch(first + byte);
  }

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
