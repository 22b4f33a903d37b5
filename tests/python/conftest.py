"""What the tests share: scenes with known answers, and the program to compare with."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])


@pytest.fixture(scope="session")
def spot():
    return fathom.Scene.read(source / "data/meshes/spot.obj")


@pytest.fixture(scope="session")
def run_program():
    """Runs the program, and returns what it prints; a failure is a failure of the test."""

    def run(*arguments):
        # It has a sanitizer of its own, if this process was given one.
        environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        return subprocess.run([os.environ["FATHOM_PROGRAM"], *map(str, arguments)], check=True, capture_output=True,
                              env=environment, text=True).stdout

    return run


@pytest.fixture
def triangle():
    """A triangle in the plane z = 4 + x/2 that a camera at the origin sees."""
    corners = np.array([(-2, -2, 3), (2, -2, 5), (0, 2, 4)], np.float64)
    return corners, np.array([(0, 1, 2)], np.uint32)


@pytest.fixture
def K():
    return np.array([(40, 0, 32), (0, 40, 24), (0, 0, 1)], np.float64)
