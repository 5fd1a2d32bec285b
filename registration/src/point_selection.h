// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/voxel_map.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** Numbers of the points that voxelSubsample() keeps. */
std::vector<std::size_t>
voxelSubsampleIndices(const ScanPoints& points, double voxel_size);

/** So many values at most, evenly chosen in their order. */
template <typename Value>
std::vector<Value>
evenlyChosen(const std::vector<Value>& values, std::size_t most)
{
  if (values.size() <= most)
    return values;
  std::vector<Value> kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < values.size(); ++i)
    if ((i + 1) * most / values.size() > i * most / values.size())
      kept.push_back(values[i]);
  return kept;
}

/** The values at some places of a list. */
template <typename Value>
std::vector<Value>
selected(const std::vector<Value>& values, const std::vector<std::size_t>& places)
{
  std::vector<Value> some;
  some.reserve(places.size());
  for (const std::size_t place : places)
    some.push_back(values[place]);
  return some;
}

} // namespace nurbs
} // namespace pcl
