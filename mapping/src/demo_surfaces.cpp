// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "demo_surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNear = 1e-6;

/** Smallest root beyond the near limit of a x^2 + 2 b x + c. */
double
firstRoot(double a, double b, double c)
{
  const double square = b * b - a * c;
  if (!(a > 0.0) || square < 0.0)
    return kNever;
  const double root = std::sqrt(square);
  const double entry = (-b - root) / a;
  const double exit = (-b + root) / a;
  return entry > kNear ? entry : exit > kNear ? exit : kNever;
}

class Plane : public DemoSurface {
public:
  Plane(std::string name, const Vector3d& normal, double offset)
      : DemoSurface(std::move(name)), normal_(normal), offset_(offset)
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    const double along = (offset_ - normal_.dot(origin)) / normal_.dot(ray);
    return along > kNear ? along : kNever;
  }

  double
  distance(const Vector3d& point) const override
  {
    return std::abs(normal_.dot(point) - offset_);
  }

private:
  Vector3d normal_;
  double offset_;
};

/** A face of a box: the points center + s a + t b with |s|, |t| <= 1. */
class Rectangle : public DemoSurface {
public:
  Rectangle(std::string name,
            const Vector3d& center,
            const Vector3d& a,
            const Vector3d& b)
      : DemoSurface(std::move(name)),
        center_(center),
        a_(a),
        b_(b),
        normal_(a.cross(b).normalized())
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    const double along = normal_.dot(center_ - origin) / normal_.dot(ray);
    const Vector2d where = local(origin + along * ray);
    return along > kNear && where.cwiseAbs().maxCoeff() <= 1.0 ? along : kNever;
  }

  double
  distance(const Vector3d& point) const override
  {
    const Vector2d inside = local(point).cwiseMin(1.0).cwiseMax(-1.0);
    return (point - center_ - inside.x() * a_ - inside.y() * b_).norm();
  }

private:
  Vector2d
  local(const Vector3d& point) const
  {
    const Vector3d offset = point - center_;
    return {offset.dot(a_) / a_.squaredNorm(), offset.dot(b_) / b_.squaredNorm()};
  }

  Vector3d center_;
  Vector3d a_;
  Vector3d b_;
  Vector3d normal_;
};

class Sphere : public DemoSurface {
public:
  Sphere(std::string name, const Vector3d& center, double radius)
      : DemoSurface(std::move(name)), center_(center), radius_(radius)
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    const Vector3d offset = origin - center_;
    return firstRoot(1.0, offset.dot(ray), offset.squaredNorm() - radius_ * radius_);
  }

  double
  distance(const Vector3d& point) const override
  {
    return std::abs((point - center_).norm() - radius_);
  }

private:
  Vector3d center_;
  double radius_;
};

/** Endless vertical cylinder. */
class Column : public DemoSurface {
public:
  Column(std::string name, const Vector2d& foot, double radius)
      : DemoSurface(std::move(name)), foot_(foot), radius_(radius)
  {
  }

  double
  cast(const Vector3d& origin, const Vector3d& ray) const override
  {
    const Vector2d offset = origin.head<2>() - foot_;
    const Vector2d across = ray.head<2>();
    return firstRoot(across.squaredNorm(),
                     offset.dot(across),
                     offset.squaredNorm() - radius_ * radius_);
  }

  double
  distance(const Vector3d& point) const override
  {
    return std::abs((point.head<2>() - foot_).norm() - radius_);
  }

private:
  Vector2d foot_;
  double radius_;
};

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
      return along > kNear ? along : kNever;
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
    constexpr int kStarts = 64;
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
      y -= (off * slope + y - point.y()) / second;
    }
    return std::hypot(wave(y) - point.x(), y - point.y());
  }

  double middle_;
  double amplitude_;
  double frequency_;
};

void
addBox(std::vector<std::unique_ptr<DemoSurface>>& surfaces,
       const Vector3d& foot,
       const Vector3d& half,
       double turn)
{
  const Vector3d a = half.x() * Vector3d(std::cos(turn), std::sin(turn), 0.0);
  const Vector3d b = half.y() * Vector3d(-std::sin(turn), std::cos(turn), 0.0);
  const Vector3d c = half.z() * Vector3d::UnitZ();
  const Vector3d center = foot + c;
  const auto face =
      [&](const char* name, const Vector3d& out, const Vector3d& s, const Vector3d& t) {
        surfaces.push_back(std::make_unique<Rectangle>(name, center + out, s, t));
      };
  face("box top", c, a, b);
  face("box front", -b, a, c);
  face("box left", -a, b, c);
  face("box right", a, b, c);
  face("box back", b, a, c);
}

} // namespace

std::vector<std::unique_ptr<DemoSurface>>
makeDemoSurfaces()
{
  std::vector<std::unique_ptr<DemoSurface>> surfaces;
  surfaces.push_back(std::make_unique<Plane>("floor", Vector3d::UnitZ(), 0.0));
  surfaces.push_back(std::make_unique<Plane>("back wall", Vector3d::UnitY(), 3.4));
  surfaces.push_back(std::make_unique<Plane>("right wall", Vector3d::UnitX(), 1.25));
  surfaces.push_back(std::make_unique<WavyWall>("wavy wall", -1.3, 0.05, 0.9));
  surfaces.push_back(std::make_unique<Column>("column", Vector2d(-0.8, 2.55), 0.17));
  surfaces.push_back(std::make_unique<Sphere>("dome", Vector3d(0.62, 2.3, 0.0), 0.38));
  surfaces.push_back(
      std::make_unique<Arch>("arch", Vector3d(0.1, 2.95, 0.0), 0.7, 0.09));
  addBox(surfaces, Vector3d(-0.3, 1.95, 0.0), Vector3d(0.24, 0.2, 0.16), 0.6);
  return surfaces;
}

} // namespace nurbs
} // namespace pcl
