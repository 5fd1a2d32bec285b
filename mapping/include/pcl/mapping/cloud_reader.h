// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/segmentation/grid_geometry.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief An input file cannot be used; what() reads "FILE: reason".
 * \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT InputError : public std::runtime_error {
public:
  InputError(const std::string& file, const std::string& reason)
      : std::runtime_error(file + ": " + reason)
  {
  }
};

/** \brief Kind of file a cloud was read from. */
enum class CloudKind { pcd, ply, kitti_bin, depth_png };

/** \brief What a file does not say about itself.
 * \ingroup mapping
 */
struct CloudReadOptions {
  /** Camera of a depth image; without it a camera of 525 pixels focal length for 640
   * columns, centred. */
  std::optional<PinholeIntrinsics> intrinsics;
  /** Stored depth per metre. */
  double depth_scale = 1000.0;
  /** Depth images of the SUN RGB-D data set hold their bits rotated left by three. */
  bool rotated_depth_bits = false;
  /** Floats per point of a .bin file: 4 (x y z reflectance) or 3. */
  int bin_values_per_point = 4;
  /** Larger files are refused (bytes). */
  std::size_t max_file_size = std::size_t{4} << 30U;
};

/** \brief A cloud as it was read.
 * \ingroup mapping
 */
struct InputCloud {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;
  CloudKind kind = CloudKind::pcd;
  /** Camera of a depth image. */
  std::optional<PinholeIntrinsics> intrinsics;
  /** What was subtracted from all points because the coordinates (of a map projection,
   * say) were too large for single precision; zero otherwise. */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  /** Reflectance per point, when the file has it. */
  std::vector<float> intensity;
  /** Colour per point as 0x00RRGGBB, when the file has it. */
  std::vector<std::uint32_t> rgb;
};

/** \brief Read a cloud: .pcd (ascii, binary, binary_compressed), .ply (ascii and both
 * binary byte orders), KITTI .bin, or a 16-bit depth .png (0 and 65535 = no reading).
 *
 * Every byte of the file is untrusted: counts are checked against the size of the file
 * before anything is allocated, and what is wrong is said in one line. The whole file
 * is held in memory while it is read.
 * \param[in] path file; its extension names its kind
 * \param[in] options what the file does not say
 * \return the cloud, with at least one point; organized when the file says so
 * \throws InputError when the file cannot be read, is damaged or is of another kind
 * \throws std::invalid_argument when an option makes no sense */
PCL_NURBS_MAPPING_EXPORT InputCloud
readCloud(const std::string& path, const CloudReadOptions& options = {});

} // namespace nurbs
} // namespace pcl
