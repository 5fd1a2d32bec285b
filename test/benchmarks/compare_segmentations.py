#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Run pcd_to_nurbs with both segmentations and write doc/compactness.md.

Takes the first cloud of each public data set, and more where they differ.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Pattern of the files, how many of them, options.
SOURCES = [
    ("pcl_organized/*.pcd", 8, ()),
    ("osd_labelled/learn*.pcd", 4, ()),
    ("tum_fr1_desk/depth/*.png", 1, ("--depth-scale", "5000")),
    ("redwood_livingroom/depth/*.png", 1, ()),
    ("icl_nuim_lr_kt0/depth/*.png", 1, ("--depth-scale", "5000")),
    ("seven_scenes_redkitchen/**/*depth.png", 1, ()),
    ("synthetic_knot/depth_syn.png", 1, ("--intrinsics", "415.692,415.692,319.5,239.5")),
    ("synthetic_knot/*.ply", 1, ()),
    ("redwood_bollard/01220_depth.png", 1, ()),
    ("synpeb_room/*.pcd", 1, ()),
    ("kitti_odometry/sequences/00/velodyne/*.bin", 1, ()),
    ("kitti_odometry/sequences/07/velodyne/*.bin", 1, ()),
    ("kitti_odometry/sequences/01_thin3/velodyne/*.bin", 1, ()),
    ("kitti_raw/**/*.bin", 1, ()),
    ("balm_realworld/velodyne/*.bin", 1, ()),
    ("pcl_unorganized/*.pcd", 4, ()),
    ("isprs_urban_als/*.pcd", 2, ()),
]
SEGMENTATIONS = ("groups", "surfaces")
INTRODUCTION = """# Maps of single clouds, by segmentation

Written by `test/benchmarks/compare_segmentations.py`; do not edit. `pcd_to_nurbs` with its
defaults but for `--segmentation`: what is connected between jumps and folds (*groups*), or
surfaces of least description length (*surfaces*, the default). Bytes are those of the
`.nurbs` file, the error is the root mean square distance of held-out points that the
surfaces cover, coverage the share of all points within three standard deviations of their
noise of a surface. Read the three together.

"""


def report_of(program, cloud, options, segmentation, folder):
    """Report of one run, or None if it found no surface."""
    path = pathlib.Path(folder) / "report.json"
    command = [program, cloud, pathlib.Path(folder) / "out.nurbs", "--segmentation",
               segmentation, "--report", path, "--quiet", *options]
    code = subprocess.run(list(map(str, command)), check=False).returncode
    if code not in (0, 3):
        raise SystemExit(f"failed with exit code {code}: {cloud}")
    return json.loads(path.read_text()) if code == 0 else None


def cells(report):
    if report is None:
        return ["no surface", "", "", "", ""]
    return [str(report["patches"]), str(report["control_points"]), str(report["bytes"]),
            f"{1e3 * report['rmse_m']:.2f}", f"{report['coverage']:.3f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=pathlib.Path, help="folder of the data sets")
    parser.add_argument("--program", type=pathlib.Path,
                        default=ROOT / "build/tools/pcd_to_nurbs")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "doc/compactness.md")
    arguments = parser.parse_args()
    lines = ["| cloud | " + " | ".join(
        f"{name}, {word}" for name in ("patches", "control points", "bytes", "error mm",
                                       "coverage") for word in SEGMENTATIONS) + " |"]
    lines.append("| --- " * (lines[0].count("|") - 1) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for pattern, most, options in SOURCES:
            for cloud in sorted(arguments.data.glob(pattern))[:most]:
                reports = [report_of(arguments.program, cloud, options, word, folder)
                           for word in SEGMENTATIONS]
                pairs = zip(*map(cells, reports))
                path = cloud.relative_to(arguments.data)
                folders = path.parts[:3] if len(path.parts) > 3 else path.parts[:1]
                name = f"{'/'.join(folders)} {path.name}"
                lines.append("| " + name + " | " +
                             " | ".join(" | ".join(pair) for pair in pairs) + " |")
                print(lines[-1], flush=True)
    arguments.output.write_text(INTRODUCTION + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
