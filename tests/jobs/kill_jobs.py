#!/usr/bin/env python3
"""Kills a job again and again, at random times, by SIGKILL and SIGINT, and lets it go on.

    tests/jobs/kill_jobs.py FATHOM [--kills N] [--maps N] [--seed N]

After each kill every file that has its name has the bytes of an undisturbed run; in the end the folder has those and no
more. A job that ends before it is killed begins again in a new folder.
"""
import argparse
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import job_runs


def kill_once(given, cameras, out, draw, longest):
    """Starts the job and kills it. Returns the number of the signal and what was said, or None where it has ended."""
    process = subprocess.Popen(job_runs.command(given.program, cameras, out), stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    number = draw.choice((signal.SIGKILL, signal.SIGKILL, signal.SIGKILL, signal.SIGINT))
    try:
        process.wait(timeout=draw.uniform(0, longest))
    except subprocess.TimeoutExpired:
        process.send_signal(number)
    said = process.stderr.read().decode()
    status = process.wait()
    if status == 0:
        return None
    # Before the program has begun to listen to it, SIGINT ends it.
    if status not in (-signal.SIGKILL, -signal.SIGINT, 130):
        sys.exit(f"exit status {status}: {said}")
    return status, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--maps", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    given.program = pathlib.Path(given.program).resolve()
    draw = random.Random(given.seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cameras = job_runs.make_cameras(given.program, folder, given.maps, "64x48")
        begin = time.monotonic()
        job_runs.run(given.program, cameras, folder / "whole")
        # So that most are killed at work, not before or after.
        longest = 0.6 * (time.monotonic() - begin)
        whole = job_runs.content(folder / "whole")
        out, kills, finished, said_so, begun = folder / "out", 0, 0, 0, set()
        while kills < given.kills:
            killed = kill_once(given, cameras, out, draw, longest)
            there = job_runs.content(out) if out.exists() else {}
            bad = job_runs.half_written(there, whole)
            if bad:
                sys.exit(f"after {kills} kills these have other bytes than an undisturbed run's: {bad}")
            if killed is None:
                finished += 1
                if there != whole:
                    sys.exit(f"after {kills} kills the folder is not that of an undisturbed run: "
                             f"{sorted(set(there) ^ set(whole))}")
                shutil.rmtree(out)
                continue
            kills += 1
            begun.add(len(there))
            said_so += killed[1].startswith("fathom: interrupted: ") and "are finished" in killed[1]
            if killed[0] == 130 and killed[1] and "finished" not in killed[1]:
                sys.exit(f"interrupted, it said: {killed[1]}")
        job_runs.run(given.program, cameras, out)
        if job_runs.content(out) != whole:
            sys.exit("in the end the folder is not that of an undisturbed run")
        print(f"{kills} kills of a job of {given.maps} maps at {len(begun)} different states; it ended {finished + 1} "
              f"times with the bytes of an undisturbed run; interrupted, it said {said_so} times how far it was")


if __name__ == "__main__":
    main()
