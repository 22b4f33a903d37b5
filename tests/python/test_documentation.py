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
modules = ["_importing", "camera", "clipping", "deep", "depth_formats", "lens", "maps",
           "pipeline", "questions", "rendering", "scanning", "scene", "studies", "validation"]


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
    attributes = [each for each in dir(getattr(_core, name)) if not each.startswith("_")]
    assert attributes and (f"**{name}**" in page or f"an {name} each" in page)
    for each in attributes:
        assert f"`{each}`" in page, each


def test_types_are_complete():
    package = pathlib.Path(fathom.__file__).parent
    # Older ones than mypy 1.7 know keywords that are a TypedDict as a feature to come.
    checked = subprocess.run(
        ["/usr/bin/python3", "-m", "mypy", "--strict", "--enable-incomplete-feature=Unpack",
         "--python-version", "3.9", "--cache-dir", "/dev/null", package.name],
        cwd=package.parent, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
    assert (package / "py.typed").exists()


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
