#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""What simulate_scans promises: layouts, report, exit codes, valid prefixes."""
import json
import resource
import signal
import struct
import subprocess
import time
import unittest

from tool import ToolTest

SMALL = ("--size", "60", "--columns", "60", "--scans", "3", "--quiet")


class Simulation(ToolTest):
    program = "simulate_scans"

    def content(self, root):
        """All files below a folder, by name."""
        return {str(path.relative_to(self.folder / root)): path.read_bytes()
                for path in (self.folder / root).rglob("*") if path.is_file()}

    def check_kitti(self, root, sequence="00"):
        """A valid drive; the number of its scans."""
        files = self.content(root)
        scans = sorted(name for name in files
                       if name.startswith(f"sequences/{sequence}/velodyne/"))
        times = files[f"sequences/{sequence}/times.txt"].decode().split()
        poses = files[f"poses/{sequence}.txt"].decode().splitlines()
        self.assertEqual(
            scans, [f"sequences/{sequence}/velodyne/{k:06}.bin" for k in range(len(times))])
        self.assertEqual(len(poses), len(times))
        for name in scans:
            self.assertGreater(len(files[name]), 16)
            self.assertEqual(len(files[name]) % 16, 0)
        self.assertTrue(all(len(line.split()) == 12 for line in poses))
        self.assertEqual([float(time) for time in times],
                         sorted(float(time) for time in times))
        return len(times)


class Help(Simulation):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout
        for word in ("--report", "--threads", "--quiet", "--version", "--scene", "--circuit",
                     "--sensor", "--overwrite", "Exit codes"):
            self.assertIn(word, text)
        self.assertRegex(self.succeed("--version").stdout,
                         r"\Asimulate_scans \d+\.\d+\.\d+\nPCL ")
        self.assertEqual(self.names(), [])


class Layout(Simulation):
    def test_kitti(self):
        self.succeed("--out", "o", *SMALL, "--labels", "--distortion", "--sequence", "07")
        files = self.content("o")
        for k in range(3):
            stem = f"sequences/07/%s/{k:06}.%s"
            points = len(files[stem % ("velodyne", "bin")]) // 16
            self.assertGreater(points, 1000)
            self.assertEqual(len(files[stem % ("labels", "label")]), 4 * points)
            times = files[stem % ("point_times", "bin")]
            self.assertEqual(len(times), 4 * points)
            values = struct.unpack(f"<{points}f", times)
            self.assertTrue(-0.05 <= min(values) < -0.04 and 0.04 < max(values) <= 0.05)
        calibration = files["sequences/07/calib.txt"].decode().splitlines()
        self.assertEqual([line.split(":")[0] for line in calibration],
                         ["P0", "P1", "P2", "P3", "Tr"])
        self.assertTrue(all(len(line.split()) == 13 for line in calibration))

    def test_every_sensor_and_scene(self):
        for sensor in ("hdl64", "hdl32", "vlp16"):
            for scene, circuit in (("town", "eight"), ("tunnel", "line"),
                                   ("square", "standstill")):
                with self.subTest(sensor=sensor, scene=scene):
                    root = f"{sensor}-{scene}"
                    self.succeed("--out", root, "--sensor", sensor, "--scene", scene,
                                 "--circuit", circuit, *SMALL)
                    self.assertEqual(self.check_kitti(root), 3)

    def test_tum(self):
        self.succeed("--out", "o", "--sensor", "kinect", "--scans", "2", "--quiet")
        files = self.content("o")
        lines = files["depth.txt"].decode().splitlines()
        self.assertTrue(lines[0].startswith("#"))
        names = [line.split()[1] for line in lines[1:]]
        self.assertEqual(sorted(names), sorted(n for n in files if n.endswith(".png")))
        self.assertEqual(len(names), 2)
        for name in names:
            self.assertEqual(files[name][:8], b"\x89PNG\r\n\x1a\n")
        poses = [line for line in files["groundtruth.txt"].decode().splitlines()
                 if not line.startswith("#")]
        self.assertEqual([float(line.split()[0]) for line in poses],
                         [float(line.split()[0]) for line in lines[1:]])

    def test_part_of_a_drive_is_that_part(self):
        self.succeed("--out", "all", "--columns", "60", "--scans", "5", "--quiet")
        self.succeed("--out", "part", "--columns", "60", "--first", "3", "--scans", "2",
                     "--quiet")
        self.assertEqual(self.check_kitti("part"), 2)
        every, part = self.content("all"), self.content("part")
        name = "sequences/00/velodyne/%06d.bin"
        self.assertEqual(part[name % 0], every[name % 3])
        self.assertEqual(part[name % 1], every[name % 4])
        self.assertEqual(part["poses/00.txt"].splitlines(),
                         every["poses/00.txt"].splitlines()[3:])

    def test_trajectory(self):
        rows = "".join(f"1 0 0 0 0 1 0 0 0 0 1 {k}\n" for k in range(4))
        self.write("poses.txt", rows)
        self.succeed("--out", "o", "--trajectory", "poses.txt", "--columns", "60", "--quiet")
        self.assertEqual(self.check_kitti("o"), 4)
        poses = [[float(x) for x in line.split()] for line in
                 self.content("o")["poses/00.txt"].decode().splitlines()]
        for pose, row in zip(poses, rows.splitlines()):
            for value, wanted in zip(pose, map(float, row.split())):
                self.assertAlmostEqual(value, wanted, delta=1e-6)


class SameBytes(Simulation):
    def test_for_any_number_of_threads(self):
        arguments = ("--columns", "200", "--scans", "2", "--quiet", "--distortion", "--labels")
        for threads in (1, 2, 5):
            self.succeed("--out", f"o{threads}", "--threads", threads, *arguments)
        self.assertEqual(self.content("o1"), self.content("o2"))
        self.assertEqual(self.content("o1"), self.content("o5"))

    def test_seed(self):
        for name, seed in (("a", 1), ("b", 1), ("c", 2)):
            self.succeed("--out", name, "--seed", seed, *SMALL)
        self.assertEqual(self.content("a"), self.content("b"))
        self.assertNotEqual(self.content("a"), self.content("c"))


class Report(Simulation):
    def test_report(self):
        text = self.succeed("--out", "o", "--columns", "60", "--scans", "4", "--circuit",
                            "line", "--report", "r.json").stdout
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["scans"], 4)
        self.assertAlmostEqual(report["distance_m"], 3 * 0.8)
        self.assertGreater(report["surfaces"], 1000)
        self.assertGreater(report["scans_per_second"], 0)
        self.assertGreater(report["seconds"]["scans"], 0)
        self.assertEqual(report["options"]["sensor"], "hdl64")
        self.assertIn("4 scans, 2.4 m", text)

    def test_quiet_says_nothing(self):
        self.assertEqual(self.succeed("--out", "o", *SMALL).stdout, "")


class Usage(Simulation):
    def test_wrong_options(self):
        self.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n")
        for arguments in (
                [], ["--out"], ["--out", ""], ["--out", "o", "--no-such-option"],
                ["--out", "o", "extra"], ["--out", "o", "--sensor", "radar"],
                ["--out", "o", "--circuit", "knot"], ["--out", "o", "--scene", "moon"],
                ["--out", "o", "--size", "5"], ["--out", "o", "--size", "nan"],
                ["--out", "o", "--speed", "0"], ["--out", "o", "--speed=-1"],
                ["--out", "o", "--columns=-1"], ["--out", "o", "--columns", "70000"],
                ["--out", "o", "--threads=-1"], ["--out", "o", "--height", "0"],
                ["--out", "o", "--height", "nan"], ["--out", "o", "--first", "100000"],
                ["--out", "o", "--first=-1"], ["--out", "o", "--scans=-1"],
                ["--out", "o", "--frame", "ship"], ["--out", "o", "--calib", "c.txt"],
                ["--out", "o", "--sequence", "../x"], ["--out", "o", "--sequence", ""],
                ["--out", "o", "--sensor", "kinect", "--yaw", "inf"], ["--out", "o", "--seed", "many"],
                ["--out", "o", "--quiet", "--quiet"]):
            with self.subTest(arguments):
                self.fail_with(1, *arguments)

    def test_wrong_input(self):
        self.write("text.txt", "no poses\n")
        self.write("nan.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n")
        self.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n")
        self.write("empty.txt", "")
        for arguments in (["--trajectory", "missing.txt"], ["--trajectory", "text.txt"],
                          ["--trajectory", "nan.txt"], ["--trajectory", "empty.txt"],
                          ["--trajectory", "poses.txt", "--calib", "text.txt"],
                          ["--trajectory", "poses.txt", "--times", "text.txt"],
                          ["--trajectory", "poses.txt", "--times", "empty.txt"]):
            with self.subTest(arguments):
                self.fail_with(2, "--out", "o", *arguments)


class ExistingFolder(Simulation):
    def test_scans_of_another_run_are_not_mixed_up(self):
        for sensor in ("hdl64", "kinect"):
            with self.subTest(sensor):
                first = ("--out", sensor, "--sensor", sensor, "--columns", "60", "--quiet")
                self.succeed(*first, "--scans", "3")
                before = self.content(sensor)
                self.fail_with(1, *first, "--scans", "2", says=["--overwrite"])
                self.assertEqual(self.content(sensor), before)
                self.succeed(*first, "--scans", "2", "--overwrite")
                self.assertLess(len(self.content(sensor)), len(before))
        self.assertEqual(self.check_kitti("hdl64"), 2)

    def test_other_sequences_and_files_stay(self):
        self.succeed("--out", "o", *SMALL)
        (self.folder / "o" / "mine.txt").write_text("mine")
        before = self.content("o")
        self.succeed("--out", "o", *SMALL, "--sequence", "01", "--overwrite")
        self.assertEqual(self.check_kitti("o", "01"), 3)
        after = self.content("o")
        for name, content in before.items():
            self.assertEqual(after[name], content)


class CannotWrite(Simulation):
    def test_no_folder(self):
        self.write("file", "text")
        for out in ("file", "file/below", "/proc/x", "n" * 300):
            with self.subTest(out):
                self.fail_with(4, "--out", out, *SMALL)
                self.assertEqual((self.folder / "file").read_text(), "text")

    def test_report(self):
        result = self.run_tool("--out", "o", *SMALL, "--report", "no/folder.json")
        self.assertEqual((result.returncode, result.stdout), (4, ""))
        self.assertIn("no/folder.json", result.stderr)

    def test_disk_full_in_the_middle(self):
        """A scan does not fit; those before it stay, with their poses."""
        self.succeed("--out", "free", "--columns", "60", "--scans", "40", "--quiet")
        name = "sequences/00/velodyne/%06d.bin"
        free = self.content("free")
        sizes = [len(free[name % k]) for k in range(40)]
        fits = max(sizes[:10])
        wanted = next(k for k, size in enumerate(sizes) if size > fits)

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (fits, fits))
        result = self.run_tool("--out", "o", "--columns", "60", "--scans", "40", "--quiet",
                               preexec_fn=limit)
        self.assertEqual(result.returncode, 4)
        self.assertRegex(result.stderr, rf"\Asimulate_scans: cannot write [^\n]*"
                                        rf"{wanted:06}.bin[^\n]*\n\Z")
        self.assertEqual(self.check_kitti("o"), wanted)
        for k in range(wanted):
            self.assertEqual(self.content("o")[name % k], free[name % k])

    def test_no_room_at_all(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (40, 40))
        result = self.run_tool("--out", "o", *SMALL, preexec_fn=limit)
        self.assertEqual(result.returncode, 4)
        self.assertEqual(self.content("o"), {})


class Interrupted(Simulation):
    def test_what_is_done_is_a_valid_drive(self):
        for number, after in ((signal.SIGINT, 0.5), (signal.SIGTERM, 1.0)):
            with self.subTest(number):
                root = f"o{number}"
                with subprocess.Popen([self.binary, "--out", root, "--size", "3000",
                                       "--report", "r.json"],
                                      cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE) as process:
                    times = self.folder / root / "sequences/00/velodyne/000000.bin"
                    while not times.exists() and process.poll() is None:
                        time.sleep(0.02)
                    time.sleep(after)
                    process.send_signal(number)
                    _, error = process.communicate()
                self.assertEqual(process.returncode, 130)
                self.assertTrue(error.endswith("simulate_scans: interrupted\n"))
                scans = self.check_kitti(root)
                self.assertGreaterEqual(scans, 1)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertEqual(report["scans"], scans)
                self.assertFalse([name for name in self.content(root) if ".tmp" in name])


if __name__ == "__main__":
    unittest.main()
