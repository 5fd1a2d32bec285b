// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings_entries.h"

namespace pcl_nurbs_tools {
namespace {

void
addDataset(SettingsTable& table, SlamSettings& s)
{
  table.add("dataset",
            &s.dataset,
            "kitti, kitti_raw, tum, files, sim, or auto: by what is in the folder");
  table.add("path", &s.path, "folder of the data set");
  table.add("sequence", &s.sequence, "of KITTI's odometry benchmark");
  table.add("poses", &s.reading.poses_path, "file of true poses instead of its own");
  table.add("times", &s.reading.times_path, "file of times instead of its own");
  table.add("period", &s.reading.period, "seconds between scans without times");
  table.add("intrinsics", &s.intrinsics, "fx,fy,cx,cy of depth images");
  table.add("depth_scale",
            &s.reading.cloud.depth_scale,
            "depth per metre of depth images, 0 for the layout's own");
  table.add(
      "bin_values", &s.reading.cloud.bin_values_per_point, "per point of .bin: 3, 4");
  table.add("vertical_correction",
            &s.reading.correct_vertical_angles,
            "turn KITTI's points up by the 0.205 degrees its calibration is off");
}

void
addDrive(SettingsTable& table, SlamSettings& s)
{
  table.add("first", &s.slam.feed.first, "number of the first scan");
  table.add("count", &s.slam.feed.count, "number of scans, 0 for all");
  table.add("stride", &s.slam.feed.stride, "use every so many-th scan");
  table.add("skip_faults",
            &s.slam.feed.skip_faults,
            "leave out what is missing or damaged and go on");
  table.add("timing",
            &s.timing,
            "when points were measured: none (at once), azimuth, source, auto");
  table.add("preset", &s.preset, "odometry for lidar, rgbd, or auto: by the data set");
  table.add("realtime",
            &s.slam.feed.realtime,
            "scans come by the clock; those that come too fast are skipped");
  table.add("deterministic",
            &s.deterministic,
            "same bits for any number of threads, as always without realtime");
  table.add("queue", &s.slam.queue_capacity, "scans that may wait between two stages");
  table.add("out", &s.out, "folder for the results");
}

void
addSimulation(SettingsTable& table, SlamSettings& s)
{
  table.add("sim.scene", &s.drive.scene, "around the drive: town, tunnel, square");
  table.add("sim.circuit",
            &s.drive.circuit,
            "built-in drive: block, oval, eight, line, standstill");
  table.add("sim.size", &s.drive.size, "extent of the circuit, metres");
  table.add("sim.speed", &s.drive.speed, "on the circuit, m/s");
  table.add("sim.laps", &s.drive.laps, "of the circuit");
  table.add("sim.trajectory", &s.drive.trajectory, "drive along these poses instead");
  table.add("sim.times", &s.drive.times, "their times");
  table.add("sim.frame", &s.drive.frame, "what they are of: camera (KITTI), vehicle");
  table.add("sim.calib", &s.drive.calib, "KITTI's calib.txt for that camera");
  table.add(
      "sim.height", &s.drive.sensor_height, "of the poses above the road, metres");
  table.add("sim.sensor", &s.drive.sensor, "hdl64, hdl32, vlp16, kinect");
  table.add("sim.columns", &s.drive.columns, "of a laser's turn, 0 for its own");
  table.add("sim.yaw", &s.drive.yaw, "where a camera looks, degrees left of ahead");
  table.add("sim.right", &s.drive.right, "a camera's place beside the path, metres");
  table.add("sim.distortion",
            &s.simulation.motion_distortion,
            "the sensor moves during a scan");
  table.add("sim.exact", &s.exact, "no noise and no lost returns");
  table.add("sim.seed", &s.simulation.town.seed, "of the town");
}

void
addOdometry(SettingsTable& table, SlamSettings& s)
{
  pcl::nurbs::OdometryOptions& o = s.slam.odometry;
  table.add("odometry.min_range", &o.min_range, "nearer points are dropped, metres");
  table.add("odometry.max_range", &o.max_range, "farther points are dropped, metres");
  table.add("odometry.deskew", &o.deskew, "undo the motion within a scan");
  table.add("odometry.calibrate_beams",
            &o.calibrate_beams,
            "learn and take out what the calibration of a turning laser left");
  table.add("odometry.map_spacing", &o.map_spacing, "of points in the map, metres");
  table.add("odometry.match_spacing", &o.match_spacing, "of matched points, metres");
  table.add("odometry.voxel_size", &o.map.voxel_size, "of the local map, metres");
  table.add("odometry.voxel_points", &o.map.max_points, "kept per voxel");
  table.add(
      "odometry.first_way",
      &o.first_way,
      "a laser with few beams begins with a coarse map for so many of its voxels");
  table.add("odometry.max_iterations", &o.match.max_iterations, "of one alignment");
  table.add("odometry.min_support",
            &o.match.min_support,
            "below it a direction is unsupported, 0 .. 1");
  table.add("odometry.keyframe_distance", &o.keyframe_distance, "between keyframes, m");
  table.add("odometry.keyframe_angle", &o.keyframe_angle, "between keyframes, radians");
}

void
addLoops(SettingsTable& table, SlamSettings& s)
{
  pcl::nurbs::ProximityLoopOptions& l = s.slam.loops;
  table.add(
      "loops.close", &s.slam.close_loops, "look for places the drive comes back to");
  table.add("loops.min_way", &l.min_way, "a loop is at least so long, metres");
  table.add(
      "loops.min_reach", &l.min_reach, "candidates are so near by their poses, m");
  table.add(
      "loops.drift_share", &l.drift_share, "or nearer than this share of the way");
  table.add("loops.max_reach", &l.max_reach, "but no farther than this, metres");
  table.add("loops.voxel_size", &l.voxel_size, "of the target of alignment, metres");
  table.add("loops.min_overlap", &l.min_overlap, "share of points on the target");
  table.add("loops.max_rmse_share", &l.max_rmse_share, "residuals, in voxels");
  table.add("graph.point_spacing",
            &s.slam.graph.point_spacing,
            "of points kept of keyframes, metres");
  table.add("graph.drift_translation",
            &s.slam.graph.drift_translation,
            "of odometry, metres per metre");
  table.add("graph.drift_rotation",
            &s.slam.graph.drift_rotation,
            "of odometry, radians per metre");
}

} // namespace

SettingsTable
settingsTable(SlamSettings& settings)
{
  SettingsTable table;
  addDataset(table, settings);
  addDrive(table, settings);
  addOdometry(table, settings);
  addLoops(table, settings);
  addSimulation(table, settings);
  return table;
}

} // namespace pcl_nurbs_tools
