// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "command_line.h"

#include "common_options.h"

#include <boost/program_options.hpp>

#include <iostream>

namespace pcl_nurbs_tools {

namespace po = boost::program_options;

bool
parseCommandLine(int argc,
                 const char* const* argv,
                 const CommandTexts& texts,
                 const po::options_description& options,
                 std::vector<std::string>* files)
{
  po::options_description all;
  po::positional_options_description positional;
  all.add(options);
  if (files != nullptr) {
    all.add_options()("file", po::value(files));
    positional.add("file", -1);
  }
  po::variables_map values;
  const int style =
      po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::store(po::command_line_parser(argc, argv)
                .options(all)
                .positional(positional)
                .style(style)
                .run(),
            values);
  if (values.count("help") != 0) {
    std::cout << texts.usage << options << texts.afterword;
    return false;
  }
  if (values.count("version") != 0) {
    std::cout << versionText(texts.name);
    return false;
  }
  po::notify(values);
  return true;
}

} // namespace pcl_nurbs_tools
