// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// The built-in scene: exact points lie on their surfaces, the noise is what it says,
// the bytes repeat, and connected groups find the true faces.

#include <pcl/mapping/demo_scene.h>
#include <pcl/segmentation/grid_segmentation.h>

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

namespace {

using namespace pcl;
using namespace pcl::nurbs;

TEST(DemoScene, exactPointsLieOnTheirSurface)
{
  const DemoScene scene({160, 120, 1, false});
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < scene.cloud()->size(); ++i) {
    const Eigen::Vector3d point = (*scene.cloud())[i].getVector3fMap().cast<double>();
    seen.insert(scene.labels()[i]);
    ASSERT_LT(scene.distance(scene.labels()[i], point), 1e-6);
    ASSERT_LE(scene.distance(point), scene.distance(scene.labels()[i], point));
  }
  EXPECT_GE(seen.size(), 10U);
}

TEST(DemoScene, nothingStandsBeforeWhatIsSeen)
{
  const DemoScene scene({80, 60, 1, false});
  for (std::size_t i = 0; i < scene.cloud()->size(); i += 7) {
    const Eigen::Vector3d point = (*scene.cloud())[i].getVector3fMap().cast<double>();
    for (double share = 0.05; share < 0.99; share += 0.01)
      ASSERT_GT(scene.distance(share * point), 0.0);
  }
}

TEST(DemoScene, distancesGrowNoFasterThanTheWay)
{
  const DemoScene scene({32, 24, 1, false});
  std::srand(3);
  for (int n = 0; n < 300; ++n) {
    const Eigen::Vector3d a =
        1.5 * Eigen::Vector3d::Random() + Eigen::Vector3d(0, 0, 2);
    const Eigen::Vector3d b = a + 0.05 * Eigen::Vector3d::Random();
    for (std::uint32_t s = 1; s <= scene.numSurfaces(); ++s)
      ASSERT_LE(std::abs(scene.distance(s, a) - scene.distance(s, b)),
                (a - b).norm() + 1e-9)
          << scene.surfaceName(s);
  }
}

TEST(DemoScene, noiseIsWhatTheModelSays)
{
  const DemoScene noisy;
  DemoSceneOptions options;
  options.noise = false;
  const DemoScene exact(options);
  double sum = 0.0;
  for (std::size_t i = 0; i < noisy.cloud()->size(); ++i) {
    const double depth = (*exact.cloud())[i].z;
    const double error = ((*noisy.cloud())[i].z - depth) / noisy.noise().sigma(depth);
    sum += error * error;
  }
  EXPECT_NEAR(sum / static_cast<double>(noisy.cloud()->size()), 1.0, 0.03);
}

TEST(DemoScene, sameOptionsSameBytesOtherSeedOtherNoise)
{
  const DemoScene first({160, 120, 5, true});
  const DemoScene second({160, 120, 5, true});
  const DemoScene other({160, 120, 6, true});
  ASSERT_EQ(first.cloud()->size(), second.cloud()->size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < first.cloud()->size(); ++i) {
    ASSERT_EQ(
        std::memcmp(&(*first.cloud())[i], &(*second.cloud())[i], sizeof(PointXYZ)), 0);
    different += (*first.cloud())[i].z != (*other.cloud())[i].z ? 1 : 0;
  }
  EXPECT_GT(different, first.cloud()->size() / 10);
}

TEST(DemoScene, refusesImagesWithoutPixels)
{
  EXPECT_THROW(DemoScene({0, 480, 1, true}), std::invalid_argument);
  EXPECT_THROW(DemoScene({1 << 20, 1 << 20, 1, true}), std::invalid_argument);
  const DemoScene scene({8, 6, 1, true});
  EXPECT_THROW(scene.distance(0, Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(scene.surfaceName(99), std::invalid_argument);
}

/** Per true face, the label most of its pixels have, and how many pixels. */
TEST(DemoScene, connectedGroupsFindTheFaces)
{
  const DemoScene scene;
  ConnectedGroupsSegmentation<PointXYZ> segmentation;
  segmentation.setInputCloud(scene.cloud());
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  std::map<std::uint32_t, std::map<std::uint32_t, double>> by_face;
  std::map<std::uint32_t, double> segment_size;
  for (std::size_t i = 0; i < scene.labels().size(); ++i) {
    by_face[scene.labels()[i]][segmentation.getLabels()[i]] += 1.0;
    segment_size[segmentation.getLabels()[i]] += 1.0;
  }
  EXPECT_LE(segments.size(), 14U);
  for (const auto& [face, labels] : by_face) {
    double pixels = 0.0;
    std::pair<std::uint32_t, double> dominant{0, 0.0};
    for (const auto& [label, count] : labels) {
      pixels += count;
      if (label != 0 && count > dominant.second)
        dominant = {label, count};
    }
    if (pixels < 500.0)
      continue;
    EXPECT_GT(dominant.second / segment_size[dominant.first], 0.8)
        << scene.surfaceName(face) << " shares its segment";
    // The back wall is seen in two parts, around the arch and through it.
    EXPECT_GT(dominant.second / pixels, 0.7)
        << scene.surfaceName(face) << " is in pieces";
  }
}

} // namespace
