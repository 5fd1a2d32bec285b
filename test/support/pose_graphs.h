// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

#include <Eigen/Cholesky>

#include <random>

namespace pcl {
namespace nurbs {
namespace test {

const Eigen::Isometry3d kStill = Eigen::Isometry3d::Identity();
const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();

/** A random motion: rotations up to an angle, translations up to a length. */
inline Eigen::Isometry3d
randomMotion(std::mt19937& generator, double length, double angle, bool planar = false)
{
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  Tangent tangent;
  for (Eigen::Index k = 0; k < 6; ++k)
    tangent(k) = share(generator) * (k < 3 ? length : angle / std::sqrt(3.0));
  if (planar)
    tangent(2) = tangent(3) = tangent(4) = 0.0;
  return exponential(tangent);
}

/** A random symmetric positive definite matrix with eigenvalues from 1 to 100. */
template <int Size>
Eigen::Matrix<double, Size, Size>
randomInformation(std::mt19937& generator)
{
  using Matrix = Eigen::Matrix<double, Size, Size>;
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  const Matrix any = Matrix::NullaryExpr([&] { return entry(generator); });
  return 30.0 * any * any.transpose() / Size + Matrix::Identity();
}

/** Information about x, y and the angle of a planar pose, the rest unknown. */
inline TangentMatrix
planarInformation(double translation, double rotation)
{
  TangentMatrix result = TangentMatrix::Zero();
  result(0, 0) = result(1, 1) = translation;
  result(5, 5) = rotation;
  return result;
}

/** How randomGraph() is made. */
struct RandomGraphOptions {
  std::size_t nodes = 40;
  std::size_t loops = 30;
  double noise = 0.0; /**< of translation; that of rotation is a third of it */
  bool planar = false;
  bool isotropic = false; /**< information, else full */
};

/** A walk with loops: truth in the nodes, measurements with noise of the right
 * information. */
inline PoseGraph
randomGraph(unsigned seed, const RandomGraphOptions& options = {})
{
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  PoseGraph graph;
  std::vector<Eigen::Isometry3d> truth;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (NodeId id = 0; id < options.nodes; ++id) {
    truth.push_back(pose);
    graph.addNode(id, pose, options.planar);
    Eigen::Isometry3d step = randomMotion(generator, 0.3, 0.8, options.planar);
    step.translation().x() += 1.0;
    pose = orthonormal(pose * step);
  }
  const auto measure = [&](NodeId from, NodeId to) {
    BetweenFactor factor;
    factor.from = from;
    factor.to = to;
    factor.T_from_to = truth[from].inverse() * truth[to];
    const double sigma = options.noise > 0.0 ? options.noise : 0.01;
    if (options.planar)
      factor.information = planarInformation(1.0 / sigma / sigma, 9.0 / sigma / sigma);
    else {
      factor.information = options.isotropic ? TangentMatrix(TangentMatrix::Identity())
                                             : randomInformation<6>(generator);
      factor.information.bottomRightCorner<3, 3>() *= 9.0;
      factor.information.topRightCorner<3, 3>() *= 3.0;
      factor.information.bottomLeftCorner<3, 3>() *= 3.0;
      factor.information /= 2.0 * sigma * sigma;
      factor.information += factor.information.transpose().eval();
    }
    Tangent error =
        Tangent::NullaryExpr([&] { return options.noise * normal(generator); });
    error.tail<3>() /= 3.0;
    if (options.planar)
      error(2) = error(3) = error(4) = 0.0;
    factor.T_from_to = orthonormal(factor.T_from_to * exponential(error));
    graph.addFactor(factor);
  };
  for (NodeId id = 1; id < options.nodes; ++id)
    measure(id - 1, id);
  std::uniform_int_distribution<NodeId> any(0, options.nodes - 1);
  for (std::size_t k = 0; k < options.loops; ++k) {
    const NodeId from = any(generator);
    const NodeId to = any(generator);
    if (from != to)
      measure(from, to);
  }
  return graph;
}

/** Move all nodes but the first one at random. */
inline void
disturb(PoseGraph& graph, unsigned seed, double length, double angle)
{
  std::mt19937 generator(seed);
  const PoseGraph::Nodes nodes = graph.nodes();
  for (const auto& [id, node] : nodes)
    if (id != nodes.begin()->first)
      graph.setPose(
          id, node.T_world_node * randomMotion(generator, length, angle, node.planar));
}

/** Largest difference of two graphs' poses, entry by entry. */
inline double
poseDifference(const PoseGraph& a, const PoseGraph& b)
{
  double largest = 0.0;
  for (const auto& [id, node] : a.nodes())
    largest = std::max(largest,
                       (node.T_world_node.matrix() - b.node(id).T_world_node.matrix())
                           .cwiseAbs()
                           .maxCoeff());
  return largest;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
