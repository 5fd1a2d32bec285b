// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graphs.h"
#include "test_data.h"

#include <pcl/mapping/pose_graph_certificate.h>
#include <pcl/mapping/pose_graph_io.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

PoseGraphOptions
optionsOf(PoseGraphMethod method, PoseGraphCost cost)
{
  PoseGraphOptions options;
  options.method = method;
  options.cost = cost;
  return options;
}

/** The bound holds at any estimate, and is tight at the best. */
TEST(PoseGraphCertificate, BoundsTheCost)
{
  for (const bool planar : {false, true}) {
    PoseGraph best = randomGraph(19, {60, 60, 0.1, planar, false});
    PoseGraph elsewhere = best;
    PoseGraphOptions options =
        optionsOf(PoseGraphMethod::Multifrontal, PoseGraphCost::SeSync);
    const GlobalSummary result = optimizeFromBestStart(best, options);
    EXPECT_TRUE(result.certificate.certifies());
    EXPECT_NEAR(result.certificate.cost,
                result.summary.final_cost,
                1e-9 * result.summary.final_cost);
    disturb(elsewhere, 20, 0.1, 0.1);
    const OptimalityCertificate bound = certify(elsewhere, PoseGraphCost::SeSync);
    EXPECT_TRUE(bound.available);
    EXPECT_FALSE(bound.certifies());
    EXPECT_LE(bound.lower_bound, result.summary.final_cost);
  }
}

/** A ring that is wound once too often is a minimum, but not the lowest. */
TEST(PoseGraphCertificate, RefusesALocalMinimum)
{
  constexpr int kNodes = 20;
  PoseGraph graph;
  BetweenFactor edge;
  edge.T_from_to.translation().x() = 1.0;
  for (int k = 0; k < kNodes; ++k) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(2.0 * M_PI * k / kNodes, Eigen::Vector3d::UnitZ()));
    graph.addNode(static_cast<NodeId>(k), pose, true);
  }
  for (int k = 0; k < kNodes; ++k)
    graph.addFactor(BetweenFactor{static_cast<NodeId>(k),
                                  static_cast<NodeId>((k + 1) % kNodes),
                                  Eigen::Isometry3d::Identity(),
                                  planarInformation(1.0, 1.0)});
  PoseGraph wound = graph;
  const PoseGraphSummary local =
      optimize(wound, optionsOf(PoseGraphMethod::Multifrontal, PoseGraphCost::SeSync));
  EXPECT_GT(local.final_cost, 1.0);
  EXPECT_FALSE(certify(wound, PoseGraphCost::SeSync).certifies());
  const GlobalSummary global = optimizeFromBestStart(
      graph, optionsOf(PoseGraphMethod::Multifrontal, PoseGraphCost::SeSync));
  EXPECT_LT(global.summary.final_cost, 1e-12);
  EXPECT_TRUE(global.certificate.certifies());
}

TEST(PoseGraphCertificate, SaysWhyThereIsNone)
{
  PoseGraph graph = randomGraph(21);
  EXPECT_EQ(certify(graph).reason, "the information is not isotropic");
  EXPECT_TRUE(certify(graph, PoseGraphCost::SeSync).available);
  graph.setFixed(1, true);
  EXPECT_TRUE(certify(graph, PoseGraphCost::SeSync).available);
  graph.setFixed(2, true);
  EXPECT_EQ(certify(graph, PoseGraphCost::SeSync).reason, "nodes are fixed");
  graph.addFactor(PriorFactor{0, kStill, TangentMatrix::Identity()});
  EXPECT_FALSE(certify(graph, PoseGraphCost::SeSync).available);
}

struct KnownOptimum {
  const char* name;
  double cost; // SE-Sync's
};

class PublicGraph : public testing::TestWithParam<KnownOptimum> {};

/** From the file's start, from none and from a random one. */
TEST_P(PublicGraph, ReachesTheKnownOptimum)
{
  PCL_NURBS_DATA_OR_SKIP(path, std::filesystem::path("g2o") / GetParam().name);
  const PoseGraph file = readG2o(path.string()).graph;
  PoseGraph none = file;
  for (const auto& [id, node] : file.nodes())
    none.clearPose(id);
  PoseGraph random = file;
  initializeRandomly(random, 22);
  PoseGraph given = file;
  for (PoseGraph* graph : {&given, &random, &none}) {
    const GlobalSummary result = optimizeFromBestStart(
        *graph, optionsOf(PoseGraphMethod::Multifrontal, PoseGraphCost::SeSync));
    EXPECT_NEAR(result.summary.final_cost, GetParam().cost, 1e-6 * GetParam().cost);
    EXPECT_TRUE(result.certificate.certifies(2e-5));
  }
}

INSTANTIATE_TEST_SUITE_P(Optima,
                         PublicGraph,
                         testing::Values(KnownOptimum{"tinyGrid3D.g2o", 18.519366},
                                         KnownOptimum{"smallGrid3D.g2o", 1025.39806},
                                         KnownOptimum{"sphere2500.g2o", 1687.0058},
                                         KnownOptimum{"torus3D.g2o", 24227.046},
                                         KnownOptimum{"parking-garage.g2o", 1.2625244},
                                         KnownOptimum{"intel.g2o", 52.348227},
                                         KnownOptimum{"kitti_00.g2o", 125.69352},
                                         KnownOptimum{"kitti_07.g2o", 23.933845}));

} // namespace
