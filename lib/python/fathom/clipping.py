"""Clipping of polygons by polygons, exactly: nothing is rounded."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from . import _core
from ._arguments import one_of

if TYPE_CHECKING:
    import numpy as np

#: Types taken as exact numbers; a str is read like by Fraction: "1/3", "0.1".
Number = Union[int, float, Fraction, Decimal, str, "np.integer[Any]", "np.floating[Any]"]
Point = tuple[Fraction, Fraction]
#: The corners of a closed polyline; the first is not repeated.
Ring = list[Point]


class Polygon(NamedTuple):
    """An outline, counter-clockwise if y points up, and its holes, clockwise."""

    outline: Ring
    holes: list[Ring]

    @property
    def area(self) -> Fraction:
        return area_of([self.outline, *self.holes])


def clip(
    subject: Iterable[Sequence[Sequence[Number]]],
    window: Iterable[Sequence[Sequence[Number]]],
    operation: str = "intersection",
    *,
    algorithm: str = "weiler-atherton",
) -> list[Polygon]:
    """Intersection, difference or union of two polygons. Each polygon is a list of rings (outlines and holes), by the
    even-odd rule. Exact: numbers (int, float, Fraction, Decimal, NumPy's, "1/3") are not rounded.

    A ring must be simple: it has at least three corners, not all on one line, and does not meet itself (no bowtie, no
    spike). Corners may be repeated or lie on a straight edge. Rings of one polygon may be equal or touch, in points or
    along edges, but must not cross. The position of the two polygons relative to each other is free, and a polygon may
    have no rings. Parts of the result without area are dropped.

    operation  "intersection", "difference" (subject without window) or "union"
    algorithm  "weiler-atherton", or "cgal" for CGAL's Boolean operations as a check: equal regions give equal lists

    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> [piece.area for piece in clip([square], [[(1, 1), (Fraction(7, 3), 1), (1, 3)]])]
    [Fraction(11, 12)]

    Raises InputError, which names the ring, if a ring violates these rules; ValueError if the arguments are not rings of
    finite numbers; TypeError for coordinates of other types.
    """
    one_of("operation", operation, ("intersection", "difference", "union"))
    one_of("algorithm", algorithm, ("weiler-atherton", "cgal"))
    found = _core.clip(_rings("subject", subject), _rings("window", window), operation,
                       algorithm == "cgal")
    return [Polygon(_ring(outline), [_ring(hole) for hole in holes]) for outline, holes in found]


def area_of(rings: Iterable[Sequence[Sequence[Number]]]) -> Fraction:
    """The signed area of rings; counter-clockwise rings are positive."""
    twice = Fraction(0)
    for ring in rings:
        points = [(_exact("rings", x), _exact("rings", y)) for x, y in ring]
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            twice += ax * by - bx * ay
    return twice / 2


def _rings(name: str, rings: Iterable[Sequence[Sequence[Number]]]) -> list[list[Any]]:
    try:
        points = [[(x, y) for x, y in ring] for ring in rings]
    except (TypeError, ValueError):
        raise ValueError(f"{name}: {_expected_rings}") from None
    return [[(_parts(_exact(name, x)), _parts(_exact(name, y))) for x, y in ring] for ring in points]


_expected_rings = "expected a list of rings, each a list of (x, y) of finite numbers"


def _exact(name: str, value: Any) -> Fraction:
    try:
        if isinstance(value, numbers.Integral):
            return Fraction(int(value))
        if isinstance(value, numbers.Rational):
            return Fraction(int(value.numerator), int(value.denominator))
        if isinstance(value, (str, Decimal)):
            return Fraction(value)
        if hasattr(value, "as_integer_ratio"):
            return Fraction(*value.as_integer_ratio())
    except (ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"{name}: {_expected_rings}, found {value!r}") from None
    raise TypeError(f"{name}: expected coordinates of int, float, Fraction, Decimal or str, found {value!r}")


def _parts(number: Fraction) -> tuple[int, int]:
    return number.numerator, number.denominator


def _ring(points: list[Any]) -> Ring:
    return [(Fraction(*x), Fraction(*y)) for x, y in points]
