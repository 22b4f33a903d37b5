"""Explains, pixel by pixel, why another renderer's map differs from the exact map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import camera_handle, scene_handle
from ._shown import html_of, png_of
from .camera import Camera
from .maps import Map, as_map

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._files import Path
    from .names import Model
    from .scene import Scene

#: The names of the classes, indexed by the numbers in arrays of classes.
CLASSES: tuple[str, ...] = tuple(_core.class_names)

_unexplained = CLASSES.index("unexplained")

#: Of the picture of the classes.
_colours = {"grey": (225, 228, 232), "blue": (95, 150, 210), "orange": (240, 150, 40), "red": (200, 20, 30)}


def _colour_of(name: str) -> str:
    return {"equal": "grey", "convention": "orange", "unexplained": "red"}.get(name, "blue")


class Validation:
    """The result of validate().

    model     name of the model by which the map was judged; it differs from the requested model if a finding or note reports so
    camera    the map's Camera: the given camera, unless the map has another size
    classes   H×W uint8: for each pixel, the number of its class in CLASSES
    findings  the faults: each has kind, text, pixels, estimates (name, value, deviation, unit), alternatives and evidence
    notes     conventions that were recognised and are not faults
    cause     the fault in one line; empty without a fault
    verdict   "every pixel is explained", "failed: " and the fault, or "cannot tell: " if the model allows nearly any depth
    least, greatest  H×W: range of depths that the model allows for the visible surface; NaN without a surface
    """

    def __init__(self, found: dict[str, Any]) -> None:
        self.model: str = found["model"]
        self.camera: Camera = Camera._of(found["camera"])
        self.cause: str = found["cause"]
        self.verdict: str = found["verdict"]
        self.classes: npt.NDArray[np.uint8] = found["classes"]
        self.least: npt.NDArray[np.float32] = found["least"]
        self.greatest: npt.NDArray[np.float32] = found["greatest"]
        self.findings: list[_core.Finding] = found["findings"]
        self.notes: list[_core.Finding] = found["notes"]

    @property
    def is_good(self) -> bool:
        """Whether every pixel is explained and no fault was found."""
        return not self.cause

    @property
    def counts(self) -> dict[str, int]:
        """Number of pixels of each class that occurs."""
        numbers = np.bincount(self.classes.ravel(), minlength=len(CLASSES))
        return {name: int(count) for name, count in zip(CLASSES, numbers) if count}

    @property
    def unexplained(self) -> int:
        return int((self.classes == _unexplained).sum())

    def report(self) -> str:
        """The whole result as text."""
        lines = [self.verdict, f"model: {self.model}"]
        lines += [f"{count:>10} pixels {name}" for name, count in self.counts.items()]
        for title, found in (("wrong", self.findings), ("noted", self.notes)):
            for each in found:
                lines.append(f"{title}: {each!r}")
                lines += [f"    {line}" for line in each.evidence]
        return "\n".join(lines) + "\n"

    def __repr__(self) -> str:
        return f"Validation({self.verdict})"

    def _repr_html_(self) -> str:
        import html  # not needed elsewhere

        rows = [("class", "pixels", "colour")]
        rows += [(name, f"{count}", _colour_of(name)) for name, count in self.counts.items()]
        text = html.escape(self.report())
        return html_of(self.verdict, rows, png_of(self._picture), f"<pre>{text}</pre>")

    def _picture(self) -> npt.NDArray[np.uint8]:
        """The classes as colours, H×W×3."""
        return np.array([_colours[_colour_of(name)] for name in CLASSES], np.uint8)[self.classes]


def validate(
    map: Map | npt.ArrayLike | Path,
    scene: Scene,
    camera: Camera,
    model: Model = "auto",
    *,
    channel: str = "",
) -> Validation:
    """Explains how another renderer's map of a scene differs from the exact map.

    map      a Map, the name of its file, or an H×W array of planar depths in scene units; its background value is detected.
             If its size is not the camera's, the reason is found: rows and columns exchanged, up to eight of them missing
             or added, the whole view larger or smaller
    camera   the renderer's camera; with the renderer's near and far if it has a depth buffer. It may have a lens if all of its
             rays go forwards
    model    the renderer's arithmetic, such as "gl-unorm24", "vtk-float32", "float32-ray" (`fathom validate --help` lists
             all); "auto": the model that fits best. If the named model leaves pixels unexplained and another model does
             not, a finding of kind "model" names the other model
    channel  the channel to judge, if the Map has several

    A pixel gets a class only if the bounds of the model prove it. See docs/validation.md.

    >>> import fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
    >>> camera = fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
    >>> depths = scene.render(camera)["Z"]
    >>> validate(depths, scene, camera, "float32-ray").is_good
    True
    >>> validate(depths[:, ::-1].copy(), scene, camera, "float32-ray").findings[0].kind
    'mirrored'
    """
    handles = scene_handle(scene), camera_handle(camera)
    if not isinstance(model, str):
        raise TypeError(f"model: expected a name, found {model!r}")
    if not isinstance(channel, str):
        raise TypeError(f"channel: expected a name, found {channel!r}")
    theirs = as_map("map", map)
    judged = theirs.get(channel or "Z")
    if theirs.scale is None and judged is not None and np.asarray(judged).dtype == np.uint16:
        raise ValueError("map: codes of uint16 need a scale: fathom.Map({'Z': codes}, scale=1000) has 1000 codes per unit")
    return Validation(_core.validate(theirs._handle(), channel, *handles, model))
