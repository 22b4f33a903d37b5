"""Checks of arguments; each error is one sentence that names the argument."""

from __future__ import annotations

import functools
import operator
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Callable, Protocol, TypeVar, Union, cast

import numpy as np

from . import _core

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]

    class HasScene(Protocol):
        """A fathom.Scene, for the modules on which that builds."""

        @property
        def _handle(self) -> _core.Scene: ...


Rows = tuple[tuple[float, ...], ...]
Function = TypeVar("Function", bound=Callable[..., Any])
Size = Union[tuple[int, int], Sequence[int]]

most_rows = 2**32 - 2


def as_array(name: str, value: object) -> npt.NDArray[Any]:
    """`value` as an array, without a copy if it is an array. Masked arrays are refused: maps mark missing pixels by their
    background."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: expected an array of numbers, found rows of different shapes") from None
    if array.dtype == object:
        raise TypeError(f"{name}: expected an array of numbers, found {_in_short(value)}")
    if isinstance(value, np.ma.MaskedArray) and np.any(np.asarray(value.mask)):
        raise TypeError(f"{name}: an array with a mask: fill it first, such as by filled(numpy.inf)")
    return array


def _in_short(value: object) -> str:
    return "None" if value is None else f"objects ({type(value).__name__})"


def as_text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: expected a string, found {value!r}")
    if any(letter == "\0" or "\ud800" <= letter <= "\udfff" for letter in value):
        raise ValueError(f"{name}: expected text without NUL and surrogates, found {value!r}")
    return value


def as_numbers(name: str, value: object, shape: tuple[int, ...] | None = None) -> Numbers:
    """float64 numbers in C order. Integers and narrower floats are converted exactly; the array is copied only if it has
    to be widened or moved."""
    array = as_array(name, value)
    if array.dtype.kind not in "fiu" or (array.dtype.kind == "f" and array.dtype.itemsize > 8):
        raise TypeError(f"{name}: expected float64 or float32 numbers, found {array.dtype}")
    if shape is not None and array.shape != shape:
        raise ValueError(f"{name}: expected shape {in_words(shape)}, found {in_words(array.shape)}")
    with _core.standard_arithmetic():  # or else subnormal numbers might become 0
        numbers = np.asarray(array, dtype=np.float64, order="C")
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and ((array > 2**53) | (array < -(2**53))).any():
        raise ValueError(f"{name}: an integer beyond 2^53 may be no float64 number: pass floats")
    return numbers


def as_finite(name: str, value: object, shape: tuple[int, ...] | None = None) -> Numbers:
    numbers = as_numbers(name, value, shape)
    if not np.isfinite(numbers).all():
        raise ValueError(f"{name}: {_first_not_finite(numbers)} is not a finite number")
    return numbers


def _first_not_finite(numbers: Numbers) -> str:
    place = tuple(int(i) for i in np.argwhere(~np.isfinite(numbers))[0])
    return f"{numbers[place]} at {list(place)}"


def as_number(name: str, value: Any) -> float:
    try:
        if not isinstance(value, (str, bytes, bytearray)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise TypeError(f"{name}: expected a number, found {value!r}")


#: The values of `cull`.
culls = tuple(_core.culls)
#: The values of `edges`.
edge_selections = tuple(_core.edge_selections)
#: The values of `frame`.
point_frames = tuple(_core.point_frames)

most_threads = 1024


def as_threads(value: Any) -> int:
    return as_count("threads", value, 0, most_threads)


def in_pixels(size: Sequence[int]) -> str:
    width, height = size
    return f"{width}×{height}"


def as_count(name: str, value: Any, least: int, most: int) -> int:
    try:
        count = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected an integer, found {value!r}") from None
    if not least <= count <= most:
        raise ValueError(f"{name}: expected {least} to {most}, found {count}")
    return count


def as_size(size: Any) -> tuple[int, int]:
    """(width, height) in pixels."""
    try:
        width, height = size
    except (TypeError, ValueError):
        raise TypeError(f"size: expected (width, height), found {size!r}") from None
    return as_count("size: width", width, 1, 2**32 - 1), as_count("size: height", height, 1, 2**32 - 1)


def one_of(name: str, value: object, allowed: Iterable[str]) -> str:
    names = list(allowed)
    if not isinstance(value, str) or value not in names:
        raise ValueError(f"{name}: expected {', '.join(map(repr, names))}, found {value!r}")
    return value


def as_names(name: str, value: Any) -> list[str]:
    """Names from a sequence, or from a text with commas."""
    listed = value.split(",") if isinstance(value, str) else value
    if not isinstance(listed, Iterable):
        raise TypeError(f"{name}: expected a sequence of names, found {value!r}")
    names = list(listed)
    for each in names:
        if not isinstance(each, str):
            raise TypeError(f"{name}: expected names, found {each!r}")
    return names


def scene_handle(scene: object) -> _core.Scene:
    """The extension module's object behind a Scene."""
    handle = getattr(scene, "_handle", None)
    if not isinstance(handle, _core.Scene):
        raise TypeError(f"scene: expected a Scene, found {scene!r}")
    return handle


def camera_handle(camera: object) -> _core.Camera:
    handle = getattr(camera, "_handle", None)
    if not isinstance(handle, _core.Camera):
        raise no_camera("camera", "a Camera", camera)
    return handle


def no_camera(name: str, expected: str, found: object) -> TypeError:
    """The error for a value that is not a Camera. The path of a camera file is a common mistake."""
    hint = f"; fathom.read_cameras({found!r}) reads a camera file" if isinstance(found, (str, os.PathLike)) else ""
    return TypeError(f"{name}: expected {expected}, found {found!r}{hint}")


def takes_pixel_centre(function: Function) -> Function:
    """For functions that need a `pixel_centre`: also accepts the spelling `pixel_center`, as camera files do, and explains
    the argument if it is missing."""

    @functools.wraps(function)
    def checked(*args: Any, **options: Any) -> Any:
        if "pixel_center" in options:
            if "pixel_centre" in options:
                raise TypeError("pixel_centre: it is given twice, also as pixel_center")
            options["pixel_centre"] = options.pop("pixel_center")
        if "pixel_centre" not in options:
            raise TypeError("pixel_centre: missing; expected the image coordinate of the first pixel's centre: 0.5 (COLMAP, "
                            "OpenGL, NeRF) or 0 (OpenCV, BOP)")
        return function(*args, **options)

    return cast("Function", checked)


def in_words(shape: tuple[int, ...]) -> str:
    return "×".join(map(str, shape)) if shape else "a single number"


def vertices_of(value: object, name: str = "vertices") -> Numbers:
    """N×3 float64 numbers in C order, without a copy if possible. Values are not checked here: the engines check them."""
    array = as_array(name, value)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected shape N×3, found {in_words(array.shape)}")
    if len(array) > most_rows:
        raise ValueError(f"{name}: {len(array)} rows are more than {most_rows}")
    return as_numbers(name, array)


def faces_of(value: object, vertex_count: int) -> npt.NDArray[np.uint32]:
    """M×3 32-bit integers in C order, without a copy if possible."""
    array = as_array("faces", value)
    if array.size == 0:
        raise ValueError("faces: a mesh needs at least one triangle")
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces: expected integers, found {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"faces: expected shape M×3 (triangles), found {in_words(array.shape)}")
    if len(array) > most_rows:
        raise ValueError(f"faces: {len(array)} rows are more than {most_rows}")
    if array.dtype.itemsize == 4 and array.dtype.isnative:
        # As unsigned numbers, negative indices are beyond any count, and engines refuse them.
        return np.ascontiguousarray(array).view(np.uint32)
    check_corners(array, vertex_count)
    return np.ascontiguousarray(array, dtype=np.uint32)


def check_corners(faces: npt.NDArray[Any], vertex_count: int) -> None:
    bad = np.argwhere((faces < 0) | (faces >= vertex_count))
    if len(bad):
        row, column = (int(i) for i in bad[0])
        vertex = int(faces[row, column])
        # An array of int32 is read as uint32: a number beyond 2^31 was negative, because no mesh has so many vertices.
        if faces.dtype == np.uint32 and vertex >= 2**31:
            vertex -= 2**32
        raise IndexError(
            f"faces: row {row} has vertex {vertex}, but there are {vertex_count} vertices, "
            "numbered from 0"
        )


def labels_of(value: object, face_count: int) -> npt.NDArray[np.uint32]:
    """A label for each face, or one for all; a negative number means no label."""
    array = as_array("labels", value)
    if array.dtype.kind not in "iub":
        raise TypeError(f"labels: expected integers, found {array.dtype}")
    if array.shape not in ((), (face_count,)):
        raise ValueError(f"labels: expected one integer for each of {face_count} faces, found {in_words(array.shape)}")
    if array.size and int(array.max()) >= _core.no_segment:
        raise ValueError(f"labels: {int(array.max())} is more than {_core.no_segment - 1}")
    numbers = np.where(array < 0, _core.no_segment, array) if array.dtype.kind == "i" else array
    return np.ascontiguousarray(np.atleast_1d(numbers), dtype=np.uint32)


def names_of(argument: str, value: object, face_count: int) -> tuple[npt.NDArray[np.uint32], list[str]]:
    """The number of each face's name (or of the single name), and the names by number."""
    if not isinstance(value, (str, Iterable)):
        raise TypeError(f"{argument}: expected a name, or one for each face, found {value!r}")
    given: list[object] = [value] if isinstance(value, str) else list(value)
    if not isinstance(value, str) and len(given) != face_count:
        raise ValueError(f"{argument}: expected one name for each of {face_count} faces, found {len(given)}")
    numbers: dict[str, int] = {}
    of_faces = np.empty(len(given), np.uint32)
    for place, name in enumerate(given):
        if name is not None and not isinstance(name, str):
            raise TypeError(f"{argument}: expected strings, found {name!r}")
        of_faces[place] = numbers.setdefault(str(name), len(numbers)) if name else _core.no_segment
    return of_faces, list(numbers)


def check_elements(vertices: Numbers, faces: npt.NDArray[Any]) -> None:
    """Reports in terms of the caller's arguments why an engine refused a mesh."""
    if not np.isfinite(vertices).all():
        raise ValueError(f"vertices: {_first_not_finite(vertices)} is not a finite number")
    check_corners(faces, len(vertices))


def pose_of(name: str, value: object) -> Rows:
    """The three rows of a 3×4 matrix, or of a 4×4 matrix whose last row is 0 0 0 1."""
    require_one_matrix(name, value)
    array = as_array(name, value)
    if array.shape not in ((3, 4), (4, 4)):
        raise ValueError(f"{name}: expected shape 4×4 or 3×4, found {in_words(array.shape)}")
    matrix = as_finite(name, array)
    if len(matrix) == 4 and matrix[3].tolist() != [0, 0, 0, 1]:
        hint = "; is it transposed?" if matrix[:, 3].tolist() == [0, 0, 0, 1] else ""
        raise ValueError(f"{name}: expected the last row to be 0 0 0 1, found {_row(matrix[3])}{hint}")
    return tuple(map(tuple, matrix[:3].tolist()))


def require_one_matrix(name: str, value: object) -> None:
    """Explains the common mistake of OpenCV users to pass a rotation and a translation separately."""
    if isinstance(value, (tuple, list)) and len(value) == 2 and not isinstance(value[0], (int, float)):
        if np.size(value[0]) == 9 and np.size(value[1]) == 3:
            raise ValueError(f"{name}: expected one matrix, found R and t: np.column_stack([R, t]) is one")


def _row(numbers: Numbers) -> str:
    return " ".join(f"{number:g}" for number in numbers)
