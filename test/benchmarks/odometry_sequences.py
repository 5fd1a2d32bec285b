# SPDX-License-Identifier: BSD-3-Clause
"""The sequences that compare_odometry.py runs on, brought into one form.

A prepared sequence is a folder with velodyne/NNNNNN.bin (x y z intensity, float32),
point_times/NNNNNN.bin where points have times (seconds from the stamp, float32), and
poses.txt (KITTI's format, of the sensor itself, at the stamps) where there is a truth.
"""
import dataclasses
import glob
import os

import numpy as np

KITTI_VERTICAL_ANGLE = np.radians(0.205)  # Deschaud, IMLS-SLAM, ICRA 2018


@dataclasses.dataclass
class Sequence:
    name: str
    kind: str  # lidar or rgbd
    scans: str  # where the scans are
    poses: str = ""  # KITTI's or TUM's format
    calib: str = ""  # KITTI's calib.txt: the poses are of its camera
    vertical_angle: float = 0.0  # radians by which points are raised
    deskew: bool = False
    camera: tuple = ()  # fx fy cx cy, depth per metre
    note: str = ""


def real_sequences(data):
    """All real sequences of the data folder."""
    kitti = os.path.join(data, "kitti_odometry")

    def drive(name, scans, number, **more):
        return Sequence(name, "lidar", f"{kitti}/sequences/{scans}/velodyne",
                        f"{kitti}/poses/{number}.txt",
                        f"{kitti}/sequences/{number}/calib.txt",
                        KITTI_VERTICAL_ANGLE, **more)

    def camera(name, intrinsics, scale):
        return Sequence(name, "rgbd", os.path.join(data, name),
                        os.path.join(data, name, "groundtruth.txt"),
                        camera=(*intrinsics, scale))

    return [
        drive("kitti_00", "00", "00", note="the first poses of this truth are wrong"),
        drive("kitti_01_thin3", "01_thin3", "01"),
        drive("kitti_07", "07", "07"),
        Sequence("kitti_raw", "lidar",
                 f"{data}/kitti_raw/sfnd_data_1_thin4/velodyne_points/data",
                 vertical_angle=KITTI_VERTICAL_ANGLE, note="no truth"),
        Sequence("balm_realworld", "lidar", f"{data}/balm_realworld/velodyne",
                 f"{data}/balm_realworld/poses.txt", note="truth is an odometry's"),
        camera("tum_fr1_desk", (517.3, 516.5, 318.6, 255.3), 5000.0),
        camera("seven_scenes_redkitchen", (585.0, 585.0, 320.0, 240.0), 1000.0),
        camera("icl_nuim_lr_kt0", (481.2, 480.0, 319.5, 239.5), 5000.0),
        camera("redwood_livingroom", (525.0, 525.0, 319.5, 239.5), 1000.0),
    ]


def simulated_sequences(folder):
    """All drives that simulate_scans wrote to a folder."""
    found = []
    for scans in sorted(glob.glob(f"{folder}/sequences/*/velodyne")):
        sequence = os.path.dirname(scans)
        number = os.path.basename(sequence)
        found.append(Sequence(f"simulated_{number}", "lidar", scans,
                              f"{folder}/poses/{number}.txt", f"{sequence}/calib.txt",
                              deskew=os.path.isdir(f"{sequence}/point_times")))
    return found


def read_kitti_poses(path):
    rows = np.loadtxt(path).reshape(-1, 3, 4)
    last = np.tile([[[0.0, 0.0, 0.0, 1.0]]], (len(rows), 1, 1))
    return np.concatenate([rows, last], axis=1)


def write_kitti_poses(path, poses):
    np.savetxt(path, np.asarray(poses)[:, :3].reshape(-1, 12), fmt="%.9e")


def read_calibration(path):
    with open(path, encoding="ascii") as lines:
        for line in lines:
            if line.startswith("Tr:"):
                rows = np.array(line.split()[1:], float).reshape(3, 4)
                return np.vstack([rows, [0.0, 0.0, 0.0, 1.0]])
    raise SystemExit(f"{path}: no Tr")


def tum_poses_at(path, stamps):
    """The poses of a file in TUM's format that are nearest to some times."""
    from scipy.spatial.transform import Rotation

    rows = np.loadtxt(path)
    rows = rows[[np.abs(rows[:, 0] - stamp).argmin() for stamp in stamps]]
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, :3] = Rotation.from_quat(rows[:, 4:8]).as_matrix()
    poses[:, :3, 3] = rows[:, 1:4]
    return poses


def depth_files(folder):
    """(stamp, file) of each depth image."""
    lists = [os.path.join(folder, name) for name in ("depth.txt", "associations.txt")]
    with open(next(path for path in lists if os.path.exists(path)),
              encoding="utf-8") as lines:
        rows = [line.split() for line in lines if line.strip() and line[0] != "#"]
    return [(float(row[-2]), os.path.join(folder, row[-1])) for row in rows]


def depth_points(path, camera):
    from PIL import Image

    fx, fy, cx, cy, scale = camera
    pixels = np.asarray(Image.open(path)).astype(np.float64)
    rows, columns = np.nonzero((pixels > 0) & (pixels < 65535))
    depth = pixels[rows, columns] / scale
    return np.stack([(columns - cx) * depth / fx, (rows - cy) * depth / fy, depth], 1)


def raise_points(points, angle):
    """Turn points upwards by an angle as seen from the sensor."""
    level = np.maximum(np.hypot(points[:, 0], points[:, 1]), 1e-9)
    factor = (np.cos(angle) * level - np.sin(angle) * points[:, 2]) / level
    return np.stack([points[:, 0] * factor, points[:, 1] * factor,
                     np.sin(angle) * level + np.cos(angle) * points[:, 2]], 1)


def write_bin(path, points):
    rows = np.zeros((len(points), 4), np.float32)
    rows[:, :3] = points
    rows.tofile(path)


def prepare_depth(sequence, folder, count):
    files = depth_files(sequence.scans)[:count]
    for i, (_, path) in enumerate(files):
        write_bin(f"{folder}/velodyne/{i:06d}.bin", depth_points(path, sequence.camera))
    write_kitti_poses(f"{folder}/poses.txt",
                      tum_poses_at(sequence.poses, [stamp for stamp, _ in files]))


def prepare_scans(sequence, folder, count):
    files = sorted(glob.glob(f"{sequence.scans}/*.bin"))[:count]
    times = os.path.join(os.path.dirname(sequence.scans), "point_times")
    if sequence.deskew:
        os.mkdir(f"{folder}/point_times")
    for i, path in enumerate(files):
        target = f"{folder}/velodyne/{i:06d}.bin"
        if sequence.vertical_angle:
            points = np.fromfile(path, np.float32).reshape(-1, 4)[:, :3].astype(float)
            write_bin(target, raise_points(points, sequence.vertical_angle))
        else:
            os.symlink(os.path.abspath(path), target)
        if sequence.deskew:
            os.symlink(os.path.abspath(f"{times}/{os.path.basename(path)}"),
                       f"{folder}/point_times/{i:06d}.bin")
    if not sequence.poses:
        return
    poses = read_kitti_poses(sequence.poses)
    if sequence.calib:
        camera = read_calibration(sequence.calib)
        poses = np.linalg.inv(camera) @ poses @ camera
    write_kitti_poses(f"{folder}/poses.txt", poses[:len(files) + 1])


def prepare(sequence, folder, count=None):
    """Write a sequence, or its first scans, in the prepared form."""
    os.makedirs(f"{folder}/velodyne")
    (prepare_depth if sequence.kind == "rgbd" else prepare_scans)(
        sequence, folder, count)


class PreparedScans:
    """Reads a prepared sequence."""

    def __init__(self, folder):
        self.files = sorted(glob.glob(f"{folder}/velodyne/*.bin"))

    def __len__(self):
        return len(self.files)

    def read(self, index):
        """Points, and their times from 0 to 1 within the scan, or None."""
        path = self.files[index]
        points = np.fromfile(path, np.float32).reshape(-1, 4)[:, :3].astype(np.float64)
        times = path.replace("/velodyne/", "/point_times/")
        if not os.path.exists(times):
            return points, None
        seconds = np.fromfile(times, np.float32).astype(np.float64)
        return points, seconds / 0.1 + 0.5  # a turn takes 0.1 s, its middle is the stamp
