"""fathom sees: the answers of Scene.sees() as CSV and NPZ, and its refusals."""

import csv
import os
import subprocess

import fathom
import numpy as np
import pytest


def run(*arguments, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], "sees", *map(str, arguments)], capture_output=True, text=True,
                          env=environment, **options)


@pytest.fixture(scope="module")
def mesh():
    return os.path.join(os.environ["FATHOM_SOURCE"], "data/meshes/cube.obj")


@pytest.fixture(scope="module")
def pairs():
    return np.random.default_rng(6).integers(-8, 9, (60, 6)) / 4


def written(path, names, rows):
    lines = [",".join(names)] + [" , ".join(repr(float(x)) for x in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("edges", ["closed", "generic"])
def test_csv_has_what_python_answers(mesh, pairs, tmp_path, edges):
    order = [3, 0, 1, 5, 4, 2]
    names = np.array(["x", "y", "z", "px", "py", "pz"])[order]
    file = written(tmp_path / "pairs.csv", names, pairs[:, order])
    rows = list(csv.DictReader(run(mesh, "--pairs", file, "--edges", edges, check=True).stdout.splitlines()))
    assert [int(row["pair"]) for row in rows] == list(range(60))
    expected = fathom.Scene.read(mesh).sees(pairs[:, :3], pairs[:, 3:], edges=edges)
    assert [row["seen"] == "1" for row in rows] == expected.tolist()
    assert 5 < expected.sum() < 55


def test_points_of_triangles_are_read(mesh, pairs, tmp_path):
    weights = np.random.default_rng(7).random((60, 2)) / 2
    triangles = np.arange(60) % 12
    rows = np.column_stack([weights, triangles, pairs[:, :3]])
    file = written(tmp_path / "pairs.csv", ["v", "w", "triangle", "x", "y", "z"], rows)
    found = run(mesh, "--pairs", file, check=True).stdout.split()[1:]
    expected = fathom.Scene.read(mesh).sees(pairs[:, :3], fathom.SurfacePoints(triangles, weights))
    assert [line.split(",")[1] == "1" for line in found] == expected.tolist()


@pytest.mark.parametrize("kind", ["float64", "float32"])
def test_npz_of_npy_has_what_python_answers(mesh, pairs, tmp_path, kind):
    np.save(tmp_path / "pairs.npy", pairs.astype(kind))
    run(mesh, "--pairs", tmp_path / "pairs.npy", "-o", tmp_path / "seen.npz", check=True)
    with np.load(tmp_path / "seen.npz") as found:
        assert sorted(found.files) == ["pair", "seen"]
        assert (found["seen"] == fathom.Scene.read(mesh).sees(pairs[:, :3], pairs[:, 3:])).all()


@pytest.mark.parametrize("text, message", [
    ("", "is empty"),
    ("x,y,z,px,py,pz\n", "has a heading and no pair"),
    ("x,y,z,dx,dy,dz\n0,0,0,0,0,1\n", "line 1: expected a heading with the columns x, y, z, px, py and pz; or "
                                      "x, y, z, triangle, v and w"),
    ("x,y,z,triangle,v,w\n0,0,0,1.5,0,0\n", "line 2: expected the number of a triangle"),
    ("x,y,z,triangle,v,w\n0,0,0,1,0,0\n0,0,0,-1,0,0\n", "line 3: expected the number of a triangle"),
    ("x,y,z,triangle,v,w\n0,0,0,1,0,nan\n", "line 2: expected a finite number, found 'nan'"),
])
def test_bad_files_are_named_with_the_line(mesh, tmp_path, text, message):
    (tmp_path / "bad.csv").write_text(text)
    ran = run(mesh, "--pairs", "bad.csv", cwd=tmp_path)
    assert ran.returncode == 3 and f"bad.csv: {message}" in ran.stderr and not ran.stdout


def test_a_triangle_that_does_not_exist_is_named(mesh, tmp_path):
    (tmp_path / "pairs.csv").write_text("x,y,z,triangle,v,w\n0,0,0,1,0,0\n0,0,0,12,0,0\n")
    ran = run(mesh, "--pairs", "pairs.csv", cwd=tmp_path)
    assert ran.returncode == 3 and "point 1: there is no triangle 12" in ran.stderr


@pytest.mark.parametrize("options, message", [
    (("-o", "seen.json"), "-o: 'seen.json' does not end in .csv or .npz"),
    (("--edges", "open"), "--edges: 'open' is neither closed nor generic"),
])
def test_wrong_usage_leaves_no_file(mesh, pairs, tmp_path, options, message):
    np.save(tmp_path / "pairs.npy", pairs)
    ran = run(mesh, "--pairs", "pairs.npy", *options, cwd=tmp_path)
    assert ran.returncode == 2 and message in ran.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["pairs.npy"]
