# SPDX-License-Identifier: BSD-3-Clause
"""Other odometries on a prepared sequence (see odometry_sequences.py).

  odometry_peers.py PEER FOLDER OUT.txt --kind lidar|rgbd [--threads 2]

writes a trajectory in KITTI's format and prints a line of JSON; reading is not timed.
Peers: kiss_icp, genz_icp, small_gicp, all from PyPI. On lidars they run with their own
defaults; in rooms all lengths shrink by the ratio of the ranges.
"""
import argparse
import json
import time

import numpy as np

from odometry_sequences import PreparedScans, write_kitti_poses

# Of the scan, the moment that a pose is for, where points have times.
REFERENCE_TIME = {"kiss_icp": 1.0, "genz_icp": 0.5, "small_gicp": 0.5}


def pipeline(config, make, kind, threads):
    """KISS-ICP's interface, which GenZ-ICP has, too."""
    config.registration.max_num_threads = threads
    if kind == "rgbd":
        config.data.max_range = 10.0
        config.adaptive_threshold.initial_threshold = 0.2
        config.adaptive_threshold.min_motion_th = 0.01
    odometries = []

    def step(points, times):
        if not odometries:
            config.data.deskew = times is not None
            odometries.append(make(config))
        odometries[0].register_frame(
            points, times if times is not None else np.zeros(len(points)))
        return odometries[0].last_pose

    return step


def kiss_icp(kind, threads):
    from kiss_icp.config import KISSConfig
    from kiss_icp.kiss_icp import KissICP

    config = KISSConfig()
    # What its pipeline chooses: max_range / 100.
    config.mapping.voxel_size = 0.1 if kind == "rgbd" else 1.0
    return pipeline(config, KissICP, kind, threads)


def genz_icp(kind, threads):
    from genz_icp.config import GenZConfig
    from genz_icp.genz_icp import GenZICP

    config = GenZConfig()
    if kind == "rgbd":
        config.data.min_range = 0.1
        config.mapping.voxel_size = 0.05
        config.mapping.map_cleanup_radius = 10.0
    return pipeline(config, GenZICP, kind, threads)


def small_gicp(kind, threads):
    """Scan to model with its Gaussian voxel map, as in its own odometry example; it
    does not deskew."""
    import small_gicp as gicp

    size = 0.1 if kind == "rgbd" else 1.0
    state = {"map": gicp.GaussianVoxelMap(size), "pose": np.eye(4), "last": np.eye(4)}
    state["map"].set_lru(horizon=100, clear_cycle=10)

    def step(points, _):
        cloud, _ = gicp.preprocess_points(
            points, downsampling_resolution=0.25 * size, num_threads=threads)
        if state["map"].size() == 0:
            state["map"].insert(cloud)
            return state["pose"]
        guess = state["pose"] @ np.linalg.inv(state["last"]) @ state["pose"]
        result = gicp.align(state["map"], cloud, guess, max_correspondence_distance=size,
                            num_threads=threads)
        state["last"], state["pose"] = state["pose"], result.T_target_source
        state["map"].insert(cloud, state["pose"])
        return state["pose"]

    return step


PEERS = {"kiss_icp": kiss_icp, "genz_icp": genz_icp, "small_gicp": small_gicp}


def memory_mb(what):
    """VmRSS, or VmHWM: getrusage() would count what the caller had before exec."""
    with open("/proc/self/status", encoding="ascii") as lines:
        return next(int(line.split()[1]) / 1024.0 for line in lines
                    if line.startswith(what))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("peer", choices=list(PEERS))
    parser.add_argument("folder")
    parser.add_argument("out")
    parser.add_argument("--kind", choices=["lidar", "rgbd"], default="lidar")
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()
    step = PEERS[args.peer](args.kind, args.threads)
    scans = PreparedScans(args.folder)
    wall = cpu = early = 0.0
    poses = []
    for i in range(len(scans)):
        points, times = scans.read(i)
        start, start_cpu = time.perf_counter(), time.process_time()
        poses.append(np.array(step(points, times)))
        wall += time.perf_counter() - start
        cpu += time.process_time() - start_cpu
        if i == len(scans) // 4:
            early = memory_mb("VmRSS")
    write_kitti_poses(args.out, poses)
    print(json.dumps({
        "scans": len(poses), "wall_ms": 1e3 * wall / len(poses),
        "cpu_ms": 1e3 * cpu / len(poses), "quarter_mb": early,
        "end_mb": memory_mb("VmRSS"), "peak_mb": memory_mb("VmHWM")}))


if __name__ == "__main__":
    main()
