// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace pcl_nurbs_tools {

/** Exit codes of every command. */
enum ExitCode {
  kDone = 0,
  kUsage = 1,
  kBadInput = 2,
  kNothingProduced = 3,
  kCannotWrite = 4,
  kInterrupted = 130
};

/** Ends a command with a message of one line and an exit code. */
class ToolError : public std::runtime_error {
public:
  ToolError(ExitCode code, const std::string& message)
      : std::runtime_error(message), code_(code)
  {
  }

  ExitCode
  code() const
  {
    return code_;
  }

private:
  ExitCode code_;
};

/** Run a command: quiet libraries, Ctrl-C handled, errors as one line on stderr.
 * \return exit code */
int
runTool(const std::string& name, const std::function<void()>& command);

/** Whether Ctrl-C or SIGTERM came. */
bool
interrupted();

/** \throws ToolError(kInterrupted) if Ctrl-C or SIGTERM came */
void
throwIfInterrupted();

} // namespace pcl_nurbs_tools
