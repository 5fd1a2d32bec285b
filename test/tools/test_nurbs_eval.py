#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""What nurbs_eval trajectory promises: figures, plots, exit codes."""
import json
import math
import os
import struct
import unittest

from tool import ToolTest


def kitti_line(x, y, angle):
    c, s = math.cos(angle), math.sin(angle)
    return f"{c:.9f} {-s:.9f} 0 {x:.9f} {s:.9f} {c:.9f} 0 {y:.9f} 0 0 1 0\n"


def drive(poses=400, scale=1.0, turn=0.0):
    """A bent drive of about a metre a pose, scaled and turned about the origin."""
    lines = []
    for k in range(poses):
        x, y = k, 30.0 * math.sin(0.02 * k)
        c, s = math.cos(turn), math.sin(turn)
        lines.append(kitti_line(scale * (c * x - s * y), scale * (s * x + c * y), turn))
    return "".join(lines)


def tum(poses=100, late=0.0):
    return "# stamp x y z qx qy qz qw\n" + "".join(
        f"{0.1 * k + late:.6f} {k} {math.sin(k)} 0 0 0 0 1\n" for k in range(poses))


class TrajectoryTest(ToolTest):
    program = "nurbs_eval"

    def report(self, *arguments):
        self.succeed("trajectory", *arguments, "--report", "r.json", "--quiet")
        return json.loads((self.folder / "r.json").read_text())


class Figures(TrajectoryTest):
    def test_itself(self):
        self.write("a.txt", drive())
        report = self.report("a.txt", "a.txt")
        self.assertEqual(report["poses"], 400)
        self.assertLess(report["ate_rmse_m"], 1e-9)
        self.assertLess(report["kitti_t_percent"], 1e-9)

    def test_alignments(self):
        self.write("a.txt", drive())
        self.write("b.txt", drive(scale=0.5, turn=1.0))
        self.assertGreater(self.report("a.txt", "b.txt", "--align", "none")["ate_rmse_m"], 100)
        self.assertGreater(self.report("a.txt", "b.txt")["ate_rmse_m"], 10)
        report = self.report("a.txt", "b.txt", "--align", "sim3")
        self.assertLess(report["ate_rmse_m"], 1e-6)
        self.assertAlmostEqual(report["scale"], 2.0, 6)

    def test_stamps_pair_the_poses(self):
        self.write("a.txt", tum())
        self.write("b.txt", tum(late=0.004))
        self.assertEqual(self.report("a.txt", "b.txt")["poses"], 100)
        self.write("c.txt", tum() + tum().splitlines()[-1] + "\n")  # the last one twice
        self.assertEqual(self.report("c.txt", "b.txt")["poses"], 100)
        self.fail_with(2, "trajectory", "a.txt", "b.txt", "--max-difference", "0.001",
                       says=["b.txt", "no pose"])

    def test_steps(self):
        self.write("a.txt", drive())
        self.write("b.txt", drive(scale=1.01))
        for step, expected in (("1", 0.01), ("10m", 0.1), ("10", 0.1), ("5s", 0.05)):
            mean = self.report("a.txt", "b.txt", "--step", step)["rpe_m"]["mean"]
            self.assertAlmostEqual(mean / expected, 1.08, delta=0.12)

    def test_plots(self):
        self.write("a.txt", drive())
        text = self.succeed("trajectory", "a.txt", "a.txt", "--plots", "plots").stdout
        self.assertIn("KITTI, 100 to 800 m", text)
        names = sorted(path.name for path in (self.folder / "plots").iterdir())
        self.assertEqual(names, ["errors.png", "path.png", "segments.png"])
        for name in names:
            data = (self.folder / "plots" / name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", data[16:24]), (1000, 760))

    def test_evos_figures(self):
        data = os.environ.get("PCL_NURBS_DATA", os.environ["PCL_NURBS_DEFAULT_DATA"])
        files = [os.path.join(data, "evo", f"KITTI_00_{name}.txt") for name in ("gt", "ORB")]
        if not all(map(os.path.exists, files)):
            self.skipTest("data set files evo/KITTI_00_*.txt are not there")
        text = self.succeed("trajectory", *files).stdout
        for figure in ("1.303450", "0.699729 %", "0.253330 deg/100 m", "3283 segments"):
            self.assertIn(figure, text)


class Failures(TrajectoryTest):
    def test_usage(self):
        self.write("a.txt", drive(20))
        self.fail_with(1, says=["no command"])
        self.fail_with(1, "trajektory", says=["trajektory"])
        self.fail_with(1, "trajectory", "a.txt", says=["two files"])
        for option, value in (("--align", "affine"), ("--step", "0"), ("--step", "1.5"),
                              ("--step", "3km"), ("--max-difference", "-1"), ("--step", "nan")):
            self.fail_with(1, "trajectory", "a.txt", "a.txt", option, value, says=[option])

    def test_bad_files(self):
        self.write("good.txt", drive(20))
        line = kitti_line(1, 2, 3)
        for content, words in ((b"", ["empty"]), ("# nothing\n", ["no pose"]),
                               (line + "1 2 3\n", ["line 2", "3 numbers"]),
                               (line.replace("1 ", "x ", 1), ["line 1", "x"]),
                               (line + line.replace("0 ", "nan ", 1), ["line 2", "nan"]),
                               ("2 " * 12 + "\n", ["line 1", "orthonormal"]),
                               ("0 0 0 0 0 0 0 2\n", ["line 1", "quaternion"]),
                               (tum(5) + tum(5), ["line 8", "backwards"]),
                               (b"\0\1\2\3" * 50, ["line 1"])):
            self.write("bad.txt", content)
            self.fail_with(2, "trajectory", "good.txt", "bad.txt", says=["bad.txt", *words])
        self.fail_with(2, "trajectory", "good.txt", "none.txt", says=["none.txt"])
        self.write("line.txt", "".join(kitti_line(k, 0, 0) for k in range(9)))
        self.fail_with(2, "trajectory", "line.txt", "line.txt", says=["--align none"])
        self.write("times.txt", "0\n1\n")
        self.fail_with(2, "trajectory", "good.txt", "good.txt", "--estimate-times",
                       "times.txt", says=["times.txt", "2 times for 20 poses"])

    def test_outputs_that_cannot_be_written(self):
        self.write("a.txt", drive(20))
        self.fail_with(4, "trajectory", "a.txt", "a.txt", "--report", "no/r.json",
                       says=["no/r.json"])
        self.fail_with(4, "trajectory", "a.txt", "a.txt", "--plots", "a.txt/plots",
                       says=["a.txt/plots"])


if __name__ == "__main__":
    unittest.main()
