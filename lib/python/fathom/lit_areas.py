"""Areas that a sun, a lamp or a camera sees, exact, without pixels."""

from __future__ import annotations

import importlib
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arguments import as_count, as_finite, as_threads, camera_handle, culls, in_words, one_of, scene_handle
from .camera import Camera
from .questions import _fraction

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from .names import AreaCentroid, AreaItem, Cull
    from .scene import Scene

    Numbers = npt.NDArray[np.float64]

#: The values of `by` and `centroid`.
area_items = ("object", "face", "triangle", "material", "group", "part", "label")
area_centroids = ("across", "lit")


class _Question(NamedTuple):
    """The arguments of areas(), checked; of lights and cameras the other one is empty."""

    handle: _core.AreaQuestion
    lights: Numbers
    are_points: bool
    cameras: tuple[Camera, ...]
    alone: bool
    cull: str
    threads: int


class ExactArea:
    """An area before it is rounded, as `Areas.exact()` returns it. Attributes whose number is not rational raise
    ValueError."""

    def __init__(self, visible: Fraction | None, projected: Fraction | None, square: Fraction) -> None:
        self._visible, self._projected, self._square = visible, projected, square

    @property
    def fraction(self) -> Fraction:
        """visible / projected, which is always rational. ValueError if it is not defined: of groups without
        `alone=True`, and if projected is 0."""
        if self._visible is None or self._projected is None:
            raise ValueError("fraction: the projected area is not known; call areas() with alone=True")
        if self._projected == 0:
            raise ValueError("fraction: not defined, because the projected area is 0")
        return self._visible / self._projected

    @property
    def visible(self) -> Fraction:
        """The visible area; from a point, the visible share of a triangle's surface."""
        return self._across("visible", self._visible)

    @property
    def projected(self) -> Fraction:
        """The area with all other triangles removed; from a point, 1."""
        return self._across("projected", self._projected)

    def _across(self, name: str, area: Fraction | None) -> Fraction:
        if area is None:
            raise ValueError(f"{name}: not defined of this item")
        roots = isqrt(self._square.numerator), isqrt(self._square.denominator)
        length = Fraction(*roots)
        if area != 0 and length * length != self._square:
            raise ValueError(f"{name}: not rational: it is {area / self._square} times the square root of {self._square}")
        return area / length if area != 0 else area

    def __repr__(self) -> str:
        return f"ExactArea(visible={self._visible}, projected={self._projected}, length²={self._square})"


class Areas:
    """What `areas()` returns. Index i is the light, index j the item. Each number is exact and rounded once to float64; NaN
    where a value is not defined."""

    #: The kind of the items.
    by: str
    #: M names; of triangles and faces the name of their object.
    names: list[str]
    #: M numbers: of a triangle in the scene, of a face in its file, of other items of their kind.
    numbers: npt.NDArray[np.uint64]
    #: M numbers of objects and of faces, of triangles and faces; else None.
    objects: npt.NDArray[np.uint32] | None
    faces: npt.NDArray[np.uint32] | None
    #: N×M: the visible area across the direction; from a camera in pixels; from a point NaN.
    visible: Numbers
    #: N×M: the area with everything else removed; of items other than triangles only with `alone=True`.
    projected: Numbers
    #: N×M: visible / projected; from a point the visible share of a triangle's surface.
    fraction: Numbers
    #: N×M: the visible area, measured on the surface.
    lit: Numbers
    #: N×M×3: the centroid of the visible surface, in the world.
    centroid: Numbers
    #: N×M: 1 if the front of a triangle faces the light, -1 if its back does, 0 if it is seen edge on; None of other items.
    sides: npt.NDArray[np.int8] | None

    def __init__(self, question: _Question, by: str, arrays: tuple[Any, ...]) -> None:
        self._question, self.by = question, by
        self.names, self.numbers, self.objects, self.faces = _core.area_items(question.handle)
        self.visible, self.projected, self.fraction, self.lit, self.centroid, self.sides = arrays

    @property
    def background(self) -> Numbers | None:
        """N areas in pixels in which nothing is visible, from cameras; None of directions and points, which see a whole
        plane. Computed at each access."""
        q = self._question
        if not q.cameras:
            return None
        return np.array([_core.background_area(q.handle, camera_handle(camera), q.cull, q.threads) for camera in q.cameras])

    def exact(self, i: int, j: int) -> ExactArea:
        """The area of item j under light i before it is rounded. It is computed again, by rational numbers."""
        q = self._question
        light = as_count("i", i, 0, len(self.lit) - 1)
        item = as_count("j", j, 0, len(self.names) - 1)
        if q.cameras:
            parts = _core.exact_camera_area(q.handle, camera_handle(q.cameras[light]), item, q.alone, q.cull, q.threads)
            square = Fraction(1)
        else:
            numbers = q.lights[light:light + 1]
            parts = _core.exact_light_area(q.handle, numbers, q.are_points, item, q.alone, q.cull, q.threads)
            square = Fraction(1) if q.are_points else sum((Fraction(float(x)) ** 2 for x in numbers[0]), Fraction(0))
        visible, projected = (None if part is None else _fraction(*part) for part in parts)
        return ExactArea(visible, projected, square)

    def to_dataframe(self) -> Any:
        """A pandas DataFrame with a row for each light and item, with the columns of `fathom areas`. Needs pandas."""
        try:
            pandas = importlib.import_module("pandas")
        except ImportError:
            raise ImportError("to_dataframe() needs pandas: pip install pandas") from None
        return pandas.DataFrame(self._columns())

    def _columns(self) -> dict[str, Any]:
        lights, items = self.lit.shape
        of_items = {"name": np.array(self.names, dtype=object), "number": self.numbers}
        for name, numbers in (("object", self.objects), ("face", self.faces)):
            if numbers is not None:
                of_items[name] = numbers
        columns: dict[str, Any] = {"direction": np.repeat(np.arange(lights), items)}
        columns.update((name, np.tile(values, lights)) for name, values in of_items.items())
        if self.sides is not None:
            columns["side"] = np.array(["edge", "front", "back"], dtype=object)[self.sides.ravel()]
        for name in ("projected", "visible", "fraction", "lit"):
            columns[name] = getattr(self, name).ravel()
        for axis, name in enumerate("xyz"):
            columns[name] = self.centroid[..., axis].ravel()
        return columns

    def __repr__(self) -> str:
        lights, items = self.lit.shape
        return f"Areas({lights} × {items} by {self.by})"


def areas(
    scene: Scene,
    *,
    directions: npt.ArrayLike | None = None,
    points: npt.ArrayLike | None = None,
    camera: Camera | Sequence[Camera] | None = None,
    by: AreaItem = "object",
    centroid: AreaCentroid | None = None,
    alone: bool = False,
    cull: Cull = "none",
    threads: int = 0,
) -> Areas:
    """Measures the areas of a scene's surfaces that N lights see. Every number is exact and rounded once (specification,
    section 8).

    directions  N×3 (or 3 numbers): towards the sun or against the wind; of any length, but not 0
    points      N×3: places of lamps, which see in all directions
    camera      a Camera without a lens, or N of them: areas within the image, in pixels. Give only one of these three
    by          the M items: "object", "face", "triangle", "material", "group", "part" or "label"
    centroid    of groups under directions: weighted by the area "across" the direction (default) or on the surface ("lit")
    alone       also measures each item with everything else removed, for `projected` and `fraction` of groups
    cull        leaves out "back" or "front" faces
    threads     0: all

    >>> import fathom
    >>> scene = fathom.Scene()
    >>> for z in (1, 0):
    ...     _ = scene.add_mesh([(0, 0, z), (2 + 2 * (1 - z), 0, z), (0, 2, z)], [(0, 1, 2)], name=f"at {z}")
    >>> found = fathom.areas(scene, directions=[(0, 0, 1), (0, 0, -1)], by="triangle")
    >>> found.visible.tolist(), found.exact(0, 1).fraction
    ([[2.0, 2.0], [0.0, 4.0]], Fraction(1, 2))
    """
    given = [name for name, value in (("directions", directions), ("points", points), ("camera", camera))
             if value is not None]
    if len(given) != 1:
        raise ValueError(f"areas: expected one of directions, points and camera, found {' and '.join(given) or 'none'}")
    kind = one_of("by", by, area_items)
    if centroid is not None and one_of("centroid", centroid, area_centroids) == "across" and directions is None:
        raise ValueError("centroid: 'across' is for directions")
    if alone and points is not None:
        raise ValueError("alone: from a point, groups have no projected area")
    lights = _lights(given[0], directions if points is None else points)
    cameras = () if camera is None else tuple(camera) if isinstance(camera, (list, tuple)) else (camera,)
    if camera is not None and not cameras:
        raise ValueError("camera: expected a Camera, found an empty list")
    for each in cameras:
        camera_handle(each)
    question = _Question(_core.area_question(scene_handle(scene), kind), lights, points is not None, cameras, bool(alone),
                         one_of("cull", cull, culls), as_threads(threads))
    return Areas(question, kind, _arrays(question, centroid or "across"))


def _arrays(q: _Question, centroid: str) -> tuple[Any, ...]:
    if len(q.lights):
        return _core.light_areas(q.handle, q.lights, q.are_points, centroid, q.alone, q.cull, q.threads)
    return _core.camera_areas(q.handle, [camera_handle(camera) for camera in q.cameras], q.alone, q.cull, q.threads)


def _lights(name: str, value: npt.ArrayLike | None) -> Numbers:
    if value is None:
        return np.empty((0, 3))
    numbers = as_finite(name, value)
    if numbers.shape == (3,):
        numbers = numbers.reshape(1, 3)
    if numbers.ndim != 2 or numbers.shape[1] != 3 or len(numbers) == 0:
        raise ValueError(f"{name}: expected shape N×3, found {in_words(numbers.shape)}")
    with _core.standard_arithmetic():  # or else subnormal numbers might be 0
        is_zero = (numbers == 0).all(axis=1)
    if name == "directions" and is_zero.any():
        raise ValueError(f"directions: the direction at {int(np.argmax(is_zero))} is 0")
    return numbers
