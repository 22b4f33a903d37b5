"""Deep maps: every visible fragment of every pixel."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import as_count, camera_handle, one_of, scene_handle
from ._files import Path, make_folder_of
from ._render import Cull, culls, most_threads

if TYPE_CHECKING:
    import numpy.typing as npt

    from .camera import Camera
    from .scene import Scene


class DeepMap:
    """The visible fragments of every pixel, as arrays of one element per fragment: those of a pixel follow each
    other, nearest first, and pixels row by row.

    Z, ZBack  float32: planar depth of a fragment's nearest and of its farthest visible point, in scene units
    area      float32: the fraction of the pixel where it is visible; A: over what the ones before it leave
    id        uint32: of its triangle
    offsets   uint64, H·W + 1 of them: the fragments of pixel (x, y) are offsets[y·W + x] to offsets[y·W + x + 1]
    camera    the Camera that sees them
    """

    def __init__(self, arrays: dict[str, npt.NDArray[Any]], camera: Camera, _description: _core.Map) -> None:
        self.Z = arrays["Z"]
        self.ZBack = arrays["ZBack"]
        self.area = arrays["area"]
        self.A = arrays["A"]
        self.id = arrays["id"]
        self.offsets = arrays["offsets"]
        self.camera = camera
        self._description = _description

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """H×W: how many fragments each pixel has."""
        return np.diff(self.offsets.astype(np.int64)).reshape(self.camera.height, self.camera.width)

    @property
    def metadata(self) -> dict[str, str]:
        """The texts that its file has: fathom.camera, fathom.sources, …"""
        return dict(self._description.texts)

    def at(self, x: int, y: int) -> slice:
        """Where the fragments of a pixel are: deep.Z[deep.at(3, 5)]."""
        pixel = as_count("y", y, 0, self.camera.height - 1) * self.camera.width
        pixel += as_count("x", x, 0, self.camera.width - 1)
        return slice(int(self.offsets[pixel]), int(self.offsets[pixel + 1]))

    def write(self, file: Path, *, compression: str = "zips", threads: int = 0) -> None:
        """Writes a deep EXR with channels A, Z, ZBack, area and id, as compositing programs read it. `compression` is
        zips, rle or none."""
        counts = self.counts
        if (counts < 0).any() or counts.sum() != len(self.Z) or int(self.offsets[0]) != 0:
            raise ValueError("offsets: expected numbers that rise from 0 to that of the fragments")
        Z, ZBack, area, A = (self._column(name, np.float32) for name in ("Z", "ZBack", "area", "A"))
        id = self._column("id", np.uint32)
        make_folder_of(file)
        _core.write_deep(self._description, Z, ZBack, area, A, id, np.ascontiguousarray(counts, np.uint32),
                         os.fspath(file), compression, as_count("threads", threads, 0, most_threads))

    def _column(self, name: str, kind: type[np.generic]) -> npt.NDArray[Any]:
        column = getattr(self, name)
        if not isinstance(column, np.ndarray) or column.dtype != kind or column.shape != self.Z.shape or column.ndim != 1:
            raise ValueError(f"{name}: expected an array of {np.dtype(kind)}, a number for each fragment")
        return np.ascontiguousarray(column)

    def __repr__(self) -> str:
        return f"DeepMap({self.camera.width}×{self.camera.height}, {len(self.Z)} fragments)"


def render_deep(scene: Scene, camera: Camera, *, cull: Cull = "none", threads: int = 0) -> DeepMap:
    """The visible fragments of every pixel, with their exact areas, each rounded once to float32.

    >>> import fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh([(0, 0, 1), (2, 0, 1), (0, 2, 1)], [(0, 1, 2)])
    >>> camera = fathom.Camera(2, 2, 1, 1, 0, 0, pixel_centre=0.5, projection="orthographic")
    >>> deep = render_deep(scene, camera)
    >>> deep.counts.tolist(), deep.area.tolist()
    ([[1, 1], [1, 0]], [1.0, 0.5, 0.5])
    """
    arrays, description = _core.deep(scene_handle(scene), camera_handle(camera), one_of("cull", cull, culls),
                                     as_count("threads", threads, 0, most_threads))
    return DeepMap(arrays, camera, description)
