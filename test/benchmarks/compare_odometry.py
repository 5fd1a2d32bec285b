#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Our odometry and its peers on the same scans: accuracy, time per scan and memory.

  compare_odometry.py RUN_ODOMETRY [--data FOLDER] [--drives FOLDER] [--threads 2]
                      [--only NAME ...] [--peers kiss_icp genz_icp small_gicp]
                      [--scans N] [--report FILE.md] [--results FILE.json]
                      [--keep FOLDER]

RUN_ODOMETRY is the program of that name that the benchmarks' build makes, --data the
folder of public data sets (PCL_NURBS_DATA), --drives one that simulate_scans wrote. The
peers come from PyPI (kiss-icp, genz-icp, small-gicp), as do evo, numpy, scipy and
pillow: install them in a virtual environment and call this script with its Python. Each
method runs in a process of its own, bound to as many processors as it has threads;
reading the files is not timed. Results of several calls are gathered in --results, and
--report is about all that are there: a table per quantity.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

import odometry_sequences as sequences
from odometry_peers import PEERS, REFERENCE_TIME

HERE = os.path.dirname(os.path.abspath(__file__))
TITLES = {"ate_m": "ATE m", "relative_percent": "rel. transl. %",
          "relative_deg": "rel. rot. deg/100 m", "rpe_m": "per scan m",
          "cpu_ms": "CPU ms/scan", "wall_ms": "wall ms/scan", "peak_mb": "peak MB",
          "growth_mb": "growth MB", "lost": "lost"}
REPORTED = ("ate_m", "relative_percent", "cpu_ms", "peak_mb")


def run(command, threads):
    processors = ",".join(str(i) for i in range(threads))
    done = subprocess.run(["taskset", "-c", processors, *command],
                          stdout=subprocess.PIPE, check=False)
    if done.returncode:
        return None
    return json.loads(done.stdout.decode().splitlines()[-1])


def rotation_angles(motions):
    traces = np.trace(motions[:, :3, :3], axis1=1, axis2=2)
    return np.degrees(np.arccos(np.clip((traces - 1.0) / 2.0, -1.0, 1.0)))


def motion_errors(truth, estimate, first, last):
    """What is left between true and estimated motions from poses to others."""
    inverse = np.linalg.inv
    real = inverse(truth[first]) @ truth[last]
    ours = inverse(estimate[first]) @ estimate[last]
    return inverse(real) @ ours


def segments(truth):
    """KITTI's: 100 .. 800 m from every tenth pose; of a shorter drive, eighths of its
    way from every pose. (first, last, nominal length)"""
    way = np.concatenate(
        [[0.0], np.cumsum(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1))])
    long = way[-1] > 150.0
    unit = 100.0 if long else way[-1] / 8.0
    found = []
    for first in range(0, len(truth), 10 if long else 1):
        for k in range(1, 9):
            last = int(np.searchsorted(way, way[first] + k * unit, side="right"))
            if last < len(truth):
                found.append((first, last, k * unit))
    return found


def ate(truth, estimate):
    """Root mean square of positions after a rigid alignment, by evo."""
    from evo.core import metrics
    from evo.core.trajectory import PosePath3D

    reference = PosePath3D(poses_se3=list(truth))
    aligned = PosePath3D(poses_se3=list(estimate))
    aligned.align(reference)
    ape = metrics.APE(metrics.PoseRelation.translation_part)
    ape.process_data((reference, aligned))
    return ape.get_statistic(metrics.StatisticsType.rmse)


def errors(truth, estimate):
    found = segments(truth)
    first, last, length = (np.array(column) for column in zip(*found))
    left = motion_errors(truth, estimate, first, last)
    step = np.arange(len(truth) - 1)
    single = motion_errors(truth, estimate, step, step + 1)
    return {
        "ate_m": ate(truth, estimate),
        "relative_percent": 100.0 * np.mean(
            np.linalg.norm(left[:, :3, 3], axis=1) / length),
        "relative_deg": 100.0 * np.mean(rotation_angles(left) / length),
        "rpe_m": np.sqrt(np.mean(np.sum(single[:, :3, 3] ** 2, axis=1)))}


def truth_at(folder, moment, count):
    """True poses at a moment of each scan (0 .. 1); the middle is the stamp."""
    from scipy.spatial.transform import Rotation, Slerp

    poses = sequences.read_kitti_poses(f"{folder}/poses.txt")
    offset = moment - 0.5
    if offset == 0.0:
        return poses[:count]
    # Between two poses, and beyond the last one as between the last two.
    if len(poses) == count:
        ahead = poses[-1] @ np.linalg.inv(poses[-2]) @ poses[-1]
        poses = np.concatenate([poses, ahead[None]])
    at = np.arange(count) + offset
    moved = np.tile(np.eye(4), (count, 1, 1))
    turns = Slerp(np.arange(len(poses)), Rotation.from_matrix(poses[:, :3, :3]))
    moved[:, :3, :3] = turns(at).as_matrix()
    whole = np.floor(at).astype(int)
    rest = (at - whole)[:, None]
    moved[:, :3, 3] = (1.0 - rest) * poses[whole, :3, 3] + rest * poses[whole + 1, :3, 3]
    return moved


def run_method(name, sequence, folder, out, args):
    if name == "ours":
        command = [args.program, folder, out]
    else:
        command = [sys.executable, os.path.join(HERE, "odometry_peers.py"), name, folder,
                   out]
    row = run([*command, "--kind", sequence.kind, "--threads", str(args.threads)],
              args.threads)
    if row is None:
        return None
    row["growth_mb"] = row["end_mb"] - row["quarter_mb"]
    if os.path.exists(f"{folder}/poses.txt"):
        estimate = sequences.read_kitti_poses(out)
        moment = REFERENCE_TIME.get(name, 0.5) if sequence.deskew else 0.5
        row.update(errors(truth_at(folder, moment, len(estimate)), estimate))
    return row


def table(name, result):
    rows = result["rows"]
    lines = [f"**{name}** ({result['scans']:.0f} scans"
             + (f"; {result['note']})" if result["note"] else ")"), ""]
    columns = [c for c in TITLES if any(row and c in row for row in rows.values())]
    lines.append("| | " + " | ".join(TITLES[c] for c in columns) + " |")
    lines.append("| --- |" + " --- |" * len(columns))
    for method, row in rows.items():
        cells = [f"{row[c]:.4g}" if c in row else "" for c in columns] if row else \
            ["failed"] + [""] * (len(columns) - 1)
        lines.append(f"| {method} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def report(results):
    """A table per quantity: sequences by rows, methods by columns."""
    methods = [name for name in ["ours", *PEERS]
               if any(name in result["rows"] for result in results.values())]
    lines = []
    for column in REPORTED:
        lines += [f"| {TITLES[column]} | scans | " + " | ".join(methods) + " |",
                  "| --- | ---: |" + " ---: |" * len(methods)]
        for name, result in results.items():
            rows = {method: row for method, row in result["rows"].items()
                    if row and column in row}
            if rows:
                cells = [f"{rows[m][column]:.3g}" if m in rows else "" for m in methods]
                lines.append(f"| {name} | {result['scans']:.0f} | "
                             + " | ".join(cells) + " |")
        lines.append("")
    return "\n".join(lines)


def keep(args, sequence, name, folder, out):
    """Trajectories to look at, with the truth beside them."""
    os.makedirs(args.keep, exist_ok=True)
    stem = os.path.join(args.keep, sequence.name)
    poses = {name: out, "truth": f"{folder}/poses.txt"}
    for which, path in poses.items():
        if os.path.exists(path):
            sequences.write_kitti_poses(f"{stem}_{which}.txt",
                                        sequences.read_kitti_poses(path))


def compare(sequence, args):
    rows = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.path.join(scratch, "scans")
        sequences.prepare(sequence, folder, args.scans)
        for name in ["ours", *args.peers]:
            out = os.path.join(scratch, name + ".txt")
            rows[name] = run_method(name, sequence, folder, out, args)
            if args.keep and rows[name]:
                keep(args, sequence, name, folder, out)
    return {"scans": next(row["scans"] for row in rows.values() if row),
            "note": sequence.note, "rows": rows}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--data", default=os.environ.get("PCL_NURBS_DATA"))
    parser.add_argument("--drives")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--peers", nargs="*", default=list(PEERS), choices=list(PEERS))
    parser.add_argument("--scans", type=int)
    parser.add_argument("--report")
    parser.add_argument("--results")
    parser.add_argument("--keep")
    args = parser.parse_args()
    found = sequences.real_sequences(args.data) if args.data else []
    found += sequences.simulated_sequences(args.drives) if args.drives else []
    results = {}
    if args.results and os.path.exists(args.results):
        with open(args.results, encoding="utf-8") as file:
            results = json.load(file)
    for sequence in found:
        if args.only and sequence.name not in args.only:
            continue
        results[sequence.name] = compare(sequence, args)
        print(table(sequence.name, results[sequence.name]), flush=True)
        if args.results:
            with open(args.results, "w", encoding="utf-8") as file:
                json.dump(results, file, indent=1)
    if args.report:
        with open(args.report, "w", encoding="utf-8") as file:
            file.write(report(results))


if __name__ == "__main__":
    main()
