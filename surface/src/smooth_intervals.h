// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The parts of a parameter domain between creases (knots of multiplicity >=
 * degree), where Newton's method may rely on continuous derivatives. */
class SmoothIntervals {
public:
  struct Interval {
    double low;
    double high;
  };

  /** \param[in] closed whether the end of the domain continues at its start */
  SmoothIntervals(const KnotVector& knots, bool closed) : closed_(closed)
  {
    const std::vector<double> breaks = knots.breaks();
    intervals_.push_back({breaks.front(), breaks.back()});
    for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
      const int continuity = knots.degree() - knots.multiplicity(breaks[i]);
      if (continuity == 1)
        curvature_is_continuous_ = false;
      if (continuity > 0)
        continue;
      // Evaluation at a knot belongs to the span above it, so the interval below ends
      // one representable number earlier.
      intervals_.back().high =
          std::nextafter(breaks[i], -std::numeric_limits<double>::infinity());
      intervals_.push_back({breaks[i], breaks.back()});
    }
  }

  bool
  closed() const
  {
    return closed_;
  }

  /** \brief Whether second derivatives are continuous inside of all intervals. */
  bool
  curvatureIsContinuous() const
  {
    return curvature_is_continuous_;
  }

  int
  count() const
  {
    return static_cast<int>(intervals_.size());
  }

  const Interval&
  operator[](int i) const
  {
    return intervals_[static_cast<std::size_t>(i)];
  }

  int
  find(double u) const
  {
    int i = count() - 1;
    while (i > 0 && u < intervals_[static_cast<std::size_t>(i)].low)
      --i;
    return i;
  }

private:
  bool closed_;
  bool curvature_is_continuous_ = true;
  std::vector<Interval> intervals_;
};

/** \brief One parameter during a descent: kept inside of its smooth interval, passed on
 * to the next one over a crease or a seam. */
class DescentParameter {
public:
  DescentParameter(const SmoothIntervals& intervals, double start)
      : intervals_(&intervals),
        value_(
            std::clamp(start, intervals[0].low, intervals[intervals.count() - 1].high)),
        index_(intervals.find(value_))
  {
  }

  double
  value() const
  {
    return value_;
  }

  bool
  curvatureIsContinuous() const
  {
    return intervals_->curvatureIsContinuous();
  }

  double
  length() const
  {
    return interval().high - interval().low;
  }

  double
  clamp(double value) const
  {
    return std::clamp(value, interval().low, interval().high);
  }

  void
  set(double value)
  {
    entered_ = 0;
    value_ = value;
  }

  /** \brief Whether descent along the negative \a slope leaves the interval. */
  bool
  blocked(double slope) const
  {
    return (slope > 0.0 && value_ <= interval().low) ||
           (slope < 0.0 && value_ >= interval().high);
  }

  /** \brief Continue in the neighbouring interval, unless descent there came back.
   * \return whether the parameter has changed */
  bool
  hop(double slope)
  {
    const int direction = slope < 0.0 ? 1 : -1;
    int next = index_ + direction;
    if (intervals_->closed())
      next = (next + intervals_->count()) % intervals_->count();
    if (direction == -entered_ || next < 0 || next >= intervals_->count())
      return false;
    index_ = next;
    entered_ = direction;
    value_ = direction > 0 ? interval().low : interval().high;
    return true;
  }

  bool
  atOpenEnd() const
  {
    const SmoothIntervals& all = *intervals_;
    return !all.closed() &&
           (value_ <= all[0].low || value_ >= all[all.count() - 1].high);
  }

private:
  const SmoothIntervals::Interval&
  interval() const
  {
    return (*intervals_)[index_];
  }

  const SmoothIntervals* intervals_;
  double value_;
  int index_;
  int entered_ = 0; // direction of the last hop while still where it led to
};

} // namespace nurbs
} // namespace pcl
