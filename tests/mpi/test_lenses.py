"""Any number of ranks, with any partition of the tiles, writes the same file as one process, byte for byte. Here cameras
whose lens bends rays, and tables of directions."""

import json
import math

import pytest

from mpi_runs import combinations, expect_same_for, mpi_program, mpirun, one_program, run, said, source
from test_memory import write_scattered, write_sphere

data = source / "data"
spot = data / "meshes/spot.obj"
#: All that a map of a lens may have, but normals of files.
channels = "Z,Zlow,distance,id,face,object,N,P,bary,Nc,valid"

lenses = {
    "OPENCV": {"k1": -0.25, "k2": 0.06, "p1": 0.001, "p2": -0.0005},
    "SIMPLE_RADIAL": {"k": -0.3},
    "FULL_OPENCV": {"k1": 0.1, "k2": 0.02, "p1": 0.002, "p2": 0, "k3": 0, "k4": 0.1, "k5": 0, "k6": 0},
    # Rays to all sides: six views.
    "DIVISION": {"k": -3},
}


def camera_with(model, width=200, height=150, distance=3):
    """A camera that stands before the cow, or with distance 0 in it."""
    focal = {"f": width * 0.6} if model.startswith("SIMPLE") else {"fx": width * 0.6, "fy": width * 0.6}
    return {"width": width, "height": height, "model": model, **focal, "cx": width / 2 + 0.3, "cy": height / 2 - 0.2,
            "pixel_centre": 0.5, **lenses[model],
            "world_to_camera": [[1, 0, 0, 0.1], [0, -1, 0, 0.2], [0, 0, -1, distance]]}


def write_panorama(folder, width=160, height=80):
    """A table of directions to all sides, some of which are missing, and its camera."""
    lines = []
    for row in range(height):
        for column in range(width):
            a, b = 2 * math.pi * (column + 0.5) / width, math.pi * ((row + 0.5) / height - 0.5)
            is_there = (row + column) % 17 != 0
            lines.append(f"{math.sin(a) * math.cos(b)},{math.sin(b)},{math.cos(a) * math.cos(b)}" if is_there else "0,0,0")
    (folder / "rays.csv").write_text("x,y,z\n" + "\n".join(lines) + "\n")
    camera = {"width": width, "height": height, "model": "TABLE", "directions": "rays.csv",
              "world_to_camera": [[1, 0, 0, 0.1], [0, -1, 0, 0.2], [0, 0, -1, 0.3]]}
    return write_camera(folder, camera)


def write_camera(folder, camera):
    path = folder / "camera.json"
    path.write_text(json.dumps(camera))
    return path


@pytest.mark.parametrize("model", lenses)
def test_lenses(tmp_path, model):
    camera = write_camera(tmp_path, camera_with(model, distance=0 if model == "DIVISION" else 3))
    for combination in combinations(model):
        print(model, combination)
        expect_same_for(combination, tmp_path, spot, "--camera", camera, "--channels", channels)


@pytest.mark.parametrize("suffix", ["exr", "npz", "png"])
def test_channels_by_default(tmp_path, suffix):
    """Also the ray distance where a file has room for it, and coverage nowhere."""
    camera = write_camera(tmp_path, camera_with("DIVISION"))
    scale = ["--png-scale", "1000", "--channels", "distance"] if suffix == "png" else []
    expect_same_for((3, "load"), tmp_path, spot, "--camera", camera, *scale, suffix=suffix)


def test_tables_of_directions(tmp_path):
    camera = write_panorama(tmp_path)
    for combination in combinations("panorama"):
        expect_same_for(combination, tmp_path, spot, data / "scenes/pair.json", "--camera", camera, "--channels", channels)


def test_paths_of_cameras_with_and_without_lenses(tmp_path):
    pinhole = {key: value for key, value in camera_with("OPENCV").items() if key not in ("model", *lenses["OPENCV"])}
    path = [camera_with("OPENCV"), pinhole, camera_with("DIVISION"), camera_with("OPENCV", distance=2)]
    expect_same_for((3, "round-robin"), tmp_path, spot, "--camera", write_camera(tmp_path, path))


@pytest.mark.parametrize("options", [["--verify", "50"], ["--channels", "Ns,Z"], ["--near", "2.7", "--far", "3.2"]],
                         ids=lambda options: options[0])
def test_options(tmp_path, options):
    camera = write_camera(tmp_path, camera_with("OPENCV"))
    expect_same_for((3, "round-robin"), tmp_path, spot, "--camera", camera, *options)


@pytest.mark.parametrize("model", ["OPENCV", "DIVISION"])
def test_rounds_do_not_show(tmp_path, model):
    # A rank takes some 20,000 triangles at a time, with several views less, from a file that none reads whole.
    write_scattered(tmp_path / "mesh.stl", 60_000)
    camera = camera_with(model, 500, 400)
    camera["world_to_camera"] = [[1, 0, 0, -0.5], [0, 1, 0, -0.5], [0, 0, 1, 1.5 if model == "OPENCV" else -0.5]]
    expect_same_for((3, "load"), tmp_path, tmp_path / "mesh.stl", "--camera", write_camera(tmp_path, camera),
                    "--channels", "Z,id,distance,valid", of_ranks=["--memory", "128M"])


def test_tiles_that_wait_do_not_show(tmp_path):
    # 1600 tiles of 40 kB or more, and their places, are far more than 128 MB.
    write_sphere(tmp_path / "mesh.stl", 100)
    camera = camera_with("SIMPLE_RADIAL", 2560, 2560, 1.5)
    expect_same_for((2, "load"), tmp_path, tmp_path / "mesh.stl", "--camera", write_camera(tmp_path, camera),
                    "--channels", "Z,id", of_ranks=["--memory", "128M"])


def test_statistics_are_those_of_all_ranks(tmp_path):
    camera = write_camera(tmp_path, camera_with("DIVISION", distance=0))
    arguments = [spot, "--camera", camera, "--stats", "-", "--quiet"]
    alone = json.loads(run([one_program, "render", *arguments, "-o", tmp_path / "one.exr"]).stdout)
    of_all = json.loads(run([*mpirun, "-n", 3, mpi_program, "render", *arguments, "-o", tmp_path / "several.exr"]).stdout)
    for key in ("triangles", "degenerate_triangles", "culled_triangles", "pixels_with_surface"):
        assert of_all[key] == alone[key], key


@pytest.mark.parametrize("options, text", [
    (["--channels", "Z,A"], "the lens OPENCV: channel A"), (["--deep"], "the lens OPENCV: "),
    (["--samples", "rotated-grid"], "the lens OPENCV: "), (["--cryptomatte"], "the lens OPENCV: "),
], ids=lambda each: each[-1] if isinstance(each, list) else "")
def test_what_needs_straight_edges_is_refused(tmp_path, options, text):
    camera = write_camera(tmp_path, camera_with("OPENCV"))
    outcome = run([*mpirun, "-n", 2, mpi_program, "render", spot, "--camera", camera, *options, "--quiet", "-o",
                   tmp_path / "map.exr"])
    assert outcome.returncode == 2 and not (tmp_path / "map.exr").exists()
    lines = said(outcome)
    assert len(lines) == 1 and text in lines[0], outcome.stderr
