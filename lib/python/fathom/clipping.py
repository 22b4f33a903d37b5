"""Clipping of polygons by polygons, exactly: nothing is rounded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple, Union

from . import _core
from ._arguments import one_of

Number = Union[int, float, Fraction, str]
Point = tuple[Fraction, Fraction]
#: The corners of a closed polyline; the first is not repeated.
Ring = list[Point]


class Polygon(NamedTuple):
    """An outline, counter-clockwise where y is upwards, and its holes, clockwise."""

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
    """Intersection or difference of two polygons, each given as its rings, outlines and holes, by the even-odd rule.
    Numbers are taken as what they are: floats too. Any shape, degenerate ones too; parts of no area are dropped.

    operation  "intersection" or "difference"
    algorithm  "weiler-atherton", or "cgal" to have CGAL's Boolean operations judge it: equal regions are equal lists

    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> [piece.area for piece in clip([square], [[(1, 1), (Fraction(7, 3), 1), (1, 3)]])]
    [Fraction(11, 12)]
    """
    one_of("operation", operation, ("intersection", "difference"))
    one_of("algorithm", algorithm, ("weiler-atherton", "cgal"))
    found = _core.clip(_rings("subject", subject), _rings("window", window), operation == "difference",
                       algorithm == "cgal")
    return [Polygon(_ring(outline), [_ring(hole) for hole in holes]) for outline, holes in found]


def area_of(rings: Iterable[Sequence[Sequence[Number]]]) -> Fraction:
    """The signed area of rings: counter-clockwise ones count as positive."""
    twice = Fraction(0)
    for ring in rings:
        points = [(Fraction(x), Fraction(y)) for x, y in ring]
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            twice += ax * by - bx * ay
    return twice / 2


def _rings(name: str, rings: Iterable[Sequence[Sequence[Number]]]) -> list[list[Any]]:
    try:
        return [[(_exact(x), _exact(y)) for x, y in ring] for ring in rings]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"{name}: expected a list of rings, each a list of (x, y) of finite numbers") from None


def _exact(value: Any) -> tuple[int, int]:
    number = Fraction(value if isinstance(value, (int, Fraction, str)) else float(value))
    return number.numerator, number.denominator


def _ring(points: list[Any]) -> Ring:
    return [(Fraction(*x), Fraction(*y)) for x, y in points]
