#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Our odometry and its peers on the same scans: accuracy and time per scan.

  compare_odometry.py RUN_ODOMETRY SCANS [--poses FILE [--calib FILE]] [--deskew]
                      [--threads 2] [--peers kiss_icp small_gicp]

RUN_ODOMETRY is the program of that name that the benchmarks' build makes, SCANS a folder
of KITTI .bin files. The peers come from PyPI (kiss-icp, small-gicp): install them, and
numpy, in a virtual environment of your own and call this script with its Python. Each
runs in a process of its own, bound to as many processors as it has threads. Reading the
files is not timed.
"""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np


def read_scan(path):
    return np.fromfile(path, dtype=np.float32).reshape(-1, 4)[:, :3].astype(np.float64)


def read_poses(path):
    rows = np.loadtxt(path).reshape(-1, 3, 4)
    last = np.tile([[[0.0, 0.0, 0.0, 1.0]]], (len(rows), 1, 1))
    return np.concatenate([rows, last], axis=1)


def read_calibration(path):
    for line in open(path, encoding="ascii"):
        if line.startswith("Tr:"):
            return np.vstack(
                [np.array(line.split()[1:], float).reshape(3, 4), [0, 0, 0, 1]])
    raise SystemExit(f"{path}: no Tr")


def times_by_azimuth(points):
    return 0.5 - np.arctan2(points[:, 1], points[:, 0]) / (2.0 * np.pi)


def kiss_icp(args):
    from kiss_icp.config import KISSConfig
    from kiss_icp.kiss_icp import KissICP

    config = KISSConfig()
    config.data.deskew = args.deskew
    config.data.max_range = 100.0
    config.mapping.voxel_size = 1.0  # what its pipeline chooses: max_range / 100
    config.registration.max_num_threads = args.threads
    odometry = KissICP(config)

    def step(points):
        times = times_by_azimuth(points) if args.deskew else np.zeros(len(points))
        odometry.register_frame(points, times)
        return odometry.last_pose

    return step


def small_gicp(args):
    """Scan to model with its Gaussian voxel map, as in its own odometry example."""
    import small_gicp as gicp

    state = {"map": gicp.GaussianVoxelMap(1.0), "pose": np.eye(4), "last": np.eye(4)}
    state["map"].set_lru(horizon=100, clear_cycle=10)

    def step(points):
        cloud, _ = gicp.preprocess_points(
            points, downsampling_resolution=0.25, num_threads=args.threads)
        if state["map"].size() == 0:
            state["map"].insert(cloud)
            return state["pose"]
        guess = state["pose"] @ np.linalg.inv(state["last"]) @ state["pose"]
        result = gicp.align(state["map"], cloud, guess, max_correspondence_distance=1.0,
                            num_threads=args.threads)
        state["last"], state["pose"] = state["pose"], result.T_target_source
        state["map"].insert(cloud, state["pose"])
        return state["pose"]

    return step


PEERS = {"kiss_icp": kiss_icp, "small_gicp": small_gicp}


def run_peer(args):
    """In a process of its own: trajectory to args.out, times to standard output."""
    step = PEERS[args.peer](args)
    wall = cpu = 0.0
    poses = []
    for path in sorted(glob.glob(os.path.join(args.scans, "*.bin"))):
        points = read_scan(path)
        start, start_cpu = time.perf_counter(), time.process_time()
        poses.append(np.array(step(points)))
        wall += time.perf_counter() - start
        cpu += time.process_time() - start_cpu
    np.savetxt(args.out, [pose[:3].ravel() for pose in poses])
    print(json.dumps({"scans": len(poses), "wall_ms": 1e3 * wall / len(poses),
                      "cpu_ms": 1e3 * cpu / len(poses)}))


def run(command, threads):
    processors = ",".join(str(i) for i in range(threads))
    done = subprocess.run(["taskset", "-c", processors, *command],
                          stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout.decode().splitlines()[-1])


def rotation_angle(rotation):
    return np.degrees(np.arccos(np.clip((np.trace(rotation) - 1.0) / 2.0, -1.0, 1.0)))


def errors(truth, estimate):
    """ATE after a rigid alignment, RPE per scan, and drift over the whole drive."""
    a, b = truth[:, :3, 3], estimate[:, :3, 3]
    u, _, vt = np.linalg.svd((a - a.mean(0)).T @ (b - b.mean(0)))
    turn = u @ np.diag([1.0, 1.0, np.linalg.det(u @ vt)]) @ vt
    ate = np.sqrt(((a - a.mean(0) - (b - b.mean(0)) @ turn.T) ** 2).sum(1).mean())
    motion = [np.linalg.inv(np.linalg.inv(truth[i]) @ truth[i + 1])
              @ np.linalg.inv(estimate[i]) @ estimate[i + 1]
              for i in range(len(truth) - 1)]
    rpe = np.sqrt(np.mean([np.sum(m[:3, 3] ** 2) for m in motion]))
    rpe_rotation = np.sqrt(np.mean([rotation_angle(m[:3, :3]) ** 2 for m in motion]))
    whole = (np.linalg.inv(np.linalg.inv(truth[0]) @ truth[-1])
             @ np.linalg.inv(estimate[0]) @ estimate[-1])
    length = np.linalg.norm(np.diff(a, axis=0), axis=1).sum()
    return {"ate_m": ate, "rpe_m": rpe, "rpe_deg": rpe_rotation,
            "end_percent": 100.0 * np.linalg.norm(whole[:3, 3]) / length,
            "end_deg": rotation_angle(whole[:3, :3])}


def truth_of(args, count):
    poses = read_poses(args.poses)[:count]
    if args.calib:
        tr = read_calibration(args.calib)
        poses = np.linalg.inv(tr) @ poses @ tr
    return poses


def compare(args):
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in ["ours", *args.peers]:
            out = os.path.join(folder, name + ".txt")
            if name == "ours":
                command = [args.program, args.scans, out, "--threads", str(args.threads)]
            else:
                command = [sys.executable, __file__, args.program, args.scans,
                           "--peer", name, "--out", out, "--threads", str(args.threads)]
            if args.deskew:
                command.append("--deskew")
            rows[name] = run(command, args.threads)
            if args.poses:
                estimate = read_poses(out)
                rows[name].update(errors(truth_of(args, len(estimate)), estimate))
    columns = list(rows["ours"])
    columns = [c for c in columns if all(c in row for row in rows.values())]
    print("| method | " + " | ".join(columns) + " |")
    print("| --- |" + " --- |" * len(columns))
    for name, row in rows.items():
        print(f"| {name} | " + " | ".join(f"{row[c]:.4g}" for c in columns) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scans")
    parser.add_argument("--poses")
    parser.add_argument("--calib")
    parser.add_argument("--deskew", action="store_true")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--peers", nargs="*", default=list(PEERS), choices=list(PEERS))
    parser.add_argument("--peer", choices=list(PEERS), help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    args = parser.parse_args()
    (run_peer if args.peer else compare)(args)


if __name__ == "__main__":
    main()
