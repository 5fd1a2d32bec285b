// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/constructions.h>

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** \a count parameters spread over the spans, ends of the domain included. */
std::vector<double>
sectionParameters(const KnotVector& knots, int count)
{
  const std::vector<double> breaks = knots.breaks();
  const int spans = static_cast<int>(breaks.size()) - 1;
  std::vector<double> parameters;
  for (int k = 0; k < count; ++k) {
    const double position = static_cast<double>(k) * spans / (count - 1);
    const int span = std::min(static_cast<int>(position), spans - 1);
    parameters.push_back(breaks[span] +
                         (breaks[span + 1] - breaks[span]) * (position - span));
  }
  return parameters;
}

/** Origin on the trajectory, z axis along its tangent. */
Eigen::Isometry3d
tangentFrame(const NurbsCurve3& trajectory, double v)
{
  const std::vector<Eigen::Vector3d> d = trajectory.derivatives(v, 1);
  if (!(d[1].norm() > 0.0))
    throw std::domain_error("sweptSurface: the trajectory has no tangent");
  return frameFromAxis(d[0], d[1]);
}

/** Reflection that swaps the ends of \a difference. */
Eigen::Matrix3d
reflection(const Eigen::Vector3d& difference)
{
  const double squared = difference.squaredNorm();
  if (!(squared > 0.0))
    return Eigen::Matrix3d::Identity();
  return Eigen::Matrix3d::Identity() -
         (2.0 / squared) * difference * difference.transpose();
}

/** The frame \a from carried to the place and tangent of \a to with as little turning
 * about the tangent as possible: two reflections (Wang, Jüttler, Zheng, Liu:
 * Computation of rotation minimizing frames, 2008). */
Eigen::Isometry3d
carried(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to)
{
  const Eigen::Matrix3d first = reflection(to.translation() - from.translation());
  const Eigen::Vector3d tangent = first * from.linear().col(2);
  Eigen::Isometry3d result = to;
  result.linear() = reflection(to.linear().col(2) - tangent) * first * from.linear();
  return result;
}

} // namespace

NurbsSurface
sweptSurface(const NurbsCurve3& profile, const NurbsCurve3& trajectory, int sections)
{
  if (sections < 2)
    throw std::invalid_argument("sweptSurface: needs at least two sections");
  const std::vector<double> parameters =
      sectionParameters(trajectory.knots(), sections);
  const Eigen::Isometry3d start = tangentFrame(trajectory, parameters.front());
  Eigen::Isometry3d frame = start;
  std::vector<NurbsCurve3> copies{profile};
  for (int k = 1; k < sections; ++k) {
    frame = carried(frame, tangentFrame(trajectory, parameters[k]));
    copies.push_back(profile.transformed(frame * start.inverse()));
  }
  return loftedSurface(copies, std::min(3, sections - 1), parameters);
}

} // namespace nurbs
} // namespace pcl
