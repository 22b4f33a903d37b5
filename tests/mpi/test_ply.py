"""Binary PLY that has the size of a file of triangles: no rank looks at all of it, and yet nothing else is made of it."""

import math
import random
import struct

import pytest

from mpi_runs import channels, combinations, expect_same_for, mpi_program, mpirun, run, said

size = ["--size", "300x200"]


def ply(corners, seed=1, vertices=60):
    """A file whose faces have so many corners."""
    draw = random.Random(seed)
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(corners)}\nproperty list uchar int vertex_indices\nend_header\n")
    points = [draw.uniform(-1, 1) for _ in range(3 * vertices)]
    faces = [struct.pack(f"<B{count}i", count, *draw.sample(range(vertices), count)) for count in corners]
    return head.encode() + struct.pack(f"<{len(points)}f", *points) + b"".join(faces)


def mixed(seed):
    corners = [3] * 80 + [2, 4] * 5
    random.Random(seed).shuffle(corners)
    return corners


@pytest.mark.parametrize("corners", [[3] * 90, mixed(1), mixed(2), [3] * 89 + [4]],
                         ids=["triangles", "mixed", "mixed too", "by size no triangles"])
def test_the_map_is_that_of_one_process(tmp_path, corners):
    mesh = tmp_path / "mesh.ply"
    mesh.write_bytes(ply(corners))
    for combination in combinations(len(corners) + corners[0]):
        expect_same_for(combination, tmp_path, mesh, *size, "--channels", channels)


def refused(mesh, count=3):
    outcome = run([*mpirun, "-n", count, mpi_program, "render", mesh, *size, "-o", mesh.with_suffix(".exr")])
    assert outcome.returncode == 3 and not mesh.with_suffix(".exr").exists()
    lines = said(outcome)
    assert len(lines) == 1, outcome.stderr
    return lines[0]


def test_what_is_wrong_in_the_part_of_one_rank(tmp_path):
    mesh = tmp_path / "mesh.ply"
    good = ply([3] * 90)
    faces = len(good) - 90 * 13
    # An index of face 50, and a coordinate of vertex 30.
    mesh.write_bytes(good[:faces + 50 * 13 + 1] + struct.pack("<i", 60) + good[faces + 50 * 13 + 5:])
    assert "index 60 is out of range, expected 0 to 59 (rank 1 of 3)" in refused(mesh)
    vertex = faces - 30 * 12
    mesh.write_bytes(good[:vertex] + struct.pack("<f", math.nan) + good[vertex + 4:])
    assert f"byte {vertex}: coordinate x is not finite, expected a finite number (rank 1 of 3)" in refused(mesh)


def test_warnings_are_said_once(tmp_path):
    mesh = tmp_path / "mesh.ply"
    mesh.write_bytes(ply(mixed(3)))
    outcome = run([*mpirun, "-n", 3, mpi_program, "render", mesh, *size, "-o", tmp_path / "map.exr"])
    assert outcome.returncode == 0, outcome.stderr
    assert sum("5 faces" in line for line in said(outcome)) == 1, outcome.stderr
