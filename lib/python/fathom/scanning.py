"""Scan conversion: lines, polygons and triangles to pixels, as `fathom scan` does it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np

from ._answers import Answer, answer_of, as_arguments, case_of
from ._arguments import as_count, one_of
from ._core import InputError, UsageError

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers = Union[Sequence[Any], npt.NDArray[Any]]

Arithmetic = Literal["exact", "float64", "float32"]
Ties = Literal["greater", "even", "stay"]
Edges = Literal["top-left", "closed"]


def algorithms() -> list[str]:
    """The names of the algorithms of scan().

    >>> "midpoint" in algorithms()
    True
    """
    from . import _textbook

    return _textbook.scan_algorithms()


def scan(
    algorithm: str,
    *,
    line: Numbers | None = None,
    polygon: Numbers | None = None,
    triangle: Numbers | None = None,
    points: Numbers | None = None,
    grid: Sequence[str] | None = None,
    seed: Numbers | None = None,
    connectivity: int | None = None,
    width: int | None = None,
    height: int | None = None,
    attributes: Numbers | None = None,
    w: Numbers | None = None,
    parameters: Numbers | None = None,
    weights: Numbers | None = None,
    name: str | None = None,
    arithmetic: Arithmetic = "exact",
    ties: Ties | None = None,
    edges: Edges | None = None,
    subpixel_bits: int | None = None,
    runs: bool = False,
    trace: bool = False,
    draw: bool = False,
) -> Answer:
    """Rasterizes a case by an algorithm of the textbooks. Arguments and answer are those of `fathom scan`; docs/scan.md
    has every algorithm's keys, answer and trace.

    algorithm   lines: explicit, dda, bresenham, midpoint, diamond-exit, line-forms; polygons: even-odd, non-zero,
                inside, convexity, tessellate; points: convex-hull; triangles: edge-function, scan-line, edge-values;
                grids: flood
    line        (x0, y0, x1, y1): pixels; places for diamond-exit
    polygon     a list of rings, each of shape N×2; triangle: 3×2; points: N×2
    width, height   of the window in pixels, which limits the answer
    attributes, w   a list of numbers for each corner, and each corner's w: values at the pixels, perspective with w
    arithmetic  exact, float64 or float32
    ties        of lines half way between two pixels: greater (default), even, stay
    edges       of triangles, to whom centres on an edge belong: top-left (default), closed
    subpixel_bits   triangles are snapped to 2^N positions a pixel, 0 to 16; None: not at all
    runs        "runs" [y, x_begin, x_end] in place of "pixels"
    trace       add the steps under "trace"
    draw        draw the steps: answer.svg, which a notebook shows

    Frame    the window in pixels, y down; pixel (x, y) has its centre at (x + ½, y + ½).
    Returns  a dict: "pixels" is an int64 array of shape N×2 (x, y), "runs" of N×3; other numbers are Fractions with
             arithmetic="exact", else floats. "values" of edge-values in float64 or float32 is an array of shape
             height×width×3.
    Exact    with arithmetic="exact": coordinates are taken as the numbers that they are, which have to be numbers of
             binary64.
    Raises   InputError for a case that cannot be done, UsageError for options that do not go together, ValueError and
             TypeError for arguments that are no numbers.
    Source   [Bre65], [Van84], [Pin88], [FvDFH90] in docs/bibliography.md

    >>> answer = scan("midpoint", line=(0, 0, 8, 3), trace=True)
    >>> [step["d"] for step in answer["trace"]["steps"]]
    [-2, 4, -6, 0, -10, -4, 2, -8, -2]
    >>> scan("edge-function", triangle=[(0, 0), (4, 0), (0, 4)], attributes=[[0], [1], [0]])["values"][0]
    [Fraction(1, 8)]
    """
    from . import _textbook

    one_of("algorithm", algorithm, algorithms())
    one_of("arithmetic", arithmetic, ("exact", "float64", "float32"))
    given = {
        "name": name, "line": line, "polygon": polygon, "triangle": triangle, "points": points, "grid": grid,
        "seed": seed, "connectivity": connectivity, "width": width, "height": height, "attributes": attributes,
        "w": w, "parameters": parameters, "weights": weights,
    }  # fmt: skip
    case = case_of({key: value for key, value in given.items() if value is not None})
    bits = None if subpixel_bits is None else as_count("subpixel_bits", subpixel_bits, 0, 16)
    try:
        request = _textbook.ScanRequest(
            algorithm, arithmetic, bool(trace), bool(runs), bool(draw), bits,
            None if ties is None else one_of("ties", ties, ("greater", "even", "stay")),
            None if edges is None else one_of("edges", edges, ("top-left", "closed")),
        )  # fmt: skip
        answer = answer_of(*_textbook.scan_case(case, request))
    except (InputError, UsageError) as error:
        raise as_arguments(error) from None
    if name is not None:
        answer["name"] = name
    for key, columns in (("pixels", 2), ("runs", 3)):
        if key in answer:
            answer[key] = np.array(answer[key], np.int64).reshape(-1, columns)
    if algorithm == "edge-values" and arithmetic != "exact":
        answer["values"] = np.array(answer["values"], np.float64)
    return answer
