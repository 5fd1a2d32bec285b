#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Second reader of .nurbs files, written from doc/file_format.md alone: prints the model as the
project's JSON. Metadata packed by zstd needs the module zstandard and is left out without it."""
import json
import math
import struct
import sys
import zlib
from collections import defaultdict

M64 = 2**64


def wrap(x):
    x %= M64
    return x - M64 if x >= M64 // 2 else x


class Coder:
    def __init__(self, data):
        self.data, self.at, self.range, self.value = data, 4, 0xFFFFFFFF, 0
        self.value = int.from_bytes(data[:4].ljust(4, b"\0"), "big")
        self.models = defaultdict(lambda: [32768, 0])

    def normalise(self):
        while self.range < 1 << 24:
            self.range <<= 8
            byte = self.data[self.at] if self.at < len(self.data) else 0
            self.value, self.at = self.value << 8 | byte, self.at + 1

    def bit(self, *name):
        model = self.models[name]
        split = (self.range >> 16) * model[0]
        bit = self.value >= split
        if bit:
            self.value, self.range = self.value - split, self.range - split
            model[0] -= model[0] // (model[1] + 2)
        else:
            self.range = split
            model[0] += (65536 - model[0]) // (model[1] + 2)
        model[1] = min(model[1] + 1, 30)
        self.normalise()
        return int(bit)

    def direct(self, count):
        result = 0
        for _ in range(count):
            self.range >>= 1
            bit = self.value >= self.range
            if bit:
                self.value -= self.range
            result = result << 1 | bit
            self.normalise()
        return result

    def positive(self, *name):
        n = 0
        while n < 63 and self.bit(*name, "length", n):
            n += 1
        result = 1
        for i in range(n):
            result = result << 1 | (self.bit(*name, "high", n, result) if i < 2 else self.direct(1))
        return result

    def unsigned(self, *name):
        return self.positive(*name) - 1

    def signed(self, *name):
        if not self.bit(*name, "nonzero"):
            return 0
        negative = self.bit(*name, "negative")
        magnitude = self.positive(*name)
        return wrap(-magnitude if negative else magnitude)


class Section:
    """Patches of one section, with what their coding carries over."""

    def __init__(self, data):
        self.c, self.exponent = Coder(data), defaultdict(lambda: 1023)
        self.step, self.origin, self.camera, self.label = 0, [0.0] * 3, [0.0] * 12, 0
        self.lattices, self.heading, self.turns = [(0, 0.0, 1.0)] * 2, 0, (0, 0)
        self.patches = [self.patch() for _ in range(self.c.unsigned("patches"))]

    def double(self, *name):
        sign = self.c.bit(*name, "sign")
        exponent = (self.exponent[name] + self.c.signed(*name, "exponent")) % 2048
        self.exponent[name] = exponent
        bits = self.c.unsigned(*name, "bits")
        mantissa = self.c.direct(bits) << 52 - bits
        return struct.unpack("<d", struct.pack("<Q", sign << 63 | exponent << 52 | mantissa))[0]

    def sequence(self, count, stride, *name):
        ordered, result = [], []
        for i in range(count):
            before = 1 << 63 if i < stride else ordered[i - stride]
            ordered.append((before + self.c.signed(*name)) % M64)
            bits = ordered[-1] ^ (1 << 63) if ordered[-1] >> 63 else ordered[-1] ^ (M64 - 1)
            result.append(struct.unpack("<d", struct.pack("<Q", bits))[0])
        return result

    def knots(self, *name):
        degree = self.c.unsigned(*name, "degree")
        layout = self.c.unsigned(*name, "layout")
        if layout == 3:
            return degree, self.sequence(self.c.unsigned(*name, "count"), 1, *name, "exact")
        first, last = self.double(*name, "first"), self.double(*name, "last")
        if layout == 2:
            bits, place, inner = self.c.unsigned(*name, "lattice"), 0, []
            for _ in range(self.c.unsigned(*name, "count")):
                place += self.c.unsigned(*name, "place")
                inner.append(first + (last - first) * math.ldexp(place, -bits))
        else:
            n = self.c.unsigned(*name, "count")
            at = lambda i: last if i == n else first + (last - first) * i / n
            if layout == 1:
                return degree, [at(i) for i in range(-degree, n + degree + 1)]
            inner = [at(i) for i in range(1, n)]
        return degree, [first] * (degree + 1) + inner + [last] * (degree + 1)

    def grid(self, rows, cols, *name):
        orders, g = self.c.unsigned(*name, "orders"), [[0] * cols for _ in range(rows)]
        for i in range(rows):
            for j in range(cols):
                m = max(abs(g[i - 1][j]) if i else 0, abs(g[i][j - 1]) if j else 0)
                which = "corner" if i + j == 0 else (m > 0) + (m > 2) + (m > 12)
                g[i][j] = self.c.signed(*name, which)
        for _ in range(orders // 3):
            for i in range(1, rows):
                g[i] = [wrap(a + b) for a, b in zip(g[i - 1], g[i])]
        for _ in range(orders % 3):
            for row in g:
                for j in range(1, cols):
                    row[j] = wrap(row[j - 1] + row[j])
        return [value for row in g for value in row]

    def step_size(self, code):
        return math.ldexp(4 + code % 4, code // 4 - 2)

    def next_step(self):
        self.step += self.c.signed("step")
        return self.step_size(self.step)

    def height_net(self, g, k, size):
        step = self.next_step()
        f = step / 2
        for d in range(3):
            ratio = abs(self.origin[d]) / f
            guess = math.floor(ratio + 0.5) if ratio < 1e15 else 0
            guess = -guess if self.origin[d] < 0 else guess
            self.origin[d] = f * wrap(guess + self.c.signed("origin"))
        half = [(x[-1] - x[0]) / 2 or 1.0 for x in (g, k)]
        if self.c.bit("orthogonal"):
            scale = [self.double("scale"), self.double("scale")]
            dropped, t = self.c.unsigned("dropped"), f / 2 / max(scale[0] * half[0], scale[1] * half[1])
            q = [t * self.c.signed("rotation") for _ in range(3)]
            q.insert(dropped, math.sqrt(max(0.0, 1 - sum(x * x for x in q))))
            length = math.sqrt(sum(part * part for part in q))
            x, y, z, w = (part / length for part in q)
            a = [scale[0] * v for v in (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y))]
            b = [scale[1] * v for v in (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x))]
            n = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]
        else:
            a, b = ([f / h * self.c.signed("axis") for _ in range(3)] for h in half)
            n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            n = [x / math.sqrt(sum(y * y for y in n)) for x in n]
        flat = self.c.bit("flat")
        h = [0] * size if flat else self.grid(len(g), len(k), "height")
        centre = [(x[0] + x[-1]) / 2 for x in (g, k)]
        pairs = [(u - centre[0], v - centre[1]) for u in g for v in k]
        return [[self.origin[d] + u * a[d] + v * b[d] + step * i * n[d] for d in range(3)] + [1.0]
                for (u, v), i in zip(pairs, h)]

    def net(self, g, k):
        size, kind = len(g) * len(k), self.c.unsigned("class")
        if kind == 0:
            values = self.sequence(4 * size, 4, "exact")
            return [values[i:i + 4] for i in range(0, 4 * size, 4)]
        if kind == 1:
            step = self.next_step()
            x, y, z = (self.grid(len(g), len(k), "coordinate") for _ in range(3))
            w = [1.0] * size
            if self.c.bit("rational"):
                weight = self.step_size(self.c.signed("weight step"))
                w = [weight * i for i in self.grid(len(g), len(k), "weight")]
            return [[w[i] * (step * p[i]) for p in (x, y, z)] + [w[i]] for i in range(size)]
        if kind == 2:
            return self.height_net(g, k, size)
        if not self.c.bit("same camera"):
            self.camera = [self.double("camera") for _ in range(12)]
        step, m = self.next_step(), self.camera
        q = [step * i for i in self.grid(len(g), len(k), "inverse depth")]
        pairs = [(u, v) for u in g for v in k]
        return [[m[d] + u * m[3 + d] + v * m[6 + d] + w * m[9 + d] for d in range(3)] + [w]
                for (u, v), w in zip(pairs, q)]

    def curve(self, degree, knots, points):
        curve = {"degree": degree, "knots": knots, "points": [[x / w, y / w] for x, y, w in points]}
        if any(w != 1.0 for _, _, w in points):
            curve["weights"] = [w for _, _, w in points]
        return curve

    def lattice_corners(self, count, domains):
        if not self.c.bit("same lattice"):
            self.lattices = []
            for _ in range(2):
                cells = self.c.signed("cells")
                self.lattices.append((cells, 0.0, 1.0) if cells else
                                     (0, self.double("trim origin"), self.double("spacing")))
        at, places = [self.c.signed("start"), self.c.signed("start")], []
        for i in range(count):
            if i:
                turn = self.c.unsigned("turn", *self.turns)
                self.turns = (self.turns[1], turn)
                if turn == 3:
                    at = [at[0] + self.c.signed("oblique"), at[1] + self.c.signed("oblique")]
                else:
                    self.heading = (self.heading + (0, 1, 3, 0, 2)[turn]) % 4
                    run = self.c.unsigned("run") + 1
                    at = list(at)
                    at[self.heading % 2] += -run if self.heading >= 2 else run
            places.append([first + (last - first) * p / cells if cells else origin + p * spacing
                           for p, (cells, origin, spacing), (first, last)
                           in zip(at, self.lattices, domains)])
        return places

    def loop(self, domains):
        kind, count = self.c.unsigned("kind"), self.c.unsigned("corners")
        if kind == 2:
            curves = []
            for _ in range(count):
                degree, knots = self.knots("curve")
                n = len(knots) - degree - 1
                values = self.sequence(3 * n, 3, "curve points")
                curves.append(self.curve(degree, knots, [values[i:i + 3] for i in range(0, 3 * n, 3)]))
            return curves
        if kind == 0:
            corners = self.lattice_corners(count, domains)
        else:
            values = self.sequence(2 * count, 2, "corner")
            corners = [values[i:i + 2] for i in range(0, 2 * count, 2)]
        knots = [0.0] + [float(i) for i in range(count + 1)] + [float(count)]
        return [self.curve(1, knots, [[u, v, 1.0] for u, v in corners + corners[:1]])]

    def patch(self):
        (p, u), (q, v) = self.knots("u"), self.knots("v")
        greville = [[sum(t[i + 1:i + d + 1]) / d for i in range(len(t) - d - 1)]
                    for d, t in ((p, u), (q, v))]
        points = self.net(*greville)
        domains = [(t[d], t[-d - 1]) for d, t in ((p, u), (q, v))]
        loops = [self.loop(domains) for _ in range(self.c.unsigned("loops"))]
        self.label += self.c.signed("label")
        quality = {"points": self.c.signed("points") % M64}
        for key in ("noise", "rmse", "max"):
            value = self.double(key)
            quality[key] = value if math.isfinite(value) else None
        patch = {"degree_u": p, "degree_v": q, "knots_u": u, "knots_v": v,
                 "points": [[x / w for x in (a, b, c)] for a, b, c, w in points]}
        if any(point[3] != 1.0 for point in points):
            patch["weights"] = [point[3] for point in points]
        return dict(patch, trims=loops, label=self.label, quality=quality)


def text(data, at):
    size = struct.unpack_from("<I", data, at)[0]
    return data[at + 4:at + 4 + size].decode(), at + 4 + size


def metadata(data):
    result, at = {}, 4
    for _ in range(struct.unpack_from("<I", data)[0]):
        key, at = text(data, at)
        result[key], at = text(data, at)
    return result


def read(data):
    assert data[:8] == b"\x89NRB\r\n\x1a\n" and data[8:10] == b"\1\0"
    assert zlib.crc32(data[:12]) == struct.unpack_from("<I", data, 12)[0]
    model = {"format": "pcl_nurbs", "version": 1, "frame_id": "", "metadata": {}, "patches": []}
    at, kind = 16, b""
    while at < len(data):
        kind, packing, stored, _ = struct.unpack_from("<4sIII", data, at)
        body, end = data[at + 16:at + 16 + stored], at + 16 + stored
        assert zlib.crc32(data[at:end]) == struct.unpack_from("<I", data, end)[0]
        at = end + 4
        if packing == 1:
            try:
                import zstandard
                body = zstandard.ZstdDecompressor().decompress(body)
            except ImportError:
                continue
        if kind == b"HEAD":
            model["frame_id"] = text(body, 0)[0]
        elif kind == b"META":
            model["metadata"].update(metadata(body))
        elif kind == b"PTCH":
            model["patches"] += Section(body).patches
    assert kind == b"INDX", "the file was not finished"
    return model


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as file:
        json.dump(read(file.read()), sys.stdout)
