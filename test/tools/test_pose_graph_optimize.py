#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""What pose_graph_optimize promises: costs, files, messages, exit codes."""
import gzip
import json
import math
import struct
import unittest

from tool import ToolTest


def ring(nodes=20, angle_error=0.02):
    """A planar ring whose odometry turns a little too far; one loop edge closes it."""
    turn = 2 * math.pi / nodes
    lines, x, y, heading = [], 0.0, 0.0, 0.0
    for k in range(nodes):
        lines.append(f"VERTEX_SE2 {k} {x!r} {y!r} {heading!r}")
        x += math.cos(heading)
        y += math.sin(heading)
        heading += turn + angle_error
    for k in range(nodes):
        error = angle_error if k + 1 < nodes else 0.0
        lines.append(f"EDGE_SE2 {k} {(k + 1) % nodes} 1 0 {turn + error!r} 100 0 0 100 0 1000")
    return "\n".join(lines) + "\n"


def drive_with_loops(rounds=2, nodes=22):
    """A ring driven twice, with an edge from each pose to the one a round later."""
    turn, information = 2 * math.pi / nodes, "400 0 0 400 0 4000"
    lines = []
    for k in range(rounds * nodes - 1):
        drift = 0.002 * (-1) ** k
        lines.append(f"EDGE_SE2 {k} {k + 1} {1 + drift!r} 0 {turn + drift!r} {information}")
    for k in range(nodes):
        error = 0.003 * (-1) ** (k // 2)
        lines.append(f"EDGE_SE2 {k} {k + nodes} {error!r} 0 {error!r} {information}")
    return "\n".join(lines) + "\n"


def space(nodes=8):
    """A spatial path with an edge from each node to the next two."""
    lines = [f"VERTEX_SE3:QUAT {k} {k * 1.1} {0.1 * k} 0 0 0 0 1" for k in range(nodes)]
    information = "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4"
    for k in range(nodes):
        for step in (1, 2):
            if k + step < nodes:
                lines.append(f"EDGE_SE3:QUAT {k} {k + step} {step} 0 0 0 0 0 1 {information}")
    return "\n".join(lines) + "\n"


class GraphTest(ToolTest):
    program = "pose_graph_optimize"

    def report(self, *arguments):
        self.succeed(*arguments, "--report", "r.json", "--quiet")
        return json.loads((self.folder / "r.json").read_text())


class Results(GraphTest):
    def test_costs_fall_and_are_reported(self):
        self.write("ring.g2o", ring())
        report = self.report("ring.g2o", "out.g2o", "--cost", "sesync")
        self.assertEqual((report["nodes"], report["edges"], report["components"]), (20, 20, 1))
        for form in ("g2o", "sesync"):
            self.assertLess(report["final_cost"][form], 0.1 * report["initial_cost"][form])
        self.assertTrue(report["converged"])
        self.assertTrue(report["certificate"]["certified"])
        again = self.report("out.g2o", "--cost", "sesync")
        self.assertAlmostEqual(again["initial_cost"]["sesync"], report["final_cost"]["sesync"])
        rows = (self.folder / "out.g2o").read_text().splitlines()
        self.assertEqual(rows[20:], ring().splitlines()[20:])
        self.assertEqual([row.split()[:2] for row in rows[:20]],
                         [["VERTEX_SE2", str(k)] for k in range(20)])

    def test_starts_methods_and_increments_agree(self):
        for name, text in (("ring.g2o", ring()), ("space.g2o", space())):
            self.write(name, text)
            costs = [self.report(name, *options)["final_cost"]["g2o"] for options in (
                [], ["--init", "chordal"], ["--init", "none"], ["--init", "random"],
                ["--method", "multifrontal"], ["--local"], ["--incremental"])]
            for cost in costs:
                self.assertAlmostEqual(cost, costs[0], delta=1e-7 * costs[0] + 1e-12)

    def test_incremental_figures(self):
        self.write("ring.g2o", ring())
        figures = self.report("ring.g2o", "--incremental")["incremental"]
        self.assertEqual(figures["updates"], 20)
        self.assertLessEqual(figures["ms_mean"], figures["ms_max"])

    def test_false_loops_are_left_out(self):
        rows = drive_with_loops().splitlines()
        false = ["EDGE_SE2 5 22 0.5 -2 1 400 0 0 400 0 4000",
                 "EDGE_SE2 11 33 4 1 -2 400 0 0 400 0 4000"]
        self.write("true.g2o", "\n".join(rows) + "\n")
        self.write("all.g2o", "\n".join(rows + false) + "\n")
        right = self.report("true.g2o", "--method", "multifrontal")
        for method in ("consensus", "gnc", "switchable", "pcm"):
            report = self.report("all.g2o", "out.g2o", "--robust", method)
            loops = report["robust"]
            self.assertEqual(loops["loops"], 24)
            self.assertEqual(loops["accepted"] + len(loops["rejected"]), 24)
            rejected = {(edge["from"], edge["to"]) for edge in loops["rejected"]}
            self.assertEqual(rejected, {(5, 22), (11, 33)}, method)
            for edge in loops["rejected"]:
                self.assertGreater(abs(edge["distance"] - edge["limit"]), 0)
                self.assertIn(edge["check"],
                              ("odometry_cycle", "pairs", "weight", "joint_distance"))
            cost = report["final_cost"]["g2o"]
            self.assertAlmostEqual(cost, right["final_cost"]["g2o"], delta=1e-6 * (1 + cost))
            edges = [row for row in (self.folder / "out.g2o").read_text().splitlines()
                     if row.startswith("EDGE")]
            self.assertEqual(edges, [row for row in rows if row.startswith("EDGE")])
            (self.folder / "out.g2o").unlink()
            text = self.succeed("all.g2o", "--robust", method).stdout
            self.assertIn("2 of 24 loops rejected", text)

    def test_other_outputs(self):
        self.write("ring.g2o", ring())
        text = self.succeed("ring.g2o", "out.g2o.gz", "--kitti", "k.txt", "--tum", "t.txt",
                            "--plots", "plots").stdout
        self.assertIn("20 poses, 20 edges, 1 part\n", text)
        unpacked = gzip.decompress((self.folder / "out.g2o.gz").read_bytes()).decode()
        self.assertEqual(unpacked.count("VERTEX_SE2"), 20)
        self.assertEqual(len((self.folder / "k.txt").read_text().splitlines()), 20)
        self.assertTrue((self.folder / "t.txt").read_text().startswith("0.000000000 0.0"))
        for name in ("before.png", "after.png"):
            data = (self.folder / "plots" / name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", data[16:24]), (1000, 760))
        self.report("out.g2o.gz")

    def test_fixed_nodes_and_unmoved_rows_stay(self):
        text = ring() + "FIX 3\n# a remark\n"
        self.write("ring.g2o", text)
        self.report("ring.g2o", "out.g2o")
        rows = (self.folder / "out.g2o").read_text().splitlines()
        self.assertEqual(rows[3], text.splitlines()[3])
        self.assertEqual(rows[-2:], ["FIX 3", "# a remark"])
        self.report("ring.g2o", "same.g2o", "--local", "--iterations", "0")
        self.assertEqual((self.folder / "same.g2o").read_text(), text)

    def test_what_can_be_solved_is_solved(self):
        rows = ring().splitlines()
        rows += ["VERTEX_SE2 100 0 0 0", "EDGE_SE2 100 101 1 0 0 1 0 0 1 0 1",
                 "EDGE_SE2 5 6 1 0 0 1 0 0 -1 0 1", "LANDMARK 1 2 3"]
        self.write("odd.g2o", "\n".join(rows) + "\n")
        result = self.run_tool("odd.g2o", "out.g2o", "--report", "r.json")
        self.assertEqual(result.returncode, 0)
        for words in ("odd.g2o: line 42: there is no vertex 101", "line 43: the edge is not used",
                      "line 44: tag \"LANDMARK\" is unknown"):
            self.assertIn(words, result.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((report["components"], report["ignored_rows"]), (2, 2))
        self.assertEqual(len(report["messages"]), 3)
        written = (self.folder / "out.g2o").read_text()
        for row in rows[40:]:
            self.assertIn(row + "\n", written)
        self.assertIn("VERTEX_SE2 101 1 0 0\n", written)
        self.fail_with(2, "odd.g2o", "none.g2o", "--strict", says=["line 43"])

    def test_one_node(self):
        self.write("one.g2o", "VERTEX_SE2 7 1 2 3\n")
        self.report("one.g2o", "out.g2o")
        self.assertEqual((self.folder / "out.g2o").read_text(), "VERTEX_SE2 7 1 2 3\n")
        self.report("one.g2o", "--incremental")


class Failures(GraphTest):
    def test_usage(self):
        self.write("ring.g2o", ring())
        self.fail_with(1, says=["IN.g2o"])
        self.fail_with(1, "ring.g2o", "b", "c", says=["IN.g2o"])
        for option, value in (("--init", "best"), ("--cost", "chi"), ("--method", "gtsam"),
                              ("--iterations", "-1"), ("--tolerance", "0"), ("--tolerance", "nan"),
                              ("--threads", "-1"), ("--seed", "x"), ("--robust", "maybe")):
            self.fail_with(1, "ring.g2o", option, value)

    def test_bad_files(self):
        good = ring()
        for content, words in ((b"", ["empty"]), ("# nothing\n", ["no vertex"]),
                               (good + "VERTEX_SE2 3 0 0 0\n", ["line 41", "line 4"]),
                               (good.replace("100 0 0 100", "100 0 nan 100", 1), ["line 21", "nan"]),
                               (good[:-8], ["line 40"]), (b"\0\1\2\3" * 50, ["no vertex"]),
                               (b"\x1f\x8b\x08 nothing", ["gzip"])):
            self.write("bad.g2o", content)
            self.fail_with(2, "bad.g2o", "out.g2o", says=["bad.g2o", *words])
        self.fail_with(2, "missing.g2o", says=["missing.g2o"])

    def test_outputs_that_cannot_be_written(self):
        self.write("ring.g2o", ring())
        self.fail_with(4, "ring.g2o", "no/out.g2o", says=["no/out.g2o"])
        for option in ("--kitti", "--tum", "--report"):
            self.fail_with(4, "ring.g2o", option, "no/file", says=["no/file"])
        self.fail_with(4, "ring.g2o", "--plots", "ring.g2o/plots", says=["ring.g2o/plots"])


if __name__ == "__main__":
    unittest.main()
