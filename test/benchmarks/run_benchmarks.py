#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Run the benchmarks and write doc/benchmarks.md.

Each row runs in a process of its own, so that its peak memory is its own too, and ours
and its peers run one right after the other. Reported are medians of the repetitions.
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Row of the benchmark program: what it is, and the time we want to stay below.
ROWS = {
    "evaluate_point/degree:3/rational:0": ("Point, bicubic", None),
    "evaluate_point/degree:3/rational:1": ("Point, rational bicubic", None),
    "evaluate_point/degree:5/rational:0": ("Point, biquintic", None),
    "evaluate_jet1/degree:3/rational:0": ("Point and first derivatives, bicubic", "60 ns"),
    "evaluate_jet1/degree:3/rational:1": ("Point and first derivatives, rational bicubic", None),
    "evaluate_jet1/degree:5/rational:0": ("Point and first derivatives, biquintic", None),
    "evaluate_jet2/degree:3/rational:0": ("Up to second derivatives, bicubic", None),
    "evaluate_jet2/degree:3/rational:1": ("Up to second derivatives, rational bicubic", None),
    "evaluate_jet2/degree:5/rational:0": ("Up to second derivatives, biquintic", None),
    "insert_16x16_knots": ("Insert 16 knots in both directions", None),
    "elevate_degree_3_to_4": ("Elevate the degree in both directions", None),
    "closest_point_build": ("Closest point: build the search", None),
    "closest_point_global": ("Closest point, up to 0.5 m away, no guess", None),
    "closest_point_warm": ("Closest point, up to 2 cm away, guess off by 1 cm", "0.4 µs"),
    "evaluate_jet1_batch": ("Point and first derivatives, bicubic, 100k at once", "60 ns"),
    "tessellate_trimmed": ("Triangles of a trimmed surface, 256 × 256", "50 ms"),
    "fit_one_pass/100000": ("Fit 100k points, 34 × 34, given parameters", "30 ms"),
    "fit_one_pass/1000000": ("Fit 1M points, 34 × 34, given parameters", "250 ms"),
    "fit_full_3d/100000": ("Fit 100k points, 34 × 34, three coordinates, parameters corrected", "150 ms"),
    "fit_adaptive/1": ("Fit 100k points, knots chosen, noise stated rightly", "100 ms"),
    "fit_adaptive/2": ("Fit 100k points, knots chosen, noise stated twice too large", "100 ms"),
    "fit_adaptive/4": ("Fit 100k points, knots chosen, noise stated four times too large", "100 ms"),
    "superpixels_8": ("1000 superpixels of a 640 × 480 cloud, 8 neighbours", "200 ms"),
    "superpixels_4": ("1000 superpixels of a 640 × 480 cloud, 4 neighbours", "100 ms"),
    "superpixels_whole_8": ("The same with raster, noise and graph, 8 neighbours", None),
    "superpixels_whole_4": ("The same with raster, noise and graph, 4 neighbours", None),
    "segment_normals": ("Normals of the same cloud", None),
    "segment_planes": ("Planes of the same cloud, normals given", None),
    "segment_regions": ("Smooth regions of the same cloud, normals given", None),
    **{f"{row}/{n}/real_time": (f"{title}, {n} thread{'s' if n > 1 else ''}", target if n == 2 else None)
       for row, title, target in (
           ("surfaces_vga", "Surfaces of the same cloud, with raster, noise and graph", "100 ms"),
           ("patches_vga", "The same with NURBS fits and trims", "200 ms"),
           ("surfaces_simulated", "Surfaces of a laser's image of a simulated street", "40 ms"),
           ("surfaces_laser", "Surfaces of an image of KITTI's laser", None),
           ("organize_laser", "The laser's image from its points", None))
       for n in (1, 2)},
    **{f"register{basin}_{name}/iterations:1": (f"{what} {title}", None)
       for basin, what in (("", "Align"), ("_basin", "Rough guesses,"))
       for name, title in (("simulated_hdl64", "64 beams in a simulated town, 1.6 m apart"),
                           ("simulated_vlp16", "16 beams in a simulated town, 1.6 m apart"),
                           ("kitti_07", "KITTI 07, 0.1 to 0.2 m apart"),
                           ("kitti_01", "KITTI 01 (every third point), 1 m apart"),
                           ("tum_desk", "TUM fr1/desk"),
                           ("seven_scenes", "7-Scenes redkitchen"),
                           ("redwood", "Redwood living room"))},
    **{f"superpixels_scaling_{k}/{n}": (f"Graph and superpixels of {n} points, {k} neighbours", None)
       for k in (8, 4) for n in (10000, 100000, 1000000, 10000000)},
}
UNITS = {"ns": 1e-9, "us": 1e-6, "µs": 1e-6, "ms": 1e-3, "s": 1.0}
NOT_QUALITY = {"calls"}


def run(command):
    """Standard output of a command and the peak memory of its process in MB."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}")
    return output.decode(), usage.ru_maxrss / 1024.0


def split_name(name):
    """'row/kernel/arguments' -> ('row/arguments', 'kernel')."""
    parts = name.split("/")
    return "/".join(parts[:1] + parts[2:]), parts[1]


def list_rows(program, pattern):
    """{row: {kernel: full name}} in the order of ROWS, then of the program."""
    names, _ = run([program, "--benchmark_list_tests=true", f"--benchmark_filter={pattern}"])
    rows = {}
    for name in names.split():
        row, kernel = split_name(name)
        rows.setdefault(row, {})[kernel] = name
    order = list(ROWS)
    return dict(sorted(rows.items(), key=lambda r: order.index(r[0]) if r[0] in order else len(order)))


def measure(program, name, repetitions):
    """Median seconds per call, quality counters and peak memory of one benchmark."""
    output, memory = run([program, f"--benchmark_filter=^{re.escape(name)}$",
                          f"--benchmark_repetitions={repetitions}",
                          "--benchmark_report_aggregates_only=true",
                          "--benchmark_format=json"])
    entries = json.loads(output)["benchmarks"]
    median = next(e for e in entries if e.get("aggregate_name") == "median")
    if median.get("error_occurred"):
        sys.exit(f"{name}: {median['error_message']}")
    known = {"real_time", "cpu_time", "threads", "repetitions", "iterations", "family_index",
             "per_family_instance_index", "repetition_index"}
    counters = {k: v for k, v in median.items() if isinstance(v, (int, float)) and k not in known}
    seconds = median["real_time"] * UNITS[median["time_unit"]] / counters.get("calls", 1.0)
    quality = {k: v for k, v in counters.items() if k not in NOT_QUALITY}
    return {"seconds": seconds, "quality": quality, "memory": memory}


def time_text(seconds):
    for unit in ("s", "ms", "µs", "ns"):
        if seconds >= UNITS[unit] or unit == "ns":
            return f"{seconds / UNITS[unit]:.3g} {unit}"
    raise ValueError(seconds)


def quality_text(result):
    return ", ".join(f"{k.replace('_', ' ')} {v:.4g}" for k, v in result["quality"].items())


def table_lines(rows):
    """Markdown rows: quality first, then time; one line per row and peer."""
    for row, results in rows.items():
        title, target = ROWS.get(row, (row, None))
        ours = results.get("ours")
        peers = {k: r for k, r in results.items() if k != "ours"} or {"": None}
        for kernel, peer in peers.items():
            both = ours and peer
            yield " | ".join([
                "| " + title,
                quality_text(ours) if ours else "",
                f"{kernel}: {quality_text(peer)}" if peer and peer["quality"] else "",
                time_text(ours["seconds"]) if ours else "",
                f"{kernel} {time_text(peer['seconds'])}" if peer else "",
                f"{peer['seconds'] / ours['seconds']:.2f}" if both else "",
                f"≤ {target}" if target else "",
                f"{ours['memory']:.0f}" if ours else "",
                f"{peer['memory']:.0f} |" if peer else "|"])


def cache_value(build, key):
    match = re.search(rf"^{key}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)
    return match.group(1) if match else ""


def machine_lines(build, repetitions):
    cpu = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    compiler, _ = run([cache_value(build, "CMAKE_CXX_COMPILER"), "--version"])
    yield f"- Machine: {cpu.group(1) if cpu else platform.processor()}, {os.cpu_count()} cores visible"
    yield f"- Load average at the start: {os.getloadavg()[0]:.1f}"
    yield f"- Compiler: {compiler.splitlines()[0]}, {cache_value(build, 'CMAKE_BUILD_TYPE')}"
    yield f"- Date: {datetime.date.today().isoformat()}; medians of {repetitions} repetitions"


HEAD = """# Benchmarks

Written by `test/benchmarks/run_benchmarks.py`; do not edit. The surface is
z = 0.25 sin 3x cos 2y on [-1, 1]² with 34 × 34 control points, samples have 2 mm noise,
seeds are fixed. Ratio: time of the peer divided by ours, above 1 is faster than the
peer. "difference" compares with our own results at the same parameters, relative;
"truth rms" is the height error against the noise-free surface. Peak memory is that of
the whole process, data included.

On pages of their own: [pose graphs](pose_graph_benchmarks.md) beside GTSAM and g2o, also
[with false loops](pose_graph_robust.md); [registration and odometry](registration.md)
beside PCL, KISS-ICP, GenZ-ICP and small_gicp; [segmentation against
labels](segmentation_quality.md) and [its scaling](segmentation_scaling.md).
"""
COLUMNS = ["Row", "Quality, ours", "Quality, peer", "Time, ours", "Time, peer", "Ratio",
           "Target", "MB, ours", "MB, peer"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--filter", default=".", help="regular expression on row names")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "doc" / "benchmarks.md")
    arguments = parser.parse_args()
    program = arguments.build / "test" / "benchmarks" / "pcl_nurbs_benchmarks"
    if cache_value(arguments.build, "CMAKE_BUILD_TYPE") != "Release":
        sys.exit(f"{arguments.build} is not a Release build")

    if os.getloadavg()[0] > 0.5:
        print(f"warning: the machine is not idle (load {os.getloadavg()[0]:.1f})", file=sys.stderr)
    head = [HEAD, *machine_lines(arguments.build, arguments.repetitions), ""]
    results = {}
    for row, kernels in list_rows(program, arguments.filter).items():
        print(row, file=sys.stderr)
        results[row] = {k: measure(program, name, arguments.repetitions)
                        for k, name in sorted(kernels.items(), key=lambda k: k[0] != "ours")}
    lines = head + ["| " + " | ".join(COLUMNS) + " |", "|" + " --- |" * len(COLUMNS),
                    *table_lines(results)]
    arguments.out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
