"""Any number of ranks, with any partition of the tiles, writes the same file as one process, byte
for byte: every channel, and what the file says of itself. Here by every number of ranks and every partition."""

import pytest

from mpi_runs import channels, expect_same_for, partitions, ranks, segments, source

data = source / "data"


@pytest.mark.parametrize("count", ranks)
@pytest.mark.parametrize("partition", partitions)
def test_every_number_of_ranks_and_every_partition(tmp_path, count, partition):
    scene = [data / "meshes/spot.obj", data / "scenes/pair.json", data / "meshes/house.glb"]
    expect_same_for((count, partition), tmp_path, *scene, "--size", "500x300", "--view", "30,20",
                    "--channels", channels + segments)
