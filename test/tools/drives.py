# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Small drives through a hall with pillars, in the layouts of public data sets."""
import array
import math
import random

TR = "0 -1 0 0 0 0 -1 -0.08 1 0 0 -0.27"  # laser to camera, as KITTI's calib.txt has it


def hall_point(generator):
    """A point of the walls, the floor or a pillar of a hall of 20 x 10 x 4 m."""
    kind = generator.random()
    a, b = generator.random(), generator.random()
    if kind < 0.35:
        return 20 * a - 6, 10 * b - 5, -1.7
    if kind < 0.65:
        return 20 * a - 6, generator.choice((-5.0, 5.0)), 4 * b - 1.7
    if kind < 0.8:
        return generator.choice((-6.0, 14.0)), 10 * a - 5, 4 * b - 1.7
    angle = 2 * math.pi * a
    pillar = generator.randrange(5)
    return (4 * pillar - 4 + 0.5 * math.cos(angle), (3.0, -3.5)[pillar % 2] + 0.5 * math.sin(angle),
            4 * b - 1.7)


def scan(x, seed, points=4000):
    """What a laser at (x, 0, 0) that looks along x sees: floats x y z reflectance."""
    generator = random.Random(seed)
    values = array.array("f")
    for _ in range(points):
        px, py, pz = hall_point(generator)
        values.extend((px - x + generator.gauss(0, 0.01), py + generator.gauss(0, 0.01),
                       pz + generator.gauss(0, 0.01), 0.5))
    return values.tobytes()


def camera_pose(x):
    """Line of KITTI's format: the camera of a laser at (x, 0, 0), which looks along z."""
    return f"1 0 0 0 0 1 0 0 0 0 1 {x:.6f}\n"


def write_kitti(folder, scans=12, step=0.3, points=4000, sequence="00"):
    """A drive straight ahead in the layout of KITTI's odometry benchmark."""
    place = folder / "sequences" / sequence
    (place / "velodyne").mkdir(parents=True)
    (folder / "poses").mkdir(exist_ok=True)
    for k in range(scans):
        (place / "velodyne" / f"{k:06}.bin").write_bytes(scan(step * k, k, points))
    (place / "times.txt").write_text("".join(f"{0.1 * k:.6f}\n" for k in range(scans)))
    (place / "calib.txt").write_text(f"P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: {TR}\n")
    (folder / "poses" / f"{sequence}.txt").write_text(
        "".join(camera_pose(step * k) for k in range(scans)))


def read_kitti(path):
    """Positions of a trajectory in KITTI's format."""
    rows = [list(map(float, line.split())) for line in path.read_text().splitlines()]
    assert all(len(row) == 12 for row in rows)
    return [(row[3], row[7], row[11]) for row in rows]
