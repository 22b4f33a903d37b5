"""Cameras of other programs and of data sets, by name: these functions are class methods of Camera.

All conventions are in docs/data-sets.md and docs/conventions.md.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeVar

from . import _core
from ._core import InputError
from ._arguments import (
    Size,
    as_count,
    as_finite,
    as_number,
    as_numbers,
    as_size,
    as_text,
    in_words,
    one_of,
    takes_pixel_centre,
)
from ._files import Path, path_of
from ._warnings import warn

if TYPE_CHECKING:
    import numpy.typing as npt

    class Imported(Protocol):
        """A class that makes cameras from the extension module's cameras."""

        @classmethod
        def _of(cls: type[Camera], core: _core.Camera) -> Camera: ...

    #: fathom.Camera, which builds on this module.
    Camera = TypeVar("Camera", bound=Imported)


def from_colmap(
    cls: type[Camera], folder: Path, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of a COLMAP model (cameras and images, .bin or .txt), by the names of their
    images.

    Lenses are taken over as they are (docs/lenses.md). Cameras with another lens are left out with
    a ViewWarning; with `ignore_distortion` all lenses are pinholes. Raises InputError if no camera
    is left.
    """
    return _named(cls, _core.import_colmap(path_of("folder", folder), ignore_distortion))


def from_nerf(
    cls: type[Camera], file: Path, size: Size | None = None, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of a transforms.json, by file_path, or by number for frames without file_path.
    `size`, (width, height) in pixels, is for files without w and h. Lens distortion is handled as
    in from_colmap().

    Raises InputError, which names the frame, if two frames have the same file_path, if a focal
    length is negative (as by an angle beyond π radians), or if the file has another size than
    `size`.
    """
    width, height = (0, 0) if size is None else as_size(size)
    imported = _core.import_nerf(path_of("file", file), width, height, ignore_distortion)
    made = _named(cls, imported)
    seen: set[str] = set()
    for name, camera in imported[0]:
        fault = _fault_of_frame(camera, size is not None and (width, height))
        if name in seen:
            fault = "there are two frames with this file_path"
        if fault:
            raise InputError(f"{os.fsdecode(file)}: frame {name}: {fault}")
        seen.add(name)
    return made


def from_bop(cls: type[Camera], file: Path, size: Size | None = None) -> dict[str, Camera]:
    """The cameras of a scene_camera.json of BOP, or of the scene's folder, by image id. Lengths are
    millimetres, as in the file. Without `size`, the size is read from the data set's camera.json in
    the scene's folder or one of the two folders above.
    """
    width, height = (0, 0) if size is None else as_size(size)
    return _named(cls, _core.import_bop(path_of("file", file), width, height))


def from_sfm_data(
    cls: type[Camera], file: Path, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of AliceVision's (Meshroom's) sfmData as JSON, by the paths of their images below
    their common folder. Views without a pose are left out with a ViewWarning; lens distortion is
    handled as in from_colmap(). Meshroom's meshes have y and z reversed relative to its cameras.
    """
    return _named(cls, _core.import_sfm_data(path_of("file", file), ignore_distortion))


def from_gltf(cls: type[Camera], file: Path, size: Size) -> dict[str, Camera]:
    """The cameras of a .gltf or .glb, by the names of their nodes. `size`, (width, height) in
    pixels, must have the camera's aspect ratio, if the camera specifies it.
    """
    return _named(cls, _core.import_gltf(path_of("file", file), *as_size(size)))


# Data sets: `K` 3×3 or (fx, fy, cx, cy), `size` (width, height) and `pixel_centre` replace the data
# set's values.


@takes_pixel_centre
def from_matrices(
    cls: type[Camera],
    K: npt.ArrayLike,
    poses: npt.ArrayLike,
    size: Size,
    *,
    direction: Literal["world-to-camera", "camera-to-world"],
    axes: Literal["opencv", "opengl"],
    pixel_centre: float,
    names: Iterable[str] | None = None,
) -> dict[str, Camera]:
    """Cameras from matrices, by `names` or by their numbers. Conventions have no default.

    K          3×3, or n×3×3, one for each pose
    poses      n×4×4 or n×3×4
    direction  of the poses: "world-to-camera" or "camera-to-world"
    axes       "opencv": x right, y down, z forward; "opengl": x right, y up, z backward

    Exact: each entry of an inverse is exact, rounded once.

    >>> K = [[500, 0, 320], [0, 500, 240], [0, 0, 1]]
    >>> ahead = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4]]  # the eye is 4 units behind the origin
    >>> from fathom import Camera
    >>> cameras = Camera.from_matrices(K, [ahead], (640, 480), direction="camera-to-world",
    ...                                axes="opencv", pixel_centre=0)
    >>> cameras["0"].world_to_camera[2]
    array([0., 0., 1., 4.])
    """
    matrices = as_numbers("poses", poses)
    if matrices.ndim != 3 or matrices.shape[1:] not in ((4, 4), (3, 4)):
        raise ValueError(f"poses: expected shape n×4×4 or n×3×4, found {in_words(matrices.shape)}")
    if matrices.shape[1] == 4 and not (matrices[:, 3] == (0, 0, 0, 1)).all():
        raise ValueError("poses: expected the last rows to be 0 0 0 1")
    intrinsics = as_numbers("K", K)
    if intrinsics.shape[-2:] != (3, 3) or intrinsics.ndim > 3:
        raise ValueError(f"K: expected shape 3×3 or n×3×3, found {in_words(intrinsics.shape)}")
    numbered = map(str, range(len(matrices)))
    words = list(numbered) if names is None else [as_text("names", each) for each in names]
    if len(words) != len(matrices):
        raise ValueError(f"names: expected {len(matrices)}, found {len(words)}")
    return _named(cls, _core.import_matrices(
        [(word, tuple(map(tuple, matrix[:3].tolist()))) for word, matrix in zip(words, matrices)],
        intrinsics.reshape(-1, 9).tolist(),
        one_of("direction", direction, ("world-to-camera", "camera-to-world")) == "camera-to-world",
        one_of("axes", axes, ("opencv", "opengl")) == "opengl",
        as_number("pixel_centre", pixel_centre),
        *as_size(size),
    ))


def from_tum(
    cls: type[Camera],
    trajectory: Path,
    K: npt.ArrayLike | Literal["ros", "freiburg1", "freiburg2", "freiburg3"],
    *,
    images: Path | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
    ignore_distortion: bool = False,
) -> dict[str, Camera]:
    """The cameras of a TUM RGB-D trajectory, or of the folder with its groundtruth.txt, by time.

    With a list of `images` (rgb.txt, depth.txt) they are named after the images, each with the pose
    nearest in time; images without a pose within 0.02 s are left out with a ViewWarning. K "ros" is
    meant for depth images, "freiburg1" to "freiburg3" for colour. Defaults: 640×480 pixels,
    pixel_centre 0.
    """
    lens = as_text("K", K) if isinstance(K, str) else ""
    given = _given(None if lens else K, size, pixel_centre)
    list_of_images = None if images is None else path_of("images", images)
    return _named(cls, _core.import_tum(
        path_of("trajectory", trajectory), list_of_images, lens, given, ignore_distortion))


def from_7scenes(
    cls: type[Camera],
    folder: Path,
    *,
    K: npt.ArrayLike | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
) -> dict[str, Camera]:
    """The cameras of a sequence of 7-Scenes (frame-XXXXXX.pose.txt), by "frame-XXXXXX". Defaults:
    640×480 pixels, focal lengths 585, principal point (320, 240), pixel_centre 0.
    """
    given = _given(K, size, pixel_centre)
    return _named(cls, _core.import_7scenes(path_of("folder", folder), given))


def from_scannet(
    cls: type[Camera],
    folder: Path,
    stream: Literal["depth", "colour"] = "depth",
    *,
    K: npt.ArrayLike | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
) -> dict[str, Camera]:
    """The cameras of a scene of ScanNet (pose/N.txt, intrinsic/), by number. Untracked frames, with
    poses of -inf, are left out with a ViewWarning. Defaults: 640×480 pixels (depth) or 1296×968
    (colour), pixel_centre 0.
    """
    colour = one_of("stream", stream, ("depth", "colour")) == "colour"
    given = _given(K, size, pixel_centre)
    return _named(cls, _core.import_scannet(path_of("folder", folder), colour, given))


def from_scannetpp(
    cls: type[Camera],
    file: Path,
    *,
    K: npt.ArrayLike | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
) -> dict[str, Camera]:
    """The cameras of ScanNet++'s iphone/pose_intrinsic_imu.json (aligned_pose, intrinsic), by
    frame. Defaults: 1920×1440 pixels, pixel_centre 0.
    """
    given = _given(K, size, pixel_centre)
    return _named(cls, _core.import_scannetpp(path_of("file", file), given))


def from_replica(
    cls: type[Camera],
    folder: Path,
    *,
    K: npt.ArrayLike | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
) -> dict[str, Camera]:
    """The cameras of a scene of Replica in the layout of iMAP and NICE-SLAM (traj.txt;
    cam_params.json in the same folder or the folder above), by "frame000000", …. Default:
    pixel_centre 0.
    """
    given = _given(K, size, pixel_centre)
    return _named(cls, _core.import_replica(path_of("folder", folder), given))


def from_kitti(
    cls: type[Camera],
    calibration: Path,
    *,
    poses: Path | None = None,
    camera: int | None = None,
    size: Size | None = None,
    pixel_centre: float | None = None,
) -> dict[str, Camera]:
    """KITTI's rectified cameras, from calib.txt (which needs `size`) or calib_cam_to_cam.txt.

    Without `poses`: the cameras in the frame of camera 0, by the names of their folders ("image_2",
    "image_02"). With `poses` (poses/NN.txt): number `camera` of each frame, by "000000", ….
    Default: pixel_centre 0.
    """
    number = None if camera is None else as_count("camera", camera, 0, 3)
    trajectory = None if poses is None else path_of("poses", poses)
    given = _given(None, size, pixel_centre)
    return _named(cls, _core.import_kitti(
        path_of("calibration", calibration), trajectory, number, given))


def intrinsics_of(K: npt.ArrayLike) -> list[float]:
    """fx, fy, cx, cy, skew of a 3×3 matrix."""
    matrix = as_finite("K", K, (3, 3))
    if matrix[1, 0] != 0 or matrix[2].tolist() != [0, 0, 1]:
        raise ValueError("K: expected fx skew cx / 0 fy cy / 0 0 1; is it transposed?")
    return [float(matrix[i]) for i in ((0, 0), (1, 1), (0, 2), (1, 2), (0, 1))]


def _given(
    K: npt.ArrayLike | None, size: Size | None, pixel_centre: float | None
) -> _core.GivenLens:
    """Replacements for a data set's own lens; K is 3×3 or (fx, fy, cx, cy)."""
    width, height = (0, 0) if size is None else as_size(size)
    matrix = None
    if K is not None:
        numbers = as_finite("K", K)
        if numbers.shape == (4,):
            fx, fy, cx, cy = numbers.tolist()
            matrix = [fx, 0, cx, 0, fy, cy, 0, 0, 1]
        else:
            fx, fy, cx, cy, skew = intrinsics_of(numbers)
            matrix = [fx, skew, cx, 0, fy, cy, 0, 0, 1]
    centre = None if pixel_centre is None else as_number("pixel_centre", pixel_centre)
    return _core.GivenLens(width, height, matrix, centre)


def _fault_of_frame(camera: _core.Camera, size: tuple[int, int] | Literal[False]) -> str:
    """The fault of a camera of a transforms.json; empty if it has none."""
    if size and (camera.width, camera.height) != size:
        return (f"its size is {camera.width}×{camera.height} by w and h, {size[0]}×{size[1]} by "
                "the argument size")
    if camera.fx < 0 or camera.fy < 0:
        return (f"the focal lengths are {camera.fx:g} and {camera.fy:g} pixels; expected positive "
                "ones, and angles from 0 to π radians")
    return ""


class Cameras(dict[str, Any]):
    """Cameras by the names of their images: a dict whose KeyError lists the names."""

    def __missing__(self, name: object) -> Any:
        import difflib  # slow to import, and not needed elsewhere

        near = difflib.get_close_matches(str(name), self, n=1, cutoff=0.5)
        hint = f"did you mean {near[0]!r}?" if near else f"the first is {next(iter(self), None)!r}"
        raise KeyError(f"there is no camera {name!r} of {len(self)}; {hint}")


def _named(cls: type[Camera], imported: tuple[_core.Named, list[str]]) -> dict[str, Camera]:
    """Cameras of a class, with a warning for each note."""
    cameras, notes = imported
    warn(notes)
    return Cameras((name, cls._of(camera)) for name, camera in cameras)
