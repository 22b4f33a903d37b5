"""Finds what is wrong with the cameras and depth images of a mesh, like `fathom doctor`."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

from . import _core
from ._arguments import as_count, as_number, as_threads, camera_handle, scene_handle
from ._files import path_of
from ._render import several_cameras
from .camera import Camera, read_cameras
from .maps import Map, as_map
from .scene import Scene

if TYPE_CHECKING:
    import numpy.typing as npt

    from . import _doctor
    from ._files import Path

    Depths = Union[Map, npt.ArrayLike, Path]

Verdict = Literal["well", "faulty", "unclear", "unknown"]


class Agreement(NamedTuple):
    """How well cameras explain depth images."""

    #: Pixels that have a depth.
    pixels: int
    #: The share of them whose depth is near the exact depth.
    explained: float
    #: The share of all pixels where both or neither have a depth.
    silhouettes: float
    #: Differences from the exact depths, in scene units; None if the mesh is at no pixel that has a depth.
    median_residual: float | None
    largest_residual: float | None


class DataSetFault(NamedTuple):
    """A fault of a data set. docs/doctor.md lists the names."""

    name: str
    text: str
    #: The images without this correction, and with all corrections.
    before: Agreement
    after: Agreement
    #: Other explanations that fit as well.
    alternatives: tuple[str, ...]


class Noise(NamedTuple):
    """Deviation of the corrected depths, relative to the exact depths."""

    median: float
    #: The standard deviation of a normal distribution with the same median distance from the median.
    spread: float
    #: The share of neighbours that deviate to the same side: 0.5 if each pixel deviates by itself.
    same_side: float


class Diagnosis:
    """The result of doctor().

    verdict     "well"; "faulty"; "unclear": several explanations fit equally well; "unknown": no known fault explains the
                depths
    faults      a list of DataSetFault
    notes       conventions that are not faults
    given       Agreement of the data set as given
    corrected   Agreement after all corrections
    noise       what remains after all corrections
    tolerance   a depth is near if it differs by at most this part of it, or half a code
    images      the number of images that were looked at
    command     the command that writes corrected files, if every input is a file and the faults are certain; otherwise None
    """

    def __init__(self, found: _doctor.Diagnosis, command: str, png_scale: float) -> None:
        self._found = found
        self._command = command
        self._png_scale = png_scale
        with _core.standard_arithmetic():  # Python reads decimals by binary64 arithmetic
            answer: dict[str, Any] = json.loads(found.json(command))
        self.verdict: Verdict = answer["verdict"]
        self.faults: list[DataSetFault] = [_fault_of(fault) for fault in answer["faults"]]
        self.notes: list[str] = answer["notes"]
        self.given = Agreement(*answer["given"].values())
        self.corrected = Agreement(*answer["corrected"].values())
        self.noise = Noise(*answer["noise"].values())
        self.tolerance: float = answer["tolerance"]
        self.images: int = answer["images"]
        self.command: str | None = answer["command"]

    @property
    def is_good(self) -> bool:
        """Whether all is well."""
        return self.verdict == "well"

    def correct(self, camera: Camera, depths: Depths) -> tuple[Camera, Map]:
        """A camera and a depth image of the data set without the faults: planar depths in scene units, float32.

        Raises ValueError if the faults are not certain."""
        if self.verdict not in ("well", "faulty"):
            raise ValueError(f"correct: the faults are not certain: the verdict is {self.verdict!r}")
        given = camera_handle(camera), as_map("depths", depths)._handle()
        return (Camera._of(self._found.corrected_camera(*given)),
                Map._of(self._found.corrected_map(*given, self._png_scale)))

    def report(self) -> str:
        """The whole result as text, as the command prints it."""
        return self._found.text(self._command)

    def __str__(self) -> str:
        return self.report().rstrip()

    def __repr__(self) -> str:
        return f"Diagnosis({self.report().splitlines()[0]})"


def doctor(scene: Scene | Path, cameras: Camera | Iterable[Camera] | Path, depths: Depths | Sequence[Depths], *,
           png_scale: float | None = None, images: int = 8, threads: int = 0) -> Diagnosis:
    """Finds what is wrong with cameras and depth images that belong to a mesh: axes, matrices, units, image sizes, mirrored
    images, lenses, ray distances, half pixels, clipped and truncated codes, and two such faults together. See
    docs/doctor.md.

    scene      a Scene, or the name of a mesh or scene file
    cameras    cameras, or the name of a camera file
    depths     a depth image for each camera, in their order: Maps, H×W arrays, or names of files. Arrays of uint16 are codes;
               a Map has their scale itself
    png_scale  codes per unit of images that do not have a scale (default 1000)
    images     the number of images to look at, at equal distances

    >>> import fathom
    >>> scene, camera = fathom.Scene(), fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
    >>> _ = scene.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
    >>> found = fathom.doctor(scene, camera, scene.render(camera, channels=["distance"])["distance"])
    >>> [fault.name for fault in found.faults]
    ['ray-distance']
    >>> corrected = found.correct(camera, scene.render(camera, channels=["distance"])["distance"])
    >>> fathom.doctor(scene, *corrected).verdict
    'well'
    """
    from . import _doctor

    scale = 1000.0 if png_scale is None else as_number("png_scale", png_scale)
    if not 0 < scale < float("inf"):
        raise ValueError(f"png_scale: expected a positive number, found {png_scale!r}")
    listed = [depths] if _is_one(depths) else list(depths)  # type: ignore[arg-type]
    command = _command_of(scene, cameras, listed, png_scale)
    views = _cameras_of(cameras)
    if len(views) != len(listed) or not listed:
        hint = "; patterns are for the program: list the names of the files" if _is_pattern(depths) else ""
        raise ValueError(f"depths: expected a depth image for each of {len(views)} cameras, found {len(listed)}{hint}")
    count = min(len(listed), as_count("images", images, 1, 2**32 - 1))
    chosen = [i * len(listed) // count for i in range(count)]
    found = _doctor.examine(scene_handle(_scene_of(scene)),
                            [camera_handle(views[i]) for i in chosen],
                            [as_map(f"depths[{i}]", listed[i])._handle() for i in chosen], scale, as_threads(threads))
    return Diagnosis(found, command, scale)


def _is_file(value: object) -> bool:
    return isinstance(value, (str, os.PathLike))


def _is_pattern(value: object) -> bool:
    return _is_file(value) and "{" in os.fspath(value)  # type: ignore[call-overload]


def _scene_of(scene: Scene | Path) -> Scene:
    return Scene.read(scene) if isinstance(scene, (str, os.PathLike)) else scene


def _is_one(depths: object) -> bool:
    """Whether it is a single depth image; a dict or an array of two dimensions is one."""
    return _is_file(depths) or isinstance(depths, dict) or getattr(depths, "ndim", 0) == 2


def _cameras_of(cameras: object) -> list[Camera]:
    if _is_file(cameras):
        return list(read_cameras(path_of("cameras", cameras)))  # type: ignore[arg-type]
    return [cameras] if isinstance(cameras, Camera) else several_cameras("cameras", cameras)


def _command_of(scene: object, cameras: object, depths: list[Any], png_scale: float | None) -> str:
    if not all(map(_is_file, (scene, cameras, *depths))):
        return ""
    words = ["fathom", "doctor", scene, "--camera", cameras, "--depth", *depths]
    if png_scale is not None:
        words += ["--png-scale", repr(float(png_scale))]
    import shlex  # at the call: import fathom stays quick

    return shlex.join(os.fspath(word) for word in [*words, "-o", "corrected"])


def _fault_of(fault: dict[str, Any]) -> DataSetFault:
    return DataSetFault(fault["name"], fault["text"], Agreement(*fault["before"].values()),
                        Agreement(*fault["after"].values()), tuple(fault.get("alternatives", ())))
