"""fathom.studies: the tables of studies, held to the program's files and to known values."""

import csv
import io
import json
import os
import pathlib
import signal
import subprocess
import sys

import numpy as np
import pytest

import fathom
from fathom import studies


@pytest.fixture(scope="module")
def resolution():
    return studies.run("depth-resolution", near=1, far=4, samples=3)


def test_names_are_those_of_the_program():
    program = pathlib.Path(os.environ["FATHOM_PROGRAM"])
    told = subprocess.run([program, "study", "--list"], check=True, capture_output=True, text=True,
                          env={k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}).stdout
    assert [line.split(None, 1) for line in told.splitlines()] == [
        [name, about.description] for name, about in studies.names().items()]
    assert studies.names()["mitigation"].takes_scene and not studies.names()["lines"].takes_scene


def test_tables_have_the_numbers_of_the_files(resolution, run_program, tmp_path):
    run_program("study", "depth-resolution", "--near", 1, "--far", 4, "--samples", 3, "--no-plots", "--out", tmp_path)
    assert sorted(resolution.files) == sorted(file.name for file in tmp_path.iterdir())
    for name, content in resolution.files.items():
        assert content == (tmp_path / name).read_bytes(), name
    assert resolution.summary == json.loads((tmp_path / "summary.json").read_text())
    assert set(resolution.tables) == {"steps", "best", "near-far"}
    for name, table in resolution.tables.items():
        heading, *rows = csv.reader(io.StringIO((tmp_path / f"{name}.csv").read_text()))
        assert list(table.dtype.names) == heading and len(table) == len(rows) > 0
        for i, column in enumerate(heading):
            if table[column].dtype.kind == "f":
                written = np.array([float(row[i] or "nan") for row in rows])
                assert np.allclose(table[column], written, rtol=1e-8, atol=0, equal_nan=True), (name, column)
            else:
                assert [str(value) for value in table[column]] == [row[i] for row in rows], (name, column)


def test_types_do_not_depend_on_the_values(resolution):
    steps = resolution.tables["steps"].dtype
    assert steps["far"] == np.float64 and steps["mapping"].kind == "U"
    assert studies.run("lines", samples=2).tables["drift"].dtype["pixels"] == np.int64


def test_tables_of_several_runs_are_joined(spot, triangle):
    """A scene of a single triangle has no separations."""
    alone = fathom.Scene()
    alone.add_mesh(*triangle)
    runs = [studies.run("z-fighting", scene, fathom.Camera.frame(scene, size=(40, 30)), near=0.1, far=100)
            for scene in (alone, spot)]
    none, some = (run.tables["separations"] for run in runs)
    assert len(some) > len(none) == 0
    assert [none.dtype[column].kind for column in none.dtype.names] == ["U", "U", "f", "f", "f"]
    joined = np.concatenate([none, some])
    assert joined.dtype == some.dtype and np.array_equal(joined, some)


def test_the_step_of_a_linear_format_is_known(resolution):
    steps = resolution.tables["steps"]
    linear = steps[(steps["mapping"] == "linear") & (steps["storage"] == "unorm16") & (steps["depth"] == 2)]
    assert len(linear) == 1 and np.isclose(linear["step"][0], (4 - 1) / (2**16 - 1), rtol=1e-12)


def test_a_scene_is_studied_with_a_camera_of_its_own_or_a_given_one(spot):
    def pixels(camera=None):
        """Those of the exact map: `pixels` are those of either."""
        row = studies.run("subpixel", spot, camera).tables["subpixel"][0]
        return row["pixels"] - row["gained"]

    camera = fathom.Camera.frame(spot, size=(40, 30))
    assert pixels(camera) == np.isfinite(spot.render(camera)["Z"]).sum()
    assert pixels() == np.isfinite(spot.render(fathom.Camera.frame(spot, size=(640, 360)))["Z"]).sum()


def test_plots_are_drawn_where_they_are_asked_for(tmp_path):
    study = studies.run("depth-resolution", samples=3, plots=True)
    drawn = [name for name in study.files if name.endswith(".svg")]
    assert drawn and not any(name.endswith(".svg") for name in studies.run("depth-resolution", samples=3).files)
    study.write(tmp_path / "a/b")
    assert (tmp_path / "a/b" / drawn[0]).read_bytes() == study.files[drawn[0]]


@pytest.mark.parametrize("name, arguments, error, words", [
    ("resolution", {}, ValueError, "there is no study 'resolution'; there are antialiasing"),
    (5, {}, TypeError, "name: expected the name of a study"),
    ("depth-resolution", {"near": -1}, ValueError, "near"),
    ("depth-resolution", {"near": "1"}, TypeError, "near: expected a number"),
    ("depth-resolution", {"samples": 1}, ValueError, "samples: expected"),
    ("depth-resolution", {"samples": 2**31}, ValueError, "^samples"),
    ("depth-resolution", {"separation": 0.1}, fathom.UsageError, "the study depth-resolution has no separation"),
    ("mitigation", {"samples": 5}, ValueError, "no separation and no samples"),
    ("subpixel", {"scene": 5}, TypeError, "scene: expected a Scene"),
])
def test_what_cannot_be_meant_is_refused(name, arguments, error, words):
    with pytest.raises(error, match=words):
        studies.run(name, **arguments)


def test_scenes_and_cameras_that_mean_nothing_are_refused(spot):
    with pytest.raises(ValueError, match="the study lines takes no scene"):
        studies.run("lines", spot)
    with pytest.raises(ValueError, match="camera: it belongs to a scene"):
        studies.run("subpixel", camera=fathom.Camera.frame(spot, size=(40, 30)))


def test_ctrl_c_ends_a_study():
    code = "from fathom import studies; print('on', flush=True); studies.run('indistinguishable')"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as process:
        assert process.stdout.readline() == "on\n"
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(0.5)
        process.send_signal(signal.SIGINT)
        assert "KeyboardInterrupt" in process.communicate(timeout=60)[1]
