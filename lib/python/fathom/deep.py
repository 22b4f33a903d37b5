"""Deep maps: every visible fragment of every pixel."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import as_count, as_text, as_threads, camera_handle, culls, in_pixels, one_of, scene_handle
from ._files import Path, make_folder_of, path_of
from ._shown import share_of
from .maps import camera_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from .camera import Camera
    from .names import Cull, DeepCompression
    from .scene import Scene


class DeepMap:
    """The visible fragments of every pixel, as arrays with one element per fragment: pixels row by row, and the fragments
    of a pixel nearest first.

    Z, ZBack  float32: planar depth of a fragment's nearest and farthest visible point, in scene units
    area      float32: fraction of the pixel in which the fragment is visible
    A         float32: area divided by the part of the pixel that nearer fragments leave free
    id        uint32: number of the fragment's triangle
    offsets   uint64, H·W + 1 numbers: the fragments of pixel (x, y) are offsets[y·W + x] to offsets[y·W + x + 1]
    camera    the deep map's Camera
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

    @classmethod
    def read(cls, file: Path) -> DeepMap:
        """Reads a deep EXR that write() or `fathom render --deep` has written: the same numbers, bit for bit. Raises
        InputError, which names the file."""
        arrays, description = _core.read_deep(path_of("file", file))
        camera = camera_of(description)
        if camera is None:
            raise _core.InputError(f"{os.fsdecode(file)}: it carries no camera, as deep maps of Fathom do")
        return cls(arrays, camera, description)

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """H×W: the number of fragments of each pixel."""
        return np.diff(self.offsets.astype(np.int64)).reshape(self.camera.height, self.camera.width)

    @property
    def metadata(self) -> dict[str, str]:
        """The texts of its file: fathom.camera, fathom.sources, …"""
        return self._description.texts_of_file()

    def at(self, x: int, y: int) -> slice:
        """The slice with the fragments of a pixel: deep.Z[deep.at(3, 5)]."""
        pixel = as_count("y", y, 0, self.camera.height - 1) * self.camera.width
        pixel += as_count("x", x, 0, self.camera.width - 1)
        return slice(int(self.offsets[pixel]), int(self.offsets[pixel + 1]))

    def write(self, file: Path, *, compression: DeepCompression = "zips", threads: int = 0) -> None:
        """Writes a deep EXR with channels A, Z, ZBack, area and id, for compositing programs. `compression` is "zips",
        "rle" or "none".

        Raises ValueError unless the name ends in .exr, and if changed arrays do not fit such a file: NaN, fragments of a
        pixel not nearest first, ZBack nearer than Z.
        """
        path = path_of("file", file)
        if not os.fsdecode(path).lower().endswith(".exr"):
            raise ValueError(f"{os.fsdecode(file)}: expected a name that ends in .exr")
        drawn = self._description.width, self._description.height
        if self.camera.size != drawn:
            sizes = f"{in_pixels(self.camera.size)} pixels, the deep map {in_pixels(drawn)} pixels"
            raise ValueError(f"camera: its image has {sizes}")
        counts = self.counts
        if (counts < 0).any() or counts.sum() != len(self.Z) or int(self.offsets[0]) != 0:
            raise ValueError("offsets: expected numbers that rise from 0 to the number of fragments")
        Z, ZBack, area, A = (self._numbers(name) for name in ("Z", "ZBack", "area", "A"))
        id = self._column("id", np.uint32)
        self._expect_nearest_first(Z, ZBack)
        make_folder_of(file)
        _core.write_deep(self._description, Z, ZBack, area, A, id, np.ascontiguousarray(counts, np.uint32),
                         path, as_text("compression", compression), as_threads(threads))

    def _column(self, name: str, kind: type[np.generic]) -> npt.NDArray[Any]:
        column = getattr(self, name)
        if not isinstance(column, np.ndarray) or column.dtype != kind or column.shape != self.Z.shape or column.ndim != 1:
            raise ValueError(f"{name}: expected an array of {np.dtype(kind)}, a number for each fragment")
        return np.ascontiguousarray(column)

    def _numbers(self, name: str) -> npt.NDArray[np.float32]:
        column = self._column(name, np.float32)
        not_numbers = np.isnan(column)
        if not_numbers.any():
            raise ValueError(f"{name}: fragment {int(np.argmax(not_numbers))} has NaN")
        return column

    def _expect_nearest_first(self, Z: npt.NDArray[np.float32], ZBack: npt.NDArray[np.float32]) -> None:
        with _core.standard_arithmetic():  # or else subnormal depths might be equal
            nearer, inverted = Z[1:] < Z[:-1], ZBack < Z
        # The first fragment of a pixel follows none.
        first = self.offsets.astype(np.int64)
        nearer[first[(first > 0) & (first < len(Z))] - 1] = False
        if nearer.any():
            raise ValueError(f"Z: fragment {int(np.argmax(nearer)) + 1} is nearer than the one before it in its pixel; "
                             "expected the nearest first")
        if inverted.any():
            raise ValueError(f"ZBack: fragment {int(np.argmax(inverted))} ends nearer than its Z")

    def __repr__(self) -> str:
        size = in_pixels(self.camera.size)
        with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
            depths = f"; Z: {self.Z.min():.6g} to {self.ZBack.max():.6g}" if len(self.Z) else ""
            counts = self.counts
            return (f"DeepMap({size} pixels; {len(self.Z)} fragments, up to {counts.max()} in a pixel{depths}; "
                    f"surface in {share_of(int((counts > 0).sum()), counts.size)})")


def render_deep(scene: Scene, camera: Camera, *, cull: Cull = "none", threads: int = 0) -> DeepMap:
    """Renders the visible fragments of every pixel, with their exact areas; each number is rounded once to float32.

    >>> import fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh([(0, 0, 1), (2, 0, 1), (0, 2, 1)], [(0, 1, 2)])
    >>> camera = fathom.Camera(2, 2, 1, 1, 0, 0, pixel_centre=0.5, projection="orthographic")
    >>> deep = render_deep(scene, camera)
    >>> deep.counts.tolist(), deep.area.tolist()
    ([[1, 1], [1, 0]], [1.0, 0.5, 0.5])
    """
    arrays, description = _core.deep(scene_handle(scene), camera_handle(camera), one_of("cull", cull, culls),
                                     as_threads(threads))
    return DeepMap(arrays, camera, description)
