"""Scan conversion: lines, polygons and triangles to pixels, like `fathom scan`."""

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
    """Rasterizes a case by an algorithm of the textbooks. Arguments and answer are the same as for `fathom scan`;
    docs/scan.md describes every algorithm's keys, answer and trace.

    algorithm   lines: explicit, dda, bresenham, midpoint, diamond-exit, line-forms; polygons: even-odd, non-zero,
                inside, convexity, tessellate; points: convex-hull; triangles: edge-function, scan-line, edge-values;
                grids: flood
    line        (x0, y0, x1, y1) in whole pixels; for diamond-exit and line-forms any coordinates
    polygon     a list of rings, each of shape N×2; triangle: 3×2; points: N×2
    width, height  size of the window in pixels; the answer is limited to it
    attributes, w  a list of numbers for each corner, and each corner's w, to interpolate at the pixels (perspective if w
                is given)
    arithmetic  exact, float64 or float32
    ties        pixel of a line half way between two pixels: greater (default), even, stay
    edges       triangles that own a centre on an edge: top-left (default), closed
    subpixel_bits  snap triangles to 2^N positions per pixel, 0 to 16; None: no snapping
    runs        return "runs" [y, x_begin, x_end] instead of "pixels"
    trace       add the steps as "trace"
    draw        draw the steps: answer.svg, which a notebook shows

    Frame    the window in pixels, y down; pixel (x, y) has its centre at (x + ½, y + ½).
    Returns  a dict: "pixels" is an int64 array of shape N×2 (x, y), "runs" of shape N×3. Other numbers are Fractions with
             arithmetic="exact", otherwise floats. "values" of edge-values in float64 or float32 is an array of shape
             height×width×3.
    Exact    with arithmetic="exact": coordinates are exact numbers and must be representable in binary64.
    Raises   InputError for a case that the algorithm cannot process, UsageError for options that exclude each other,
             ValueError and TypeError for arguments that are not numbers.
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
