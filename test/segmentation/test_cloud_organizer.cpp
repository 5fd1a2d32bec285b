// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Rasters recognised and made: exact grids give their parameters back, every cell's
// point lies where the raster says.

#include <pcl/segmentation/cloud_organizer.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

Cloud
organized(CloudOrganizer<PointXYZ>& organizer, const Cloud& cloud)
{
  organizer.setInputCloud(cloud.makeShared());
  Cloud output;
  organizer.organize(output);
  return output;
}

Cloud
withoutGrid(Cloud cloud)
{
  cloud.width = static_cast<std::uint32_t>(cloud.size());
  cloud.height = 1;
  return cloud;
}

/** No point moved, none twice, and each in its cell or one beside it. */
void
expectFaithful(const Cloud& input,
               const Cloud& output,
               const CloudOrganizer<PointXYZ>& organizer)
{
  const GridGeometry& grid = organizer.getGeometry();
  ASSERT_EQ(output.size(), organizer.getCellPoints().size());
  std::set<std::int32_t> seen;
  for (std::size_t i = 0; i < output.size(); ++i) {
    const std::int32_t index = organizer.getCellPoints()[i];
    if (index < 0) {
      EXPECT_TRUE(std::isnan(output[i].x));
      continue;
    }
    EXPECT_TRUE(seen.insert(index).second);
    const PointXYZ& point = input[static_cast<std::size_t>(index)];
    ASSERT_EQ(point.getVector3fMap(), output[i].getVector3fMap());
    const Eigen::Vector3d chart = grid.chart(point.getVector3fMap().cast<double>());
    const Eigen::Vector2d cell = grid.cell(chart.x(), chart.y());
    const double column = static_cast<double>(i % output.width);
    double apart = std::abs(cell.x() - column);
    if (grid.wrap)
      apart = std::min(apart, grid.width - apart);
    ASSERT_LE(apart, 1.51);
    ASSERT_LE(std::abs(cell.y() - static_cast<double>(i / output.width)), 1.51);
  }
  EXPECT_EQ(seen.size() + organizer.getNumDropped(), input.size());
}

TEST(OrganizedInput, pinholeCameraIsRecognised)
{
  const GridGeometry truth =
      GridGeometry::pinhole(160, 120, {131.5, 128.0, 77.25, 61.0});
  const Cloud cloud = cameraCloud(truth, [](int column, int row) {
    return (column * 7 + row * 3) % 11 == 0 ? std::nan("") : 1.0 + 0.01 * column;
  });
  CloudOrganizer<PointXYZ> organizer;
  organized(organizer, cloud);
  const PinholeIntrinsics found = organizer.getGeometry().intrinsics();
  EXPECT_NEAR(found.fx, 131.5, 1e-3);
  EXPECT_NEAR(found.fy, 128.0, 1e-3);
  EXPECT_NEAR(found.cx, 77.25, 1e-3);
  EXPECT_NEAR(found.cy, 61.0, 1e-3);
}

TEST(OrganizedInput, laserWithUnequalStepsIsRecognised)
{
  GridGeometry truth = turningLaser(100, 80);
  truth.wrap = false;
  truth.first_u = -0.6;
  truth.step_u = 0.012;
  const Cloud cloud = laserCloud(
      truth, [](int column, int row) { return 2.0 + 0.1 * ((column + row) % 7); });
  CloudOrganizer<PointXYZ> organizer;
  organized(organizer, cloud);
  const GridGeometry& found = organizer.getGeometry();
  ASSERT_EQ(found.projection, GridProjection::spherical);
  EXPECT_FALSE(found.wrap);
  EXPECT_NEAR(found.step_u, truth.step_u, 1e-6);
  EXPECT_NEAR(found.step_v, truth.step_v, 1e-6);
}

TEST(OrganizedInput, fullTurnWrapsAndUnevenRowsGetATable)
{
  GridGeometry truth = turningLaser(180, 16);
  for (int row = 0; row < 16; ++row)
    truth.row_v.push_back(-0.1 + 0.001 * row * row);
  const Cloud cloud =
      laserCloud(truth, [](int column, int) { return 4.0 + column % 3; });
  CloudOrganizer<PointXYZ> organizer;
  organized(organizer, cloud);
  const GridGeometry& found = organizer.getGeometry();
  ASSERT_EQ(found.projection, GridProjection::spherical);
  EXPECT_TRUE(found.wrap);
  ASSERT_EQ(found.row_v.size(), truth.row_v.size());
  for (std::size_t i = 0; i < found.row_v.size(); ++i)
    EXPECT_NEAR(found.row_v[i], truth.row_v[i], 1e-6);
}

TEST(OrganizedInput, directionsInvertTheCells)
{
  const GridGeometry grid = turningLaser(90, 20);
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector3d chart = grid.chart(3.0 * grid.direction(column, row));
      EXPECT_NEAR(chart.z(), 3.0, 1e-12);
      const Eigen::Vector2d cell = grid.cell(chart.x(), chart.y());
      EXPECT_NEAR(cell.x(), column, 1e-9);
      EXPECT_NEAR(cell.y(), row, 1e-9);
    }
}

TEST(OrganizedInput, placesBetweenUnequalRowsAreInterpolated)
{
  GridGeometry grid = turningLaser(90, 3);
  grid.row_v = {-0.2, -0.1, 0.2};
  EXPECT_NEAR(grid.chartOfCell(0.0, 1.0).y(), -0.1, 1e-15);
  EXPECT_NEAR(grid.chartOfCell(0.0, 1.5).y(), 0.05, 1e-15);
  EXPECT_NEAR(grid.chartOfCell(0.0, -0.5).y(), -0.25, 1e-15);
  EXPECT_NEAR(grid.chartOfCell(0.0, 2.5).y(), 0.35, 1e-15);
  EXPECT_NEAR(grid.chart(grid.direction(7.25, 1.5)).y(), 0.05, 1e-12);
  grid.row_v = {0.3};
  EXPECT_NEAR(grid.chartOfCell(0.0, 0.5).y(), 0.3, 1e-15);
}

/** Where a turning laser's rings begin, in degrees left of forward, and which way it
 * turns. */
struct Turn {
  double seam;
  double sense;
};

class RingsInStoredOrder : public testing::TestWithParam<Turn> {};

TEST_P(RingsInStoredOrder, comeBack)
{
  // Some returns are missing, some beams pass the seam early, and a beam looks a little
  // up or down at near things, as one does that starts beside the sensor's centre.
  const GridGeometry truth = turningLaser(720, 32);
  std::mt19937 random(5);
  Cloud cloud;
  std::vector<std::int32_t> row_of_point;
  for (int row = 0; row < 32; ++row)
    for (int step = 0; step < 720; ++step) {
      if (random() % 10 == 0)
        continue;
      const int degrees = (step / 2 + row % 3) % 360;
      const double dip = degrees > 40 && degrees < 150 ? 0.4 : 0.0;
      const double left = M_PI / 180.0 * GetParam().seam +
                          GetParam().sense * (step + row % 3) * truth.step_u;
      const double column = (left - truth.first_u) / truth.step_u;
      const Eigen::Vector3d ray = truth.direction(column, row + dip);
      const Eigen::Vector3f point = (8.0 * ray).cast<float>();
      cloud.emplace_back(point.x(), point.y(), point.z());
      row_of_point.push_back(row);
    }
  CloudOrganizer<PointXYZ> organizer;
  const Cloud output = organized(organizer, cloud);
  ASSERT_EQ(output.height, 32U);
  EXPECT_NEAR(output.width, 720.0, 8.0);
  EXPECT_TRUE(organizer.getGeometry().wrap);
  EXPECT_LT(organizer.getNumDropped(), cloud.size() / 50);
  expectFaithful(cloud, output, organizer);
  for (std::size_t cell = 0; cell < output.size(); ++cell) {
    const std::int32_t point = organizer.getCellPoints()[cell];
    if (point >= 0) {
      ASSERT_EQ(row_of_point[static_cast<std::size_t>(point)],
                static_cast<std::int32_t>(cell / output.width));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllAround,
                         RingsInStoredOrder,
                         testing::Values(Turn{0.0, -1.0},
                                         Turn{0.0, 1.0},
                                         Turn{77.7, 1.0},
                                         Turn{180.0, -1.0},
                                         Turn{-179.8, 1.0},
                                         Turn{-120.3, -1.0}));

TEST(ScatteredInput, ringsOfALaserThatLooksAheadComeBack)
{
  // The upper beams meet no more than a tower 30 degrees wide.
  const GridGeometry truth = turningLaser(720, 32);
  Cloud cloud;
  for (int row = 0; row < 32; ++row)
    for (int column = row < 8 ? 400 : 260; column < 460; ++column) {
      const Eigen::Vector3f point = (8.0 * truth.direction(column, row)).cast<float>();
      cloud.emplace_back(point.x(), point.y(), point.z());
    }
  CloudOrganizer<PointXYZ> organizer;
  const Cloud output = organized(organizer, cloud);
  EXPECT_EQ(output.height, 32U);
  EXPECT_NEAR(output.width, 200.0, 4.0);
  expectFaithful(cloud, output, organizer);
}

TEST(ScatteredInput, unevenTurnLosesNoReading)
{
  // Pairs of pulses close together, as from a laser that turns by fits and starts:
  // rounded, half of them share cells with the others.
  const GridGeometry truth = turningLaser(720, 16);
  Cloud cloud;
  for (int row = 0; row < 16; ++row)
    for (int turn = 0; turn < 720; ++turn) {
      const double column = 359.4 - turn + (turn % 2 == 0 ? -0.4 : 0.4);
      const Eigen::Vector3f point = (8.0 * truth.direction(column, row)).cast<float>();
      cloud.emplace_back(point.x(), point.y(), point.z());
    }
  CloudOrganizer<PointXYZ> organizer;
  const Cloud output = organized(organizer, cloud);
  EXPECT_LE(organizer.getNumDropped(), cloud.size() / 500);
  expectFaithful(cloud, output, organizer);
  // Cells of a row follow each other in the order of the azimuths.
  for (std::uint32_t row = 0; row < output.height; ++row) {
    double before = -std::numeric_limits<double>::infinity();
    for (std::uint32_t column = 0; column < output.width; ++column)
      if (std::isfinite(output(column, row).x)) {
        const Eigen::Vector3d chart = organizer.getGeometry().chart(
            output(column, row).getVector3fMap().cast<double>());
        EXPECT_GT(chart.x(), before);
        before = chart.x();
      }
  }
}

TEST(ScatteredInput, shuffledRingsAreFoundByTheirAngles)
{
  const GridGeometry truth = turningLaser(360, 24);
  Cloud cloud = withoutGrid(laserCloud(truth, [](int, int) { return 6.0; }));
  std::shuffle(cloud.begin(), cloud.end(), std::mt19937(3));
  CloudOrganizer<PointXYZ> organizer;
  const Cloud output = organized(organizer, cloud);
  EXPECT_EQ(output.height, 24U);
  expectFaithful(cloud, output, organizer);
}

TEST(ScatteredInput, airborneTerrainBecomesAHeightField)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> where(-200.0F, 200.0F);
  Cloud cloud;
  for (int i = 0; i < 20000; ++i) {
    const float x = where(random);
    const float y = where(random);
    const bool roof = std::fmod(std::abs(x), 50.0F) < 15.0F && std::abs(y) < 120.0F;
    cloud.emplace_back(x, y, 0.02F * x + (roof ? 9.0F : 0.0F));
  }
  CloudOrganizer<PointXYZ> organizer;
  const Cloud output = organized(organizer, cloud);
  EXPECT_EQ(organizer.getGeometry().projection, GridProjection::plane);
  EXPECT_LT(organizer.getNumDropped(), cloud.size() / 10);
  expectFaithful(cloud, output, organizer);
}

TEST(ScatteredInput, nearestPointKeepsTheCell)
{
  Cloud cloud;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> slope(-0.5F, 0.5F);
  for (int i = 0; i < 3000; ++i) {
    const float u = slope(random);
    const float v = slope(random);
    for (const float depth : {5.0F, 2.0F})
      cloud.emplace_back(depth * u, depth * v, depth);
  }
  CloudOrganizer<PointXYZ> organizer;
  organizer.setProjection(CloudOrganizer<PointXYZ>::PERSPECTIVE);
  const Cloud output = organized(organizer, cloud);
  std::size_t near = 0;
  for (const PointXYZ& point : output)
    near += point.z == 2.0F ? 1 : 0;
  EXPECT_GT(near, 2700U);
  expectFaithful(cloud, output, organizer);
}

TEST(ScatteredInput, onlyTheIndicesCount)
{
  const Cloud cloud =
      withoutGrid(laserCloud(turningLaser(360, 16), [](int, int) { return 6.0; }));
  auto half = pcl::make_shared<Indices>();
  for (std::size_t i = 0; i < cloud.size() / 2; ++i)
    half->push_back(static_cast<index_t>(i));
  CloudOrganizer<PointXYZ> organizer;
  organizer.setInputCloud(cloud.makeShared());
  organizer.setIndices(half);
  Cloud output;
  ASSERT_TRUE(organizer.organize(output));
  for (const std::int32_t index : organizer.getCellPoints())
    EXPECT_LT(index, static_cast<std::int32_t>(cloud.size() / 2));
}

} // namespace
