"""The maps of a data set, by Dask's bag; in the folder of the data set:

    python dask_bag.py

The same command, given again, makes the maps that are missing. docs/farms.md says more.
"""
import functools
import pathlib

import dask.bag
import fathom


@functools.cache
def scene():
    """Read once in each process: a scene cannot be sent to another one."""
    return fathom.Scene.read("room.ply")


def render(numbered):
    number, camera = numbered
    path = pathlib.Path(f"maps/{number:06}.exr")
    if not path.exists():
        part = path.with_name("part-" + path.name)
        scene().render(camera, channels=("Z", "A"), threads=1).write(part)
        part.rename(path)  # so that a map has its name only when it is whole


if __name__ == "__main__":  # each process imports this file
    cameras = fathom.read_cameras("cameras.json")
    dask.bag.from_sequence(enumerate(cameras)).map(render).compute()
