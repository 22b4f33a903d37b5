#!/usr/bin/env python3
"""Cuts the power of a job at every point of its work.

    tests/jobs/power_cut.py FATHOM [--maps N]

What the job does to its folder is recorded by strace: contents written, names made and changed, and what is waited for
until it is on the disk. Each prefix of that sequence is then replayed to what a power cut may leave:

    nothing else  contents and names as they were when they were last waited for
    new names     all names, but contents as they were last waited for: an ordinary file system may order them so
    all           everything, as a process that is killed leaves it

In each such folder no file that has its name may have other bytes than an undisturbed run's, every file that the manifest
calls finished is there, and the next run ends with the bytes of an undisturbed one.
"""
import argparse
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import job_runs

CALLS = "openat,write,pwrite64,lseek,ftruncate,fsync,fdatasync,syncfs,linkat,rename,unlink,unlinkat,mkdir,close,flock"
STRING = r'"((?:\\x[0-9a-f]{2})*)"'


def text_of(string):
    return bytes.fromhex(string.replace("\\x", "")).decode("utf-8", "surrogateescape")


def bytes_of(string):
    return bytes.fromhex(string.replace("\\x", ""))


class Disk:
    """A folder: its names, each of a file's number, and the contents of files; as they are, and as the disk has them."""

    def __init__(self, root):
        self.root = root
        self.names, self.names_on_disk = {}, {}
        self.contents, self.on_disk = {}, {}
        self.folders, self.folders_on_disk = set(), set()

    def inside(self, path):
        """The name below the folder; None for what lies elsewhere."""
        path = pathlib.PurePath(path)
        if path == self.root:
            return ""
        return str(path.relative_to(self.root)) if self.root in path.parents else None

    def sync_file(self, number):
        self.on_disk[number] = self.contents[number]

    def sync_folder(self, folder):
        """The names in it, and those of its folders."""
        def here(name):
            return str(pathlib.PurePath(name).parent) in (folder, "." if folder == "" else folder)
        for name in [name for name in self.names_on_disk if here(name) and name not in self.names]:
            del self.names_on_disk[name]
        self.names_on_disk.update({name: number for name, number in self.names.items() if here(name)})
        self.folders_on_disk |= {name for name in self.folders if here(name)}

    def sync_all(self):
        self.on_disk = dict(self.contents)
        self.names_on_disk = dict(self.names)
        self.folders_on_disk = set(self.folders)

    def states(self):
        """What a power cut may leave, by what it is called: folders, and the bytes of files by their names."""
        def files(names, contents):
            return {name: contents.get(number, b"") for name, number in names.items()}
        yield "nothing else", self.folders_on_disk, files(self.names_on_disk, self.on_disk)
        yield "new names", self.folders, files(self.names, self.on_disk)
        yield "all", self.folders, files(self.names, self.contents)


class Replay:
    """The calls that strace has recorded, carried out on a Disk."""

    def __init__(self, disk, working):
        self.disk, self.working = disk, working
        # By process and descriptor: what it is of, and where the next write goes.
        self.open = {}
        self.next_number = 0

    def path(self, name):
        return str(pathlib.PurePath(self.working) / name)

    def carry_out(self, line):
        """Returns whether the folder or what the disk has of it may have changed."""
        match = re.match(r"(\d+) +(\w+)\((.*)\) += (-?\d+)", line)
        if not match or int(match[4]) < 0:
            return False
        _, call, arguments, result = match.groups()
        return getattr(self, "on_" + call)(arguments, int(result))

    def descriptor(self, arguments):
        return self.open.get(int(re.match(r"(\d+)", arguments)[1]))

    def on_openat(self, arguments, result):
        self.open.pop(result, None)
        name = self.disk.inside(self.path(text_of(re.search(STRING, arguments)[1])))
        if name is None:
            return False
        if "O_TMPFILE" in arguments:
            number = self.new_file()
        elif "O_DIRECTORY" in arguments:
            self.open[result] = {"folder": name}
            return False
        elif name in self.disk.names:
            number = self.disk.names[name]
        elif "O_CREAT" in arguments:
            number = self.new_file()
            self.disk.names[name] = number
        else:
            return False
        self.open[result] = {"file": number, "at": 0, "appends": "O_APPEND" in arguments}
        return True

    def new_file(self):
        self.next_number += 1
        self.disk.contents[self.next_number] = b""
        return self.next_number

    def on_write(self, arguments, result):
        file = self.descriptor(arguments)
        if file is None:
            return False
        data = bytes_of(re.search(STRING, arguments.split(", ", 1)[1])[1])[:result]
        if len(data) != result:
            sys.exit(f"strace has cut a write of {result} bytes to {len(data)}")
        old = self.disk.contents[file["file"]]
        at = len(old) if file["appends"] else file["at"]
        self.disk.contents[file["file"]] = old[:at].ljust(at, b"\0") + data + old[at + len(data):]
        file["at"] = at + len(data)
        return True

    def on_lseek(self, arguments, result):
        file = self.descriptor(arguments)
        if file is not None and "file" in file:
            file["at"] = result
        return False

    def on_ftruncate(self, arguments, _):
        file = self.descriptor(arguments)
        if file is None:
            return False
        length = int(arguments.rsplit(", ", 1)[1])
        self.disk.contents[file["file"]] = self.disk.contents[file["file"]][:length].ljust(length, b"\0")
        return True

    def on_fsync(self, arguments, _):
        what = self.descriptor(arguments)
        if what is None:
            return False
        if "file" in what:
            self.disk.sync_file(what["file"])
        else:
            self.disk.sync_folder(what["folder"])
        return True

    on_fdatasync = on_fsync

    def on_syncfs(self, arguments, _):
        self.disk.sync_all()
        return True

    def on_linkat(self, arguments, _):
        first, second = (text_of(string) for string in re.findall(STRING, arguments))
        name = self.disk.inside(self.path(second))
        if name is None:
            return False
        number = re.fullmatch(r"/proc/self/fd/(\d+)", first)
        if not number:
            sys.exit(f"a link from {first}")
        self.disk.names[name] = self.open[int(number[1])]["file"]
        return True

    def on_rename(self, arguments, _):
        first, second = (self.disk.inside(self.path(text_of(string))) for string in re.findall(STRING, arguments))
        if first is None or second is None:
            return False
        self.disk.names[second] = self.disk.names.pop(first)
        return True

    def on_unlink(self, arguments, _):
        name = self.disk.inside(self.path(text_of(re.search(STRING, arguments)[1])))
        return self.disk.names.pop(name, None) is not None

    on_unlinkat = on_unlink

    def on_mkdir(self, arguments, _):
        name = self.disk.inside(self.path(text_of(re.search(STRING, arguments)[1])))
        if name is None:
            return False
        self.disk.folders.add(name)
        return True

    def on_close(self, arguments, _):
        self.open.pop(int(re.match(r"(\d+)", arguments)[1]), None)
        return False

    def on_flock(self, arguments, _):
        return False


def record(command, folder):
    trace = folder / "trace"
    subprocess.run(["strace", "-f", "-xx", "-s", "10000000", "-e", f"trace={CALLS}", "-o", trace, *command],
                   check=True, stdout=subprocess.DEVNULL, cwd=folder)
    lines = trace.read_text(errors="surrogateescape").splitlines()
    if any("unfinished ..." in line and re.search(r"(write|linkat|rename|mkdir)\(", line) for line in lines):
        lines = joined(lines)
    return lines


def joined(lines):
    """Calls of threads that overlapped, each in one line, where it ended."""
    begun, result = {}, []
    for line in lines:
        process = line.split(" ", 1)[0]
        if line.endswith("<unfinished ...>"):
            begun[process] = line[:-len("<unfinished ...>")]
            continue
        resumed = re.match(r"\d+ +<\.\.\. \w+ resumed>(.*)", line)
        result.append(begun.pop(process) + resumed[1] if resumed else line)
    return result


def halves(lines):
    """The same with each write as two, the first of a half: a power cut may come between its bytes."""
    for line in lines:
        match = re.fullmatch(r"(\d+ +write\(\d+, )" + STRING + r", \d+\) += (\d+)", line)
        if not match or int(match[3]) < 2:
            yield line
            continue
        length = int(match[3])
        for part in (match[2][:4 * (length // 2)], match[2][4 * (length // 2):]):
            yield f'{match[1]}"{part}", {len(part) // 4}) = {len(part) // 4}'


def write_state(folders, files, out):
    out.mkdir()
    for folder in sorted(folders):
        if folder:
            (out / folder).mkdir(parents=True, exist_ok=True)
    for name, data in files.items():
        file = out / name
        if file.parent.is_dir():  # a folder that the disk does not have has no names
            file.write_bytes(data)


def finished_of(manifest):
    """The files that complete lines of a manifest call finished."""
    lines = manifest.split(b"\n")[:-1]
    return [file["path"] for line in lines for file in json.loads(line).get("files", [])]


def check_state(given, cameras, state, whole, out):
    kind, folders, files = state
    write_state(folders, files, out)
    there = job_runs.content(out)
    bad = job_runs.half_written(there, whole)
    lost = [name for name in finished_of(there.get(job_runs.MANIFEST, b"")) if there.get(name) != whole[name]]
    if bad or lost:
        sys.exit(f"{kind}: half-written {bad}, lost {lost}")
    job_runs.run(given.program, cameras, out)
    if job_runs.content(out) != whole:
        sys.exit(f"{kind}: the next run does not end as an undisturbed one")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--maps", type=int, default=4)
    given = parser.parse_args()
    given.program = pathlib.Path(given.program).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        cameras = job_runs.make_cameras(given.program, folder, given.maps, "8x6")
        job_runs.run(given.program, cameras, folder / "whole")
        whole = job_runs.content(folder / "whole")
        lines = record(job_runs.command(given.program, cameras, folder / "out"), folder)
        disk = Disk(folder / "out")
        replay = Replay(disk, folder)
        seen, prefixes = set(), 0
        for line in halves(lines):
            if not replay.carry_out(line):
                continue
            prefixes += 1
            for state in disk.states():
                known = repr((sorted(state[1]), sorted(state[2].items())))
                if known in seen or "" not in state[1]:
                    continue
                seen.add(known)
                check_state(given, cameras, copy.deepcopy(state), whole, folder / f"state-{len(seen)}")
        final = {name: disk.on_disk.get(number) for name, number in disk.names_on_disk.items()}
        if final != whole:
            sys.exit("at its end, the disk does not have what the job has made")
        print(f"{prefixes} prefixes of the sequence, {len(seen)} different states: each ends as an undisturbed run")


if __name__ == "__main__":
    main()
