// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings.h"

#include "command_line.h"
#include "run_tool.h"
#include "settings_checks.h"
#include "word_choice.h"

#include <boost/program_options.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;

/** Options that are words or numbers before they have a meaning. */
struct RawOptions {
  std::string intrinsics;
  std::string projection;
  std::string sensor;
  std::string segmentation;
  std::string criterion;
  std::string obj;
  std::string size;
};

void
addInputOptions(Settings& settings,
                RawOptions& raw,
                po::options_description& description)
{
  description.add_options()(
      "demo", po::bool_switch(&settings.demo), "use a generated room instead of IN")(
      "intrinsics",
      po::value(&raw.intrinsics)->value_name("fx,fy,cx,cy"),
      "camera of a depth image, pixels (default: 525 pixels for 640 columns, centred)")(
      "depth-scale",
      po::value(&settings.read.depth_scale)->default_value(1000.0, "1000"),
      "stored depth per metre in a depth image")(
      "rotated-depth",
      po::bool_switch(&settings.read.rotated_depth_bits),
      "depth bits are rotated by three, as in the SUN RGB-D data set")(
      "bin-values",
      po::value(&settings.read.bin_values_per_point)->default_value(4),
      "floats per point of a .bin file: 4 (x y z reflectance) or 3")(
      "projection",
      po::value(&raw.projection)->default_value("auto"),
      "raster for clouds that are not organized: auto, spherical, perspective, plane")(
      "sensor",
      po::value(&raw.sensor)->default_value("auto"),
      "noise of the depth: auto (measured in the cloud), kinect, hdl64, or metres");
}

void
addFitOptions(Settings& settings, RawOptions& raw, po::options_description& description)
{
  pcl::nurbs::ReconstructionOptions& fit = settings.reconstruction;
  description.add_options()(
      "segmentation",
      po::value(&raw.segmentation)->default_value("surfaces"),
      "what is fitted: surfaces (found by their description length) or groups "
      "(connected points between folds and jumps)")(
      "tolerance",
      po::value(&fit.tolerance)->default_value(0.0, "0"),
      "a point belongs to a surface within this distance, metres; 0: three standard "
      "deviations of its noise")("min-segment",
                                 po::value(&settings.min_segment)->default_value(60),
                                 "smaller segments are dropped, points")(
      "min-patch",
      po::value(&fit.min_patch_points)->default_value(fit.min_patch_points),
      "smaller patches are dropped, points")(
      "max-degree",
      po::value(&fit.knots.max_degree)->default_value(3),
      "highest degree, 1 to 9")("max-control-points",
                                po::value(&fit.knots.max_control_points)
                                    ->default_value(fit.knots.max_control_points),
                                "largest net of a patch")(
      "criterion",
      po::value(&raw.criterion)->default_value("aicc"),
      "what a knot must be worth: aic, aicc, bic, known-noise")(
      "correlation",
      po::value(&fit.knots.points_per_sample)->default_value(0.0, "0"),
      "so many neighbouring points err alike and count as one; 0: what suits the "
      "sensor")("hold-out",
                po::value(&fit.hold_out_every)->default_value(fit.hold_out_every),
                "every so-manieth point is only measured, never fitted; 0 for none");
}

void
addOutputOptions(Settings& settings,
                 RawOptions& raw,
                 po::options_description& description)
{
  description.add_options()(
      "labels",
      po::value(&settings.labels)->value_name("OUT.pcd"),
      "write the organized cloud with the number of its patch per point, 0 for none")(
      "lossless",
      po::bool_switch(&settings.output.nurbs.lossless),
      "keep every bit in .nurbs files")(
      "mesh-tolerance",
      po::value(&settings.output.mesh_tolerance)->default_value(0.0, "0"),
      "largest distance of mesh and surface, metres; 0: half of what the points are "
      "off")("obj",
             po::value(&raw.obj)->default_value("mesh"),
             "content of .obj files: mesh or rational")(
      "shade",
      po::value(&settings.picture.shade)->default_value("patch"),
      "colours of .png files: patch, normal, curvature, deviation")(
      "view",
      po::value(&settings.picture.view)->default_value("auto"),
      "camera of .png files: auto, sensor, oblique, or eye and target as x,y,z,x,y,z")(
      "points",
      po::bool_switch(&settings.picture.points),
      "draw the points over the surfaces in .png files")(
      "size", po::value(&raw.size)->default_value("1024x768"), "of .png files, pixels");
}

pcl::PinholeIntrinsics
parseIntrinsics(const std::string& text)
{
  pcl::PinholeIntrinsics camera;
  char rest = 0;
  const int read = std::sscanf(text.c_str(),
                               "%lf,%lf,%lf,%lf%c",
                               &camera.fx,
                               &camera.fy,
                               &camera.cx,
                               &camera.cy,
                               &rest);
  if (read != 4 || !std::isfinite(camera.cx) || !std::isfinite(camera.cy) ||
      !(camera.fx > 0.0) || !(camera.fy > 0.0) || !std::isfinite(camera.fx) ||
      !std::isfinite(camera.fy))
    throw ToolError(kUsage, "--intrinsics must be fx,fy,cx,cy in pixels");
  return camera;
}

std::optional<pcl::SensorNoise>
parseSensor(const std::string& word)
{
  if (word == "auto")
    return std::nullopt;
  if (word == "kinect")
    return pcl::SensorNoise::kinect();
  if (word == "hdl64")
    return pcl::SensorNoise::hdl64();
  pcl::SensorNoise noise;
  char rest = 0;
  if (std::sscanf(word.c_str(), "%lf%c", &noise.constant, &rest) != 1 ||
      !(noise.constant > 0.0) || !std::isfinite(noise.constant))
    throw ToolError(kUsage, "--sensor must be auto, kinect, hdl64, or metres above 0");
  return noise;
}

void
interpret(const RawOptions& raw, Settings& settings)
{
  using Organizer = pcl::CloudOrganizer<pcl::PointXYZ>;
  using pcl::nurbs::ModelCriterion;
  if (!raw.intrinsics.empty())
    settings.read.intrinsics = parseIntrinsics(raw.intrinsics);
  settings.noise = parseSensor(raw.sensor);
  settings.projection =
      chosen<Organizer::Projection>("--projection",
                                    raw.projection,
                                    {{"auto", Organizer::AUTO},
                                     {"spherical", Organizer::SPHERICAL},
                                     {"perspective", Organizer::PERSPECTIVE},
                                     {"plane", Organizer::PLANE}});
  settings.segmentation =
      chosen<SegmentationChoice>("--segmentation",
                                 raw.segmentation,
                                 {{"surfaces", SegmentationChoice::Surfaces},
                                  {"groups", SegmentationChoice::Groups}});
  settings.reconstruction.knots.criterion =
      chosen<ModelCriterion>("--criterion",
                             raw.criterion,
                             {{"aic", ModelCriterion::AIC},
                              {"aicc", ModelCriterion::AICc},
                              {"bic", ModelCriterion::BIC},
                              {"known-noise", ModelCriterion::KnownNoise}});
  settings.output.obj_rational =
      chosen<bool>("--obj", raw.obj, {{"mesh", false}, {"rational", true}});
  char rest = 0;
  if (std::sscanf(raw.size.c_str(),
                  "%dx%d%c",
                  &settings.picture.width,
                  &settings.picture.height,
                  &rest) != 2)
    throw ToolError(kUsage, "--size must be WIDTHxHEIGHT");
  settings.words = {{"intrinsics", raw.intrinsics},
                    {"projection", raw.projection},
                    {"sensor", raw.sensor},
                    {"segmentation", raw.segmentation},
                    {"criterion", raw.criterion},
                    {"obj", raw.obj},
                    {"size", raw.size}};
}

/** Without outputs the surfaces go to a .nurbs and a .png beside the caller. */
void
nameOutputs(std::vector<std::string> files, Settings& settings)
{
  if (!settings.demo) {
    if (files.empty())
      throw ToolError(kUsage, "no input file (see --help)");
    settings.input = files.front();
    files.erase(files.begin());
  }
  settings.outputs = std::move(files);
  if (!settings.outputs.empty() || !settings.labels.empty())
    return;
  const std::string stem =
      settings.demo ? "demo" : std::filesystem::path(settings.input).stem().string();
  settings.outputs = {stem + ".nurbs", stem + ".png"};
}

} // namespace

std::optional<Settings>
parseSettings(int argc, char** argv)
{
  Settings settings;
  RawOptions raw;
  std::vector<std::string> files;
  po::options_description common("Options");
  po::options_description input("Input");
  po::options_description fit("Surfaces");
  po::options_description output("Output");
  addCommonOptions(settings.common, common);
  addInputOptions(settings, raw, input);
  addFitOptions(settings, raw, fit);
  addOutputOptions(settings, raw, output);
  po::options_description shown;
  shown.add(common).add(input).add(fit).add(output);
  const CommandTexts texts{
      "pcd_to_nurbs",
      "pcd_to_nurbs IN [OUT...]\n"
      "Turn a point cloud into trimmed NURBS surfaces.\n\n"
      "IN   .pcd, .ply, KITTI .bin, or a 16-bit depth .png\n"
      "OUT  .nurbs .json .obj .ply .png, as many as wanted; without any\n"
      "     NAME.nurbs and NAME.png in the current folder\n",
      "\nExit codes: 0 done, 1 wrong usage, 2 input unreadable or invalid,\n"
      "3 no surface found, 4 output could not be written.\n"};
  if (!parseCommandLine(argc, argv, texts, shown, &files))
    return std::nullopt;
  interpret(raw, settings);
  nameOutputs(std::move(files), settings);
  checkSettings(settings);
  settings.common.threads = resolveThreads(settings.common.threads);
  settings.reconstruction.threads = settings.common.threads;
  return settings;
}

} // namespace pcl_nurbs_tools
