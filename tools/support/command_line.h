// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/program_options/options_description.hpp>

#include <string>
#include <vector>

namespace pcl_nurbs_tools {

/** What --help and --version say of a command. */
struct CommandTexts {
  std::string name;      /**< of the program */
  std::string usage;     /**< before the list of options */
  std::string afterword; /**< behind it */
};

/** Parse a command line; values go where the options say. Options are not abbreviated.
 * \param[in] texts for --help and --version, which are answered here
 * \param[in] options all that --help lists, with those of addCommonOptions()
 * \param[out] files words that are no options; null if there must be none
 * \return false if --help or --version has been answered
 * \throws boost::program_options::error naming what is wrong */
bool
parseCommandLine(int argc,
                 const char* const* argv,
                 const CommandTexts& texts,
                 const boost::program_options::options_description& options,
                 std::vector<std::string>* files);

} // namespace pcl_nurbs_tools
