// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Odometry over a folder of .bin scans or 16-bit depth images, for
// compare_odometry.py: writes a KITTI trajectory in the sensor's frame and prints the
// time per scan, reading not counted.
//
//   run_odometry FOLDER OUT.txt [--threads N] [--deskew] [--rgbd fx,fy,cx,cy,scale]

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/stop_watch.h>
#include <pcl/mapping/trajectory.h>
#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>

namespace {

using namespace pcl::nurbs;
namespace po = boost::program_options;

struct Study {
  OdometryOptions odometry;
  CloudReadOptions reading;
  bool deskew = false;
};

std::vector<std::filesystem::path>
scansIn(const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".bin" || entry.path().extension() == ".png")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void
run(const Study& study, const std::string& folder, const std::string& out)
{
  ScanOdometry odometry(study.odometry);
  Trajectory trajectory;
  double wall = 0.0;
  double cpu = 0.0;
  int lost = 0;
  double iterations = 0.0;
  for (const auto& file : scansIn(folder)) {
    const ScanPoints points =
        finitePoints(*readCloud(file.string(), study.reading).cloud);
    const std::vector<float> times =
        study.deskew ? timesByAzimuth(points) : std::vector<float>();
    StopWatch watch;
    const std::clock_t start = std::clock();
    const OdometryResult result = odometry.process(points, times);
    cpu += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    wall += watch.lap();
    iterations += result.match.iterations;
    lost += result.tracked ? 0 : 1;
    trajectory.push_back({static_cast<double>(trajectory.size()), result.pose});
  }
  writeKittiTrajectory(out, trajectory);
  const double scans = static_cast<double>(trajectory.size());
  std::cout << "{\"scans\": " << scans << ", \"lost\": " << lost
            << ", \"wall_ms\": " << 1e3 * wall / scans
            << ", \"cpu_ms\": " << 1e3 * cpu / scans
            << ", \"iterations\": " << iterations / scans << "}\n";
}

/** Camera and scale from "fx,fy,cx,cy,scale". */
void
setCamera(const std::string& numbers, Study& study)
{
  pcl::PinholeIntrinsics camera;
  double scale = 0.0;
  if (std::sscanf(numbers.c_str(),
                  "%lf,%lf,%lf,%lf,%lf",
                  &camera.fx,
                  &camera.fy,
                  &camera.cx,
                  &camera.cy,
                  &scale) != 5)
    throw po::error("--rgbd needs five numbers");
  study.reading.intrinsics = camera;
  study.reading.depth_scale = scale;
  study.odometry = OdometryOptions::rgbd();
}

} // namespace

int
main(int argc, char** argv)
try {
  po::options_description visible("run_odometry FOLDER OUT.txt");
  auto add = visible.add_options();
  add("folder", po::value<std::string>()->required(), "scans");
  add("out", po::value<std::string>()->required(), "trajectory");
  add("threads", po::value<int>()->default_value(2), "threads");
  add("vertical-angle", po::value<double>()->default_value(0.0), "degrees");
  add("rgbd", po::value<std::string>(), "camera fx,fy,cx,cy,scale of depth images");
  add("deskew", "undo the motion within a scan, times from azimuths");
  po::positional_options_description places;
  places.add("folder", 1).add("out", 1);
  po::variables_map values;
  po::store(
      po::command_line_parser(argc, argv).options(visible).positional(places).run(),
      values);
  po::notify(values);
  Study study;
  if (values.count("rgbd") != 0)
    setCamera(values["rgbd"].as<std::string>(), study);
  study.deskew = values.count("deskew") != 0;
  study.odometry.threads = values["threads"].as<int>();
  study.odometry.vertical_angle = values["vertical-angle"].as<double>() * M_PI / 180.0;
  run(study, values["folder"].as<std::string>(), values["out"].as<std::string>());
  return 0;
} catch (const std::exception& error) {
  std::cerr << "run_odometry: " << error.what() << '\n';
  return 1;
}
