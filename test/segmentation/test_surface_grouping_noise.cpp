// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Surface grouping when the noise is large, wrong, or weighed in other ways.

#include "surface_scenes.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

TEST(SurfaceGrouping, stepOfThreeSigmaSeparates)
{
  const double step = 3.0 * SensorNoise::kinect().sigma(1.5);
  const GroupedScene result = groupScene([&](int column, int) {
    return column < 150 ? Hit{1.5, 1} : Hit{1.5 + step, 2};
  });
  ASSERT_EQ(result.groups.size(), 2U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

TEST(SurfaceGrouping, planeUnderNoiseOfHalfASigmaMoreIsOne)
{
  const GroupedScene result = groupScene(
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
  const GroupedScene result = groupScene(boxCorner, {}, 1.0, GetParam());
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
  const GroupedScene result = groupScene(boxCorner, options);
  ASSERT_GE(result.groups.size(), 3U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

INSTANTIATE_TEST_SUITE_P(All,
                         Criteria,
                         testing::Values(GroupingCriterion::AIC,
                                         GroupingCriterion::AICc,
                                         GroupingCriterion::BIC,
                                         GroupingCriterion::DescriptionLength));

} // namespace
