"""Any number of ranks, with any partition of the tiles, writes the same file as one process, byte
for byte: every channel, and what the file says of itself. Here scenes drawn
at random."""

import pytest

from mpi_runs import channels, combinations, expect_same_for, is_long, segments
from random_scenes import RandomScene


@pytest.mark.parametrize("seed", range(100 if is_long else 12))
def test_random_scenes(tmp_path, seed):
    scene = RandomScene(seed, tmp_path)
    for combination in combinations(seed):
        print("seed", seed, combination, *scene.arguments)
        expect_same_for(combination, tmp_path, *scene.arguments, "--channels", channels + segments * (seed % 2))
