// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/simulated_drive.h>

#include <functional>
#include <string>

namespace pcl {
namespace nurbs {

/** \brief Which part of a drive is written. */
struct DriveWriteOptions {
  std::size_t first = 0;
  std::size_t count = 0; /**< scans, 0 for all that follow */
  /** Number of the sequence in KITTI's layout. */
  std::string sequence = "00";
  /** Also write the surface of every point: labels/NNNNNN.label beside velodyne/,
   * 32-bit numbers, kind + 1 in the lower half and (object mod 65536) in the upper one.
   */
  bool labels = false;
  /** Called after each scan with the number written; false ends the drive there. */
  std::function<bool(std::size_t)> progress;
};

/** \brief Write a laser's drive in the layout of the KITTI odometry benchmark:
 * sequences/NN/{velodyne/NNNNNN.bin, times.txt, calib.txt} and poses/NN.txt, the poses
 * of the left camera as there.
 *
 * With motion distortion, point_times/NNNNNN.bin holds a float per point (seconds from
 * the stamp), which is no part of KITTI's layout. Scans are written one by one, points
 * without a return left out, beam by beam from the top; times and poses follow for as
 * many scans as were written, also when the disk is full in between or \a progress ends
 * the drive. \return number of scans written \throws std::invalid_argument when the
 * sensor is no laser or there are no such scans \throws std::runtime_error "cannot
 * write PATH: reason" \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT std::size_t
writeKittiDrive(const SimulatedDrive& drive,
                const std::string& folder,
                const DriveWriteOptions& options = {});

/** \brief Write a camera's drive in the layout of the TUM RGB-D benchmark:
 * depth/STAMP.png (16 bits, 5000 per metre, 0 = no reading), depth.txt,
 * groundtruth.txt, and intrinsics.txt (fx fy cx cy), which is no part of TUM's layout.
 * As writeKittiDrive(). \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT std::size_t
writeTumDrive(const SimulatedDrive& drive,
              const std::string& folder,
              const DriveWriteOptions& options = {});

} // namespace nurbs
} // namespace pcl
