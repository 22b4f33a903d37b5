"""docs/farms/parallel.sh, by GNU parallel on this machine."""

import pytest

from farm_runs import source

SCRIPT = source / "docs/farms/parallel.sh"


def test_the_shards_make_the_bytes_of_one_undisturbed_run(farm):
    told = farm.run(SCRIPT)
    assert told.count(", 3 made now, of 12 in 4 shards") == 4
    assert told.endswith("maps: 12 maps, 0 made now\n")
    farm.assert_whole()


def test_what_a_killed_shard_has_not_made_is_made_by_the_same_command(farm):
    farm.kill(2)
    ran = farm.start(SCRIPT)
    assert ran.returncode == 1
    assert ran.stdout.endswith("parallel.sh: not all shards are finished; the same command goes on from there\n")
    farm.assert_lacks_some_of(2, of=4)
    farm.heal()
    assert farm.run(SCRIPT).count(", 0 made now, of 12 in 4 shards") == 3
    farm.assert_whole()


def test_a_shard_that_fails_says_so_in_its_line(farm):
    farm.lose_mesh_of(3)
    ran = farm.start(SCRIPT)
    assert ran.returncode == 1
    assert "shard 3:\tfathom: error: missing.ply: cannot be opened: No such file or directory\n" in ran.stdout
    assert ran.stdout.count("fathom: error") == 1
    farm.assert_lacks_all_of(3, of=4)
    farm.heal()
    farm.run(SCRIPT)
    farm.assert_whole()


def test_without_the_mesh_nothing_is_written(farm):
    farm.mesh.unlink()
    ran = farm.start(SCRIPT)
    assert ran.returncode == 1 and ran.stdout.count("fathom: error: room.ply: cannot be opened") == 4
    assert not (farm.folder / "maps").exists()


@pytest.mark.parametrize("machines", [":", ":,:"])
def test_names_with_blanks_and_braces_reach_the_program(farm, machines):
    text = SCRIPT.read_text(encoding="utf-8")
    changes = [("-o maps", "-o 'my maps' --name 'a {index:03} b.exr'"), ("machines=:", f"machines={machines}")]
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    farm.put("changed.sh", text)
    farm.run("changed.sh")
    there = sorted(file.name for file in (farm.folder / "my maps").glob("*.exr"))
    assert there == [f"a {number:03} b.exr" for number in range(12)]
