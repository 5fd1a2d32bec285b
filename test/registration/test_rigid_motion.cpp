// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Laws of the exponential map.

#include <pcl/registration/rigid_motion.h>

#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include <random>

namespace {

using namespace pcl::nurbs;

Tangent
randomTangent(double size, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Tangent tangent;
  for (int i = 0; i < 6; ++i)
    tangent[i] = size * normal(random);
  return tangent;
}

TEST(RigidMotion, ExponentialIsThatOfMatrices)
{
  std::mt19937 random(1);
  for (const double size : {0.0, 1e-9, 1e-5, 1e-4, 1e-2, 0.5}) {
    const Tangent t = randomTangent(size, random);
    Eigen::Matrix4d generator;
    generator << 0, -t[5], t[4], t[0], t[5], 0, -t[3], t[1], -t[4], t[3], 0, t[2], 0, 0,
        0, 0;
    const Eigen::Matrix4d expected = generator.exp();
    EXPECT_LT((exponential(t).matrix() - expected).norm(), 1e-12) << size;
  }
}

TEST(RigidMotion, LogarithmIsItsInverse)
{
  std::mt19937 random(2);
  for (const double size : {0.0, 1e-9, 1e-4, 0.1, 0.4})
    for (int i = 0; i < 20; ++i) {
      const Tangent tangent = randomTangent(size, random);
      EXPECT_LT((logarithm(exponential(tangent)) - tangent).norm(), 1e-9) << size;
    }
}

TEST(RigidMotion, AdjointTakesPerturbationsToTheOtherSide)
{
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d motion = exponential(randomTangent(0.7, random));
    const Tangent tangent = randomTangent(0.3, random);
    const Eigen::Isometry3d right = motion * exponential(tangent);
    const Eigen::Isometry3d left = exponential(adjoint(motion) * tangent) * motion;
    EXPECT_LT((right.matrix() - left.matrix()).norm(), 1e-12);
  }
}

TEST(RigidMotion, OrthonormalAgain)
{
  std::mt19937 random(3);
  Eigen::Isometry3d motion = exponential(randomTangent(0.5, random));
  motion.linear() *= 1.001;
  const Eigen::Matrix3d rotation = orthonormal(motion).linear();
  EXPECT_LT((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
}

} // namespace
