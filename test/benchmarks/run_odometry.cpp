// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Odometry over a prepared sequence (see odometry_sequences.py), for
// compare_odometry.py: writes a KITTI trajectory in the sensor's frame and prints time
// per scan and memory as a line of JSON; reading is not timed.
//
//   run_odometry FOLDER OUT.txt [--kind lidar|rgbd] [--threads N] [--log FILE]

#include <pcl/mapping/stop_watch.h>
#include <pcl/mapping/trajectory.h>
#include <pcl/registration/scan_odometry.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace {

using namespace pcl::nurbs;
namespace fs = std::filesystem;
namespace po = boost::program_options;

std::vector<float>
readFloats(const fs::path& path)
{
  std::vector<float> numbers(fs::file_size(path) / sizeof(float));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  return numbers;
}

struct TimedScan {
  ScanPoints points;
  std::vector<float> times; // 0 .. 1
};

TimedScan
readScan(const fs::path& path)
{
  constexpr std::size_t kColumns = 4;
  constexpr float kTurn = 0.1F; // seconds; the stamp is in the middle
  TimedScan scan;
  const std::vector<float> rows = readFloats(path);
  for (std::size_t i = 0; i + kColumns <= rows.size(); i += kColumns)
    scan.points.emplace_back(rows[i], rows[i + 1], rows[i + 2]);
  const fs::path times =
      path.parent_path().parent_path() / "point_times" / path.filename();
  if (fs::exists(times))
    for (const float seconds : readFloats(times))
      scan.times.push_back(seconds / kTurn + 0.5F);
  return scan;
}

std::vector<fs::path>
scansIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "velodyne"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/** VmRSS or VmHWM; getrusage() would count what the caller had before exec. */
double
memoryMegabytes(const std::string& what)
{
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word)
    if (word == what + ":") {
      double kilobytes = 0.0;
      file >> kilobytes;
      return kilobytes / 1024.0;
    }
  return 0.0;
}

/** One line per scan, to see where it was hard. */
void
log(std::ostream& stream, std::size_t scan, const OdometryResult& result, double ms)
{
  stream << scan << " tracked " << result.tracked << " searched " << result.searched
         << " iterations " << result.match.iterations << " pairs "
         << result.match.correspondences << " inliers " << result.match.inlier_share
         << " near " << result.match.near_share << " rmse " << result.match.rmse
         << " threshold " << result.threshold << " unsupported "
         << result.match.degeneracy.unsupported << " least "
         << result.match.degeneracy.support[0] << " cpu_ms " << ms << '\n';
}

struct Totals {
  double wall = 0.0;
  double cpu = 0.0;
  double iterations = 0.0;
  double early = 0.0; // megabytes after a quarter of the scans
  int lost = 0;
};

void
print(const Totals& totals, double scans)
{
  std::cout << "{\"scans\": " << scans << ", \"lost\": " << totals.lost
            << ", \"wall_ms\": " << 1e3 * totals.wall / scans
            << ", \"cpu_ms\": " << 1e3 * totals.cpu / scans
            << ", \"iterations\": " << totals.iterations / scans
            << ", \"quarter_mb\": " << totals.early
            << ", \"end_mb\": " << memoryMegabytes("VmRSS")
            << ", \"peak_mb\": " << memoryMegabytes("VmHWM") << "}\n";
}

void
run(const OdometryOptions& options, const po::variables_map& values)
{
  ScanOdometry odometry(options);
  Trajectory trajectory;
  Totals totals;
  std::ofstream lines;
  if (values.count("log") != 0)
    lines.open(values["log"].as<std::string>());
  const std::vector<fs::path> files = scansIn(values["folder"].as<std::string>());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const TimedScan scan = readScan(files[i]);
    StopWatch watch;
    const std::clock_t start = std::clock();
    const OdometryResult result = odometry.process(scan.points, scan.times);
    const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    totals.cpu += cpu;
    totals.wall += watch.lap();
    totals.iterations += result.match.iterations;
    totals.lost += result.tracked ? 0 : 1;
    if (i == files.size() / 4)
      totals.early = memoryMegabytes("VmRSS");
    if (lines.is_open())
      log(lines, i, result, 1e3 * cpu);
    trajectory.push_back({static_cast<double>(i), result.pose});
  }
  writeKittiTrajectory(values["out"].as<std::string>(), trajectory);
  print(totals, static_cast<double>(files.size()));
}

} // namespace

int
main(int argc, char** argv)
try {
  po::options_description visible("run_odometry FOLDER OUT.txt");
  auto add = visible.add_options();
  add("folder", po::value<std::string>()->required(), "a prepared sequence");
  add("out", po::value<std::string>()->required(), "trajectory");
  add("kind", po::value<std::string>()->default_value("lidar"), "lidar or rgbd");
  add("threads", po::value<int>()->default_value(2), "threads");
  add("log", po::value<std::string>(), "a line per scan");
  po::positional_options_description places;
  places.add("folder", 1).add("out", 1);
  po::variables_map values;
  po::store(
      po::command_line_parser(argc, argv).options(visible).positional(places).run(),
      values);
  po::notify(values);
  OdometryOptions options = values["kind"].as<std::string>() == "rgbd"
                                ? OdometryOptions::rgbd()
                                : OdometryOptions::lidar();
  options.threads = values["threads"].as<int>();
  run(options, values);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "run_odometry: " << error.what() << '\n';
  return 1;
}
