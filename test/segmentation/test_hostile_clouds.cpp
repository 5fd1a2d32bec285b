// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Clouds without sense and clouds without end: organizing them does no harm.

#include <pcl/segmentation/cloud_organizer.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace pcl;
using Cloud = PointCloud<PointXYZ>;

Cloud
organized(CloudOrganizer<PointXYZ>& organizer, const Cloud& cloud)
{
  organizer.setInputCloud(cloud.makeShared());
  Cloud output;
  organizer.organize(output);
  return output;
}

class Hostile : public testing::TestWithParam<Cloud> {};

TEST_P(Hostile, everyProjectionEndsWell)
{
  for (const auto projection : {CloudOrganizer<PointXYZ>::AUTO,
                                CloudOrganizer<PointXYZ>::SPHERICAL,
                                CloudOrganizer<PointXYZ>::PERSPECTIVE,
                                CloudOrganizer<PointXYZ>::PLANE}) {
    CloudOrganizer<PointXYZ> organizer;
    organizer.setProjection(projection);
    const Cloud output = organized(organizer, GetParam());
    EXPECT_EQ(output.size(), static_cast<std::size_t>(output.width) * output.height);
    EXPECT_LE(output.size(), 1024 + 64 * GetParam().size());
  }
}

Cloud
clones(std::size_t count, const PointXYZ& point)
{
  Cloud cloud;
  cloud.assign(count, point);
  return cloud;
}

Cloud
lineOf(float x, float y, float z)
{
  Cloud cloud;
  for (int i = 0; i < 500; ++i)
    cloud.emplace_back(x * static_cast<float>(i),
                       y * static_cast<float>(i),
                       z * static_cast<float>(i));
  return cloud;
}

/** Straight ahead of a laser nothing tells the points' azimuths apart. */
Cloud
lineAhead()
{
  Cloud cloud;
  for (int i = 0; i < 5000; ++i)
    cloud.emplace_back(
        0.001F * std::floor(1000.0F * static_cast<float>(i) / 7.0F), 0.0F, 1.0F);
  return cloud;
}

Cloud
withOutlier()
{
  Cloud cloud = lineOf(0.1F, 0.02F, 0.01F);
  cloud.emplace_back(1e30F, -1e30F, 1e30F);
  return cloud;
}

const float kNan = std::nanf("");
const float kInfinite = std::numeric_limits<float>::infinity();

INSTANTIATE_TEST_SUITE_P(Clouds,
                         Hostile,
                         testing::Values(Cloud(),
                                         clones(1000, {kNan, kNan, kNan}),
                                         clones(1000, {kInfinite, 1.0F, 1.0F}),
                                         clones(1, {1.0F, 2.0F, 3.0F}),
                                         clones(1000, {1.0F, 2.0F, 3.0F}),
                                         clones(1000, {0.0F, 0.0F, 0.0F}),
                                         lineOf(1.0F, 0.0F, 0.0F),
                                         lineOf(0.0F, 0.0F, -1.0F),
                                         lineOf(0.3F, 0.2F, 0.1F),
                                         lineAhead(),
                                         withOutlier()));

TEST(OrganizedInput, hostileGridsAreLattices)
{
  for (const Cloud& cloud : {Cloud(20, 10, PointXYZ(kNan, kNan, kNan)),
                             Cloud(20, 10, PointXYZ(1.0F, 1.0F, 1.0F)),
                             Cloud(20, 10, PointXYZ(0.0F, 0.0F, 0.0F))}) {
    CloudOrganizer<PointXYZ> organizer;
    organized(organizer, cloud);
    EXPECT_EQ(organizer.getGeometry().projection, GridProjection::lattice);
  }
}

TEST(ScatteredInput, tenMillionPoints)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<float> where(-50.0F, 50.0F);
  auto cloud = pcl::make_shared<Cloud>();
  cloud->reserve(10000000);
  for (int i = 0; i < 10000000; ++i) {
    const float x = where(random);
    const float y = where(random);
    cloud->emplace_back(x, y, std::sin(0.2F * x));
  }
  CloudOrganizer<PointXYZ> organizer;
  organizer.setInputCloud(cloud);
  Cloud output;
  ASSERT_TRUE(organizer.organize(output));
  EXPECT_LT(organizer.getNumDropped(), cloud->size() / 10);
}

} // namespace
