// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pose_error.h"

namespace pcl {
namespace nurbs {

/** What a measurement compares; in space, poses by the chord of the angle. */
ErrorModel
errorModelOf(const Measurement& measurement);

} // namespace nurbs
} // namespace pcl
