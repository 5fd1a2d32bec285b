// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings.h"

#include "command_line.h"
#include "run_tool.h"

#include <boost/program_options.hpp>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;

void
describeDrive(SimulationSettings& s, po::options_description& description)
{
  description.add_options()("scene",
                            po::value(&s.scene)->default_value("town"),
                            "what is built around the drive: town, tunnel, square")(
      "circuit",
      po::value(&s.circuit)->default_value("block"),
      "built-in drive: block, oval, eight, line, standstill")(
      "size",
      po::value(&s.size)->default_value(120.0),
      "extent of the circuit, length of the line, metres")(
      "speed",
      po::value(&s.speed)->default_value(8.0),
      "on the circuit, m/s; for a depth camera rather a walking pace")(
      "trajectory",
      po::value(&s.trajectory)->value_name("FILE"),
      "drive along these poses instead (KITTI's format or TUM's)")(
      "times",
      po::value(&s.times)->value_name("FILE"),
      "times of poses in KITTI's format; without them one per turn of the sensor")(
      "frame",
      po::value(&s.frame)->default_value("camera"),
      "what the poses are of: camera (z ahead, y down, as KITTI's) or vehicle (x "
      "ahead, "
      "z up)")("calib",
               po::value(&s.calib)->value_name("FILE"),
               "KITTI's calib.txt, whose Tr goes from the laser to that camera");
}

void
describeSensor(SimulationSettings& s, po::options_description& description)
{
  description.add_options()(
      "sensor",
      po::value(&s.sensor)->default_value("hdl64"),
      "hdl64, hdl32, vlp16 (KITTI layout) or kinect (TUM layout)")(
      "columns",
      po::value(&s.columns)->default_value(0),
      "beams of a laser per turn and row; 0 for the sensor's own")(
      "height",
      po::value(&s.sensor_height)->default_value(1.89, "1.89"),
      "of the poses above the road, metres (where the beams of a laser start)")(
      "yaw",
      po::value(&s.yaw)->default_value(-70.0, "-70"),
      "where a camera looks, degrees left of ahead")(
      "right",
      po::value(&s.right)->default_value(3.0, "3"),
      "a camera's place to the right of the poses, metres")(
      "distortion",
      po::bool_switch(&s.simulation.motion_distortion),
      "the sensor moves during a scan (times per point go to point_times/)")(
      "exact", po::bool_switch(&s.exact), "no noise and no lost returns");
}

void
describeOutput(SimulationSettings& s, po::options_description& description)
{
  description.add_options()(
      "out", po::value(&s.out)->value_name("FOLDER"), "where the drive is written")(
      "sequence",
      po::value(&s.writing.sequence)->default_value("00"),
      "number of the sequence in KITTI's layout")(
      "first", po::value(&s.first)->default_value(0), "first scan")(
      "scans", po::value(&s.scans)->default_value(0), "scans; 0 for all")(
      "seed", po::value(&s.simulation.town.seed)->default_value(1), "of the town")(
      "labels",
      po::bool_switch(&s.writing.labels),
      "write kind and object of every point to labels/")(
      "overwrite",
      po::bool_switch(&s.overwrite),
      "remove the scans of an earlier run there, which is refused otherwise");
}

void
requireSensible(const SimulationSettings& s)
{
  if (s.out.empty())
    throw ToolError(kUsage, "--out is needed (see --help)");
  if (s.first < 0 || s.scans < 0)
    throw ToolError(kUsage, "--first and --scans must not be negative");
  const std::string& sequence = s.writing.sequence;
  if (sequence.empty() || sequence.find('/') != std::string::npos || sequence[0] == '.')
    throw ToolError(kUsage, "--sequence must be the name of a folder");
}

} // namespace

bool
parseSettings(int argc, char** argv, SimulationSettings& settings)
{
  po::options_description options("Options");
  po::options_description drive("Drive");
  po::options_description sensor("Sensor");
  po::options_description output("Output");
  addCommonOptions(settings.common, options);
  describeDrive(settings, drive);
  describeSensor(settings, sensor);
  describeOutput(settings, output);
  options.add(drive).add(sensor).add(output);
  const CommandTexts texts{
      "simulate_scans",
      "simulate_scans --out FOLDER\n"
      "Drive through a made-up town of exact surfaces and write what a laser\n"
      "or a depth camera sees, with the true poses.\n",
      "\nExit codes: 0 done, 1 wrong usage, 2 unusable input, 4 an output could not "
      "be\n"
      "written, 130 interrupted; scans finished before 4 and 130 are a valid drive.\n"};
  if (!parseCommandLine(argc, argv, texts, options, nullptr))
    return false;
  requireSensible(settings);
  settings.writing.first = static_cast<std::size_t>(settings.first);
  settings.writing.count = static_cast<std::size_t>(settings.scans);
  settings.simulation.threads = resolveThreads(settings.common.threads);
  settings.simulation.noise = !settings.exact;
  settings.simulation.town.sensor_height = settings.sensor_height;
  settings.simulation.town.scene = sceneOf(settings);
  settings.simulation.T_body_sensor = mountOf(settings);
  return true;
}

} // namespace pcl_nurbs_tools
