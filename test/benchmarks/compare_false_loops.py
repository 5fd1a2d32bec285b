#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""False loops: pose_graph_optimize --robust beside GTSAM's GNC, as a table in Markdown.

  compare_false_loops.py --tool pose_graph_optimize real FOLDER
  compare_false_loops.py --tool pose_graph_optimize added GRAPH.g2o [--truth TRUTH]

real: FOLDER has S_alpha_A.g2o.gz, S_alpha_A_GT_LC.txt (true pairs) and S_GT.g2o.gz.
added: false loops are added to the graph: random, local (at most 60 poses apart), and both
in groups of ten that agree with each other and the odometry; their measurements are those
of true loops at places where they are wrong by more than 1 m or 0.2 rad. Without --truth
the reference is the optimum of the true loops, whose own error is then 0.
"""

import argparse
import glob
import gzip
import json
import os
import random
import subprocess
import tempfile
import time

import gtsam
import numpy as np

import pose_graph_files as files


def run_tool(args, source, *options):
    """Report, and the graph with the poses found."""
    report = os.path.join(args.folder, "report.json")
    out = os.path.join(args.folder, "out.g2o")
    if os.path.exists(out):
        os.remove(out)
    subprocess.run([args.tool, source, out, "--quiet", "--report", report, "--method",
                    "multifrontal", *options], check=True)
    with open(report, encoding="utf-8") as file:
        return json.load(file), files.read_g2o(out)


def positions(poses):
    points = [np.append(p.translation(), 0.0)[:3] for _, p in sorted(poses.items())]
    return np.array(points)


def ate(poses, truth):
    """RMSE after the best rigid motion."""
    a, b = positions(poses), positions(truth)
    a, b = a - a.mean(0), b - b.mean(0)
    u, _, vt = np.linalg.svd(b.T @ a)
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    return float(np.sqrt(((b - a @ (u @ flip @ vt).T) ** 2).sum(1).mean()))


def is_loop(edge):
    return abs(edge[0] - edge[1]) > 1


def run_gnc(graph):
    """GTSAM's GNC, the odometry known to be right; poses and rejected pairs."""
    problem, values, known = gtsam.NonlinearFactorGraph(), gtsam.Values(), []
    for index, edge in enumerate(graph.edges):
        problem.add(files.factor(edge, graph.planar))
        if not is_loop(edge):
            known.append(index)
    known.append(len(graph.edges))
    problem.add(files.anchor(graph, 0))
    for name, pose in graph.poses.items():
        values.insert(name, pose)
    params = gtsam.GncLMParams(gtsam.LevenbergMarquardtParams())
    params.setKnownInliers(known)
    optimizer = gtsam.GncLMOptimizer(problem, values, params)
    optimizer.setInlierCostThresholdsAtProbability(0.99)
    begin = time.perf_counter()
    result = optimizer.optimize()
    seconds = time.perf_counter() - begin
    read = result.atPose2 if graph.planar else result.atPose3
    weights = optimizer.getWeights()
    rejected = [e[:2] for k, e in enumerate(graph.edges) if is_loop(e) and weights[k] < 0.5]
    return {name: read(name) for name in graph.poses}, rejected, seconds


def study(args, name, lines, is_true, truth):
    """lines: edges of the graph; is_true: for each of its loops' pairs."""
    whole = os.path.join(args.folder, "whole.g2o")
    clean = os.path.join(args.folder, "clean.g2o")
    pair = lambda line: tuple(int(word) for word in line.split()[1:3])
    with open(whole, "w", encoding="ascii") as file:
        file.writelines(lines)
    with open(clean, "w", encoding="ascii") as file:
        file.writelines(l for l in lines if not is_loop(pair(l)) or is_true(pair(l)))
    _, best = run_tool(args, clean, "--init", "chordal")
    truth = truth or best.poses
    reference = ate(best.poses, truth)
    loops = [pair(line) for line in lines if is_loop(pair(line))]
    for method in args.methods:
        if method == "gtsam":
            _, start = run_tool(args, whole, "--init", "none", "--local", "--iterations", "0")
            poses, rejected, seconds = run_gnc(start)
        else:
            report, result = run_tool(args, whole, "--robust", method)
            poses, seconds = result.poses, report["seconds"]["solver"]
            rejected = [(e["from"], e["to"]) for e in report["robust"]["rejected"]]
        gone = set(rejected)
        true_kept = sum(is_true(p) and p not in gone for p in loops)
        false_kept = sum(not is_true(p) and p not in gone for p in loops)
        error = ate(poses, truth)
        ratio = f"{error / reference:.3f}" if reference > 1e-6 else ""
        print(f"| {name} | {method} | {true_kept} / {sum(map(is_true, loops))} | {false_kept} / "
              f"{sum(not is_true(p) for p in loops)} | {error:.4f} | {reference:.4f} | {ratio} | "
              f"{seconds:.2f} |", flush=True)


def chained(graph):
    poses = {0: graph.edges[0][2].between(graph.edges[0][2])}
    for start, end, motion, _ in graph.edges:
        if end == start + 1:
            poses[end] = poses[start].compose(motion)
    return poses


def edges_of(path):
    opened = gzip.open(path, "rt") if path.endswith(".gz") else open(path, encoding="ascii")
    with opened as file:
        return [line.rstrip("\n") + "\n" for line in file if line.startswith("EDGE")]


def real(args):
    for path in sorted(glob.glob(os.path.join(args.source, "*_alpha_*.g2o.gz"))):
        name = os.path.basename(path).removesuffix(".g2o.gz")
        with open(path.removesuffix(".g2o.gz") + "_GT_LC.txt", encoding="ascii") as file:
            rows = [line.split() for line in file if line.strip() and line[0] != "#"]
        pairs = {tuple(map(int, row)) for row in rows}
        pairs |= {(b, a) for a, b in pairs}
        chain = os.path.join(args.folder, "chain.g2o")
        with open(chain, "w", encoding="ascii") as file:
            file.writelines(edges_of(os.path.join(args.source, name.split("_alpha")[0] +
                                                  "_GT.g2o.gz")))
        study(args, name, edges_of(path), pairs.__contains__, chained(files.read_g2o(chain)))


def false_edges(graph, lines, truth, kind, count, rng):
    """Lines of false loops, at pairs that have no edge yet."""
    loops = [k for k, edge in enumerate(graph.edges) if is_loop(edge)]
    odometry = {e[0]: e[2] for e in graph.edges if e[1] == e[0] + 1}
    taken = {edge[:2] for edge in graph.edges}
    size, result = (10 if "grouped" in kind else 1), []
    while len(result) < count:
        i = rng.randrange(len(truth) - size)
        reach = (max(0, i - 60), min(len(truth) - size, i + 60))
        j = rng.randrange(*reach) if "local" in kind else rng.randrange(len(truth) - size)
        source = rng.choice(loops)
        motion, group = graph.edges[source][2], []
        for k in range(size):
            error = motion.between(truth[i + k].between(truth[j + k]))
            turn = np.linalg.norm(gtsam.Rot3.Logmap(error.rotation()))
            if abs(i - j) < 3 or (i + k, j + k) in taken or (
                    np.linalg.norm(error.translation()) < 1 and turn < 0.2):
                break
            group.append(_line(i + k, j + k, motion, lines[source], rng))
            motion = odometry[i + k].inverse().compose(motion).compose(odometry[j + k])
        if len(group) == size:
            result += group
            taken |= {(i + k, j + k) for k in range(size)}
    return result[:count]


def _line(i, j, motion, like, rng):
    noise = [rng.gauss(0, 0.005) for _ in range(3)] + [rng.gauss(0, 0.02) for _ in range(3)]
    pose = motion.compose(gtsam.Pose3.Expmap(np.array(noise)))
    q = pose.rotation().toQuaternion()
    numbers = [*pose.translation(), q.x(), q.y(), q.z(), q.w()]
    measured = " ".join(repr(float(v)) for v in numbers)
    return f"EDGE_SE3:QUAT {i} {j} {measured} {' '.join(like.split()[10:])}\n"


def added(args):
    lines = edges_of(args.source)
    graph = files.read_g2o(args.source)
    _, optimum = run_tool(args, args.source, "--init", "chordal")
    truth = chained(files.read_g2o(args.truth)) if args.truth else None
    pairs = {edge[:2] for edge in graph.edges}
    for kind in args.kinds:
        for share in args.shares:
            for seed in args.seeds:
                count = round(share * sum(map(is_loop, graph.edges)))
                false = false_edges(graph, lines, truth or optimum.poses, kind, count,
                                    random.Random(seed))
                study(args, f"{kind} {share:.0%}, seed {seed}", lines + false,
                      pairs.__contains__, truth)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("real", "added"))
    parser.add_argument("source")
    parser.add_argument("--tool", required=True, help="path of pose_graph_optimize")
    parser.add_argument("--truth", help="g2o or TORO file whose odometry edges are exact")
    parser.add_argument("--methods", nargs="*", default=["consensus", "gnc", "switchable",
                                                         "pcm", "gtsam"])
    parser.add_argument("--kinds", nargs="*", default=["random", "local", "random grouped",
                                                       "local grouped"])
    parser.add_argument("--shares", type=float, nargs="*", default=[0.1, 0.5, 1.0])
    parser.add_argument("--seeds", type=int, nargs="*", default=[1, 2, 3])
    args = parser.parse_intermixed_args()
    print("| loops | method | true kept | false kept | ATE m | with true only | ratio | s |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as args.folder:
        {"real": real, "added": added}[args.study](args)


if __name__ == "__main__":
    main()
