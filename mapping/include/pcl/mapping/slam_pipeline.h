// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/keyframe_graph.h>
#include <pcl/mapping/pipeline/scan_feed.h>
#include <pcl/mapping/pipeline/stage_threads.h>
#include <pcl/mapping/pipeline/weak_intervals.h>
#include <pcl/mapping/scan_source.h>
#include <pcl/registration/scan_odometry.h>

#include <functional>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How a drive is turned into a trajectory. */
struct SlamOptions {
  OdometryOptions odometry;
  ScanFeedOptions feed;
  KeyframeGraphOptions graph;
  /** Whether places are looked for where the drive comes back to, and how. */
  bool close_loops = true;
  ProximityLoopOptions loops;
  /** Scans that may wait between two stages. */
  std::size_t queue_capacity = 2;
};

/** \brief What a drive was turned into. */
struct SlamResult {
  /** Poses of the sensor in its frame at the first scan, by time, after the pose graph;
   * one per scan that was used. */
  Trajectory trajectory;
  /** The same by odometry alone. */
  Trajectory odometry;
  /** Number of the scan of each pose. */
  std::vector<std::size_t> scans;
  /** Numbers of the scans that became keyframes. */
  std::vector<std::size_t> keyframes;
  /** Places that the drive came back to, by numbers of scans: earlier, later. */
  std::vector<std::pair<std::size_t, std::size_t>> loops;
  /** Loops that were proposed but contradict the graph, and are not part of it. */
  std::vector<std::pair<std::size_t, std::size_t>> held_loops;
  /** Scans after the first one that were aligned. */
  std::size_t tracked = 0;
  /** Scans left out because the sensor was faster. */
  std::size_t skipped = 0;
  /** Why scans could not be read and were left out, "FILE: reason". */
  std::vector<std::string> faults;
  /** Where poses are less sure, by time. */
  std::vector<WeakInterval> weak;
  std::vector<StageTimes> stages;
  double seconds = 0.0; /**< of the whole run */
};

/** \brief A drive's scans become a trajectory: stages in threads of their own, joined
 * by bounded queues.
 *
 * (1) "read" reads and prepares scans, (2) "odometry" aligns each with the last ones,
 * (3) "graph" adds keyframes to the pose graph, closes loops and optimises, (4)
 * "output" collects the results. Without ScanFeedOptions::realtime no scan is left
 * out, and the result has the same bits for any number of threads. Memory does not grow
 * with the drive but by its poses and, as long as loops are closed, the thinned points
 * of its keyframes.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT SlamPipeline {
public:
  /** Told after each scan how many of how many are done, in a thread of the pipeline;
   * false ends the drive there. */
  using Progress = std::function<bool(std::size_t done, std::size_t all)>;

  /** \param[in] source must outlive this object
   * \throws std::invalid_argument for options that make no sense */
  SlamPipeline(const ScanSource& source, const SlamOptions& options);

  void
  setProgress(Progress progress)
  {
    progress_ = std::move(progress);
  }

  /** \brief Process the drive; once. result() then holds what was done, also when this
   * throws. \throws InputError for a scan that cannot be read, and what else a stage
   * threw */
  void
  run();

  /** \brief Use another detector of loops; before run(). */
  void
  setLoopDetector(std::unique_ptr<LoopDetector> detector);

  /** \brief The pose graph, its keyframes and scans; after run(). */
  const KeyframeGraph&
  keyframeGraph() const
  {
    return graph_;
  }

  /** \brief What has been done; after run(). */
  const SlamResult&
  result() const
  {
    return result_;
  }

private:
  /** A scan's way through the stages behind odometry. */
  struct TrackedScan {
    std::size_t number = 0;
    double stamp = 0.0;
    std::string fault;
    OdometryResult odometry;
  };

  TrackedScan
  track(const ReadScan& scan);

  /** Add a scan to the graph, which keeps what is needed of its points. */
  TrackedScan
  addToGraph(TrackedScan scan);

  /** Fill in what is known at the end. */
  void
  conclude();

  void
  collect(const TrackedScan& scan);

  void
  noteWeakness(const TrackedScan& scan);

  SlamOptions options_;
  ScanFeed feed_;
  ScanOdometry odometry_;
  KeyframeGraph graph_;
  Progress progress_;
  std::optional<double> last_stamp_;
  std::size_t collected_ = 0;
  std::size_t last_collected_ = 0;
  SlamResult result_;
};

} // namespace nurbs
} // namespace pcl
