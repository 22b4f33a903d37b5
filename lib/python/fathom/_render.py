"""Rendering into arrays, with checks of its options."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import (
    as_names,
    as_number,
    as_threads,
    camera_handle,
    culls,
    in_pixels,
    in_words,
    no_camera,
    one_of,
)
from .camera import Camera

if TYPE_CHECKING:
    import numpy.typing as npt

    from .names import Background, Channels

#: The channels that fathom renders: the letters of their parts, and their type, or "" for the
#: requested type.
rendered = _core.channels()


def render_cameras(
    scene: _core.Scene,
    camera: Camera | Sequence[Camera],
    channels: Channels,
    cull: str,
    dtype: npt.DTypeLike,
    scale: float,
    engine: str,
    threads: int,
    normals: str,
    out: Mapping[str, npt.NDArray[Any]] | None,
) -> tuple[dict[str, npt.NDArray[Any]], list[tuple[Camera, _core.Map]], list[str]]:
    """Arrays by channel, of H×W for one camera and n×H×W for a sequence; each camera with the
    description of its map; notes on suspicious views."""
    names = channel_names(channels)
    stored = stored_type(dtype)
    options = _core.RenderOptions(
        names,
        one_of("cull", cull, culls),
        stored,
        as_number("scale", scale),
        one_of("engine", engine, _core.engines),
        as_threads(threads),
        one_of("normals", normals, _core.normal_sources),
    )
    is_stack = not isinstance(camera, Camera)
    cameras = [camera] if isinstance(camera, Camera) else list_of_cameras(camera)
    require_room(cameras, names, stored)
    width, height = cameras[0].size
    shape = (len(cameras), height, width) if is_stack else (height, width)
    arrays = room_for(names, stored, shape, out)
    if out is not None:
        check_apart(scene, arrays)
    handles, places = [camera_handle(each) for each in cameras], list(arrays.values())
    if is_stack:
        descriptions, notes = _core.render_stack(scene, handles, options, places)
    else:
        description, notes = _core.render_one(scene, handles[0], options, places)
        descriptions = [description]
    return arrays, list(zip(cameras, descriptions)), notes


def room_for(
    names: list[str],
    stored: str,
    shape: tuple[int, ...],
    out: Mapping[str, npt.NDArray[Any]] | None,
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
    """Output arrays must not share memory with input arrays or with each other."""
    names = list(arrays)
    for i, name in enumerate(names):
        if scene.overlaps(arrays[name]):
            raise ValueError(f"out: the array for channel {name} shares memory with a mesh of the "
                             "scene")
        for other in names[:i]:
            # Exact for arrays in C order.
            if np.may_share_memory(arrays[name], arrays[other]):
                raise ValueError(f"out: the arrays for channels {other} and {name} share memory")


def checked_out(
    out: Mapping[str, npt.NDArray[Any]], name: str, shape: tuple[int, ...], kind: np.dtype[Any]
) -> npt.NDArray[Any]:
    if not isinstance(out, Mapping):
        raise TypeError("out: expected a dict of arrays by the names of channels, found "
                        f"{type(out).__name__}")
    if name not in out:
        raise ValueError(f"out: it has no array for channel {name}")
    array = out[name]
    if not isinstance(array, np.ndarray) or array.dtype != kind:
        found = array.dtype if isinstance(array, np.ndarray) else type(array).__name__
        raise TypeError(f"out: channel {name}: expected an array of {kind}, found {found}")
    if array.shape != shape:
        raise ValueError(f"out: channel {name}: expected shape {in_words(shape)}, found "
                         f"{in_words(array.shape)}")
    if not array.flags.c_contiguous or not array.flags.aligned:
        raise ValueError(f"out: channel {name}: expected an array in C order")
    if not array.flags.writeable:
        raise ValueError(f"out: channel {name}: the array is read-only")
    return array


def several_cameras(name: str, cameras: object) -> list[Camera]:
    """The elements of a sequence of cameras."""
    if isinstance(cameras, Mapping):
        raise TypeError(f"{name}: expected a Camera or a sequence of them, found a dict: "
                        "take list(cameras.values())")
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


def channel_names(channels: Channels) -> list[str]:
    names: list[str] = []
    for name in as_names("channels", channels):
        name = _core.contents.get(name, name)
        if name not in rendered:
            raise ValueError(f"channels: {_core.unknown_contents(name)}")
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
    if name not in _core.stored_types:
        raise TypeError(f"dtype: expected float32, float64 or uint16, found {name}")
    return name


def background_value(background: Background, dtype: npt.DTypeLike) -> float | None:
    """The background to write; None if it is the value that maps have by default."""
    stored = stored_type(dtype)
    if background == "inf":
        value = math.inf
    elif background == "nan":
        value = math.nan
    else:
        value = as_number("background", background)
    if stored == "uint16":
        if value not in (0, math.inf):
            raise ValueError("background: codes of uint16 have 0 where there is no surface, and "
                             "nothing else")
        return None
    return None if value == math.inf else value


def require_room(cameras: list[Camera], names: list[str], stored: str) -> None:
    """Raises MemoryError early; otherwise the system might end the process."""
    pixels = float(cameras[0].width) * cameras[0].height
    if pixels > _core.most_pixels:
        size = in_pixels(cameras[0].size)
        raise ValueError(f"size: an image of {size} has {_core.too_many_pixels}")
    bytes_of_pixel = sum(
        np.dtype(own or stored).itemsize * max(1, len(parts))
        for parts, own in (rendered[name] for name in names)
    )
    needed = pixels * len(cameras) * bytes_of_pixel
    if needed > 2.0**28:  # asking for the free memory takes longer than a small map
        maps = "" if len(cameras) == 1 else f"{len(cameras)} maps of "
        _core.require_bytes(f"{maps}{in_pixels(cameras[0].size)} pixels", needed)
