#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Write nurbs_oracle_values.json: random curves and surfaces with points and
derivatives computed by geomdl, an implementation independent of this project.

    pip install geomdl==5.4.0
    python3 make_oracle_values.py nurbs_oracle_values.json

Layout: {"generator", "curves": [...], "surfaces": [...]}. Control points are
homogeneous (w x, w y[, w z], w), those of surfaces with the second index fastest.
A sample of a curve is {"u", "derivatives": [C, C', ...]}, one of a surface
{"u", "v", "derivatives": {"kl": d^(k+l) S / du^k dv^l}}.
"""
import json
import random
import sys

import geomdl
from geomdl import NURBS

ORDER = 3
SAMPLES = 4


def make_knots(rng, degree, kind):
    """Non-decreasing knots: 'bezier', 'clamped' (inner ones repeat) or 'unclamped'."""
    first = round(rng.uniform(-2, 1), 3)
    if kind == "unclamped":
        knots = [first]
        for _ in range(2 * degree + 4):
            knots.append(round(knots[-1] + rng.uniform(0.1, 1.0), 3))
        return knots
    last = round(first + rng.uniform(0.5, 4), 3)
    inner = []
    for _ in range(0 if kind == "bezier" else rng.randint(1, 3)):
        knot = round(rng.uniform(first + 0.1, last - 0.1), 3)
        inner += [knot] * rng.randint(1, min(2, degree))
    return [first] * (degree + 1) + sorted(inner) + [last] * (degree + 1)


def make_points(rng, count, dimension, rational):
    """Homogeneous control points, rounded so that the file stays small."""
    points = []
    for _ in range(count):
        weight = round(rng.uniform(0.5, 2), 3) if rational else 1.0
        points.append([round(rng.uniform(-1, 1), 4) for _ in range(dimension)] + [weight])
    return points


def pick(rng, degree, knots):
    """A parameter inside of the domain and away from knots, where derivatives jump."""
    while True:
        u = rng.uniform(knots[degree], knots[-degree - 1])
        if min(abs(u - knot) for knot in knots) > 1e-3:
            return u


def make_curve(rng, degree, kind, dimension, rational):
    knots = make_knots(rng, degree, kind)
    curve = NURBS.Curve(normalize_kv=False)
    curve.degree = degree
    points = make_points(rng, len(knots) - degree - 1, dimension, rational)
    curve.ctrlptsw = points
    curve.knotvector = knots
    samples = []
    for _ in range(SAMPLES):
        u = pick(rng, degree, knots)
        samples.append({"u": u, "derivatives": curve.derivatives(u, ORDER)})
    return {"degree": degree, "knots": knots, "points": points, "samples": samples}


def make_surface(rng, degrees, kinds, rational):
    knots = [make_knots(rng, p, kind) for p, kind in zip(degrees, kinds)]
    counts = [len(k) - p - 1 for k, p in zip(knots, degrees)]
    surface = NURBS.Surface(normalize_kv=False)
    surface.degree_u, surface.degree_v = degrees
    points = make_points(rng, counts[0] * counts[1], 3, rational)
    surface.set_ctrlpts(points, *counts)
    surface.knotvector_u, surface.knotvector_v = knots
    samples = []
    for _ in range(SAMPLES):
        u, v = (pick(rng, p, k) for p, k in zip(degrees, knots))
        all_values = surface.derivatives(u, v, ORDER)
        values = {
            f"{k}{l}": all_values[k][l]
            for k in range(ORDER + 1)
            for l in range(ORDER + 1 - k)
        }
        samples.append({"u": u, "v": v, "derivatives": values})
    return {"degrees": list(degrees), "knots": knots, "points": points, "samples": samples}


def main(path):
    rng = random.Random(20260101)
    kinds = ["bezier", "clamped", "unclamped"]
    curves = [
        make_curve(rng, degree, kinds[(degree + dimension) % 3], dimension, rational)
        for degree in (1, 2, 3, 5, 9)
        for dimension in (2, 3)
        for rational in (False, True)
    ]
    surfaces = [
        make_surface(rng, (p, q), (kinds[(p + i) % 3], kinds[(q + 2 * i) % 3]), i % 2 == 1)
        for p, q in ((1, 1), (1, 2), (2, 3), (3, 3), (5, 2))
        for i in range(4)
    ]
    table = {
        "generator": f"geomdl {geomdl.__version__}",
        "curves": curves,
        "surfaces": surfaces,
    }
    with open(path, "w", encoding="ascii") as file:
        json.dump(table, file, separators=(",", ":"))
        file.write("\n")


if __name__ == "__main__":
    main(sys.argv[1])
