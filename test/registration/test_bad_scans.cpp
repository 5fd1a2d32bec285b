// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// pcl::ScanRegistration with clouds and guesses that cannot be aligned: one line that
// names the reason, no convergence, and numbers that stay finite.

#include <pcl/registration/scan_registration.h>

#include "registration_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Cloud::Ptr
roomCloud()
{
  std::mt19937 random(1);
  return cloudSeenFrom<PointXYZ>(Eigen::Isometry3d::Identity(),
                                 sampleScene(room(), 4000, 0.005, random));
}

Cloud::Ptr
moved(const Cloud& cloud, float x)
{
  Cloud::Ptr result(new Cloud(cloud));
  for (PointXYZ& point : *result)
    point.x += x;
  return result;
}

/** So many points that a function of their number makes. */
Cloud::Ptr
cloudOf(int count, const std::function<PointXYZ(float)>& make)
{
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < count; ++i)
    cloud->push_back(make(static_cast<float>(i)));
  return cloud;
}

/** Aligns a good pair and then a bad one; what the bad one printed. */
std::string
refusal(MatchMetric metric,
        const Cloud::Ptr& target,
        const Cloud::Ptr& source,
        const Eigen::Matrix4f& guess = Eigen::Matrix4f::Identity())
{
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(metric);
  registration.setInputTarget(roomCloud());
  registration.setInputSource(roomCloud());
  Cloud aligned;
  registration.align(aligned);
  EXPECT_TRUE(registration.hasConverged());
  testing::internal::CaptureStderr();
  registration.setInputTarget(target);
  registration.setInputSource(source);
  registration.align(aligned, guess);
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_TRUE(registration.getFinalTransformation().allFinite());
  EXPECT_TRUE(registration.getResult().pose.matrix().allFinite());
  EXPECT_TRUE(registration.getCovariance().isZero());
  return testing::internal::GetCapturedStderr();
}

/** The same both ways round and for all distances; the line must name the reason. */
void
expectRefusal(const Cloud::Ptr& bad, const std::string& reason)
{
  for (const auto metric : {MatchMetric::PointToPoint,
                            MatchMetric::PointToPlane,
                            MatchMetric::PlaneToPlane}) {
    const std::string as_target = refusal(metric, bad, roomCloud());
    const std::string as_source = refusal(metric, roomCloud(), bad);
    EXPECT_NE(as_target.find(reason), std::string::npos) << as_target;
    EXPECT_NE(as_source.find(reason), std::string::npos) << as_source;
  }
}

TEST(BadScans, NoPoints)
{
  expectRefusal(Cloud::Ptr(new Cloud), "nvalid or empty point cloud");
  expectRefusal(nullptr, "No cloud given");
}

TEST(BadScans, NoNumbers)
{
  expectRefusal(cloudOf(100, [](float) { return PointXYZ(kNan, kNan, kNan); }),
                "no finite point");
  expectRefusal(cloudOf(100, [](float i) { return PointXYZ(i, kInfinity, 0.0F); }),
                "no finite point");
}

TEST(BadScans, OnePoint)
{
  expectRefusal(cloudOf(1, [](float) { return PointXYZ(1, 2, 3); }), "align]");
}

TEST(BadScans, OnePointManyTimesOver)
{
  const auto point = cloudOf(500, [](float) { return PointXYZ(1.1F, 2.3F, 0.7F); });
  for (const auto metric : {MatchMetric::PointToPlane, MatchMetric::PlaneToPlane})
    EXPECT_NE(refusal(metric, point, point).find("No direction"), std::string::npos);
}

TEST(BadScans, OneLineOnly)
{
  const auto line =
      cloudOf(500, [](float i) { return PointXYZ(0.01F * i - 2.5F, 0.3F, -0.4F); });
  for (const auto metric : {MatchMetric::PointToPoint, MatchMetric::PointToPlane})
    EXPECT_NE(refusal(metric, line, line).find("No direction"), std::string::npos);
}

TEST(BadScans, NoOverlap)
{
  expectRefusal(moved(*roomCloud(), 1000.0F), "do not overlap");
}

TEST(BadScans, TooFarFromTheOrigin)
{
  const auto far = moved(*roomCloud(), 1e6F);
  EXPECT_NE(refusal(MatchMetric::PointToPlane, far, far).find("million voxels"),
            std::string::npos);
}

TEST(BadScans, SomeInfinitePointsAreSkipped)
{
  const auto source = moved(*roomCloud(), 0.05F);
  for (std::size_t i = 0; i < source->size(); i += 7)
    (*source)[i].y = i % 2 == 0 ? kInfinity : -kInfinity;
  source->is_dense = false;
  ScanRegistration<PointXYZ> registration;
  registration.setInputTarget(roomCloud());
  registration.setInputSource(source);
  Cloud aligned;
  registration.align(aligned);
  ASSERT_TRUE(registration.hasConverged());
  EXPECT_NEAR(registration.getResult().pose.translation().x(), -0.05, 0.002);
}

TEST(BadScans, GuessesThatAreNoMotion)
{
  const auto cloud = roomCloud();
  const auto reasonFor = [&](const Eigen::Matrix4f& guess) {
    return refusal(MatchMetric::PointToPlane, cloud, cloud, guess);
  };
  EXPECT_NE(reasonFor(Eigen::Matrix4f::Constant(kNan)).find("not finite"),
            std::string::npos);
  Eigen::Matrix4f scaled = Eigen::Matrix4f::Identity();
  scaled.topLeftCorner<3, 3>() *= 1.1F;
  Eigen::Matrix4f mirrored = Eigen::Matrix4f::Identity();
  mirrored(2, 2) = -1.0F;
  Eigen::Matrix4f projective = Eigen::Matrix4f::Identity();
  projective(3, 0) = 0.5F;
  for (const Eigen::Matrix4f& guess : {scaled, mirrored, projective})
    EXPECT_NE(reasonFor(guess).find("not a rigid motion"), std::string::npos);
}

} // namespace
