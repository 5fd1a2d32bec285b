# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Runs the commands in a folder of their own and makes clouds for them."""
import math
import os
import pathlib
import random
import struct
import subprocess
import tempfile
import unittest
import zlib

TOOLS = pathlib.Path(os.environ["PCL_NURBS_TOOLS"]).resolve()
NAN = float("nan")


def pcd(points, width=None, fields="x y z"):
    """ASCII PCD; organized when a width is given."""
    width, height = (width, len(points) // width) if width else (len(points), 1)
    count = len(fields.split())
    header = (f"VERSION 0.7\nFIELDS {fields}\nSIZE {'4 ' * count}\nTYPE {'F ' * count}\n"
              f"COUNT {'1 ' * count}\nWIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {len(points)}\nDATA ascii\n")
    return header + "".join("%.9g %.9g %.9g\n" % point for point in points)


def ply(points):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
              "property float x\nproperty float y\nproperty float z\nend_header\n")
    return header.encode() + b"".join(struct.pack("<3f", *point) for point in points)


def kitti(points):
    return b"".join(struct.pack("<4f", *point, 0.5) for point in points)


def png(rows):
    """16-bit grey PNG."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    size = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) +
            chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def wave(width=80, height=60, noise=0.001, scale=1.0, seed=1):
    """A wavy sheet as a depth camera sees it, row by row."""
    generator = random.Random(seed)
    points = []
    for row in range(height):
        for column in range(width):
            u, v = (column - width / 2) / width, (row - height / 2) / width
            z = 2.0 + 0.1 * math.sin(5 * u) * math.cos(4 * v) + generator.gauss(0, noise)
            points.append((scale * z * u, scale * z * v, scale * z))
    return points


def depth_rows(width=80, height=60):
    points = wave(width, height)
    return [[round(1000 * points[r * width + c][2]) for c in range(width)]
            for r in range(height)]


class ToolTest(unittest.TestCase):
    """A test in a temporary folder, which is also the working folder of the tool."""

    program = "pcd_to_nurbs"

    @property
    def binary(self):
        return TOOLS / self.program

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def run_tool(self, *arguments, **options):
        return subprocess.run([self.binary, *map(str, arguments)], cwd=self.folder, text=True,
                              errors="replace", capture_output=True, check=False, **options)

    def succeed(self, *arguments, **options):
        result = self.run_tool(*arguments, **options)
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result

    def fail_with(self, code, *arguments, says=(), **options):
        """One line on stderr, nothing on stdout, no file more than before."""
        before = self.names()
        result = self.run_tool(*arguments, **options)
        self.assertEqual(result.returncode, code, (arguments, result.stderr))
        self.assertRegex(result.stderr, rf"\A{self.program}: [^\n]+\n\Z", arguments)
        self.assertEqual(result.stdout, "", arguments)
        self.assertEqual(self.names(), before, arguments)
        for word in says:
            self.assertIn(str(word), result.stderr)
        return result
