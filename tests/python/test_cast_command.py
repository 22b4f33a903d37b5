"""fathom cast: the answers of Scene.cast() as CSV and NPZ, and its refusals."""

import csv
import os
import subprocess

import fathom
import numpy as np
import pytest
from fathom import _core

channels = _core.ray_channels
parts = {"P": ["P.X", "P.Y", "P.Z"], "N": ["N.X", "N.Y", "N.Z"], "bary": ["bary.U", "bary.V"]}


def run(*arguments, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], "cast", *map(str, arguments)], capture_output=True, text=True,
                          env=environment, **options)


@pytest.fixture(scope="module")
def mesh():
    return os.path.join(os.environ["FATHOM_SOURCE"], "data/meshes/cube.obj")


@pytest.fixture(scope="module")
def rays():
    random = np.random.default_rng(5)
    origins = random.integers(-8, 9, (60, 3)) / 4
    directions = random.integers(-2, 3, (60, 3)) / 2
    directions[(directions == 0).all(axis=1)] = (0, 1, 0)
    return np.concatenate([origins, directions], axis=1)


@pytest.fixture
def csv_file(tmp_path, rays):
    file = tmp_path / "rays.csv"
    # Columns in another order, with blanks.
    order = [3, 0, 1, 5, 4, 2]
    names = np.array(["x", "y", "z", "dx", "dy", "dz"])[order]
    rows = [",".join(names)] + [" , ".join(repr(float(x)) for x in row) for row in rays[:, order]]
    file.write_text("\n".join(rows) + "\n")
    return file


def expected_columns(hits):
    columns = {}
    for name in channels:
        for k, part in enumerate(parts.get(name, [name])):
            columns[part] = hits[name][:, k] if name in parts else hits[name]
    return columns


@pytest.mark.parametrize("mode", ["nearest", "all"])
def test_csv_has_what_python_answers(mesh, rays, csv_file, mode):
    hits = fathom.Scene.read(mesh).cast(rays, mode=mode, channels=channels)
    ran = run(mesh, "--rays", csv_file, "--mode", mode, "--channels", ",".join(channels), check=True)
    rows = list(csv.DictReader(ran.stdout.splitlines()))
    ray = hits["ray"] if mode == "all" else np.arange(len(rays))
    assert [int(row["ray"]) for row in rows] == ray.tolist()
    for name, column in expected_columns(hits).items():
        assert np.array_equal([float(row[name]) for row in rows], column.astype(float), equal_nan=True)


@pytest.mark.parametrize("kind", ["float64", "float32"])
def test_npz_of_npy_has_what_python_answers(mesh, rays, tmp_path, kind):
    np.save(tmp_path / "rays.npy", rays.astype(kind))
    run(mesh, "--rays", tmp_path / "rays.npy", "--mode", "all", "--channels", ",".join(channels), "-o",
        tmp_path / "hits.npz", check=True)
    hits = fathom.Scene.read(mesh).cast(rays, mode="all", channels=channels)
    with np.load(tmp_path / "hits.npz") as found:
        assert sorted(found.files) == sorted(hits)
        for name, array in hits.items():
            assert found[name].shape == array.shape and np.array_equal(found[name], array)


def test_count_and_any_take_segments_and_culling(mesh, rays, csv_file):
    scene = fathom.Scene.read(mesh)
    options = ("--segment", "-inf:1.5", "--open", "--cull", "back")
    named = {"tmin": -np.inf, "tmax": 1.5, "open": True, "cull": "back"}
    count = run(mesh, "--rays", csv_file, "--mode", "count", *options, check=True).stdout.split()
    assert count[0] == "ray,count"
    assert [int(line.split(",")[1]) for line in count[1:]] == scene.count(rays, **named).tolist()
    occluded = run(mesh, "--rays", csv_file, "--mode", "any", *options, check=True).stdout.split()
    assert [line.split(",")[1] == "1" for line in occluded[1:]] == scene.occluded(rays, **named).tolist()


heading = "x,y,z,dx,dy,dz\n"


@pytest.mark.parametrize("text, message", [
    ("", "is empty"),
    (heading, "has a heading and no ray"),
    ("x,y,z\n0,0,0\n", "line 1: expected a heading with the columns x, y, z, dx, dy and dz"),
    ("x,x,z,dx,dy,dz\n", "line 1: expected a heading"),
    (heading + "0,0,0,0,0,1\n0,0,0,0,0\n", "line 3: expected 6 fields, found 5"),
    (heading + "0,0,0,0,0,1\n\n0,0,0,0,-0,0\n", "line 4: the direction is 0"),
    (heading + "0,0,0,0,nan,1\n", "line 2: expected a finite number, found 'nan'"),
    (heading + "0,0,0,0,1e999,1\n", "line 2: expected a finite number, found '1e999'"),
])
def test_bad_files_are_named_with_the_line(mesh, tmp_path, text, message):
    (tmp_path / "bad.csv").write_text(text)
    ran = run(mesh, "--rays", "bad.csv", cwd=tmp_path)
    assert ran.returncode == 3 and f"bad.csv: {message}" in ran.stderr and not ran.stdout


@pytest.mark.parametrize("array, message", [
    (np.zeros((2, 3)), "expected an array of shape N×6, of float64 or float32"),
    (np.ones((2, 6), np.uint32), "expected an array of shape N×6, of float64 or float32"),
    (np.ones((2, 6, 2)), "expected an array of shape N×6, of float64 or float32"),
    (np.array([[0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0.0]]), "row 1: the direction is 0"),
    (np.array([[0, 0, np.inf, 0, 0, 1]]), "row 0: expected finite numbers"),
])
def test_bad_arrays_are_named_with_the_row(mesh, tmp_path, array, message):
    np.save(tmp_path / "bad.npy", array)
    ran = run(mesh, "--rays", "bad.npy", cwd=tmp_path)
    assert ran.returncode == 3 and f"bad.npy: {message}" in ran.stderr


@pytest.mark.parametrize("options, message", [
    (("-o", "hits.json"), "-o: 'hits.json' does not end in .csv or .npz"),
    (("--segment", "2:1"), "--segment: '2:1': TMIN is above TMAX"),
    (("--segment", "2"), "--segment: '2' is not TMIN:TMAX"),
    (("--mode", "count", "--channels", "t"), "--channels is for --mode nearest and all"),
    (("--channels", "t,t"), "--channels: 't' is there twice"),
    (("--channels", "Z"), "--channels: there is no channel 'Z'; there are t, id, distance, P, bary, N, object and face"),
    (("--channels", "seg"), "did you mean 'object'?"),
    (("--channels", "t,range"), "did you mean 'distance'?"),
])
def test_wrong_usage_leaves_no_file(mesh, csv_file, tmp_path, options, message):
    ran = run(mesh, "--rays", csv_file, *options, cwd=tmp_path)
    assert ran.returncode == 2 and message in ran.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["rays.csv"]
