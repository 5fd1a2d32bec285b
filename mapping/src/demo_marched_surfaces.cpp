// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "demo_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();

/** Walk along a ray by steps that cannot pass the surface. */
template <typename Clearance>
double
march(const Vector3d& origin,
      const Vector3d& ray,
      double along,
      double end,
      const Clearance& clearance)
{
  constexpr double kMet = 1e-10;
  constexpr int kMostSteps = 20000;
  for (int step = 0; step < kMostSteps && along < end; ++step) {
    const double free = clearance(origin + along * ray);
    if (free < kMet)
      return along;
    along += free;
  }
  return kNever;
}

/** A torus standing upright, its axis along y. */
class Arch : public DemoSurface {
public:
  Arch(std::string name, const Vector3d& center, double ring, double tube)
      : DemoSurface(std::move(name)), center_(center), ring_(ring), tube_(tube)
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    const double along = (center_ - origin).dot(ray);
    const double reach = ring_ + tube_;
    if ((center_ - origin - along * ray).norm() > reach)
      return kNever;
    return march(origin,
                 ray,
                 std::max(along - reach, 0.0),
                 along + reach,
                 [this](const Vector3d& point) { return distance(point); });
  }

  double
  distance(const Vector3d& point) const override
  {
    const Vector3d offset = point - center_;
    const double from_ring = std::hypot(offset.x(), offset.z()) - ring_;
    return std::abs(std::hypot(from_ring, offset.y()) - tube_);
  }

private:
  Vector3d center_;
  double ring_;
  double tube_;
};

/** x = middle + amplitude sin(2 pi y / length). */
class WavyWall : public DemoSurface {
public:
  WavyWall(std::string name, double middle, double amplitude, double length)
      : DemoSurface(std::move(name)),
        middle_(middle),
        amplitude_(amplitude),
        frequency_(2.0 * M_PI / length)
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    // Start where the ray enters the slab that holds the waves.
    const double side = middle_ > origin.x() ? -1.0 : 1.0;
    const double enter = (middle_ + side * amplitude_ - origin.x()) / ray.x();
    const double leave = (middle_ - side * amplitude_ - origin.x()) / ray.x();
    if (!(leave > 0.0))
      return kNever;
    const double steepest = std::hypot(1.0, amplitude_ * frequency_);
    return march(origin,
                 ray,
                 std::max(enter, 0.0),
                 leave + 1e-6,
                 [this, steepest](const Vector3d& point) {
                   return std::abs(point.x() - wave(point.y())) / steepest;
                 });
  }

  double
  distance(const Vector3d& point) const override
  {
    // The nearest place is no farther along y than the distance at this y.
    const double reach = std::abs(point.x() - wave(point.y()));
    constexpr int kStarts = 16;
    double best = reach;
    for (int i = 0; i <= kStarts; ++i)
      best = std::min(
          best, localDistance(point, point.y() + reach * (2.0 * i / kStarts - 1.0)));
    return best;
  }

private:
  double
  wave(double y) const
  {
    return middle_ + amplitude_ * std::sin(frequency_ * y);
  }

  /** Distance to the foot of the perpendicular near y, by Newton's method. */
  double
  localDistance(const Vector3d& point, double y) const
  {
    for (int round = 0; round < 20; ++round) {
      const double off = wave(y) - point.x();
      const double slope = amplitude_ * frequency_ * std::cos(frequency_ * y);
      const double bend = -frequency_ * frequency_ * (wave(y) - middle_);
      const double second = 1.0 + slope * slope + off * bend;
      if (!(second > 0.0))
        break;
      const double step = (off * slope + y - point.y()) / second;
      y -= step;
      if (std::abs(step) < 1e-13)
        break;
    }
    return std::hypot(wave(y) - point.x(), y - point.y());
  }

  double middle_;
  double amplitude_;
  double frequency_;
};

} // namespace

std::unique_ptr<DemoSurface>
makeArch(std::string name, const Vector3d& center, double ring, double tube)
{
  return std::make_unique<Arch>(std::move(name), center, ring, tube);
}

std::unique_ptr<DemoSurface>
makeWavyWall(std::string name, double middle, double amplitude, double length)
{
  return std::make_unique<WavyWall>(std::move(name), middle, amplitude, length);
}

} // namespace nurbs
} // namespace pcl
