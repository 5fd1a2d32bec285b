// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "trajectory_settings.h"

#include "command_line.h"
#include "run_tool.h"

#include <boost/program_options.hpp>

#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;
using namespace pcl::nurbs;

void
interpretAlignment(TrajectorySettings& settings)
{
  static const std::map<std::string, TrajectoryAlignment> words = {
      {"none", TrajectoryAlignment::None},
      {"se3", TrajectoryAlignment::SE3},
      {"sim3", TrajectoryAlignment::Sim3}};
  const auto found = words.find(settings.align_word);
  if (found == words.end())
    throw ToolError(kUsage, "--align must be none, se3 or sim3");
  settings.alignment = found->second;
}

void
interpretStep(TrajectorySettings& settings)
{
  static const std::map<std::string, RelativeUnit> units = {
      {"", RelativeUnit::Poses},
      {"m", RelativeUnit::Metres},
      {"s", RelativeUnit::Seconds}};
  std::size_t end = 0;
  try {
    settings.step = std::stod(settings.step_word, &end);
  } catch (const std::logic_error&) { // no number, or one that is too large
    settings.step = 0.0;
  }
  const auto unit = units.find(settings.step_word.substr(end));
  const bool whole = settings.step == std::floor(settings.step);
  if (unit == units.end() || !(settings.step > 0.0) || !std::isfinite(settings.step) ||
      (unit->second == RelativeUnit::Poses && !whole))
    throw ToolError(kUsage, "--step must be poses (1), metres (10m) or seconds (1s)");
  settings.unit = unit->second;
}

void
describe(TrajectorySettings& settings, po::options_description& description)
{
  description.add_options()(
      "align",
      po::value(&settings.align_word)->default_value("se3"),
      "what is fitted to the estimate first: none, se3 (rigid), sim3 (with scale)")(
      "step",
      po::value(&settings.step_word)->default_value("1"),
      "length of the steps of the relative error: poses (1), metres (10m), seconds "
      "(1s)")("max-difference",
              po::value(&settings.max_difference)->default_value(0.01, "0.01"),
              "poses are compared if their times differ by no more, seconds")(
      "reference-times",
      po::value(&settings.reference_times)->value_name("FILE"),
      "times of a reference in KITTI's format, one a line, seconds")(
      "estimate-times",
      po::value(&settings.estimate_times)->value_name("FILE"),
      "times of an estimate in KITTI's format")(
      "plots",
      po::value(&settings.plots)->value_name("FOLDER"),
      "write path.png (seen along the least extent), errors.png, segments.png there");
}

} // namespace

std::optional<TrajectorySettings>
parseTrajectorySettings(int argc, char** argv)
{
  TrajectorySettings settings;
  po::options_description common("Options");
  po::options_description own("Trajectory");
  std::vector<std::string> files;
  addCommonOptions(settings.common, common);
  describe(settings, own);
  po::options_description shown;
  shown.add(common).add(own);
  const CommandTexts texts{
      "nurbs_eval",
      "nurbs_eval trajectory REFERENCE ESTIMATE\n"
      "Absolute and relative errors of poses, and KITTI's over 100 to 800 m.\n\n"
      "Files are KITTI's (12 numbers a line) or TUM's (stamp x y z qx qy qz qw).\n"
      "Poses are paired by time; those of KITTI files without times by their number.\n",
      ""};
  if (!parseCommandLine(argc, argv, texts, shown, &files))
    return std::nullopt;
  if (files.size() != 2)
    throw ToolError(kUsage, "two files are needed: REFERENCE ESTIMATE (see --help)");
  settings.reference = files[0];
  settings.estimate = files[1];
  interpretAlignment(settings);
  interpretStep(settings);
  resolveThreads(settings.common.threads);
  if (!(settings.max_difference >= 0.0))
    throw ToolError(kUsage, "--max-difference must not be negative");
  return settings;
}

} // namespace pcl_nurbs_tools
