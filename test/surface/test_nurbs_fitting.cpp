// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fitting_clouds.h"

#include <pcl/surface/nurbs/conics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using pcl::nurbs::NurbsSurface;
using pcl::nurbs::Parameterization;
using namespace pcl::nurbs::test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/** Unit cylinder about a slanted axis. */
Eigen::Vector3d
pipe(double angle, double height, double noise)
{
  static const Eigen::Isometry3d frame = pcl::nurbs::frameFromAxis(
      Eigen::Vector3d(0.5, -1.0, 4.0), Eigen::Vector3d(0.3, 1.0, 0.2));
  const double r = 1.0 + noise;
  return frame *
         Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 1.5 * height);
}

double
pipeError(const NurbsSurface& surface)
{
  const Eigen::Isometry3d inverse =
      pcl::nurbs::frameFromAxis(Eigen::Vector3d(0.5, -1.0, 4.0),
                                Eigen::Vector3d(0.3, 1.0, 0.2))
          .inverse();
  double largest = 0.0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 10; ++j) {
      const auto at = [](const pcl::nurbs::KnotVector& knots, double share) {
        return knots.domainMin() + share * knots.domainLength();
      };
      const Eigen::Vector3d p =
          inverse * surface.evaluate(at(surface.knotsU(), i / 40.0),
                                     at(surface.knotsV(), j / 10.0));
      largest = std::max(largest, std::abs(p.head<2>().norm() - 1.0));
    }
  return largest;
}

/** Depth image of a plane, with some pixels missing. */
Cloud::Ptr
planeImage(const Eigen::Vector3d& normal, double distance)
{
  Cloud::Ptr cloud(new Cloud(64, 48));
  for (int row = 0; row < 48; ++row)
    for (int column = 0; column < 64; ++column) {
      const Eigen::Vector3d ray((column - 31.5) / 60.0, (row - 23.5) / 60.0, 1.0);
      const Eigen::Vector3d p = ray * distance / normal.dot(ray);
      const bool missing = (row * 7 + column) % 11 == 0;
      (*cloud)(column, row) = missing ? pcl::PointXYZ(kNan, kNan, kNan)
                                      : pcl::PointXYZ(p.x(), p.y(), p.z());
    }
  cloud->is_dense = false;
  return cloud;
}

TEST(NurbsFitting, ScatteredHillIsFittedAtItsNoise)
{
  Fitting fitting;
  fitting.setInputCloud(scatteredCloud(hill, 20000, 0.003, 1));
  fitting.setHoldOut(7);
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_NEAR(fitting.getNoise(), 0.003, 0.0006);
  EXPECT_NEAR(fitting.getReport().held_out_rmse, 0.003, 0.0005);
  EXPECT_LE(surface.numControlPoints(), 60);
  EXPECT_EQ(fitting.getUsedIndices().size(), 20000u);
}

TEST(NurbsFitting, CylinderIsExact)
{
  for (double share : {0.4, 0.9}) { // of a half turn to each side
    Fitting fitting;
    fitting.setParameterization(Parameterization::Cylinder);
    fitting.setInputCloud(scatteredCloud(
        [&](double u, double v, double) { return pipe(share * M_PI * u, v, 0.0); },
        5000,
        0.0,
        2));
    fitting.setHoldOut(7);
    NurbsSurface surface;
    ASSERT_TRUE(fitting.compute(surface));
    EXPECT_LT(pipeError(surface), 2e-6) << "the points are rounded to floats";
    EXPECT_TRUE(surface.isRational());
    EXPECT_EQ(surface.numControlPointsV(), 2);
    EXPECT_LE(surface.numControlPointsU(), 9);
  }
}

TEST(NurbsFitting, NoisyClosedCylinderMeetsItself)
{
  Fitting fitting;
  fitting.setParameterization(Parameterization::Cylinder);
  fitting.setClosed(true);
  fitting.setInputCloud(scatteredCloud(
      [](double u, double v, double noise) { return pipe(M_PI * u, v, noise); },
      20000,
      0.005,
      3));
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_LT(pipeError(surface), 0.005);
  EXPECT_NEAR(fitting.getReport().rmse, 0.005, 0.0005);
  for (int j = 0; j < surface.numControlPointsV(); ++j)
    EXPECT_EQ(surface.controlPoint(0, j),
              surface.controlPoint(surface.numControlPointsU() - 1, j));
}

TEST(NurbsFitting, FixedAxisIsKept)
{
  Fitting fitting;
  fitting.setParameterization(Parameterization::Cylinder);
  fitting.setAxis(Eigen::Vector3d(0.5, -1.0, 4.0), Eigen::Vector3d(0.3, 1.0, 0.2));
  fitting.setInputCloud(scatteredCloud(
      [](double u, double v, double) { return pipe(u, v, 0.0); }, 40, 0.0, 4));
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_LT(pipeError(surface), 5e-6);
}

TEST(NurbsFitting, AutoTakesTheCylinderForAPipe)
{
  Fitting fitting;
  fitting.setInputCloud(scatteredCloud(
      [](double u, double v, double noise) { return pipe(0.8 * M_PI * u, v, noise); },
      8000,
      0.002,
      5));
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_LT(fitting.getReport().rmse, 0.0025);
  EXPECT_LE(surface.numControlPoints(), 18);
}

TEST(NurbsFitting, PlaneOfADepthImage)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.2, 1.0).normalized();
  Fitting fitting;
  fitting.setInputCloud(planeImage(normal, 2.0));
  pcl::nurbs::PinholeCamera camera;
  camera.fx = camera.fy = 60.0;
  camera.cx = 31.5;
  camera.cy = 23.5;
  fitting.setCamera(camera);
  for (Parameterization parameterization : {Parameterization::Auto,
                                            Parameterization::Perspective,
                                            Parameterization::Plane}) {
    fitting.setParameterization(parameterization);
    NurbsSurface surface;
    ASSERT_TRUE(fitting.compute(surface));
    EXPECT_EQ(surface.numControlPoints(), 4);
    EXPECT_LT(fitting.getReport().max, 2e-6);
    EXPECT_LT(fitting.getUsedIndices().size(), 64u * 48u);
  }
}

TEST(NurbsFitting, GridGivesColumnAndRow)
{
  Cloud::Ptr cloud(new Cloud(40, 30));
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      (*cloud)(column, row) = pcl::PointXYZ(
          0.1f * column, 0.1f * row, 0.02f * (column - 20) * (column - 20) * 0.1f);
  Fitting fitting;
  fitting.setInputCloud(cloud);
  fitting.setParameterization(Parameterization::Grid);
  fitting.setDistance(pcl::nurbs::FitDistance::Parametric);
  fitting.setAdaptive(false);
  fitting.setDegree(2, 1);
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_EQ(surface.knotsU().degree(), 2);
  EXPECT_EQ(surface.knotsV().degree(), 1);
  EXPECT_NEAR(surface.knotsU().domainMax(), 39.0, 1e-12);
  EXPECT_LT((surface.evaluate(10.0, 20.0) - Eigen::Vector3d(1.0, 2.0, 0.2)).norm(),
            1e-6);
}

TEST(NurbsFitting, GivenParametersFixedKnotsAndWeights)
{
  const Cloud::Ptr cloud = scatteredCloud(
      [](double u, double v, double) {
        return Eigen::Vector3d(
            0.6 * u, 0.6 * v, std::sqrt(1.0 - 0.36 * (u * u + v * v)));
      },
      2000,
      0.0,
      6);
  Eigen::Matrix2Xd parameters(2, cloud->size());
  for (std::size_t k = 0; k < cloud->size(); ++k)
    parameters.col(k) << (*cloud)[k].x, (*cloud)[k].y;
  Fitting fitting;
  fitting.setInputCloud(cloud);
  fitting.setParameterization(Parameterization::Given);
  NurbsSurface surface;
  EXPECT_FALSE(fitting.compute(surface)) << "parameters are missing";
  fitting.setParameters(parameters);
  const pcl::nurbs::KnotVector knots = pcl::nurbs::KnotVector::bezier(2, -0.6, 0.6);
  fitting.setKnots(knots, knots);
  fitting.setOptimizeWeights(true);
  fitting.setFairness(0.0);
  fitting.setMaximumIterations(60);
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_EQ(surface.numControlPoints(), 9);
  EXPECT_LT(fitting.getReport().rmse, 1e-7) << "the points are rounded to floats";
}

TEST(NurbsFitting, IndicesChooseTheSegment)
{
  Cloud::Ptr cloud = scatteredCloud(hill, 5000, 0.0, 7);
  const auto half = cloud->size() / 2;
  pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t k = 0; k < cloud->size(); ++k)
    if (k < half)
      indices->push_back(static_cast<pcl::index_t>(k));
    else
      (*cloud)[k].z = 100.0f;
  Fitting fitting;
  fitting.setInputCloud(cloud);
  fitting.setIndices(indices);
  NurbsSurface surface;
  ASSERT_TRUE(fitting.compute(surface));
  EXPECT_EQ(fitting.getUsedIndices().size(), half);
  EXPECT_LT(fitting.getReport().max, 1e-3);
}

} // namespace
