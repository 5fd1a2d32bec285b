// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// True and false loops offered to a graph that grows.

#include "loop_graphs.h"

#include <pcl/mapping/loop_gate.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl_nurbs_test;

/** A drive without loops, as it grew. */
struct Drive {
  explicit Drive(unsigned seed) : made(false, seed, false)
  {
    for (const auto& [id, node] : made.graph.nodes())
      slam.addNode(id);
    for (const auto& [id, factor] : made.graph.factors())
      slam.addFactor(factor.measurement);
    slam.update();
  }

  bool
  offerTrue(int from, int to)
  {
    return gate.offer(slam, made.measured(from, to));
  }

  /** Claims what is true of the pair, but for an error at its end. */
  bool
  offerWrong(int from, int to, double metres)
  {
    BetweenFactor loop = made.measured(from, to);
    loop.T_from_to = loop.T_from_to * Eigen::Translation3d(0.0, metres, 0.0);
    return gate.offer(slam, loop);
  }

  /** How far a loop is from the truth, metres. */
  double
  errorOf(const BetweenFactor& loop) const
  {
    const Eigen::Isometry3d error = loop.T_from_to.inverse() *
                                    made.truth[loop.from].inverse() *
                                    made.truth[loop.to];
    return error.translation().norm();
  }

  LoopGraph made;
  IncrementalPoseGraph slam;
  LoopGate gate;
};

TEST(LoopGate, trueLoopsComeIn)
{
  int held = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Drive drive(seed);
    const double before = drive.made.error(drive.slam.graph());
    for (int k = 40; k < 120; k += 2)
      held += drive.offerTrue(k - 40, k) ? 0 : 1;
    EXPECT_LT(drive.made.error(drive.slam.graph()), before);
    EXPECT_EQ(drive.gate.accepted().size() + drive.gate.held().size(), 40U);
  }
  EXPECT_LE(held, 4); // of 200; one in a hundred may be
}

TEST(LoopGate, falseLoopsDoNotBendTheGraph)
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Drive with(seed);
    Drive without(seed);
    for (int k = 40; k < 120; k += 4) {
      with.offerTrue(k - 40, k);
      without.offerTrue(k - 40, k);
    }
    const std::size_t held = with.gate.held().size();
    for (const int k : {3, 17, 29})
      EXPECT_FALSE(with.offerWrong(k, k + 60, 0.2 * k + 4.0));
    EXPECT_EQ(with.gate.held().size(), held + 3);
    EXPECT_GT(with.gate.held().back().distance, with.gate.held().back().limit);
    EXPECT_NEAR(with.made.error(with.slam.graph()),
                without.made.error(without.slam.graph()),
                1e-3);
  }
}

/** Ten that agree with each other, against twenty true ones. */
TEST(LoopGate, falseLoopsThatConfirmEachOtherLoseAgainstMore)
{
  Drive drive(6);
  for (int k = 40; k < 120; k += 4)
    drive.offerTrue(k - 40, k);
  const double before = drive.made.error(drive.slam.graph());
  const std::size_t accepted = drive.gate.accepted().size();
  for (int k = 0; k < 10; ++k)
    EXPECT_FALSE(drive.offerWrong(5 + k, 65 + k, 4.0));
  EXPECT_EQ(drive.gate.accepted().size(), accepted);
  EXPECT_NEAR(drive.made.error(drive.slam.graph()), before, 1e-3);
}

TEST(LoopGate, aFalseLoopThatCameFirstIsTakenOut)
{
  Drive drive(7);
  // So little wrong that the odometry alone cannot tell.
  ASSERT_TRUE(drive.offerWrong(10, 90, 1.0));
  bool is_in = false;
  for (int k = 0; k < 8; ++k)
    is_in = drive.offerTrue(2 * k, 80 + 2 * k);
  EXPECT_TRUE(is_in);
  EXPECT_GE(drive.gate.accepted().size(), 7U);
  for (const FactorId id : drive.gate.accepted())
    EXPECT_LT(drive.errorOf(
                  std::get<BetweenFactor>(drive.slam.graph().factor(id).measurement)),
              0.5);
  ASSERT_GE(drive.gate.held().size(), 1U);
  EXPECT_GT(drive.errorOf(drive.gate.held().back().loop), 0.5);
}

/** A straight drive one of whose steps is wrong: a short loop over it is too good for
 * the odometry, until a longer one has told most of the error. */
TEST(LoopGate, whatWasHeldComesInWhenAnotherAgrees)
{
  constexpr double kSigma = 0.01;
  IncrementalPoseGraph slam;
  LoopGate gate;
  const TangentMatrix information = TangentMatrix::Identity() / (kSigma * kSigma);
  const auto measured = [&](NodeId from, NodeId to, double error) {
    BetweenFactor factor{from, to, Eigen::Isometry3d::Identity(), information};
    factor.T_from_to.translation().x() = static_cast<double>(to - from) + error;
    return factor;
  };
  slam.addNode(0, Eigen::Isometry3d::Identity());
  for (NodeId k = 1; k <= 30; ++k) {
    slam.addNode(k);
    slam.addFactor(measured(k - 1, k, k == 15 ? 45.0 * kSigma : 0.0));
  }
  EXPECT_FALSE(gate.offer(slam, measured(10, 20, 0.0)));
  EXPECT_EQ(gate.held().size(), 1U);
  EXPECT_TRUE(gate.offer(slam, measured(0, 30, 0.0)));
  EXPECT_TRUE(gate.held().empty());
  EXPECT_EQ(gate.accepted().size(), 2U);
}

TEST(LoopGate, oddLoops)
{
  Drive drive(8);
  EXPECT_THROW(drive.gate.offer(drive.slam, {0, 500}), std::out_of_range);
  EXPECT_TRUE(drive.gate.accepted().empty());
  EXPECT_THROW(LoopGate(0.0), std::invalid_argument);
  EXPECT_THROW(LoopGate(1.0), std::invalid_argument);
  ASSERT_TRUE(drive.offerTrue(0, 40));
  EXPECT_TRUE(drive.offerTrue(0, 40)); // once more is no contradiction
}

} // namespace
