// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace test {

/** A HDL-64E with few columns. */
inline LaserModel
coarseLaser(int columns = 200)
{
  LaserModel laser = LaserModel::hdl64();
  laser.columns = columns;
  return laser;
}

/** The first poses of a figure of eight. */
inline Trajectory
shortDrive(std::size_t poses = 60)
{
  CircuitOptions options;
  options.shape = CircuitShape::Eight;
  options.laps = 0.5;
  Trajectory drive = makeCircuit(options);
  drive.resize(std::min(poses, drive.size()));
  return drive;
}

/** Such a laser on such a drive. */
inline SimulatedDrive
townDrive(const SimulationOptions& options, int columns = 200)
{
  return SimulatedDrive(shortDrive(), coarseLaser(columns), options);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
