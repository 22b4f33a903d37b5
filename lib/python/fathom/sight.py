"""Sight: which points see each other, and which points cameras see. Every decision is exact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arguments import as_array, as_finite, as_threads, camera_handle, culls, in_words, one_of
from ._rays import rows_of_three
from ._render import several_cameras
from .camera import Camera

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt

    from .names import Cull, EdgeRule

edge_rules = ("closed", "generic")


class SurfacePoints:
    """Points of triangles of a scene, each exactly A + v·(B − A) + w·(C − A) for a triangle ABC. Coordinates that were
    computed and rounded lie beside their surface, perhaps behind it; these points lie on it.

    triangles  numbers of triangles, as in channel "id"; any shape
    weights    v and w, the weights of the second and third corner, as in channel "bary": the same shape, then 2

    >>> from fathom import Scene
    >>> scene = Scene()
    >>> _ = scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)]), np.array([(0, 1, 2)]))
    >>> scene.sees((0, 0, 0), SurfacePoints([0, 0], [(0.1, 0.3), (0.7, 0.2)])).tolist()
    [True, True]

    Raises TypeError or ValueError, which name the argument.
    """

    __slots__ = ("triangles", "weights")
    triangles: npt.NDArray[np.uint32]
    weights: npt.NDArray[np.float64]

    def __init__(self, triangles: npt.ArrayLike, weights: npt.ArrayLike) -> None:
        numbers = as_array("triangles", triangles)
        if numbers.dtype.kind not in "iu" and numbers.size:
            raise TypeError(f"triangles: expected integers, found {numbers.dtype}")
        if numbers.size and not (0 <= int(numbers.min()) and int(numbers.max()) < _core.no_surface):
            raise ValueError(f"triangles: expected numbers from 0 to {_core.no_surface - 1}")
        given = as_finite("weights", weights)
        if given.shape != (*numbers.shape, 2):
            raise ValueError(f"weights: expected shape {in_words((*numbers.shape, 2))}, found {in_words(given.shape)}")
        self.triangles = np.ascontiguousarray(numbers, dtype=np.uint32).reshape(numbers.shape)
        self.weights = given

    def __len__(self) -> int:
        return len(self.triangles)

    def __repr__(self) -> str:
        return f"<fathom.SurfacePoints: {in_words(self.triangles.shape)}>"


class _Points(NamedTuple):
    """Rows as the extension module takes them: coordinates, and no triangles; or weights."""

    triangles: npt.NDArray[np.uint32]
    numbers: npt.NDArray[np.float64]
    shape: tuple[int, ...]

    def broadcast(self, shape: tuple[int, ...]) -> _Points:
        if shape == self.shape:
            return self
        rows = np.broadcast_to(np.arange(len(self.numbers)).reshape(self.shape), shape).ravel()
        return _Points(self.triangles[rows] if len(self.triangles) else self.triangles, self.numbers[rows], shape)


def _points_of(name: str, points: npt.ArrayLike | SurfacePoints) -> _Points:
    if isinstance(points, SurfacePoints):
        return _Points(points.triangles.ravel(), points.weights.reshape(-1, 2), points.triangles.shape)
    given = rows_of_three(name, points)
    return _Points(np.empty(0, np.uint32), np.ascontiguousarray(given.reshape(-1, 3)), given.shape[:-1])


def sees(rays: _core.Rays, eyes: npt.ArrayLike | SurfacePoints, points: npt.ArrayLike | SurfacePoints, pairs: bool,
         edges: EdgeRule, threads: int) -> npt.NDArray[np.bool_]:
    from_, to = _points_of("eyes", eyes), _points_of("points", points)
    shape = from_.shape + to.shape
    if pairs:
        try:
            shape = np.broadcast_shapes(from_.shape, to.shape)
        except ValueError:
            raise ValueError(f"points: the shape {in_words(to.shape)} does not fit {in_words(from_.shape)} of eyes; "
                             "pairs=False is for all eyes and all points") from None
        from_, to = from_.broadcast(shape), to.broadcast(shape)
    found = _core.sees(rays, *from_[:2], *to[:2], bool(pairs), one_of("edges", edges, edge_rules), as_threads(threads))
    return found.reshape(shape).astype(bool)


def seen_by(rays: _core.Rays, points: npt.ArrayLike | SurfacePoints, cameras: Camera | Iterable[Camera], cull: Cull,
            threads: int) -> npt.NDArray[np.bool_]:
    given = _points_of("points", points)
    several: list[Any] = [cameras] if isinstance(cameras, Camera) else several_cameras("cameras", cameras)
    handles = [camera_handle(each) for each in several]
    found = _core.seen_by(rays, *given[:2], handles, one_of("cull", cull, culls), as_threads(threads))
    return found.reshape((*given.shape, len(handles))).astype(bool)
