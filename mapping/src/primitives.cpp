// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/primitives.h>

#include "polynomial_roots.h"

#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();

/** A ray in a primitive's frame, counted from its point nearest to the frame's origin:
 * squares of large distances would cost digits. */
struct LocalBeam {
  LocalBeam(const Eigen::Isometry3d& frame, const Beam& ray)
      : direction(frame.linear().transpose() * ray.direction)
  {
    const Vector3d start =
        frame.linear().transpose() * (ray.origin - frame.translation());
    shift = -start.dot(direction);
    origin = start + shift * direction;
  }

  Vector3d
  at(double t) const
  {
    return origin + t * direction;
  }

  Vector3d origin;
  Vector3d direction;
  double shift = 0.0; /**< what is to be added to t to get the ray's distance */
};

bool
inSweep(const AngleRange& sweep, double x, double y)
{
  constexpr double kTurn = 2.0 * M_PI;
  if (sweep.sweep() >= kTurn - 1e-12)
    return true;
  const double beyond = std::atan2(y, x) - sweep.first;
  return beyond - kTurn * std::floor(beyond / kTurn) <= sweep.sweep();
}

/** The nearer root of a t^2 + 2 b t + c that \a accept takes, as a distance. */
template <typename Accept>
double
firstOfQuadratic(double a, double b, double c, const Accept& accept)
{
  const double square = b * b - a * c;
  if (!(square >= 0.0))
    return kNever;
  // Citardauq: no difference of nearly equal numbers.
  const double q = -(b + std::copysign(std::sqrt(square), b));
  const double one = a != 0.0 ? q / a : kNever;
  const double other = q != 0.0 ? c / q : one;
  const double first = accept(std::min(one, other));
  return first < kNever ? first : accept(std::max(one, other));
}

/** t as a distance if it lies between the limits and the point is part of the surface.
 */
template <typename Inside>
double
accepted(const LocalBeam& ray, double t, double near, double far, const Inside& inside)
{
  const double distance = t + ray.shift;
  return distance > near && distance < far && inside(ray.at(t)) ? distance : kNever;
}

bool
isInside(const PlanePatch& patch, double x, double y)
{
  if (patch.outline == PlanePatch::Outline::Disc)
    return x * x + y * y <= patch.size_x * patch.size_x;
  if (!(x >= 0.0 && x <= patch.size_x && y >= 0.0 && y <= patch.size_y))
    return false;
  if (patch.outline == PlanePatch::Outline::Gable)
    return y <= patch.size_y * (1.0 - std::abs(2.0 * x / patch.size_x - 1.0));
  return !patch.openings.contains(x, y);
}

double
meet(const PlanePatch& patch, const Beam& ray, double near, double far)
{
  const Vector3d normal = patch.frame.linear().col(2);
  const double distance =
      normal.dot(patch.frame.translation() - ray.origin) / normal.dot(ray.direction);
  if (!(distance > near && distance < far))
    return kNever;
  const Vector3d offset = ray.at(distance) - patch.frame.translation();
  return isInside(patch,
                  offset.dot(patch.frame.linear().col(0)),
                  offset.dot(patch.frame.linear().col(1)))
             ? distance
             : kNever;
}

double
meet(const FrustumPatch& patch, const Beam& ray, double near, double far)
{
  const LocalBeam local(patch.frame, ray);
  const Vector3d& o = local.origin;
  const Vector3d& d = local.direction;
  const double slope = (patch.radius_top - patch.radius_bottom) / patch.height;
  const double radius = patch.radius_bottom + slope * o.z();
  const auto inside = [&](const Vector3d& p) {
    return p.z() >= 0.0 && p.z() <= patch.height && inSweep(patch.sweep, p.x(), p.y());
  };
  return firstOfQuadratic(
      d.x() * d.x() + d.y() * d.y() - slope * slope * d.z() * d.z(),
      o.x() * d.x() + o.y() * d.y() - slope * d.z() * radius,
      o.x() * o.x() + o.y() * o.y() - radius * radius,
      [&](double t) { return accepted(local, t, near, far, inside); });
}

double
meet(const SpherePatch& patch, const Beam& ray, double near, double far)
{
  const LocalBeam local(patch.frame, ray);
  const double low = patch.radius * std::sin(patch.latitude.first);
  const double high = patch.radius * std::sin(patch.latitude.last);
  const auto inside = [&](const Vector3d& p) { return p.z() >= low && p.z() <= high; };
  return firstOfQuadratic(
      1.0,
      0.0, // the origin is the nearest point to the centre
      local.origin.squaredNorm() - patch.radius * patch.radius,
      [&](double t) { return accepted(local, t, near, far, inside); });
}

double
meet(const TorusPatch& patch, const Beam& ray, double near, double far)
{
  const LocalBeam local(patch.frame, ray);
  const Vector3d& o = local.origin;
  const Vector3d& d = local.direction;
  const double major = patch.radius_major;
  const double reach = major + patch.radius_minor;
  const double room = reach * reach - o.squaredNorm();
  if (!(room > 0.0))
    return kNever;
  // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2), and |p|^2 = |o|^2 + t^2.
  const double k =
      o.squaredNorm() + major * major - patch.radius_minor * patch.radius_minor;
  const double m = 4.0 * major * major;
  Polynomial quartic;
  quartic.degree = 4;
  quartic.c = {k * k - m * (o.x() * o.x() + o.y() * o.y()),
               -2.0 * m * (o.x() * d.x() + o.y() * d.y()),
               2.0 * k - m * (d.x() * d.x() + d.y() * d.y()),
               0.0,
               1.0};
  const double half = std::sqrt(room);
  const RootList roots = rootsIn(quartic, -half, half);
  const auto inside = [&](const Vector3d& p) {
    return inSweep(patch.around, p.x(), p.y());
  };
  for (int i = 0; i < roots.count; ++i) {
    const double distance =
        accepted(local, roots.values[static_cast<std::size_t>(i)], near, far, inside);
    if (distance < kNever)
      return distance;
  }
  return kNever;
}

/** Distances of the control points from a plane through the ray, as the parts of
 * a(v) + u b(v) in powers of v. */
struct RuledSection {
  std::array<double, 3> a{};
  std::array<double, 3> b{};
  bool one_sided = false;

  RuledSection(const RuledPatch& patch, const Vector3d& origin, const Vector3d& normal)
  {
    std::array<double, 3> s{};
    std::array<double, 3> e{};
    int above = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = normal.dot(patch.start[k] - origin);
      e[k] = normal.dot(patch.end[k] - origin);
      above += (s[k] > 0.0 ? 1 : 0) + (e[k] > 0.0 ? 1 : 0);
    }
    one_sided = above == 0 || above == 6;
    a = powers(s);
    const std::array<double, 3> last = powers(e);
    for (std::size_t k = 0; k < 3; ++k)
      b[k] = last[k] - a[k];
  }

  static std::array<double, 3>
  powers(const std::array<double, 3>& p)
  {
    return {p[0], 2.0 * (p[1] - p[0]), p[0] - 2.0 * p[1] + p[2]};
  }

  static double
  value(const std::array<double, 3>& c, double v)
  {
    return c[0] + v * (c[1] + v * c[2]);
  }
};

/** What is left of two sections when u is eliminated. */
Polynomial
eliminateU(const RuledSection& one, const RuledSection& other)
{
  constexpr double kRounding = 1e-13;
  Polynomial result;
  result.degree = Polynomial::kMaxDegree;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      result.c[i + k] += one.a[i] * other.b[k] - other.a[i] * one.b[k];
  double largest = 0.0;
  for (const double c : result.c)
    largest = std::max(largest, std::abs(c));
  while (result.degree > 0 &&
         std::abs(result.c[static_cast<std::size_t>(result.degree)]) <=
             kRounding * largest)
    --result.degree;
  return result;
}

double
meet(const RuledPatch& patch, const Beam& ray, double near, double far)
{
  const Vector3d across = ray.direction.unitOrthogonal();
  const RuledSection one(patch, ray.origin, across);
  if (one.one_sided)
    return kNever;
  const RuledSection other(patch, ray.origin, ray.direction.cross(across));
  if (other.one_sided)
    return kNever;
  const RootList roots = rootsIn(eliminateU(one, other), 0.0, 1.0);
  double best = kNever;
  for (int i = 0; i < roots.count; ++i) {
    const double v = roots.values[static_cast<std::size_t>(i)];
    const double slope_one = RuledSection::value(one.b, v);
    const double slope_other = RuledSection::value(other.b, v);
    const bool by_one = std::abs(slope_one) > std::abs(slope_other);
    const double u = by_one ? -RuledSection::value(one.a, v) / slope_one
                            : -RuledSection::value(other.a, v) / slope_other;
    if (!(u >= 0.0 && u <= 1.0))
      continue;
    const double distance = ray.direction.dot(patch.point(u, v) - ray.origin);
    if (distance > near && distance < far)
      best = std::min(best, distance);
  }
  return best;
}

} // namespace

bool
OpeningGrid::contains(double u, double v) const
{
  if (columns <= 0 || rows <= 0)
    return false;
  const auto index = [](double offset, double pitch, int count) {
    const double cell = count > 1 ? std::floor(offset / pitch) : 0.0;
    return std::min(std::max(cell, 0.0), count - 1.0);
  };
  double x = u - first.x();
  double y = v - first.y();
  x -= index(x, pitch.x(), columns) * pitch.x();
  y -= index(y, pitch.y(), rows) * pitch.y();
  if (x < 0.0 || x > size.x() || y < 0.0)
    return false;
  if (y <= size.y() || !arched)
    return y <= size.y();
  const double radius = 0.5 * size.x();
  return std::hypot(x - radius, y - size.y()) <= radius;
}

double
intersect(const Primitive& primitive, const Beam& ray, double near, double far)
{
  switch (primitive.index()) {
  case 0:
    return meet(*std::get_if<PlanePatch>(&primitive), ray, near, far);
  case 1:
    return meet(*std::get_if<RuledPatch>(&primitive), ray, near, far);
  case 2:
    return meet(*std::get_if<FrustumPatch>(&primitive), ray, near, far);
  case 3:
    return meet(*std::get_if<SpherePatch>(&primitive), ray, near, far);
  default:
    return meet(*std::get_if<TorusPatch>(&primitive), ray, near, far);
  }
}

} // namespace nurbs
} // namespace pcl
