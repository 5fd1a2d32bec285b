// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_certificate.h>
#include <pcl/mapping/stop_watch.h>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

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
