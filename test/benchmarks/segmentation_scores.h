// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

using LabelImage = std::vector<std::uint32_t>;

/** Counts of Hoover et al., "An Experimental Comparison of Range Image Segmentation
 * Algorithms", IEEE TPAMI 18(7), 1996. */
struct RegionCounts {
  int truth = 0;   /**< regions of the ground truth */
  int correct = 0; /**< pairs that cover each other by the tolerance */
  int over = 0;    /**< true regions that several found ones make up */
  int under = 0;   /**< found regions that cover several true ones */
  int missed = 0;  /**< true regions in none of these */
  int noise = 0;   /**< found regions in none of these */
};

/** How well labels agree with the truth; shares of 0 to 1. */
struct Scores {
  RegionCounts regions;
  double boundary_recall = 0.0;   /**< true border cells with a found border near by */
  double undersegmentation = 0.0; /**< cells of found regions on the smaller side of a
                                     true border, and cells without a label */
  double accuracy = 0.0; /**< achievable: each found region labelled with the true one
                            it covers most of */
};

/** Compare labels of a raster; cells without a true label do not count.
 * \param[in] width cells per row
 * \param[in] truth true label of each cell, 0 for none
 * \param[in] found found label of each cell, 0 for none
 * \param[in] tolerance share by which regions of a correct pair cover each other
 * \param[in] least smaller true and found regions are left out (cells) */
Scores
compare(std::size_t width,
        const LabelImage& truth,
        const LabelImage& found,
        double tolerance,
        std::size_t least);

} // namespace bench
} // namespace nurbs
} // namespace pcl
