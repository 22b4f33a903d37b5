"""Rays: which triangles they meet, and where. Every decision is exact; values are rounded once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arguments import as_finite, as_names, as_number, as_threads, culls, in_words, one_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from .names import Cull, RayChannels

    Numbers = npt.NDArray[np.float64]

ray_modes = ("nearest", "all")


class Asked(NamedTuple):
    """The arguments that all questions have, checked."""

    origins: Numbers
    directions: Numbers
    #: Of the results.
    shape: tuple[int, ...]
    #: t_min, t_max, open, cull and threads as the extension module takes them.
    options: tuple[float, float, bool, str, int]


def asked(
    origins: npt.ArrayLike, directions: npt.ArrayLike | None, tmin: float, tmax: float, open: bool, cull: Cull, threads: int
) -> Asked:
    o, d = origins_and_directions(origins, directions)
    first, last = as_number("tmin", tmin), as_number("tmax", tmax)
    if not first <= last:
        raise ValueError(f"tmin: expected a number that is at most tmax, found {first} and {last}")
    options = (first, last, bool(open), one_of("cull", cull, culls), as_threads(threads))
    return Asked(_flat(o), _flat(d), o.shape[:-1], options)


def origins_and_directions(origins: npt.ArrayLike, directions: npt.ArrayLike | None) -> tuple[Numbers, Numbers]:
    """Arrays of the same shape, which ends in 3. Without directions, `origins` has six numbers for each ray."""
    if directions is None:
        rays = _rows_of_six(origins)
        o, d = rays[..., :3], rays[..., 3:]
    else:
        o, d = rows_of_three("origins", origins), rows_of_three("directions", directions)
    try:
        shape = np.broadcast_shapes(o.shape, d.shape)
    except ValueError:
        raise ValueError(f"directions: the shape {in_words(d.shape)} does not fit {in_words(o.shape)} of origins") from None
    with _core.standard_arithmetic():  # or else subnormal numbers might be 0
        is_zero = (d == 0).all(axis=-1)
    if is_zero.any():
        place = [int(i) for i in np.argwhere(is_zero)[0]]
        raise ValueError(f"directions: the direction at {place} is 0")
    return np.broadcast_to(o, shape), np.broadcast_to(d, shape)


def rows_of_three(name: str, value: npt.ArrayLike) -> Numbers:
    numbers = as_finite(name, value)
    if numbers.ndim == 0 or numbers.shape[-1] != 3:
        raise ValueError(f"{name}: expected shape N×3, found {in_words(numbers.shape)}")
    return numbers


def _rows_of_six(value: npt.ArrayLike) -> Numbers:
    numbers = as_finite("origins", value)
    if numbers.ndim == 0 or numbers.shape[-1] != 6:
        raise ValueError(f"origins: expected shape N×6 without directions, found {in_words(numbers.shape)}")
    return numbers


def _flat(numbers: Numbers) -> Numbers:
    return np.ascontiguousarray(numbers).reshape(-1, 3)


def checked_channels(channels: RayChannels) -> list[str]:
    names = as_names("channels", channels)
    for name in names:
        if name not in _core.ray_channels:
            raise ValueError(f"channels: {_core.unknown_ray_channel(name)}")
    return names


def real_type(dtype: npt.DTypeLike) -> np.dtype[Any]:
    kind = np.dtype(dtype)
    if kind not in (np.float32, np.float64):
        raise TypeError(f"dtype: expected float32 or float64, found {kind}")
    return kind


def hit_arrays(
    rays: _core.Rays, question: Asked, found: tuple[npt.NDArray[np.uint32], Numbers], channels: Sequence[str],
    kind: np.dtype[Any],
) -> dict[str, npt.NDArray[Any]]:
    """The channels of hits, one for each row of the question; also "front", whether the ray meets the front."""
    triangles, t = found
    arrays: dict[str, npt.NDArray[Any]] = {"id": triangles}
    if not {"distance", "P", "bary", "N", "front"}.isdisjoint(channels):
        given = (rays, question.origins, question.directions, triangles, question.options[-1])
        values = _core.hit_values32(*given) if kind == np.float32 else _core.hit_values64(*given)
        arrays.update(zip(("t", "distance", "P", "bary", "N", "front"), values))
    elif kind == np.float64:
        arrays["t"] = t
    elif "t" in channels:
        arrays["t"] = _t_as_float32(rays, question, triangles, t)
    if not {"object", "face"}.isdisjoint(channels):
        arrays.update(zip(("object", "face"), _core.origins_of(rays, triangles)))
    return {name: arrays[name] for name in channels}


def _t_as_float32(rays: _core.Rays, question: Asked, triangles: npt.NDArray[np.uint32], t: Numbers) -> npt.NDArray[np.float32]:
    """t rounded once. What binary64 rounds to a number within an interval lies in that interval, so a t that binary64 has
    rounded is rounded once more without harm, except half-way between two float32 numbers. Those that may be half-way, and
    all that are subnormal as float32, are computed again."""
    with _core.standard_arithmetic(), np.errstate(over="ignore"):
        narrow = t.astype(np.float32)
        low_bits = t.view(np.uint64) & np.uint64(2**29 - 1)  # that float32 does not have
        doubtful = (low_bits == 2**28) | (np.abs(t) < 2.0**-126)
    again = np.flatnonzero(doubtful & (triangles != np.uint32(2**32 - 1)))
    if len(again):
        values = _core.hit_values32(rays, np.ascontiguousarray(question.origins[again]),
                                    np.ascontiguousarray(question.directions[again]),
                                    np.ascontiguousarray(triangles[again]), question.options[-1])
        narrow[again] = values[0]
    return narrow


def hit_lists(rays: _core.Rays, question: Asked, channels: Sequence[str], kind: np.dtype[Any]) -> dict[str, npt.NDArray[Any]]:
    """The channels of all hits, with "splits" and "ray"."""
    of_hits, splits, ray, found = all_hits(rays, question)
    return {"splits": splits, "ray": ray, **hit_arrays(rays, of_hits, found, channels, kind)}


def all_hits(
    rays: _core.Rays, question: Asked
) -> tuple[Asked, npt.NDArray[np.int64], npt.NDArray[np.int64], tuple[npt.NDArray[np.uint32], Numbers]]:
    """All hits of rays: a question with a ray for each hit, where the hits of each ray begin, the numbers of the rays, and
    triangles and t."""
    given, triangles, t = _core.all_hits(rays, question.origins, question.directions, *question.options)
    splits, ray = splits_and_rays(given)
    of_hits = question._replace(origins=np.ascontiguousarray(question.origins[ray]),
                                directions=np.ascontiguousarray(question.directions[ray]))
    return of_hits, splits, ray, (triangles, t)


def splits_and_rays(given: npt.NDArray[np.uint64]) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Where the hits of each ray begin, and the ray of each hit."""
    splits = given.astype(np.int64)
    return splits, np.repeat(np.arange(len(splits) - 1), np.diff(splits))
