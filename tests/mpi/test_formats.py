"""Any number of ranks, with any partition of the tiles, writes the same file as one process, byte
for byte: every channel, and what the file says of itself. Here all kinds of
files, paths of cameras, normals, and scenes of which there is little."""

import json

import pytest

from mpi_runs import expect_same_for, mpi_program, mpirun, one_program, run, source

data = source / "data"


@pytest.mark.parametrize("arguments", [
    ("npz",), ("npy", "--channels", "N"), ("pfm",), ("png", "--png-scale", "1000"), ("png", "--channels", "id"),
    ("exr", "--compression", "zips"), ("exr", "--compression", "piz"), ("exr", "--background", "0", "--channels", "Z,id"),
], ids=lambda arguments: "-".join(arguments))
def test_formats(tmp_path, arguments):
    suffix, *options = arguments
    expect_same_for((3, "round-robin"), tmp_path, data / "meshes/spot.obj", "--size", "200x150", *options, suffix=suffix)


def test_normals_of_files(tmp_path):
    mesh = tmp_path / "with-normals.obj"
    vertices = [(x, y, (3 * x + 5 * y) % 4) for y in range(9) for x in range(9)]
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"vn {x - 4} {y - 4} {z + 1}" for x, y, z in vertices]
    for corner in (9 * y + x + 1 for y in range(8) for x in range(8)):
        lines += [f"f {a}//{a} {b}//{b} {c}//{c}" for a, b, c in
                  [(corner, corner + 1, corner + 10), (corner, corner + 10, corner + 9)]]
    mesh.write_text("\n".join(lines) + "\n")
    expect_same_for((3, "load"), tmp_path, mesh, "--size", "200x150", "--channels", "Z,Ns,id")


@pytest.mark.parametrize("arguments", [
    ("--near", "0.1", "--far", "100", "--depth-format", "unorm16", "--against-exact"), ("--samples", "rotated-grid"),
    ("--cryptomatte", "--channels", "Z"), ("--verify", "50"), ("--channels", "Ns,Z"),
], ids=lambda arguments: arguments[-1])
def test_what_needs_the_whole_map_or_scene(tmp_path, arguments):
    expect_same_for((3, "round-robin"), tmp_path, data / "meshes/spot.obj", data / "scenes/pair.json", "--size", "200x150",
                    *arguments)


def test_statistics_are_those_of_all_ranks(tmp_path):
    arguments = [data / "meshes/spot.obj", "--size", "200x150", "--channels", "Z,A", "--stats", "-", "--quiet"]
    alone = json.loads(run([one_program, "render", *arguments, "-o", tmp_path / "one.exr"]).stdout)
    outcome = run([*mpirun, "-n", 3, mpi_program, "render", *arguments, "-o", tmp_path / "several.exr"])
    of_all = json.loads(outcome.stdout)
    assert of_all.keys() == alone.keys()
    for key in ("triangles", "degenerate_triangles", "culled_triangles", "pixels_with_surface", "width", "height"):
        assert of_all[key] == alone[key], key
    facing = of_all["decisions"]["facing"]
    assert facing == alone["decisions"]["facing"] and sum(facing.values()) == 5856


def test_paths_of_cameras(tmp_path):
    expect_same_for((3, "load"), tmp_path, data / "meshes/spot.obj", "--camera", data / "cameras/orbit.json")


def test_streamable_objects_that_move(tmp_path):
    motion = tmp_path / "motion.json"
    places = [{"time": time, "transform": [[1, 0, 0, time], [0, 1, 0, 0], [0, 0, 1, 0]]} for time in (0, 1)]
    motion.write_text(json.dumps({"objects": [{"name": "cube", "keyframes": places}]}))
    expect_same_for((2, "load"), tmp_path, data / "meshes/cube.stl", "--size", "100x75", "--motion", motion, "--time", "0.5")


def test_objects_that_move(tmp_path):
    motion = tmp_path / "motion.json"
    places = [{"time": time, "transform": [[1, 0, 0, time], [0, 1, 0, 0], [0, 0, 1, 0]]} for time in (0, 1)]
    motion.write_text(json.dumps({"objects": [{"name": "spot", "keyframes": places}]}))
    expect_same_for((2, "rows"), tmp_path, data / "meshes/spot.obj", "--size", "100x75", "--motion", motion, "--time", "0.5")


@pytest.mark.parametrize("count", [1, 3])
def test_a_scene_without_triangles(tmp_path, count):
    nothing = tmp_path / "nothing.obj"
    nothing.write_text("v 0 0 0\n")
    expect_same_for((count, "load"), tmp_path, nothing, "--camera", data / "cameras/look-at.json")


def test_more_ranks_than_tiles(tmp_path):
    for partition in ("load", "rows", "round-robin"):
        expect_same_for((8, partition), tmp_path, data / "meshes/cube.stl", "--size", "20x30", "--channels", "Z,A,id")
