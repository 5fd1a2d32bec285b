// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// What an alignment says about itself: covariance by Monte Carlo, directions without
// support in scenes that have some.

#include <pcl/registration/scan_registration.h>

#include "registration_scenes.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

/** Align two independent samples of a scene. */
MatchResult
alignSamples(ScanRegistration<PointXYZ>& registration,
             const Scene& scene,
             const Eigen::Isometry3d& truth,
             double noise,
             std::mt19937& random)
{
  const auto first = sampleScene(scene, 8000, noise, random);
  const auto second = sampleScene(scene, 4000, noise, random);
  registration.setInputTarget(
      cloudSeenFrom<PointXYZ>(Eigen::Isometry3d::Identity(), first));
  registration.setInputSource(cloudSeenFrom<PointXYZ>(truth, second));
  Cloud aligned;
  registration.align(aligned);
  EXPECT_TRUE(registration.hasConverged());
  return registration.getResult();
}

MatchResult
alignScene(const Scene& scene,
           const Eigen::Isometry3d& truth,
           double noise,
           MatchMetric metric,
           std::mt19937& random,
           double voxel_size = 0.7)
{
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(metric);
  registration.setVoxelSize(voxel_size);
  return alignSamples(registration, scene, truth, noise, random);
}

/** What is drawn anew many times. */
struct Trial {
  std::string name;
  Scene scene;
  MatchMetric metric;
  double voxel_size;
  double noise;
  int runs;
};

std::ostream&
operator<<(std::ostream& stream, const Trial& trial)
{
  return stream << trial.name << ", metric " << static_cast<int>(trial.metric);
}

/** An alignment that ends at the gradient's root, which the covariance is of: one that
 * ends earlier keeps something of its guess. */
MatchResult
alignToTheEnd(const Trial& trial, const Eigen::Isometry3d& truth, std::mt19937& random)
{
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(trial.metric);
  registration.setVoxelSize(trial.voxel_size);
  registration.setTransformationEpsilon(1e-12);
  registration.setMaximumIterations(300);
  registration.setNumberOfThreads(2);
  return alignSamples(registration, trial.scene, truth, trial.noise, random);
}

/** Sums over independent pairs of scans, with noise in both. */
struct NeesSums {
  double squares = 0.0;
  double supported = 0.0;
};

NeesSums
neesOf(const Trial& trial)
{
  NeesSums sums;
  for (int i = 0; i < trial.runs; ++i) {
    std::mt19937 random(1000 + i);
    const Eigen::Isometry3d truth = randomMotion(0.1, 0.01, random);
    const MatchResult result = alignToTheEnd(trial, truth, random);
    const Tangent error = logarithm(result.pose.inverse() * truth);
    sums.squares += error.dot(result.information * error);
    sums.supported += 6 - result.degeneracy.unsupported;
  }
  return sums;
}

class NormalisedError : public ::testing::TestWithParam<Trial> {};

TEST_P(NormalisedError, IsWithinIts95PercentInterval)
{
  const NeesSums sums = neesOf(GetParam());
  // Chi-square with so many degrees of freedom, nearly normal.
  EXPECT_NEAR(sums.squares, sums.supported, 1.96 * std::sqrt(2.0 * sums.supported));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes,
    NormalisedError,
    ::testing::Values(
        Trial{"room", room(), MatchMetric::PointToPlane, 0.3, 0.015, 80},
        Trial{"room", room(), MatchMetric::PointToPoint, 0.3, 0.015, 16},
        Trial{"room", room(), MatchMetric::PlaneToPlane, 0.3, 0.015, 24},
        Trial{"street", street(), MatchMetric::PointToPlane, 0.7, 0.02, 16},
        Trial{"street", street(), MatchMetric::PointToPoint, 0.7, 0.02, 12},
        // Half as many points have normals of their own only in larger voxels.
        Trial{"street", street(), MatchMetric::PlaneToPlane, 1.4, 0.02, 24},
        Trial{"corridor", corridor(), MatchMetric::PointToPlane, 0.7, 0.01, 24},
        Trial{"corridor", corridor(), MatchMetric::PlaneToPlane, 0.7, 0.01, 24}));

TEST(MatchCovariance, OfNearestPointsInACorridorIsOnTheSafeSide)
{
  // Points near edges have nearest ones across the edge: the same at both sides, so
  // that they cancel, but known to be so by nobody.
  const NeesSums sums =
      neesOf({"corridor", corridor(), MatchMetric::PointToPoint, 0.7, 0.01, 8});
  EXPECT_EQ(sums.supported, 8.0 * 5.0);
  EXPECT_LT(sums.squares, sums.supported + 1.96 * std::sqrt(2.0 * sums.supported));
  EXPECT_GT(sums.squares, 0.5 * sums.supported);
}

TEST(MatchCovariance, AndInformationAreInverse)
{
  for (const auto metric : {MatchMetric::PointToPoint,
                            MatchMetric::PointToPlane,
                            MatchMetric::PlaneToPlane}) {
    std::mt19937 random(7);
    const MatchResult result =
        alignScene(room(), Eigen::Isometry3d::Identity(), 0.015, metric, random, 0.3);
    EXPECT_LT((result.covariance * result.information - TangentMatrix::Identity())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-3);
  }
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
