// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// What an alignment says about itself: covariance by Monte Carlo, directions without
// support in scenes that have some.

#include <pcl/registration/scan_registration.h>

#include "registration_scenes.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

MatchResult
alignScene(const Scene& scene,
           const Eigen::Isometry3d& truth,
           double noise,
           MatchMetric metric,
           std::mt19937& random,
           double voxel_size = 0.7)
{
  const auto first = sampleScene(scene, 8000, noise, random);
  const auto second = sampleScene(scene, 4000, noise, random);
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(metric);
  registration.setVoxelSize(voxel_size);
  registration.setInputTarget(
      cloudSeenFrom<PointXYZ>(Eigen::Isometry3d::Identity(), first));
  registration.setInputSource(cloudSeenFrom<PointXYZ>(truth, second));
  Cloud aligned;
  registration.align(aligned);
  EXPECT_TRUE(registration.hasConverged());
  return registration.getResult();
}

/** Mean of the normalised squared error over independent scans; 6 when the covariance
 * is right. */
double
meanNees(const Scene& scene, double noise, MatchMetric metric, int runs)
{
  double sum = 0.0;
  for (int i = 0; i < runs; ++i) {
    std::mt19937 random(1000 + i);
    const Eigen::Isometry3d truth = randomMotion(0.1, 0.01, random);
    const MatchResult result = alignScene(scene, truth, noise, metric, random, 0.3);
    const Tangent error = logarithm(result.pose.inverse() * truth);
    EXPECT_LT((result.covariance * result.information - TangentMatrix::Identity())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-3);
    sum += error.dot(result.information * error);
  }
  return sum / runs;
}

TEST(MatchCovariance, NormalisedErrorIsWithinIts95PercentInterval)
{
  constexpr int kRuns = 80;
  // The sum over runs is chi-square with 6 runs degrees of freedom, nearly normal.
  const double half_width = 1.96 * std::sqrt(2.0 * 6.0 * kRuns) / kRuns;
  EXPECT_NEAR(
      meanNees(room(), 0.015, MatchMetric::PointToPlane, kRuns), 6.0, half_width);
}

TEST(MatchCovariance, GrowsWithTheNoise)
{
  std::mt19937 random(1);
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  const MatchResult quiet =
      alignScene(room(), still, 0.005, MatchMetric::PointToPlane, random, 0.3);
  const MatchResult noisy =
      alignScene(room(), still, 0.02, MatchMetric::PointToPlane, random, 0.3);
  const double ratio = std::sqrt(noisy.covariance.trace() / quiet.covariance.trace());
  EXPECT_GT(ratio, 1.3); // the spacing of the points at edges does not grow
  EXPECT_LT(ratio, 8.0);
}

/** Unsupported directions of a scene, as a projector in (m, m) units. */
TangentMatrix
unsupportedSpace(const MatchResult& result)
{
  const auto space =
      result.degeneracy.directions.leftCols(result.degeneracy.unsupported);
  return space * space.transpose();
}

TEST(Degeneracy, APlaneHoldsThreeDirections)
{
  for (const auto metric : {MatchMetric::PointToPlane, MatchMetric::PointToPoint}) {
    std::mt19937 random(2);
    const MatchResult result =
        alignScene(ground(10), Eigen::Isometry3d::Identity(), 0.01, metric, random);
    EXPECT_EQ(result.degeneracy.unsupported, 3);
    TangentMatrix expected = TangentMatrix::Zero();
    expected.diagonal() << 1, 1, 0, 0, 0, 1; // x, y, yaw
    EXPECT_LT((unsupportedSpace(result) - expected).norm(), 0.2);
    EXPECT_GE(result.covariance(0, 0), 0.9 * kUnsupportedVariance);
    EXPECT_LT(result.information(0, 0), 1e-2 * result.information(2, 2));
  }
}

TEST(Degeneracy, ACorridorHoldsAllButItsOwnDirection)
{
  std::mt19937 random(3);
  const MatchResult result = alignScene(corridor(),
                                        Eigen::Isometry3d::Identity(),
                                        0.01,
                                        MatchMetric::PointToPlane,
                                        random);
  EXPECT_EQ(result.degeneracy.unsupported, 1);
  EXPECT_GT(std::abs(result.degeneracy.directions(0, 0)), 0.99);
  EXPECT_LT(result.covariance(1, 1), 1e-3);
  // Not measured, so not moved.
  EXPECT_LT(std::abs(result.pose.translation().x()), 0.02);
}

TEST(Degeneracy, AStreetHoldsAll)
{
  std::mt19937 random(4);
  const MatchResult result = alignScene(
      street(), Eigen::Isometry3d::Identity(), 0.01, MatchMetric::PlaneToPlane, random);
  EXPECT_EQ(result.degeneracy.unsupported, 0);
  EXPECT_LT(result.covariance.trace(), 0.01);
}

} // namespace
