"""docs/farms/Snakefile, by Snakemake on this machine."""

from farm_runs import source

COMMAND = ("snakemake", "--cores", "2", "--snakefile", source / "docs/farms/Snakefile")


def test_the_shards_make_the_bytes_of_one_undisturbed_run(farm):
    told = farm.run(*COMMAND)
    assert told.count(", 3 made now, of 12 in 4 shards") == 4
    assert "maps: 12 maps, 0 made now\n" in told
    farm.assert_whole()
    assert "Nothing to be done" in farm.run(*COMMAND)


def test_what_a_killed_shard_has_not_made_is_made_by_the_same_command(farm):
    farm.kill(2)
    ran = farm.start(*COMMAND, "--keep-going")
    assert ran.returncode == 1 and "Error in rule shard" in ran.stdout
    farm.assert_lacks_some_of(2, of=4)
    farm.heal()
    told = farm.run(*COMMAND)
    # Finished shards are not even started again.
    assert told.count("of 12 in 4 shards") == 1
    farm.assert_whole()


def test_a_shard_that_fails_says_so_in_its_line(farm):
    farm.lose_mesh_of(3)
    ran = farm.start(*COMMAND, "--keep-going")
    assert ran.returncode == 1
    assert "\nfathom: error: missing.ply: cannot be opened: No such file or directory\n" in ran.stdout
    assert ran.stdout.count("fathom: error") == 1
    farm.assert_lacks_all_of(3, of=4)
    farm.heal()
    farm.run(*COMMAND)
    farm.assert_whole()


def test_a_mesh_that_is_missing_or_damaged_fails_and_one_that_has_changed_makes_all_maps_anew(farm):
    mesh = farm.mesh.read_bytes()
    farm.mesh.unlink()
    ran = farm.start(*COMMAND)
    assert ran.returncode == 1 and "Missing input files" in ran.stdout and "room.ply" in ran.stdout
    farm.mesh.write_bytes(mesh[:300])
    ran = farm.start(*COMMAND)
    assert ran.returncode == 1 and "fathom: error: room.ply: " in ran.stdout
    assert not (farm.folder / "maps").exists()
    farm.mesh.write_bytes((source / "data/meshes/cube-ascii.stl").read_bytes())
    farm.run(*COMMAND)
    farm.mesh.write_bytes(mesh)
    told = farm.run(*COMMAND)
    assert told.count(", 3 made now, of 12 in 4 shards") == 4 and "maps: 12 maps, 0 made now\n" in told
    farm.assert_whole()


def test_another_command_makes_all_maps_anew(farm):
    text = COMMAND[-1].read_text(encoding="utf-8")
    assert text.count(" -o maps") == 1
    (farm.folder / "Snakefile").write_text(text.replace(" -o maps", " -o maps --channels Z"), encoding="utf-8")
    farm.run("snakemake", "--cores", "2")
    told = farm.run(*COMMAND)
    assert told.count(", 3 made now, of 12 in 4 shards") == 4 and "maps: 12 maps, 0 made now\n" in told
    farm.assert_whole()


def test_a_map_that_was_lost_later_is_made_by_the_closing_rule(farm):
    farm.run(*COMMAND)
    (farm.folder / "maps/000004.exr").unlink()
    told = farm.run(*COMMAND, "--forcerun", "all")
    assert "maps: 12 maps, 1 made now\n" in told and "in 4 shards" not in told
    farm.assert_whole()
