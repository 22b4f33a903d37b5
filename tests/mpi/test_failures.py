"""A run of several ranks fails as one: with one line, its exit status, and nothing of its outputs left."""

import filecmp
import math
import os
import signal
import struct
import subprocess
import time

import pytest

from mpi_runs import environment, is_long, mpi_program, mpirun, run, said, source

spot = source / "data/meshes/spot.obj"


def render_in(folders, *arguments):
    """One rank for each of these working directories."""
    command = list(mpirun)
    for i, folder in enumerate(folders):
        command += [*([":"] if i else []), "-n", "1", "--wdir", folder, mpi_program, "render", *arguments]
    return run(command)


def expect_failure(outcome, status, text, folder):
    assert outcome.returncode == status, outcome.stderr
    lines = said(outcome)
    assert len(lines) == 1 and text in lines[0], outcome.stderr
    assert not list(folder.glob("*.exr")) and not list(folder.glob(".fathom*"))


@pytest.mark.parametrize("arguments, status, text", [
    (["nothing.obj"], 3, "nothing.obj: cannot be opened"),
    ([spot, "--chanels", "Z"], 2, "did you mean '--channels'?"),
    ([spot, "--partition", "row"], 2, "did you mean 'rows'?"),
    ([spot, "--deep", "--channels", "Z"], 2, "--deep always has the channels A, Z"),
    ([spot, "--stream"], 2, "leaves binary STL and PLY in their files anyway"),
    ([spot, "--engine", "reference"], 2, "supports only --engine fast"),
    (["-"], 2, "standard input, reaches one rank only"),
    ([spot, "--memory", "100M"], 2, "--memory: expected at least 128M"),
    ([spot, "--size", "100000x100000", "--max-memory", "1G", "--compression", "piz"], 3, "an image of 100000x100000 pixels"),
], ids=lambda value: "-".join(str(part) for part in value if part != spot) if isinstance(value, list) else None)
def test_what_all_ranks_refuse(tmp_path, arguments, status, text):
    expect_failure(render_in([tmp_path] * 3, *arguments, "-o", tmp_path / "map.exr"), status, text, tmp_path)


def test_a_depth_that_a_png_cannot_hold(tmp_path):
    outcome = render_in([tmp_path] * 2, spot, "--size", "200x150", "--png-scale", "30000", "-o", tmp_path / "map.png")
    expect_failure(outcome, 4, f"fathom: error: {tmp_path / 'map.png'}: pixel (", tmp_path)
    assert not (tmp_path / "map.png").exists()


def test_a_file_that_one_rank_does_not_have(tmp_path):
    here, there = tmp_path / "here", tmp_path / "there"
    for folder in (here, there):
        folder.mkdir()
    (here / "mesh.obj").write_bytes(spot.read_bytes())
    outcome = render_in([here, there, here], "mesh.obj", "-o", tmp_path / "map.exr")
    expect_failure(outcome, 3, "mesh.obj: cannot be opened: No such file or directory (rank 1 of 3)", tmp_path)


def test_another_file_of_the_same_name(tmp_path):
    here, there = tmp_path / "here", tmp_path / "there"
    for folder in (here, there):
        folder.mkdir()
    (here / "mesh.obj").write_bytes(spot.read_bytes())
    (there / "mesh.obj").write_bytes(spot.read_bytes() + b"f 1 2 3\n")
    outcome = render_in([here, there], "mesh.obj", "-o", tmp_path / "map.exr")
    expect_failure(outcome, 3, "the ranks read different files (rank 1 of 2", tmp_path)


@pytest.mark.parametrize("view", [[], ["--camera", source / "data/cameras/look-at.json"]], ids=["framed", "camera"])
def test_a_triangle_that_only_one_rank_reads(tmp_path, view):
    mesh = tmp_path / "mesh.stl"
    records = [struct.pack("<12fH", 0, 0, 0, *(math.nan if i == 500 and k == 4 else i % 7 + k % 5 for k in range(9)), 0)
               for i in range(900)]
    mesh.write_bytes(bytes(80) + struct.pack("<I", len(records)) + b"".join(records))
    outcome = render_in([tmp_path] * 3, mesh, *view, "-o", tmp_path / "map.exr")
    expect_failure(outcome, 3, "triangle 500", tmp_path)
    assert outcome.stderr.count("(rank 1 of 3)") == 1
    mesh.write_bytes(mesh.read_bytes()[:-1])
    expect_failure(render_in([tmp_path] * 3, mesh, *view, "-o", tmp_path / "map.exr"), 3, "mesh.stl: ", tmp_path)


def test_different_arguments(tmp_path):
    one = ["-n", "1", mpi_program, "render", spot, "-o", tmp_path / "map.exr"]
    outcome = run([*mpirun, *one, ":", *one, "--channels", "Z"])
    expect_failure(outcome, 2, "the ranks were started with different arguments (rank 1 of 2", tmp_path)


def test_a_disk_that_is_full(tmp_path):
    expect_failure(render_in([tmp_path] * 2, spot, "--size", "64x48", "-o", "/dev/full"), 4,
                   "/dev/full: No space left on device", tmp_path)


def test_help_is_said_once(tmp_path):
    outcome = run([*mpirun, "-n", "3", mpi_program, "--version"])
    assert outcome.returncode == 0 and outcome.stdout.count("fathom") == 1


def has_no_output(pid):
    """Whether a process has closed standard output, as all ranks but the first do when MPI has started in all."""
    return os.readlink(f"/proc/{pid}/fd/1") == os.devnull


def processes_of(run_of_ranks, count):
    """The ranks that mpirun has started, once they are that many and MPI has started, too: where a process dies earlier,
    mpirun of Open MPI 4.1.4 itself can wait for ever."""
    for _ in range(6000):
        listed = subprocess.run(["pgrep", "-P", str(run_of_ranks.pid), "fathom-mpi"], capture_output=True, text=True)
        pids = sorted(map(int, listed.stdout.split()))
        if len(pids) == count and any(map(has_no_output, pids)):
            return pids
        time.sleep(0.005)
    raise AssertionError("the ranks do not start")


def start_run(output):
    command = [*mpirun, "-n", "3", mpi_program, "render", spot, "--size", "6000x6000", "--channels", "Z,A,id,N,P", "-o", output]
    return subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env=environment())


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """The map of a run that nobody kills, and the seconds from the start of MPI to its end."""
    output = tmp_path_factory.mktemp("undisturbed") / "map.exr"
    process = start_run(output)
    processes_of(process, 3)
    start = time.monotonic()
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
    return output, time.monotonic() - start


def kill_a_rank(output, rank, delay):
    """The exit status and the error messages of a run after one of its ranks was killed."""
    process = start_run(output)
    victim = processes_of(process, 3)[rank]
    time.sleep(delay)
    try:
        os.kill(victim, signal.SIGKILL)
    except ProcessLookupError:
        pass
    _, err = process.communicate(timeout=60)
    return process.returncode, err


# While they read, draw and write: from the start of MPI to 9/10 of the time of a run. A run that has written its map
# before the kill has written all of it, and is tried again with half the delay.
@pytest.mark.parametrize("attempt", range(50) if is_long else [0, 13, 29, 48])
def test_a_rank_that_is_killed(tmp_path, undisturbed, attempt):
    expected, seconds = undisturbed
    output = tmp_path / "map.exr"
    delay = 0.9 * seconds * attempt / 50
    status, err = kill_a_rank(output, attempt % 3, delay)
    while output.exists():
        assert filecmp.cmp(output, expected, shallow=False)
        output.unlink()
        delay /= 2
        status, err = kill_a_rank(output, attempt % 3, delay)
    assert status == 128 + signal.SIGKILL, err
    lines = [line for line in err.splitlines() if line.startswith("fathom: ")]
    assert lines == ["fathom: error: a rank of the run has ended, or all were told to: nothing is written"], err
    assert not list(tmp_path.iterdir())
