// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_certificate.h>

#include "certificate_form.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

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

} // namespace

OptimalityCertificate
certify(const PoseGraph& graph, PoseGraphCost form)
{
  for (const auto& [id, node] : graph.nodes())
    if (!node.has_estimate && !node.factors.empty())
      throw std::invalid_argument("node " + std::to_string(id) + " has no pose");
  return CertificateMaker(graph, form).make();
}

} // namespace nurbs
} // namespace pcl
