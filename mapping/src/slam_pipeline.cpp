// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/slam_pipeline.h>

#include <stdexcept>

namespace pcl {
namespace nurbs {

namespace {

/** Detector by options; null for none. */
std::unique_ptr<LoopDetector>
detectorFor(const SlamOptions& options)
{
  if (!options.close_loops)
    return nullptr;
  return std::make_unique<ProximityLoopDetector>(options.loops);
}

} // namespace

SlamPipeline::SlamPipeline(const ScanSource& source, const SlamOptions& options)
    : options_(options),
      feed_(source, options.feed),
      odometry_(options.odometry),
      graph_(options.graph, detectorFor(options))
{
  if (options.queue_capacity == 0)
    throw std::invalid_argument("SlamPipeline: the queue's capacity must be positive");
}

void
SlamPipeline::setLoopDetector(std::unique_ptr<LoopDetector> detector)
{
  graph_ = KeyframeGraph(options_.graph, std::move(detector));
}

void
SlamPipeline::run()
{
  StopWatch watch;
  const bool realtime = options_.feed.realtime;
  BoundedQueue<ReadScan> read(options_.queue_capacity,
                              realtime ? QueuePolicy::DropOldest : QueuePolicy::Wait);
  BoundedQueue<TrackedScan> tracked(options_.queue_capacity);
  BoundedQueue<TrackedScan> placed(options_.queue_capacity);
  StageThreads stages;
  const auto finish = [&] {
    result_.stages = stages.times();
    result_.skipped = feed_.skipped() + read.dropped();
    conclude();
    result_.seconds = watch.lap();
  };
  try {
    const auto wait = [&](auto moment) { return stages.waitUntil(moment); };
    stages.addSource<ReadScan>(
        "read", read, [&] { return feed_.ready(wait); }, [&] { return feed_.next(); });
    stages.addStage<ReadScan, TrackedScan>(
        "odometry", read, tracked, [this](const ReadScan& scan) {
          return track(scan);
        });
    stages.addStage<TrackedScan, TrackedScan>(
        "graph", tracked, placed, [this](TrackedScan scan) {
          return addToGraph(std::move(scan));
        });
    stages.addSink<TrackedScan>("output", placed, [&](const TrackedScan& scan) {
      collect(scan);
      if (progress_ && !progress_(collected_, feed_.size()))
        stages.stop();
    });
    stages.wait();
  } catch (...) {
    finish();
    throw;
  }
  finish();
}

SlamPipeline::TrackedScan
SlamPipeline::track(const ReadScan& scan)
{
  if (!scan.fault.empty())
    return {scan.number, scan.stamp, scan.fault, {}};
  // Odometry's unit of time is the sensor's period: where scans were left out or could
  // not be read, the sensor went on for longer.
  const double period = feed_.period();
  std::vector<float> times;
  double interval = 1.0;
  if (period > 0.0) {
    for (const float time : scan.times)
      times.push_back(
          static_cast<float>(options_.odometry.reference_time + time / period));
    if (last_stamp_)
      interval = (scan.stamp - *last_stamp_) / period;
  }
  last_stamp_ = scan.stamp;
  return {scan.number, scan.stamp, {}, odometry_.process(scan.points, times, interval)};
}

SlamPipeline::TrackedScan
SlamPipeline::addToGraph(TrackedScan scan)
{
  if (scan.fault.empty())
    graph_.add(scan.number, scan.stamp, scan.odometry);
  scan.odometry.points = {};
  return scan;
}

void
SlamPipeline::conclude()
{
  graph_.finish();
  result_.trajectory = graph_.trajectory();
  result_.odometry = graph_.odometry();
  const std::vector<Keyframe>& keyframes = graph_.keyframes();
  const auto scansOf = [&](const BetweenFactor& loop) {
    return std::make_pair(keyframes[loop.from].scan, keyframes[loop.to].scan);
  };
  for (const BetweenFactor& loop : graph_.loops())
    result_.loops.push_back(scansOf(loop));
  for (const HeldLoop& held : graph_.heldLoops())
    result_.held_loops.push_back(scansOf(held.loop));
}

void
SlamPipeline::collect(const TrackedScan& scan)
{
  noteWeakness(scan);
  last_collected_ = scan.number;
  ++collected_;
  if (!scan.fault.empty()) {
    result_.faults.push_back(scan.fault);
    return;
  }
  const OdometryResult& odometry = scan.odometry;
  if (odometry.match.converged)
    ++result_.tracked;
  result_.scans.push_back(scan.number);
  if (odometry.keyframe)
    result_.keyframes.push_back(scan.number);
}

void
SlamPipeline::noteWeakness(const TrackedScan& scan)
{
  WeakInterval weak{
      scan.number, scan.number, scan.stamp, scan.stamp, Weakness::Lost, 0};
  const MatchResult& match = scan.odometry.match;
  if (!scan.fault.empty())
    weak.weakness = Weakness::Unreadable;
  else if (scan.odometry.tracked) {
    if (!match.converged || match.degeneracy.unsupported == 0) // or the first scan
      return;
    weak.weakness = Weakness::Degenerate;
    weak.directions = match.degeneracy.unsupported;
  }
  addWeakScan(result_.weak, weak, last_collected_);
}

} // namespace nurbs
} // namespace pcl
