"""Cameras of other programs and of data sets, by name: these functions are class methods of Camera.

All conventions are in docs/data-sets.md and docs/conventions.md.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Literal, Protocol, TypeVar

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
        """A class that makes cameras from those of the extension module."""

        @classmethod
        def _of(cls: type[Camera], core: _core.Camera) -> Camera: ...

    #: fathom.Camera, which builds on this module.
    Camera = TypeVar("Camera", bound=Imported)


def from_colmap(
    cls: type[Camera], folder: Path, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of a COLMAP model (cameras and images, .bin or .txt), by the names of their
    images.

    Those with lens distortion are left out with a ViewWarning, unless `ignore_distortion` takes
    their pinhole part. Raises InputError where none is left.
    """
    return _named(cls, _core.import_colmap(path_of("folder", folder), ignore_distortion))


def from_nerf(
    cls: type[Camera], file: Path, size: Size | None = None, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of a transforms.json, by their file_path; those of frames without one by their
    number. `size`, (width, height) in pixels, is for files without w and h. Lens distortion is as
    in from_colmap().

    Raises InputError, which names the frame, where two have one file_path, a focal length is
    negative (an angle beyond π radians gives such), or the file has another size than the one that
    is given.
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
    millimetres, as in the file. Without `size` it is that of the data set's camera.json, which is
    looked for in the scene's folder and the two above.
    """
    width, height = (0, 0) if size is None else as_size(size)
    return _named(cls, _core.import_bop(path_of("file", file), width, height))


def from_sfm_data(
    cls: type[Camera], file: Path, *, ignore_distortion: bool = False
) -> dict[str, Camera]:
    """The cameras of AliceVision's (Meshroom's) sfmData as JSON, by the paths of their images below
    the folder that all have in common. Views without a pose are left out with a ViewWarning; lens
    distortion is as in from_colmap(). Meshroom's meshes have y and z the other way round than its
    cameras.
    """
    return _named(cls, _core.import_sfm_data(path_of("file", file), ignore_distortion))


def from_gltf(cls: type[Camera], file: Path, size: Size) -> dict[str, Camera]:
    """The cameras of a .gltf or .glb, by the names of their nodes. `size`, (width, height) in
    pixels, must have the aspect ratio of a camera that has one.
    """
    return _named(cls, _core.import_gltf(path_of("file", file), *as_size(size)))


# Data sets: `K` 3×3 or (fx, fy, cx, cy), `size` (width, height) and `pixel_centre` replace what the
# data set has.


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
    """Cameras of matrices, by `names` or by their numbers. What the arrays do not say has no
    default.

    K          3×3, or n×3×3 with one for each pose
    poses      n×4×4 or n×3×4
    direction  which way they lead
    axes       x right in both; y down and z forward ("opencv"), or y up and z backward ("opengl")

    Exact: an inverse is exact, and each of its entries rounded once.

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
    """The cameras of a TUM RGB-D trajectory, or of the folder with its groundtruth.txt, by their
    times; of a list of `images` (rgb.txt, depth.txt) by the names of these, each with the pose
    nearest in time: those with none within 0.02 s are left out with a ViewWarning. "ros" is meant
    for depth images, the others for colour. 640×480 pixels and pixel_centre 0 without others.
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
    """The cameras of a sequence of 7-Scenes (frame-XXXXXX.pose.txt), by "frame-XXXXXX". 640×480
    pixels, focal lengths 585, (320, 240) and pixel_centre 0 without others.
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
    """The cameras of a scene of ScanNet (pose/N.txt, intrinsic/), by their numbers. Frames that
    were not tracked, with poses of -inf, are left out with a ViewWarning. 640×480 or 1296×968
    pixels and pixel_centre 0 without others.
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
    """The cameras of ScanNet++'s iphone/pose_intrinsic_imu.json (aligned_pose, intrinsic), by their
    frames. 1920×1440 pixels and pixel_centre 0 without others.
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
    """The cameras of a scene of Replica as iMAP and NICE-SLAM have it (traj.txt; cam_params.json
    beside it or in the folder above), by "frame000000", …. pixel_centre is 0 without another.
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
    """KITTI's rectified cameras, of calib.txt (which needs `size`) or calib_cam_to_cam.txt: these
    themselves, by the names of their folders ("image_2", "image_02"), in the frame of camera 0; or,
    with `poses` (poses/NN.txt), number `camera` of each frame, by "000000", …. pixel_centre is 0
    without another.
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


def _named(cls: type[Camera], imported: tuple[_core.Named, list[str]]) -> dict[str, Camera]:
    """Cameras of a class, with a warning for each note."""
    cameras, notes = imported
    warn(notes)
    return {name: cls._of(camera) for name, camera in cameras}
