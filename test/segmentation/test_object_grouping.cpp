// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Objects from surfaces, on scenes whose objects are known exactly.

#include <pcl/segmentation/entropy_rate_segmentation.h>
#include <pcl/segmentation/object_grouping.h>

#include "surface_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** A camera 0.6 m above a table looks down by 40 degrees. */
struct TableView {
  Eigen::Matrix3d world_camera;

  TableView()
  {
    const double pitch = 40.0 * M_PI / 180.0;
    const Eigen::Vector3d forward(0.0, std::cos(pitch), -std::sin(pitch));
    const Eigen::Vector3d right(1.0, 0.0, 0.0);
    world_camera << right, forward.cross(right), forward;
  }

  Eigen::Vector3d
  ray(int column, int row) const
  {
    return world_camera * pcl::nurbs::test::ray(column, row);
  }
};

const TableView kView;
const Eigen::Vector3d kEye(0.0, 0.0, 0.6);

Hit
table(int column, int row)
{
  const Eigen::Vector3d e = kView.ray(column, row);
  const double depth = -kEye.z() / e.z();
  return {depth > 0.0 && depth < 2.0 ? depth : std::nan(""), 1};
}

/** The nearest face of a box that stands turned by an angle; none: infinite. */
Hit
box(int column,
    int row,
    const Eigen::Vector3d& middle,
    const Eigen::Vector3d& size,
    double turn,
    std::uint32_t object)
{
  const Eigen::Matrix3d box_world =
      Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d origin = box_world * (kEye - middle);
  const Eigen::Vector3d e = box_world * kView.ray(column, row);
  const Eigen::Array3d to_low = (-0.5 * size - origin).array() / e.array();
  const Eigen::Array3d to_high = (0.5 * size - origin).array() / e.array();
  const double near = to_low.min(to_high).maxCoeff();
  const double far = to_low.max(to_high).minCoeff();
  return {near > 0.0 && near < far ? near : std::numeric_limits<double>::infinity(),
          object};
}

Hit
nearest(const Hit& ground, const Hit& other)
{
  return std::isnan(ground.depth) && std::isinf(other.depth) ? ground
         : std::isnan(ground.depth)                          ? other
                                                             : nearer(ground, other);
}

/** Two boxes side by side that do not touch. */
Hit
twoBoxes(int column, int row)
{
  const Hit left = box(column, row, {-0.16, 0.65, 0.08}, {0.16, 0.14, 0.16}, 0.5, 2);
  const Hit right = box(column, row, {0.17, 0.75, 0.06}, {0.2, 0.12, 0.12}, -0.6, 3);
  return nearest(table(column, row), nearer(left, right));
}

/** A small box on a large one. */
Hit
stack(int column, int row)
{
  const Hit low = box(column, row, {0.0, 0.7, 0.05}, {0.34, 0.3, 0.1}, 0.5, 2);
  const Hit high = box(column, row, {0.0, 0.72, 0.16}, {0.14, 0.12, 0.12}, 0.5, 3);
  return nearest(table(column, row), nearer(low, high));
}

/** The hollow of half a ball in the table. */
Hit
hollow(int column, int row)
{
  const Hit ground = table(column, row);
  const Eigen::Vector3d e = kView.ray(column, row);
  const Eigen::Vector3d from = kEye - Eigen::Vector3d(0.0, 0.7, 0.05);
  const double radius = 0.15;
  const double b = e.dot(from) / e.squaredNorm();
  const double root = b * b - (from.squaredNorm() - radius * radius) / e.squaredNorm();
  if (root < 0.0)
    return ground;
  const double far = -b + std::sqrt(root);
  return std::isnan(ground.depth) || far <= ground.depth ? ground : Hit{far, 2};
}

struct Objects {
  GroupedScene scene;
  ObjectGrouping result;
};

/** Groups a scene, which groupScene() makes, to objects. */
template <typename Scene>
Objects
objectsOf(const Scene& scene,
          const ObjectGroupingOptions& options = {},
          int threads = 1)
{
  Objects all;
  all.scene = groupScene(scene);
  GridGraph graph;
  graph.build(all.scene.points, SensorNoise::kinect());
  graph.setWeights();
  SurfaceGroupingOptions surfaces;
  surfaces.threads = threads;
  all.result =
      groupObjects(all.scene.points, graph, SensorNoise::kinect(), surfaces, options);
  return all;
}

TEST(ObjectGrouping, boxesAreWholeAndStandOnOneTable)
{
  const Objects objects = objectsOf(twoBoxes);
  ASSERT_EQ(objects.result.objects.size(), 3U);
  EXPECT_GT(accuracy(objects.scene.truth, objects.result.labels), 0.98);
  EXPECT_GE(objects.result.surfaces.size(), 6U) << "of surfaces, which faces stay";
}

TEST(ObjectGrouping, stackedBoxesAreTwo)
{
  const Objects objects = objectsOf(stack);
  ASSERT_EQ(objects.result.objects.size(), 3U);
  EXPECT_GT(accuracy(objects.scene.truth, objects.result.labels), 0.98);
}

TEST(ObjectGrouping, hollowIsOneObject)
{
  const Objects objects = objectsOf(hollow);
  LabelImage inside;
  for (std::size_t i = 0; i < objects.scene.truth.size(); ++i)
    if (objects.scene.truth[i] == 2)
      inside.push_back(objects.result.labels[i]);
  std::map<std::uint32_t, std::size_t> sizes;
  for (const std::uint32_t label : inside)
    ++sizes[label];
  std::size_t most = 0;
  for (const auto& [label, size] : sizes)
    most = std::max(most, size);
  EXPECT_GT(static_cast<double>(most), 0.95 * static_cast<double>(inside.size()))
      << "a steady concave bend is no fold";
}

TEST(ObjectGrouping, recordsAgreeWithLabels)
{
  const Objects objects = objectsOf(twoBoxes);
  const ObjectGrouping& result = objects.result;
  std::vector<std::size_t> sizes(result.objects.size() + 1, 0);
  for (const std::uint32_t label : result.labels) {
    ASSERT_LE(label, result.objects.size());
    ++sizes[label];
  }
  std::set<std::uint32_t> seen;
  for (std::size_t k = 0; k < result.objects.size(); ++k) {
    EXPECT_EQ(result.objects[k].size, sizes[k + 1]);
    for (const std::uint32_t surface : result.objects[k].surfaces) {
      EXPECT_TRUE(seen.insert(surface).second) << "a surface is of one object";
      for (std::size_t i = 0; i < result.labels.size(); ++i)
        if (result.surface_labels[i] == surface) {
          ASSERT_EQ(result.labels[i], k + 1);
        }
    }
  }
}

TEST(ObjectGrouping, threadsDoNotMatter)
{
  const Objects one = objectsOf(stack);
  for (const int threads : {2, 5}) {
    const Objects more = objectsOf(stack, {}, threads);
    EXPECT_EQ(more.result.labels, one.result.labels);
    EXPECT_EQ(more.result.surface_labels, one.result.surface_labels);
  }
}

TEST(ObjectGrouping, optionsOutOfRangeAreRefused)
{
  ObjectGroupingOptions options;
  options.convex_share = 0.0;
  EXPECT_THROW(objectsOf(table, options), std::invalid_argument);
  options.convex_share = 1.5;
  EXPECT_THROW(objectsOf(table, options), std::invalid_argument);
  options = {};
  options.concave_angle = std::nan("");
  EXPECT_THROW(objectsOf(table, options), std::invalid_argument);
  options = {};
  options.least_border = -1.0;
  EXPECT_THROW(objectsOf(table, options), std::invalid_argument);
}

TEST(ObjectGrouping, modeOfTheSegmentation)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto cloud = cameraCloud(kCamera, [&](int column, int row) {
    const double depth = twoBoxes(column, row).depth;
    return depth + SensorNoise::kinect().sigma(depth) * normal(random);
  });
  EntropyRateSegmentation<PointXYZ> segmentation;
  segmentation.setMode(EntropyRateSegmentation<PointXYZ>::OBJECTS);
  segmentation.setGeometry(kCamera);
  segmentation.setSensorNoise(SensorNoise::kinect());
  segmentation.setInputCloud(pcl::make_shared<pcl::PointCloud<PointXYZ>>(cloud));
  std::vector<PointIndices> objects;
  segmentation.segment(objects);
  EXPECT_EQ(objects.size(), 3U);
  EXPECT_EQ(segmentation.getObjects().size(), objects.size());
  EXPECT_EQ(segmentation.getSurfaceLabels().size(), cloud.size());
  EXPECT_GE(segmentation.getSurfaceGroups().size(), 6U);
  segmentation.setMode(EntropyRateSegmentation<PointXYZ>::SURFACES);
  segmentation.segment(objects);
  EXPECT_TRUE(segmentation.getObjects().empty());
  EXPECT_TRUE(segmentation.getSurfaceLabels().empty());
}

} // namespace
