"""Rays that are kept: origins and directions, or the rays through the pixels of a camera."""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

import numpy as np

from . import _core, _rays
from ._arguments import as_number, as_threads, camera_handle, in_words
from ._files import Path, path_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from .camera import Camera
    from .names import Cull

#: The first argument of Scene.cast() and of its companions.
RaysLike = Union["npt.ArrayLike", "Rays"]


class Rays:
    """Rays for Scene.cast(), Scene.occluded() and Scene.count().

    Rays(origins, directions) keeps two arrays of N×3 numbers, or of any shapes that end in 3 and fit each other;
    Rays(rays) keeps an array of N×6 numbers, the origin and the direction of each ray. Numbers are taken exactly.

    >>> Rays((0, 0, 0), [(0, 0, 1), (0, 1, 1)])
    Rays(2)
    """

    __slots__ = ("_camera", "_directions", "_origins")
    _camera: Camera | None
    _origins: npt.NDArray[np.float64]
    _directions: npt.NDArray[np.float64]

    def __init__(self, origins: npt.ArrayLike, directions: npt.ArrayLike | None = None) -> None:
        self._camera = None
        self._origins, self._directions = _rays.origins_and_directions(origins, directions)

    @classmethod
    def from_camera(cls, camera: Camera) -> Rays:
        """The rays through the centres of all pixels of a camera. What they meet is what the camera shows, bit for bit:

        - a ray that passes through an edge meets the triangle that the pixel shows;
        - t is the planar depth Z; P, bary and N are float32 numbers, as in maps;
        - hits are within the camera's near and far. tmin, tmax and open are not for these rays;
        - a pixel of a lens that has no ray meets nothing.

        Works for cameras with lenses and tables, too. Mode "all" and Scene.count() need a camera without a lens, take longer
        (a pixel of every triangle is decided one by one), and have the channels t, id, object and face in float64.

        >>> import fathom
        >>> scene = fathom.Scene()
        >>> _ = scene.add_mesh([(0, 0, 3), (9, 0, 3), (0, 9, 4)], [(0, 1, 2)])
        >>> camera = fathom.Camera(8, 6, 8, 8, 4, 3, pixel_centre=0.5)
        >>> bool((scene.cast(Rays.from_camera(camera), dtype="float32")["t"] == scene.render(camera)["Z"]).all())
        True
        """
        camera_handle(camera)
        rays = cls.__new__(cls)
        rays._camera = camera
        return rays

    @classmethod
    def read(cls, file: Path) -> Rays:
        """Reads rays as the command `fathom cast` does: CSV with the columns x, y, z, dx, dy and dz, or NPY of shape N×6.
        InputError names the line or the row that is faulty."""
        numbers = _core.read_rays(path_of("file", file))
        return cls(numbers)

    @classmethod
    def lidar(cls, sensor: Path, poses: Path | None = None, *, start: float | None = None, threads: int = 0) -> Rays:
        """The rays of one turn of an Ouster lidar, in metres: rows are beams, columns are times. They are the rays of
        `fathom cast --lidar`, bit for bit.

        sensor   the sensor's metadata, a JSON file
        poses    file with the path of the sensor, lines `time tx ty tz qx qy qz qw`; None: it stands at the world's zero
        start    time of column 0 in seconds; None: the first of poses
        """
        if poses is None and start is not None:
            raise ValueError("start: needs poses")
        given = None if poses is None else path_of("poses", poses)
        rays, rows = _core.lidar_rays(path_of("sensor", sensor), given, _time(start), as_threads(threads))
        return cls(rays.reshape(rows, -1, 6))

    @classmethod
    def shutter(cls, camera: Camera, poses: Path, readout: float, *, start: float | None = None, threads: int = 0) -> Rays:
        """The rays through the centres of all pixels of a moving camera with a rolling shutter: each row has its own pose.
        They are the rays of `fathom camera shutter`, bit for bit.

        camera   every pixel must have a ray. t is the planar depth, except with fisheyes, panoramas and tables: the
                 greatest component of their directions is 1 or −1 in the camera's frame, and `distance` is the channel
                 to ask for
        poses    file with the path of the camera, lines `time tx ty tz qx qy qz qw`, camera to world, if the pose of
                 `camera` is the identity. Otherwise the path of what the camera is mounted on
        readout  seconds from the top row to the bottom row; negative if the bottom row comes first
        start    time of the top row in seconds; None: the first of poses
        """
        numbers = _core.shutter_rays(
            camera_handle(camera), path_of("poses", poses), as_number("readout", readout), _time(start), as_threads(threads))
        return cls(numbers.reshape(camera.height, camera.width, 6))

    @property
    def camera(self) -> Camera | None:
        """The camera of from_camera(), else None."""
        return self._camera

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of results: (height, width) for a camera."""
        return self._origins.shape[:-1] if self._camera is None else (self._camera.height, self._camera.width)

    @property
    def origins(self) -> npt.NDArray[np.float64]:
        """…×3, read-only. For a camera they are rounded, as Camera.rays() returns them."""
        return _read_only(self._origins if self._camera is None else self._camera.rays()[0])

    @property
    def directions(self) -> npt.NDArray[np.float64]:
        """…×3, read-only. For a camera they are rounded, as Camera.rays() returns them."""
        return _read_only(self._directions if self._camera is None else self._camera.rays()[1])

    def __len__(self) -> int:
        """The number of rays."""
        return int(np.prod(self.shape))

    def __repr__(self) -> str:
        return f"Rays({in_words(self.shape)})" if self._camera is None else f"Rays.from_camera({self._camera!r})"


def _time(start: float | None) -> float | None:
    return None if start is None else as_number("start", start)


def _read_only(numbers: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    view = numbers.view()
    view.flags.writeable = False
    return view


def camera_of(rays: RaysLike) -> Camera | None:
    """The camera whose rays are meant."""
    return rays.camera if isinstance(rays, Rays) else None


def arrays_of_rays(rays: RaysLike, directions: npt.ArrayLike | None) -> tuple[npt.ArrayLike, npt.ArrayLike | None]:
    """Rays that no camera has, as arrays."""
    if not isinstance(rays, Rays):
        return rays, directions
    require_no_directions(directions)
    return rays.origins, rays.directions


def require_whole_rays(directions: npt.ArrayLike | None, tmin: float, tmax: float, open: bool) -> None:
    """Refuses arguments that rays of a camera do not have."""
    require_no_directions(directions)
    if tmin != 0 or tmax != float("inf") or open:
        raise ValueError("tmin, tmax and open: not for rays of a camera: set near and far of the camera")


def require_no_directions(directions: npt.ArrayLike | None) -> None:
    if directions is not None:
        raise TypeError("directions: not with fathom.Rays, which have directions")
