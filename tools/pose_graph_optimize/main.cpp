// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "graph_plot.h"
#include "incremental_run.h"
#include "progress_bar.h"
#include "robust_run.h"
#include "run_tool.h"
#include "settings.h"

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/pose_graph_certificate.h>
#include <pcl/mapping/pose_graph_io.h>
#include <pcl/mapping/stop_watch.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <numeric>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

/** Both forms of the cost. */
struct Costs {
  double g2o = 0.0;
  double sesync = 0.0;
};

/** A run, for the report. */
struct Outcome {
  PoseGraph before;
  PoseGraph after;
  Costs initial;
  Costs final;
  PoseGraphSummary summary;
  OptimalityCertificate certificate;
  bool from_chordal = false;
  std::optional<IncrementalRun> incremental;
  nlohmann::json robust;
  double read_seconds = 0.0;
  double solve_seconds = 0.0;
};

Costs
costsOf(const PoseGraph& graph)
{
  return {costOf(graph, PoseGraphCost::Information),
          costOf(graph, PoseGraphCost::SeSync)};
}

void
forgetPoses(PoseGraph& graph)
{
  const PoseGraph::Nodes nodes = graph.nodes();
  for (const auto& [id, node] : nodes)
    if (!node.fixed && !node.factors.empty())
      graph.clearPose(id);
}

/** The graph with the estimates to start from. */
PoseGraph
startOf(PoseGraph graph, const GraphSettings& settings)
{
  if (settings.start == StartKind::None)
    forgetPoses(graph);
  if (settings.start == StartKind::Random)
    initializeRandomly(graph, settings.seed);
  if (settings.start == StartKind::Chordal)
    initializeChordal(graph, settings.solver.cost);
  else
    completeEstimates(graph);
  return graph;
}

void
optimizeAtOnce(const GraphSettings& settings, Outcome& outcome)
{
  if (settings.local || settings.start == StartKind::Chordal) {
    outcome.from_chordal = settings.start == StartKind::Chordal;
    outcome.summary = optimize(outcome.after, settings.solver);
    outcome.certificate = certify(outcome.after, settings.solver.cost);
    return;
  }
  const GlobalSummary result = optimizeFromBestStart(outcome.after, settings.solver);
  outcome.summary = result.summary;
  outcome.certificate = result.certificate;
  outcome.from_chordal = result.from_chordal;
}

Outcome
solve(const GraphSettings& settings, const PoseGraph& graph)
{
  Outcome outcome;
  ProgressBar bar("optimising", settings.common.quiet);
  outcome.before = startOf(graph, settings);
  outcome.initial = costsOf(outcome.before);
  outcome.after = outcome.before;
  if (settings.incremental) {
    outcome.incremental = runIncrementally(
        outcome.before, settings.solver, [&](double share) { bar.update(share); });
    outcome.after = outcome.incremental->graph;
    outcome.summary = outcome.incremental->all;
    outcome.certificate = certify(outcome.after, settings.solver.cost);
  }
  else if (settings.robust) {
    RobustRun run = runRobustly(outcome.before, *settings.robust, settings.solver);
    outcome.after = run.graph;
    outcome.summary = run.summary;
    outcome.robust = run.report;
    outcome.certificate = certify(outcome.after, settings.solver.cost);
  }
  else
    optimizeAtOnce(settings, outcome);
  throwIfInterrupted();
  outcome.final = costsOf(outcome.after);
  return outcome;
}

nlohmann::json
timesOf(const IncrementalRun& run)
{
  std::vector<double> sorted = run.seconds;
  std::sort(sorted.begin(), sorted.end());
  const auto count = sorted.size();
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  return {{"updates", count},
          {"ms_mean", 1e3 * sum / static_cast<double>(count)},
          {"ms_p99", 1e3 * sorted[(count - 1) * 99 / 100]},
          {"ms_max", 1e3 * sorted.back()},
          {"eliminated_mean", run.eliminated},
          {"solved_mean", run.solved},
          {"cost_before_all", run.cost_before_all}};
}

nlohmann::json
reportOf(const GraphSettings& settings, const G2oGraph& input, const Outcome& outcome)
{
  const auto both = [](const Costs& costs) -> nlohmann::json {
    return {{"g2o", costs.g2o}, {"sesync", costs.sesync}};
  };
  nlohmann::json certificate = {{"available", outcome.certificate.available}};
  if (outcome.certificate.available) {
    certificate["lower_bound"] = outcome.certificate.lower_bound;
    certificate["certified"] = outcome.certificate.certifies();
  }
  else
    certificate["reason"] = outcome.certificate.reason;
  nlohmann::json report = {{"nodes", input.graph.nodes().size()},
                           {"edges", input.graph.factors().size()},
                           {"components", outcome.summary.components},
                           {"initial_cost", both(outcome.initial)},
                           {"final_cost", both(outcome.final)},
                           {"iterations", outcome.summary.iterations},
                           {"converged", outcome.summary.converged},
                           {"from_chordal", outcome.from_chordal},
                           {"certificate", certificate},
                           {"ignored_rows", input.ignored_rows},
                           {"messages", input.messages},
                           {"seconds",
                            {{"read", outcome.read_seconds},
                             {"optimise", outcome.solve_seconds},
                             {"solver", outcome.summary.seconds}}},
                           {"peak_rss_mb", peakMemoryMegabytes()},
                           {"options",
                            {{"init", settings.init_word},
                             {"local", settings.local},
                             {"cost", settings.cost_word},
                             {"method", settings.method_word},
                             {"incremental", settings.incremental},
                             {"robust", settings.robust_word},
                             {"iterations", settings.solver.max_iterations},
                             {"tolerance", settings.solver.function_tolerance},
                             {"seed", settings.seed}}}};
  if (outcome.incremental)
    report["incremental"] = timesOf(*outcome.incremental);
  if (settings.robust)
    report["robust"] = outcome.robust;
  return report;
}

void
print(const nlohmann::json& report, const Outcome& outcome)
{
  std::printf("%zu poses, %zu edges, %zu part%s\n",
              report["nodes"].get<std::size_t>(),
              report["edges"].get<std::size_t>(),
              outcome.summary.components,
              outcome.summary.components == 1 ? "" : "s");
  std::printf("%-10s %18s %18s\n", "cost", "g2o", "SE-Sync");
  std::printf(
      "%-10s %18.9g %18.9g\n", "initial", outcome.initial.g2o, outcome.initial.sesync);
  std::printf(
      "%-10s %18.9g %18.9g\n", "final", outcome.final.g2o, outcome.final.sesync);
  std::printf("%d iterations%s, %.3f s\n",
              outcome.summary.iterations,
              outcome.summary.converged ? "" : " (not converged)",
              outcome.solve_seconds);
  if (outcome.certificate.certifies())
    std::printf("certified: no poses cost less than %.9g\n",
                outcome.certificate.lower_bound);
  else if (outcome.certificate.available)
    std::printf("not certified: a minimum, perhaps not the lowest (bound %.9g)\n",
                outcome.certificate.lower_bound);
  else
    std::printf("no certificate: %s\n", outcome.certificate.reason.c_str());
  if (!outcome.robust.is_null())
    printRobust(outcome.robust);
  if (outcome.incremental)
    std::printf(
        "update: %.3f ms mean, %.3f ms p99, %.3f ms max; %.1f poses eliminated\n",
        report["incremental"]["ms_mean"].get<double>(),
        report["incremental"]["ms_p99"].get<double>(),
        report["incremental"]["ms_max"].get<double>(),
        outcome.incremental->eliminated);
}

void
writePlots(const std::filesystem::path& folder, const Outcome& outcome)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw ToolError(kCannotWrite,
                    "cannot write " + folder.string() + ": " + error.message());
  writeGraphPlot((folder / "before.png").string(), "Before", outcome.before);
  writeGraphPlot((folder / "after.png").string(), "After", outcome.after);
}

void
writeOutputs(const GraphSettings& settings,
             const G2oGraph& input,
             const Outcome& outcome)
{
  try {
    if (!settings.output.empty())
      writeG2o(settings.output, outcome.after, input.layout.get());
    if (!settings.kitti.empty())
      writeKittiTrajectory(settings.kitti, trajectoryOf(outcome.after));
    if (!settings.tum.empty())
      writeTumTrajectory(settings.tum, trajectoryOf(outcome.after));
  } catch (const std::runtime_error& error) {
    throw ToolError(kCannotWrite, error.what());
  }
  if (!settings.plots.empty())
    writePlots(settings.plots, outcome);
}

void
tellMessages(const GraphSettings& settings, const G2oGraph& input)
{
  if (input.messages.empty())
    return;
  if (settings.strict)
    throw ToolError(kBadInput, input.messages.front());
  if (!settings.common.quiet)
    for (const std::string& message : input.messages)
      std::cerr << "pose_graph_optimize: " << message << '\n';
}

void
run(int argc, char** argv)
{
  const std::optional<GraphSettings> parsed = parseGraphSettings(argc, argv);
  if (!parsed)
    return;
  const GraphSettings& settings = *parsed;
  StopWatch watch;
  const G2oGraph input = readG2o(settings.input);
  const double read_seconds = watch.lap();
  tellMessages(settings, input);
  watch.lap();
  Outcome outcome = solve(settings, input.graph);
  outcome.read_seconds = read_seconds;
  outcome.solve_seconds = watch.lap();
  writeOutputs(settings, input, outcome);
  const nlohmann::json report = reportOf(settings, input, outcome);
  if (!settings.common.report.empty())
    writeText(settings.common.report, report.dump(2) + '\n');
  if (!settings.common.quiet)
    print(report, outcome);
}

} // namespace
} // namespace pcl_nurbs_tools

int
main(int argc, char** argv)
{
  using namespace pcl_nurbs_tools;
  return runTool("pose_graph_optimize", [&] { run(argc, argv); });
}
