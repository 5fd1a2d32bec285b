// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// nurbs_eval: how good a result is, measured against truth.

#include "run_tool.h"
#include "trajectory_command.h"

#include <cstring>
#include <iostream>

int
main(int argc, char** argv)
{
  using namespace pcl_nurbs_tools;
  return runTool("nurbs_eval", [&] {
    if (argc > 1 && std::strcmp(argv[1], "trajectory") == 0)
      return evaluateTrajectory(argc - 1, argv + 1);
    if (argc > 1 && std::strcmp(argv[1], "--version") == 0) {
      std::cout << versionText("nurbs_eval");
      return;
    }
    const bool asked = argc > 1 && (std::strcmp(argv[1], "--help") == 0 ||
                                    std::strcmp(argv[1], "-h") == 0);
    if (!asked)
      throw ToolError(kUsage,
                      argc > 1 ? std::string("unknown command \"") + argv[1] +
                                     "\" (see --help)"
                               : "no command (see --help)");
    std::cout << "nurbs_eval COMMAND ...\n"
                 "Measure a result against truth.\n\n"
                 "trajectory  errors of an estimated trajectory\n\n"
                 "nurbs_eval COMMAND --help tells its options.\n";
  });
}
