"""Exact answers about a scene and a camera, in addition to maps."""

from __future__ import annotations

import os
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arguments import as_count, as_number, as_threads, camera_handle, culls, edge_selections, one_of, scene_handle
from ._core import OutputError
from ._files import make_folder_of, path_of
from ._render import rendered, stored_type
from .maps import Map

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._files import Path
    from .camera import Camera
    from .names import Cull, EdgeSelection
    from .scene import Scene


class CoveringTriangle(NamedTuple):
    """A triangle that covers the centre of a pixel."""

    #: Its number in the scene, as in channel `id`.
    id: int
    object: int
    #: Its number within its object's mesh, and the number of its face within its file.
    triangle: int
    face: int
    front_facing: bool
    #: The exact planar depth at the centre, in scene units. Under a lens it may be irrational: then it is a fraction
    #: that differs from the exact depth by at most 2**-180 of it.
    depth: Fraction
    #: Whether it can be visible: it is in front of the camera, within near and far, and not culled.
    counts: bool
    #: The signs of the edge functions: 1 inside, 0 on the edge.
    edges: tuple[int, int, int]
    #: The arithmetic that settles its orientation, and then each sign of `edges`: an interval by CGAL, or dyadic numbers
    #: if the interval does not settle the sign. The depth is always computed with dyadic numbers.
    decided_by: tuple[str, str, str, str]


def probe(scene: Scene, camera: Camera, x: int, y: int, *, cull: Cull = "none") -> list[CoveringTriangle]:
    """Every triangle that covers the centre of the pixel in column `x` and row `y` from the top left: nearest first,
    ties by number, and last the triangles that do not count. The first triangle that counts is visible. Empty where a
    lens gives the pixel no ray.

    >>> import fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh([(0, 0, 3), (9, 0, 3), (0, 9, 4)], [(0, 1, 2)])
    >>> camera = fathom.Camera(8, 8, 8, 8, 0, 0, pixel_centre=0.5)
    >>> probe(scene, camera, 2, 2)[0].depth
    Fraction(432, 139)
    """
    scene_handle(scene), camera_handle(camera)
    column = as_count("x", x, 0, camera.width - 1)
    row = as_count("y", y, 0, camera.height - 1)
    found = _core.probe(scene_handle(scene), camera_handle(camera), column, row, one_of("cull", cull, culls))
    return [_covering(*each) for each in found]


def _covering(id: int, object: int, triangle: int, face: int, front_facing: bool, depth: tuple[int, int, int, int],
              counts: bool, edges: tuple[int, int, int], decided_by: tuple[str, str, str, str]) -> CoveringTriangle:
    return CoveringTriangle(id, object, triangle, face, front_facing, _fraction(*depth), counts, edges, decided_by)


def _fraction(m: int, e: int, n: int, f: int) -> Fraction:
    """m·2^e / (n·2^f)"""
    power = e - f
    return Fraction(m << max(power, 0), n << max(-power, 0))


class PixelAreas(NamedTuple):
    """Areas in pixels, exact, rounded once to float64; index i is triangle or object i."""

    #: Area in which it is visible.
    visible: npt.NDArray[np.float64]
    #: Area in which it would be visible without all other triangles or objects.
    unoccluded: npt.NDArray[np.float64]
    #: visible / unoccluded; NaN without unoccluded area.
    ratio: npt.NDArray[np.float64]

    def __repr__(self) -> str:
        with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
            shown = int((self.visible > 0).sum())
            areas = f": {self.visible[self.visible > 0].min():.6g} to {self.visible.max():.6g} pixels" if shown else ""
            return f"PixelAreas({shown} of {len(self.visible)} visible{areas}, {self.visible.sum():.6g} pixels together)"


class VisibleAreas(NamedTuple):
    triangles: PixelAreas
    objects: PixelAreas


def visible(scene: Scene, camera: Camera, *, cull: Cull = "none", threads: int = 0) -> VisibleAreas:
    """The exact visible area of every triangle and every object, in pixels of the image."""
    triangles, objects = _core.visible(scene_handle(scene), camera_handle(camera), one_of("cull", cull, culls),
                                       as_threads(threads))
    return VisibleAreas(PixelAreas(*triangles), PixelAreas(*objects))


def draw(scene: Scene, camera: Camera, path: Path, *, edges: EdgeSelection = "creases", crease_angle: float = 30,
         stroke: float = 1, cull: Cull = "none", threads: int = 0) -> None:
    """Writes the visible edges as a drawing: a file .svg or .pdf with a layer for each object. Visibility is exact; ends of
    lines are rounded once.

    `edges` are outlines ("silhouettes"), also edges at which a surface turns by at least `crease_angle` degrees
    ("creases"), or "all" edges of triangles. `stroke` is the width of the lines in pixels. Raises UsageError for a camera
    with a lens that bends rays, OutputError if the file cannot be written.
    """
    file = path_of("path", path)
    suffix = os.fsdecode(file)[-4:]
    if suffix not in (".svg", ".pdf"):
        raise ValueError(f"path: expected a name that ends in .svg or .pdf, found {file!r}")
    drawing = _core.draw(scene_handle(scene), camera_handle(camera), one_of("edges", edges, edge_selections),
                         as_number("crease_angle", crease_angle), as_number("stroke", stroke), one_of("cull", cull, culls),
                         as_threads(threads), suffix == ".pdf")
    make_folder_of(file)
    try:
        with open(file, "wb") as opened:
            opened.write(drawing)
    except OSError as error:
        raise OutputError(f"{os.fsdecode(file)}: {error.strerror}") from None


class Disagreement(NamedTuple):
    x: int
    y: int
    channel: str
    found: str
    expected: str


class Verification(NamedTuple):
    #: Number of pixels that were computed again, and number of pixels that differ.
    verified: int
    differing: int
    first: Disagreement | None


def verify(map: Map, scene: Scene, camera: Camera | None = None, *, pixels: int = 1000, cull: Cull = "none",
           threads: int = 0) -> Verification:
    """Computes up to `pixels` pixels of a rendered map again, only with exact arithmetic, and compares every channel bit
    for bit. The choice of pixels depends only on the image size. The map's background must be inf."""
    if not isinstance(map, Map):
        raise TypeError(f"map: expected a Map, found {map!r}")
    if not map.scale and not np.isposinf(map.background):
        raise ValueError(f"map: expected a background of inf, as it was rendered with, found {map.background:g}")
    view = map._camera(camera)
    channels = [name for name in map if name in rendered]
    if len(channels) < len(map):
        raise ValueError(f"map: expected channels that fathom renders, found {', '.join(set(map) - set(channels))}")
    depths = next((map[name] for name in ("Z", "distance") if name in map), None)
    stored = "float32" if depths is None else stored_type(depths.dtype)
    options = _core.RenderOptions(channels, one_of("cull", cull, culls), stored, map.scale or 1000, "fast",
                                  as_threads(threads),
                                  map.metadata.get(_core.normals_text, "file"))
    verified, differing, first = _core.verify(map._handle(), scene_handle(scene), camera_handle(view), options,
                                              as_count("pixels", pixels, 1, 2**63))
    return Verification(verified, differing, None if first is None else Disagreement(*first))
