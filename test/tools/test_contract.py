#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""What pcd_to_nurbs promises: files, report, exit codes."""
import importlib.util
import json
import os
import struct
import unittest
import zlib

from tool import NAN, ToolTest, depth_rows, kitti, pcd, ply, png, wave


def second_reader():
    """The reader of .nurbs files that was written from the description of the format."""
    path = os.path.join(os.path.dirname(__file__), "..", "data", "read_nurbs.py")
    spec = importlib.util.spec_from_file_location("read_nurbs", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Help(ToolTest):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout
        for word in ("--report", "--threads", "--quiet", "--version", "--labels", "Exit codes"):
            self.assertIn(word, text)
        self.assertRegex(self.succeed("--version").stdout, r"\Apcd_to_nurbs \d+\.\d+\.\d+\nPCL ")
        self.assertEqual(self.names(), [])


class Inputs(ToolTest):
    def check(self, *arguments):
        self.succeed(*arguments, "out.nurbs", "--report", "r.json", "--quiet")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertGreater(report["coverage"], 0.9, arguments)
        self.assertGreaterEqual(report["patches"], 1)

    def test_pcd_organized(self):
        self.check(self.write("a.pcd", pcd(wave(), 80)))

    def test_upper_case_extension(self):
        self.check(self.write("A.PCD", pcd(wave(), 80)))

    def test_scattered_ply_and_bin(self):
        self.check(self.write("a.ply", ply(wave())), "--projection", "perspective")
        self.check(self.write("a.bin", kitti(wave())), "--projection", "perspective")

    def test_depth_png(self):
        name = self.write("a.png", png(depth_rows()))
        self.check(name, "--intrinsics", "80,80,40,30")

    def test_demo(self):
        self.succeed("--demo", "--labels", "l.pcd", "--quiet")
        self.assertEqual(self.names(), ["l.pcd"])


class Outputs(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("in.pcd", pcd(wave(), 80))

    def test_default_names(self):
        result = self.succeed("in.pcd")
        self.assertEqual(self.names(), ["in.nurbs", "in.pcd", "in.png"])
        for word in ("4800 points", "covered", "wrote in.nurbs", "wrote in.png"):
            self.assertIn(word, result.stdout)

    def test_quiet_says_nothing(self):
        self.assertEqual(self.succeed("in.pcd", "--quiet").stdout, "")

    def test_report(self):
        self.succeed("in.pcd", "o.nurbs", "--report", "r.json", "--tolerance", "0.004",
                     "--threads", "2", "--sensor", "0.001")
        report = json.loads((self.folder / "r.json").read_text())
        for key in ("points", "valid_points", "patches", "control_points", "bytes", "rmse_m",
                    "mean_m", "p95_m", "max_m", "coverage", "tolerance_m", "seconds",
                    "peak_rss_mb", "options"):
            self.assertIn(key, report)
        self.assertEqual(report["points"], 4800)
        self.assertEqual(report["valid_points"], 4800)
        self.assertEqual(report["bytes"], (self.folder / "o.nurbs").stat().st_size)
        self.assertEqual(report["tolerance_m"], 0.004)
        self.assertTrue(0.95 < report["coverage"] <= 1.0)
        self.assertTrue(0 < report["mean_m"] <= report["rmse_m"] <= report["p95_m"]
                        <= report["max_m"] <= 0.004)
        self.assertTrue(0.0005 < report["rmse_m"] < 0.0015)
        seconds = report["seconds"]
        stages = ["load", "organize", "segment", "fit", "trim", "write"]
        self.assertEqual(sorted(seconds), sorted([*stages, "total"]))
        total = sum(seconds[stage] for stage in stages)
        self.assertLessEqual(total, seconds["total"] + 1e-6)
        self.assertGreater(total, 0.8 * seconds["total"])
        self.assertTrue(5 < report["peak_rss_mb"] < 1000)
        self.assertEqual(report["options"]["threads"], 2)
        self.assertEqual(report["options"]["sensor"], "0.001")
        self.assertEqual(report["options"]["tolerance"], 0.004)

    def test_bytes_without_nurbs_file(self):
        self.succeed("in.pcd", "o.json", "--report", "r.json")
        self.assertGreater(json.loads((self.folder / "r.json").read_text())["bytes"], 20)

    def test_nurbs_and_json_hold_the_same_model(self):
        self.succeed("in.pcd", "o.nurbs", "o.json", "--lossless")
        model = json.loads((self.folder / "o.json").read_text())
        data = (self.folder / "o.nurbs").read_bytes()
        other = second_reader().read(data)
        self.assertGreaterEqual(len(model["patches"]), 1)
        self.assertEqual(len(other["patches"]), len(model["patches"]))

    def test_meshes(self):
        self.succeed("in.pcd", "o.obj", "o.ply")
        lines = [line.split() for line in (self.folder / "o.obj").read_text().splitlines()]
        vertices = [tuple(map(float, line[1:4])) for line in lines if line[:1] == ["v"]]
        faces = [line for line in lines if line[:1] == ["f"]]
        self.assertGreater(len(faces), 1)
        for face in faces:
            for corner in face[1:]:
                self.assertTrue(1 <= int(corner.split("/")[0]) <= len(vertices))
        self.assertTrue(all(1.8 < z < 2.2 for _, _, z in vertices))
        content = (self.folder / "o.ply").read_bytes()
        self.assertTrue(content.startswith(b"ply\nformat "))
        self.assertIn(b"element vertex %d\n" % len(vertices), content)
        self.assertIn(b"element face %d\n" % len(faces), content)

    def test_rational_obj(self):
        self.succeed("in.pcd", "o.obj", "--obj", "rational")
        self.assertIn("cstype rat bspline", (self.folder / "o.obj").read_text())

    def check_picture(self, name, size, what):
        """A PNG of that size that is not of one colour."""
        data = (self.folder / name).read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), size)
        self.assertTrue(data.endswith(b"IEND\xaeB`\x82"))
        start = data.index(b"IDAT")
        length, = struct.unpack(">I", data[start - 4:start])
        pixels = zlib.decompressobj().decompress(data[start + 4:start + 4 + length])
        self.assertGreater(len(set(pixels)), 8, what)

    def test_picture(self):
        for shade in ("patch", "normal", "curvature", "deviation"):
            self.succeed("in.pcd", "o.png", "--size", "200x100", "--shade", shade)
            self.check_picture("o.png", (200, 100), shade)

    def test_picture_of_points_far_from_the_optical_axis(self):
        points = [(x + 2.0 * z, y + 1.5 * z, z) for x, y, z in wave(noise=0.0)]
        self.write("side.pcd", pcd(points, width=80))
        self.succeed("side.pcd", "o.png", "--size", "200x150")
        self.check_picture("o.png", (200, 150), "beside the axis")

    def read_labels(self, name, size):
        data = (self.folder / name).read_bytes()
        end = data.index(b"DATA binary\n") + len(b"DATA binary\n")
        header = dict(line.split(" ", 1) for line in data[:end].decode().splitlines()
                      if " " in line)
        self.assertEqual(header["FIELDS"], "x y z label")
        layout = struct.Struct("<3fI" if size == 4 else "<3dI")
        self.assertEqual(header["SIZE"], " ".join([str(size)] * 3 + ["4"]))
        return header, list(layout.iter_unpack(data[end:]))

    def test_labels(self):
        points = wave()
        points[0] = points[81] = (NAN, NAN, NAN)
        self.write("hole.pcd", pcd(points, 80))
        self.succeed("hole.pcd", "--labels", "l.pcd", "--report", "r.json")
        header, records = self.read_labels("l.pcd", 4)
        self.assertEqual((header["WIDTH"], header["HEIGHT"]), ("80", "60"))
        self.assertEqual(len(records), 4800)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(max(label for *_, label in records), report["patches"])
        covered = sum(label != 0 for *_, label in records)
        self.assertAlmostEqual(covered / report["valid_points"], report["coverage"])
        self.assertEqual([records[k][3] for k in (0, 81)], [0, 0])
        self.assertNotEqual(records[0][0], records[0][0])

    def test_large_coordinates_come_back(self):
        """Map coordinates do not fit into floats: surfaces and labels must still have them."""
        far = [(x + 500000.0, y + 5400000.0, z) for x, y, z in wave()]
        body = b"".join(struct.pack("<3d", *point) for point in far)
        self.write("far.ply", (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(far)}\n"
                               "property double x\nproperty double y\nproperty double z\n"
                               "end_header\n").encode() + body)
        self.succeed("far.ply", "o.json", "--labels", "l.pcd", "--projection", "plane")
        _, records = self.read_labels("l.pcd", 8)
        rows = [record for record in records if record[3] != 0]
        self.assertGreater(len(rows), 1000)
        for x, y, z, _ in rows:
            self.assertTrue(499998 < x < 500002 and 5399998 < y < 5400002 and 1.8 < z < 2.2)

    def test_identical_for_any_number_of_threads(self):
        files = []
        for threads in (1, 2, 4):
            self.succeed("in.pcd", "o.nurbs", "o.json", "--threads", threads)
            files.append([(self.folder / f"o.{kind}").read_bytes() for kind in ("nurbs", "json")])
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_existing_output_is_replaced(self):
        self.write("o.nurbs", "old")
        self.succeed("in.pcd", "o.nurbs")
        self.assertGreater((self.folder / "o.nurbs").stat().st_size, 50)


class Usage(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("in.pcd", pcd(wave(40, 30), 40))

    def test_wrong_options(self):
        for arguments in (
                [], ["in.pcd", "--no-such-option"], ["in.pcd", "o.xyz"], ["in.pcd", "o"],
                ["in.pcd", "--threads", "-1"], ["in.pcd", "--threads", "many"],
                ["in.pcd", "--threads", "99999999999999"], ["in.pcd", "--report"],
                ["in.pcd", "--max-degree", "10"], ["in.pcd", "--max-degree", "0"],
                ["in.pcd", "--tolerance=-1"], ["in.pcd", "--tolerance=nan"],
                ["in.pcd", "--tolerance=inf"], ["in.pcd", "--hold-out", "1"],
                ["in.pcd", "--min-patch", "3"], ["in.pcd", "--min-segment", "0"],
                ["in.pcd", "--criterion", "best"], ["in.pcd", "--sensor", "0"],
                ["in.pcd", "--sensor", "1mm"], ["in.pcd", "--projection", "round"],
                ["in.pcd", "--intrinsics", "1,2,3"], ["in.pcd", "--intrinsics", "0,1,2,3"],
                ["in.pcd", "--size", "9x9"], ["in.pcd", "--size", "big"],
                ["in.pcd", "--shade", "red"], ["in.pcd", "--view", "1,2,3"],
                ["in.pcd", "--obj", "cube"], ["in.pcd", "--mesh-tolerance=-1"],
                ["in.pcd", "--bin-values", "5"], ["in.pcd", "--depth-scale", "0"],
                ["in.pcd", "--correlation", "0.5"], ["in.pcd", "--max-control-points", "3"],
                ["in.pcd", "--quiet", "--quiet"], ["--demo", "in.pcd"]):
            with self.subTest(arguments):
                self.fail_with(1, *arguments)

    def test_one_file_in_two_roles(self):
        os.symlink("in.pcd", self.folder / "link.pcd")
        for arguments in (["in.pcd", "--labels", "in.pcd"], ["in.pcd", "--labels", "./in.pcd"],
                          ["in.pcd", "--labels", "link.pcd"], ["in.pcd", "o.json", "./o.json"],
                          ["in.pcd", "r.json", "--report", "r.json"],
                          ["in.pcd", "--labels", "l.nurbs"]):
            with self.subTest(arguments):
                self.fail_with(1, *arguments)

    def test_names_that_look_like_options(self):
        self.write("-odd.pcd", pcd(wave(40, 30), 40))
        self.succeed("--quiet", "--", "-odd.pcd", "-odd.json")
        self.assertIn("-odd.json", self.names())


if __name__ == "__main__":
    unittest.main()
