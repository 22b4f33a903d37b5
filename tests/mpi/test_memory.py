"""Triangles are taken in rounds, and tiles wait in files, where a rank may take little memory: the same files."""

import math
import random
import struct

import pytest

from mpi_runs import channels, combinations, expect_same_for, mpi_program, mpirun, render_alone, run, said


def write_sphere(path, rings, times=1):
    """4 · rings² triangles, as a scanner would have them: each next to the one before; all of them several times."""
    def point(i, k):
        a, b = math.pi * i / rings, math.pi * k / rings
        return math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)

    points = [[point(i, k % (2 * rings)) for k in range(2 * rings + 1)] for i in range(rings + 1)]
    triangles = []
    for i in range(rings):
        for k in range(2 * rings):
            a, b, c, d = points[i][k], points[i + 1][k], points[i + 1][k + 1], points[i][k + 1]
            triangles += [(a, b, c), (a, c, d)]
    write_stl(path, triangles, times)


def write_scattered(path, count):
    """Triangles in an order in which no two neighbours are near each other."""
    draw = random.Random(71)
    triangles = []
    for _ in range(count):
        centre = [draw.random() for _ in range(3)]
        triangles.append([[x + draw.uniform(-0.02, 0.02) for x in centre] for _ in range(3)])
    write_stl(path, triangles)


def write_stl(path, triangles, times=1):
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in triangles)
    path.write_bytes(bytes(80) + struct.pack("<I", times * len(triangles)) + times * facets)


@pytest.mark.parametrize("combination", combinations(81), ids=lambda each: f"{each[0]}-{each[1]}")
@pytest.mark.parametrize("write", [lambda path: write_sphere(path, 200), lambda path: write_scattered(path, 120_000)],
                         ids=["sphere", "scattered"])
def test_rounds_do_not_show(tmp_path, combination, write):
    # A rank takes some 20,000 triangles at a time.
    write(tmp_path / "mesh.stl")
    expect_same_for(combination, tmp_path, tmp_path / "mesh.stl", "--size", "900x700", "--channels", channels,
                    of_ranks=["--memory", "128M"])


def test_tiles_that_wait_do_not_show(tmp_path):
    # 4096 tiles of 40 kB or more are far more than 128 MB.
    write_sphere(tmp_path / "mesh.stl", 150)
    expect_same_for((2, "load"), tmp_path, tmp_path / "mesh.stl", "--size", "4096x4096", "--channels", "Z,A,id",
                    of_ranks=["--memory", "128M"])


def test_ranks_that_have_different_memory(tmp_path):
    # One rank would take its part at once, the other in rounds.
    write_scattered(tmp_path / "mesh.stl", 160_000)
    arguments = [tmp_path / "mesh.stl", "--size", "300x200", "--channels", "Z,id", "--quiet"]
    render_alone(*arguments, "-o", tmp_path / "one.exr")
    command = [mpi_program, "render", *arguments, "--threads", 1, "-o", tmp_path / "several.exr"]
    outcome = run([*mpirun, "-n", 1, *command, ":", "-n", 1, "bash", "-c", 'ulimit -v 450000; exec "$@"', "bash", *command])
    assert outcome.returncode == 0, outcome.stderr
    assert (tmp_path / "one.exr").read_bytes() == (tmp_path / "several.exr").read_bytes()


def peak_memory(folder, *options):
    """Of the greatest process, in MB."""
    script = ("import resource, subprocess, sys; status = subprocess.call(sys.argv[1:]); "
              "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024); sys.exit(status)")
    outcome = run(["/usr/bin/python3", "-c", script, *mpirun, "-n", 2, mpi_program, "render", folder / "mesh.stl",
                   "--size", "640x480", "--channels", "Z,A", "--threads", 1, "--quiet", "-o", folder / "map.exr", *options])
    assert outcome.returncode == 0, outcome.stderr
    return float(outcome.stdout)


def test_memory_is_bounded(tmp_path):
    write_sphere(tmp_path / "mesh.stl", 150, times=12)
    assert peak_memory(tmp_path) > 150
    assert peak_memory(tmp_path, "--memory", "128M") < 128


@pytest.mark.parametrize("folder, text", [("/proc", "/proc"), ("none", "TMPDIR: expected a folder")])
def test_no_room_for_what_waits(tmp_path, folder, text):
    """A missing folder gives one line of error, and nothing is written."""
    write_sphere(tmp_path / "mesh.stl", 150)
    outcome = run([*mpirun, "-n", 2, "env", f"TMPDIR={folder}", mpi_program, "render", tmp_path / "mesh.stl", "--size",
                   "4096x4096", "--quiet", "--threads", 1, "--memory", "128M", "-o", tmp_path / "map.exr"])
    assert outcome.returncode == 4 and not (tmp_path / "map.exr").exists()
    lines = said(outcome)
    assert len(lines) == 1 and text in lines[0], outcome.stderr


def test_no_room_in_one_rank(tmp_path):
    """The other hears of it while it draws."""
    write_sphere(tmp_path / "mesh.stl", 150, times=4)
    command = [mpi_program, "render", tmp_path / "mesh.stl", "--size", "7000x7000", "--quiet", "--threads", 1, "--memory",
               "128M", "--partition", "round-robin", "-o", tmp_path / "map.exr"]
    outcome = run([*mpirun, "-n", 2, *command, ":", "-n", 1, "env", "TMPDIR=/proc", *command])
    assert outcome.returncode == 4 and not (tmp_path / "map.exr").exists()
    lines = said(outcome)
    assert len(lines) == 1 and "/proc" in lines[0] and lines[0].endswith("(rank 2 of 3)"), outcome.stderr
