"""Rendering, and what is asked of its options."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Union, cast

import numpy as np

from . import _core
from ._arguments import (
    as_array,
    as_number,
    as_threads,
    camera_handle,
    culls,
    in_pixels,
    in_words,
    no_camera,
    one_of,
    require_one_matrix,
    scene_handle,
    takes_pixel_centre,
)
from ._importing import ViewWarning
from .camera import Camera
from .maps import Map, rendered

if TYPE_CHECKING:
    import numpy.typing as npt

    from .scene import Scene

Cull = Literal["none", "back", "front"]
Background = Union[float, Literal["inf", "nan"]]
Normals = Literal["file", "vertex", "place"]
normal_sources = ("file", "vertex", "place")

def render_cameras(
    scene: Scene,
    camera: Camera | Sequence[Camera],
    channels: Sequence[str],
    cull: str,
    dtype: npt.DTypeLike,
    scale: float,
    background: Background,
    engine: str,
    threads: int,
    normals: str,
    out: Mapping[str, npt.NDArray[Any]] | None = None,
    stacklevel: int = 3,
) -> Map:
    """`stacklevel` is that of the caller whom warnings are for."""
    names = channel_names(channels)
    stored = stored_type(dtype)
    options = _core.RenderOptions(
        names,
        one_of("cull", cull, culls),
        stored,
        as_number("scale", scale),
        one_of("engine", engine, ("fast", "reference")),
        as_threads(threads),
        one_of("normals", normals, normal_sources),
    )
    nothing = background_value(background, stored)
    single = isinstance(camera, Camera)
    cameras = [camera] if isinstance(camera, Camera) else list_of_cameras(camera)
    require_room(cameras, names, stored)
    width, height = cameras[0].size
    handle = scene_handle(scene)
    arrays = room_for(names, stored, (height, width) if single else (len(cameras), height, width), out)
    if out is not None:
        check_apart(handle, arrays)
    handles = [camera_handle(each) for each in cameras]
    try:
        if single:
            description, notes = _core.render_one(handle, handles[0], options, list(arrays.values()))
            result = Map(arrays, cameras[0], description)
        else:
            descriptions, notes = _core.render_stack(handle, handles, options, list(arrays.values()))
            result = Map(arrays, _views=list(zip(cameras, descriptions)))
            result._description.png_scale = descriptions[0].png_scale
            result._description.tables = descriptions[0].tables
    except _core.InputError:
        scene._check()
        raise
    if nothing is not None:
        result._set_background(nothing)
    for note in notes:
        warnings.warn(note, ViewWarning, stacklevel=stacklevel)
    return result


def room_for(
    names: list[str], stored: str, shape: tuple[int, ...], out: Mapping[str, npt.NDArray[Any]] | None
) -> dict[str, npt.NDArray[Any]]:
    """An array for each channel: the caller's, or a new one."""
    arrays: dict[str, npt.NDArray[Any]] = {}
    for name in names:
        parts, own = rendered[name]
        kind = np.dtype(own or stored)
        whole = (*shape, len(parts)) if parts else shape
        if out is not None:
            arrays[name] = checked_out(out, name, whole, kind)
        elif len(shape) == 3:
            arrays[name] = _core.array_in_small_pages(whole, kind)
        else:
            arrays[name] = np.empty(whole, kind)
    return arrays


def check_apart(scene: _core.Scene, arrays: Mapping[str, npt.NDArray[Any]]) -> None:
    """What is written must lie apart from what is read, and from each other."""
    names = list(arrays)
    for i, name in enumerate(names):
        if scene.overlaps(arrays[name]):
            raise ValueError(f"out: the array for channel {name} shares memory with a mesh of the scene")
        for other in names[:i]:
            if np.may_share_memory(arrays[name], arrays[other]):  # which is exact for arrays in C order
                raise ValueError(f"out: the arrays for channels {other} and {name} share memory")


def checked_out(
    out: Mapping[str, npt.NDArray[Any]], name: str, shape: tuple[int, ...], kind: np.dtype[Any]
) -> npt.NDArray[Any]:
    if not isinstance(out, Mapping):
        raise TypeError(f"out: expected a dict of arrays by the names of channels, found {type(out).__name__}")
    if name not in out:
        raise ValueError(f"out: it has no array for channel {name}")
    array = out[name]
    if not isinstance(array, np.ndarray) or array.dtype != kind:
        found = array.dtype if isinstance(array, np.ndarray) else type(array).__name__
        raise TypeError(f"out: channel {name}: expected an array of {kind}, found {found}")
    if array.shape != shape:
        raise ValueError(f"out: channel {name}: expected shape {in_words(shape)}, found {in_words(array.shape)}")
    if not array.flags.c_contiguous or not array.flags.aligned:
        raise ValueError(f"out: channel {name}: expected an array in C order")
    if not array.flags.writeable:
        raise ValueError(f"out: channel {name}: the array is read-only")
    return array


def several_cameras(name: str, cameras: object) -> list[Camera]:
    """What is in a sequence that may be one of cameras."""
    if isinstance(cameras, Mapping):
        raise TypeError(f"{name}: expected a Camera or a sequence of them, found a dict: take its values()")
    if isinstance(cameras, (str, os.PathLike)) or not isinstance(cameras, Iterable):
        raise no_camera(name, "a Camera or a sequence of them", cameras)
    return list(cameras)


def list_of_cameras(cameras: Sequence[Camera]) -> list[Camera]:
    listed = several_cameras("camera", cameras)
    if not listed:
        raise ValueError("camera: expected at least one")
    for each in listed:
        camera_handle(each)
        if each.size != listed[0].size:
            raise ValueError(
                "camera: a stack of maps needs cameras of one size, found "
                f"{in_pixels(listed[0].size)} and {in_pixels(each.size)}"
            )
    return listed


def channel_names(channels: Sequence[str]) -> list[str]:
    if isinstance(channels, str):
        channels = channels.split(",")
    if not isinstance(channels, Iterable):
        raise TypeError(f"channels: expected a sequence of names, found {channels!r}")
    names: list[str] = []
    for name in channels:
        if not isinstance(name, str):
            raise TypeError(f"channels: expected names, found {name!r}")
        if name not in rendered:
            raise ValueError(f"channels: {_core.unknown_channel(name)}")
        if name not in names:
            names.append(name)
    if not names:
        raise ValueError("channels: expected at least one")
    return names


def stored_type(dtype: npt.DTypeLike) -> str:
    try:
        name = "None" if dtype is None else np.dtype(dtype).name
    except TypeError:
        name = str(dtype)
    if name not in ("float32", "float64", "uint16"):
        raise TypeError(f"dtype: expected float32, float64 or uint16, found {name}")
    return name


def background_value(background: Background, stored: str) -> float | None:
    """The value to put in; None where the one that maps have anyway is asked for."""
    value = math.inf if background == "inf" else math.nan if background == "nan" else as_number("background", background)
    if stored == "uint16":
        if value not in (0, math.inf):
            raise ValueError("background: codes of uint16 have 0 where there is no surface, and nothing else")
        return None
    return None if value == math.inf else value


def require_room(cameras: list[Camera], names: list[str], stored: str) -> None:
    """Raises MemoryError rather than have the system end the process."""
    pixels = float(cameras[0].width) * cameras[0].height
    if pixels > 2.0**44:
        raise ValueError(f"size: an image of {in_pixels(cameras[0].size)} has more than 2^44 pixels")
    bytes_of_pixel = sum(
        np.dtype(own or stored).itemsize * max(1, len(parts)) for parts, own in (rendered[name] for name in names)
    )
    needed = pixels * len(cameras) * bytes_of_pixel
    if needed > 2.0**28:  # to ask what there is takes longer than a small map
        maps = "" if len(cameras) == 1 else f"{len(cameras)} maps of "
        _core.require_bytes(f"{maps}{in_pixels(cameras[0].size)} pixels", needed)


@takes_pixel_centre
def render(
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    K: npt.ArrayLike,
    T: npt.ArrayLike,
    size: Sequence[int],
    *,
    pixel_centre: float,
    channels: Sequence[str] = ("Z",),
    near: float = 0,
    far: float = math.inf,
    cull: Cull = "none",
    dtype: npt.DTypeLike = "float32",
    scale: float = 1000,
    background: Background = math.inf,
    normals: Normals = "file",
    threads: int = 0,
    out: Mapping[str, npt.NDArray[Any]] | None = None,
) -> Map:
    """Renders the exact depth map of a mesh: every value is the exact number, rounded once.

    vertices      N×3, float64 or float32, in the world
    faces         M×3 triangles; integers of any type, numbers of vertices from 0
    K             3×3, fx skew cx / 0 fy cy / 0 0 1, in pixels; or a stack of n, n×3×3
    T             4×4 or 3×4, world to camera, x right, y down, z forward (OpenCV); or a stack of n
    size          (width, height) in pixels
    pixel_centre  the image coordinate of the first pixel's centre, as K counts: 0.5 (COLMAP, OpenGL) or 0 (OpenCV,
                  BOP). There is no default: half a pixel is the error that is made most often.
    channels      what to render, ("Z", "id") or "Z,id": Z (planar depth), A (coverage), Zlow (exact depth minus Z), distance (along the ray),
                  id, face, object (numbers of what is visible; NO_SURFACE where nothing is), material, group, part
                  and label (of a Scene; NO_SEGMENT where what is visible has none), N (normal) and P (position), both
                  in the world, bary (weights of a triangle's second and third corner), Nc (normal in the camera
                  frame), Ns (the corners' normals interpolated, in the world)
    near, far     the range of planar depth that counts, in scene units
    cull          "back" or "front" leaves out triangles that face so
    dtype         of Z and distance: float32, float64, or uint16 for codes round(scale · depth), 0 for no surface
    background    what Z and distance have where there is no surface (and where a depth is beyond the greatest number
                  of the type): inf, nan, 0 or any other number
    normals       of Ns: "file" (where there are none, as "vertex"), "vertex": sums over the triangles at each vertex,
                  weighted by area, or "place": over those at all vertices that lie at one place
    threads       to work in; 0: all. Results never depend on it.
    out           arrays to write to, by channel, such as an earlier call has returned: saves the time in which the
                  system provides memory. They must fit, and are what is returned.

    Returns a dict: H×W arrays by the names of channels, H×W×3 for N, P, Nc and Ns, H×W×2 for bary; with n cameras, n of
    each, n×H×W(×3). Arrays of vertices and faces that fit (see Scene.add_mesh()) are not copied. Other Python threads run
    meanwhile, and Ctrl-C ends it.

    Warns (ViewWarning) of what is probably not meant: nothing in front of the camera, a matrix from camera to world, one
    that is no rotation, a principal point far from the middle, an eye inside a solid, metres beside millimetres.

    Raises TypeError, ValueError or IndexError, which name the argument; MemoryError; OutputError where a depth has no
    code.

    >>> corners = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float)
    >>> K = np.array([[4, 0, 2], [0, 4, 2], [0, 0, 1]], float)
    >>> render(corners, [(0, 1, 2)], K, np.eye(4), (4, 4), pixel_centre=0.5)["Z"]
    array([[inf, inf, inf, inf],
           [inf,  4.,  4., inf],
           [inf, inf, inf, inf],
           [inf, inf, inf, inf]], dtype=float32)
    """
    from .scene import Scene

    scene = Scene()
    scene.add_mesh(vertices, faces)
    cameras = cameras_of(K, T, size, pixel_centre, near, far)
    return render_cameras(scene, cameras, channels, cull, dtype, scale, background, "fast", threads, normals, out,
                          stacklevel=4)


def cameras_of(
    K: npt.ArrayLike, T: npt.ArrayLike, size: Sequence[int], pixel_centre: float, near: float, far: float
) -> Camera | list[Camera]:
    """One camera, or as many as K or T is a stack of; the other one may be a single matrix for all."""
    require_one_matrix("T", T)
    intrinsics, poses = as_array("K", K), as_array("T", T)
    counts = {len(stack) for stack in (intrinsics, poses) if stack.ndim == 3}
    if not counts:
        return Camera.from_opencv(K, T, size, pixel_centre=pixel_centre, near=near, far=far)
    if len(counts) > 1:
        raise ValueError(f"K and T: expected stacks of one length, found {len(intrinsics)} and {len(poses)}")
    count = counts.pop()

    def each(stack: npt.NDArray[np.float64], i: int) -> npt.NDArray[np.float64]:
        return cast("npt.NDArray[np.float64]", stack[i]) if stack.ndim == 3 else stack

    return [
        Camera.from_opencv(each(intrinsics, i), each(poses, i), size, pixel_centre=pixel_centre, near=near, far=far)
        for i in range(count)
    ]
