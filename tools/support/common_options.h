// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/program_options/options_description.hpp>

#include <string>

namespace pcl_nurbs_tools {

/** Options every command has. */
struct CommonOptions {
  std::string report; /**< JSON file, empty for none */
  int threads = 0;    /**< 0 for all cores; resolveThreads() sets it */
  bool quiet = false;
};

/** Describe --help, --version, --report, --threads and --quiet. */
void
addCommonOptions(CommonOptions& options,
                 boost::program_options::options_description& description);

/** Number of threads to use for the option's value.
 * \throws ToolError(kUsage) for a negative or absurd number */
int
resolveThreads(int requested);

/** Name, version and the libraries it runs with, one per line. */
std::string
versionText(const std::string& name);

/** Peak resident memory of this process in MB (10^6 bytes). */
double
peakMemoryMegabytes();

/** Write a text file atomically.
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writeText(const std::string& path, const std::string& text);

} // namespace pcl_nurbs_tools
