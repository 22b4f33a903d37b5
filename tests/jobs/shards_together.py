#!/usr/bin/env python3
"""Lets two shards of a job end at the same time, again and again.

    tests/jobs/shards_together.py FATHOM [--rounds N] [--maps N]

Shards that end together both write the lists of the job. Each has to end with 0, and the folder has the bytes of an
undisturbed run. Of a file that one shard replaces, the system may give the number (inode) to the next file that the other
shard writes.
"""
import argparse
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import job_runs


def make_cameras(folder, count):
    """A NeRF's cameras, side by side in front of the mesh."""
    frames = [{"file_path": f"./images/{number}",
               "transform_matrix": [[1, 0, 0, number / 10], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]]}
              for number in range(count)]
    file = folder / "transforms.json"
    file.write_text(json.dumps({"camera_angle_x": 0.7, "w": 16, "h": 12, "frames": frames}))
    return file


def command(program, cameras, out):
    """A job with two lists, cameras.json and transforms.json."""
    return [str(part) for part in (program, "dataset", "nerf", cameras, "--mesh", job_runs.MESH, "--out", out,
                                   "--threads", "1")]


def outputs(folder):
    return {name: data for name, data in job_runs.content(folder).items() if not job_runs.is_manifest(name)}


def disturb(shards, draw):
    """Stops one shard after another for a moment, until all have ended, so that they meet in many orders."""
    while any(shard.poll() is None for shard in shards):
        shard = draw.choice(shards)
        shard.send_signal(signal.SIGSTOP)
        time.sleep(draw.uniform(0, 0.004))
        shard.send_signal(signal.SIGCONT)
        time.sleep(draw.uniform(0, 0.002))


def run_together(program, cameras, out, draw):
    shards = [subprocess.Popen([*command(program, cameras, out), "--shard", f"{number}/2"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True) for number in (1, 2)]
    disturb(shards, draw)
    return [(shard.communicate()[1], shard.returncode) for shard in shards]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=40)
    parser.add_argument("--maps", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    draw = random.Random(given.seed)
    program = pathlib.Path(given.program).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cameras = make_cameras(folder, given.maps)
        subprocess.run(command(program, cameras, folder / "whole"), check=True, stdout=subprocess.DEVNULL)
        whole = outputs(folder / "whole")
        failures = []
        for number in range(given.rounds):
            out = folder / "out"
            failures += [f"round {number}: exit status {status}: {said}"
                         for said, status in run_together(program, cameras, out, draw) if status != 0]
            if outputs(out) != whole:
                failures.append(f"round {number}: the folder is not that of an undisturbed run")
            shutil.rmtree(out)
        if failures:
            sys.exit(f"{len(failures)} failures in {given.rounds} rounds:\n" + "\n".join(failures))
        print(f"{given.rounds} times two shards ended together, with the bytes of an undisturbed run")


if __name__ == "__main__":
    main()
