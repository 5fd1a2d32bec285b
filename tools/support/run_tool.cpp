// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "run_tool.h"

#include <pcl/mapping/cloud_reader.h>

#include <pcl/console/print.h>

#include <boost/program_options/errors.hpp>
#include <glog/logging.h>

#include <csignal>
#include <iostream>
#include <new>

namespace pcl_nurbs_tools {
namespace {

volatile std::sig_atomic_t signal_received = 0;

extern "C" void
onSignal(int number)
{
  signal_received = 1;
  std::signal(number, SIG_DFL); // a second one does not wait
}

int
fail(const std::string& name, ExitCode code, const std::string& message)
{
  std::cerr << name << ": " << message << '\n';
  return code;
}

} // namespace

bool
interrupted()
{
  return signal_received != 0;
}

void
throwIfInterrupted()
{
  if (interrupted())
    throw ToolError(kInterrupted, "interrupted");
}

int
runTool(const std::string& name, const std::function<void()>& command)
{
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  std::signal(SIGXFSZ, SIG_IGN); // a limit of file sizes is an error like a full disk
  // Messages are ours, one line each; libraries have said what they know by exceptions.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  FLAGS_minloglevel = google::GLOG_FATAL;
  try {
    command();
    return kDone;
  } catch (const ToolError& error) {
    return fail(name, error.code(), error.what());
  } catch (const boost::program_options::error& error) {
    return fail(name, kUsage, std::string(error.what()) + " (see --help)");
  } catch (const pcl::nurbs::InputError& error) {
    return fail(name, kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(name, kBadInput, "not enough memory for this input");
  } catch (const std::exception& error) {
    return fail(name, kBadInput, error.what());
  }
}

} // namespace pcl_nurbs_tools
