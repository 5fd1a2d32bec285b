// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "bucket_lists.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** An edge in the queue with all that is asked of it, so that no look at it has to
 * fetch it from elsewhere; its first node follows from its number. */
struct QueuedEdge {
  std::uint32_t number;
  std::uint32_t target;
  float weight;
};

/** Monotone queue of edges whose keys only fall: buckets of equal width from the
 * highest key down to the lowest of a range. What falls out of the range waits for a
 * new one. */
class KeyBuckets {
public:
  /** \param[in] edges how many edges there may be at a time */
  explicit KeyBuckets(std::size_t edges)
      : lists_(std::clamp(edges / kPerBucket, std::size_t{1}, kMostBuckets), edges)
  {
  }

  std::size_t
  size() const
  {
    return lists_.size();
  }

  /** Of the keys pushed from now on; all buckets are empty. */
  void
  setRange(double low, double high)
  {
    highest_ = high;
    per_key_ = high > low ? static_cast<double>(lists_.size()) / (high - low) : 0.0;
  }

  /** Put an edge in the bucket of its key, which is in range. */
  void
  push(const QueuedEdge& edge, double key)
  {
    lists_.push(std::min(bucketOf(key), lists_.size() - 1), edge);
  }

  /** Let an edge wait for a later bucket than this one, if its key belongs there. */
  bool
  postpone(std::size_t bucket, const QueuedEdge& edge, double key)
  {
    const std::size_t later = bucketOf(key);
    if (later <= bucket)
      return false;
    if (later < lists_.size())
      lists_.push(later, edge);
    else
      waiting_.push_back(edge);
    return true;
  }

  /** Move the edges of a bucket to a vector. */
  void
  take(std::size_t bucket, std::vector<QueuedEdge>& edges)
  {
    lists_.take(bucket, edges);
  }

  /** Move the edges whose keys are below all buckets to a vector. */
  std::vector<QueuedEdge>
  takeWaiting()
  {
    std::vector<QueuedEdge> waiting;
    waiting.swap(waiting_);
    return waiting;
  }

private:
  /** Edges per bucket: their nodes and the order of them fit the cache. */
  static constexpr std::size_t kPerBucket = 128;
  static constexpr std::size_t kMostBuckets = 1U << 16U;

  /** Number of a bucket, or beyond the last where the key is below all buckets. */
  std::size_t
  bucketOf(double key) const
  {
    const double place = (highest_ - key) * per_key_;
    if (!(place > 0.0))
      return 0;
    return static_cast<std::size_t>(
        std::min(place, static_cast<double>(lists_.size())));
  }

  BucketLists<QueuedEdge> lists_;
  std::vector<QueuedEdge> waiting_;
  double highest_ = 0.0;
  double per_key_ = 0.0;
};

} // namespace nurbs
} // namespace pcl
