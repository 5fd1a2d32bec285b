// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/pipeline/scan_feed.h>
#include <pcl/registration/scan_preprocessing.h>

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Median time between scans, by the first hundred. */
double
medianPeriod(const ScanSource& source)
{
  constexpr std::size_t kMost = 100;
  std::vector<double> periods;
  for (std::size_t k = 1; k < std::min(source.size(), kMost); ++k)
    periods.push_back(source.stamp(k) - source.stamp(k - 1));
  if (periods.empty())
    return 0.0;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

} // namespace

ScanFeed::ScanFeed(const ScanSource& source, const ScanFeedOptions& options)
    : source_(source),
      options_(options),
      period_(medianPeriod(source)),
      next_(options.first),
      end_(source.size())
{
  if (options.stride == 0)
    throw std::invalid_argument("ScanFeed: the stride must be positive");
  if (options.first >= end_)
    throw std::invalid_argument("ScanFeed: there is no scan " +
                                std::to_string(options.first) + ", only " +
                                std::to_string(end_));
  const std::size_t left = (end_ - options.first - 1) / options.stride + 1;
  if (options.count > 0 && options.count < left)
    end_ = options.first + (options.count - 1) * options.stride + 1;
}

std::size_t
ScanFeed::size() const
{
  return (end_ - options_.first - 1) / options_.stride + 1;
}

ScanFeed::Clock::time_point
ScanFeed::due(std::size_t number) const
{
  const std::chrono::duration<double> since(source_.stamp(number) -
                                            source_.stamp(options_.first));
  return start_ + std::chrono::duration_cast<Clock::duration>(since);
}

bool
ScanFeed::ready(const Wait& wait)
{
  if (next_ >= end_)
    return false;
  if (!options_.realtime)
    return true;
  if (!started_)
    start_ = Clock::now();
  started_ = true;
  if (!wait(due(next_)))
    return false;
  const Clock::time_point now = Clock::now();
  for (; next_ + options_.stride < end_ && due(next_ + options_.stride) <= now;
       next_ += options_.stride)
    ++skipped_;
  return true;
}

ReadScan
ScanFeed::next()
{
  const std::size_t number = next_;
  next_ += options_.stride;
  try {
    return read(number);
  } catch (const InputError& error) {
    if (!options_.skip_faults)
      throw;
    ReadScan faulty;
    faulty.number = number;
    faulty.stamp = source_.stamp(number);
    faulty.fault = error.what();
    return faulty;
  }
}

ReadScan
ScanFeed::read(std::size_t number) const
{
  const Scan scan = source_.read(number);
  ReadScan result;
  result.number = number;
  result.stamp = scan.stamp;
  result.points.reserve(scan.cloud->size());
  const bool timed =
      options_.timing == PointTiming::Source && !scan.point_times.empty();
  for (std::size_t i = 0; i < scan.cloud->size(); ++i) {
    const auto point = (*scan.cloud)[i].getVector3fMap();
    if (!point.allFinite())
      continue;
    result.points.emplace_back(point);
    if (timed)
      result.times.push_back(scan.point_times[i]);
  }
  if (options_.timing == PointTiming::Azimuth) {
    result.times = timesByAzimuth(result.points);
    for (float& time : result.times) // the stamp is when the laser looks ahead
      time = (time - 0.5F) * static_cast<float>(period_);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
