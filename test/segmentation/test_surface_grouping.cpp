// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Surface grouping on scenes whose surfaces are known exactly.

#include <pcl/segmentation/surface_grouping.h>

#include "grid_clouds.h"
#include "label_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Labels = std::vector<std::uint32_t>;

const GridGeometry kCamera =
    GridGeometry::pinhole(320, 240, {262.5, 262.5, 159.5, 119.5});

/** What a ray through a pixel meets. */
struct Hit {
  double depth;
  std::uint32_t surface;
};

struct Result {
  GridPoints points;
  Labels truth;
  Labels labels;
  std::vector<SurfaceGroup> groups;
};

/** Ray (u, v, 1) of a pixel. */
Eigen::Vector3d
ray(int column, int row)
{
  return {kCamera.first_u + column * kCamera.step_u,
          kCamera.first_v + row * kCamera.step_v,
          1.0};
}

/** Depth where a ray meets the plane n.p = d; infinite behind the camera. */
double
planeDepth(const Eigen::Vector3d& normal, double distance, const Eigen::Vector3d& e)
{
  const double depth = distance / normal.dot(e);
  return depth > 0.0 ? depth : std::numeric_limits<double>::infinity();
}

template <typename Scene>
Result
group(const Scene& scene,
      const SurfaceGroupingOptions& options = {},
      double noise_factor = 1.0,
      double stated_factor = 1.0)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Result result;
  const SensorNoise kinect = SensorNoise::kinect();
  const auto cloud = cameraCloud(kCamera, [&](int column, int row) {
    const Hit hit = scene(column, row);
    result.truth.push_back(std::isfinite(hit.depth) ? hit.surface : 0);
    return hit.depth + noise_factor * kinect.sigma(hit.depth) * normal(random);
  });
  result.points = toGridPoints(cloud, kCamera);
  const SensorNoise stated{
      stated_factor * kinect.constant, stated_factor * kinect.quadratic, 0.4};
  GridGraph graph;
  graph.build(result.points, stated);
  graph.setWeights();
  groupSurfaces(result.points, graph, stated, options, result.labels, &result.groups);
  return result;
}

Hit
nearer(const Hit& a, const Hit& b)
{
  return a.depth <= b.depth ? a : b;
}

/** The corner of a box towards the camera: its three faces. */
Hit
boxCorner(int column, int row)
{
  const Eigen::Vector3d e = ray(column, row);
  const double slant = 1.0 / std::sqrt(3.0);
  // Faces meet in (0, 0, 1.2) and go away from the camera: the farthest counts.
  Hit hit{0.0, 0};
  std::uint32_t number = 0;
  for (const double angle : {0.3, 0.3 + 2.0 * M_PI / 3.0, 0.3 + 4.0 * M_PI / 3.0}) {
    const double across = std::sqrt(1.0 - slant * slant);
    const Eigen::Vector3d n(across * std::cos(angle), across * std::sin(angle), slant);
    const double depth = planeDepth(n, 1.2 * slant, e);
    ++number;
    if (depth > hit.depth)
      hit = {depth, number};
  }
  return hit;
}

/** A wall 2 m away with a cylinder in front of it. */
Hit
cylinderBeforeWall(int column, int row)
{
  const Eigen::Vector3d e = ray(column, row);
  const Hit wall{2.0, 1};
  const double radius = 0.25;
  const double middle = 1.3;
  const double a = e.x() * e.x() + 1.0;
  const double root = middle * middle - a * (middle * middle - radius * radius);
  return root < 0.0 ? wall : nearer(wall, {(middle - std::sqrt(root)) / a, 2});
}

/** A dome on a floor 1 m below the camera, which looks down by 40 degrees. */
Hit
domeOnFloor(int column, int row)
{
  const double pitch = 40.0 * M_PI / 180.0;
  const Eigen::Vector3d down(0.0, std::cos(pitch), std::sin(pitch));
  const Eigen::Vector3d e = ray(column, row);
  const double floor = planeDepth(down, 1.0, e);
  const Eigen::Vector3d centre = planeDepth(down, 1.0, ray(160, 130)) * ray(160, 130);
  const double radius = 0.3;
  const double b = e.dot(centre) / e.squaredNorm();
  const double root =
      b * b - (centre.squaredNorm() - radius * radius) / e.squaredNorm();
  const Hit ground{floor, 1};
  return root < 0.0 ? ground : nearer(ground, {b - std::sqrt(root), 2});
}

TEST(SurfaceGrouping, boxIsItsThreeFaces)
{
  const Result result = group(boxCorner);
  ASSERT_EQ(result.groups.size(), 3U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.99);
  for (const SurfaceGroup& face : result.groups) {
    ASSERT_EQ(face.models.size(), 1U);
    EXPECT_EQ(face.models.front().terms, 3) << "a face is plane";
    EXPECT_EQ(face.neighbours.size(), 2U);
    EXPECT_NEAR(face.rms, 1.0, 0.1);
  }
}

TEST(SurfaceGrouping, foldIsWhereTheModelsIntersect)
{
  const Result result = group(boxCorner);
  std::size_t wrong = 0;
  for (const std::size_t cell : mismatches(result.truth, result.labels))
    wrong += distanceToOther(kCamera, result.truth, cell) > 4 ? 1 : 0;
  EXPECT_LE(wrong, 4U) << "cells farther than 4 from the fold on the wrong side";
}

TEST(SurfaceGrouping, cylinderAndWallAreOneGroupEach)
{
  const Result result = group(cylinderBeforeWall);
  ASSERT_EQ(result.groups.size(), 2U) << "the wall's halves are joined";
  EXPECT_GT(accuracy(result.truth, result.labels), 0.98);
}

TEST(SurfaceGrouping, separatedPartsStayApartIfToldTo)
{
  SurfaceGroupingOptions options;
  options.join_separated = false;
  EXPECT_EQ(group(cylinderBeforeWall, options).groups.size(), 3U);
}

TEST(SurfaceGrouping, domeIsOneGroup)
{
  const Result result = group(domeOnFloor);
  ASSERT_EQ(result.groups.size(), 2U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.98);
}

TEST(SurfaceGrouping, wallWithWindowsIsOneGroup)
{
  const Result result = group([](int column, int row) {
    const bool window =
        column % 80 > 25 && column % 80 < 60 && row % 90 > 20 && row % 90 < 70;
    const Hit wall{planeDepth({0.3, 0.0, 1.0}, 2.0, ray(column, row)), 1};
    return window ? Hit{std::nan(""), 0} : wall;
  });
  ASSERT_EQ(result.groups.size(), 1U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.99);
}

TEST(SurfaceGrouping, wallBehindPillarsIsOneGroup)
{
  const Result result = group([](int column, int) {
    const bool pillar = column % 107 > 60 && column % 107 < 85;
    return pillar ? Hit{1.2, 2U + static_cast<std::uint32_t>(column / 107)}
                  : Hit{2.0, 1};
  });
  Labels wall;
  for (std::size_t i = 0; i < result.truth.size(); ++i)
    if (result.truth[i] == 1)
      wall.push_back(result.labels[i]);
  EXPECT_GT(std::count(wall.begin(), wall.end(), 1U),
            static_cast<std::ptrdiff_t>(0.97 * static_cast<double>(wall.size())));
}

TEST(SurfaceGrouping, wavyWallIsOneGroup)
{
  const Result result = group([](int column, int row) {
    const Eigen::Vector3d e = ray(column, row);
    return Hit{1.8 + 0.06 * std::sin(9.0 * e.x()) + 0.04 * std::cos(11.0 * e.y()), 1};
  });
  ASSERT_GE(result.groups.size(), 1U);
  EXPECT_GT(static_cast<double>(result.groups.front().size),
            0.98 * static_cast<double>(result.labels.size()));
  EXPECT_GT(result.groups.front().models.size(), 1U) << "no cubic follows it";
}

TEST(SurfaceGrouping, stepOfThreeSigmaSeparates)
{
  const double step = 3.0 * SensorNoise::kinect().sigma(1.5);
  const Result result = group([&](int column, int) {
    return column < 150 ? Hit{1.5, 1} : Hit{1.5 + step, 2};
  });
  ASSERT_EQ(result.groups.size(), 2U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

TEST(SurfaceGrouping, planeUnderNoiseOfHalfASigmaMoreIsOne)
{
  const Result result = group(
      [](int column, int row) {
        return Hit{planeDepth({0.2, 0.5, 1.0}, 1.6, ray(column, row)), 1};
      },
      {},
      1.5);
  EXPECT_EQ(result.groups.size(), 1U);
}

class WrongNoise : public testing::TestWithParam<double> {};

TEST_P(WrongNoise, boxIsItsFacesAllTheSame)
{
  const Result result = group(boxCorner, {}, 1.0, GetParam());
  ASSERT_GE(result.groups.size(), 3U);
  EXPECT_LE(result.groups.size(), 4U) << "a small one beside the faces at most";
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

INSTANTIATE_TEST_SUITE_P(StatedOverTrue,
                         WrongNoise,
                         testing::Values(0.25, 0.5, 2.0, 4.0));

class Criteria : public testing::TestWithParam<GroupingCriterion> {};

TEST_P(Criteria, findTheFacesOfABox)
{
  SurfaceGroupingOptions options;
  options.criterion = GetParam();
  const Result result = group(boxCorner, options);
  ASSERT_GE(result.groups.size(), 3U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

INSTANTIATE_TEST_SUITE_P(All,
                         Criteria,
                         testing::Values(GroupingCriterion::AIC,
                                         GroupingCriterion::AICc,
                                         GroupingCriterion::BIC,
                                         GroupingCriterion::DescriptionLength));

TEST(SurfaceGrouping, laserRoomHasItsWallsAndFloor)
{
  const GridGeometry grid = turningLaser(720, 64);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Labels truth;
  const auto cloud = laserCloud(grid, [&](int column, int row) {
    const Eigen::Vector3d e = grid.direction(column, row);
    Hit hit{std::numeric_limits<double>::infinity(), 0};
    std::uint32_t number = 0;
    for (const Eigen::Vector4d& wall : {Eigen::Vector4d(1, 0, 0, 6),
                                        Eigen::Vector4d(-1, 0, 0, 5),
                                        Eigen::Vector4d(0, 1, 0, 7),
                                        Eigen::Vector4d(0, -1, 0, 4),
                                        Eigen::Vector4d(0, 0, -1, 1.2)}) {
      ++number;
      const double along = wall.head<3>().dot(e);
      if (along > 0.0)
        hit = nearer(hit, {wall.w() / along, number});
    }
    truth.push_back(hit.surface);
    return hit.depth + 0.02 * normal(random);
  });
  const GridPoints points = toGridPoints(cloud, grid);
  GridGraph graph;
  graph.build(points, SensorNoise::hdl64());
  graph.setWeights();
  Labels labels;
  EXPECT_EQ(groupSurfaces(points, graph, SensorNoise::hdl64(), {}, labels), 5U);
  EXPECT_GT(accuracy(truth, labels), 0.96);
  EXPECT_EQ(labels[0], labels[719]) << "over the seam";
}

TEST(SurfaceGrouping, labelsAreOrderedAndGroupsDescribeThem)
{
  const Result result = group(cylinderBeforeWall);
  std::vector<std::size_t> sizes(result.groups.size() + 1, 0);
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    ASSERT_LE(result.labels[i], result.groups.size());
    ++sizes[result.labels[i]];
  }
  for (std::size_t k = 0; k < result.groups.size(); ++k) {
    EXPECT_EQ(result.groups[k].size, sizes[k + 1]);
    if (k > 0) {
      EXPECT_GE(sizes[k], sizes[k + 1]);
    }
  }
}

TEST(SurfaceGrouping, threadsDoNotMatter)
{
  const Result one = group(domeOnFloor);
  SurfaceGroupingOptions options;
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    EXPECT_EQ(group(domeOnFloor, options).labels, one.labels);
  }
}

} // namespace
