// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "labelled_scenes.h"

#include <pcl/io/pcd_io.h>
#include <pcl/mapping/demo_scene.h>
#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace bench {
namespace {

template <typename PointT, typename Label>
LabelledScene
readScene(const std::string& path, const Label& label)
{
  pcl::PointCloud<PointT> file;
  if (pcl::io::loadPCDFile(path, file) != 0)
    throw std::runtime_error(path + ": cannot be read");
  LabelledScene scene;
  pcl::copyPointCloud(file, *scene.cloud);
  for (const PointT& point : file)
    scene.truth.push_back(std::isfinite(point.z) ? label(point) : 0);
  return scene;
}

/** Labels of the surfaces of a scan; those that go on smoothly are one. */
LabelImage
streetLabels(const Town& town, const SimulatedScan& scan, std::size_t width)
{
  constexpr double kStep = 0.05;             // metres
  const double least_cosine = std::cos(0.2); // of normals
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto find = [&](std::uint32_t id) {
    while (parent.emplace(id, id).first->second != id)
      id = parent[id];
    return id;
  };
  const auto join = [&](std::size_t i, std::size_t j) {
    const std::uint32_t a = scan.surfaces[i];
    const std::uint32_t b = scan.surfaces[j];
    if (a == b || a == BeamHit::kNothing || b == BeamHit::kNothing ||
        town.surface(a).kind != town.surface(b).kind)
      return;
    const Eigen::Vector3d normal_a = normalAt(town.primitive(a), scan.true_points[i]);
    const Eigen::Vector3d normal_b = normalAt(town.primitive(b), scan.true_points[j]);
    const Eigen::Vector3d between = scan.true_points[j] - scan.true_points[i];
    if (std::abs(normal_a.dot(normal_b)) >= least_cosine &&
        std::abs(normal_a.dot(between)) <= kStep &&
        std::abs(normal_b.dot(between)) <= kStep)
      parent[find(a)] = find(b);
  };
  for (std::size_t i = 0; i < scan.surfaces.size(); ++i) {
    join(i, i + 1 < scan.surfaces.size() ? i + 1 : i);
    join(i, i + width < scan.surfaces.size() ? i + width : i);
  }
  LabelImage labels;
  for (const std::uint32_t surface : scan.surfaces)
    labels.push_back(surface == BeamHit::kNothing ||
                             town.surface(surface).kind == SurfaceKind::Leaves
                         ? 0
                         : find(surface) + 1);
  return labels;
}

} // namespace

SceneSet
readOsd(const std::filesystem::path& data)
{
  SceneSet set{"OSD",
               "Kinect, 8 table tops, hand labels of whole objects",
               {},
               SceneScale::Room};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(data / "osd_labelled"))
    if (entry.path().extension() == ".pcd")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files)
    set.scenes.push_back(
        readScene<PointXYZL>(file, [](const PointXYZL& p) { return p.label; }));
  return set;
}

SceneSet
readSynpeb(const std::filesystem::path& data)
{
  SceneSet set{
      "SynPEB", "laser, one room of 39 planes, exact labels", {}, SceneScale::Room};
  set.scenes.push_back(readScene<PointXYZI>(
      (data / "synpeb_room" / "test_500.pcd").string(), [](const PointXYZI& p) {
        return static_cast<std::uint32_t>(std::lround(p.intensity));
      }));
  return set;
}

SceneSet
simulateRoom()
{
  SceneSet set{"Simulated room",
               "Kinect noise, planes, wavy wall, column, dome, arch and box; exact "
               "labels of surfaces",
               {},
               SceneScale::Room};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DemoSceneOptions options;
    options.seed = seed;
    const DemoScene demo(options);
    set.scenes.push_back({demo.cloud(), demo.labels()});
  }
  return set;
}

SceneSet
simulateStreet()
{
  SceneSet set{"Simulated street",
               "HDL-64E, 2 cm noise, two scans of a town; exact labels of its "
               "surfaces (road, sidewalks, curbs, facades, windows, doors, roofs, "
               "columns, cars), without leaves",
               {},
               SceneScale::Street};
  SimulationOptions options;
  options.town.movers = false;
  options.threads = 2;
  const SimulatedDrive drive(makeCircuit(), LaserModel::hdl64(), options);
  for (const std::size_t index : {drive.size() / 7, drive.size() / 2}) {
    const SimulatedScan scan = drive.simulate(index);
    LabelledScene scene;
    pcl::copyPointCloud(*scan.scan.cloud, *scene.cloud);
    scene.truth = streetLabels(drive.town(), scan, scan.scan.cloud->width);
    set.scenes.push_back(scene);
  }
  return set;
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
