// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>
#include <pcl/registration/voxel_map.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A place of the drive with what was seen there.
 * \ingroup mapping */
struct Keyframe {
  NodeId node = 0;      /**< in the pose graph */
  std::size_t scan = 0; /**< number of its scan */
  double way = 0.0;     /**< driven until there, metres */
  /** By odometry: right relative to keyframes nearby, adrift from others. */
  Eigen::Isometry3d T_odometry_keyframe = Eigen::Isometry3d::Identity();
  /** Points of its scan and those until the next keyframe, in its frame, thinned. */
  ScanPoints points;
};

/** \brief Finds places where a drive comes back to: proposes factors of the pose graph.
 *
 * To add another method, derive from this class and hand it to KeyframeGraph.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT LoopDetector {
public:
  virtual ~LoopDetector();

  /** \brief Look for loops; called once for each keyframe, when its points are
   * complete.
   * \param[in] keyframes all so far; the last one is the new one
   * \param[in] graph their current poses
   * \return factors between earlier keyframes and the new one, or others that are now
   * sure; each once. A wrong one bends the whole map, one less only leaves drift. */
  virtual std::vector<BetweenFactor>
  detect(const std::vector<Keyframe>& keyframes, const PoseGraph& graph) = 0;
};

/** \brief Parameters of ProximityLoopDetector; metres and radians. */
struct ProximityLoopOptions {
  /** A loop is at least so long. */
  double min_way = 40.0;
  /** A keyframe within this distance is a candidate ... */
  double min_reach = 5.0;
  /** ... or within this share of the way since then, as far as drift may go ... */
  double drift_share = 0.02;
  /** ... but not farther than this. */
  double max_reach = 20.0;
  /** Voxels of the target of the final alignment; the first one's are four times that
   * large. */
  double voxel_size = 0.5;
  /** Least share of points within a voxel's size of the target. */
  double min_overlap = 0.7;
  /** Largest root mean square residual, as a share of a voxel. */
  double max_rmse_share = 0.4;
  /** Two loops confirm each other if the way around both ends nearer than this to where
   * it began ... */
  double max_cycle_distance = 0.5;
  double max_cycle_angle = 0.05;
  /** ... and their keyframes are no more than so many apart. */
  std::size_t max_cycle_keyframes = 6;
  /** Standard deviations that every loop has at least. */
  double min_sigma_translation = 0.03;
  double min_sigma_rotation = 0.002;
  int threads = 1;
};

/** \brief Proposes keyframes that are near by the estimated poses, and verifies them by
 * registration.
 *
 * The points of a keyframe are aligned with those around the candidate, coarse to fine.
 * A loop is accepted when the alignment converges, holds the pose in all directions and
 * covers most points, and when a second such loop nearby confirms it (Mangelson et al.,
 * Pairwise consistent measurement set maximization, ICRA 2018, for pairs).
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT ProximityLoopDetector : public LoopDetector {
public:
  explicit ProximityLoopDetector(const ProximityLoopOptions& options = {})
      : options_(options)
  {
  }

  std::vector<BetweenFactor>
  detect(const std::vector<Keyframe>& keyframes, const PoseGraph& graph) override;

private:
  /** A verified loop by the places of its keyframes in the list. */
  struct Candidate {
    std::size_t from = 0;
    std::size_t to = 0;
    BetweenFactor factor;
    bool returned = false;
  };

  std::optional<std::size_t>
  nearest(const std::vector<Keyframe>& keyframes, const PoseGraph& graph) const;

  std::optional<Candidate>
  verify(const std::vector<Keyframe>& keyframes,
         std::size_t from,
         const Eigen::Isometry3d& guess) const;

  bool
  consistent(const std::vector<Keyframe>& keyframes,
             const Candidate& a,
             const Candidate& b) const;

  ProximityLoopOptions options_;
  std::vector<Candidate> recent_;
};

} // namespace nurbs
} // namespace pcl
