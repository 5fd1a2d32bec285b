// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/scan_source.h>
#include <pcl/registration/voxel_map.h>

#include <chrono>
#include <functional>

namespace pcl {
namespace nurbs {

/** \brief When the points of a scan were measured, for deskewing. */
enum class PointTiming {
  Source, /**< as the source says; all at once where it does not */
  None,   /**< all at once */
  Azimuth /**< by azimuth, see timesByAzimuth() */
};

/** \brief Which scans of a source are used, and when. */
struct ScanFeedOptions {
  std::size_t first = 0;  /**< number of the first scan */
  std::size_t count = 0;  /**< most scans, 0 for all */
  std::size_t stride = 1; /**< every so many-th scan */
  PointTiming timing = PointTiming::Source;
  /** Go on behind a scan that cannot be read; otherwise the first one is an InputError.
   */
  bool skip_faults = false;
  /** A scan is not there before its stamp, counted from that of the first one, and only
   * the latest is there: those that come while one is being read are skipped. */
  bool realtime = false;
};

/** \brief A scan with what odometry needs of it. */
struct ReadScan {
  std::size_t number = 0; /**< in its source */
  double stamp = 0.0;     /**< seconds */
  ScanPoints points;      /**< finite ones, in the sensor's frame */
  /** When each point was measured, seconds from \a stamp; empty for all at once. */
  std::vector<float> times;
  std::string fault; /**< why it could not be read ("FILE: reason"), else empty */
};

/** \brief The first stage of a pipeline: scans of a source, one after the other.
 *
 * Not to be called from several threads at a time. \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT ScanFeed {
public:
  /** Waits for a moment; false if the wait was cut short. */
  using Wait = std::function<bool(std::chrono::steady_clock::time_point)>;

  /** \param[in] source must outlive this object
   * \throws std::invalid_argument for a stride of 0 or no scan at \a first */
  ScanFeed(const ScanSource& source, const ScanFeedOptions& options);

  /** \brief Scans there are, faulty and skipped ones included. */
  std::size_t
  size() const;

  /** \brief Median time between the source's scans, seconds; 0 for a single scan. */
  double
  period() const
  {
    return period_;
  }

  /** \brief Wait until the next scan is there. \return false when none is left, or \a
   * wait was cut short */
  bool
  ready(const Wait& wait);

  /** \brief Read the next scan, which must be there. \throws InputError for one that
   * cannot be read, unless faults are skipped: then it comes without points */
  ReadScan
  next();

  /** \brief Scans that came too fast. */
  std::size_t
  skipped() const
  {
    return skipped_;
  }

private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point
  due(std::size_t number) const;

  ReadScan
  read(std::size_t number) const;

  const ScanSource& source_;
  ScanFeedOptions options_;
  double period_ = 0.0;
  std::size_t next_;
  std::size_t end_;
  Clock::time_point start_;
  bool started_ = false;
  std::size_t skipped_ = 0;
};

} // namespace nurbs
} // namespace pcl
