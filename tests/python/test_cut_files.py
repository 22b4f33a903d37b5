"""A file that another program cuts short while it is read, by every interface: an error of one line, or the whole.

A process that reads the file is stopped as soon as it has the file open, and the file is cut then; once more it is cut
at a random time. Files of more than 64 MiB, which used to be mapped everywhere: reading on was a SIGBUS.
"""

import os
import pathlib
import random
import signal
import struct
import subprocess
import sys
import time

import pytest

# What a program in C does, by the same functions.
in_c = """
import ctypes, os, sys
library = ctypes.CDLL(os.environ["FATHOM_C_LIBRARY"])
library.fathom_error.restype = ctypes.c_char_p
scene = ctypes.c_void_p()
names = (ctypes.c_char_p * 1)(sys.argv[1].encode())
status = library.fathom_scene_read(names, ctypes.c_size_t(1), ctypes.byref(scene))
print(library.fathom_error().decode(), file=sys.stderr)
os._exit(status)
"""
in_python = """
import os, sys, fathom
try:
    fathom.Scene.read(sys.argv[1])
except fathom.InputError as error:
    print(error, file=sys.stderr, flush=True)
    os._exit(3)
os._exit(0)
"""


def command(interface, path):
    program = os.environ["FATHOM_PROGRAM"]
    return {"program": [program, "info", path],
            "stream": [program, "render", path, "--stream", "--quiet", "--size", "40x30", "-o", path.with_suffix(".exr")],
            "python": [sys.executable, "-c", in_python, path],
            "c": [sys.executable, "-c", in_c, path]}[interface]


def stl():
    """Points, and a triangle at the end."""
    count = (70 << 20) // 50
    data = bytearray(84 + 50 * count)
    data[80:84] = struct.pack("<I", count)
    data[-50:-2] = struct.pack("<12f", *range(12))
    return bytes(data)


def obj():
    return b"v 0 0 4\nv 1 0 4\n#" + b" " * (66 << 20) + b"\nv 0 1 4\nf 1 2 3\n"


def has_open(process, path):
    """Whether the process has the file open, or mapped."""
    folder = pathlib.Path(f"/proc/{process.pid}")
    try:
        files = [os.readlink(file) for file in (folder / "fd").iterdir()]
        return str(path) in files or str(path) in (folder / "maps").read_text()
    except OSError:
        return False


def cut_once_open(process, path, size):
    while process.poll() is None:
        process.send_signal(signal.SIGSTOP)
        is_open = has_open(process, path)
        if is_open:
            os.truncate(path, size)
        process.send_signal(signal.SIGCONT)
        if is_open:
            return
        time.sleep(0.0005)


def run_cutting(interface, path, cut):
    process = subprocess.Popen(command(interface, path), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    cut(process)
    said = process.communicate(timeout=120)[1].strip()
    assert process.returncode in (0, 3), f"{process.returncode}: {said}"
    if process.returncode == 3:
        assert len(said.splitlines()) == 1 and path.name in said, said


@pytest.mark.parametrize("interface, content", [("program", obj), ("program", stl), ("stream", stl), ("python", obj),
                                                ("python", stl), ("c", obj), ("c", stl)])
def test_a_file_that_is_cut_as_soon_as_it_is_open(interface, content, tmp_path):
    path = tmp_path / f"cut.{content.__name__}"
    path.write_bytes(content())
    run_cutting(interface, path, lambda process: cut_once_open(process, path, 4096))


@pytest.mark.parametrize("interface", ["program", "stream", "python", "c"])
def test_a_file_that_is_cut_at_any_time(interface, tmp_path):
    draw = random.Random(1)
    path = tmp_path / "cut.stl"
    content = stl()
    for _ in range(int(os.environ.get("FATHOM_CUTS", "3"))):
        path.write_bytes(content)

        def cut(process):
            time.sleep(draw.uniform(0, 0.4))
            os.truncate(path, draw.choice((0, 84, 84 + 50 * 1000, len(content) - 1)))

        run_cutting(interface, path, cut)
