"""For test suites: assert_depth(), and a pytest fixture that keeps reports.

pytest finds the fixture `assert_depth` automatically if the module was installed or built with its metadata: by pip, from
the Debian package, or for `scripts/python -m pytest`. Otherwise put `pytest_plugins = ["fathom.testing"]` into a
conftest.py.
"""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _core, _files
from .maps import Map, as_map
from .validation import Validation, validate

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from .camera import Camera
    from .names import Model
    from .scene import Scene


def assert_depth(
    map: Map | npt.ArrayLike,
    scene: Scene,
    camera: Camera,
    model: Model = "auto",
    *,
    channel: str = "",
    report: _files.Path | None = None,
) -> Validation:
    """Raises AssertionError, with the cause in one line, unless the model explains every pixel of the map and the map has
    no fault. The arguments are the same as for fathom.validate().

    report  folder for report.html, report.txt, map.exr, camera.json and classes.npy, written if the map fails. If they
            cannot be written, the AssertionError contains the reason
    """
    __tracebackhide__ = True
    found = validate(map, scene, camera, model, channel=channel)
    if not found.is_good:
        kept = "" if report is None else f" ({_kept_or_why_not(report, map, camera, found)})"
        raise AssertionError(found.cause + kept)
    return found


def keep_report(folder: Path, map: Any, camera: Camera, found: Validation) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.txt").write_text(found.report(), encoding="utf-8")
    page = f'<!DOCTYPE html><meta charset="utf-8"><title>{_folder_name(folder.name)}</title>{found._repr_html_()}'
    (folder / "report.html").write_text(page, encoding="utf-8")
    np.save(folder / "classes.npy", found.classes)
    camera.write(folder / "camera.json")
    planes: dict[str, npt.NDArray[Any]] = {}
    for name, plane in as_map("map", map).items():
        array = np.asarray(plane)
        with _core.standard_arithmetic():
            planes[name] = array.astype(np.float32) if array.dtype == np.float64 else array
    try:
        same_size = found.camera.size == camera.size
        Map(planes, camera if same_size else None).write(folder / "map.exr")
    except Exception as error:  # keep the other files
        (folder / "map.txt").write_text(f"no map.exr: {error}\n", encoding="utf-8")
    return folder


def _kept_or_why_not(folder: object, map: Any, camera: Camera, found: Validation) -> str:
    """Keeps a report, and describes where or why not. A failure here does not hide the fault of the map."""
    if not isinstance(folder, (str, os.PathLike)):
        return f"no report: expected the name of a folder, found {folder!r}"
    try:
        return f"report in {keep_report(Path(folder), map, camera, found)}"
    except Exception as error:
        why = (error.strerror if isinstance(error, OSError) else None) or str(error)
        return f"no report in {os.fspath(folder)}: {' '.join(why.split())}"


#: Maximum length of a folder's name; file systems allow 255 bytes.
_longest = 120


def _folder_name(text: str) -> str:
    """The text as part of a path. If characters had to be replaced, a hash keeps different texts apart."""
    name = re.sub(r"[^\w.-]+", "-", text).encode()[:_longest].decode(errors="ignore").strip(".-")
    return name if name == text else f"{name}-{hashlib.sha256(text.encode()).hexdigest()[:12]}".lstrip("-")


def _folder_of(node: str) -> Path:
    """The folder of a test, from its pytest id: tests/test_a/TestB/test_c-1 for tests/test_a.py::TestB::test_c[1]."""
    path, _, parameters = node.partition("[")
    file, *names = path.split("::")
    folders = [*re.sub(r"\.py$", "", file).split("/"), *names]
    if parameters:
        folders[-1] += f"-{parameters.removesuffix(']')}"
    return Path(*(_folder_name(each) for each in folders if each))


try:
    import pytest
except ImportError:
    pass
else:

    def pytest_addoption(parser: pytest.Parser) -> None:
        parser.addoption("--fathom-reports", metavar="FOLDER", default="fathom-reports",
                         help="where assert_depth of fathom keeps the reports of maps that fail")

    @pytest.fixture(name="assert_depth")
    def assert_depth_fixture(request: pytest.FixtureRequest) -> Iterator[Callable[..., Validation]]:
        """fathom.testing.assert_depth() with a report for each map that fails, in a folder named after the test:
        FILE/CLASS/TEST, and FILE/CLASS/TEST/2 for a second map in the same test."""
        folder = Path(request.config.getoption("--fathom-reports")) / _folder_of(request.node.nodeid)
        failures = 0

        def check(*arguments: Any, **options: Any) -> Validation:
            __tracebackhide__ = True
            nonlocal failures
            options.setdefault("report", folder / str(failures + 1) if failures else folder)
            try:
                return assert_depth(*arguments, **options)
            except AssertionError:
                failures += 1
                raise

        yield check
