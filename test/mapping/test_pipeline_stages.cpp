// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Queues, threads and clocks of a pipeline.

#include <pcl/mapping/pipeline/stage_threads.h>
#include <pcl/mapping/pipeline/weak_intervals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

TEST(BoundedQueue, keepsOrderAndEnds)
{
  BoundedQueue<int> queue(3);
  std::thread producer([&] {
    for (int k = 0; k < 1000; ++k)
      ASSERT_TRUE(queue.push(k));
    queue.close();
  });
  int expected = 0;
  while (const std::optional<int> item = queue.pop())
    EXPECT_EQ(*item, expected++);
  producer.join();
  EXPECT_EQ(expected, 1000);
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST(BoundedQueue, neverHoldsMoreThanItsCapacity)
{
  BoundedQueue<int> queue(2);
  std::atomic<int> pushed{0};
  std::thread producer([&] {
    for (int k = 0; k < 10; ++k, ++pushed)
      queue.push(k);
    queue.close();
  });
  for (int taken = 0; queue.pop(); ++taken)
    EXPECT_LE(pushed, taken + 1 + 2); // one taken now, two waiting
  producer.join();
}

TEST(BoundedQueue, dropsTheOldestWhenItMayNotWait)
{
  BoundedQueue<int> queue(2, QueuePolicy::DropOldest);
  for (int k = 0; k < 5; ++k)
    EXPECT_TRUE(queue.push(k));
  EXPECT_EQ(queue.dropped(), 3U);
  EXPECT_EQ(*queue.pop(), 3);
  EXPECT_EQ(*queue.pop(), 4);
}

TEST(BoundedQueue, cancelWakesAWaitingProducer)
{
  BoundedQueue<int> queue(1);
  ASSERT_TRUE(queue.push(0));
  std::thread canceller([&] { queue.cancel(); });
  EXPECT_FALSE(queue.push(1)); // full: waits, or is refused at once
  canceller.join();
  EXPECT_FALSE(queue.pop());
}

TEST(BoundedQueue, refusesToHoldNothing)
{
  EXPECT_THROW(BoundedQueue<int>(0), std::invalid_argument);
}

/** A line of four stages over the numbers below a limit. */
struct Line {
  explicit Line(int most) : limit(most) {}

  void
  run(int fail_stage = 0, int fail_at = -1)
  {
    const auto work = [=](int stage, int item) {
      if (stage == fail_stage && item == fail_at)
        throw std::runtime_error("stage " + std::to_string(stage));
      return item;
    };
    threads.addSource<int>(
        "count", first, [&] { return next < limit; }, [=] { return work(1, next++); });
    threads.addStage<int, long>(
        "double", first, second, [=](int item) { return 2L * work(2, item); });
    threads.addStage<long, long>("add", second, third, [=](long item) {
      return 1L + work(3, static_cast<int>(item / 2)) * 2L;
    });
    threads.addSink<long>("gather", third, [=](long item) {
      work(4, static_cast<int>(item / 2));
      results.push_back(item);
      if (stop_after > 0 && results.size() == stop_after)
        threads.stop();
    });
    threads.wait();
  }

  int limit;
  int next = 0;
  std::size_t stop_after = 0;
  std::vector<long> results;
  BoundedQueue<int> first{2};
  BoundedQueue<long> second{1};
  BoundedQueue<long> third{3};
  StageThreads threads;
};

void
expectBeginning(const std::vector<long>& results)
{
  for (std::size_t k = 0; k < results.size(); ++k)
    ASSERT_EQ(results[k], 2 * static_cast<long>(k) + 1);
}

TEST(StageThreads, everyItemPassesInOrder)
{
  Line line(500);
  line.run();
  ASSERT_EQ(line.results.size(), 500U);
  expectBeginning(line.results);
  const std::vector<StageTimes> times = line.threads.times();
  ASSERT_EQ(times.size(), 4U);
  EXPECT_EQ(times[0].name, "count");
  EXPECT_EQ(times[3].name, "gather");
  for (const StageTimes& stage : times)
    EXPECT_EQ(stage.times.count(), 500U);
}

TEST(StageThreads, whatAStageThrowsArrivesAndTheItemsBeforeAreKept)
{
  for (int stage = 1; stage <= 4; ++stage)
    for (const int at : {0, 1, 17, 99}) {
      Line line(100);
      try {
        line.run(stage, at);
        ADD_FAILURE() << stage;
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "stage " + std::to_string(stage));
      }
      EXPECT_TRUE(line.threads.stopping());
      ASSERT_EQ(line.results.size(), static_cast<std::size_t>(at));
      expectBeginning(line.results);
    }
}

TEST(StageThreads, stopEndsTheSourceAndFinishesWhatItMade)
{
  Line line(1000000000);
  line.stop_after = 50;
  line.run();
  EXPECT_GE(line.results.size(), 50U);
  EXPECT_EQ(line.results.size(), static_cast<std::size_t>(line.next));
  expectBeginning(line.results);
}

TEST(StageThreads, anIncompleteLineCanBeGivenUp)
{
  BoundedQueue<int> queue(1);
  BoundedQueue<int> other(1);
  StageThreads threads;
  threads.addSource<int>(
      "endless", queue, [] { return true; }, [] { return 1; });
  threads.addStage<int, int>("same", queue, other, [](int item) { return item; });
  SUCCEED(); // nobody takes from the last queue: the destructor must not wait for that
}

TEST(StageThreads, waitingIsCutShortByStop)
{
  StageThreads threads;
  EXPECT_TRUE(threads.waitUntil(steady_clock::now() + milliseconds(1)));
  std::thread stopper([&] { threads.stop(); });
  EXPECT_FALSE(threads.waitUntil(steady_clock::now() + std::chrono::hours(1)));
  stopper.join();
}

TEST(TimeStatistics, percentilesAreThoseOfTheSortedList)
{
  std::mt19937 random(1);
  std::lognormal_distribution<double> duration(-3.0, 1.5);
  TimeStatistics statistics;
  std::vector<double> all;
  for (int k = 0; k < 20000; ++k) {
    all.push_back(duration(random));
    statistics.add(all.back());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(statistics.count(), all.size());
  EXPECT_EQ(statistics.max(), all.back());
  EXPECT_NEAR(
      statistics.mean(), std::accumulate(all.begin(), all.end(), 0.0) / 20000.0, 1e-12);
  for (const double share : {0.01, 0.5, 0.95, 0.999}) {
    const double exact = all[static_cast<std::size_t>(share * 20000.0) - 1];
    EXPECT_NEAR(statistics.percentile(share), exact, 0.011 * exact);
  }
  EXPECT_THROW(statistics.percentile(1.1), std::invalid_argument);
}

TEST(TimeStatistics, extremes)
{
  TimeStatistics statistics;
  EXPECT_EQ(statistics.percentile(0.95), 0.0);
  EXPECT_EQ(statistics.mean(), 0.0);
  statistics.add(0.0);
  EXPECT_EQ(statistics.percentile(0.5), 0.0);
  statistics.add(1e9);
  EXPECT_EQ(statistics.max(), 1e9);
  EXPECT_LE(statistics.percentile(0.4), 1.02e-6);
}

TEST(WeakIntervals, growOverScansInARow)
{
  std::vector<WeakInterval> intervals;
  const auto add = [&](std::size_t scan,
                       Weakness weakness,
                       int directions,
                       std::size_t previous) {
    const double stamp = 0.1 * static_cast<double>(scan);
    addWeakScan(intervals, {scan, scan, stamp, stamp, weakness, directions}, previous);
  };
  add(4, Weakness::Degenerate, 1, 3);
  add(5, Weakness::Degenerate, 2, 4);
  add(8, Weakness::Degenerate, 1, 5); // two scans were skipped: the next in the row
  add(9, Weakness::Lost, 0, 8);
  add(11, Weakness::Lost, 0, 10); // 10 was good
  ASSERT_EQ(intervals.size(), 3U);
  EXPECT_EQ(intervals[0].first, 4U);
  EXPECT_EQ(intervals[0].last, 8U);
  EXPECT_EQ(intervals[0].directions, 2);
  EXPECT_DOUBLE_EQ(intervals[0].to, 0.8);
  EXPECT_EQ(intervals[1].last, 9U);
  EXPECT_EQ(intervals[2].first, 11U);
}

} // namespace
