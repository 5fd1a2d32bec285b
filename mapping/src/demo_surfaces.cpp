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
  surfaces.push_back(makeWavyWall("wavy wall", -1.3, 0.05, 0.9));
  surfaces.push_back(std::make_unique<Column>("column", Vector2d(-0.8, 2.55), 0.17));
  surfaces.push_back(std::make_unique<Sphere>("dome", Vector3d(0.62, 2.3, 0.0), 0.38));
  surfaces.push_back(makeArch("arch", Vector3d(0.1, 2.95, 0.0), 0.7, 0.09));
  addBox(surfaces, Vector3d(-0.3, 1.95, 0.0), Vector3d(0.24, 0.2, 0.16), 0.6);
  return surfaces;
}

} // namespace nurbs
} // namespace pcl
