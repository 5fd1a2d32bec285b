// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/beam_calibration.h>
#include <pcl/registration/motion_threshold.h>
#include <pcl/registration/scan_matching.h>

#include <functional>
#include <memory>
#include <optional>

namespace pcl {
namespace nurbs {

/** \brief Parameters of ScanOdometry; metres and radians.
 * \ingroup registration */
struct PCL_NURBS_REGISTRATION_EXPORT OdometryOptions {
  /** Points nearer or farther are dropped. */
  double min_range = 2.0;
  double max_range = 100.0;
  /** Rise of each point, for a laser whose calibration is off; see
   * correctVerticalAngle(). */
  double vertical_angle = 0.0;
  /** Undo the sensor's motion during a scan, where points have times. */
  bool deskew = true;
  /** Moment of the scan, 0 .. 1, that its pose is for. */
  double reference_time = 0.5;
  /** Learn, and take out, what the calibration of a turning laser left (z up in the
   * sensor's frame). Costs a laser without such errors a tenth of its accuracy. */
  bool calibrate_beams = true;
  /** What is expected of the beams, and how fast it is learnt. */
  BeamCalibrationOptions beams;
  /** Local map. */
  VoxelMapOptions map;
  /** One point of the scan per voxel of this size goes into the map ... */
  double map_spacing = 0.4;
  /** ... and one per voxel of this size is matched, but ... */
  double match_spacing = 0.8;
  /** ... no more than so many points, evenly chosen: leaves and grass have many that
   * add little. */
  std::size_t max_match_points = 4500;
  /** The first scans of a sparse laser (see isSparse()) are aligned with the planes of
   * a map whose voxels are so many times as large as suits the first one (see
   * suitableVoxelSize()), ... */
  double first_voxels = 1.5;
  /** ... until the sensor has gone so far, in those voxels; 0 for not at all. */
  double first_way = 12.0;
  /** Alignment; its maximal distance follows the motion. */
  MatchOptions match;
  MotionThresholdOptions threshold;
  /** A keyframe is made after so much way ... */
  double keyframe_distance = 5.0;
  /** ... or so much turning. */
  double keyframe_angle = 0.35;
  /** The result does not depend on it. */
  int threads = 2;

  /** \brief For turning lasers, in any surroundings (this is the default). */
  static OdometryOptions
  lidar();

  /** \brief For depth cameras in rooms. */
  static OdometryOptions
  rgbd();
};

/** \brief What became of a scan. */
struct OdometryResult {
  /** From the sensor's frame to that of the first scan. */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /** Whether the pose was measured; else it is the prediction. */
  bool tracked = false;
  /** Whether the prediction led to a doubtful place, so that others were tried. */
  bool searched = false;
  bool keyframe = false;
  /** Largest distance of pairs that was used. */
  double threshold = 0.0;
  /** The alignment: covariance, degeneracy, residuals. */
  MatchResult match;
  /** The scan, cropped, without the known errors of its beams, deskewed and thinned to
   * OdometryOptions::map_spacing, in the sensor's frame. */
  ScanPoints points;
};

/** \brief Tracks a range sensor by aligning each scan with a map of the last ones.
 *
 * Preprocessing, prediction with constant velocity, alignment (matchScan()) with pairs
 * no farther apart than the prediction was off lately, and insertion into a local map
 * that forgets what is out of range: the pipeline of KISS-ICP (Vizzo et al., RA-L 2023)
 * with planes where there are planes. Scans that cannot be aligned leave the map as it
 * is and the sensor on its predicted way; after several of those the map is begun anew
 * there.
 *
 * A sparse laser's rings go along with it. A young map consists of nothing else, so
 * that each scan fits best where the sensor moves as it seemed to before: a slope that
 * changes is not seen, and the map is bent by it. Its first scans are therefore aligned
 * with planes so large that a single scan knows them.
 *
 * Not to be called from several threads at a time.
 * \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT ScanOdometry {
public:
  /** \brief Says whether a tracked scan shall be a keyframe, given the motion since the
   * last one. */
  using KeyframeDecision =
      std::function<bool(const OdometryResult&, const Eigen::Isometry3d& since_last)>;

  /** \throws std::invalid_argument when an option makes no sense */
  explicit ScanOdometry(const OdometryOptions& options = OdometryOptions::lidar());

  ~ScanOdometry();

  /** \brief Replace the decision by way and angle. */
  void
  setKeyframeDecision(KeyframeDecision decision);

  /** \brief Process the next scan.
   * \param[in] points in the sensor's frame; those that are not finite are dropped
   * \param[in] times of the points within the scan, 0 .. 1; empty when it needs no
   * deskewing
   * \param[in] interval time since the scan before, in the unit of \a times: 1 when
   * scans follow each other, 2 when one was left out. The sensor is predicted to go on
   * as fast as before, for ten units at most.
   * \throws std::invalid_argument when there are times, but not one per point, or for an
   * interval that is negative or no number */
  OdometryResult
  process(const ScanPoints& points,
          const std::vector<float>& times = {},
          double interval = 1.0);

  /** \brief Points of the local map, in the frame of the first scan. */
  std::vector<Eigen::Vector3d>
  localMap() const;

  /** \brief What has been learnt about the sensor's beams. */
  const BeamCalibration&
  beamCalibration() const
  {
    return calibration_;
  }

private:
  /** How the points of a thinned scan were measured, before they were deskewed. */
  struct Readings {
    ScanPoints points; // these and their beams are empty when beams are not calibrated
    std::vector<BeamCalibration::Beam> beams;
    bool sparse = false; // see isSparse(); asked only where a map may begin
  };

  ScanPoints
  prepare(const ScanPoints& points,
          const std::vector<float>& times,
          Readings& readings) const;

  void
  track(double interval, const Readings& readings, OdometryResult& result);

  /** The map that scans are aligned with now. */
  const VoxelMap&
  target() const
  {
    return first_map_ ? *first_map_ : map_;
  }

  void
  clearMap();

  /** Whether the next scan may be the first one of a map. */
  bool
  mayBegin() const;

  /** Begin the map of the first scans where that is needed, and end it. */
  void
  updateFirstMap(const OdometryResult& result, bool sparse);

  void
  insert(const OdometryResult& result, bool sparse);

  bool
  isKeyframe(const OdometryResult& result) const;

  void
  decideKeyframe(OdometryResult& result);

  OdometryOptions options_;
  KeyframeDecision decision_; // by way and angle if there is none
  VoxelMap map_;
  std::optional<VoxelMap> first_map_;
  double first_way_ = 0.0; // since it was begun, metres
  BeamCalibration calibration_;
  MotionThreshold threshold_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d velocity_ = Eigen::Isometry3d::Identity(); // per unit of time
  Eigen::Isometry3d keyframe_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d pruned_at_ = Eigen::Vector3d::Zero();
  bool any_keyframe_ = false;
  /** Share of a scan that lies on the map, lately; 0 before anything is known. */
  double usual_share_ = 0.0;
  int lost_ = 0;
};

} // namespace nurbs
} // namespace pcl
