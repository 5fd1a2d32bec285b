// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Why a pose is less sure than others. */
enum class Weakness {
  Lost,       /**< the scan could not be aligned: the pose is a prediction */
  Degenerate, /**< the surroundings do not hold the sensor in some direction */
  Unreadable  /**< the scan was damaged and left out */
};

/** \brief Scans in a row with the same weakness. */
struct WeakInterval {
  std::size_t first = 0; /**< number of the first scan */
  std::size_t last = 0;  /**< number of the last scan */
  double from = 0.0;     /**< stamp of the first, seconds */
  double to = 0.0;       /**< stamp of the last, seconds */
  Weakness weakness = Weakness::Lost;
  int directions = 0; /**< most without support at a time, of six */
};

/** \brief Add a scan with a weakness to intervals, in the order of the drive.
 * \param[in,out] intervals the last one grows where it fits
 * \param[in] scan its only scan; \a first and \a last are the same
 * \param[in] previous number of the scan that was processed before it */
PCL_NURBS_MAPPING_EXPORT void
addWeakScan(std::vector<WeakInterval>& intervals,
            const WeakInterval& scan,
            std::size_t previous);

} // namespace nurbs
} // namespace pcl
