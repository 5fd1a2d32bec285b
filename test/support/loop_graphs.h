// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace pcl_nurbs_test {

using namespace pcl::nurbs;

/** A drive of several rounds on a circle with noisy odometry and noisy true loops
 * between the rounds; false loops are added on demand. */
class LoopGraph {
public:
  PoseGraph graph;
  std::vector<Eigen::Isometry3d> truth;
  std::set<FactorId> true_loops;
  std::set<FactorId> false_loops;

  LoopGraph(bool planar, unsigned seed, bool with_loops = true)
      : planar_(planar), random_(seed)
  {
    constexpr int kRound = 40;
    constexpr int kNodes = 3 * kRound;
    for (int k = 0; k < kNodes; ++k) {
      truth.push_back(poseAt(k, kRound));
      graph.addNode(static_cast<NodeId>(k), planar);
    }
    for (int k = 1; k < kNodes; ++k)
      graph.addFactor(measured(k - 1, k));
    for (int k = kRound; with_loops && k < kNodes; k += 2)
      true_loops.insert(graph.addFactor(measured(k - kRound, k)));
  }

  /** The truth with noise, as a factor. */
  BetweenFactor
  measured(int from, int to)
  {
    return noisy(from, to, truth[index(from)].inverse() * truth[index(to)]);
  }

  /** Claims that two places are the same that are not: the lead from one is what it is
   * a quarter of a round on. */
  void
  addFalse(int from, int to)
  {
    const Eigen::Isometry3d wrong =
        truth[index(from)].inverse() * truth[index((to + 10) % 120)];
    false_loops.insert(graph.addFactor(noisy(from, to, wrong)));
  }

  /** Root mean square distance of the estimates from the truth, both from the first. */
  double
  error(const PoseGraph& estimate) const
  {
    const Eigen::Isometry3d start =
        truth.front() * estimate.node(0).T_world_node.inverse();
    double sum = 0.0;
    for (const auto& [id, node] : estimate.nodes())
      sum += (start * node.T_world_node.translation() - truth[id].translation())
                 .squaredNorm();
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }

private:
  static std::size_t
  index(int k)
  {
    return static_cast<std::size_t>(k);
  }

  Eigen::Isometry3d
  poseAt(int k, int round) const
  {
    const double angle = 2.0 * M_PI * k / round;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 10.0 * std::cos(angle), 10.0 * std::sin(angle),
        planar_ ? 0.0 : 0.02 * k;
    pose.linear() =
        Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (!planar_)
      pose.rotate(
          Eigen::AngleAxisd(0.3 * std::sin(3.0 * angle), Eigen::Vector3d::UnitX()));
    return pose;
  }

  BetweenFactor
  noisy(int from, int to, const Eigen::Isometry3d& motion)
  {
    constexpr double kPosition = 0.02;
    constexpr double kAngle = 0.005;
    std::normal_distribution<double> normal;
    Tangent error;
    for (Eigen::Index k = 0; k < 6; ++k)
      error(k) = (k < 3 ? kPosition : kAngle) * normal(random_);
    if (planar_)
      error(2) = error(3) = error(4) = 0.0;
    Tangent weights;
    weights << Eigen::Vector3d::Constant(1.0 / (kPosition * kPosition)),
        Eigen::Vector3d::Constant(1.0 / (kAngle * kAngle));
    return {static_cast<NodeId>(from),
            static_cast<NodeId>(to),
            motion * exponential(error),
            TangentMatrix(weights.asDiagonal())};
  }

  bool planar_;
  std::mt19937 random_;
};

} // namespace pcl_nurbs_test
