#!/usr/bin/env python3
"""Looks whether starting a job asks the system the same questions, however many cameras there are.

    tests/jobs/start.py FATHOM

Each shard reads all cameras, most of which are not its own. The calls of a shard without any map are counted by strace,
for 10 cameras and for 400: those for 400 are no more by as many as there are cameras.
"""
import pathlib
import subprocess
import sys
import tempfile

import job_runs


def calls(program, folder, count):
    """How many calls to the system a shard without maps makes."""
    cameras, record = job_runs.make_cameras(program, folder, count, "64x48"), folder / "record"
    subprocess.run(["strace", "-f", "-qq", "-o", record, *job_runs.command(program, cameras, folder / f"out-{count}"),
                    "--shard", "1000/1000"], check=True, stdout=subprocess.DEVNULL)
    return len(record.read_text(errors="replace").splitlines())


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        few, many = (calls(program, pathlib.Path(name), count) for count in (10, 400))
        if many - few >= 390:
            sys.exit(f"with 10 cameras {few} calls, with 400 of them {many}")
        print(f"with 10 cameras {few} calls, with 400 of them {many}")


if __name__ == "__main__":
    main()
