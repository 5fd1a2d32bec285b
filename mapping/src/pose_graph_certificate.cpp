// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_certificate.h>

#include "clique_tree.h"
#include "elimination_order.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/stop_watch.h>

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** A between factor in SE-Sync's cost, about nodes of one part by their places in it.
 */
struct CertificateEdge {
  int first;
  int second;
  SeSyncWeights weights;
  Eigen::MatrixXd rotation; // d x d
  Eigen::VectorXd translation;
};

/** The quadratic form of SE-Sync's cost over (R_1 t_1 R_2 t_2 ...), one row of it, for
 * one part of a graph with n poses. */
class CostForm {
public:
  CostForm(int dimension,
           std::vector<SolverPose> poses,
           std::vector<CertificateEdge> edges)
      : dimension_(dimension),
        poses_(std::move(poses)),
        edges_(std::move(edges)),
        tree_(0, false)
  {
    VariablePairs pairs;
    for (std::size_t k = 0; k < poses_.size(); ++k) // the first one's place is free
      tree_.addVariable(k == 0 ? dimension : dimension + 1);
    for (const CertificateEdge& edge : edges_) {
      tree_.addTerm(edge.first, edge.second);
      pairs.emplace_back(edge.first, edge.second);
    }
    for (std::size_t k = 0; k < poses_.size(); ++k)
      tree_.addTerm(static_cast<int>(k), -1);
    tree_.build(eliminationOrder(static_cast<int>(poses_.size()), pairs));
    findMultipliers();
  }

  double
  cost() const
  {
    return cost_;
  }

  /** Sum of the traces of Lambda. */
  double
  trace() const
  {
    double sum = 0.0;
    for (const Eigen::MatrixXd& multiplier : multipliers_)
      sum += multiplier.trace();
    return sum;
  }

  double
  largestEntry() const
  {
    return largest_;
  }

  double
  rotationRows() const
  {
    return static_cast<double>(poses_.size()) * dimension_;
  }

  /** Whether the form minus Lambda plus a share of the identity on the rotations is
   * positive definite. */
  bool
  isPositive(double shift)
  {
    return tree_.factor(
        [&](int term, FrontView& front) {
          const auto count = static_cast<int>(edges_.size());
          if (term < count)
            addEdge(edges_[static_cast<std::size_t>(term)], front);
          else
            addMultiplier(term - count, shift, front);
        },
        0.0);
  }

private:
  Eigen::MatrixXd
  rotationOf(int pose) const
  {
    return poses_[static_cast<std::size_t>(pose)]
        .rotation.toRotationMatrix()
        .topLeftCorner(dimension_, dimension_);
  }

  Eigen::VectorXd
  translationOf(int pose) const
  {
    return poses_[static_cast<std::size_t>(pose)].translation.head(dimension_);
  }

  void
  findMultipliers()
  {
    multipliers_.assign(poses_.size(), Eigen::MatrixXd::Zero(dimension_, dimension_));
    for (const CertificateEdge& edge : edges_) {
      const Eigen::MatrixXd first = rotationOf(edge.first);
      const Eigen::MatrixXd second = rotationOf(edge.second);
      const Eigen::MatrixXd turn = second - first * edge.rotation;
      const Eigen::VectorXd step = translationOf(edge.second) -
                                   translationOf(edge.first) - first * edge.translation;
      const double kappa = edge.weights.kappa;
      const double tau = edge.weights.tau;
      cost_ += kappa * turn.squaredNorm() + tau * step.squaredNorm();
      multipliers_[static_cast<std::size_t>(edge.first)] -=
          first.transpose() * (kappa * turn * edge.rotation.transpose() +
                               tau * step * edge.translation.transpose());
      multipliers_[static_cast<std::size_t>(edge.second)] +=
          kappa * second.transpose() * turn;
      largest_ =
          std::max({largest_, kappa + tau * edge.translation.squaredNorm(), tau});
    }
    for (Eigen::MatrixXd& multiplier : multipliers_)
      multiplier = (0.5 * (multiplier + multiplier.transpose())).eval();
  }

  void
  addEdge(const CertificateEdge& edge, FrontView& front) const
  {
    const int d = dimension_;
    const double tau = edge.weights.tau;
    Eigen::MatrixXd first = Eigen::MatrixXd::Zero(d + 1, d + 1);
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(d + 1, d + 1);
    Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(d + 1, d + 1); // first's rows
    second.topLeftCorner(d, d).diagonal().setConstant(edge.weights.kappa);
    second(d, d) = tau;
    first = second;
    first.topLeftCorner(d, d) += tau * edge.translation * edge.translation.transpose();
    first.topRightCorner(d, 1) = tau * edge.translation;
    first.bottomLeftCorner(1, d) = tau * edge.translation.transpose();
    cross.topLeftCorner(d, d) = -edge.weights.kappa * edge.rotation;
    cross.topRightCorner(d, 1) = -tau * edge.translation;
    cross(d, d) = -tau;
    const int a = tree_.dimension(edge.first);
    const int b = tree_.dimension(edge.second);
    front.add(edge.first, edge.first, Eigen::MatrixXd(first.topLeftCorner(a, a)));
    front.add(edge.second, edge.second, Eigen::MatrixXd(second.topLeftCorner(b, b)));
    front.add(edge.first, edge.second, Eigen::MatrixXd(cross.topLeftCorner(a, b)));
  }

  void
  addMultiplier(int pose, double shift, FrontView& front) const
  {
    const int size = tree_.dimension(pose);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
    block.topLeftCorner(dimension_, dimension_) =
        shift * Eigen::MatrixXd::Identity(dimension_, dimension_) -
        multipliers_[static_cast<std::size_t>(pose)];
    front.add(pose, pose, block);
  }

  int dimension_;
  std::vector<SolverPose> poses_;
  std::vector<CertificateEdge> edges_;
  CliqueTree tree_;
  std::vector<Eigen::MatrixXd> multipliers_;
  double cost_ = 0.0;
  double largest_ = 0.0;
};

/** Weights of the cost as SE-Sync has it; false if they are not isotropic. */
bool
isotropicWeights(const BetweenFactor& factor,
                 bool planar,
                 PoseGraphCost form,
                 SeSyncWeights& weights)
{
  if (form == PoseGraphCost::SeSync) {
    weights = seSyncWeights(factor, planar);
    return true;
  }
  const double tau = factor.information(0, 0);
  const double lambda = factor.information(3, 3);
  Tangent diagonal;
  diagonal << Eigen::Vector3d::Constant(tau), Eigen::Vector3d::Constant(lambda);
  weights = {0.5 * lambda, tau};
  constexpr double kRounding = 1e-9;
  return !planar && (factor.information - TangentMatrix(diagonal.asDiagonal()))
                            .cwiseAbs()
                            .maxCoeff() <= kRounding * diagonal.maxCoeff();
}

/** The parts of a graph as cost forms. */
class CertificateMaker {
public:
  CertificateMaker(const PoseGraph& graph, PoseGraphCost form)
      : graph_(graph), form_(form)
  {
  }

  OptimalityCertificate
  make()
  {
    result_.reason = obstacle();
    if (!result_.reason.empty())
      return result_;
    result_.available = true;
    result_.cost = costOf(graph_, form_);
    boundParts();
    if (!result_.certifies()) {
      const OptimalityCertificate before = result_;
      refine();
      boundParts();
      if (result_.lower_bound < before.lower_bound)
        result_ = before;
    }
    return result_;
  }

private:
  void
  boundParts()
  {
    result_.lower_bound = result_.rounding = 0.0;
    for (const std::vector<NodeId>& part : graph_.components())
      if (part.size() > 1)
        bound(part);
  }

  /** The bound holds wherever Lambda is taken, and is better the nearer to a minimum.
   */
  void
  refine()
  {
    PoseGraphOptions options;
    options.cost = form_;
    options.method = PoseGraphMethod::Multifrontal;
    options.max_iterations = 2;
    options.function_tolerance = 1e-15;
    optimize(graph_, options);
  }

  std::string
  obstacle() const
  {
    for (const auto& [id, factor] : graph_.factors()) {
      if (factor.weight == 0.0)
        continue;
      const auto* between = std::get_if<BetweenFactor>(&factor.measurement);
      if (between == nullptr)
        return "there are factors other than between two nodes";
      const bool planar = graph_.node(between->from).planar;
      SeSyncWeights weights;
      if (planar != graph_.node(between->to).planar)
        return "planar and spatial nodes are joined";
      if (!isotropicWeights(*between, planar, form_, weights))
        return planar ? "the cost is of angles, not of chords"
                      : "the information is not isotropic";
    }
    for (const std::vector<NodeId>& part : graph_.components()) {
      const auto fixed = std::count_if(part.begin(), part.end(), [this](NodeId id) {
        return graph_.node(id).fixed;
      });
      if (fixed > 1)
        return "nodes are fixed";
    }
    return {};
  }

  CostForm
  formOf(const std::vector<NodeId>& part) const
  {
    std::vector<SolverPose> poses;
    std::vector<CertificateEdge> edges;
    const bool planar = graph_.node(part.front()).planar;
    const int d = planar ? 2 : 3;
    for (const NodeId id : part) {
      poses.push_back(toSolverPose(graph_.node(id).T_world_node));
      for (const FactorId factor : graph_.node(id).factors) {
        const auto& between =
            std::get<BetweenFactor>(graph_.factor(factor).measurement);
        const double weight = graph_.factor(factor).weight;
        if (between.from != id || weight == 0.0)
          continue;
        SeSyncWeights weights;
        isotropicWeights(between, planar, form_, weights);
        edges.push_back({static_cast<int>(indexOf(part, id)),
                         static_cast<int>(indexOf(part, between.to)),
                         {weight * weights.kappa, weight * weights.tau},
                         between.T_from_to.linear().topLeftCorner(d, d),
                         between.T_from_to.translation().head(d)});
      }
    }
    return CostForm(d, std::move(poses), std::move(edges));
  }

  /** The smallest shift that will do, as a share of the cost, gives the bound. */
  void
  bound(const std::vector<NodeId>& part)
  {
    constexpr double kRounding = 1e-13;
    CostForm form = formOf(part);
    const double least = kRounding * form.largestEntry();
    result_.rounding += 10.0 * least * form.rotationRows();
    for (double share = 1e-9; share < 1.0; share *= 10.0) {
      const double shift =
          std::max(least * share / 1e-9, share * form.cost() / form.rotationRows());
      if (form.isPositive(shift)) {
        result_.lower_bound +=
            std::max(0.0, form.trace() - form.rotationRows() * shift);
        return;
      }
    }
    // zero is always a bound
  }

  PoseGraph graph_;
  PoseGraphCost form_;
  OptimalityCertificate result_;
};

/** The start that was not taken: without a certificate it may lead to something better.
 * Where there can be none, only if it was not far worse. */
bool
isWorthTrying(const GlobalSummary& result, const PoseGraphOptions& options)
{
  constexpr double kFarWorse = 10.0;
  if (result.certificate.certifies() || (options.interrupted && options.interrupted()))
    return false;
  const double better = std::min(result.given_cost, result.chordal_cost);
  const double worse = std::max(result.given_cost, result.chordal_cost);
  return result.certificate.available || worse <= kFarWorse * better;
}

} // namespace

OptimalityCertificate
certify(const PoseGraph& graph, PoseGraphCost form)
{
  for (const auto& [id, node] : graph.nodes())
    if (!node.has_estimate && !node.factors.empty())
      throw std::invalid_argument("node " + std::to_string(id) + " has no pose");
  return CertificateMaker(graph, form).make();
}

GlobalSummary
optimizeFromBestStart(PoseGraph& graph, const PoseGraphOptions& options)
{
  StopWatch watch;
  GlobalSummary result;
  completeEstimates(graph);
  result.given_cost = costOf(graph, options.cost);
  PoseGraph other = graph;
  initializeChordal(other, options.cost);
  result.chordal_cost = costOf(other, options.cost);
  result.from_chordal = result.chordal_cost < result.given_cost;
  if (result.from_chordal)
    std::swap(graph, other);
  result.summary = optimize(graph, options);
  result.certificate = certify(graph, options.cost);
  if (isWorthTrying(result, options)) {
    const PoseGraphSummary summary = optimize(other, options);
    if (summary.final_cost < result.summary.final_cost) {
      graph = std::move(other);
      result.summary = summary;
      result.certificate = certify(graph, options.cost);
      result.from_chordal = !result.from_chordal;
    }
  }
  result.seconds = watch.lap();
  return result;
}

} // namespace nurbs
} // namespace pcl
