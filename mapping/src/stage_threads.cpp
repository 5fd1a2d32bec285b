// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pipeline/stage_threads.h>

namespace pcl {
namespace nurbs {

StageThreads::~StageThreads()
{
  stop();
  for (const std::function<void()>& abandon : abandon_)
    abandon();
  join();
}

void
StageThreads::stop()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  stopping_ = true;
  stopped_.notify_all();
}

bool
StageThreads::stopping() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return stopping_;
}

bool
StageThreads::waitUntil(std::chrono::steady_clock::time_point moment) const
{
  std::unique_lock<std::mutex> lock(mutex_);
  return !stopped_.wait_until(lock, moment, [&] { return stopping_; });
}

void
StageThreads::start(const std::string& name,
                    std::function<bool(TimeStatistics&)> step,
                    std::function<void()> end,
                    std::function<void()> abandon)
{
  abandon_.push_back(std::move(abandon));
  times_.push_back({name, {}});
  TimeStatistics& times = times_.back().times;
  threads_.emplace_back([this, &times, step = std::move(step), end = std::move(end)] {
    try {
      while (step(times))
        continue;
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_)
        failure_ = std::current_exception();
      stopping_ = true;
      stopped_.notify_all();
    }
    end();
  });
}

void
StageThreads::join()
{
  for (std::thread& thread : threads_)
    if (thread.joinable())
      thread.join();
}

void
StageThreads::wait()
{
  join();
  if (failure_)
    std::rethrow_exception(std::exchange(failure_, nullptr));
}

std::vector<StageTimes>
StageThreads::times() const
{
  return {times_.begin(), times_.end()};
}

} // namespace nurbs
} // namespace pcl
