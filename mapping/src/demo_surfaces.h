// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** One analytic surface of the demo scene, in the room's frame: x right, y away from
 * the camera, z up, floor at z = 0. */
class DemoSurface {
public:
  explicit DemoSurface(std::string name) : name_(std::move(name)) {}

  virtual ~DemoSurface() = default;

  const std::string&
  name() const
  {
    return name_;
  }

  /** Distance along a unit ray to the first meeting, or infinity. */
  virtual double
  cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const = 0;

  /** Exact distance of a point. */
  virtual double
  distance(const Eigen::Vector3d& point) const = 0;

private:
  std::string name_;
};

/** A torus standing upright, its axis along y. */
std::unique_ptr<DemoSurface>
makeArch(std::string name, const Eigen::Vector3d& center, double ring, double tube);

/** x = middle + amplitude sin(2 pi y / length). */
std::unique_ptr<DemoSurface>
makeWavyWall(std::string name, double middle, double amplitude, double length);

/** The surfaces of the demo room. */
std::vector<std::unique_ptr<DemoSurface>>
makeDemoSurfaces();

} // namespace nurbs
} // namespace pcl
