"""Metrics that compare a reconstructed surface with the true surface."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from typing import TYPE_CHECKING, NamedTuple

from . import _core
from ._arguments import as_count, as_number, as_threads, camera_handle, culls, one_of, scene_handle, vertices_of
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
    point is seen. Either surface may be a point cloud."""

    #: Points put on the surface or left in the cloud, and points that a camera sees; only the latter count.
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
    #: Points of a point cloud before it was thinned; 0 for a surface.
    cloud_points: int
    #: Seen points at `max_distance` or more: left out of mean to max, but not of `shares`.
    outliers: int

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
    #: The mean of both means, as in DTU's tables; None if no point is left on one side.
    overall: float | None
    #: The table that `fathom evaluate` prints.
    table: str

    def __repr__(self) -> str:
        return f"Evaluation:\n{self.table.rstrip()}"


def evaluate(reconstruction: Scene | npt.ArrayLike, truth: Scene | npt.ArrayLike,
             cameras: Camera | Iterable[Camera] = (), *, within: Iterable[float] = (), points: int = 200_000,
             density: float | None = None, truth_density: float | None = None, max_distance: float | None = None,
             keep_points: bool = False, cull: Cull = "none", threads: int = 0) -> Evaluation:
    """Compares a reconstructed surface with the true surface, in the same world and unit: Depth L1 and related figures
    from exact depth maps of every camera, and distances of points on each surface from the other surface. Either side
    may be a point cloud: an N×3 array, or a Scene with vertices and no faces.

    cameras      points count if a camera sees them on their own surface; without cameras all points count, and there are
                 no depth figures. Points of a cloud always count, and a cloud has no depth figures
    within       thresholds in scene units, for the fraction of points that are nearer
    points       number of points on each surface, distributed by area; always the same points. All points of a cloud
                 are measured
    density      thins the cloud `reconstruction` first: in its order, drops each point that is nearer than this to a
                 point already kept
    truth_density  thins the cloud `truth` in the same way
    max_distance  points at this distance or more are outliers, which only `shares` count
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
    >>> fathom.evaluate([(0, 0, 2.5), (0, 0, 6)], truth, max_distance=1).accuracy.mean
    0.5
    """
    depth, accuracy, completeness, f_scores, overall, table = _core.evaluate(
        _side("reconstruction", reconstruction), _side("truth", truth), _handles(cameras), _thresholds(within),
        as_count("points", points, 1, 2**32 - 1), _positive("density", density),
        _positive("truth_density", truth_density), _positive("max_distance", max_distance), bool(keep_points),
        one_of("cull", cull, culls), as_threads(threads))
    return Evaluation(None if depth is None else Depth(*depth), Distances(*accuracy), Distances(*completeness),
                      f_scores, overall, table)


def _side(name: str, side: object) -> _core.Scene:
    """A scene, or the points of a cloud as the vertices of a mesh without faces."""
    if hasattr(side, "_handle"):
        return scene_handle(side)
    if isinstance(side, (str, bytes, PathLike)):
        raise TypeError(f"{name}: expected a Scene or an N×3 array, found {side!r}; Scene.read() reads files")
    import numpy as np

    cloud = _core.Scene()
    mesh = cloud.add_mesh(vertices_of(side, name), np.empty((0, 3), np.uint32))
    cloud.add_object(mesh, None, name)
    return cloud


def _positive(name: str, value: object) -> float | None:
    if value is None:
        return None
    number = as_number(name, value)
    if not 0 < number < float("inf"):
        raise ValueError(f"{name}: expected a positive number, found {value!r}")
    return number


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
