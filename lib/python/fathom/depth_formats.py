"""Depth formats: the values that a depth buffer stores, and which depths it distinguishes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import as_array, as_number, as_numbers, one_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from .names import Mapping, Storage

MAPPINGS: tuple[str, ...] = tuple(_core.mappings)
STORAGES: tuple[str, ...] = tuple(_core.storages)


class DepthFormat:
    """A mapping from planar depth to [0, 1], and the type that stores the value.

    mapping    one of MAPPINGS: "standard", "reversed", "infinite", "reversed-infinite", "opengl", "linear", "w", "log",
               "log-ulrich"
    storage    one of STORAGES: "unorm16", "unorm24", "unorm32", "float16", "float32", "float64"
    near, far  planar depths in scene units
    c          constant C of mapping "log"

    A stored value is the code of a unorm storage or the bits of a float storage; both increase with the value.

    >>> z24 = DepthFormat("standard", "unorm24", near=0.1, far=100)
    >>> z24.encode([0.1, 1, 100]).tolist()
    [0, 15114608, 16777215]
    >>> float(z24.bin_width(50.0).round(8))  # depths that differ by more have different codes
    0.00148863
    """

    def __init__(self, mapping: Mapping, storage: Storage, *, near: float, far: float, c: float = 1) -> None:
        self.mapping = one_of("mapping", mapping, MAPPINGS)
        self.storage = one_of("storage", storage, STORAGES)
        self.near = as_number("near", near)
        self.far = as_number("far", far)
        self.c = as_number("c", c)
        self._handle = _core.DepthFormat(self.mapping, self.storage, self.near, self.far, self.c)

    @property
    def greatest(self) -> int:
        """The stored value for 1."""
        return self._handle.greatest

    def encode(self, depths: npt.ArrayLike, *, clamp: bool = False) -> npt.NDArray[np.uint64]:
        """The stored values nearest to the exact values, ties to even. A depth outside [near, far] raises InputError or,
        with `clamp`, is moved to the nearer end."""
        return self._handle.encode(as_numbers("depths", depths), bool(clamp))

    def decode(self, stored: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The depths of stored values, exact, rounded once; inf for an infinite depth. Numbers of the type of a float
        storage, as glReadPixels() returns them, are taken as their bits.

        Raises InputError for values above `greatest`: the bits of floats beyond 1, of negative floats, of NaN."""
        return self._handle.decode(self._stored(stored))

    def values(self, stored: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The numbers in [0, 1] of stored values, rounded once. Raises InputError like decode()."""
        return self._handle.values(self._stored(stored))

    def resolution(self, depths: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """For the stored value of each depth, the distances from its depth to the depths of the next nearer and the next
        farther stored value; NaN without such a value."""
        numbers = as_numbers("depths", depths)
        return self._handle.to_nearer(numbers), self._handle.to_farther(numbers)

    def separation_behind(self, depths: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The distance behind each depth at which a surface gets another stored value; NaN if no surface does."""
        return self._handle.separation_behind(as_numbers("depths", depths))

    def bin_width(self, depths: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The length of the interval of depths with the same stored value as each depth."""
        return self._handle.bin_width(as_numbers("depths", depths))

    def codes_between(self, nearest: float, farthest: float) -> int:
        """The number of different stored values of the depths between these two."""
        return self._handle.codes_between(as_number("nearest", nearest), as_number("farthest", farthest))

    def _stored(self, value: Any) -> npt.NDArray[np.uint64]:
        array = as_array("stored", value)
        if array.dtype.kind == "f":
            if array.dtype.name != self.storage:
                raise TypeError(f"stored: expected integers or, for a float storage, numbers of its type, found {array.dtype} "
                                f"for {self.storage}" + self._remedy())
            array = np.ascontiguousarray(array, self.storage).view(f"uint{8 * array.dtype.itemsize}")
        if array.dtype.kind not in "iu":
            raise TypeError(f"stored: expected integers, found {array.dtype}")
        if (array < 0).any():
            raise ValueError("stored: expected values from 0 on")
        return np.asarray(array, dtype=np.uint64, order="C")

    def _remedy(self) -> str:
        """How numbers in [0, 1] become the codes that they were."""
        is_code = self.storage.startswith("unorm")
        return "; np.rint(stored * np.float64(format.greatest)).astype(int) makes codes of numbers" if is_code else ""

    def __repr__(self) -> str:
        return f"DepthFormat({self.mapping!r}, {self.storage!r}, near={self.near:g}, far={self.far:g})"
