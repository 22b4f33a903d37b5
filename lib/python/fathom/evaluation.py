"""Metrics that compare a reconstructed surface with the true surface."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from . import _core
from ._arguments import as_count, as_number, as_threads, camera_handle, culls, one_of, scene_handle
from ._render import several_cameras
from ._shown import repr_without_arrays
from .camera import Camera

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from .names import Cull
    from .scene import Scene


class Depth(NamedTuple):
    """Agreement of the reconstruction's exact depths with the true depths, over all views; lengths in scene units."""

    views: int
    #: Pixels that show both surfaces, or only one surface.
    both: int
    only_truth: int
    only_reconstruction: int
    #: Depth L1: the mean of |d − t| over the pixels that show both. The next seven figures are over the same pixels.
    l1: float
    rmse: float
    rmse_log: float
    abs_rel: float
    sq_rel: float
    #: Shares with max(d / t, t / d) below 1.25, 1.25², 1.25³.
    delta_1: float
    delta_2: float
    delta_3: float
    #: Depth L1 with depth 0 for "no surface" and equal weights for all views: over all pixels, as NICE-SLAM computes it;
    #: and over the pixels that show the truth, in views with more than 100 such pixels, as neural_slam_eval computes it.
    l1_of_all_pixels: float
    l1_of_truth_pixels: float
    views_of_truth: int


class Distances(NamedTuple):
    """Distances of points on one surface from the other surface, in scene units, each exact, rounded once; 0 if no
    point is seen."""

    #: Points put on the surface, and points that a camera sees; only the latter count.
    points: int
    seen: int
    mean: float
    rms: float
    median: float
    p90: float
    p99: float
    max: float
    #: For each threshold, the fraction of the points that are nearer.
    shares: tuple[float, ...]
    #: With `keep_points`, the points that count, (seen, 3), and their distances, (seen,); otherwise None.
    positions: npt.NDArray[np.float64] | None
    distances: npt.NDArray[np.float64] | None

    def __repr__(self) -> str:
        return repr_without_arrays(self)


class Evaluation(NamedTuple):
    #: None without cameras.
    depth: Depth | None
    #: From the reconstruction to the truth; its `shares` are the precision.
    accuracy: Distances
    #: From the truth to the reconstruction; its `shares` are the completion ratio, or recall.
    completeness: Distances
    #: For each threshold the harmonic mean of precision and recall.
    f_scores: tuple[float, ...]


def evaluate(reconstruction: Scene, truth: Scene, cameras: Camera | Iterable[Camera] = (), *,
             within: Iterable[float] = (), points: int = 200_000, keep_points: bool = False, cull: Cull = "none",
             threads: int = 0) -> Evaluation:
    """Compares a reconstructed surface with the true surface, in the same world and unit: Depth L1 and related figures
    from exact depth maps of every camera, and distances of points on each surface from the other surface.

    cameras      points count if a camera sees them on their own surface; without cameras all points count, and there are
                 no depth figures
    within       thresholds in scene units, for the fraction of points that are nearer
    points       number of points on each surface, distributed by area; always the same points
    keep_points  return every point that counts, with its distance

    >>> import fathom
    >>> square = [(-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)]
    >>> truth, scan = fathom.Scene(), fathom.Scene()
    >>> _ = truth.add_mesh(square, [(0, 1, 2), (0, 2, 3)])
    >>> _ = scan.add_mesh([(x, y, 2.25) for x, y, _ in square], [(0, 1, 2), (0, 2, 3)])
    >>> camera = fathom.Camera(64, 64, 32, 32, 32, 32, pixel_centre=0.5)
    >>> found = fathom.evaluate(scan, truth, camera, within=[0.5], points=1000)
    >>> found.depth.l1, found.accuracy.mean, found.f_scores
    (0.25, 0.25, (1.0,))
    """
    depth, accuracy, completeness, f_scores = _core.evaluate(
        scene_handle(reconstruction), scene_handle(truth), _handles(cameras), _thresholds(within),
        as_count("points", points, 1, 2**32 - 1), bool(keep_points), one_of("cull", cull, culls), as_threads(threads))
    return Evaluation(None if depth is None else Depth(*depth), Distances(*accuracy), Distances(*completeness), f_scores)


def _handles(cameras: object) -> list[_core.Camera]:
    listed = [cameras] if isinstance(cameras, Camera) else several_cameras("cameras", cameras)
    return [camera_handle(each) for each in listed]


def _thresholds(within: object) -> list[float]:
    if isinstance(within, (str, bytes)) or not isinstance(within, Iterable):
        raise TypeError(f"within: expected numbers, found {within!r}")
    thresholds = [as_number("within", each) for each in within]
    for each in thresholds:
        if not 0 < each < float("inf"):
            raise ValueError(f"within: expected positive numbers, found {each!r}")
    return thresholds
