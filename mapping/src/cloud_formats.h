// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "input_file.h"

namespace pcl {
namespace nurbs {

/** Points before an offset is taken off, in the precision of the file. */
struct RawCloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<float> intensity;
  std::vector<std::uint32_t> rgb;
  std::uint32_t width = 0;
  std::uint32_t height = 1;
};

RawCloud
readPcd(const InputFile& file);

RawCloud
readPly(const InputFile& file);

RawCloud
readBin(const InputFile& file, int values_per_point);

/** Points of a depth image in the camera's frame; pixels without a reading are NaN.
 * Intrinsics that are not given are filled in. */
RawCloud
readDepthPng(const InputFile& file,
             const CloudReadOptions& options,
             PinholeIntrinsics& intrinsics);

} // namespace nurbs
} // namespace pcl
