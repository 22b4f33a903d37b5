"""Cameras: constructors, importers, and camera files."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Callable, Literal, Union, cast

import numpy as np

from . import _core, _importing
from ._core import InputError, OutputError
from ._arguments import (
    Rows,
    Size,
    as_count,
    as_finite,
    as_number,
    as_numbers,
    as_size,
    as_text,
    camera_handle,
    in_pixels,
    in_words,
    one_of,
    point_frames,
    pose_of,
    scene_handle,
    takes_pixel_centre,
)
from ._files import Path, make_folder_of, path_of
from ._importing import intrinsics_of
from ._shown import html_of
from ._warnings import warn
from .lens import Lens, Projection, lens_handle, projections

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Concatenate, ParamSpec, Unpack

    from ._arguments import HasScene as Scene
    from .lens import LensKeywords
    from .names import Frame

    Arguments = ParamSpec("Arguments")

Up = Union[Literal["x", "y", "z", "-x", "-y", "-z"], "npt.ArrayLike"]


def _importer(
    function: Callable[Concatenate[type[Camera], Arguments], dict[str, Camera]]
) -> Callable[Arguments, dict[str, Camera]]:
    """A function as a class method of Camera; type checkers know its arguments."""
    return cast("Callable[Arguments, dict[str, Camera]]", classmethod(function))


class Camera:
    """A pinhole or orthographic camera. Every number is exact: it means the real number that it
    denotes. A camera is immutable.

    width, height    image size in pixels
    fx, fy, skew     pixels (perspective) or pixels per scene unit (orthographic)
    cx, cy           principal point in pixels
    pixel_centre     image coordinate of the top left pixel's centre in the convention of cx and cy:
                     0.5 (COLMAP, OpenGL, NeRF) or 0 (OpenCV, BOP). Required, because half a pixel
                     is the most common error.
    world_to_camera  4×4 or 3×4, [R | t]; x right, y down, z forward (OpenCV's axes). R need not be
                     a rotation.
    near, far        range of planar depths that are rendered, in scene units; of ray distances for
                     fisheyes, panoramas, DIVISION, SIMPLE_DIVISION and TABLE
    name             name of the camera's image; it does not change the map
    model            model of the lens, as "OPENCV" (docs/lenses.md); without it the lens bends no ray
    distortion       its numbers of distortion, in the model's order
    params           all parameters of the model in its order, in place of fx, fy, cx, cy and
                     distortion; [w, h] for EQUIRECTANGULAR, whose fx is then w and fy h
    max_radius       where the lens ends, on the plane z = 1; for FOV, fisheyes, panoramas, DIVISION,
                     SIMPLE_DIVISION and TABLE the angle to the z axis in radians

    >>> camera = Camera(640, 480, 500, 500, 320, 240, pixel_centre=0.5)
    >>> camera.K
    array([[500.,   0., 320.],
           [  0., 500., 240.],
           [  0.,   0.,   1.]])

    Raises TypeError or ValueError, which name the argument.
    """

    __slots__ = ("_handle",)
    _handle: _core.Camera

    @takes_pixel_centre
    def __init__(
        self,
        width: int,
        height: int,
        fx: float | None = None,
        fy: float | None = None,
        cx: float | None = None,
        cy: float | None = None,
        *,
        pixel_centre: float,
        skew: float = 0,
        world_to_camera: npt.ArrayLike | None = None,
        projection: Projection = "perspective",
        near: float = 0,
        far: float = math.inf,
        name: str = "",
        model: str | None = None,
        distortion: npt.ArrayLike = (),
        params: npt.ArrayLike | None = None,
        max_radius: float = math.inf,
    ) -> None:
        size = as_size((width, height))
        if params is not None:
            if model is None:
                raise ValueError("params: expected a model, whose parameters they are")
            if not all(each is None for each in (fx, fy, cx, cy)):
                raise ValueError("params: has fx, fy, cx and cy; leave these out")
            keys: dict[str, object] = {"params": _list("params", params)}
            if _finite("skew", skew) != 0:
                keys["skew"] = _finite("skew", skew)
        else:
            given = {"fx": fx, "fy": fy, "cx": cx, "cy": cy}
            for key, value in given.items():
                if value is None:
                    raise TypeError(f"{key}: missing")
            keys = {"K": [[_finite("fx", fx), _finite("skew", skew), _finite("cx", cx)],
                          [0, _finite("fy", fy), _finite("cy", cy)], [0, 0, 1]]} if model else {}
        lens = _list("distortion", distortion)
        if model is None and lens:
            raise ValueError('distortion: expected a model, as "OPENCV", whose numbers they are')
        if model is None and as_number("max_radius", max_radius) != math.inf:
            raise ValueError('max_radius: expected a model, as "OPENCV", whose lens ends there')
        if model is not None:
            pose = _identity if world_to_camera is None else pose_of("world_to_camera", world_to_camera)
            keys.update({"distortion": lens} if lens else {})
            keys.update(model=as_text("model", model), projection=one_of("projection", projection, projections))
            self._set_lens(size, keys, pixel_centre, pose, near, far, max_radius, as_text("name", name))
            return
        intrinsics = [as_number(name, value) for name, value in
                      (("fx", fx), ("fy", fy), ("cx", cx), ("cy", cy), ("skew", skew))]
        pose = _identity if world_to_camera is None else pose_of("world_to_camera", world_to_camera)
        called = as_text("name", name)
        self._set(size, projection, intrinsics, pixel_centre, pose, near, far, called)

    def _set(
        self,
        size: tuple[int, int],
        projection: object,
        intrinsics: list[float],
        pixel_centre: object,
        pose: Rows,
        near: object,
        far: object,
        name: str = "",
    ) -> None:
        made = _core.Camera(
            *size,
            one_of("projection", projection, projections) == "orthographic",
            intrinsics,
            as_number("pixel_centre", pixel_centre),
            pose,
            as_number("near", near),
            as_number("far", far),
            name,
        )
        object.__setattr__(self, "_handle", made)

    def _set_lens(
        self,
        size: tuple[int, int],
        keys: dict[str, object],
        pixel_centre: object,
        pose: Rows,
        near: object,
        far: object,
        max_radius: object,
        name: str = "",
    ) -> None:
        """The camera of a camera file with these keys."""
        keys = {**keys, "pixel_centre": _finite("pixel_centre", pixel_centre)}
        text = _lens_file(size, keys, pose, near, far, max_radius, name)
        object.__setattr__(self, "_handle", Camera.from_json(text)._handle)

    def _set_table(
        self, numbers: npt.NDArray[np.float64], pose: Rows, near: object, far: object, max_radius: object, name: str
    ) -> None:
        height, width, _ = numbers.shape
        keys: dict[str, object] = {"model": "TABLE", "directions": None}
        text = _lens_file((width, height), keys, pose, near, far, max_radius, name)
        object.__setattr__(self, "_handle", _core.camera_with_table(text, numbers))

    @classmethod
    def _of(cls, core: _core.Camera) -> Camera:
        camera = cls.__new__(cls)
        object.__setattr__(camera, "_handle", core)
        return camera

    # Made

    @classmethod
    @takes_pixel_centre
    def from_opencv(
        cls,
        K: npt.ArrayLike,
        T: npt.ArrayLike,
        size: Size,
        *,
        pixel_centre: float,
        distortion: npt.ArrayLike | None = None,
        near: float = 0,
        far: float = math.inf,
    ) -> Camera:
        """A camera from OpenCV's matrices.

        K           3×3: fx skew cx / 0 fy cy / 0 0 1, in pixels
        T           4×4 or 3×4, world to camera, x right, y down, z forward
        size        (width, height) in pixels
        distortion  4, 5, 8, 12 or 14 numbers, as cv2.calibrateCamera() returns them: the lens is
                    the model OPENCV_14

        K from cv2.calibrateCamera() has pixel_centre 0; K exported by COLMAP has 0.5.

        >>> K = [[500, 0, 320], [0, 500, 240], [0, 0, 1]]
        >>> Camera.from_opencv(K, np.eye(4), (640, 480), pixel_centre=0)
        Camera(640×480, perspective, fx=500, fy=500, cx=320, cy=240, pixel_centre=0)
        """
        camera = cls.__new__(cls)
        width_and_height, intrinsics, pose = as_size(size), intrinsics_of(K), pose_of("T", T)
        numbers = [] if distortion is None else _list("distortion", distortion)
        if numbers:
            fx, fy, cx, cy, skew = intrinsics
            keys: dict[str, object] = {"model": "OPENCV_14", "K": [[fx, skew, cx], [0, fy, cy], [0, 0, 1]], "distortion": numbers}
            camera._set_lens(width_and_height, keys, pixel_centre, pose, near, far, math.inf)
        else:
            camera._set(width_and_height, "perspective", intrinsics, pixel_centre, pose, near, far)
        return camera

    @classmethod
    def from_directions(
        cls,
        directions: npt.ArrayLike,
        *,
        world_to_camera: npt.ArrayLike | None = None,
        near: float = 0,
        far: float = math.inf,
        name: str = "",
        max_radius: float = math.inf,
    ) -> Camera:
        """A camera whose pixels see given directions: the model TABLE, for lenses that no model describes.

        directions       H×W×3 in the camera frame, x right, y down, z forward, of any length. Every number is exact. A
                         pixel with (0, 0, 0) or a NaN has no ray.
        world_to_camera  4×4 or 3×4, [R | t]
        near, far        range of ray distances that are rendered, in scene units
        max_radius       greatest angle between a ray and the z axis, in radians

        Such a camera has no fx, fy, cx, cy, skew and pixel_centre. write_cameras() needs a table that was read from a
        file. Raises InputError for an infinite number.

        >>> down = np.zeros((2, 3, 3)) + (0, 0.5, 1)
        >>> Camera.from_directions(down).model
        'TABLE'
        """
        numbers = as_numbers("directions", directions)
        if numbers.ndim != 3 or numbers.shape[2] != 3 or not numbers.size:
            raise ValueError(f"directions: expected shape H×W×3, found {in_words(numbers.shape)}")
        camera = cls.__new__(cls)
        pose = _identity if world_to_camera is None else pose_of("world_to_camera", world_to_camera)
        camera._set_table(numbers, pose, near, far, max_radius, as_text("name", name))
        return camera

    @classmethod
    def from_opengl(cls, projection: npt.ArrayLike, modelview: npt.ArrayLike, size: Size) -> Camera:
        """A camera from OpenGL's matrices, each 4×4 for column vectors (transpose the result of
        glGetFloatv), for a viewport of `size` and clip depths from −1 to 1. Near and far are taken
        from the projection.

        Exact: entries that follow from a formula are computed exactly and rounded once.
        """
        return cls._of(
            _core.camera_from_opengl(
                as_finite("projection", projection, (4, 4)).ravel().tolist(),
                as_finite("modelview", modelview, (4, 4)).ravel().tolist(),
                *as_size(size),
            )
        )

    @classmethod
    def look_at(
        cls,
        eye: npt.ArrayLike,
        target: npt.ArrayLike = (0, 0, 0),
        up: Up = "y",
        *,
        lens: Lens | None = None,
        **keywords: Unpack[LensKeywords],
    ) -> Camera:
        """A camera at `eye` that looks at `target`, with `up` upwards in the image. Points are in
        the world, in scene units.

        lens        a Lens, which several cameras can share
        **keywords  instead, the arguments of Lens: size, fov, focal, extent, projection, near, far

        >>> Camera.look_at((0, 0, 3)).world_to_camera[2]
        array([ 0.,  0., -1.,  3.])
        """
        chosen = lens_handle(lens, keywords)
        return cls._of(_core.look_at(_point("eye", eye), _point("target", target), _up(up), chosen))

    @classmethod
    def orbit(
        cls,
        count: int,
        *,
        distance: float,
        centre: npt.ArrayLike = (0, 0, 0),
        azimuth: float = 35,
        elevation: float = 25,
        up: Up = "y",
        lens: Lens | None = None,
        **keywords: Unpack[LensKeywords],
    ) -> list[Camera]:
        """`count` cameras around `centre` at `distance`, in steps of 360°/count starting at
        `azimuth`, all at `elevation` degrees above the horizon. `up` is the world's up direction:
        "x", "y", "z", "-x", "-y", "-z" or a vector of any length. At azimuth 0 the image's right is
        +x minus its part along `up` (+y if `up` is along x). The lens is as for look_at().

        >>> len(Camera.orbit(12, distance=3))
        12
        """
        view = _view(azimuth, elevation, up)
        chosen = lens_handle(lens, keywords)
        made = _core.orbit(view, as_count("count", count, 1, 1_000_000), _point("centre", centre),
                           as_number("distance", distance), chosen)
        return [cls._of(each) for each in made]

    @classmethod
    def frame(
        cls,
        scene: Scene,
        *,
        azimuth: float = 35,
        elevation: float = 25,
        up: Up = "y",
        lens: Lens | None = None,
        **keywords: Unpack[LensKeywords],
    ) -> Camera:
        """A camera that sees the whole scene, with a margin, from a direction in degrees.
        The lens is as for look_at()."""
        view = _view(azimuth, elevation, up)
        chosen = lens_handle(lens, keywords)
        return cls._of(_core.frame_scene(scene_handle(scene), view, chosen))

    @classmethod
    def orbit_scene(
        cls,
        scene: Scene,
        count: int,
        *,
        azimuth: float = 35,
        elevation: float = 25,
        up: Up = "y",
        lens: Lens | None = None,
        **keywords: Unpack[LensKeywords],
    ) -> list[Camera]:
        """Like orbit(), around a scene, at a distance from which each camera sees the whole
        scene."""
        view = _view(azimuth, elevation, up)
        chosen = lens_handle(lens, keywords)
        steps = as_count("count", count, 1, 1_000_000)
        made = _core.orbit_scene(scene_handle(scene), view, steps, chosen)
        return [cls._of(each) for each in made]

    # Imported: conventions are in docs/data-sets.md and docs/conventions.md

    from_colmap = _importer(_importing.from_colmap)
    from_nerf = _importer(_importing.from_nerf)
    from_bop = _importer(_importing.from_bop)
    from_sfm_data = _importer(_importing.from_sfm_data)
    from_gltf = _importer(_importing.from_gltf)
    from_matrices = _importer(_importing.from_matrices)
    from_tum = _importer(_importing.from_tum)
    from_7scenes = _importer(_importing.from_7scenes)
    from_scannet = _importer(_importing.from_scannet)
    from_scannetpp = _importer(_importing.from_scannetpp)
    from_replica = _importer(_importing.from_replica)
    from_kitti = _importer(_importing.from_kitti)

    # Read and written

    @classmethod
    def from_json(cls, text: str) -> Camera:
        """A camera from the text of a camera file."""
        return _only(cameras_from_json(text))

    @classmethod
    def read(cls, file: Path) -> Camera:
        """Reads a camera file with one camera; read_cameras() reads files with several."""
        return _only(read_cameras(file))

    def to_json(self) -> str:
        """The text of a camera file, every number with as many digits as it needs: from_json() returns the same
        camera, bit for bit."""
        return _core.camera_to_json(self._handle)

    def write(self, file: Path) -> None:
        """Writes a camera file, which the program can read."""
        write_cameras(file, [self])

    # What it is

    @property
    def width(self) -> int:
        return self._handle.width

    @property
    def height(self) -> int:
        return self._handle.height

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self._handle.width, self._handle.height

    @property
    def projection(self) -> Projection:
        return "orthographic" if self._handle.orthographic else "perspective"

    @property
    def fx(self) -> float:
        return self._handle.fx

    @property
    def fy(self) -> float:
        return self._handle.fy

    @property
    def cx(self) -> float:
        return self._handle.cx

    @property
    def cy(self) -> float:
        return self._handle.cy

    @property
    def skew(self) -> float:
        return self._handle.skew

    @property
    def pixel_centre(self) -> float:
        return self._handle.pixel_centre

    @property
    def model(self) -> str | None:
        """The model of the lens, as "OPENCV"; None for a camera without a lens."""
        return self._handle.lens[0] if self._handle.lens else None

    @property
    def distortion(self) -> list[float]:
        """The numbers of distortion of the lens, in the order of its model."""
        return self._handle.lens[1] if self._handle.lens else []

    @property
    def max_radius(self) -> float:
        """Where the lens ends; inf without a bound."""
        return self._handle.lens[2] if self._handle.lens else math.inf

    @property
    def near(self) -> float:
        return self._handle.near

    @property
    def far(self) -> float:
        return self._handle.far

    @property
    def name(self) -> str:
        """Name of the camera's image; "" without a name."""
        return self._handle.name

    @property
    def K(self) -> npt.NDArray[np.float64]:
        """3×3: fx skew cx / 0 fy cy / 0 0 1."""
        rows = [[self.fx, self.skew, self.cx], [0, self.fy, self.cy], [0, 0, 1]]
        return np.array(rows, np.float64)

    @property
    def world_to_camera(self) -> npt.NDArray[np.float64]:
        """4×4, x right, y down, z forward."""
        return np.array([*self._handle.world_to_camera, (0, 0, 0, 1)], np.float64)

    @property
    def camera_to_world(self) -> npt.NDArray[np.float64]:
        """4×4, the inverse of world_to_camera: each entry is exact, rounded once."""
        return np.array([*self._handle.camera_to_world, (0, 0, 0, 1)], np.float64)

    @property
    def eye(self) -> npt.NDArray[np.float64]:
        """Where the camera is, in the world, in scene units: 3 numbers, each exact, rounded once. The rays of an orthographic
        camera begin in the plane through this point that is parallel to the image."""
        return self.camera_to_world[:3, 3]

    @property
    def forward(self) -> npt.NDArray[np.float64]:
        """The direction in the world in which the camera looks: 3 numbers, each exact, rounded once. The point
        eye + d·forward has planar depth d; the length is 1 if world_to_camera has a rotation."""
        return self.camera_to_world[:3, 2]

    def project(self, points: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """The images of points, and their depths.

        points   …×3, in the world, in scene units, finite
        Returns  …×2: u (right) and v (down) in pixels, counted like cx and cy, so that the centre of
                 the pixel in column x and row y is (x + pixel_centre, y + pixel_centre); NaN for a
                 perspective camera where the depth is not positive. And …: planar depths, in scene
                 units. The image size, near and far are not taken into account.
        Exact    each number is exact, rounded once.

        >>> camera = Camera(640, 480, 500, 500, 320, 240, pixel_centre=0.5)
        >>> camera.project((1, 0.5, 4))
        (array([445. , 302.5]), array(4.))
        """
        numbers = as_finite("points", points)
        if numbers.ndim == 0 or numbers.shape[-1] != 3:
            raise ValueError(f"points: expected shape …×3, found {in_words(numbers.shape)}")
        found = _core.project(self._handle, numbers.reshape(-1, 3))
        shape = numbers.shape[:-1]
        return found[:, :2].reshape(*shape, 2), found[:, 2].reshape(shape)

    def unproject(self, pixels: npt.ArrayLike, depths: npt.ArrayLike, *, frame: Frame = "world") -> npt.NDArray[np.float64]:
        """The points at image positions and planar depths: the inverse of project().

        pixels   …×2: u and v, counted like cx and cy; finite
        depths   …, or one number for all: planar depths in scene units
        frame    "world" or "camera" (x right, y down, z forward)
        Returns  …×3, in scene units; NaN where the depth is not finite, as of a map without a surface
        Exact    each number is exact for these numbers, rounded once.

        >>> camera = Camera(640, 480, 500, 500, 320, 240, pixel_centre=0.5)
        >>> camera.unproject((445, 302.5), 4)
        array([1. , 0.5, 4. ])
        """
        places = as_finite("pixels", pixels)
        if places.ndim == 0 or places.shape[-1] != 2:
            raise ValueError(f"pixels: expected shape …×2, found {in_words(places.shape)}")
        lengths = as_numbers("depths", depths)
        shape = places.shape[:-1]
        if lengths.shape not in ((), shape):
            raise ValueError(f"depths: expected shape {in_words(shape)} or a number, found {in_words(lengths.shape)}")
        known = np.isfinite(lengths)
        flat = np.broadcast_to(np.where(known, lengths, 1.0), shape).ravel()
        rows = _core.unproject(self._handle, places.reshape(-1, 2), flat, one_of("frame", frame, point_frames))
        points = rows.reshape(*shape, 3)
        points[~np.broadcast_to(known, shape)] = np.nan
        return points

    def rays(self, *, frame: Frame = "world") -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """The rays through the centres of all pixels.

        frame    "world" or "camera" (x right, y down, z forward)
        Returns  origins and directions, H×W×3 each, in scene units. origins + d·directions has planar
                 depth d: directions have no unit length. One of the two is the same for all pixels,
                 and read-only: the origins of a perspective camera, the directions of an orthographic
                 camera.
        Exact    each number is exact, rounded once.

        >>> camera = Camera(640, 480, 500, 500, 320, 240, pixel_centre=0.5)
        >>> origins, directions = camera.rays()
        >>> origins.shape, directions[240, 320]
        ((480, 640, 3), array([0.001, 0.001, 1.   ]))
        """
        shape = (self.height, self.width, 3)
        if self.width * self.height > 2**31:
            raise ValueError(f"size: rays of {in_pixels(self.size)} pixels do not fit into memory: take unproject()")
        varying = _core.rays_of_pixels(self._handle, one_of("frame", frame, point_frames)).reshape(shape)
        pose = self.camera_to_world if frame == "world" else np.eye(4)
        if self.projection == "orthographic":
            return varying, np.broadcast_to(pose[:3, 2], shape)
        return np.broadcast_to(pose[:3, 3], shape), varying

    def directions(self) -> npt.NDArray[np.float64]:
        """The directions that the pixels see, H×W×3, in the camera frame: x right, y down, z forward. The component of a
        direction that is greatest in magnitude is 1 or −1. A pixel without a ray has (0, 0, 0). Works for pinholes, lenses
        and tables. Raises ValueError for an orthographic camera.

        Exact    each number is exact, rounded once. A camera made by from_directions() of the result has these rounded
                 directions.

        >>> camera = Camera(4, 2, 2, 2, 2, 1, pixel_centre=0.5)
        >>> camera.directions()[0, 0]
        array([-0.75, -0.25,  1.  ])
        """
        return _core.directions_of(self._handle)

    def scaled(self, factor: float | None = None, *, size: Size | None = None) -> Camera:
        """The camera of the same image at another resolution: it shows the same view up to the edges.

        factor  the new width and height are factor·width and factor·height, rounded to whole pixels,
                ties to even, at least 1
        size    instead, the new (width, height)

        fx, fy, skew and the principal point are scaled by new / old width and height, about the top
        left corner of the image: with pixel_centre 0, that is about (−½, −½). Each is exact, rounded
        once. world_to_camera, near, far and name stay.

        >>> Camera(640, 480, 500, 500, 319.5, 239.5, pixel_centre=0).scaled(0.5)
        Camera(320×240, perspective, fx=250, fy=250, cx=159.5, cy=119.5, pixel_centre=0)
        """
        if (factor is None) == (size is None):
            raise TypeError("scaled: expected either a factor or a size")
        if size is not None:
            return Camera._of(_core.resized(self._handle, *as_size(size)))
        number = as_number("factor", factor)
        if not 0 < number < math.inf:
            raise ValueError(f"factor: expected a positive number, found {number!r}")
        return Camera._of(_core.scaled(self._handle, number))

    def with_size(self, width: int | Size, height: int | None = None) -> Camera:
        """The same camera with another image size, (width, height) or two numbers, and the same principal point in
        pixels."""
        size = as_size(width if height is None else (width, height))
        if self.model == "TABLE":
            raise ValueError("with_size: a table has directions for its own pixels only; make a table of the other size")
        return Camera._of(_core.with_size(self._handle, *size))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a Camera does not change: make another one")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Camera) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Any, ...]:
        return _from_json, (self.to_json(), _core.table_of(self._handle))

    def _repr_html_(self) -> str:
        forward, eye = self.camera_to_world[:3, 2], self.camera_to_world[:3, 3]
        with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
            rows = [
                (f"{self.projection} camera", self.name),
                ("size", f"{self.width}×{self.height} pixels"),
                ("fx, fy, skew", f"{self.fx:.6g}, {self.fy:.6g}, {self.skew:.6g}"),
                ("cx, cy", f"{self.cx:.6g}, {self.cy:.6g} (centre of the first pixel: {self.pixel_centre:.6g})"),
                ("eye", ", ".join(f"{each:.6g}" for each in eye)),
                ("forward", ", ".join(f"{each:.6g}" for each in forward)),
                ("near to far", f"{self.near:.6g} to {self.far:.6g}"),
            ]
        return html_of(repr(self), rows, extra=self._sketch())

    def _sketch(self) -> str:
        """An SVG: the image's outline with its principal point, as far as that is inside."""
        with _core.standard_arithmetic():
            shift = 0.5 - self.pixel_centre
            x, y, dot = self.cx + shift, self.cy + shift, max(self.size) / 50
            return (f'<svg width="160" height="120" viewBox="0 0 {self.width} {self.height}" role="img">'
                    f"<title>the image and its principal point</title>"
                    f'<rect width="{self.width}" height="{self.height}" fill="none" stroke="currentColor" '
                    f'stroke-width="{dot / 2:.6g}"/><circle cx="{x:.6g}" cy="{y:.6g}" r="{dot:.6g}" fill="currentColor"/></svg>')

    def __repr__(self) -> str:
        if self.model == "TABLE":
            return f"Camera({self.width}×{self.height}, TABLE{f', name={self.name!r}' if self.name else ''})"
        names = ("fx", "fy", "cx", "cy")
        numbers = " ".join(f"{each}={getattr(self, each):.10g}," for each in names)
        skew = f" skew={self.skew:.10g}," if self.skew else ""
        name = f", name={self.name!r}" if self.name else ""
        return (f"Camera({self.width}×{self.height}, {self.model or self.projection}, {numbers}{skew} "
                f"pixel_centre={self.pixel_centre:.10g}{name})")


_identity: Rows = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))


def _from_json(text: str, table: npt.NDArray[np.float64] | None = None) -> Camera:
    """The camera of a camera file's text, and of its table of directions."""
    return Camera.from_json(text) if table is None else Camera._of(_core.camera_with_table(text, table))


def _lens_file(
    size: tuple[int, int], keys: dict[str, object], pose: Rows, near: object, far: object, max_radius: object, name: str
) -> str:
    """The text of a camera file with these keys."""
    file = {"width": size[0], "height": size[1], **keys, "name": name,
            "world_to_camera": [list(row) for row in pose], "near": _finite("near", near)}
    for key, value in (("far", far), ("max_radius", max_radius)):
        if as_number(key, value) != math.inf:
            file[key] = _finite(key, value)
    with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
        return json.dumps(file)


def _list(name: str, value: npt.ArrayLike) -> list[float]:
    """Numbers of any shape, as OpenCV's 1×5."""
    numbers = np.asarray(value, np.float64)
    return [float(each) for each in as_finite(name, numbers.ravel(), (numbers.size,))]


def _finite(name: str, value: object) -> float:
    number = as_number(name, value)
    if not math.isfinite(number):
        raise ValueError(f"{name}: expected a finite number, found {number!r}")
    return number


def _point(name: str, value: npt.ArrayLike) -> list[float]:
    return [float(each) for each in as_finite(name, value, (3,))]


def _view(azimuth: float, elevation: float, up: Up) -> _core.View:
    return _core.View(as_number("azimuth", azimuth), as_number("elevation", elevation), _up(up))


def _up(up: Up) -> list[float]:
    if not isinstance(up, str):
        return _point("up", up)
    word = one_of("up", up, ("x", "y", "z", "-x", "-y", "-z"))
    return [(-1.0 if word[0] == "-" else 1.0) * (axis == word[-1]) for axis in "xyz"]


def _only(cameras: Sequence[Camera]) -> Camera:
    if len(cameras) != 1:
        raise ValueError(f"expected one camera, found {len(cameras)}: read_cameras() takes several")
    return cameras[0]


def cameras_from_json(text: str, name: str = "camera") -> list[Camera]:
    """The cameras from the text of a camera file; `name` begins error messages. Tables of directions are in other files,
    which read_cameras() reads; here they are only named, and such a camera cannot be rendered."""
    return _cameras_of(text, name, is_file=False)


def _cameras_of(text: str, name: str, *, is_file: bool) -> list[Camera]:
    if not isinstance(text, str):
        raise TypeError(f"text: expected a string, found {text!r}")
    try:
        text.encode()
    except UnicodeEncodeError:
        message = "text: expected a camera file's text, found one with lone surrogates"
        raise ValueError(message) from None
    # A file's name may stand for any bytes.
    cameras, notes = _core.cameras_from_json(text, os.fsencode(path_of("name", name)), is_file)
    warn(notes)
    return [Camera._of(each) for each in cameras]


def read_cameras(file: Path) -> list[Camera]:
    """Reads a camera file with one camera or a list (a camera path). Raises InputError, which names
    the file."""
    name = os.fsdecode(path_of("file", file))
    try:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
    except OSError as error:
        raise InputError(f"{name}: cannot be opened: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{name}: is not text, expected a camera file (JSON); fathom.read_map({name!r}).camera is the camera "
                         "of a map") from None
    return _cameras_of(text, name, is_file=True)


def write_cameras(file: Path, cameras: Iterable[Camera]) -> None:
    """Writes a camera file: an object for a single camera, a list for several. Creates missing
    folders. Names the files of tables of directions as they were named when they were read. Raises OutputError if the
    file cannot be written, or if a table is from an array and thus in no file."""
    path_of("file", file)
    handles = [camera_handle(camera) for camera in cameras]
    if any(_core.has_table_without_file(each) for each in handles):
        raise OutputError(f"{os.fsdecode(file)}: a table of directions is in no file: write the camera's directions() with "
                          "numpy.save() and name that file in a camera file")
    text = _core.cameras_to_json(handles)
    make_folder_of(file)
    try:
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text + "\n")
    except OSError as error:
        raise OutputError(f"{os.fsdecode(file)}: {error.strerror}") from None
