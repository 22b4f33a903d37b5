"""What a distant light or a lamp sees of a triangle, in whole numbers, straight from the definition.

Another triangle hides the part of a triangle that lies in its shadow. That part is convex, and it is bounded by four
half-planes, which are linear in the coordinates of the triangle itself: three planes through the light and the edges of
the other triangle, and the other triangle's plane. Parts are subtracted one after another. There is no camera, no image
and no sweep, so this judge shares nothing with `fathom areas` except the definition.
"""

import json
import math
import pathlib
from fractions import Fraction

import numpy as np


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def sign(x):
    return (x > 0) - (x < 0)


def triangles_of_file(file, scene):
    """The corners of all triangles of a mesh or scene file, as fractions; `scene` is the file as Fathom reads it, of
    which only the lists of vertices and faces are used."""
    transforms = [None] * len(scene.objects)
    if pathlib.Path(file).suffix == ".json":
        transforms = [each.get("transform") for each in json.loads(pathlib.Path(file).read_text())["meshes"]]
    triangles = []
    for each, transform in zip(scene.objects, transforms):
        rows = [[Fraction(x) for x in row] for row in transform] if transform else None
        corners = []
        for vertex in scene.vertices(each.mesh).tolist():
            p = tuple(map(Fraction, vertex))
            corners.append(tuple(dot(row, p) + row[3] for row in rows) if rows else p)
        triangles += [tuple(corners[k] for k in face) for face in scene.faces(each.mesh).tolist()]
    return triangles


def whole(triangles, light):
    """The same scene and light, enlarged so that all coordinates are whole numbers; and the factor."""
    numbers = [x for t in triangles for p in t for x in p] + [Fraction(x) for x in light]
    factor = math.lcm(*{x.denominator for x in numbers})
    enlarged = [tuple(tuple(int(x * factor) for x in p) for p in t) for t in triangles]
    return enlarged, tuple(int(Fraction(x) * factor) for x in light), factor


def clipped(polygon, half):
    """The part of a convex polygon with a·x + b·y + c·w ≥ 0; empty without an area. Corners are (x, y, w) with w > 0."""
    values = [half[0] * p[0] + half[1] * p[1] + half[2] * p[2] for p in polygon]
    if max(values) <= 0:
        return []
    if min(values) >= 0:
        return polygon
    kept = []
    for k, (p, at_p) in enumerate(zip(polygon, values)):
        if at_p >= 0:
            kept.append(p)
        following = (k + 1) % len(polygon)
        q, at_q = polygon[following], values[following]
        if at_p * at_q < 0:
            x, y, w = (abs(at_q) * i + abs(at_p) * j for i, j in zip(p, q))
            common = math.gcd(x, y, w)
            kept.append((x // common, y // common, w // common))
    return kept


def subtracted(polygon, halves):
    """Convex parts of a polygon without a convex region."""
    parts, rest = [], polygon
    for half in halves:
        outside = clipped(rest, tuple(-x for x in half))
        if outside:
            parts.append(outside)
        rest = clipped(rest, half)
        if not rest:
            return [polygon]
    return parts


def added(terms):
    """Their sum; of neighbours first, so that numbers stay short."""
    while len(terms) > 1:
        terms = [sum(terms[k:k + 2]) for k in range(0, len(terms), 2)]
    return terms[0] if terms else Fraction(0)


def measured(polygons):
    """Twice the area of all polygons, and that times their centre."""
    twice, first, second = [], [], []
    for polygon in polygons:
        for p, q in zip(polygon[1:], polygon[2:]):
            three = polygon[0], p, q
            weight = three[0][2] * p[2] * q[2]
            area = Fraction(dot(three[0], cross(p, q)), weight)
            twice.append(area)
            first.append(area * sum(Fraction(x, w) for x, _, w in three) / 3)
            second.append(area * sum(Fraction(y, w) for _, y, w in three) / 3)
    return added(twice), added(first), added(second)


class Judge:
    """A scene under a direction, or around a point."""

    # Far above the errors of binary64 for coordinates of at most 1.
    doubt = 1e-12

    def __init__(self, triangles, light, is_point):
        self.triangles, self.light, self.factor = whole(triangles, light)
        self.is_point = is_point
        size = max(1, *(abs(x) for t in self.triangles for p in t for x in p), *map(abs, self.light if is_point else ()))
        self.corners = np.array([[[x / size for x in p] for p in t] for t in self.triangles])
        size = size if is_point else max(map(abs, self.light))
        self.near_light = np.array([x / size for x in self.light])

    def facing(self, number):
        """n·d, or n·(c − A), with the length of n and d as enlarged."""
        a, b, c = self.triangles[number]
        towards = minus(self.light, a) if self.is_point else self.light
        return dot(cross(minus(b, a), minus(c, a)), towards)

    def shadow(self, number, of):
        """The half-planes of what triangle `of` hides of a triangle, in the triangle's coordinates (β, γ, 1)."""
        corners = self.triangles[number]
        p = self.triangles[of]
        facing = sign(self.facing(of))
        if facing == 0:
            return None
        normal = cross(minus(p[1], p[0]), minus(p[2], p[0]))
        planes = []
        for k in range(3):
            if self.is_point:
                plane = cross(minus(p[k], self.light), minus(p[(k + 1) % 3], self.light))
            else:
                plane = cross(self.light, minus(p[(k + 1) % 3], p[k]))
            # Positive at the third corner. From a point, det(p − c, q − c, r − c) = −n·(c − p).
            planes.append((plane, p[k], -facing if self.is_point else facing))
        planes.append((normal, p[0], -facing))
        halves = []
        for plane, at, side in planes:
            first, second, third = (side * dot(plane, minus(corner, at)) for corner in corners)
            halves.append((second - first, third - first, first))
        if halves[3] == (0, 0, 0) and of > number:
            return None  # in one plane, the triangle with the lower number is visible
        return halves

    def candidates(self, number):
        """Triangles that may hide something of a triangle: all but those that binary64 certainly finds elsewhere."""
        p, corners, light = self.corners, self.corners[number], self.near_light
        normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        facing = (normal * (light - p[:, 0] if self.is_point else light)).sum(axis=1)
        side = np.sign(facing) * (-1 if self.is_point else 1)
        may_hide = np.ones(len(p), bool)
        for k in range(3):
            q = p[:, (k + 1) % 3]
            plane = np.cross(p[:, k] - light, q - light) if self.is_point else np.cross(light, q - p[:, k])
            values = side * ((corners[:, None, :] - p[None, :, k]) * plane).sum(axis=2)
            may_hide &= values.max(axis=0) > -self.doubt
        may_hide |= np.abs(facing) <= self.doubt
        may_hide[number] = False
        return np.flatnonzero(may_hide).tolist()

    def visible(self, number):
        """The share of the triangle that is visible, and the share times its centre in the world."""
        if self.facing(number) == 0:
            return Fraction(0), None
        parts = [[(0, 0, 1), (1, 0, 1), (0, 1, 1)]]
        for other in self.candidates(number):
            halves = self.shadow(number, other)
            if halves is None or any(max(h[2], h[0] + h[2], h[1] + h[2]) < 0 for h in halves):
                continue
            # A form that is 0 everywhere bounds nothing.
            halves = [half for half in halves if half != (0, 0, 0)]
            parts = [piece for part in parts for piece in subtracted(part, halves)]
        share, beta, gamma = measured(parts)
        a, b, c = self.triangles[number]
        moment = tuple((a[k] * share + (b[k] - a[k]) * beta + (c[k] - a[k]) * gamma) / self.factor for k in range(3))
        return share, moment

    def area(self, number):
        """The values of a row of the table, rounded once."""
        a, b, c = self.triangles[number]
        normal, facing = cross(minus(b, a), minus(c, a)), self.facing(number)
        share, moment = self.visible(number)
        unit = self.factor**4
        row = {"side": ["edge", "front", "back"][sign(facing)], "projected": None, "visible": None, "fraction": None,
               "lit": nearest_root(share**2 * Fraction(dot(normal, normal), 4 * unit)), "x": None, "y": None, "z": None}
        if not self.is_point:
            across = Fraction(facing**2, 4 * dot(self.light, self.light) * unit)
            row["projected"], row["visible"] = nearest_root(across), nearest_root(share**2 * across)
        if facing != 0:
            row["fraction"] = float(share)
        if share != 0:
            row.update(zip("xyz", (float(m / share) for m in moment)))
        return row


def nearest_root(square):
    """The square root of a fraction, rounded once to binary64."""
    if square == 0:
        return 0.0
    # A whole number with at least 64 bits of the root; a last bit stands for the rest.
    shift = max(0, 130 - square.numerator.bit_length() + square.denominator.bit_length())
    shift += shift % 2
    scaled = (square.numerator << shift) // square.denominator
    root = math.isqrt(scaled)
    is_exact = root * root == scaled and scaled * square.denominator == square.numerator << shift
    return float(Fraction(2 * root + (0 if is_exact else 1), 2 << (shift // 2)))
