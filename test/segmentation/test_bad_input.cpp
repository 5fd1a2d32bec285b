// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What the class says and returns, in either mode, about clouds and weights that cannot
// be segmented, and about odd ones that can.

#include "superpixel_scenes.h"

#include <pcl/common/point_tests.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;
using Segmentation = EntropyRateSegmentation<PointXYZ>;

const float kNan = std::nanf("");
const PointXYZ kNoReturn(kNan, kNan, kNan);

class EitherMode : public testing::TestWithParam<Segmentation::Mode> {
protected:
  EitherMode() : segmentation_(superpixels<PointXYZ>(10))
  {
    segmentation_.setMode(GetParam());
  }

  /** No segment, no label, and one line that names the class and holds \a reason. */
  void
  expectRefused(const Cloud& cloud, const std::string& reason)
  {
    testing::internal::CaptureStderr();
    const auto segments = segmentsOf(segmentation_, cloud);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(segments.empty());
    EXPECT_EQ(segmentation_.getNumSegments(), 0U);
    EXPECT_TRUE(segmentation_.getLabels().empty());
    EXPECT_TRUE(segmentation_.getAdjacency().empty());
    EXPECT_NE(said.find("[pcl::GridSegmentation::segment]"), std::string::npos) << said;
    EXPECT_NE(said.find(reason), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }

  /** Segments of valid points only, each point in one at most. */
  std::vector<PointIndices>
  expectSegmented(const Cloud& cloud)
  {
    const auto segments = segmentsOf(segmentation_, cloud);
    std::vector<int> uses(cloud.size(), 0);
    for (const PointIndices& segment : segments)
      for (const index_t index : segment.indices) {
        EXPECT_TRUE(isFinite(cloud[static_cast<std::size_t>(index)]));
        ++uses[static_cast<std::size_t>(index)];
      }
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](int n) { return n <= 1; }));
    EXPECT_FALSE(segments.empty());
    return segments;
  }

  Segmentation segmentation_;
};

INSTANTIATE_TEST_SUITE_P(Modes,
                         EitherMode,
                         testing::Values(Segmentation::SURFACES,
                                         Segmentation::SUPERPIXELS));

TEST_P(EitherMode, refusesNoCloudAndNoPoints)
{
  testing::internal::CaptureStderr();
  std::vector<PointIndices> segments(2);
  segmentation_.segment(segments);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("No input"), std::string::npos);
  EXPECT_TRUE(segments.empty());
  expectRefused(Cloud(40, 30, kNoReturn), "no neighbouring points");
}

TEST_P(EitherMode, refusesAnUnorganizedCloud)
{
  expectRefused(Cloud(1200, 1, PointXYZ(1.0F, 1.0F, 1.0F)), "not organized");
}

TEST_P(EitherMode, refusesIsolatedPoints)
{
  Cloud cloud = boxBeforeWall(7);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i % 160 % 2 != 0 || i / 160 % 2 != 0)
      cloud[i] = kNoReturn;
  expectRefused(cloud, "too few for a segment");
}

TEST_P(EitherMode, refusesTwoPoints)
{
  Cloud cloud(4, 4, kNoReturn);
  cloud[5] = PointXYZ(0.0F, 0.0F, 1.0F);
  cloud[6] = PointXYZ(0.01F, 0.0F, 1.0F);
  expectRefused(cloud, "too few for a segment");
}

TEST_P(EitherMode, refusesEdgesThatAreAllTooWeak)
{
  segmentation_.setMinWeight(2.0F); // weights by distance are at most 1
  if (GetParam() == Segmentation::SUPERPIXELS) {
    expectRefused(boxBeforeWall(8), "too few for a segment");
    return;
  }
  // Whole blocks are surfaces still; what matters is that labels are right.
  EXPECT_LE(segmentsOf(segmentation_, boxBeforeWall(8)).size(), 160U * 120U / 100U);
}

TEST_P(EitherMode, refusesWeightsWithoutSense)
{
  const Cloud cloud = boxBeforeWall(9);
  for (const float bad : {kNan, std::numeric_limits<float>::infinity(), -1.0F}) {
    segmentation_.setWeightFunction(
        [bad](const PointXYZ& p, const PointXYZ&, float, float) {
          return p.x > 0.5F ? bad : 1.0F;
        });
    expectRefused(cloud, "finite and not negative");
  }
  segmentation_.resetWeightFunction();
  expectSegmented(cloud);
}

TEST_P(EitherMode, segmentsConstantDepthAsOneHugeSegment)
{
  segmentation_.setNumberOfSuperpixels(1);
  const GridGeometry camera =
      GridGeometry::pinhole(640, 480, {525.0, 525.0, 319.5, 239.5});
  const Cloud cloud = cameraCloud(camera, [](int, int) { return 1.0; });
  const auto segments = expectSegmented(cloud);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].indices.size(), cloud.size());
}

TEST_P(EitherMode, segmentsAMillionPoints)
{
  const GridGeometry camera =
      GridGeometry::pinhole(1250, 800, {1000.0, 1000.0, 624.5, 399.5});
  const Cloud cloud =
      cameraCloud(camera, [](int column, int) { return column < 600 ? 1.5 : 2.0; });
  const auto segments = expectSegmented(cloud);
  EXPECT_EQ(segments.size(), GetParam() == Segmentation::SURFACES ? 2U : 10U);
}

} // namespace
