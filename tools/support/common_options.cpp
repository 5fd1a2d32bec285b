// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "common_options.h"

#include "run_tool.h"

#include <pcl/pcl_config.h>
#include <pcl/surface/nurbs/atomic_file.h>

#include <Eigen/Core>
#include <boost/program_options.hpp>
#include <boost/version.hpp>
#include <ceres/version.h>

#include <sys/resource.h>

#include <sstream>
#include <thread>

namespace pcl_nurbs_tools {

namespace po = boost::program_options;

void
addCommonOptions(CommonOptions& options, po::options_description& description)
{
  description.add_options()("help,h", "this text")(
      "version", "version of the program and its libraries")(
      "report",
      po::value(&options.report)->value_name("FILE.json"),
      "write figures of the run as JSON")(
      "threads",
      po::value(&options.threads)->default_value(0)->value_name("N"),
      "number of threads; 0 means all cores")(
      "quiet,q", po::bool_switch(&options.quiet), "print nothing but errors");
}

int
resolveThreads(int requested)
{
  constexpr int kMost = 1024;
  if (requested < 0 || requested > kMost)
    throw ToolError(kUsage, "--threads must be 0 to " + std::to_string(kMost));
  if (requested > 0)
    return requested;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

std::string
versionText(const std::string& name)
{
  std::ostringstream text;
  text << name << ' ' << PCL_NURBS_VERSION << '\n'
       << "PCL " << PCL_VERSION_PRETTY << '\n'
       << "Ceres " << CERES_VERSION_STRING << '\n'
       << "Eigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.'
       << EIGEN_MINOR_VERSION << '\n'
       << "Boost " << BOOST_VERSION / 100000 << '.' << BOOST_VERSION / 100 % 1000 << '.'
       << BOOST_VERSION % 100 << '\n';
  return text.str();
}

double
peakMemoryMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

void
writeText(const std::string& path, const std::string& text)
{
  try {
    pcl::nurbs::writeFileAtomically(path, text);
  } catch (const std::runtime_error& error) {
    throw ToolError(kCannotWrite, error.what());
  }
}

} // namespace pcl_nurbs_tools
