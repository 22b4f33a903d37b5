"""fathom.clip(): exact areas, judged by inclusion and exclusion, and by CGAL."""

import random
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import fathom
from fathom.clipping import area_of


def random_polygon(source, corners=7):
    """A star about a point: simple, with rational corners."""
    centre = (Fraction(source.randint(-9, 9), 7), Fraction(source.randint(-9, 9), 7))
    ring = []
    for i in range(corners):
        t = Fraction(2 * i + 1 - corners, 1) * Fraction(22, 7 * corners) / 2
        c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        r = Fraction(source.randint(1, 12), 3)
        ring.append((centre[0] + r * c, centre[1] + r * s))
    return ring


def total(pieces):
    return sum((piece.area for piece in pieces), Fraction(0))


def test_areas_add_up_and_both_algorithms_agree():
    source = random.Random(3)
    for _ in range(60):
        a, b = [random_polygon(source)], [random_polygon(source)]
        common, rest = fathom.clip(a, b), fathom.clip(a, b, "difference")
        assert total(common) + total(rest) == abs(area_of(a))
        assert common == fathom.clip(a, b, algorithm="cgal") and rest == fathom.clip(a, b, "difference", algorithm="cgal")
        joined = fathom.clip(a, b, "union")
        assert total(joined) + total(common) == abs(area_of(a)) + abs(area_of(b))
        assert joined == fathom.clip(a, b, "union", algorithm="cgal")


def test_holes_floats_and_strings():
    frame = [[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (1, 3), (3, 3), (3, 1)]]
    assert total(fathom.clip(frame, [[(0, 0), (4, 0), (4, 4), (0, 4)]])) == 12
    square = [[(0.1, 0.1), (0.2, 0.1), (0.2, 0.2), (0.1, 0.2)]]
    side = Fraction(0.2) - Fraction(0.1)
    assert total(fathom.clip(square, [[(0, 0), (1, 0), (1, 1), (0, 1)]])) == side**2
    assert total(fathom.clip([[("1/3", 0), (1, 0), (1, 1)]], [[(0, 0), (9, 0), (9, 9)]])) == Fraction(1, 3)
    huge = 10**400
    assert total(fathom.clip([[(0, 0), (huge, 0), (0, huge)]], [[(0, 0), (huge, 0), (huge, huge)]])) == Fraction(huge**2, 4)


@pytest.mark.parametrize("number, exact", [
    (np.int64(2**53 + 1), Fraction(2**53 + 1)),
    (np.uint64(2**64 - 1), Fraction(2**64 - 1)),
    (Decimal("0.1"), Fraction(1, 10)),
    ("0.1", Fraction(1, 10)),
    (0.1, Fraction(3602879701896397, 2**55)),
    (np.float32(0.1), Fraction(13421773, 2**27)),
    (np.longdouble(1) + np.finfo(np.longdouble).eps, 1 + Fraction(2) ** np.finfo(np.longdouble).machep),
])
def test_no_number_is_rounded(number, exact):
    rings = [[(0, 0), (number, 0), (0, 1)]]
    window = [[(0, 0), (2**65, 0), (0, 2**65)]]
    assert total(fathom.clip(rings, window)) == area_of(rings) == exact / 2


@pytest.mark.parametrize("value", [None, 1j, [1], object()])
def test_what_is_no_number(value):
    with pytest.raises(TypeError, match="subject: expected coordinates of int, float, Fraction, Decimal or str, found"):
        fathom.clip([[(0, 0), (1, 0), (value, 1)]], [])


square = [(0, 0), (2, 0), (2, 2), (0, 2)]


@pytest.mark.parametrize("ring, words", [
    ([(0, 0), (2, 2), (2, 0), (0, 2)], "is not simple: its edges 0 and 2 meet at"),  # a bowtie
    ([(0, 0), (2, 0), (2, 2), (3, 3), (2, 2), (0, 2)], "is not simple"),  # a spike
    (square * 2, "is not simple"),
    ([(0, 0), (1, 0), (2, 0)], "its corners lie on one line"),
    ([], "0 distinct corners; expected at least 3"),
])
def test_rings_that_are_refused(ring, words):
    with pytest.raises(fathom.InputError, match=f"subject ring 0 .*{words}"):
        fathom.clip([ring], [square])
    with pytest.raises(fathom.InputError, match="subject rings 0 and 1 cross"):
        fathom.clip([square, [(1, 1), (3, 1), (3, 3), (1, 3)]], [square])


def test_rings_that_are_taken():
    everything = [[(-9, -9), (9, -9), (9, 9), (-9, 9)]]
    for rings, area in [
        ([[*square, square[0]]], 4),  # a corner repeated
        ([[(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)]], 4),  # a straight corner
        ([square, [(2, 2), (4, 2), (4, 4), (2, 4)]], 8),  # touching in a point
        ([square, [(2, 0), (4, 0), (4, 2), (2, 2)]], 8),  # along an edge
        ([square, square], 0),  # equal: even-odd
    ]:
        assert total(fathom.clip(rings, everything)) == area


@pytest.mark.parametrize("rings", [[[(0, 0, 0)]], [[(0, float("nan"))]], 5, [[(0, "x")]], [[(0, "1/0")]]])
def test_what_is_no_polygon(rings):
    with pytest.raises(ValueError, match="subject: expected a list of rings"):
        fathom.clip(rings, [[(0, 0), (1, 0), (0, 1)]])


def test_names():
    with pytest.raises(ValueError, match="operation: expected 'intersection', 'difference', 'union', found 'xor'"):
        fathom.clip([], [], "xor")
    assert fathom.clip([], []) == []
