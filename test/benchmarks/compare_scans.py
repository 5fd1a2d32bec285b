#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Measures scans of 64-beam lasers in KITTI's layout and writes a table to compare them.

Each argument NAME=FOLDER names a column and a folder of .bin files, e.g.

  compare_scans.py "real 07"=KITTI/sequences/07/velodyne "town"=town/sequences/00/velodyne

Rings are told by the order of the points: each file holds ring after ring, turning one
way, so the angle turned so far says which ring a point is of. Every ring must have
returns all around, as in streets: it does not work under an open sky.
"""
import argparse
import pathlib
import sys

import numpy as np

RANGES = [0, 5, 10, 15, 20, 30, 40, 60, np.inf]
RINGS = [0, 8, 16, 24, 32, 40, 48, 52, 56, 60, 63]
TURN = 2 * np.pi


class Scan:
    """Points, ranges, azimuths, and the ring of every point."""

    def __init__(self, path):
        values = np.fromfile(path, np.float32).reshape(-1, 4).astype(float)
        self.points, self.intensity = values[:, :3], values[:, 3]
        self.range = np.linalg.norm(self.points, axis=1)
        self.azimuth = np.arctan2(self.points[:, 1], self.points[:, 0])
        steps = (np.diff(self.azimuth) + np.pi) % TURN - np.pi
        sense = 1.0 if np.median(steps) > 0 else -1.0
        # KITTI's rings begin ahead, the simulator's behind: the seam is where most begin.
        turned = sense * np.concatenate([[0.0], np.cumsum(steps)])
        begin = 0.0 if abs(self.azimuth[0]) < np.pi / 2 else np.pi
        first = (sense * (self.azimuth[0] - begin) + 0.5) % TURN - 0.5
        self.ring = np.clip(np.floor((turned + first + 0.003) / TURN), 0, 63).astype(int)


def along_rings(scan):
    """Index of points whose two neighbours in the ring are about one step away."""
    same = (scan.ring[2:] == scan.ring[1:-1]) & (scan.ring[1:-1] == scan.ring[:-2])
    step = np.abs((np.diff(scan.azimuth) + np.pi) % TURN - np.pi)
    near = (step < 0.0045) & (step > 0.002)
    return 1 + np.flatnonzero(same & near[1:] & near[:-1])


def white_noise(scan):
    """Standard deviation of what neighbours in a ring do not share, by the median of second
    differences, which leaves out edges and leaves."""
    i = along_rings(scan)
    i = i[(scan.range[i] > 5) & (scan.range[i] < 25)]
    second = scan.range[i + 1] - 2 * scan.range[i] + scan.range[i - 1]
    return 1.4826 * np.median(np.abs(second)) / np.sqrt(6)


def spacing(scan):
    i = along_rings(scan)
    return np.median(np.linalg.norm(scan.points[i + 1] - scan.points[i], axis=1))


class Voxels:
    """Planes fitted to the points of cubes."""

    def __init__(self, scan, size, least):
        cells = np.floor(scan.points / size).astype(np.int64)
        key = (cells[:, 0] * 4096 + cells[:, 1]) * 4096 + cells[:, 2]
        _, self.cell, counts = np.unique(key, return_inverse=True, return_counts=True)

        def mean(values):
            return np.bincount(self.cell, values, len(counts)) / counts
        self.centre = np.stack([mean(scan.points[:, k]) for k in range(3)], 1)
        offset = scan.points - self.centre[self.cell]
        moments = np.stack([mean(offset[:, a] * offset[:, b])
                            for a in range(3) for b in range(3)], 1)
        spread, axes = np.linalg.eigh(moments.reshape(-1, 3, 3))
        self.normal = axes[:, :, 0]
        self.flat = (counts >= least) & (spread[:, 0] < 0.05 * spread[:, 1])
        self.offset = offset


def orientation(scan):
    """Shares of flat cubes that lie and that stand."""
    voxels = Voxels(scan, 0.5, 10)
    up = np.abs(voxels.normal[voxels.flat, 2])
    return np.mean(up > np.cos(np.radians(26))), np.mean(up < np.sin(np.radians(17)))


def wall_residuals(scan):
    """Range residuals on walls seen steeply, with their rings."""
    voxels = Voxels(scan, 1.0, 60)
    ray = scan.points / scan.range[:, None]
    normal = voxels.normal[voxels.cell]
    cosine = np.abs(np.sum(ray * normal, 1))
    use = voxels.flat[voxels.cell] & (np.abs(normal[:, 2]) < 0.2) & (cosine > 0.6)
    ring, normal, ray, offset = scan.ring[use], normal[use], ray[use], voxels.offset[use]
    residual = np.sum(offset * normal, 1) / np.sum(ray * normal, 1)
    inlier = np.abs(residual) < 0.15
    return residual[inlier], ring[inlier]


def ring_offsets(scans):
    """Standard deviation between rings of the mean residual of a ring."""
    residual, ring = map(np.concatenate, zip(*map(wall_residuals, scans)))
    count = np.bincount(ring, minlength=64)
    mean = np.bincount(ring, residual, 64) / np.maximum(count, 1)
    return np.std(mean[count > 200]) if np.any(count > 200) else np.nan


def measure(scans):
    """Rows of the table: name, figure."""
    ranges = np.concatenate([scan.range for scan in scans])
    rings = np.concatenate([scan.ring for scan in scans])
    light = np.concatenate([scan.intensity for scan in scans])
    count = np.bincount(rings, minlength=64)
    rows = [("points", f"{len(ranges) / len(scans):.0f}")]
    for low, high in zip(RANGES, RANGES[1:]):
        name = f"{low} to {high} m" if np.isfinite(high) else f"beyond {low} m"
        rows.append((name, f"{100 * np.mean((ranges >= low) & (ranges < high)):.1f}"))
    rows += [(f"returns, ring {k}", f"{count[k] / len(scans):.0f}") for k in RINGS]
    lying, standing = np.mean([orientation(scan) for scan in scans], 0)
    by_ring = np.bincount(rings, light, 64) / np.maximum(count, 1)
    return rows + [
        ("spacing along a ring, median (cm)", f"{100 * np.mean([*map(spacing, scans)]):.1f}"),
        ("flat cubes within 26° of upright", f"{100 * lying:.0f}"),
        ("flat cubes within 17° of level", f"{100 * standing:.0f}"),
        ("noise within a ring (cm)", f"{100 * np.mean([*map(white_noise, scans)]):.1f}"),
        ("offsets between rings (cm)", f"{100 * ring_offsets(scans):.1f}"),
        ("mean intensity", f"{np.mean(light):.2f}"),
        ("intensity between rings", f"{np.std(by_ring[count > 200 * len(scans)]):.3f}")]


def picture(scans, names, path):
    """From above, and range over azimuth and ring, scan beside scan."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    columns = len(scans)
    figure, axes = plt.subplots(2, columns, figsize=(8 * columns, 10.5), squeeze=False,
                                gridspec_kw={"height_ratios": [4, 1]})
    for (above, image), scan, name in zip(axes.T, scans, names):
        above.scatter(scan.points[:, 0], scan.points[:, 1], s=0.25, linewidths=0,
                      c=np.clip(scan.points[:, 2], -2.5, 5.0), cmap="turbo")
        above.set(title=name, xlim=(-50, 50), ylim=(-50, 50), aspect="equal",
                  xlabel="ahead (m)", ylabel="left (m)")
        raster = np.full((64, 1000), np.nan)
        column = ((np.pi - scan.azimuth) / TURN * 1000).astype(int) % 1000
        raster[scan.ring, column] = scan.range
        image.imshow(np.log(raster), aspect="auto", cmap="turbo_r", vmin=np.log(3),
                     vmax=np.log(80), interpolation="nearest", extent=(180, -180, 63, 0))
        image.set(xlabel="degrees to the left", ylabel="ring")
    figure.tight_layout()
    figure.savefig(path, dpi=75)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="NAME=FOLDER")
    parser.add_argument("--most", type=int, default=8, help="scans per folder (8)")
    parser.add_argument("--picture", metavar="PNG", help="draw the first scan of each folder")
    arguments = parser.parse_args()
    names, columns, firsts = [], [], []
    for argument in arguments.folders:
        name, _, folder = argument.partition("=")
        files = sorted(pathlib.Path(folder).glob("*.bin"))
        if not files:
            sys.exit(f"compare_scans.py: no .bin files in {folder!r}")
        step = max(1, len(files) // arguments.most)
        scans = [Scan(path) for path in files[::step][:arguments.most]]
        names.append(name)
        columns.append(measure(scans))
        firsts.append(scans[0])
    print("| | " + " | ".join(names) + " |")
    print("| --- |" + " ---: |" * len(names))
    for rows in zip(*columns):
        print(f"| {rows[0][0]} | " + " | ".join(figure for _, figure in rows) + " |")
    if arguments.picture:
        picture(firsts, names, arguments.picture)


if __name__ == "__main__":
    main()
