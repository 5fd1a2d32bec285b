// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** Write a 16-bit grey PNG image. \throws std::runtime_error "cannot write PATH:
 * reason"
 */
void
writeDepthPng(const std::string& path,
              const std::vector<std::uint16_t>& pixels,
              std::uint32_t width);

} // namespace nurbs
} // namespace pcl
