"""Examples in docstrings run; every public name has a docstring; types are complete; importing is quick."""

import doctest
import importlib
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
modules = ["_importing", "camera", "clipping", "comparison", "compat", "deep", "depth_formats", "diagnosis", "lens", "lit_areas",
           "maps", "pipeline", "questions", "rays", "rendering", "scanning", "scene", "studies", "validation"]


@pytest.mark.parametrize("name", ["fathom", *(f"fathom.{name}" for name in modules)])
def test_examples(name):
    results = doctest.testmod(importlib.import_module(name))
    assert results.failed == 0 and results.attempted > 0


def public_members():
    for name in fathom.__all__:
        member = getattr(fathom, name)
        yield name, member
        if inspect.isclass(member):
            for inner, value in vars(member).items():
                if not inner.startswith("_") and callable(value):
                    yield f"{name}.{inner}", value


def test_everything_public_is_documented():
    names = {"NO_SURFACE"}
    for name, member in public_members():
        if name not in names:
            assert inspect.getdoc(member), name


@pytest.mark.parametrize("name", ["MapComparison", "ChannelComparison", "DifferenceSummary", "DepthMetrics", "DisparityMetrics",
                                  "Finding", "Estimate"])
def test_what_is_returned_has_its_attributes_in_the_reference(name):
    from fathom import _core

    page = (source / "docs/reference/python.md").read_text(encoding="utf-8")
    assert getattr(_core, name).__doc__ or getattr(fathom, name).__doc__
    attributes = [each for each in dir(getattr(_core, name)) if not each.startswith("_")]
    assert attributes and (f"**{name}**" in page or f"an {name} each" in page)
    for each in attributes:
        assert f"`{each}`" in page, each


def run_mypy(path):
    """Before mypy 1.7, keywords from a TypedDict need an option."""
    return subprocess.run(
        ["/usr/bin/python3", "-m", "mypy", "--strict", "--enable-incomplete-feature=Unpack",
         "--python-version", "3.9", "--cache-dir", "/dev/null", path],
        cwd=pathlib.Path(fathom.__file__).parent.parent, capture_output=True, text=True)


def test_types_are_complete():
    checked = run_mypy("fathom")
    assert checked.returncode == 0, checked.stdout
    assert (pathlib.Path(fathom.__file__).parent / "py.typed").exists()


def test_type_checkers_know_the_arguments_of_class_methods(tmp_path):
    calls = tmp_path / "calls.py"
    calls.write_text("""import fathom

fathom.Camera.from_colmap("model", ignore_distortion=True)["a"].width
fathom.Camera.from_colmap("model", ignore=True)
fathom.Camera.from_kitti("calib.txt", camera="left")
fathom.Camera.look_at((0, 0, 3), fov=60, lens=fathom.Lens(fov=60))
fathom.Camera.look_at((0, 0, 3), fov="wide")
fathom.Camera.frame(fathom.Scene(), size=(64, 48))
fathom.Camera.frame("scene.json")
""")
    found = [line for line in run_mypy(calls).stdout.splitlines() if "calls.py" in line]
    assert [line.partition("calls.py:")[2].partition(":")[0] for line in found] == ["4", "5", "7", "9"], found


def test_type_checkers_know_names_and_channels(tmp_path):
    calls = tmp_path / "calls.py"
    calls.write_text("""import fathom

scene = fathom.Scene()
camera = fathom.Camera.look_at((0, 0, 3), up="z")
maps = scene.render(camera, channels=("Z", "id"))
scene.render(camera, channels=("dpth",))
fathom.validate(maps, scene, camera, "opengl")
fathom.validate(maps.Z, scene, camera, "gl-unorm24")
fathom.DepthFormat("standard", "d24", near=1, far=9)
maps.z
maps.write("a.exr", compression="zipped")
fathom.compare(maps, maps).preview(by="ulps")
camera.rays(frame="eye")
""")
    found = [line for line in run_mypy(calls).stdout.splitlines() if "calls.py" in line]
    assert [line.partition("calls.py:")[2].partition(":")[0] for line in found] == ["6", "7", "9", "10", "11", "12", "13"], found


def test_the_stub_has_what_the_extension_module_has():
    from fathom import _core

    stub = (pathlib.Path(fathom.__file__).parent / "_core.pyi").read_text()
    for name in dir(_core):
        if not name.startswith("_"):
            assert f"class {name}" in stub or f"def {name}(" in stub or f"\n{name}: " in stub, name


def test_numpy_alone_is_imported():
    code = "import sys, numpy; before = set(sys.modules); import fathom; print(*sorted(set(sys.modules) - before))"
    loaded = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split()
    others = {name for name in loaded if not name.startswith("fathom")}
    assert others <= {"atexit", "fractions", "decimal", "_decimal", "numbers", "_typing", "typing", "typing.io", "typing.re"}, others
