// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// From labelled cells to patches: known shapes, what is held out, threads.

#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/mapping/surface_reconstruction.h>

#include "camera_views.h"
#include "reconstruction_checks.h"

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

double
coverage(const Reconstruction& reconstruction)
{
  return static_cast<double>(summarize(reconstruction).covered_points) /
         static_cast<double>(reconstruction.labels.size());
}

TEST(SurfaceReconstruction, planeIsOneBilinearPatch)
{
  const GridPoints points = noisyView(tilted, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  ASSERT_EQ(result.model.patches.size(), 1U);
  const SurfacePatch& patch = result.model.patches.front();
  EXPECT_EQ(patch.geometry.surface().numControlPoints(), 4);
  EXPECT_GT(coverage(result), 0.99);
  EXPECT_NEAR(patch.quality.noise, 0.002, 1e-9);
  // 16 000 points average the noise out: the control net lies on the true plane.
  const Eigen::Matrix3Xd net =
      patch.geometry.surface().homogeneousPoints().colwise().hnormalized();
  const Eigen::Vector3d normal = Eigen::Vector3d(
      0.0004 * 130.0, 0.0003 * 130.0, 0.4 + 0.0004 * 79.5 + 0.0003 * 59.5);
  for (Eigen::Index k = 0; k < net.cols(); ++k)
    EXPECT_NEAR((normal.dot(net.col(k)) - 1.0) / normal.norm(), 0.0, 2e-4);
}

TEST(SurfaceReconstruction, exactPointsNeedNoNoise)
{
  const GridPoints points = noisyView(wavy, 0.0);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.0));
  EXPECT_GT(coverage(result), 0.9);
}

/** What is granted to all must not follow from one point. */
TEST(SurfaceReconstruction, wildCoordinatesHarmNobodyElse)
{
  const auto wild = [](int column, int row) {
    return column == 3 && row % 7 == 0 ? 3e37 : tilted(column, row);
  };
  const GridPoints points = noisyView(wild, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  ASSERT_GE(result.model.patches.size(), 1U);
  EXPECT_LE(result.model.patches.front().quality.rmse, 0.003);
  EXPECT_NEAR(result.model.patches.front().quality.noise, 0.002, 1e-9);
}

TEST(SurfaceReconstruction, everyPatchHoldsItsOwnPoints)
{
  const GridPoints points = noisyView(wavy, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  EXPECT_GT(coverage(result), 0.95);
  const OwnPoints own = checkOwnPoints(points, result, 3);
  EXPECT_GE(own.inside, 0.99);
  EXPECT_GE(own.agreeing, 0.995);
}

TEST(SurfaceReconstruction, twoWallsInOneSegmentBecomeTwoPatches)
{
  const auto corner = [](int column, int row) {
    return column < kWidth / 2 ? tilted(column, row)
                               : 1.0 + tilted(kWidth - column, row);
  };
  const GridPoints points = noisyView(corner, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  EXPECT_GE(result.model.patches.size(), 2U);
  EXPECT_GT(coverage(result), 0.9);
  for (const SurfacePatch& patch : result.model.patches) {
    EXPECT_LE(patch.quality.rmse, patch.quality.points > 1000 ? 0.0025 : 0.004);
    EXPECT_LE(patch.quality.max, 3.0 * 0.002 + 1e-9);
  }
}

/** Nothing of the surface may reach far into the hole of the mask. */
TEST(SurfaceReconstruction, holesStayHoles)
{
  const auto window = [](int column, int row) {
    const bool hole = column > 50 && column < 100 && row > 40 && row < 80;
    return hole ? std::numeric_limits<double>::quiet_NaN() : tilted(column, row);
  };
  const GridPoints points = noisyView(window, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  ASSERT_EQ(result.model.patches.size(), 1U);
  const TrimmedSurface& geometry = result.model.patches.front().geometry;
  for (int row = 42; row < 79; ++row)
    for (int column = 52; column < 99; ++column)
      ASSERT_FALSE(geometry.contains(column, row)) << column << ' ' << row;
  EXPECT_TRUE(geometry.contains(25.0, 60.0));
}

/** A round room seen by a laser that turns all around. */
TEST(SurfaceReconstruction, closedScanHoldsItsOwnPoints)
{
  const GridGeometry laser = turningLaser(512, 32);
  const auto points = toGridPoints(laserCloud(laser,
                                              [&](int column, int row) {
                                                const Eigen::Vector3d ray =
                                                    laser.direction(column, row);
                                                return 5.0 / ray.head<2>().norm();
                                              }),
                                   laser);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.01));
  EXPECT_GT(coverage(result), 0.9);
  EXPECT_GE(checkOwnPoints(points, result, 3).inside, 0.98);
}

/** A wall seen by a laser whose rows are not equally spaced and whose
 * sources sit below the middle of the rings, so that near rings are lower than the
 * table of angles has them. */
TEST(SurfaceReconstruction, displacedRingsHoldTheirOwnPoints)
{
  constexpr double kBelow = 0.25; // metres
  GridGeometry laser = turningLaser(900, 40);
  laser.step_v = 0.0;
  for (int row = 0; row < laser.height; ++row)
    laser.row_v.push_back(-0.05 + 0.005 * row + 0.0001 * row * row);
  PointCloud<PointXYZ> cloud(900, 40);
  for (int row = 0; row < laser.height; ++row)
    for (int column = 0; column < laser.width; ++column) {
      const Eigen::Vector3d ray = laser.direction(column, row);
      const bool ahead = ray.x() > 0.8;
      const double range = ahead ? 6.0 / ray.x() : std::nan("");
      const Eigen::Vector3d hit = range * ray - kBelow * Eigen::Vector3d::UnitZ();
      cloud(column, row).getVector3fMap() = hit.cast<float>();
    }
  const GridPoints points = toGridPoints(cloud, laser);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.01));
  ASSERT_EQ(result.model.patches.size(), 1U);
  EXPECT_GE(checkOwnPoints(points, result, 1).inside, 0.99);
}

/** A terrain seen from above, its points anywhere in their cells. */
TEST(SurfaceReconstruction, scatteredMapHoldsItsOwnPoints)
{
  GridGeometry map;
  map.projection = GridProjection::plane;
  map.frame = GridGeometry::mapFrame();
  map.width = 90;
  map.height = 70;
  map.step_u = map.step_v = 0.5;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.24, 0.24);
  PointCloud<PointXYZ> cloud(90, 70);
  for (int row = 0; row < 70; ++row)
    for (int column = 0; column < 90; ++column) {
      const double x = 0.5 * column + shift(random);
      const double y = -0.5 * row + shift(random);
      const double z = 3.0 * std::sin(0.1 * x) + 0.1 * y;
      cloud(column, row) = PointXYZ(float(x), float(y), float(z));
    }
  const GridPoints points = toGridPoints(cloud, map);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.02));
  EXPECT_GT(coverage(result), 0.95);
  EXPECT_GE(checkOwnPoints(points, result, 1).inside, 0.97);
}

TEST(SurfaceReconstruction, heldOutPointsAreOnlyMeasured)
{
  const GridPoints points = noisyView(wavy, 0.002);
  const Reconstruction before =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  GridPoints moved = points;
  std::size_t held_out = 0;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (before.held_out[cell]) {
      const float scale = ++held_out % 2 == 0 ? 1.01F : 0.97F;
      for (std::vector<float>* value : {&moved.x, &moved.y, &moved.z, &moved.depth})
        (*value)[cell] *= scale;
    }
  EXPECT_EQ(held_out, points.size() / 7);
  const Reconstruction after =
      reconstructSurfaces(moved, oneSegment(moved), constantNoise(0.002));
  EXPECT_EQ(before.held_out, after.held_out);
  ASSERT_FALSE(before.model.patches.empty());
  ASSERT_FALSE(after.model.patches.empty());
  expectSameSurface(before.model.patches.front(), after.model.patches.front());
}

TEST(SurfaceReconstruction, heldOutErrorIsTheNoise)
{
  const GridPoints points = noisyView(tilted, 0.002);
  ReconstructionOptions options;
  options.tolerance = 0.1; // so that no point is judged away
  const ReconstructionStatistics statistics = summarize(
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002), options));
  EXPECT_EQ(statistics.measured_points, points.size() / 7);
  // Noise along z, distances along the normal, 0.4 / |(0.052, 0.039, 0.45)| of it.
  EXPECT_NEAR(statistics.rmse, 0.002 * 0.989, 0.00008);
  EXPECT_NEAR(statistics.p95, 1.96 * statistics.rmse, 0.0002);
  EXPECT_NEAR(statistics.mean, std::sqrt(2.0 / M_PI) * statistics.rmse, 0.0001);
}

TEST(SurfaceReconstruction, threadsDoNotChangeABit)
{
  const GridPoints points = noisyView(wavy, 0.002);
  std::vector<std::uint32_t> labels(points.size());
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
    labels[cell] = 1 + static_cast<std::uint32_t>(cell % kWidth / 23);
  ReconstructionOptions options;
  const Reconstruction one =
      reconstructSurfaces(points, labels, constantNoise(0.002), options);
  EXPECT_EQ(one.model.patches.size(), 7U);
  for (const int threads : {2, 4}) {
    options.threads = threads;
    SCOPED_TRACE(threads);
    expectIdentical(one,
                    reconstructSurfaces(points, labels, constantNoise(0.002), options));
  }
}

TEST(SurfaceReconstruction, nearestDistancesAreThoseOfTheNearestPoint)
{
  const GridPoints points = noisyView(tilted, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002));
  std::vector<Eigen::Vector3d> queries;
  for (std::size_t cell = 0; cell < points.size(); cell += 97)
    queries.push_back(points.point(cell).cast<double>());
  queries.emplace_back(100.0, 0.0, 0.0);
  const std::vector<double> values = nearestDistances(points, result, queries, 0.01);
  ASSERT_EQ(values.size(), queries.size());
  for (std::size_t k = 0; k + 1 < queries.size(); ++k)
    if (result.labels[97 * k] != 0) {
      EXPECT_EQ(values[k], result.distances[97 * k]);
    }
  EXPECT_TRUE(std::isnan(values.back()));
}

} // namespace
