// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/random_walk.h>

#include <numeric>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

void
requireWeight(float weight)
{
  if (!std::isfinite(weight) || weight < 0.0F)
    throw std::invalid_argument("random walk: weights must be finite and not negative");
}

double
sumOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/** -p log p. */
double
surprise(double probability)
{
  return -xLogX(probability);
}

} // namespace

void
requireValidWeights(const GridGraph& graph)
{
  for (int d = 0; d < graph.numDirections(); ++d)
    for (const float weight : graph.weight(d))
      requireWeight(weight);
}

void
requireValidGraph(const WeightedGraph& graph)
{
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.a >= graph.nodes || edge.b >= graph.nodes || edge.a == edge.b)
      throw std::invalid_argument("random walk: an edge joins two nodes of the graph");
    requireWeight(edge.weight);
  }
}

WeightedGraph
toWeightedGraph(const GridGraph& graph, float min_weight)
{
  requireValidWeights(graph);
  WeightedGraph list;
  list.nodes = graph.numCells();
  list.edges.reserve(graph.numEdges());
  for (std::size_t i = 0; i < graph.numCells(); ++i)
    for (int d = 0; d < graph.numDirections(); ++d) {
      if (graph.target(d)[i] == GridGraph::kNone)
        continue;
      const float weight = graph.weight(d)[i];
      if (weight > 0.0F && weight >= min_weight)
        list.edges.push_back({static_cast<std::uint32_t>(i),
                              static_cast<std::uint32_t>(graph.target(d)[i]),
                              weight});
    }
  return list;
}

std::vector<double>
nodeWeights(const WeightedGraph& graph)
{
  requireValidGraph(graph);
  std::vector<double> weights(graph.nodes, 0.0);
  for (const WeightedEdge& edge : graph.edges) {
    weights[edge.a] += edge.weight;
    weights[edge.b] += edge.weight;
  }
  return weights;
}

std::vector<StepProbabilities>
stepProbabilities(const WeightedGraph& graph)
{
  const std::vector<double> weights = nodeWeights(graph);
  std::vector<StepProbabilities> steps;
  steps.reserve(graph.edges.size());
  for (const WeightedEdge& edge : graph.edges) {
    const double w = edge.weight;
    if (w > 0.0)
      steps.push_back({w / weights[edge.a], w / weights[edge.b]});
    else
      steps.push_back({0.0, 0.0});
  }
  return steps;
}

std::vector<double>
stationaryDistribution(const WeightedGraph& graph)
{
  std::vector<double> distribution = nodeWeights(graph);
  const double total = sumOf(distribution);
  if (total > 0.0)
    for (double& share : distribution)
      share /= total;
  return distribution;
}

double
entropyRate(const WeightedGraph& graph)
{
  return entropyRate(graph, std::vector<bool>(graph.edges.size(), true));
}

double
entropyRate(const WeightedGraph& graph, const std::vector<bool>& selected)
{
  if (selected.size() != graph.edges.size())
    throw std::invalid_argument("random walk: one flag per edge is needed");
  const std::vector<double> mu = stationaryDistribution(graph);
  const std::vector<StepProbabilities> steps = stepProbabilities(graph);
  std::vector<double> leave(graph.nodes, 0.0);
  std::vector<double> stay(graph.nodes, 0.0);
  for (std::size_t e = 0; e < steps.size(); ++e) {
    const WeightedEdge& edge = graph.edges[e];
    if (selected[e]) {
      leave[edge.a] += surprise(steps[e].forward);
      leave[edge.b] += surprise(steps[e].backward);
    }
    else {
      stay[edge.a] += steps[e].forward;
      stay[edge.b] += steps[e].backward;
    }
  }
  double rate = 0.0;
  for (std::size_t i = 0; i < graph.nodes; ++i)
    rate += mu[i] * (leave[i] + surprise(stay[i]));
  return rate;
}

ConvexPair
convexPair(const WeightedGraph& graph)
{
  const std::vector<double> weights = nodeWeights(graph);
  const double total = sumOf(weights);
  ConvexPair pair{0.0, 0.0};
  if (!(total > 0.0))
    return pair;
  for (const double weight : weights)
    pair.g += xLogX(weight / total);
  for (const WeightedEdge& edge : graph.edges)
    pair.h += 2.0 * xLogX(edge.weight / total); // both ways
  return pair;
}

EdgeSubsetWalk::EdgeSubsetWalk(const WeightedGraph& graph)
{
  const std::vector<double> weights = nodeWeights(graph);
  total_ = sumOf(weights);
  loops_.reserve(weights.size());
  for (const double weight : weights)
    loops_.push_back({weight, xLogX(weight)});
}

double
EdgeSubsetWalk::gain(const WeightedEdge& edge) const
{
  if (!(edge.weight > 0.0F))
    return 0.0;
  return scaledEdgeGain(loops_[edge.a], loops_[edge.b], edge.weight) / total_;
}

void
EdgeSubsetWalk::add(const WeightedEdge& edge)
{
  rate_ += gain(edge);
  loops_[edge.a].shorten(edge.weight);
  loops_[edge.b].shorten(edge.weight);
}

} // namespace nurbs
} // namespace pcl
