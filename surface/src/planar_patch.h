// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "bezier_extraction.h"

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

// A Bézier piece in ray coordinates maps its parameters to the plane across the ray by
// its first two components; the ray meets it where both vanish.

/** \brief Whether that map is provably one-to-one: the cross products of all
 * differences in u with all differences in v, whose hulls hold the derivatives, have
 * one sign. */
bool
isInjective(const BezierPatch& patch);

/** \brief Rotation of the first two components along the longest diagonal of a piece:
 * seen along a ray that grazes it a piece is a thin strip, which only a box along the
 * strip tells from the ray. */
Eigen::Matrix3d
thinFrame(const BezierPatch& patch);

} // namespace nurbs
} // namespace pcl
