"""A data set of twelve small maps, where the scripts of docs/farms make it, and machines that die."""

import os
import pathlib
import shutil
import subprocess
import sys

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
program = pathlib.Path(os.environ["FATHOM_PROGRAM"])
sys.path.insert(0, str(source / "tests/jobs"))
import job_runs  # noqa: E402

# Ends the process when it gives the second of its maps a name: in the middle of the work of a shard.
KILLED = "strace -f -qq -o /dev/null -e trace=linkat,rename -e inject=linkat,rename:signal=KILL:when=2"


class Farm:
    """A folder as docs/farms.md has it: cameras.json, room.ply, and no maps yet."""

    def __init__(self, folder):
        self.folder, self.programs = folder / "farm", folder / "programs"
        self.folder.mkdir()
        self.programs.mkdir()
        self.mesh = self.folder / "room.ply"
        shutil.copy(source / "data/meshes/cube-little-endian.ply", self.mesh)
        # What the tools leave in the home of who starts them stays here.
        self.environment = {**os.environ, "HOME": str(folder), "PATH": f"{self.programs}:{os.environ['PATH']}"}
        self.heal()
        self.run("fathom", "camera", "orbit", "room.ply", "--views", "12", "--size", "64x48", "-o", "cameras.json")
        self.run("fathom", "dataset", "maps", "cameras.json", "--mesh", "room.ply", "--out", folder / "whole")
        self.whole = job_runs.content(folder / "whole")
        assert len(self.whole) == 14  # with cameras.json and the manifest

    def start(self, *command):
        """Runs it in the folder. What it prints is in `stdout`, with what it prints of errors."""
        return subprocess.run(command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=240)

    def run(self, *command):
        """As start(); a failure is a failure of the test."""
        ran = self.start(*command)
        assert ran.returncode == 0, ran.stdout
        return ran.stdout

    def put(self, name, text):
        """A program that is found before all others of its name."""
        file = self.programs / name
        file.unlink(missing_ok=True)
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)

    def spoil(self, shard, command):
        """From now on a process of this shard is `command`, where "$@" are the arguments that fathom was given."""
        self.put("fathom", f'#!/bin/sh\ncase " $* " in *" --shard {shard}/"*) exec {command} ;; esac\n'
                           f'exec "{program}" "$@"\n')

    def kill(self, shard):
        """From now on the process of this shard dies in the middle of its work."""
        self.spoil(shard, f'{KILLED} "{program}" "$@"')

    def lose_mesh_of(self, shard):
        """From now on this shard needs a mesh that is not there."""
        self.spoil(shard, f'"{program}" "$@" --mesh missing.ply')

    def heal(self):
        """From now on all shards are as they should be."""
        self.put("fathom", f'#!/bin/sh\nexec "{program}" "$@"\n')

    def maps(self):
        return job_runs.content(self.folder / "maps")

    def assert_whole(self):
        """The folder has, to the byte, what one undisturbed run without shards leaves."""
        there = self.maps()
        assert sorted(there) == sorted(self.whole)
        assert [name for name in there if there[name] != self.whole[name]] == []

    def assert_lacks_some_of(self, shard, of):
        """Each file that is there is whole, and of this shard some maps are there, and some, or the lists, are not."""
        there = self.maps()
        assert job_runs.half_written(there, self.whole) == []
        expected = [f"{number:06}.exr" for number in range(shard - 1, 12, of)]
        assert 0 < sum(name in there for name in expected) < len(expected), sorted(there)
        assert "cameras.json" not in there and job_runs.MANIFEST not in there

    def assert_lacks_all_of(self, shard, of):
        """Each file that is there is whole, and of this shard none is."""
        there = self.maps()
        assert job_runs.half_written(there, self.whole) == []
        assert not any(f"{number:06}.exr" in there for number in range(shard - 1, 12, of))
        assert "cameras.json" not in there and job_runs.MANIFEST not in there
