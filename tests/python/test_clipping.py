"""fathom.clip(): exact areas, judged by inclusion and exclusion, and by CGAL."""

import random
from fractions import Fraction

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


def test_holes_floats_and_strings():
    frame = [[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (1, 3), (3, 3), (3, 1)]]
    assert total(fathom.clip(frame, [[(0, 0), (4, 0), (4, 4), (0, 4)]])) == 12
    square = [[(0.1, 0.1), (0.2, 0.1), (0.2, 0.2), (0.1, 0.2)]]
    side = Fraction(0.2) - Fraction(0.1)
    assert total(fathom.clip(square, [[(0, 0), (1, 0), (1, 1), (0, 1)]])) == side**2
    assert total(fathom.clip([[("1/3", 0), (1, 0), (1, 1)]], [[(0, 0), (9, 0), (9, 9)]])) == Fraction(1, 3)
    huge = 10**400
    assert total(fathom.clip([[(0, 0), (huge, 0), (0, huge)]], [[(0, 0), (huge, 0), (huge, huge)]])) == Fraction(huge**2, 4)


@pytest.mark.parametrize("rings", [[[(0, 0, 0)]], [[(0, float("nan"))]], 5, [[(0, "x")]], [[(0, "1/0")]]])
def test_what_is_no_polygon(rings):
    with pytest.raises(ValueError, match="subject: expected a list of rings"):
        fathom.clip(rings, [[(0, 0), (1, 0), (0, 1)]])


def test_names():
    with pytest.raises(ValueError, match="operation: expected 'intersection', 'difference', found 'union'"):
        fathom.clip([], [], "union")
    assert fathom.clip([], []) == []
