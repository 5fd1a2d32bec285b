# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""g2o files as graphs of GTSAM and g2o, and graphs of any size with known truth."""

import dataclasses
import random

import g2o
import gtsam
import numpy as np

_TO_GTSAM = [3, 4, 5, 0, 1, 2]  # g2o: translation, rotation; GTSAM the other way round


@dataclasses.dataclass
class Graph:
    planar: bool
    poses: dict  # by vertex
    edges: list  # (from, to, measured pose, information in GTSAM's order)


def _pose3(numbers):
    x, y, z, qx, qy, qz, qw = numbers
    return gtsam.Pose3(gtsam.Rot3.Quaternion(qw, qx, qy, qz), np.array([x, y, z]))


def _information(numbers, size):
    matrix = np.zeros((size, size))
    matrix[np.triu_indices(size)] = numbers
    matrix = matrix + np.triu(matrix, 1).T
    if size == 3:
        return matrix
    half_angles = np.diag([1, 1, 1, 0.5, 0.5, 0.5])  # g2o's quaternions
    matrix = half_angles @ matrix @ half_angles
    return matrix[np.ix_(_TO_GTSAM, _TO_GTSAM)]


def read_g2o(path):
    graph = Graph(False, {}, [])
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if not words or words[0].startswith("#"):
                continue
            numbers = [float(word) for word in words[1:]]
            if words[0] == "VERTEX_SE2":
                graph.planar = True
                graph.poses[int(words[1])] = gtsam.Pose2(*numbers[1:])
            elif words[0] == "VERTEX_SE3:QUAT":
                graph.poses[int(words[1])] = _pose3(numbers[1:])
            elif words[0] == "EDGE_SE2":
                graph.planar = True
                graph.edges.append((int(words[1]), int(words[2]), gtsam.Pose2(*numbers[2:5]),
                                    _information(numbers[5:], 3)))
            elif words[0] == "EDGE_SE3:QUAT":
                graph.edges.append((int(words[1]), int(words[2]), _pose3(numbers[2:9]),
                                    _information(numbers[9:], 6)))
            elif words[0] == "EDGE3":  # of TORO: roll, pitch, yaw; exact, so no information
                pose = gtsam.Pose3(gtsam.Rot3.RzRyRx(*numbers[5:8]), np.array(numbers[2:5]))
                graph.edges.append((int(words[1]), int(words[2]), pose, np.eye(6)))
    return graph


def write_poses(source, path, poses):
    """The edges of a g2o file with other poses."""
    with open(source, encoding="ascii") as file:
        edges = [line for line in file if line.startswith("EDGE")]
    with open(path, "w", encoding="ascii") as file:
        for name in sorted(poses):
            pose = poses[name]
            if isinstance(pose, gtsam.Pose2):
                file.write(f"VERTEX_SE2 {name} {pose.x()!r} {pose.y()!r} {pose.theta()!r}\n")
                continue
            q = pose.rotation().toQuaternion()
            numbers = [*pose.translation(), q.x(), q.y(), q.z(), q.w()]
            file.write(f"VERTEX_SE3:QUAT {name} {' '.join(repr(float(v)) for v in numbers)}\n")
        file.writelines(edges)


def factor(edge, planar):
    start, end, pose, information = edge
    noise = gtsam.noiseModel.Gaussian.Information(information, False)
    kind = gtsam.BetweenFactorPose2 if planar else gtsam.BetweenFactorPose3
    return kind(start, end, pose, noise)


def anchor(graph, name):
    kind = gtsam.PriorFactorPose2 if graph.planar else gtsam.PriorFactorPose3
    noise = gtsam.noiseModel.Isotropic.Sigma(3 if graph.planar else 6, 1e-4)
    return kind(name, graph.poses[name], noise)


def g2o_problem(graph, algorithm):
    """The graph as g2o's, its first vertex fixed."""
    problem, vertices = g2o.SparseOptimizer(), {}
    problem.set_algorithm(algorithm)
    vertex_kind, edge_kind = (g2o.VertexSE2, g2o.EdgeSE2) if graph.planar else (
        g2o.VertexSE3, g2o.EdgeSE3)
    for name, pose in graph.poses.items():
        vertices[name] = vertex_kind()
        vertices[name].set_id(name)
        vertices[name].set_estimate(_g2o_pose(pose, graph.planar))
        vertices[name].set_fixed(name == min(graph.poses))
        problem.add_vertex(vertices[name])
    to_file = np.diag([1, 1, 1] if graph.planar else [1, 1, 1, 2, 2, 2])
    order = slice(None) if graph.planar else _TO_GTSAM  # its own inverse
    for start, end, motion, information in graph.edges:
        edge = edge_kind()
        edge.set_vertex(0, vertices[start])
        edge.set_vertex(1, vertices[end])
        edge.set_measurement(_g2o_pose(motion, graph.planar))
        edge.set_information(to_file @ information[order][:, order] @ to_file)
        problem.add_edge(edge)
    return problem


def _g2o_pose(pose, planar):
    return g2o.SE2(pose.x(), pose.y(), pose.theta()) if planar else g2o.Isometry3d(pose.matrix())


def poses_of_g2o(graph, problem):
    def pose(name):
        estimate = problem.vertex(name).estimate()
        return gtsam.Pose2(*estimate.to_vector()) if graph.planar else gtsam.Pose3(
            estimate.matrix())
    return {name: pose(name) for name in graph.poses}


def write_street_grid(path, poses, seed=1):
    """A drive through a grid of streets, turning at random, with a loop to each earlier
    passage of the same corner; noise 5 cm and 0.01 rad, and the information to match."""
    rng = random.Random(seed)
    side = max(4, int((poses / 4) ** 0.5))
    information = " ".join(str(v) for v in _diagonal(400.0, 40000.0))
    x, y, heading, corners, edges = 0, 0, 0, {}, []
    truth = []
    for k in range(poses):
        truth.append((x, y, heading))
        if k > 0:
            edges.append((k - 1, k))
        if (x, y) in corners and k - corners[(x, y)] > 10:
            edges.append((corners[(x, y)], k))
        corners[(x, y)] = k
        turns = [(heading + turn) % 4 for turn in (0, 0, 1, 3)]
        steps = ((1, 0), (0, 1), (-1, 0), (0, -1))
        free = [h for h in turns if 0 <= x + steps[h][0] < side and 0 <= y + steps[h][1] < side]
        heading = rng.choice(free or [(heading + 2) % 4])
        x, y = x + steps[heading][0], y + steps[heading][1]
    with open(path, "w", encoding="ascii") as file:
        for start, end in edges:
            file.write(_noisy_edge(truth, start, end, rng) + information + "\n")


def _diagonal(translation, rotation):
    values = [translation] * 3 + [rotation] * 3
    return [values[r] if r == c else 0.0 for r in range(6) for c in range(r, 6)]


def _noisy_edge(truth, start, end, rng):
    def pose(place):
        x, y, heading = place
        return gtsam.Pose3(gtsam.Rot3.Rz(heading * np.pi / 2), np.array([x, y, 0.0]))

    error = [rng.gauss(0, 0.01) for _ in range(3)] + [rng.gauss(0, 0.05) for _ in range(3)]
    motion = pose(truth[start]).between(pose(truth[end])).compose(
        gtsam.Pose3.Expmap(np.array(error)))
    q = motion.rotation().toQuaternion()
    numbers = [*motion.translation(), q.x(), q.y(), q.z(), q.w()]
    return f"EDGE_SE3:QUAT {start} {end} {' '.join(repr(float(v)) for v in numbers)} "
