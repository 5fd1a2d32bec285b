#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Inputs that are damaged, degenerate or something else than their name says."""
import array
import json
import math
import random
import unittest

from tool import NAN, ToolTest, depth_rows, kitti, pcd, ply, png, wave


class NoInput(ToolTest):
    def test_missing_file_and_folder(self):
        self.fail_with(2, "missing.pcd", "o.nurbs", says=["missing.pcd", "does not exist"])
        (self.folder / "folder.pcd").mkdir()
        self.fail_with(2, "folder.pcd", "o.nurbs", says=["folder.pcd"])
        self.fail_with(2, "/dev/null", "o.nurbs", says=["/dev/null"])

    def test_other_files(self):
        for kind in ("pcd", "ply", "png", "bin", "xyz"):
            for content in ("", "hello\n", "\0" * 37, "\xff" * 4001):
                with self.subTest(kind=kind, content=content[:5]):
                    name = self.write(f"a.{kind}", content.encode("latin-1"))
                    self.fail_with(2, name, "o.nurbs", says=[name])

    def test_names_that_lie(self):
        contents = {"pcd": pcd(wave(), 80).encode(), "ply": ply(wave()),
                    "png": png(depth_rows())}
        for said in ("pcd", "ply", "png"):
            for kind, content in contents.items():
                if said != kind:
                    with self.subTest(said=said, kind=kind):
                        name = self.write(f"a.{said}", content)
                        self.fail_with(2, name, "o.nurbs", says=[name])


class Damaged(ToolTest):
    """Whatever is cut off or changed: a result or one line, never a crash."""

    def run_safely(self, name):
        result = self.run_tool(name, "o.nurbs", "--quiet")
        self.assertIn(result.returncode, (0, 2, 3), (name, result.stderr))
        if result.returncode != 0:
            self.assertRegex(result.stderr, rf"\Apcd_to_nurbs: {name}: [^\n]+\n\Z")
        return result.returncode

    def truncate(self, kind, content, must_fail):
        offsets = sorted({round(len(content) * k / 23) for k in range(23)} | {1, 7, 33, 100})
        for offset in offsets:
            with self.subTest(kind=kind, offset=offset):
                code = self.run_safely(self.write(f"a.{kind}", content[:offset]))
                if must_fail:
                    self.assertEqual(code, 2)

    def test_truncated(self):
        self.truncate("pcd", pcd(wave(40, 30), 40).encode(), True)
        self.truncate("ply", ply(wave(40, 30)), True)
        self.truncate("png", png(depth_rows(40, 30)), True)
        self.truncate("bin", kitti(wave(40, 30)), False)

    def test_wrong_bytes(self):
        generator = random.Random(4)
        for kind, content in (("pcd", pcd(wave(40, 30), 40).encode()), ("ply", ply(wave(40, 30))),
                              ("png", png(depth_rows(40, 30))), ("bin", kitti(wave(40, 30)))):
            for k in range(12):
                with self.subTest(kind=kind, k=k):
                    bad = bytearray(content)
                    for _ in range(1 + k):
                        bad[generator.randrange(len(bad))] = generator.randrange(256)
                    self.run_safely(self.write(f"a.{kind}", bytes(bad)))

    def test_wrong_counts(self):
        text = pcd(wave(40, 30), 40)
        for old, new in (("WIDTH 40", "WIDTH 41"), ("WIDTH 40", "WIDTH 4294967295"),
                         ("HEIGHT 30", "HEIGHT 99999999999999999999"), ("HEIGHT 30", "HEIGHT -30"),
                         ("POINTS 1200", "POINTS 18446744073709551615"),
                         ("COUNT 1 1 1", "COUNT 1 1 4000000000"), ("SIZE 4 4 4", "SIZE 4 4 0")):
            with self.subTest(new):
                self.fail_with(2, self.write("a.pcd", text.replace(old, new)), "o.nurbs",
                               says=["a.pcd"])
        data = ply(wave(40, 30))
        for count in (b"1201", b"0", b"-1", b"4294967296", b"99999999999999999999"):
            with self.subTest(count):
                bad = data.replace(b"vertex 1200", b"vertex " + count)
                self.fail_with(2, self.write("a.ply", bad), "o.nurbs", says=["a.ply"])


class Degenerate(ToolTest):
    def check(self, points, width=None):
        for name, content in (("a.pcd", pcd(points, width)), ("a.ply", ply(points))):
            self.fail_with(3, self.write(name, content), "o.nurbs", "o.png", "--labels", "l.pcd",
                           "--report", "r.json", says=[name])

    def test_nothing_to_fit(self):
        self.check([(NAN, NAN, NAN)] * 1200, 40)
        self.check([(1.0, 2.0, 3.0)])
        self.check([(1.0, 2.0, 3.0), (1.5, 2.0, 3.0)])
        self.check([(1.0, 2.0, 3.0)] * 1200)
        self.check([(0.0, 0.0, 0.0)] * 1200)

    def test_all_nan_is_named(self):
        self.fail_with(3, self.write("a.pcd", pcd([(NAN, NAN, NAN)] * 1200, 40)), "o.nurbs",
                       says=["a.pcd", "no point has finite coordinates"])

    def run_any(self, points, *arguments):
        name = self.write("a.ply", ply(points))
        result = self.run_tool(name, "o.nurbs", "o.json", "o.ply", "o.obj", "o.png", *arguments)
        self.assertIn(result.returncode, (0, 3), result.stderr)

    def test_lines_and_repeated_points(self):
        line = [(1.0 + 0.01 * k, 2.0, 3.0) for k in range(3000)]
        self.write("line.ply", ply(line))
        for projection in ("auto", "plane", "spherical"):
            self.fail_with(3, "line.ply", "o.nurbs", "--projection", projection)
        self.run_any([(x, y, z) for x, y, z in wave() for _ in range(3)])
        self.run_any([(0.001 * math.floor(1000 * k / 7), 0.0, 1.0) for k in range(5000)])

    def test_wild_values(self):
        generator = random.Random(2)
        points = wave()
        for k in range(0, len(points), 50):
            points[k] = tuple(generator.choice((3e38, -3e38, 1e-40, 0.0, 1e10, float("inf")))
                              for _ in range(3))
        self.run_any(points)
        self.run_any([tuple(generator.gauss(0, 1) for _ in range(3)) for _ in range(5000)])

    def test_scales(self):
        """Micrometres and thousands of kilometres are just units."""
        for scale in (1e-6, 1e-3, 1.0, 1e3, 1e6):
            with self.subTest(scale):
                self.write("a.pcd", pcd(wave(160, 120, scale=scale), 160))
                self.succeed("a.pcd", "o.nurbs", "o.png", "--report", "r.json",
                             "--mesh-tolerance", 1e-3 * scale)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertGreater(report["coverage"], 0.95)
                self.assertAlmostEqual(report["rmse_m"] / scale, 0.001, delta=0.0004)


class Large(ToolTest):
    """Ten million points: bounded memory. Takes about a minute."""

    def test_ten_million_points(self):
        generator = random.Random(5)
        width, height = 4000, 2500
        noise = [generator.gauss(0, 0.002) for _ in range(10007)]
        values = array.array("f")
        for row in range(height):
            for column in range(width):
                k = row * width + column
                values.extend((0.001 * column, 0.001 * row,
                               0.2 * math.sin(0.002 * column) + noise[k % 10007]))
        header = (f"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                  f"WIDTH {width * height}\nHEIGHT 1\nPOINTS {width * height}\nDATA binary\n")
        self.write("a.pcd", header.encode() + values.tobytes())
        self.succeed("a.pcd", "o.nurbs", "--report", "r.json", "--projection", "plane")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["valid_points"], width * height)
        self.assertLess(report["peak_rss_mb"], 4000)
        self.assertGreater(report["coverage"], 0.5)


if __name__ == "__main__":
    unittest.main()
