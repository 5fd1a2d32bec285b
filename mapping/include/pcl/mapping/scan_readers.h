// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/scan_source.h>

#include <memory>

namespace pcl {
namespace nurbs {

/** \brief What a data set does not say about itself, and what to do about its faults.
 * \ingroup mapping */
struct ScanReadOptions {
  /** Leave out what is missing or torn, name it in ScanSource::problems() and go on;
   * otherwise the first fault is an InputError. Only names, sizes and first bytes are
   * looked at when a source is opened: damage within a file shows when it is read. */
  bool skip_faults = false;
  /** Turn every point of a KITTI scan upwards by 0.205 degrees: the vertical angles of
   * the benchmark's calibration are that much too low (Deschaud, "IMLS-SLAM", ICRA
   * 2018). */
  bool correct_vertical_angles = false;
  /** Seconds between scans without times. */
  double period = 0.1;
  /** Poses instead of those of the layout (KITTI's format or TUM's), and times, one a
   * line, for poses or scans without; empty for the layout's own. */
  std::string poses_path;
  std::string times_path;
  /** Camera, depth per metre and .bin layout; a depth scale of 0 means the layout's. */
  CloudReadOptions cloud{{}, 0.0, false, 4};
};

/** \brief Open a sequence of the KITTI odometry benchmark.
 *
 * ROOT/sequences/NN/{velodyne/NNNNNN.bin, times.txt, calib.txt} and ROOT/poses/NN.txt.
 * A scan's number selects its line in times and poses; a number that is missing in
 * between is a fault, one after the last is not (parts of a sequence are common).
 * Without times.txt scans are one period apart. Poses are of the left camera; the truth
 * is that of the laser, see kitti_calibration.h, and needs calib.txt. Scans come with
 * the point times of point_times/ if that is there (simulated drives).
 * \throws InputError "FILE: reason" \throws std::invalid_argument when an option makes
 * no sense \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT std::unique_ptr<ScanSource>
openKittiOdometry(const std::string& root,
                  const std::string& sequence,
                  const ScanReadOptions& options = {});

/** \brief Open a drive of the KITTI raw data: DRIVE/velodyne_points/{data/N.bin,
 * timestamps.txt}; calib_velo_to_cam.txt in DRIVE or the folder above it.
 *
 * The truth is that of \a options (of the laser), or what the vehicle's own satellite
 * and inertial navigation says: DRIVE/oxts/data/N.txt, with calib_imu_to_velo.txt.
 * Stamps are seconds from the first time. Errors as above. */
PCL_NURBS_MAPPING_EXPORT std::unique_ptr<ScanSource>
openKittiRaw(const std::string& drive, const ScanReadOptions& options = {});

/** \brief Open a folder of depth images, in the layout of
 * - TUM RGB-D or ICL-NUIM: depth.txt (stamp file) or associations.txt (stamp file stamp
 *   file), and groundtruth.txt;
 * - Microsoft 7-Scenes: frame-N.depth.png, there or in frames/, and frame-N.pose.txt
 *   beside them, one period apart;
 * - Redwood or Open3D: depth/N.png and trajectory.log, one period apart.
 *
 * Each file is taken where it is found, whatever the others are. Poses of
 * groundtruth.txt are interpolated at the stamps between two that lie within 0.1 s; a
 * scan without such a pose is kept, without truth.
 *
 * The camera comes from the options, from intrinsics.txt (fx fy cx cy),
 * camera-intrinsics.txt (3 x 3) or camera.json, camera_primesense.json,
 * camera_intrinsic.json (Open3D), in this order, or is the one of readCloud(). Depths
 * per metre are 1000 for images named as in 7-Scenes and beside a trajectory.log, else
 * 5000, unless the options say otherwise; 0 and 65535 are no reading. Errors as above.
 */
PCL_NURBS_MAPPING_EXPORT std::unique_ptr<ScanSource>
openDepthSequence(const std::string& folder, const ScanReadOptions& options = {});

/** \brief Whether a folder holds what openDepthSequence() looks for. */
PCL_NURBS_MAPPING_EXPORT bool
isDepthFolder(const std::string& folder);

/** \brief Open a folder of .pcd, .ply and .bin clouds in the order of their names, with
 * poses.txt and times.txt beside them or in the folder above if they are there (one
 * line per cloud). Errors as above. */
PCL_NURBS_MAPPING_EXPORT std::unique_ptr<ScanSource>
openCloudFolder(const std::string& folder, const ScanReadOptions& options = {});

} // namespace nurbs
} // namespace pcl
