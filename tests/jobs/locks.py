#!/usr/bin/env python3
"""Looks whether every lock that a job takes would be granted by a file server.

    tests/jobs/locks.py FATHOM

NFS and CIFS grant an exclusive lock only on a file that is open for writing (flock(2)), which no local file system asks
for. The calls of two shards, and of the run that ends them, are recorded by strace; beside the maps lies a part that a
killed process has left, which the first of them removes.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import job_runs

OPEN = re.compile(r'openat\([^"]*"([^"]*)", ([A-Z_|]+).*= (\d+)$')
LOCK = re.compile(r"flock\((\d+), LOCK_EX")


def locks(record):
    """The name and the flags of each file that is locked, of a process whose threads open files by turns."""
    opened = {}
    for line in record.splitlines():
        if found := OPEN.search(line):
            opened[found[3]] = found[1], found[2].split("|")
        elif found := LOCK.search(line):
            yield opened[found[1]]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cameras, record = job_runs.make_cameras(program, folder, 4, "64x48"), folder / "record"
        left = folder / "out/maps/.fathom-0123456789abcdef.part"
        left.parent.mkdir(parents=True)
        left.touch(0o600)
        names = set()
        for part in (["--shard", "1/2"], ["--shard", "2/2"], []):
            traced = ["strace", "-f", "-qq", "-o", record, "-e", "trace=openat,flock"]
            subprocess.run([*traced, *job_runs.command(program, cameras, folder / "out"), *part], check=True,
                           stdout=subprocess.DEVNULL)
            for file, flags in locks(record.read_text()):
                if not {"O_RDWR", "O_WRONLY"} & set(flags):
                    sys.exit(f"{file}: is locked, and open as {'|'.join(flags)}: NFS would not grant that")
                names.add(pathlib.PurePath(file).name)
        expected = {left.name, job_runs.MANIFEST, "fathom-manifest-1-of-2.jsonl", "fathom-manifest-2-of-2.jsonl"}
        if not expected <= names or left.exists():
            sys.exit(f"these should have been locked, and the part removed: {sorted(expected - names)}")
        print(f"{len(names)} files were locked, each open for writing: {sorted(names)}")


if __name__ == "__main__":
    main()
