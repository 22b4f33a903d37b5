"""fathom cast: the answers of Scene.cast() as CSV and NPZ, and its refusals."""

import csv
import os
import signal
import subprocess
import sys

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


@pytest.fixture(scope="module")
def many_rays():
    """More than the blocks in which they are cast."""
    random = np.random.default_rng(6)
    origins = random.integers(-8, 9, (150_000, 3)) / 4
    directions = random.integers(-2, 3, (150_000, 3)) / 2
    directions[(directions == 0).all(axis=1)] = (0, 1, 0)
    return np.concatenate([origins, directions], axis=1)


def write_csv(file, rays):
    file.write_text(heading + "".join(f"{','.join(map(repr, row))}\n" for row in rays.tolist()))


@pytest.mark.parametrize("mode", ["nearest", "all"])
def test_blocks_do_not_show_in_hits(mesh, many_rays, tmp_path, mode):
    np.save(tmp_path / "rays.npy", many_rays)
    run(mesh, "--rays", "rays.npy", "--mode", mode, "--channels", "t,id,face", "-o", "hits.npz", cwd=tmp_path, check=True)
    hits = fathom.Scene.read(mesh).cast(many_rays, mode=mode, channels=("t", "id", "face"))
    if mode == "nearest":
        hits = {"ray": np.arange(len(many_rays)), **hits}
    with np.load(tmp_path / "hits.npz") as found:
        assert sorted(found.files) == sorted(hits)
        for name, array in hits.items():
            assert found[name].shape == array.shape and np.array_equal(found[name], array)


@pytest.mark.parametrize("output", ["-", "hits.csv"])
def test_blocks_do_not_show_in_text(mesh, many_rays, tmp_path, output):
    write_csv(tmp_path / "rays.csv", many_rays)
    ran = run(mesh, "--rays", "rays.csv", "--mode", "count", "-o", output, cwd=tmp_path, check=True)
    text = ran.stdout if output == "-" else (tmp_path / output).read_text()
    count = fathom.Scene.read(mesh).count(many_rays)
    assert text == "ray,count\n" + "".join(f"{i},{n}\n" for i, n in enumerate(count))
    lines = ran.stdout.count("\n")
    assert lines == (len(many_rays) + 1 if output == "-" else 0)


@pytest.mark.parametrize("kind", ["<f8", ">f8", "<f4", ">f4", "<f2"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_arrays_of_every_type_and_order(mesh, rays, tmp_path, kind, order):
    np.save(tmp_path / "rays.npy", np.asarray(rays, kind, order=order))
    count = fathom.Scene.read(mesh).count(rays).tolist()
    for name, options in (("rays.npy", {}), ("-", {"stdin": open(tmp_path / "rays.npy", "rb")}),
                          ("/dev/stdin", {"stdin": pipe_from(tmp_path / "rays.npy")})):
        ran = run(mesh, "--rays", name, "--mode", "count", cwd=tmp_path, check=True, **options)
        assert [int(line.split(",")[1]) for line in ran.stdout.split()[1:]] == count


def pipe_from(file):
    return subprocess.Popen(["cat", file], stdout=subprocess.PIPE).stdout


def test_a_fault_behind_the_first_block_leaves_nothing(mesh, many_rays, tmp_path):
    faulty = many_rays.copy()
    faulty[140_000, 3:] = 0
    np.save(tmp_path / "rays.npy", faulty)
    write_csv(tmp_path / "rays.csv", faulty)
    for file, message in (("rays.npy", "row 140000: the direction is 0"), ("rays.csv", "line 140002: the direction is 0")):
        for output in ("-", "hits.csv", "hits.npz"):
            ran = run(mesh, "--rays", file, "-o", output, cwd=tmp_path)
            assert ran.returncode == 3 and f"{file}: {message}" in ran.stderr and not ran.stdout
    assert sorted(each.name for each in tmp_path.iterdir()) == ["rays.csv", "rays.npy"]


@pytest.mark.parametrize("through_pipe", [False, True])
@pytest.mark.parametrize("change, found", [(-1, 7_199_999), (8, 7_200_008), (-48, 7_199_952), (48, 7_200_048)])
def test_a_cut_or_overlong_array(mesh, many_rays, tmp_path, change, found, through_pipe):
    file = tmp_path / "rays.npy"
    np.save(file, many_rays)
    whole = file.read_bytes()
    file.write_bytes(whole[:change] if change < 0 else whole + bytes(change))
    options = {"stdin": pipe_from(file)} if through_pipe else {}
    ran = run(mesh, "--rays", "-" if through_pipe else file, **options)
    expected = f"truncated or overlong NPY file: expected 150000×6 values of 8 bytes, found {found} bytes"
    assert ran.returncode == 3 and expected in ran.stderr and not ran.stdout


@pytest.mark.parametrize("ends", ["\n", "\r\n", "\r"])
def test_line_ends_a_mark_and_long_lines(mesh, rays, tmp_path, ends):
    lines = ["\ufeffx,y,z,dx,dy,dz", "", *(",".join(map(repr, row)) for row in rays.tolist())]
    lines[3] += " " * 1_000_000  # the lines behind it are in the next piece of the file
    (tmp_path / "rays.csv").write_bytes(ends.join(lines).encode())
    ran = run(mesh, "--rays", "rays.csv", "--mode", "count", cwd=tmp_path, check=True)
    count = fathom.Scene.read(mesh).count(rays).tolist()
    assert [int(line.split(",")[1]) for line in ran.stdout.split()[1:]] == count
    lines[3] += " " * 100_000
    (tmp_path / "rays.csv").write_bytes(ends.join(lines).encode())
    ran = run(mesh, "--rays", "rays.csv", cwd=tmp_path)
    assert ran.returncode == 3 and "rays.csv: line 4: is longer than 1048576 bytes" in ran.stderr


def peak_memory(arguments, **options):
    """In bytes, of a successful run. A process begins with the peak of the one that starts it: here a small one."""
    measure = ("import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
               "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=sys.stderr)")
    command = [sys.executable, "-c", measure, os.environ["FATHOM_PROGRAM"], "cast", *map(str, arguments)]
    return 1024 * int(subprocess.run(command, stderr=subprocess.PIPE, check=True, **options).stderr)


@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps freed memory")
@pytest.mark.parametrize("output, mode", [("hits.npz", "all"), ("hits.csv", "nearest"), ("-", "count")])
def test_ten_times_the_rays_take_the_same_memory(mesh, tmp_path, output, mode):
    """1 million rays are 48 MB, and their hits in memory as much."""
    random = np.random.default_rng(7)
    peaks = []
    for count in (100_000, 1_000_000):
        np.save(tmp_path / "rays.npy", np.concatenate([np.full((count, 3), 0.25), random.random((count, 3))], axis=1))
        with open(tmp_path / "rays.npy", "rb") as source, open(tmp_path / "out", "wb") as target:
            peaks.append(peak_memory([mesh, "--rays", "-", "--mode", mode, "--threads", 2, "-o", output], stdin=source,
                                     stdout=target, cwd=tmp_path))
    assert peaks[1] - peaks[0] < 16e6, peaks


def test_an_interrupted_cast_leaves_nothing(mesh, tmp_path):
    """Rays without end come through a pipe."""
    environment = {**os.environ, "TMPDIR": str(tmp_path / "temporary")}
    (tmp_path / "temporary").mkdir()
    environment.pop("LD_PRELOAD", None)
    for output in ("hits.npz", "hits.csv", "-"):
        process = subprocess.Popen([os.environ["FATHOM_PROGRAM"], "cast", mesh, "--rays", "-", "-o", output], cwd=tmp_path,
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        os.write(process.stdin.fileno(), heading.encode())
        for _ in range(100):
            process.stdin.write(b"0,0,0,0,0,1\n" * 2000)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate()
        assert process.returncode in (130, -signal.SIGINT) and not out
    assert [each.name for each in tmp_path.iterdir()] == ["temporary"] and not list((tmp_path / "temporary").iterdir())
