// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// pcl::ScanRegistration against known motions, over noise, overlap, error of the guess
// and kind of scene.

#include <pcl/registration/scan_registration.h>

#include "registration_scenes.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

Scene
sceneNamed(const std::string& name)
{
  if (name == "street")
    return street();
  return name == "room" ? room() : columns();
}

struct Problem {
  Cloud::Ptr target;
  Cloud::Ptr source;
  Eigen::Isometry3d truth;
};

/** Two independent samples of a scene; the source sees only a share of its length. */
Problem
makeProblem(const Scene& scene,
            double noise,
            double overlap,
            unsigned int seed,
            int points = 10000)
{
  std::mt19937 random(seed);
  Problem problem;
  problem.truth = randomMotion(0.5, 0.1, random);
  const auto all = sampleScene(scene, points, noise, random);
  auto seen = sampleScene(scene, points, noise, random);
  double low = 1e9;
  double high = -1e9;
  for (const Eigen::Vector3d& point : seen) {
    low = std::min(low, point.x());
    high = std::max(high, point.x());
  }
  const double cut = low + (1.0 - overlap) * (high - low);
  std::vector<Eigen::Vector3d> known;
  for (const Eigen::Vector3d& point : all)
    if (point.x() >= cut)
      known.push_back(point);
  problem.target = cloudSeenFrom<PointXYZ>(Eigen::Isometry3d::Identity(), known);
  problem.source = cloudSeenFrom<PointXYZ>(problem.truth, seen);
  return problem;
}

Tangent
errorOf(const Eigen::Isometry3d& truth, const Eigen::Isometry3d& pose)
{
  return logarithm(truth.inverse() * pose);
}

/** Allowed errors. Nearest points lie somewhere on the surface: their spacing is noise.
 * Planes through pieces of a column lie a little inside of it. */
Tangent
limitFor(const std::string& name, MatchMetric metric, double noise)
{
  const double size = name == "room" ? 0.25 : 1.0;
  const double kind = name == "columns" ? 2.0 : 1.0;
  const double points = metric == MatchMetric::PointToPoint ? 10.0 : 1.0;
  Tangent limit;
  limit.head<3>().setConstant(kind * points * (0.015 * size + 0.1 * noise));
  limit.tail<3>().setConstant(kind * points * 0.004);
  return limit;
}

using Parameters = std::tuple<std::string, MatchMetric, double, double, double>;

class RegistrationAccuracy : public ::testing::TestWithParam<Parameters> {};

TEST_P(RegistrationAccuracy, FindsTheMotion)
{
  const auto [name, metric, noise, overlap, guess_error] = GetParam();
  const double size = name == "room" ? 0.25 : 1.0;
  for (unsigned int seed = 1; seed <= 2; ++seed) {
    const Problem problem = makeProblem(sceneNamed(name), noise, overlap, seed);
    std::mt19937 random(100 + seed);
    const Eigen::Isometry3d guess =
        problem.truth * randomMotion(size * guess_error, 0.1 * guess_error, random);
    ScanRegistration<PointXYZ> registration;
    registration.setMetric(metric);
    registration.setNumberOfThreads(2); // changes nothing but the time
    registration.setInputTarget(problem.target);
    registration.setInputSource(problem.source);
    Cloud aligned;
    registration.align(aligned, guess.matrix().cast<float>());
    ASSERT_TRUE(registration.hasConverged()) << "seed " << seed;
    const Tangent error = errorOf(problem.truth, registration.getResult().pose);
    const Tangent limit = limitFor(name, metric, noise);
    EXPECT_LT(error.head<3>().norm(), limit[0]) << "seed " << seed;
    EXPECT_LT(error.tail<3>().norm(), limit[3]) << "seed " << seed;
    EXPECT_TRUE(aligned[0].getVector3fMap().isApprox(
        (registration.getResult().pose *
         (*problem.source)[0].getVector3fMap().cast<double>())
            .cast<float>(),
        1e-4F));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Conditions,
    RegistrationAccuracy,
    ::testing::Combine(::testing::Values("street", "room", "columns"),
                       ::testing::Values(MatchMetric::PointToPoint,
                                         MatchMetric::PointToPlane,
                                         MatchMetric::PlaneToPlane),
                       ::testing::Values(0.0, 0.02),
                       ::testing::Values(1.0, 0.6),
                       ::testing::Values(0.1, 0.5)));

/** One alignment with default options, by threads. */
MatchResult
alignWith(unsigned int threads, MatchMetric metric)
{
  const Problem problem = makeProblem(street(), 0.02, 0.8, 5, 4000);
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(metric);
  registration.setNumberOfThreads(threads);
  registration.setInputTarget(problem.target);
  registration.setInputSource(problem.source);
  Cloud aligned;
  registration.align(aligned);
  EXPECT_TRUE(registration.hasConverged());
  return registration.getResult();
}

TEST(ScanRegistration, SameBitsForAnyNumberOfThreads)
{
  for (const auto metric : {MatchMetric::PointToPoint,
                            MatchMetric::PointToPlane,
                            MatchMetric::PlaneToPlane}) {
    const MatchResult one = alignWith(1, metric);
    for (const unsigned int threads : {2U, 3U, 7U}) {
      const MatchResult many = alignWith(threads, metric);
      EXPECT_EQ(one.pose.matrix(), many.pose.matrix());
      EXPECT_EQ(one.covariance, many.covariance);
      EXPECT_EQ(one.rmse, many.rmse);
    }
  }
}

TEST(ScanRegistration, WorksThroughTheBaseOfPcl)
{
  const Problem problem = makeProblem(room(), 0.0, 1.0, 2);
  const Registration<PointXYZ, PointXYZ>::Ptr registration(
      new ScanRegistration<PointXYZ>);
  registration->setInputTarget(problem.target);
  registration->setInputSource(problem.source);
  Cloud aligned;
  registration->align(aligned);
  ASSERT_TRUE(registration->hasConverged());
  EXPECT_TRUE(registration->getFinalTransformation().isApprox(
      problem.truth.matrix().cast<float>(), 0.01F));
  search::KdTree<PointXYZ> tree; // the score by its definition
  tree.setInputCloud(problem.target);
  double sum = 0.0;
  for (const PointXYZ& point : aligned) {
    Indices index(1);
    std::vector<float> square(1);
    tree.nearestKSearch(point, 1, index, square);
    sum += square[0];
  }
  EXPECT_NEAR(
      registration->getFitnessScore(), sum / static_cast<double>(aligned.size()), 1e-6);
}

TEST(ScanRegistration, OutliersDoNotCount)
{
  Problem problem = makeProblem(street(), 0.01, 1.0, 8);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-10.0F, 10.0F);
  for (std::size_t i = 0; i < problem.source->size(); i += 4)
    (*problem.source)[i] = PointXYZ(place(random), place(random), place(random) / 4.0F);
  ScanRegistration<PointXYZ> registration;
  registration.setInputTarget(problem.target);
  registration.setInputSource(problem.source);
  Cloud aligned;
  registration.align(aligned);
  ASSERT_TRUE(registration.hasConverged());
  EXPECT_LT(errorOf(problem.truth, registration.getResult().pose).head<3>().norm(),
            0.02);
}

TEST(ScanRegistration, PointsOfOtherTypesAndIndices)
{
  const Problem problem = makeProblem(room(), 0.005, 1.0, 3);
  PointCloud<PointXYZI>::Ptr target(new PointCloud<PointXYZI>);
  PointCloud<PointXYZI>::Ptr source(new PointCloud<PointXYZI>);
  copyPointCloud(*problem.target, *target);
  copyPointCloud(*problem.source, *source);
  const IndicesPtr some(new Indices);
  for (index_t i = 0; i < static_cast<index_t>(source->size()); ++i)
    if (i % 3 == 0)
      some->push_back(i);
    else
      (*source)[static_cast<std::size_t>(i)].x += 5.0F; // must not be looked at
  ScanRegistration<PointXYZI> registration;
  registration.setInputTarget(target);
  registration.setInputSource(source);
  registration.setIndices(some);
  PointCloud<PointXYZI> aligned;
  registration.align(aligned);
  ASSERT_TRUE(registration.hasConverged());
  EXPECT_EQ(aligned.size(), some->size());
  EXPECT_LT(errorOf(problem.truth, registration.getResult().pose).norm(), 0.02);
}

TEST(ScanRegistration, SomePointsWithoutNumbersAreSkipped)
{
  Problem problem = makeProblem(room(), 0.0, 1.0, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < problem.source->size(); i += 5) {
    (*problem.source)[i].x = nan;
    (*problem.target)[i].z = nan;
  }
  problem.source->is_dense = problem.target->is_dense = false;
  ScanRegistration<PointXYZ> registration;
  registration.setInputTarget(problem.target);
  registration.setInputSource(problem.source);
  Cloud aligned;
  registration.align(aligned);
  ASSERT_TRUE(registration.hasConverged());
  EXPECT_LT(errorOf(problem.truth, registration.getResult().pose).norm(), 0.02);
  EXPECT_LT(registration.getFitnessScore(), 0.01);
}

} // namespace
