"""Section 11 of the specification in fractions, by brute force over all triangles."""

from fractions import Fraction


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def sign(x):
    return (x > 0) - (x < 0)


def meet(o, d, corners):
    """(t, weights of the second and third corner) by section 11 of the specification."""
    a, b, c = corners
    n = cross(minus(b, a), minus(c, a))
    divisor = dot(n, d)
    if divisor == 0:
        return None
    edges = []
    for p, q in ((a, b), (b, c), (c, a)):
        s = dot(cross(minus(p, o), minus(q, o)), d)
        moved = [s] + [-x for x in cross(minus(q, p), d)]
        if sign(next(x for x in moved if x)) != sign(divisor):
            return None
        edges.append(s)
    return dot(n, minus(a, o)) / divisor, edges[2] / divisor, edges[0] / divisor


def hits_of(o, d, triangles, first, last):
    found = []
    for number, corners in enumerate(triangles):
        hit = meet(o, d, corners)
        if hit and first <= hit[0] <= last:
            found.append((hit[0], number, *hit[1:]))
    return sorted(found)


def fractions(rows):
    return [[Fraction(float(x)) for x in row] for row in rows]
