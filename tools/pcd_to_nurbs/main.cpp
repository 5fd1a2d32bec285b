// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// pcd_to_nurbs: one point cloud in, trimmed NURBS surfaces out.

#include "labels_file.h"
#include "progress_bar.h"
#include "run_tool.h"
#include "settings.h"

#include <pcl/mapping/demo_scene.h>
#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/mapping/stop_watch.h>
#include <pcl/segmentation/entropy_rate_segmentation.h>

#include <pcl/common/point_tests.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace {

using namespace pcl_nurbs_tools;
using pcl::nurbs::StopWatch;
using Reconstructor = pcl::NurbsReconstruction<pcl::PointXYZ>;

/** A run of the command: its input, its result, and how long each stage took. */
class Run {
public:
  explicit Run(const Settings& settings) : settings_(settings) {}

  void
  execute()
  {
    StopWatch total;
    requireFolders();
    load();
    throwIfInterrupted();
    reconstruct();
    write();
    total_seconds_ = total.lap();
    if (!settings_.common.report.empty())
      writeText(settings_.common.report, report().dump(2) + '\n');
    if (!settings_.common.quiet)
      printSummary();
  }

private:
  /** Work of minutes must not end with a folder that is not there. */
  void
  requireFolders() const
  {
    std::vector<std::string> paths = settings_.outputs;
    paths.push_back(settings_.labels);
    paths.push_back(settings_.common.report);
    for (const std::string& path : paths) {
      const std::filesystem::path folder = std::filesystem::path(path).parent_path();
      std::error_code error;
      if (!folder.empty() && !std::filesystem::is_directory(folder, error))
        throw ToolError(
            kCannotWrite,
            "cannot write " + path + ": " +
                (error ? error.message() : folder.string() + " is no folder"));
    }
  }

  void
  load()
  {
    StopWatch watch;
    if (settings_.demo) {
      const pcl::nurbs::DemoScene scene;
      cloud_ = scene.cloud();
      reconstructor_.setGeometry(
          pcl::GridGeometry::pinhole(static_cast<int>(cloud_->width),
                                     static_cast<int>(cloud_->height),
                                     scene.intrinsics()));
      reconstructor_.setSensorNoise(scene.noise());
    }
    else {
      const pcl::nurbs::InputCloud input =
          pcl::nurbs::readCloud(settings_.input, settings_.read);
      cloud_ = input.cloud;
      offset_ = input.offset;
      if (input.intrinsics)
        reconstructor_.setGeometry(
            pcl::GridGeometry::pinhole(static_cast<int>(cloud_->width),
                                       static_cast<int>(cloud_->height),
                                       *input.intrinsics));
    }
    load_seconds_ = watch.lap();
  }

  void
  reconstruct()
  {
    ProgressBar bar("surfaces", settings_.common.quiet);
    pcl::nurbs::ReconstructionOptions options = settings_.reconstruction;
    options.progress = [&bar](double share) { bar.update(share); };
    options.stop = interrupted;
    if (settings_.noise)
      reconstructor_.setSensorNoise(*settings_.noise);
    Reconstructor::Segmentation::Ptr segmentation;
    if (settings_.segmentation == SegmentationChoice::Surfaces)
      segmentation.reset(new pcl::EntropyRateSegmentation<pcl::PointXYZ>);
    else
      segmentation.reset(new pcl::ConnectedGroupsSegmentation<pcl::PointXYZ>);
    segmentation->setMinSegmentSize(static_cast<std::size_t>(settings_.min_segment));
    reconstructor_.setSegmentation(segmentation);
    reconstructor_.setProjection(settings_.projection);
    reconstructor_.setOptions(options);
    reconstructor_.setInputCloud(cloud_);
    const bool found = reconstructor_.reconstruct(model_);
    throwIfInterrupted();
    if (!found)
      throw ToolError(kNothingProduced,
                      name() +
                          (countValid() == 0
                               ? ": no point has finite coordinates"
                               : ": no surface found (try a smaller --min-segment)"));
    const Eigen::Affine3d back(Eigen::Translation3d{offset_});
    if (!offset_.isZero())
      for (pcl::nurbs::SurfacePatch& patch : model_.patches)
        patch.geometry = pcl::nurbs::TrimmedSurface(
            patch.geometry.surface().transformed(back), patch.geometry.loops());
    model_.metadata["source"] = std::filesystem::path(name()).filename().string();
    model_.metadata["generator"] = "pcd_to_nurbs";
  }

  void
  write()
  {
    StopWatch watch;
    for (const std::string& path : settings_.outputs) {
      throwIfInterrupted();
      if (extensionOf(path) == ".png")
        writePicture(
            path, gridPoints(), reconstructor_.getReconstruction(), settings_.picture);
      else
        writeSurfaces(path, model_, settings_.output);
      if (extensionOf(path) == ".nurbs" && std::filesystem::is_regular_file(path))
        bytes_ = std::filesystem::file_size(path);
    }
    if (!settings_.labels.empty())
      writeLabels(settings_.labels,
                  *reconstructor_.getOrganizedCloud(),
                  offset_,
                  reconstructor_.getReconstruction().labels);
    if (bytes_ == 0)
      bytes_ = pcl::nurbs::encodePatches(model_.patches, settings_.output.nurbs).size();
    write_seconds_ = watch.lap();
  }

  pcl::nurbs::GridPoints
  gridPoints() const
  {
    return pcl::nurbs::toGridPoints(*reconstructor_.getOrganizedCloud(),
                                    reconstructor_.getGeometry());
  }

  std::string
  name() const
  {
    return settings_.demo ? "demo scene" : settings_.input;
  }

  std::size_t
  countValid() const
  {
    std::size_t count = 0;
    for (const pcl::PointXYZ& point : *cloud_)
      count += pcl::isFinite(point) ? 1 : 0;
    return count;
  }

  /** Tolerance at the median depth, where it is not the same for all points. */
  double
  toleranceMetres() const
  {
    if (settings_.reconstruction.tolerance > 0.0)
      return settings_.reconstruction.tolerance;
    std::vector<float> depths;
    for (float depth : gridPoints().depth)
      if (!std::isnan(depth))
        depths.push_back(depth);
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return settings_.reconstruction.tolerance_sigmas *
           reconstructor_.getUsedNoise().sigma(*middle);
  }

  nlohmann::json
  report() const
  {
    const pcl::nurbs::ReconstructionStatistics statistics =
        pcl::nurbs::summarize(reconstructor_.getReconstruction());
    const Reconstructor::Seconds& seconds = reconstructor_.getSeconds();
    const std::size_t valid = countValid();
    return {
        {"points", cloud_->size()},
        {"valid_points", valid},
        {"segments", reconstructor_.getNumSegments()},
        {"patches", model_.patches.size()},
        {"control_points", model_.numControlPoints()},
        {"bytes", bytes_},
        {"rmse_m", statistics.rmse},
        {"mean_m", statistics.mean},
        {"p95_m", statistics.p95},
        {"max_m", statistics.max},
        {"coverage",
         static_cast<double>(statistics.covered_points) / static_cast<double>(valid)},
        {"tolerance_m", toleranceMetres()},
        {"seconds",
         {{"load", load_seconds_},
          {"organize", seconds.organize},
          {"segment", seconds.segment},
          {"fit", seconds.fit},
          {"trim", seconds.trim},
          {"write", write_seconds_},
          {"total", total_seconds_}}},
        {"peak_rss_mb", peakMemoryMegabytes()},
        {"options", optionsAsJson(settings_)}};
  }

  void
  printSummary() const
  {
    const nlohmann::json r = report();
    std::printf("%s: %zu points, %zu patches, %zu control points, %zu bytes\n"
                "covered %.1f %% of the points; held-out error %.2f mm rms, %.2f mm at "
                "95 %%; %.2f s\n",
                name().c_str(),
                r["valid_points"].get<std::size_t>(),
                model_.patches.size(),
                model_.numControlPoints(),
                bytes_,
                100.0 * r["coverage"].get<double>(),
                1e3 * r["rmse_m"].get<double>(),
                1e3 * r["p95_m"].get<double>(),
                total_seconds_);
    for (const std::string& path : settings_.outputs)
      std::printf("wrote %s\n", path.c_str());
    if (!settings_.labels.empty())
      std::printf("wrote %s\n", settings_.labels.c_str());
  }

  const Settings& settings_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Reconstructor reconstructor_;
  pcl::nurbs::SurfaceModel model_;
  std::size_t bytes_ = 0;
  double load_seconds_ = 0.0;
  double write_seconds_ = 0.0;
  double total_seconds_ = 0.0;
};

} // namespace

int
main(int argc, char** argv)
{
  return runTool("pcd_to_nurbs", [&] {
    if (const auto settings = parseSettings(argc, argv))
      Run(*settings).execute();
  });
}
