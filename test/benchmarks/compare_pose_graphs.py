#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""pose_graph_optimize beside GTSAM and g2o (PyPI: gtsam, g2o-python), tables in Markdown.

All start from the same poses, written by pose_graph_optimize; costs of all results are
computed by it, too. Times are those of the solvers alone: GTSAM's optimize() and update(),
ours as reported. Run it on an idle machine.

  compare_pose_graphs.py batch|incremental|scaling --tool pose_graph_optimize FILE.g2o...

batch: from the starts of --init, each to a relative change of 1e-10. incremental: vertex by
vertex. scaling: drives through a grid of streets of --poses poses; --plot PICTURE.png.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

import g2o
import gtsam

import pose_graph_files as files


def ours(args, source, *options, out=None):
    report = os.path.join(args.folder, "report.json")
    command = [args.tool, source] + ([out] if out else [])
    subprocess.run(command + ["--quiet", "--report", report, *options], check=True)
    with open(report, encoding="utf-8") as file:
        return json.load(file)


def start_of(args, source, init):
    """A file with the poses to start from."""
    path = os.path.join(args.folder, "start.g2o")
    if os.path.exists(path):
        os.remove(path)
    ours(args, source, "--init", init, "--local", "--iterations", "0", out=path)
    return path


def gtsam_problem(graph):
    problem = gtsam.NonlinearFactorGraph()
    values = gtsam.Values()
    for edge in graph.edges:
        problem.add(files.factor(edge, graph.planar))
    problem.add(files.anchor(graph, min(graph.poses)))
    for name, pose in graph.poses.items():
        values.insert(name, pose)
    return problem, values


def poses_of(graph, values):
    read = values.atPose2 if graph.planar else values.atPose3
    return {name: read(name) for name in graph.poses}


def cost_of(args, source, poses):
    path = os.path.join(args.folder, "peer.g2o")
    files.write_poses(source, path, poses)
    return ours(args, path, "--local", "--iterations", "0")["initial_cost"]


def run_gtsam(args, start, graph, method):
    problem, values = gtsam_problem(graph)
    if method == "GN":
        params, kind = gtsam.GaussNewtonParams(), gtsam.GaussNewtonOptimizer
    else:
        params, kind = gtsam.LevenbergMarquardtParams(), gtsam.LevenbergMarquardtOptimizer
    params.setMaxIterations(200)
    params.setRelativeErrorTol(1e-10)
    params.setAbsoluteErrorTol(1e-10)
    times = []
    for _ in range(args.runs):
        optimizer = kind(problem, values, params)
        begin = time.perf_counter()
        try:
            result = optimizer.optimize()
        except RuntimeError:  # GTSAM's Gauss-Newton may meet a singular matrix
            return None
        times.append(time.perf_counter() - begin)
    return statistics.median(times), cost_of(args, start, poses_of(graph, result))


def run_g2o(args, start, graph, method):
    """Its optimize(), Eigen's sparse Cholesky, which is the one that its wheel has."""
    block, linear = ((g2o.BlockSolverSE2, g2o.LinearSolverEigenSE2) if graph.planar else
                     (g2o.BlockSolverSE3, g2o.LinearSolverEigenSE3))
    kind = g2o.OptimizationAlgorithmGaussNewton if method == "GN" else \
        g2o.OptimizationAlgorithmLevenberg
    times = []
    for _ in range(args.runs):
        optimizer = files.g2o_problem(graph, kind(block(linear())))
        optimizer.initialize_optimization()
        enough = g2o.SparseOptimizerTerminateAction()
        enough.set_gain_threshold(1e-10)
        optimizer.add_post_iteration_action(enough)
        begin = time.perf_counter()
        optimizer.optimize(200)
        times.append(time.perf_counter() - begin)
    return statistics.median(times), cost_of(args, start,
                                             files.poses_of_g2o(graph, optimizer))


def run_ours(args, start, method):
    reports = [ours(args, start, "--local", "--method", method) for _ in range(args.runs)]
    seconds = statistics.median(report["seconds"]["solver"] for report in reports)
    return seconds, reports[-1]["final_cost"]


def row(name, init, kind, result, reference):
    if result is None:
        return f"| {name} | {init} | {kind} | failed | | | |"
    seconds, cost = result
    return (f"| {name} | {init} | {kind} | {1e3 * seconds:.1f} | {seconds / reference:.2f} | "
            f"{cost['g2o']:.6g} | {cost['sesync']:.6g} |")


def batch(args):
    print("| graph | start | solver | ms | ratio to ours | g2o cost | SE-Sync cost |\n"
          "| --- | --- | --- | --- | --- | --- | --- |")
    for source in args.files:
        name = os.path.basename(source).removesuffix(".g2o")
        for init in args.init:
            start = start_of(args, source, init)
            graph = files.read_g2o(start)
            best = run_ours(args, start, "multifrontal")
            print(row(name, init, "ours, multifrontal", best, best[0]), flush=True)
            print(row(name, init, "ours, Ceres", run_ours(args, start, "ceres"), best[0]))
            for method in ("GN", "LM"):
                for peer, run in (("GTSAM", run_gtsam), ("g2o", run_g2o)):
                    print(row(name, init, f"{peer} {method}", run(args, start, graph, method),
                              best[0]), flush=True)


def isam_params(sensible):
    params = gtsam.ISAM2Params()
    if sensible:
        params.relinearizeSkip = 1
        params.setRelinearizeThreshold(0.01)
    return params


def run_isam(graph, sensible):
    """Vertex by vertex, each from the estimate of the one before."""
    by_last = {}
    for edge in graph.edges:
        by_last.setdefault(max(edge[0], edge[1]), []).append(edge)
    isam = gtsam.ISAM2(isam_params(sensible))
    times, previous = [], None
    for name in sorted(graph.poses):
        new, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        pose = graph.poses[name]
        for edge in by_last.get(name, []):
            new.add(files.factor(edge, graph.planar))
            if edge[0] == previous and edge[1] == name:
                read = isam.calculateEstimatePose2 if graph.planar else isam.calculateEstimatePose3
                pose = read(previous).compose(edge[2])
        if previous is None:
            new.add(files.anchor(graph, name))
        values.insert(name, pose)
        begin = time.perf_counter()
        isam.update(new, values)
        times.append(time.perf_counter() - begin)
        previous = name
    return times, isam.calculateEstimate()


def incremental(args):
    print("| graph | solver | ms mean | p99 | max | g2o cost at the end |\n"
          "| --- | --- | --- | --- | --- | --- |")
    for source in args.files:
        name = os.path.basename(source).removesuffix(".g2o")
        start = start_of(args, source, "none")
        graph = files.read_g2o(start)
        own = ours(args, start, "--incremental")["incremental"]
        print(f"| {name} | ours | {own['ms_mean']:.3f} | {own['ms_p99']:.2f} | "
              f"{own['ms_max']:.1f} | {own['cost_before_all']:.6g} |", flush=True)
        for sensible in (False, True):
            times, values = run_isam(graph, sensible)
            times.sort()
            cost = cost_of(args, start, poses_of(graph, values))["g2o"]
            kind = "iSAM2, each update, 0.01" if sensible else "iSAM2, defaults"
            print(f"| {name} | {kind} | {1e3 * sum(times) / len(times):.3f} | "
                  f"{1e3 * times[(len(times) - 1) * 99 // 100]:.2f} | {1e3 * times[-1]:.1f} | "
                  f"{cost:.6g} |", flush=True)


def scaling(args):
    print("| poses | edges | ours ms | GTSAM LM ms | ratio | g2o LM ms | ratio | g2o cost ours | "
          "GTSAM | g2o |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    lines = {"ours": [], "GTSAM LM": [], "g2o LM": []}
    for poses in args.poses:
        source = os.path.join(args.folder, "grid.g2o")
        files.write_street_grid(source, poses)
        start = start_of(args, source, "chordal")
        graph = files.read_g2o(start)
        results = [run_ours(args, start, "multifrontal"), run_gtsam(args, start, graph, "LM")]
        if poses <= args.most_g2o:
            results.append(run_g2o(args, start, graph, "LM"))
        for line, (seconds, _) in zip(lines.values(), results):
            line.append(seconds)
        best = results[0][0]
        times = [f"{1e3 * best:.1f}"]
        for seconds, _ in results[1:]:
            times += [f"{1e3 * seconds:.1f}", f"{seconds / best:.2f}"]
        costs = [f"{cost['g2o']:.6g}" for _, cost in results]
        if poses > args.most_g2o:
            times += ["", ""]
            costs.append("")
        print("| " + " | ".join([str(poses), str(len(graph.edges))] + times + costs) + " |",
              flush=True)
    if args.plot:
        draw(args, lines)


def draw(args, lines):
    """Seconds over poses, both logarithmic."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 4.5), dpi=100)
    for name, seconds in lines.items():
        axes.loglog(args.poses[:len(seconds)], seconds, "o-", label=name)
    axes.loglog(args.poses, [lines["ours"][0] * n / args.poses[0] for n in args.poses], ":",
                color="gray", label="in proportion to the poses")
    axes.set_xlabel("poses")
    axes.set_ylabel("seconds to the minimum")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(args.plot)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("batch", "incremental", "scaling"))
    parser.add_argument("files", nargs="*")
    parser.add_argument("--tool", required=True, help="path of pose_graph_optimize")
    parser.add_argument("--runs", type=int, default=3, help="of which the median is taken")
    parser.add_argument("--init", nargs="*", default=["file", "chordal"])
    parser.add_argument("--poses", type=int, nargs="*", default=[1000, 3000, 10000, 30000, 100000])
    parser.add_argument("--most-g2o", type=int, default=10000,
                        help="poses up to which g2o takes part in the scaling")
    parser.add_argument("--plot", help="where to draw the scaling")
    args = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as args.folder:
        {"batch": batch, "incremental": incremental, "scaling": scaling}[args.study](args)


if __name__ == "__main__":
    main()
