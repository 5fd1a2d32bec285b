// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "../support/loop_graphs.h"

#include <pcl/mapping/pose_graph_robust.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace pcl::nurbs;
using pcl_nurbs_test::LoopGraph;

namespace {

constexpr RobustMethod kMethods[] = {RobustMethod::Consensus,
                                     RobustMethod::GraduatedNonConvexity,
                                     RobustMethod::Switchable,
                                     RobustMethod::PairwiseConsistency};

RobustOptions
optionsOf(RobustMethod method)
{
  RobustOptions options;
  options.method = method;
  return options;
}

std::set<FactorId>
setOf(const std::vector<FactorId>& names)
{
  return {names.begin(), names.end()};
}

/** True loops that were rejected; 1 % of true ones may be at each of the checks. */
std::size_t
lost(const LoopGraph& made, const RobustSummary& summary)
{
  const std::vector<FactorId> rejected = summary.rejected();
  return static_cast<std::size_t>(
      std::count_if(rejected.begin(), rejected.end(), [&](FactorId id) {
        return made.true_loops.count(id) > 0;
      }));
}

void
expectFalseRejected(const LoopGraph& made, const RobustSummary& summary)
{
  for (const FactorId id : summary.accepted())
    EXPECT_EQ(made.false_loops.count(id), 0U) << "loop " << id;
}

} // namespace

class EachMethod : public testing::TestWithParam<std::tuple<RobustMethod, bool>> {
protected:
  RobustOptions options = optionsOf(std::get<0>(GetParam()));
  bool planar = std::get<1>(GetParam());

  /** As if the false loops were not there. */
  double
  errorWithTrueOnly(const LoopGraph& made) const
  {
    PoseGraph graph = made.graph;
    for (const FactorId id : made.false_loops)
      graph.removeFactor(id);
    optimize(graph);
    return made.error(graph);
  }

  void
  expectSolved(LoopGraph& made)
  {
    const double best = errorWithTrueOnly(made);
    const RobustSummary summary = optimizeRobustly(made.graph, options);
    expectFalseRejected(made, summary);
    EXPECT_LE(lost(made, summary), 3U);
    EXPECT_LE(made.error(made.graph), 1.05 * best + 0.02);
  }
};

TEST_P(EachMethod, scatteredFalseLoops)
{
  for (unsigned seed = 1; seed <= 3; ++seed) {
    LoopGraph made(planar, seed);
    std::mt19937 generator(seed);
    std::uniform_int_distribution<int> any(0, 119);
    while (made.false_loops.size() < 40) {
      const int from = any(generator);
      const int to = any(generator);
      if (std::abs(from - to) > 3)
        made.addFalse(from, to);
    }
    expectSolved(made);
  }
}

TEST_P(EachMethod, falseLoopsThatAgreeWithEachOther)
{
  LoopGraph made(planar, 4);
  for (int k = 0; k < 12; ++k)
    made.addFalse(5 + k, 70 + k);
  expectSolved(made);
}

TEST_P(EachMethod, loopsThatContradictEachOtherAndDuplicates)
{
  LoopGraph made(planar, 5);
  for (int k = 40; k < 120; k += 8)
    made.addFalse(k - 40, k); // beside a true one between the same nodes
  for (int k = 0; k < 5; ++k)
    made.true_loops.insert(made.graph.addFactor(made.measured(0, 40)));
  expectSolved(made);
}

TEST_P(EachMethod, allLoopsFalse)
{
  LoopGraph made(planar, 6, false);
  for (int k = 0; k < 20; ++k)
    made.addFalse(k, 119 - 2 * k);
  PoseGraph odometry = made.graph;
  initializeFromOdometry(odometry);
  const RobustSummary summary = optimizeRobustly(made.graph, options);
  EXPECT_TRUE(summary.accepted().empty());
  EXPECT_NEAR(made.error(made.graph), made.error(odometry), 1e-6);
}

TEST_P(EachMethod, noLoops)
{
  LoopGraph made(planar, 7, false);
  const RobustSummary summary = optimizeRobustly(made.graph, options);
  EXPECT_TRUE(summary.loops.empty());
  EXPECT_TRUE(summary.solution.converged);
}

TEST_P(EachMethod, isTheSameEachTime)
{
  const auto run = [&] {
    LoopGraph made(planar, 8);
    for (int k = 0; k < 15; ++k)
      made.addFalse(2 * k, 110 - k);
    const RobustSummary summary = optimizeRobustly(made.graph, options);
    return std::make_pair(summary.rejected(),
                          made.graph.node(60).T_world_node.matrix());
  };
  EXPECT_EQ(run(), run());
}

INSTANTIATE_TEST_SUITE_P(PoseGraphRobust,
                         EachMethod,
                         testing::Combine(testing::ValuesIn(kMethods),
                                          testing::Bool()));

TEST(PoseGraphRobust, GemanMcClureToo)
{
  LoopGraph made(false, 9);
  for (int k = 0; k < 20; ++k)
    made.addFalse(k, 119 - 2 * k);
  RobustOptions options = optionsOf(RobustMethod::GraduatedNonConvexity);
  options.loss = RobustLoss::GemanMcClure;
  expectFalseRejected(made, optimizeRobustly(made.graph, options));
}

TEST(PoseGraphRobust, methodsAloneFindFalseLoops)
{
  for (const RobustMethod method : kMethods) {
    LoopGraph made(true, 10);
    for (int k = 0; k < 10; ++k)
      made.addFalse(3 * k, 119 - 2 * k);
    RobustOptions options = optionsOf(method);
    options.check_cycles = false;
    options.check_jointly = false;
    options.estimate_noise = false;
    const RobustSummary summary = optimizeRobustly(made.graph, options);
    expectFalseRejected(made, summary);
    EXPECT_LE(lost(made, summary), 8U);
  }
}

TEST(PoseGraphRobust, weightsFollowVerdicts)
{
  LoopGraph made(true, 11);
  made.addFalse(0, 60);
  const RobustSummary summary = optimizeRobustly(made.graph);
  EXPECT_EQ(summary.loops.size(), made.true_loops.size() + 1);
  for (const LoopVerdict& loop : summary.loops) {
    EXPECT_EQ(made.graph.factor(loop.factor).weight, loop.accepted ? 1.0 : 0.0);
    EXPECT_EQ(loop.distance <= loop.limit, loop.accepted);
  }
  EXPECT_EQ(setOf(summary.rejected()).count(*made.false_loops.begin()), 1U);
}

/** Information that claims ten times too little hides false loops that are small. */
TEST(PoseGraphRobust, noiseIsSmallerThanInformationSays)
{
  LoopGraph honest(true, 12);
  LoopGraph modest(true, 12);
  PoseGraph graph = modest.graph;
  for (const auto& [id, factor] : modest.graph.factors()) {
    BetweenFactor between = std::get<BetweenFactor>(factor.measurement);
    between.information *= 0.01;
    graph.removeFactor(id);
    graph.addFactor(between);
  }
  BetweenFactor wrong = modest.measured(0, 80);
  wrong.T_from_to.translation().x() += 1.0;
  wrong.information *= 0.01;
  const FactorId name = graph.addFactor(wrong);
  const RobustSummary summary = optimizeRobustly(graph);
  EXPECT_LT(summary.translation_scale, 0.5);
  EXPECT_EQ(setOf(summary.rejected()).count(name), 1U);
  EXPECT_EQ(optimizeRobustly(honest.graph).translation_scale, 1.0);
}

TEST(PoseGraphRobust, badInputIsRefused)
{
  LoopGraph made(true, 13);
  const auto refused = [&](auto change) {
    RobustOptions options;
    change(options);
    EXPECT_THROW(optimizeRobustly(made.graph, options), std::invalid_argument);
  };
  refused([](RobustOptions& o) { o.probability = 1.0; });
  refused([](RobustOptions& o) { o.probability = 0.0; });
  refused([](RobustOptions& o) { o.max_reweightings = 0; });
  refused([](RobustOptions& o) { o.max_joint_rounds = 0; });
  refused([](RobustOptions& o) { o.max_clique_steps = 0; });
  refused([](RobustOptions& o) { o.solver.threads = 0; });
  EXPECT_THROW(optimizeRobustly(made.graph, {99999}), std::out_of_range);
  const FactorId prior = made.graph.addFactor(PriorFactor{});
  EXPECT_THROW(optimizeRobustly(made.graph, {prior}), std::invalid_argument);
}
