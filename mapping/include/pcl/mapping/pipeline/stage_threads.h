// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/mapping/pipeline/bounded_queue.h>
#include <pcl/mapping/pipeline/time_statistics.h>
#include <pcl/mapping/stop_watch.h>

#include <chrono>
#include <exception>
#include <functional>
#include <list>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How long a stage worked on each of its items; waiting does not count. */
struct StageTimes {
  std::string name;
  TimeStatistics times;
};

/** \brief Stages of work, each in a thread of its own, joined by queues.
 *
 * A line of stages is made of one source, any number of stages and one sink, with a
 * queue between each two. Items keep their order. When a stage throws, those before it
 * end, those behind it finish what they were given, and wait() throws what it threw.
 * The queues must outlive this object.
 *
 * \code
 * BoundedQueue<int> numbers(4);
 * BoundedQueue<double> roots(4);
 * StageThreads stages;
 * stages.addSource<int>("count", numbers, [&] { return n < 9; }, [&] { return n++; });
 * stages.addStage<int, double>("root", numbers, roots, [](int n) { return sqrt(n); });
 * stages.addSink<double>("print", roots, [](double r) { std::cout << r << '\n'; });
 * stages.wait();
 * \endcode
 * Not to be built up from several threads; stop() may be called from any.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT StageThreads {
public:
  StageThreads() = default;

  /** \brief Ends all stages, also a line that is not complete, and forgets what was
   * thrown; items on the way are lost unless wait() was called. */
  ~StageThreads();

  StageThreads(const StageThreads&) = delete;
  StageThreads&
  operator=(const StageThreads&) = delete;

  /** \brief Start a source: \a next makes an item as long as \a ready, which may wait,
   * says that there is one. */
  template <typename Out>
  void
  addSource(const std::string& name,
            BoundedQueue<Out>& out,
            std::function<bool()> ready,
            std::function<Out()> next)
  {
    start(
        name,
        [this, &out, ready = std::move(ready), next = std::move(next)](
            TimeStatistics& times) {
          if (stopping() || !ready())
            return false;
          StopWatch watch;
          Out item = next();
          times.add(watch.lap());
          return out.push(std::move(item));
        },
        [&out] { out.close(); },
        [&out] { out.cancel(); });
  }

  /** \brief Start a stage that makes each item into another. */
  template <typename In, typename Out>
  void
  addStage(const std::string& name,
           BoundedQueue<In>& in,
           BoundedQueue<Out>& out,
           std::function<Out(In)> work)
  {
    start(
        name,
        [&in, &out, work = std::move(work)](TimeStatistics& times) {
          std::optional<In> item = in.pop();
          if (!item)
            return false;
          StopWatch watch;
          Out result = work(std::move(*item));
          times.add(watch.lap());
          return out.push(std::move(result));
        },
        [&in, &out] {
          in.cancel();
          out.close();
        },
        [&out] { out.cancel(); });
  }

  /** \brief Start the last stage. */
  template <typename In>
  void
  addSink(const std::string& name, BoundedQueue<In>& in, std::function<void(In)> work)
  {
    start(
        name,
        [&in, work = std::move(work)](TimeStatistics& times) {
          std::optional<In> item = in.pop();
          if (!item)
            return false;
          StopWatch watch;
          work(std::move(*item));
          times.add(watch.lap());
          return true;
        },
        [&in] { in.cancel(); },
        [] {});
  }

  /** \brief Let sources end after the item at hand; what they made is finished. */
  void
  stop();

  /** \brief Whether stop() was called or a stage threw. */
  bool
  stopping() const;

  /** \brief Wait for a moment, less long if stop() is called. \return whether it was not
   */
  bool
  waitUntil(std::chrono::steady_clock::time_point moment) const;

  /** \brief Wait until all stages have ended. \throws what the first of them to fail
   * threw */
  void
  wait();

  /** \brief Times of the stages in the order in which they were added; after wait(). */
  std::vector<StageTimes>
  times() const;

private:
  /** Repeat \a step until it is false or throws, then \a end, in a new thread. \a
   * abandon lets it not wait for a stage that never came. */
  void
  start(const std::string& name,
        std::function<bool(TimeStatistics&)> step,
        std::function<void()> end,
        std::function<void()> abandon);

  void
  join();

  mutable std::mutex mutex_;
  mutable std::condition_variable stopped_;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::list<StageTimes> times_; // threads keep references to its items
  std::vector<std::function<void()>> abandon_;
  std::vector<std::thread> threads_;
};

} // namespace nurbs
} // namespace pcl
