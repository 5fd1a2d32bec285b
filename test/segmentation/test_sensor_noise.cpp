// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Noise measured in clouds whose noise is known.

#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/sensor_noise.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

/** Wall x = 10 seen by a laser whose rings err by \a ring, whose pulses by \a pulse. */
SensorNoise
measuredOnAWall(double ring, double pulse)
{
  GridGeometry grid = turningLaser(400, 64);
  grid.wrap = false;
  grid.first_u = -0.6;
  grid.step_u = 0.003;
  for (int row = 0; row < grid.height; ++row)
    grid.row_v.push_back(-0.1 + 0.007 * row);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> offset;
  for (int row = 0; row < grid.height; ++row)
    offset.push_back(ring * normal(random));
  const Cloud cloud = laserCloud(grid, [&](int column, int row) {
    return 10.0 / grid.direction(column, row).x() +
           offset[static_cast<std::size_t>(row)] + pulse * normal(random);
  });
  return SensorNoise::estimate(toGridPoints(cloud, grid));
}

TEST(NoiseEstimate, PulsesOfALaser)
{
  EXPECT_NEAR(measuredOnAWall(0.0, 0.01).sigma(10.5), 0.01, 0.0015);
}

TEST(NoiseEstimate, RingsThatAreNotAlignedCount)
{
  EXPECT_NEAR(measuredOnAWall(0.03, 0.01).sigma(10.5), 0.0316, 0.009);
}

/** Scattered samples of a tilted plane; \a clutter is the share that lies anywhere
 * within two metres above it. */
double
sigmaOfTerrain(double slope, double noise, double clutter)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, noise);
  Cloud cloud;
  for (int i = 0; i < 20000; ++i) {
    const double x = 100.0 * uniform(random);
    const double y = 100.0 * uniform(random);
    const double above = uniform(random) < clutter ? 2.0 * uniform(random) : 0.0;
    cloud.emplace_back(static_cast<float>(x),
                       static_cast<float>(y),
                       static_cast<float>(slope * x + above + normal(random)));
  }
  CloudOrganizer<PointXYZ> organizer;
  organizer.setProjection(CloudOrganizer<PointXYZ>::PLANE);
  organizer.setInputCloud(cloud.makeShared());
  Cloud output;
  organizer.organize(output);
  const SensorNoise found =
      SensorNoise::estimate(toGridPoints(output, organizer.getGeometry()));
  EXPECT_EQ(found.quadratic, 0.0); // heights say nothing about the sensor
  return found.constant;
}

TEST(NoiseEstimate, ScatteredHeights)
{
  EXPECT_NEAR(sigmaOfTerrain(0.0, 0.1, 0.0), 0.1, 0.02);
  EXPECT_NEAR(sigmaOfTerrain(0.1, 0.1, 0.0), 0.1, 0.03);
}

TEST(NoiseEstimate, ClutterIsNotNoise)
{
  EXPECT_LT(sigmaOfTerrain(0.0, 0.1, 0.2), 0.2);
}

TEST(NoiseEstimate, FewPointsFallBack)
{
  GridGeometry grid = turningLaser(20, 4);
  const Cloud cloud = laserCloud(grid, [](int, int) { return 5.0; });
  EXPECT_NEAR(SensorNoise::estimate(toGridPoints(cloud, grid)).sigma(5.0), 0.005, 1e-6);
}

} // namespace
