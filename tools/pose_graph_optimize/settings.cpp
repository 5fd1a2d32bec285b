// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings.h"

#include "command_line.h"
#include "run_tool.h"
#include "word_choice.h"

#include <boost/program_options.hpp>

#include <stdexcept>
#include <vector>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;
using namespace pcl::nurbs;

void
describe(GraphSettings& settings, po::options_description& description)
{
  description.add_options()(
      "init",
      po::value(&settings.init_word)->default_value("file"),
      "where to start: file (its vertices; those that are missing along the edges), "
      "none (along the edges alone), chordal (linear relaxation of all edges), random")(
      "local",
      po::bool_switch(&settings.local),
      "start there whatever happens; without, from the chordal relaxation where that "
      "is better, and a result without certificate is compared with its")(
      "cost",
      po::value(&settings.cost_word)->default_value("g2o"),
      "what is minimised: g2o (error' * information * error) or sesync (chordal "
      "distances, isotropic)")(
      "incremental",
      po::bool_switch(&settings.incremental),
      "add vertex by vertex in the order of their numbers, estimating after "
      "each, and time it; all at once at the end")(
      "method",
      po::value(&settings.method_word)->default_value("ceres"),
      "who solves: ceres or multifrontal (our own Cholesky, faster)")(
      "robust",
      po::value(&settings.robust_word)->default_value("none"),
      "find edges between vertices that do not follow each other (loops) that are "
      "false, and leave them out of OUT.g2o: consensus (best), gnc, switchable, pcm, "
      "none; the others are trusted and must hold the graph together")(
      "iterations",
      po::value(&settings.solver.max_iterations)->default_value(200),
      "no more steps than this")(
      "tolerance",
      po::value(&settings.solver.function_tolerance)->default_value(1e-10, "1e-10"),
      "stop when a step lowers the cost by less than this share of it")(
      "seed", po::value(&settings.seed)->default_value(1), "of random starts")(
      "strict",
      po::bool_switch(&settings.strict),
      "refuse files with unknown tags, edges that cannot be used and the like, which "
      "are "
      "otherwise reported and kept")(
      "kitti",
      po::value(&settings.kitti)->value_name("FILE"),
      "write the poses in KITTI's format, in the order of their numbers")(
      "tum",
      po::value(&settings.tum)->value_name("FILE"),
      "write the poses in TUM's format, their numbers as times")(
      "plots",
      po::value(&settings.plots)->value_name("FOLDER"),
      "write before.png and after.png there, seen along the least extent");
}

void
interpret(GraphSettings& settings, const std::vector<std::string>& files)
{
  if (files.empty() || files.size() > 2)
    throw ToolError(kUsage,
                    "one or two files are needed: IN.g2o [OUT.g2o] (see --help)");
  settings.input = files[0];
  settings.output = files.size() > 1 ? files[1] : "";
  settings.start = chosen<StartKind>("--init",
                                     settings.init_word,
                                     {{"file", StartKind::File},
                                      {"none", StartKind::None},
                                      {"chordal", StartKind::Chordal},
                                      {"random", StartKind::Random}});
  settings.solver.cost = chosen<PoseGraphCost>(
      "--cost",
      settings.cost_word,
      {{"g2o", PoseGraphCost::Information}, {"sesync", PoseGraphCost::SeSync}});
  settings.solver.method =
      chosen<PoseGraphMethod>("--method",
                              settings.method_word,
                              {{"ceres", PoseGraphMethod::Ceres},
                               {"multifrontal", PoseGraphMethod::Multifrontal}});
  settings.robust =
      chosen<std::optional<RobustMethod>>("--robust",
                                          settings.robust_word,
                                          {{"none", std::nullopt},
                                           {"consensus", RobustMethod::Consensus},
                                           {"gnc", RobustMethod::GraduatedNonConvexity},
                                           {"switchable", RobustMethod::Switchable},
                                           {"pcm", RobustMethod::PairwiseConsistency}});
  if (settings.robust && settings.incremental)
    throw ToolError(kUsage, "--robust and --incremental exclude each other");
  settings.solver.threads = resolveThreads(settings.common.threads);
  settings.solver.interrupted = interrupted;
  try {
    settings.solver.validate();
  } catch (const std::invalid_argument& error) {
    throw ToolError(kUsage, error.what());
  }
}

} // namespace

std::optional<GraphSettings>
parseGraphSettings(int argc, char** argv)
{
  GraphSettings settings;
  po::options_description common("Options");
  po::options_description own("Pose graph");
  std::vector<std::string> files;
  addCommonOptions(settings.common, common);
  describe(settings, own);
  po::options_description shown;
  shown.add(common).add(own);
  const CommandTexts texts{
      "pose_graph_optimize",
      "pose_graph_optimize IN.g2o [OUT.g2o]\n"
      "Find the poses of a graph that agree best with its edges.\n\n"
      "Files are g2o's (VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, FIX),\n"
      "gzip-compressed if they end in .gz. Other rows are kept as they are.\n",
      ""};
  if (!parseCommandLine(argc, argv, texts, shown, &files))
    return std::nullopt;
  interpret(settings, files);
  return settings;
}

} // namespace pcl_nurbs_tools
