// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fitting_clouds.h"

#include <gtest/gtest.h>

namespace {

using pcl::nurbs::NurbsSurface;
using pcl::nurbs::Parameterization;
using namespace pcl::nurbs::test;

TEST(NurbsFittingFailures, HostileCloudsNeverThrow)
{
  const auto tryOut = [](const Cloud::Ptr& cloud, bool expected) {
    for (Parameterization parameterization : {Parameterization::Auto,
                                              Parameterization::Grid,
                                              Parameterization::Plane,
                                              Parameterization::Cylinder,
                                              Parameterization::Perspective,
                                              Parameterization::Given}) {
      Fitting fitting;
      fitting.setInputCloud(cloud);
      fitting.setParameterization(parameterization);
      NurbsSurface surface;
      bool done = true;
      EXPECT_NO_THROW(done = fitting.compute(surface));
      EXPECT_EQ(done, fitting.getReport().fitted_points > 0);
      EXPECT_TRUE(done || !fitting.getReport().message.empty());
      EXPECT_TRUE(done == expected || parameterization != Parameterization::Plane);
    }
  };
  tryOut(nullptr, false);
  tryOut(Cloud::Ptr(new Cloud), false);
  tryOut(
      scatteredCloud([](double, double, double) { return Eigen::Vector3d(NAN, 0, 0); },
                     50,
                     0.0,
                     8),
      false);
  tryOut(scatteredCloud(hill, 1, 0.0, 9), true);
  tryOut(scatteredCloud([](double, double, double) { return Eigen::Vector3d(1, 2, 3); },
                        100,
                        0.0,
                        10),
         true);
  tryOut(scatteredCloud(
             [](double u, double, double) { return Eigen::Vector3d(u, 2 * u, 0); },
             100,
             0.0,
             11),
         true);
  for (double scale : {1e-6, 1e6})
    tryOut(scatteredCloud(
               [&](double u, double v, double n) {
                 return Eigen::Vector3d(scale * hill(u, v, n));
               },
               500,
               0.0,
               12),
           true);
}

TEST(NurbsFittingFailures, BadOptionsAreReported)
{
  Fitting fitting;
  fitting.setInputCloud(scatteredCloud(hill, 500, 0.0, 13));
  NurbsSurface surface;
  fitting.setNoise(-1.0);
  EXPECT_FALSE(fitting.compute(surface));
  fitting.setNoise(0.0);
  fitting.setNumberOfThreads(0);
  EXPECT_FALSE(fitting.compute(surface));
  fitting.setNumberOfThreads(1);
  EXPECT_TRUE(fitting.compute(surface));
  EXPECT_TRUE(fitting.getReport().message.empty());
}

} // namespace
