// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Renumber labels 1..count by decreasing size; equal sizes keep their order. */
void
orderBySize(std::uint32_t count, std::vector<std::uint32_t>& labels);

} // namespace nurbs
} // namespace pcl
