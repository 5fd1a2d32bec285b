// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The laws of a Ceres manifold, and its derivatives against numeric ones.

#include "ceres_poses.h"
#include "pose_graphs.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

class Manifold : public testing::TestWithParam<bool> {
protected:
  bool planar = GetParam();
  PoseManifold manifold{planar};
  Eigen::Index size = manifold.TangentSize();
  std::mt19937 generator{1};

  Eigen::VectorXd
  anyPose()
  {
    return asVector(toBlock(toSolverPose(randomMotion(generator, 5.0, 3.0, planar))));
  }

  Eigen::VectorXd
  anyTangent(double length)
  {
    std::uniform_real_distribution<double> entry(-length, length);
    return Eigen::VectorXd::NullaryExpr(size,
                                        [&](Eigen::Index) { return entry(generator); });
  }

  static Eigen::VectorXd
  asVector(const PoseBlock& block)
  {
    return Eigen::Map<const Eigen::VectorXd>(block.data(), kBlockSize);
  }

  Eigen::VectorXd
  plus(const Eigen::VectorXd& x, const Eigen::VectorXd& delta) const
  {
    Eigen::VectorXd result(kBlockSize);
    EXPECT_TRUE(manifold.Plus(x.data(), delta.data(), result.data()));
    return result;
  }

  Eigen::VectorXd
  minus(const Eigen::VectorXd& y, const Eigen::VectorXd& x) const
  {
    Eigen::VectorXd result(size);
    EXPECT_TRUE(manifold.Minus(y.data(), x.data(), result.data()));
    return result;
  }

  using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  RowMajor
  plusJacobian(const Eigen::VectorXd& x) const
  {
    RowMajor result(kBlockSize, size);
    EXPECT_TRUE(manifold.PlusJacobian(x.data(), result.data()));
    return result;
  }

  RowMajor
  minusJacobian(const Eigen::VectorXd& x) const
  {
    RowMajor result(size, kBlockSize);
    EXPECT_TRUE(manifold.MinusJacobian(x.data(), result.data()));
    return result;
  }
};

TEST_P(Manifold, PlusAndMinusUndoEachOther)
{
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd x = anyPose();
    const Eigen::VectorXd delta = anyTangent(0.5);
    EXPECT_LT((plus(x, Eigen::VectorXd::Zero(size)) - x).norm(), 1e-14);
    EXPECT_LT(minus(x, x).norm(), 1e-14);
    EXPECT_LT((minus(plus(x, delta), x) - delta).norm(), 1e-12);
    const Eigen::VectorXd y = anyPose();
    const Eigen::Matrix4d reached =
        toIsometry(toPose(plus(x, minus(y, x)).data())).matrix();
    EXPECT_LT((reached - toIsometry(toPose(y.data())).matrix()).norm(), 1e-12);
    EXPECT_NEAR(plus(x, delta).tail<4>().norm(), 1.0, 1e-14);
  }
}

TEST_P(Manifold, PlusMovesOnTheRight)
{
  constexpr double kSmall = 1e-5;
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd x = anyPose();
    const Eigen::VectorXd delta = anyTangent(kSmall);
    Tangent tangent = Tangent::Zero();
    for (Eigen::Index r = 0; r < size; ++r)
      tangent(planar ? kPlanarRows[static_cast<std::size_t>(r)] : r) = delta(r);
    const Eigen::Matrix4d expected =
        (toIsometry(toPose(x.data())) * exponential(tangent)).matrix();
    const Eigen::Matrix4d moved = toIsometry(toPose(plus(x, delta).data())).matrix();
    EXPECT_LT((moved - expected).norm(), 20.0 * kSmall * kSmall);
  }
}

TEST_P(Manifold, DerivativesAreTheNumericOnes)
{
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd x = anyPose();
    Eigen::MatrixXd numeric(kBlockSize, size);
    for (Eigen::Index c = 0; c < size; ++c) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(size, c);
      numeric.col(c) = (plus(x, step) - plus(x, -step)) / (2.0 * kStep);
    }
    EXPECT_LT((plusJacobian(x) - numeric).norm(), 1e-8);
    // Off the unit sphere Minus means nothing: along it, it undoes Plus.
    EXPECT_LT(
        (minusJacobian(x) * numeric - Eigen::MatrixXd::Identity(size, size)).norm(),
        1e-8);
    const Eigen::VectorXd y = plus(x, anyTangent(1e-6));
    EXPECT_LT((minusJacobian(x) * (y - x) - minus(y, x)).norm(), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(PoseManifold, Manifold, testing::Bool());

} // namespace
