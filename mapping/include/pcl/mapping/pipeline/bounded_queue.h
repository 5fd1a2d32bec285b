// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {

/** \brief What a full queue does with the next item. */
enum class QueuePolicy {
  Wait,      /**< whoever pushes waits: nothing is lost */
  DropOldest /**< the item that has waited longest makes room: nothing is late */
};

/** \brief Hands items from one thread to the next, in order, at most so many on the
 * way.
 *
 * All members may be called from any thread. \ingroup mapping */
template <typename T>
class BoundedQueue {
public:
  /** \throws std::invalid_argument for a capacity of zero */
  explicit BoundedQueue(std::size_t capacity, QueuePolicy policy = QueuePolicy::Wait)
      : capacity_(capacity), policy_(policy)
  {
    if (capacity == 0)
      throw std::invalid_argument("BoundedQueue: the capacity must be positive");
  }

  /** \brief Add an item; waits while the queue is full if that is the policy.
   * \return false when nobody takes items any longer */
  bool
  push(T item)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (policy_ == QueuePolicy::Wait)
      changed_.wait(lock, [&] { return items_.size() < capacity_ || cancelled_; });
    if (cancelled_)
      return false;
    if (items_.size() == capacity_) {
      items_.pop_front();
      ++dropped_;
    }
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  /** \brief Take the oldest item; waits while there is none.
   * \return nothing when no item will come */
  std::optional<T>
  pop()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return !items_.empty() || closed_ || cancelled_; });
    if (items_.empty())
      return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  /** \brief No item will be added; what is in the queue can still be taken. */
  void
  close()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  /** \brief No item will be taken: forget those that wait, and let nobody wait. */
  void
  cancel()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    cancelled_ = true;
    items_.clear();
    changed_.notify_all();
  }

  /** \brief Items that had to make room. */
  std::size_t
  dropped() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

private:
  const std::size_t capacity_;
  const QueuePolicy policy_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  std::size_t dropped_ = 0;
  bool closed_ = false;
  bool cancelled_ = false;
};

} // namespace nurbs
} // namespace pcl
