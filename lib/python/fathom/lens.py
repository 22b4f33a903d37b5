"""Lenses: the image size, focal length, projection and range that cameras can share."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from . import _core
from ._arguments import Size, as_number, as_size, one_of

Projection = Literal["perspective", "orthographic"]
projections = ("perspective", "orthographic")

if TYPE_CHECKING:

    class LensKeywords(TypedDict, total=False):
        """The arguments of Lens, for functions that also accept them directly."""

        size: Size
        fov: float | None
        focal: float | None
        extent: float | None
        projection: Projection
        near: float
        far: float


class Lens:
    """Image size, focal length, projection and range, which several cameras can share. A lens is
    immutable.

    size        (width, height) of the image in pixels
    fov         vertical field of view in degrees (default 40, unless `focal` is given)
    focal       fx = fy in pixels, instead of `fov`
    extent      height of the image in scene units, for orthographic cameras
    projection  "perspective" or "orthographic"
    near, far   range of planar depths that are rendered, in scene units

    The principal point is the middle of the image. Camera.look_at(), orbit(), frame() and
    orbit_scene() accept a `lens`, or its arguments:

    >>> from fathom import Camera
    >>> wide = Lens(size=(640, 480), fov=90)
    >>> Camera.look_at((0, 0, 3), lens=wide) == Camera.look_at((0, 0, 3), size=(640, 480), fov=90)
    True

    Raises TypeError or ValueError, which name the argument; ValueError if two of fov, focal and
    extent are given, or if one does not fit the projection.
    """

    __slots__ = ("_handle", "extent", "far", "focal", "fov", "near", "projection", "size")
    _handle: _core.Lens
    size: tuple[int, int]
    fov: float | None
    focal: float | None
    extent: float | None
    projection: Projection
    near: float
    far: float

    def __init__(
        self,
        *,
        size: Size = (1280, 720),
        fov: float | None = None,
        focal: float | None = None,
        extent: float | None = None,
        projection: Projection = "perspective",
        near: float = 0,
        far: float = math.inf,
    ) -> None:
        if projection == "perspective" and extent is not None:
            raise ValueError("extent: it is for orthographic cameras: give fov or focal")
        if projection == "orthographic" and (fov is not None or focal is not None):
            raise ValueError("fov, focal: they are for perspective cameras: give extent")
        if fov is not None and focal is not None:
            raise ValueError("fov, focal: give one of them")
        keep = object.__setattr__
        keep(self, "size", as_size(size))
        keep(self, "projection", one_of("projection", projection, projections))
        keep(self, "fov", _number_or_none("fov", fov))
        keep(self, "focal", _number_or_none("focal", focal))
        keep(self, "extent", _number_or_none("extent", extent))
        keep(self, "near", as_number("near", near))
        keep(self, "far", as_number("far", far))
        keep(self, "_handle", _core.Lens(*self.size, self.projection == "orthographic", self.fov,
                                         self.focal, self.extent, self.near, self.far))

    def _keywords(self) -> LensKeywords:
        return {"size": self.size, "fov": self.fov, "focal": self.focal, "extent": self.extent,
                "projection": self.projection, "near": self.near, "far": self.far}

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a Lens does not change: make another one")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Lens) and self._keywords() == other._keywords()

    def __hash__(self) -> int:
        return hash(tuple(self._keywords().values()))

    def __reduce__(self) -> tuple[Any, ...]:
        return _lens, (self._keywords(),)

    def __repr__(self) -> str:
        given = [f"{name}={each!r}" for name, each in self._keywords().items() if each is not None]
        return f"Lens({', '.join(given)})"


def _lens(keywords: LensKeywords) -> Lens:
    """For pickle."""
    return Lens(**keywords)


def _number_or_none(name: str, value: float | None) -> float | None:
    return None if value is None else as_number(name, value)


def lens_handle(lens: object, keywords: Mapping[str, Any]) -> _core.Lens:
    """The lens, or a new one made from the keywords."""
    if lens is None:
        return Lens(**keywords)._handle
    if not isinstance(lens, Lens):
        raise TypeError(f"lens: expected a Lens, found {lens!r}")
    if keywords:
        raise TypeError(f"{next(iter(keywords))}: a lens is given, too: make a Lens with it")
    return lens._handle
