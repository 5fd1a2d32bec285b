// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// pcl::ScanRegistration where a program holds a pcl::Registration: what the setters of
// the base mean, beside pcl::IterativeClosestPoint driven by the same code.

#include <pcl/registration/scan_registration.h>

#include "registration_scenes.h"

#include <pcl/registration/correspondence_rejection_distance.h>
#include <pcl/registration/icp.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;
using Base = Registration<PointXYZ, PointXYZ>;

struct Pair {
  Cloud::Ptr target;
  Cloud::Ptr source;
  Eigen::Isometry3d truth;
};

/** Two samples of a room, the second one seen from up to half a metre off. */
Pair
makePair()
{
  std::mt19937 random(7);
  Pair pair;
  pair.truth = randomMotion(0.5, 0.1, random);
  pair.target = cloudSeenFrom<PointXYZ>(Eigen::Isometry3d::Identity(),
                                        sampleScene(room(), 6000, 0.005, random));
  pair.source =
      cloudSeenFrom<PointXYZ>(pair.truth, sampleScene(room(), 6000, 0.005, random));
  return pair;
}

/** A guess some centimetres off. */
Eigen::Matrix4f
guessOf(const Pair& pair)
{
  std::mt19937 random(8);
  return (pair.truth * randomMotion(0.1, 0.02, random)).matrix().cast<float>();
}

double
distanceFrom(const Pair& pair, const Eigen::Matrix4f& pose)
{
  return (pose.topRightCorner<3, 1>().cast<double>() - pair.truth.translation()).norm();
}

Base::Ptr
registrationNamed(const std::string& name)
{
  if (name == "ICP")
    return Base::Ptr(new IterativeClosestPoint<PointXYZ, PointXYZ>);
  return Base::Ptr(new ScanRegistration<PointXYZ>);
}

class BothRegistrations : public ::testing::TestWithParam<std::string> {
protected:
  BothRegistrations() : pair_(makePair()), registration_(registrationNamed(GetParam()))
  {
    registration_->setInputTarget(pair_.target);
    registration_->setInputSource(pair_.source);
  }

  Pair pair_;
  Base::Ptr registration_;
  Cloud aligned_;
};

TEST_P(BothRegistrations, AlignFromAGuess)
{
  registration_->setMaxCorrespondenceDistance(0.5);
  registration_->setMaximumIterations(100);
  registration_->setTransformationEpsilon(1e-10);
  registration_->align(aligned_, guessOf(pair_));
  ASSERT_TRUE(registration_->hasConverged());
  EXPECT_LT(distanceFrom(pair_, registration_->getFinalTransformation()), 0.02);
  ASSERT_EQ(aligned_.size(), pair_.source->size());
  const Eigen::Matrix4f pose = registration_->getFinalTransformation();
  for (std::size_t i = 0; i < aligned_.size(); i += 500)
    EXPECT_LT(
        (aligned_[i].getVector4fMap() - pose * (*pair_.source)[i].getVector4fMap())
            .norm(),
        1e-4F);
}

TEST_P(BothRegistrations, ScoreFitnessWithinARange)
{
  (*pair_.source)[0].x += 50.0F; // one point without a partner
  registration_->setMaxCorrespondenceDistance(0.5);
  registration_->align(aligned_, guessOf(pair_));
  ASSERT_TRUE(registration_->hasConverged());
  EXPECT_GT(registration_->getFitnessScore(), 0.1);
  EXPECT_LT(registration_->getFitnessScore(1.0), 0.02);
}

TEST_P(BothRegistrations, StopAfterTheLargestNumberOfIterations)
{
  registration_->setMaxCorrespondenceDistance(0.5);
  registration_->setMaximumIterations(100);
  registration_->align(aligned_, guessOf(pair_));
  const double full = distanceFrom(pair_, registration_->getFinalTransformation());
  registration_->setMaximumIterations(1);
  EXPECT_EQ(registration_->getMaximumIterations(), 1);
  Eigen::Matrix4f far = guessOf(pair_);
  far(0, 3) += 0.3F;
  registration_->align(aligned_, far);
  EXPECT_GT(distanceFrom(pair_, registration_->getFinalTransformation()), full);
  EXPECT_TRUE(registration_->getFinalTransformation().allFinite());
}

TEST_P(BothRegistrations, FindNoPairsFartherThanAllowed)
{
  Eigen::Matrix4f far = guessOf(pair_);
  far(2, 3) += 40.0F;
  registration_->setMaxCorrespondenceDistance(0.2);
  EXPECT_EQ(registration_->getMaxCorrespondenceDistance(), 0.2);
  registration_->align(aligned_, far);
  EXPECT_FALSE(registration_->hasConverged());
}

TEST_P(BothRegistrations, TakeNewCloudsOneAfterTheOther)
{
  registration_->setMaxCorrespondenceDistance(0.5);
  registration_->setMaximumIterations(100);
  registration_->align(aligned_, guessOf(pair_));
  ASSERT_TRUE(registration_->hasConverged());
  // The target itself, seen from where it is: the pose is none.
  registration_->setInputSource(pair_.target);
  registration_->align(aligned_);
  ASSERT_TRUE(registration_->hasConverged());
  EXPECT_TRUE(registration_->getFinalTransformation().isIdentity(1e-3F));
}

INSTANTIATE_TEST_SUITE_P(OfPclAndOurs,
                         BothRegistrations,
                         ::testing::Values("ICP", "ScanRegistration"));

/** Ours from the guess, after settings by \a set. */
template <typename Set>
MatchResult
alignAfter(const Pair& pair, const Set& set)
{
  ScanRegistration<PointXYZ> registration;
  registration.setInputTarget(pair.target);
  registration.setInputSource(pair.source);
  set(registration);
  Cloud aligned;
  registration.align(aligned, guessOf(pair));
  return registration.getResult();
}

TEST(RegistrationBase, ALargerEpsilonStopsEarlier)
{
  const Pair pair = makePair();
  const auto iterationsAt = [&](double epsilon) {
    return alignAfter(pair,
                      [&](auto& registration) {
                        registration.setCoarserMaps(0);
                        registration.setTransformationEpsilon(epsilon);
                        registration.setTransformationRotationEpsilon(
                            std::cos(std::sqrt(epsilon)));
                      })
        .iterations;
  };
  EXPECT_LT(iterationsAt(1e-3), iterationsAt(1e-12));
}

TEST(RegistrationBase, IterationsAreCountedAndLimited)
{
  const Pair pair = makePair();
  for (const int most : {1, 2, 3})
    EXPECT_EQ(alignAfter(pair,
                         [&](auto& registration) {
                           registration.setCoarserMaps(0);
                           registration.setTransformationEpsilon(1e-30);
                           registration.setMaximumIterations(most);
                         })
                  .iterations,
              most);
}

TEST(RegistrationBase, WhatIsNotUsedChangesNothing)
{
  const Pair pair = makePair();
  const MatchResult plain = alignAfter(pair, [](auto&) {});
  const MatchResult set = alignAfter(pair, [](auto& registration) {
    registration.setEuclideanFitnessEpsilon(10.0);
    registration.setRANSACIterations(3);
    registration.setRANSACOutlierRejectionThreshold(1e-6);
    const registration::CorrespondenceRejectorDistance::Ptr rejector(
        new registration::CorrespondenceRejectorDistance);
    rejector->setMaximumDistance(1e-6F);
    registration.addCorrespondenceRejector(rejector);
  });
  EXPECT_EQ(plain.pose.matrix(), set.pose.matrix());
}

TEST(RegistrationBase, KeepsTheShapeOfAnOrganizedCloud)
{
  Pair pair = makePair();
  pair.source->width = 100;
  pair.source->height = static_cast<std::uint32_t>(pair.source->size() / 100);
  pair.source->header.frame_id = "laser";
  ScanRegistration<PointXYZ> registration;
  registration.setInputTarget(pair.target);
  registration.setInputSource(pair.source);
  Cloud aligned;
  registration.align(aligned);
  ASSERT_TRUE(registration.hasConverged());
  EXPECT_EQ(aligned.width, pair.source->width);
  EXPECT_EQ(aligned.height, pair.source->height);
}

} // namespace
