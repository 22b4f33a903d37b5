"""The metadata beside the built module: its version, and the entry point by which pytest finds assert_depth."""

import importlib.metadata
import os
import subprocess
import sys

import pytest

import fathom

suite = """import fathom

def test_depth(assert_depth):
    camera = fathom.Camera.look_at((0, 0, 3), size=(64, 48))
    scene = fathom.Scene()
    scene.add_mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])
    assert_depth(scene.render(camera), scene, camera)
"""


def test_the_version_is_that_of_the_program_and_of_the_package(run_program):
    assert fathom.__version__ == importlib.metadata.version("fathom-depth")
    assert run_program("--version").split() == ["fathom", fathom.__version__]
    assert "numpy" in importlib.metadata.requires("fathom-depth")[0]


@pytest.mark.parametrize("conftest", ["", "pytest_plugins = ['fathom.testing']\n"])
def test_pytest_finds_the_fixture_by_itself_and_takes_it_once(tmp_path, conftest):
    (tmp_path / "conftest.py").write_text(conftest)
    (tmp_path / "test_depth.py").write_text(suite)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    told = subprocess.run([sys.executable, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", tmp_path], cwd=tmp_path,
                          env=environment, capture_output=True, text=True)
    assert told.returncode == 0 and "1 passed" in told.stdout, told.stdout + told.stderr
