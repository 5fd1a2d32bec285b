// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/scan_source.h>

namespace pcl {
namespace nurbs {

ScanSource::~ScanSource() = default;

} // namespace nurbs
} // namespace pcl
