// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/surface_reconstruction.h>

#include <string>

namespace pcl_nurbs_tools {

/** What a picture of a reconstruction shows. */
struct PictureOptions {
  std::string shade = "patch"; /**< patch, normal, curvature or deviation */
  std::string view = "auto"; /**< auto, sensor, oblique, or six numbers: eye, target */
  bool points = false;       /**< draw the input points over it */
  int width = 1024;
  int height = 768;

  /** \throws ToolError(kUsage) naming the option that is wrong */
  void
  validate() const;
};

/** Draw a reconstruction to a PNG file.
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writePicture(const std::string& path,
             const pcl::nurbs::GridPoints& points,
             const pcl::nurbs::Reconstruction& reconstruction,
             const PictureOptions& options);

} // namespace pcl_nurbs_tools
