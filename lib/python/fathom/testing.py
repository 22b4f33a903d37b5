"""For test suites: assert_depth(), and a fixture of pytest's that keeps reports.

In a conftest.py, `pytest_plugins = ["fathom.testing"]` gives tests the fixture `assert_depth`; packages that are
installed by pip have it without that.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _files
from .maps import Map, as_map
from .validation import Validation, validate

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from .camera import Camera
    from .scene import Scene


def assert_depth(
    map: Map | npt.ArrayLike,
    scene: Scene,
    camera: Camera,
    model: str = "auto",
    *,
    channel: str = "",
    report: _files.Path | None = None,
) -> Validation:
    """Fails with an AssertionError, which says what is wrong with a map in one line, unless every pixel of it is
    explained by the model and nothing is wrong with it on the whole. The arguments are those of fathom.validate().

    report  a folder for report.txt, map.exr, camera.json and classes.npy, written where the map fails
    """
    __tracebackhide__ = True
    found = validate(map, scene, camera, model, channel=channel)
    if not found.is_good:
        kept = "" if report is None else f" (report in {keep_report(Path(report), map, camera, found)})"
        raise AssertionError(found.cause + kept)
    return found


def keep_report(folder: Path, map: Any, camera: Camera, found: Validation) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.txt").write_text(found.report(), encoding="utf-8")
    np.save(folder / "classes.npy", found.classes)
    camera.write(folder / "camera.json")
    planes: dict[str, npt.NDArray[Any]] = {}
    for name, plane in as_map("map", map).items():
        planes[name] = plane.astype(np.float32) if plane.dtype == np.float64 else plane
    try:
        same_size = found.camera.size == camera.size
        Map(planes, camera if same_size else None).write(folder / "map.exr")
    except OSError as error:
        (folder / "map.txt").write_text(f"no map.exr: {error}\n", encoding="utf-8")
    return folder


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
        """fathom.testing.assert_depth(), which keeps a report for each map that fails, in a folder named after the
        test."""
        folder = Path(request.config.getoption("--fathom-reports"))
        name = re.sub(r"[^\w.-]+", "-", request.node.name)

        def check(*arguments: Any, **options: Any) -> Validation:
            __tracebackhide__ = True
            options.setdefault("report", folder / name)
            return assert_depth(*arguments, **options)

        yield check
