#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""What nurbs_slam promises: data sets, files, report, settings, exit codes."""
import json
import struct
import subprocess
import unittest

from drives import read_kitti, scan, write_kitti
from tool import TOOLS, ToolTest, depth_rows, pcd, png

FILES = ["pose_graph.g2o", "report.json", "trajectory.png", "trajectory_kitti.txt",
         "trajectory_tum.txt", "truth_kitti.txt", "truth_tum.txt"]


class SlamTest(ToolTest):
    program = "nurbs_slam"

    def outputs(self, folder="out"):
        return sorted(path.name for path in (self.folder / folder).iterdir())

    def report(self, folder="out"):
        return json.loads((self.folder / folder / "report.json").read_text())

    def run_kitti(self, *arguments):
        self.succeed("--dataset", "kitti", "--path", ".", "--out", "out", *arguments)
        return self.report()


class Contract(SlamTest):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout
        for word in ("--report", "--threads", "--quiet", "--version", "--dataset", "--sequence",
                     "--config", "--dump-config", "--realtime", "--deterministic", "Exit codes"):
            self.assertIn(word, text)
        self.assertRegex(self.succeed("--version").stdout, r"\Anurbs_slam \d+\.\d+\.\d+\nPCL ")
        self.assertEqual(self.names(), [])

    def test_files_and_report(self):
        write_kitti(self.folder)
        report = self.run_kitti("--quiet", "--report", "copy.json")
        self.assertEqual(self.outputs(), FILES)
        self.assertEqual(json.loads((self.folder / "copy.json").read_text()), report)
        for key in ("scans", "distance_m", "keyframes", "loops", "ate_rmse_m", "skipped",
                    "scans_per_second", "peak_rss_mb", "weakly_constrained", "options"):
            self.assertIn(key, report)
        self.assertEqual((report["scans"], report["skipped"], report["lost"]), (12, 0, 0))
        self.assertAlmostEqual(report["distance_m"], 3.3, delta=0.2)
        self.assertLess(report["ate_rmse_m"], 0.05)
        self.assertEqual(sorted(report["stages"]), ["graph", "odometry", "output", "read"])
        for stage in report["stages"].values():
            self.assertTrue(0 <= stage["ms_mean"] <= stage["ms_max"])
            self.assertLessEqual(stage["ms_p95"], stage["ms_max"])

    def test_trajectories_are_of_the_data_sets_poses(self):
        """KITTI's are of the camera, which looks along z."""
        write_kitti(self.folder)
        text = self.succeed("--path", ".", "--out", "out").stdout
        self.assertIn("12 scans", text)
        poses = read_kitti(self.folder / "out" / "trajectory_kitti.txt")
        self.assertEqual(len(poses), 12)
        self.assertEqual(poses[0], (0, 0, 0))
        for k, (x, y, z) in enumerate(poses):
            self.assertTrue(abs(x) < 0.1 and abs(y) < 0.1 and abs(z - 0.3 * k) < 0.1)
        rows = [line.split() for line in
                (self.folder / "out" / "trajectory_tum.txt").read_text().splitlines()]
        self.assertEqual([len(row) for row in rows], [8] * 12)
        self.assertAlmostEqual(float(rows[3][0]), 0.3)
        self.assertAlmostEqual(float(rows[3][3]), poses[3][2], 6)

    def test_picture(self):
        write_kitti(self.folder, scans=4)
        self.run_kitti()
        data = (self.folder / "out" / "trajectory.png").read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (1000, 760))

    def test_pose_graph(self):
        write_kitti(self.folder)
        report = self.run_kitti("--odometry.keyframe-distance", 1)
        self.assertGreaterEqual(report["keyframes"], 3)
        tags = [line.split()[0] for line in
                (self.folder / "out" / "pose_graph.g2o").read_text().splitlines()]
        self.assertEqual(tags.count("VERTEX_SE3:QUAT"), report["keyframes"])
        self.assertEqual(tags.count("EDGE_SE3:QUAT"), report["keyframes"] - 1 + report["loops"])

    def test_identical_for_any_number_of_threads(self):
        write_kitti(self.folder)
        files = []
        for threads in (1, 2, 4):
            self.run_kitti("--threads", threads, "--deterministic")
            files.append([(self.folder / "out" / name).read_bytes() for name in FILES
                          if name != "report.json"])
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_part_of_a_drive(self):
        write_kitti(self.folder)
        report = self.run_kitti("--first", 2, "--count", 4, "--stride", 2)
        self.assertEqual(report["scans"], 4)
        self.assertAlmostEqual(report["distance_m"], 1.8, delta=0.15)
        self.assertEqual(len(read_kitti(self.folder / "out" / "trajectory_kitti.txt")), 4)

    def test_by_the_clock(self):
        write_kitti(self.folder, scans=30, step=0.02)
        (self.folder / "sequences/00/times.txt").write_text(
            "".join(f"{0.0001 * k:.6f}\n" for k in range(30)))
        report = self.run_kitti("--realtime")
        self.assertGreater(report["skipped"], 0)
        self.assertEqual(report["skipped"] + report["scans"], 30)
        poses = read_kitti(self.folder / "out" / "trajectory_kitti.txt")
        self.assertGreaterEqual(len(poses), report["scans"])
        self.fail_with(1, "--path", ".", "--out", "out", "--realtime", "--deterministic")


class DataSets(SlamTest):
    def test_raw_layout(self):
        write_kitti(self.folder / "odometry", scans=4)
        drive = self.folder / "day" / "drive"
        (drive / "velodyne_points").mkdir(parents=True)
        (self.folder / "odometry/sequences/00/velodyne").rename(drive / "velodyne_points/data")
        for dataset in ("kitti", "kitti_raw", "auto"):
            self.succeed("--dataset", dataset, "--path", "day/drive", "--out", "out")
            self.assertEqual(self.report()["scans"], 4)
            self.assertNotIn("ate_rmse_m", self.report())

    def test_raw_layout_with_navigation(self):
        write_kitti(self.folder / "odometry", scans=4)
        drive = self.folder / "drive"
        (drive / "velodyne_points").mkdir(parents=True)
        (self.folder / "odometry/sequences/00/velodyne").rename(drive / "velodyne_points/data")
        (drive / "calib_imu_to_velo.txt").write_text("R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n")
        (drive / "oxts/data").mkdir(parents=True)
        degrees_per_metre = 180 / (3.141592653589793 * 6378137.0 * 0.6560590289905073)
        for k in range(4):  # eastwards at latitude 49
            (drive / f"oxts/data/{k:06}.txt").write_text(
                f"49 {8.4 + 0.3 * k * degrees_per_metre:.12f} 110 0 0 0" + " 0" * 24 + "\n")
        self.succeed("--path", "drive", "--out", "out")
        self.assertLess(self.report()["ate_rmse_m"], 0.05)
        self.assertAlmostEqual(self.report()["truth_distance_m"], 0.9, places=3)

    def test_folder_of_clouds(self):
        (self.folder / "clouds").mkdir()
        for k in range(3):
            points = list(struct.iter_unpack("<4f", scan(0.3 * k, k)))
            self.write(f"clouds/{k}.pcd", pcd([point[:3] for point in points]))
        self.write("poses.txt", "".join(f"1 0 0 {0.3 * k} 0 1 0 0 0 0 1 0\n" for k in range(3)))
        self.succeed("--dataset", "files", "--path", "clouds", "--out", "out")
        self.assertLess(self.report()["ate_rmse_m"], 0.05)

    def write_depth(self, names):
        for name in names:
            (self.folder / name).parent.mkdir(exist_ok=True)
            self.write(name, png(depth_rows()))

    def test_depth_images(self):
        self.write_depth(["depth/a.png", "depth/b.png"])
        self.write("depth.txt", "1.0 depth/a.png\n1.1 depth/b.png\n")
        self.write("groundtruth.txt", "1.05 0 0 0 0 0 0 1\n1.15 0 0 0 0 0 0 1\n")
        self.succeed("--dataset", "tum", "--path", ".", "--depth-scale", 1000,
                     "--intrinsics", "80,80,40,30", "--out", "out")
        report = self.report()
        self.assertEqual(report["scans"], 2)
        self.assertEqual(len(read_kitti(self.folder / "out/truth_kitti.txt")), 1)

    def test_seven_scenes_layout(self):
        self.write_depth([f"frames/frame-{k:06}.depth.png" for k in range(3)])
        self.write("camera-intrinsics.txt", "80 0 40\n0 80 30\n0 0 1\n")
        for k in range(2):  # the third one has none
            self.write(f"frames/frame-{k:06}.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
        for path in (".", "frames"):
            extra = ["--intrinsics", "80,80,40,30"] if path == "frames" else []
            self.succeed("--path", path, "--out", "out", *extra)
            self.assertEqual(self.report()["scans"], 3)
            self.assertLess(self.report()["ate_rmse_m"], 0.005)

    def test_redwood_layout(self):
        self.write_depth(["depth/2.png", "depth/10.png"])
        self.write("trajectory.log", "".join(
            f"{k} {k} {k + 1}\n1 0 0 {k}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" for k in range(2)))
        self.write("camera_primesense.json", json.dumps(
            {"width": 80, "height": 60, "intrinsic_matrix": [80, 0, 0, 0, 80, 0, 40, 30, 1]}))
        self.succeed("--path", ".", "--out", "out")
        self.assertAlmostEqual(self.report()["truth_distance_m"], 1.0)

    def test_simulated_drive(self):
        self.succeed("--dataset", "sim", "--out", "out", "--sim.sensor", "vlp16",
                     "--sim.columns", 600, "--count", 6, "--sim.distortion")
        self.assertEqual(self.report()["scans"], 6)
        self.assertLess(self.report()["ate_rmse_m"], 0.2)
        self.assertEqual(self.report()["options"]["sim"]["sensor"], "vlp16")

    def expect_the_same_drive_from_files(self, dataset, drive, delta):
        """What simulate_scans writes and what the simulator gives make the same path and
        have the same truth."""
        written = subprocess.run(
            [TOOLS / "simulate_scans", "--out", "drive", "--scans", "3", "--quiet",
             *map(str, drive)], cwd=self.folder, check=False)
        self.assertEqual(written.returncode, 0)
        self.succeed("--dataset", dataset, "--path", "drive", "--out", "read")
        self.succeed("--dataset", "sim", "--out", "given", "--count", 3,
                     *(f"--sim.{word[2:]}" if str(word).startswith("--") else word
                       for word in drive))
        for name, most in (("trajectory_kitti.txt", delta), ("truth_kitti.txt", 2e-6)):
            read, given = (read_kitti(self.folder / folder / name)
                           for folder in ("read", "given"))
            self.assertEqual(len(read), 3)
            for place, other in zip(read, given): # the truth goes on
                for a, b in zip(place, other):
                    self.assertAlmostEqual(a, b, delta=most)

    def test_simulate_scans_writes_what_the_laser_gives(self):
        self.expect_the_same_drive_from_files(
            "kitti", ("--columns", 150, "--circuit", "eight", "--distortion"), 1e-6)

    def test_simulate_scans_writes_what_the_camera_gives(self):
        """Depths are rounded to 0.2 mm, which shifts the path by millimetres."""
        self.expect_the_same_drive_from_files(
            "tum", ("--sensor", "kinect", "--speed", 1), 1e-2)


class Settings(SlamTest):
    def test_defaults_read_back_are_the_same(self):
        for preset in (["--preset", "lidar"], ["--preset", "rgbd"], ["--dataset", "sim"]):
            defaults = self.succeed(*preset, "--dump-config").stdout
            self.write("all.yaml", defaults)
            self.assertEqual(self.succeed("--config", "all.yaml", "--dump-config").stdout,
                             defaults)

    def test_command_line_comes_first(self):
        self.write("c.yaml", "odometry:\n  max_range: 50\ncount: 3\n")
        text = self.succeed("--config", "c.yaml", "--odometry.max-range", 60,
                            "--dump-config").stdout
        self.assertIn("  max_range: 60.0 ", text)
        self.assertIn("count: 3 ", text)

    def test_a_drive_by_file(self):
        write_kitti(self.folder, scans=5)
        self.write("c.yaml", "# a drive\ndataset: kitti\npath: .\ncount: 3\nout: out\n"
                             "odometry: {keyframe_distance: 0.2}\n")
        self.succeed("--config", "c.yaml")
        self.assertEqual((self.report()["scans"], self.report()["keyframes"]), (3, 3))
        self.assertEqual(self.report()["options"]["odometry"]["keyframe_distance"], 0.2)

    def test_what_is_wrong_is_named_with_its_line(self):
        for text, line, word in (("count: 1\nodometri:\n  x: 1\n", 3, "odometri.x"),
                                 ("\n\nspeed: 3\n", 3, "speed"),
                                 ("odometry:\n  max_rang: 1\n", 2, "odometry.max_rang"),
                                 ("count: many\n", 1, "many"),
                                 ("count: -1\n", 1, "-1"),
                                 ("realtime: perhaps\n", 1, "perhaps"),
                                 ("odometry:\n  max_range: .nan\n", 2, "finite"),
                                 ("count: [1, 2]\n", 1, "count"),
                                 ("count: 1\ncount: 2\n", 2, "twice"),
                                 ("count: 1\n  first: 2\n", 2, ""),
                                 ("- count\n", 1, "no settings"),
                                 ("count: \"1\n", 1, "")):
            self.write("bad.yaml", text)
            self.fail_with(2, "--config", "bad.yaml", "--dump-config",
                           says=["bad.yaml", f"line {line}", word])
        self.fail_with(2, "--config", "none.yaml", "--dump-config", says=["none.yaml"])
        self.fail_with(2, "--config", ".", "--dump-config", says=["not a file"])
        self.write("empty.yaml", "")
        self.succeed("--config", "empty.yaml", "--dump-config")

    def test_usage(self):
        write_kitti(self.folder, scans=2)
        good = ["--path", ".", "--out", "out"]
        for arguments in ([], ["--path", "."], ["--out", "out"], [*good, "--no-such"],
                          [*good, "--dataset", "mars"], [*good, "--preset", "sonar"],
                          [*good, "--timing", "late"], [*good, "--count", "x"],
                          [*good, "--stride", "0"], [*good, "--first", "2"],
                          [*good, "--threads", "-1"], [*good, "--queue", "0"],
                          [*good, "--odometry.max-range", "1"], [*good, "--period", "0"],
                          [*good, "--odometry.map-spacing", "0"], [*good, "word"],
                          [*good, "--intrinsics", "1,2,3"], [*good, "--bin-values", "7"],
                          [*good, "--graph.point-spacing", "0"],
                          ["--dataset", "sim", "--out", "out", "--sim.circuit", "star"],
                          ["--dataset", "sim", "--out", "out", "--sim.sensor", "eye"]):
            with self.subTest(arguments):
                self.fail_with(1, *arguments)


if __name__ == "__main__":
    unittest.main()
