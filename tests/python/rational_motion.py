"""The placements of a moving sensor in fractions, at dyadic shares of the way from one pose to the next."""

import math
from fractions import Fraction

one = 1 << 220


def rounded(x):
    return Fraction(float(x))


def rotated(matrix, v):
    return [sum(a * b for a, b in zip(row, v)) for row in matrix]


def rotation(q):
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    return [[(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
            [2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n],
            [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n]]


def unit(q):
    length = math.isqrt(int(sum(x * x for x in q) * one * one))
    return [x * one / length for x in q]


def turned_by_halves(quaternions, share):
    """Slerp of two quaternions (w, x, y, z) at a dyadic share: the middle of an arc is along the sum of its ends."""
    p, q = (unit([Fraction(x) for x in each]) for each in quaternions)
    if sum(a * b for a, b in zip(p, q)) < 0:
        q = [-x for x in q]
    low, high = Fraction(0), Fraction(1)
    while low != share:
        middle, between = (low + high) / 2, unit([a + b for a, b in zip(p, q)])
        low, p, high, q = (middle, between, high, q) if share >= middle else (low, p, middle, between)
    return [rounded(x) for x in p]


def placement(positions, quaternions, share):
    """The rotation matrix and the position, of a rounded quaternion and a rounded position."""
    position = [rounded(Fraction(a) + share * (Fraction(b) - Fraction(a))) for a, b in zip(*positions)]
    return rotation(turned_by_halves(quaternions, share)), position
