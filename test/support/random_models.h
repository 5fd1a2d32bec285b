// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>

#include "random_nurbs.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** A file name in the temporary folder; the file is gone when the object is. */
class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              (std::to_string(std::random_device{}()) + name))
  {
  }

  ~TemporaryFile()
  {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    std::filesystem::remove(path() + ".part", ignored);
  }

  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile&
  operator=(const TemporaryFile&) = delete;

  std::string
  path() const
  {
    return path_.string();
  }

private:
  std::filesystem::path path_;
};

inline std::vector<std::uint8_t>
readBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/** Star-shaped polygon around the middle of the domain. */
inline TrimLoop
randomPolygon(RandomNurbs& random, const NurbsSurface& surface, int corners)
{
  const KnotVector& u = surface.knotsU();
  const KnotVector& v = surface.knotsV();
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    const double radius = random.uniform(0.2, 0.45);
    points.emplace_back(
        u.domainMin() + u.domainLength() * (0.5 + radius * std::cos(angle)),
        v.domainMin() + v.domainLength() * (0.5 + radius * std::sin(angle)));
  }
  return TrimLoop::polygon(points);
}

/** Loop of a rational quadratic and a straight edge of degree 1. */
inline TrimLoop
randomCurvedLoop(RandomNurbs& random, const NurbsSurface& surface)
{
  const Eigen::Vector2d low(surface.knotsU().domainMin(), surface.knotsV().domainMin());
  const Eigen::Vector2d size(surface.knotsU().domainLength(),
                             surface.knotsV().domainLength());
  const auto at = [&](double u, double v) {
    return (low + size.cwiseProduct(Eigen::Vector2d(u, v))).eval();
  };
  NurbsCurve2::Points line(2, 2);
  line << at(0.2, 0.5), at(0.8, 0.5);
  NurbsCurve2::Points arc(2, 3);
  arc << at(0.8, 0.5), at(0.5, random.uniform(0.7, 1.0)), at(0.2, 0.5);
  const Eigen::Vector3d weights(1.0, random.uniform(0.5, 2.0), 1.0);
  return TrimLoop(
      {NurbsCurve2::fromControlPoints(KnotVector::bezier(1), line),
       NurbsCurve2::fromControlPoints(KnotVector::bezier(2), arc, weights)});
}

/** Patches of all degrees, knots and trims; values with full mantissas. */
inline SurfaceModel
randomModel(unsigned seed, int patches)
{
  RandomNurbs random(seed);
  SurfaceModel model;
  model.frame_id = "map";
  model.metadata = {{"source", "random"}, {"Größe", "line\nbreak \"quoted\""}};
  for (int i = 0; i < patches; ++i) {
    NurbsSurface surface = random.surface(random.integer(1, 5),
                                          random.integer(1, 5),
                                          i % 2 == 1,
                                          static_cast<KnotKind>(i % 4));
    std::vector<TrimLoop> loops;
    if (i % 3 > 0)
      loops.push_back(randomPolygon(random, surface, random.integer(3, 20)));
    if (i % 3 == 2)
      loops.push_back(randomCurvedLoop(random, surface));
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(std::move(surface), std::move(loops));
    patch.label = static_cast<std::uint32_t>(random.integer(0, 1000));
    patch.quality = {static_cast<std::uint64_t>(random.integer(10, 100000)),
                     random.uniform(1e-4, 1e-2),
                     random.uniform(1e-4, 1e-2),
                     random.uniform(1e-2, 1e-1)};
    model.patches.push_back(std::move(patch));
  }
  return model;
}

/** Height field over the xy plane, turned and moved: 20 x 20 control points, waves of
 * 10 cm, 5 m wide. */
inline NurbsSurface
heightField(const Eigen::Affine3d& pose, int spans = 17)
{
  const KnotVector u = KnotVector::clampedUniform(3, spans, -2.5, 2.5);
  const KnotVector v = KnotVector::clampedUniform(3, spans, -2.0, 2.0);
  Eigen::Matrix3Xd points(3, u.numControlPoints() * v.numControlPoints());
  for (int i = 0, column = 0; i < u.numControlPoints(); ++i)
    for (int j = 0; j < v.numControlPoints(); ++j, ++column) {
      const double x = u.greville(i);
      const double y = v.greville(j);
      points.col(column) << x, y, 0.1 * std::sin(1.5 * x) * std::cos(1.2 * y);
    }
  return NurbsSurface::fromControlPoints(u, v, points).transformed(pose);
}

inline Eigen::Affine3d
rigidPose(RandomNurbs& random)
{
  const Eigen::Quaterniond turn(
      random.normal(1.0), random.normal(1.0), random.normal(1.0), random.normal(1.0));
  const Eigen::Vector3d shift(
      random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-2, 2));
  return Eigen::Translation3d(shift) * turn.normalized();
}

/** One patch of every kind, made by arithmetic that is exact, so that it is the same on
 * every machine. */
inline SurfaceModel
goldenModel()
{
  SurfaceModel model;
  model.frame_id = "golden";
  model.metadata = {{"made by", "hand"}};
  const KnotVector u = KnotVector::clamped(2, {0.0, 0.25, 1.0});
  const KnotVector v = KnotVector::bezier(3, -1.0, 2.0);
  for (int kind = 0; kind < 4; ++kind) {
    NurbsSurface::HomogeneousPoints points(4, 16);
    for (int i = 0, column = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j, ++column) {
        const double wave = 0.125 * ((i * 7 + j * 5) % 4);
        const double weight = kind == 2 ? 0.5 + wave : 1.0;
        points.col(column) << u.greville(i), v.greville(j), kind == 2 ? 1.0 : wave,
            weight;
        if (kind == 3) // no structure at all
          points.col(column) << wave, 0.25 * i * j, 0.5 * i - j, 1.0 + wave;
      }
    if (kind == 0) // flat
      points.row(2).setZero();
    std::vector<TrimLoop> loops;
    if (kind == 1)
      loops.push_back(TrimLoop::polygon(
          {{0.125, -0.5}, {0.75, -0.5}, {0.75, 1.0}, {0.5, 1.0}, {0.125, 0.25}}));
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(NurbsSurface(u, v, points), std::move(loops));
    patch.label = 7 * kind;
    patch.quality = {1000U + kind, 0.0009765625, 0.001953125, 0.0078125};
    model.patches.push_back(std::move(patch));
  }
  return model;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
