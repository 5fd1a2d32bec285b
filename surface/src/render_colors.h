// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_render.h>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Colour 0..255 of patch \a index: hues that differ most for neighbours in the
 * order. */
Eigen::Vector3f
patchColour(std::size_t index);

/** \brief Values to colours 0..255, from blue at the low to red at the high end; by way
 * of white at zero if the range has both signs. */
class ColourScale {
public:
  /** \brief Scale over a given range, or over the 2nd to 98th percentile of the finite
   * values; a range with both signs is made symmetric. */
  ColourScale(const std::vector<double>& values,
              const std::optional<std::pair<double, double>>& range);

  Eigen::Vector3f
  colour(double value) const;

  /** \brief Draw a bar with the numbers at its ends along the right border. */
  void
  drawBar(Image& image) const;

private:
  double low_ = 0.0;
  double high_ = 1.0;
};

} // namespace nurbs
} // namespace pcl
