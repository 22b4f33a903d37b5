"""docs/reference/channels.md: every channel that the program writes is in the table, with its type and its background."""

import json
import os
import pathlib
import re

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
types = {"FLOAT": np.float32, "UINT": np.uint32}


def rows_of_the_page():
    """Channel: (type, background), both as the page has them."""
    text = (source / "docs/reference/channels.md").read_text(encoding="utf-8")
    rows = [row.split(" | ") for row in re.findall(r"^\| (`.*) \|$", text, re.M)]
    return {name: (row[2], row[4]) for row in rows for name in re.findall(r"`([^`]+)`", row[0])}


@pytest.fixture(scope="module")
def written(tmp_path_factory, run_program):
    """One map with all channels of one format of depths, by the arguments that ask for them."""

    folder = tmp_path_factory.mktemp("maps")

    def render(name, *arguments):
        file = folder / name
        run_program("render", source / "data/meshes/cube.obj", "--size", "64x48", "--near", "0.1", "--far", "100", "-o", file,
                    *arguments)
        return fathom.read_map(file)

    run_program("render", source / "data/meshes/cube.obj", "--size", "64x48", "-o", folder / "z.exr")
    run_program("convert", folder / "z.exr", "--to", "disparity", "--baseline", "0.1", "-o", folder / "disparity.exr")
    scene = folder / "stencil.json"
    scene.write_text(json.dumps({"meshes": [{"file": str(source / "data/meshes/cube.obj"),
                                             "draw": {"stencil": {"reference": 1, "pass": "replace"}}}]}))
    run_program("render", scene, "--engine", "pipeline", "--size", "64x48", "--near", "0.1", "--far", "100", "--depth-format", "unorm24",
                "-o", folder / "stencil.exr")
    every = ",".join(fathom.maps.rendered)
    return {
        "unorm24": render("24.exr", "--channels", every, "--samples", "4", "--depth-format", "unorm24", "--against-exact"),
        "float32": render("32.exr", "--channels", "Z", "--depth-format", "float32", "--mapping", "reversed"),
        "float64": render("64.exr", "--channels", "Z", "--depth-format", "float64"),
        "stencil": fathom.read_map(folder / "stencil.exr"),
        "disparity": fathom.read_map(folder / "disparity.exr"),
    }


def planes(maps):
    for name, array in maps.items():
        parts = fathom.maps.parts_of.get(name)
        yield from ([(name, array)] if parts is None else [(f"{name}.{part}", array[..., k]) for k, part in enumerate(parts)])


def test_the_table_has_every_channel_with_its_type_and_background(written):
    rows, found = rows_of_the_page(), set()
    for maps in written.values():
        for name, plane in planes(maps):
            kind, background = rows[name]
            found.add(name)
            if not name.startswith("Zwindow"):
                assert plane.dtype == types[kind], name
                assert np.array_equal(plane[0, 0], plane.dtype.type(float(background)), equal_nan=True), name
    assert found == set(rows)


def test_stored_depths_are_cleared_as_the_table_says(written):
    assert written["unorm24"]["Zwindow"].dtype == np.uint32 and written["unorm24"]["Zwindow"][0, 0] == 2**24 - 1
    assert written["float32"]["Zwindow"].dtype == np.float32 and written["float32"]["Zwindow"][0, 0] == 0
    one = int(np.array([1.0]).view(np.uint64)[0])
    assert written["float64"]["Zwindow.high"][0, 0] == one >> 32 and written["float64"]["Zwindow.low"][0, 0] == 0
