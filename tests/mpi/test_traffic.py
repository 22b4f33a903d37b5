"""Figures of --traffic: sums that follow from the number of ranks, the triangles and the image."""

import json

from mpi_runs import mpi_program, mpirun, run, source

spot = source / "data/meshes/spot.obj"


def traffic_of(count, folder, *options):
    outcome = run([*mpirun, "-n", count, mpi_program, "render", spot, "--size", "256x192", "--quiet", "--threads", 1,
                   "-o", folder / "map.exr", "--traffic", "-", *options])
    assert outcome.returncode == 0, outcome.stderr
    return json.loads(outcome.stdout)


def test_one_rank_sends_nothing(tmp_path):
    found = traffic_of(1, tmp_path)
    assert found["ranks"] == 1 and found["triangles"] == found["drawn"] == found["most_drawn"] == 5856
    assert {each["bytes"] for each in found["sent"].values()} == {each["messages"] for each in found["sent"].values()} == {0}


def test_rows_send_their_triangles_and_no_pixels(tmp_path):
    # The bands coincide with the three rows of 4 tiles each: no pixel is sent.
    found = traffic_of(3, tmp_path, "--partition", "rows", "--channels", "Z,A,id")
    sent = found["sent"]
    assert sent["pixels"] == {"messages": 0, "bytes": 0}
    assert 0 < sent["triangles"]["messages"] <= 3 * 2 and 20 * (found["drawn"] - found["triangles"]) < sent["triangles"]["bytes"]
    # Chunks of 16 rows, of two bands of 64.
    assert sent["chunks"]["messages"] == 8 and 0 < sent["chunks"]["bytes"] < 2 * 64 * 256 * 12
    assert found["triangles"] <= found["drawn"] <= 3 * found["most_drawn"]
    assert 0 < found["seconds"]["slowest"] <= found["seconds"]["drawing"]


def test_pixels_travel_once(tmp_path):
    # Round robin over 3 ranks: a band has 4 of the 12 tiles; tiles that another rank has drawn are sent.
    found = traffic_of(3, tmp_path, "--partition", "round-robin", "--channels", "Z")
    owners = [tile % 3 for tile in range(12)]
    moving = sum(owner != tile // 4 for tile, owner in enumerate(owners))
    assert found["sent"]["pixels"]["bytes"] == moving * 64 * 64 * 4
