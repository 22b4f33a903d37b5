"""docs/farms/dask_bag.py, by Dask's bag in processes of this machine."""

import sys

from farm_runs import KILLED, source

COMMAND = (sys.executable, "-B", source / "docs/farms/dask_bag.py")


def made(farm):
    """The maps that are there; each is whole."""
    there = {name: data for name, data in farm.maps().items() if not name.startswith("part-")}
    assert [name for name in there if there[name] != farm.whole.get(name)] == []
    return sorted(there)


def all_maps(farm):
    return sorted(name for name in farm.whole if name.endswith(".exr"))


def test_the_maps_have_the_bytes_of_those_that_the_program_makes(farm):
    farm.run(*COMMAND)
    assert made(farm) == all_maps(farm)


def test_what_a_killed_process_has_not_made_is_made_by_the_same_command(farm):
    ran = farm.start(*KILLED.split(), *COMMAND)
    assert ran.returncode == 1 and "BrokenProcessPool" in ran.stdout
    assert 0 < len(made(farm)) < 12
    farm.run(*COMMAND)
    assert made(farm) == sorted(farm.maps()) == all_maps(farm)


def test_without_the_mesh_nothing_is_written(farm):
    farm.mesh.unlink()
    ran = farm.start(*COMMAND)
    assert ran.returncode == 1 and "room.ply: cannot be opened: No such file or directory" in ran.stdout
    assert not (farm.folder / "maps").exists()
