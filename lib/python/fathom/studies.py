"""Studies of depth precision, as tables; `fathom study` writes the same results as CSV, plots and pages."""

from __future__ import annotations

import json
import os
import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._arguments import as_count, as_number, camera_handle, scene_handle
from ._core import UsageError
from ._files import Path, make_folder, path_of
from .camera import Camera

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from .scene import Scene


#: Studies that would ignore a separation. All other studies use it, or refuse it themselves.
_without_separation = ("clipping", "depth-resolution", "indistinguishable")


class Description(NamedTuple):
    """The subject of a study, and whether it takes a scene."""

    description: str
    takes_scene: bool


def names() -> dict[str, Description]:
    """All studies, by name. docs/studies.md describes their options and defaults.

    >>> names()["depth-resolution"]
    Description(description='The step of every depth format against depth, near and far', takes_scene=False)
    """
    from . import _studies

    return {name: Description(about, takes_scene) for name, about, takes_scene in _studies.names_of_studies()}


class Study:
    """The results of a study.

    name     the study's name, as in `fathom study --list`
    tables   structured arrays by name, one element per row. Counts are int64; other numbers, and counts that may be
             missing, are float64 (NaN for an empty cell); yes or no is bool; everything else is text. The types do not
             depend on the rows, even without rows, so np.concatenate() joins the tables of several runs. The CSV files of
             the same names have fewer digits
    summary  the figures of summary.json
    files    the contents of all files by name, including index.html and pictures
    """

    def __init__(
        self, name: str, files: dict[str, bytes], tables: dict[str, list[tuple[str, str, list[Any]]]]
    ) -> None:
        self.name = name
        self.files = files
        with _core.standard_arithmetic():  # Python reads decimals by binary64 arithmetic
            self.summary: dict[str, Any] = json.loads(files["summary.json"])
        self.tables: dict[str, npt.NDArray[Any]] = {
            file.removesuffix(".csv"): _table(columns) for file, columns in tables.items()
        }

    def write(self, folder: Path) -> None:
        """Writes the files to a folder, which is created if it is missing."""
        path_of("folder", folder)
        make_folder(folder)
        for name, content in self.files.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)

    def __repr__(self) -> str:
        return f"Study({self.name}: {', '.join(f'{name} {len(table)}' for name, table in self.tables.items())})"


def run(
    name: str,
    scene: Scene | None = None,
    camera: Camera | None = None,
    *,
    near: float | None = None,
    far: float | None = None,
    separation: float | None = None,
    samples: int | None = None,
    plots: bool = False,
) -> Study:
    """Runs a study and returns its tables.

    name        one of names()
    scene       scene to study, for studies that take a scene (default: the study's own scene)
    camera      camera for the scene (default: a camera that frames it in 640×360 pixels)
    near, far, separation  in scene units (default: the study's values)
    samples     number of samples (default: the study's value)
    plots       also draw plots with gnuplot; they are added to the files

    Raises UsageError for an argument that the study does not take. Ctrl-C ends the study.

    >>> steps = run("depth-resolution", near=0.1, far=1000, samples=3).tables["steps"]
    >>> at_far = steps[(steps["storage"] == "unorm24") & (steps["depth"] == 1000)]
    >>> {str(row["mapping"]): float(f"{row['step']:.3g}") for row in at_far if row["mapping"] in ("standard", "linear")}
    {'standard': 0.596, 'linear': 5.96e-05}
    """
    from . import _studies

    if not isinstance(name, str):
        raise TypeError(f"name: expected the name of a study, found {name!r}")
    if scene is None and camera is not None:
        raise ValueError("camera: it belongs to a scene: give one")
    handle = view = None
    if scene is not None:
        handle = scene_handle(scene)
        view = camera_handle(camera if camera is not None else Camera.frame(scene, size=(640, 360)))
    depths = tuple(
        None if value is None else as_number(what, value)
        for what, value in (("near", near), ("far", far), ("separation", separation))
    )
    if separation is not None and name in _without_separation:
        raise UsageError(f"the study {name} has no separation")
    count = None if samples is None else as_count("samples", samples, 2, 2**32 - 1)
    try:
        return Study(name, *_studies.run_study(name, handle, view, depths, count, bool(plots)))
    except UsageError as error:
        # The program's options are the arguments here.
        raise UsageError(re.sub(r"--(near|far|separation|samples|scene|camera)\b", r"\1", str(error))) from None


def _table(columns: Sequence[tuple[str, str, Sequence[Any]]]) -> npt.NDArray[Any]:
    arrays = [(name, _array(kind, cells)) for name, kind, cells in columns]
    table = np.empty(len(arrays[0][1]), [(name, array.dtype) for name, array in arrays])
    for name, array in arrays:
        table[name] = array
    return table


def _array(kind: str, cells: Sequence[Any]) -> npt.NDArray[Any]:
    if (kind or _kind_of(cells)) == "str":
        return np.array([cell if isinstance(cell, str) else "" if cell != cell else str(cell) for cell in cells], str)
    return np.array(cells, kind or _kind_of(cells))


def _kind_of(cells: Sequence[Any]) -> str:
    """The type of a column without a declared type."""
    kinds = {type(cell) for cell in cells}
    if kinds == {int}:
        return "int64"
    if kinds == {bool}:
        return "bool"
    return "str" if str in kinds else "float64"
