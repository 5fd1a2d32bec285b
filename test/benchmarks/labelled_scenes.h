// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pcl_segmenters.h"
#include "segmentation_scores.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

/** An organized cloud and the true label of each point, 0 for none. */
struct LabelledScene {
  Cloud::Ptr cloud{new Cloud};
  LabelImage truth;
};

struct SceneSet {
  std::string name;
  std::string about;
  std::vector<LabelledScene> scenes;
  SceneScale scale = SceneScale::Room;
};

/** Table tops of the Object Segmentation Database in a folder of data sets. */
SceneSet
readOsd(const std::filesystem::path& data);

/** The room of SynPEB in a folder of data sets. */
SceneSet
readSynpeb(const std::filesystem::path& data);

/** Views of the simulated room. */
SceneSet
simulateRoom();

/** Scans of the simulated town. Its primitives that go on smoothly into each other, as
 * the pieces of a road, are one region; leaves are none. */
SceneSet
simulateStreet();

} // namespace bench
} // namespace nurbs
} // namespace pcl
