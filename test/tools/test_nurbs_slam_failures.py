#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Bad drives, full disks and interrupted runs of nurbs_slam: a clear line, the right exit
code, and everything finished so far kept."""
import array
import json
import os
import resource
import signal
import subprocess
import unittest

from drives import read_kitti, scan, write_kitti
from interruption import wait_until_caught
from tool import NAN, ToolTest


SPARSE = ("--odometry.voxel-size", "1")  # for scans of few points


class SlamTest(ToolTest):
    program = "nurbs_slam"
    velodyne = "sequences/00/velodyne"

    def drive(self, scans=12, **options):
        write_kitti(self.folder, scans, **options)

    def replace(self, number, content):
        self.write(f"{self.velodyne}/{number:06}.bin", content)

    def track(self, *arguments):
        self.succeed("--path", ".", "--out", "out", *arguments)
        return json.loads((self.folder / "out/report.json").read_text())

    def refuse(self, code, *arguments, says=()):
        """Refused before anything is written."""
        return self.fail_with(code, "--path", ".", "--out", "out", *arguments, says=says)

    def fail_midway(self, code, *arguments, says=(), **options):
        """One line on stderr, nothing on stdout."""
        result = self.run_tool("--path", ".", "--out", "out", *arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertRegex(result.stderr, r"\Anurbs_slam: [^\n]+\n\Z")
        self.assertEqual(result.stdout, "")
        for word in says:
            self.assertIn(word, result.stderr)

    def poses(self):
        return read_kitti(self.folder / "out/trajectory_kitti.txt")


class Scans(SlamTest):
    def test_empty_file(self):
        self.drive()
        self.replace(5, b"")
        self.refuse(2, says=["000005.bin", "is empty"])
        report = self.track("--skip-faults")
        self.assertEqual(report["scans"], 11)
        self.assertIn("000005.bin", report["problems"][0])

    def test_scan_without_a_number(self):
        self.drive()
        self.replace(5, array.array("f", [NAN] * 4000).tobytes())
        report = self.track()
        self.assertEqual((report["scans"], report["lost"]), (12, 1))
        self.assertEqual(report["weakly_constrained"][0]["first_scan"], 5)
        self.assertAlmostEqual(self.poses()[5][2], 1.5, delta=0.1)

    def test_scan_without_points_in_range(self):
        self.drive()
        self.replace(5, array.array("f", [0.1, 0, 0, 0.5] * 500).tobytes())
        report = self.track()
        self.assertEqual((report["scans"], report["lost"]), (12, 1))
        self.assertEqual(report["weakly_constrained"][0]["first_scan"], 5)
        self.assertEqual(report["weakly_constrained"][0]["reason"], "lost")
        self.assertLess(report["ate_rmse_m"], 0.1)

    def test_scan_without_overlap(self):
        self.drive()
        far = [value + (5000.0 if k % 4 == 0 else 0.0)
               for k, value in enumerate(array.array("f", scan(0, 0)))]
        self.replace(5, array.array("f", far).tobytes())
        report = self.track("--odometry.max-range", 10000)
        self.assertEqual(report["weakly_constrained"][0]["first_scan"], 5)
        self.assertLess(report["ate_rmse_m"], 0.1)

    def test_tracking_lost_at_the_start(self):
        self.drive(scans=3)
        for k in range(3):
            self.replace(k, array.array("f", [0.1, 0, 0, 0.5] * 500).tobytes())
        self.fail_midway(3, says=["lost at the start"])
        self.assertEqual(list((self.folder / "out").iterdir()), [])

    def test_one_scan(self):
        self.drive(scans=1)
        report = self.track()
        self.assertEqual((report["scans"], report["keyframes"]), (1, 1))
        self.assertEqual(self.poses(), [(0, 0, 0)])

    def test_duplicated_scan(self):
        self.drive()
        self.replace(6, (self.folder / f"{self.velodyne}/000005.bin").read_bytes())
        self.write("sequences/00/times.txt", "".join(
            f"{0.1 * (5 if k == 6 else k):.6f}\n" for k in range(12)))
        report = self.track("--poses", "poses/00.txt")
        self.assertEqual((report["scans"], report["lost"]), (12, 0))
        a, b = self.poses()[5:7]
        self.assertLess(abs(a[2] - b[2]), 0.05)

    def test_file_that_is_not_what_its_name_says(self):
        self.drive()
        self.replace(5, b"\x89PNG\r\n\x1a\n" + bytes(1000))
        self.refuse(2, says=["000005.bin", "not what its extension says"])
        self.replace(5, b"x" * 1003)
        self.refuse(2, says=["000005.bin", "1003"])
        self.replace(5, bytes([127]) * 1600) # found when it is read
        self.fail_midway(2, says=["000005.bin", "5 scans done before"])
        self.assertEqual(len(self.poses()), 5)
        report = self.track("--skip-faults")
        self.assertEqual((report["scans"], report["unreadable"]), (11, 1))
        self.assertEqual(report["weakly_constrained"][0]["reason"], "unreadable")
        self.assertEqual(len(self.poses()), 12) # that one between its neighbours
        self.assertAlmostEqual(self.poses()[5][2], 1.5, delta=0.1)

    def test_scan_missing_in_between(self):
        self.drive()
        os.remove(self.folder / f"{self.velodyne}/000005.bin")
        self.refuse(2, says=["000006.bin", "missing"])
        self.assertEqual(self.track("--skip-faults")["scans"], 11)


class Texts(SlamTest):
    def test_time_going_backwards(self):
        self.drive(scans=4)
        self.write("sequences/00/times.txt", "0\n0.2\n0.1\n0.3\n")
        self.refuse(2, says=["000002.bin", "backwards"])
        self.assertEqual(self.track("--skip-faults")["scans"], 3)

    def test_calibration_missing(self):
        self.drive(scans=4)
        os.remove(self.folder / "sequences/00/calib.txt")
        self.refuse(2, says=["calib.txt", "does not exist"])
        self.assertNotIn("ate_rmse_m", self.track("--skip-faults"))
        os.remove(self.folder / "poses/00.txt") # without poses none is needed
        self.track()

    def test_poses_that_are_none(self):
        self.drive(scans=4)
        for text, word in (("1 0 0 nan 0 1 0 0 0 0 1 0\n" * 4, "nan"), ("1 2 3\n", "3 numbers"),
                           ("1 0 0 0 0 1 0 0 0 0 1 0\n", "1 of 4"), ("\0\1\2", "not a finite")):
            self.write("poses/00.txt", text)
            self.refuse(2, says=["poses/00.txt", word])
            self.assertEqual(self.track("--skip-faults")["scans"], 4)

    def test_no_data(self):
        for path in ("nowhere", "."):
            for dataset in ("kitti", "kitti_raw", "tum", "files", "auto"):
                self.fail_with(2, "--dataset", dataset, "--path", path, "--out", "out")


class CannotWrite(SlamTest):
    NAMES = ("trajectory_kitti.txt", "trajectory_tum.txt", "trajectory.png", "report.json",
             "pose_graph.g2o", "truth_kitti.txt", "truth_tum.txt")

    def test_full_disk(self):
        self.drive(scans=3)
        for name in self.NAMES:
            with self.subTest(name):
                (self.folder / "out").mkdir()
                os.symlink("/dev/full", self.folder / "out" / name)
                self.fail_midway(4, says=[f"out/{name}", "No space left"])
                for other in set(self.NAMES) - {name}:
                    self.assertGreater((self.folder / "out" / other).stat().st_size, 30)
                for other in self.NAMES:
                    (self.folder / "out" / other).unlink()
                (self.folder / "out").rmdir()

    def test_disk_that_becomes_full(self):
        self.drive(scans=3)
        self.track()
        before = (self.folder / "out/trajectory_kitti.txt").read_bytes()

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        self.fail_midway(4, "--count", "2", says=["out/trajectory_kitti.txt", "too large"],
                         preexec_fn=limit)
        self.assertEqual((self.folder / "out/trajectory_kitti.txt").read_bytes(), before)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()},
                         set(self.NAMES), "no temporary file")

    def test_no_folder(self):
        self.drive(scans=2)
        self.write("file", "")
        for out in ("file", "file/out", "/proc/out"):
            self.fail_with(4, "--path", ".", "--out", out, says=[out])
        self.fail_midway(4, "--report", "no/report.json", says=["no/report.json"])
        self.assertEqual(len(self.poses()), 2)


class Interrupted(SlamTest):
    def test_what_was_done_is_kept(self):
        self.drive(scans=200, step=0.02, points=1500)
        for number in (signal.SIGINT, signal.SIGTERM):
            # By the clock the drive takes 20 s, whatever the machine.
            with subprocess.Popen([self.binary, "--path", ".", "--out", "out", "--realtime", *SPARSE],
                                  cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                wait_until_caught(process.pid, number)
                while not (self.folder / "out").exists():
                    pass
                try:
                    process.wait(1.5)
                except subprocess.TimeoutExpired:
                    process.send_signal(number)
                out, error = process.communicate()
            self.assertEqual((process.returncode, out), (130, ""))
            self.assertRegex(error, r"\Anurbs_slam: interrupted; the \d+ scans done before "
                                    r"are in out\n\Z")
            report = json.loads((self.folder / "out/report.json").read_text())
            self.assertIn(f" {report['scans']} scans", error)
            self.assertTrue(1 < report["scans"] < 150)
            self.assertGreaterEqual(len(self.poses()), report["scans"])
            for path in (self.folder / "out").iterdir():
                self.assertNotIn("tmp", path.name)
                path.unlink()
            (self.folder / "out").rmdir()


class Memory(SlamTest):
    def test_does_not_grow_with_the_drive(self):
        """As many scans as the longest drive of KITTI, to and fro in the hall."""
        place = self.folder / "scans"
        place.mkdir()
        for k in range(40):
            (place / f"s{k}").write_bytes(scan(0.2 * k, k, 1500))
        for k in range(4541):
            os.link(place / f"s{min(k % 78, 78 - k % 78)}", place / f"{k:06}.bin")
        for k in range(40):
            (place / f"s{k}").unlink()
        peaks = []
        for count in (400, 4541):
            self.succeed("--path", "scans", "--out", "out", "--count", count, *SPARSE)
            report = json.loads((self.folder / "out/report.json").read_text())
            self.assertEqual(report["scans"], count)
            peaks.append(report["peak_rss_mb"])
        # Poses and thinned points of keyframes, a few kB each, are all that stays.
        self.assertLess(peaks[1] - peaks[0], 30.0)


if __name__ == "__main__":
    unittest.main()
