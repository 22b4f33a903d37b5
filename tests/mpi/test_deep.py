"""Deep maps and Cryptomatte: each rank has a share of the rows, and the files equal one process's files, byte for byte."""

import json

import pytest

from mpi_runs import expect_same_for, is_long, mpi_program, mpirun, ranks, run, source

data = source / "data"
scenes = [*sorted(path for path in (data / "meshes").iterdir() if path.is_file()), *sorted((data / "scenes").glob("*.json")),
          *sorted((data / "scenes/hard").glob("*.obj"))]
#: In every change; all of them, and all numbers of ranks, in scripts/check-long.
representative = ["pair.json", "coplanar-crowd.obj", "through-the-camera-plane.obj"]


def write_grid(path, materials):
    """A bumpy grid, whose rows of faces have these materials in turn, or none."""
    lines = [f"v {x} {y} {(3 * x + 5 * y) % 4}" for y in range(9) for x in range(9)]
    for y in range(8):
        name = materials[y % len(materials)]
        lines.append(f"usemtl {name}" if name else "usemtl")
        lines += [f"f {9 * y + x + 1} {9 * y + x + 2} {9 * y + x + 11} {9 * y + x + 10}" for x in range(8)]
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("scene", [path for path in scenes if is_long or path.name in representative],
                         ids=lambda path: path.name)
def test_deep_scenes(tmp_path, scene):
    camera = scene.with_suffix(".camera.json")
    view = ["--camera", camera] if camera.exists() else ["--size", "90x67", "--view", "20,10"]
    for count in ranks if is_long else [3]:
        expect_same_for((count, "load"), tmp_path, scene, *view, "--deep")


@pytest.mark.parametrize("size, count", [("40x30", 8), ("7x9", 3), ("64x8", 2), ("33x24", 1)])
def test_ranks_with_few_rows_or_none(tmp_path, size, count):
    expect_same_for((count, "load"), tmp_path, data / "meshes/cube.stl", "--size", size, "--deep", "--compression", "rle")


def test_deep_maps_of_what_moves_along_a_path(tmp_path):
    motion = tmp_path / "motion.json"
    places = [{"time": time, "transform": [[1, 0, 0, time], [0, 1, 0, 0], [0, 0, 1, 0]]} for time in (0, 1)]
    motion.write_text(json.dumps({"objects": [{"name": "cube", "keyframes": places}]}))
    expect_same_for((3, "load"), tmp_path, data / "meshes/cube.stl", "--camera", data / "cameras/orbit.json", "--motion",
                    motion, "--time", "0.5", "--deep")


def test_a_deep_map_of_nothing(tmp_path):
    nothing = tmp_path / "nothing.obj"
    nothing.write_text("v 0 0 0\n")
    expect_same_for((3, "load"), tmp_path, nothing, "--camera", data / "cameras/look-at.json", "--deep")


@pytest.mark.parametrize("materials", [["red", "green", "blue"], ["red", ""], [""]], ids=["all", "some", "none"])
def test_mattes_by_material(tmp_path, materials):
    """The name of what has none is in the file where any rank sees it."""
    write_grid(tmp_path / "grid.obj", materials)
    expect_same_for((3, "rows"), tmp_path, tmp_path / "grid.obj", "--size", "70x50", "--cryptomatte-by", "object,material",
                    "--channels", "Z,id")


def test_what_travels(tmp_path):
    """Traffic: four bytes for each pixel in other ranks' rows, and twenty bytes for each sample."""
    outcome = run([*mpirun, "-n", 3, mpi_program, "render", data / "meshes/cube.stl", "--size", "40x48", "--quiet", "--deep",
                   "--threads", 1, "-o", tmp_path / "map.exr", "--traffic", "-"])
    assert outcome.returncode == 0, outcome.stderr
    found = json.loads(outcome.stdout)
    pixels = found["sent"]["pixels"]
    assert pixels["messages"] == 2 * 2 and (pixels["bytes"] - 32 * 40 * 4) % 20 == 0
    assert pixels["bytes"] > 32 * 40 * 4 and found["sent"]["triangles"]["messages"] == 0
    assert 0 < found["seconds"]["slowest"] <= found["seconds"]["drawing"]
