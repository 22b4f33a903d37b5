"""fathom.pipeline: pictures, traces and single stages, as the commands give them."""

import json
import os
import subprocess
import zlib

import numpy as np
import pytest

import fathom

source = os.environ["FATHOM_SOURCE"]
spot = os.path.join(source, "data/meshes/spot.obj")
cube = os.path.join(source, "data/meshes/cube.obj")


def fathom_command(*arguments, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], *arguments], check=True, capture_output=True, text=True,
                          env=environment, **options).stdout


def view(folder, mesh=cube, size="64x48"):
    """The scene and the camera that the command frames it with."""
    path = folder / "camera.json"
    fathom_command("render", mesh, "--size", size, "--save-camera", str(path), "-o", str(folder / "map.exr"))
    return fathom.Scene.read(mesh), fathom.read_cameras(str(path))[0], path


def pixels_of(png):
    """The colours of an 8-bit RGB PNG, by its definition."""
    data, at, header, packed = png.read_bytes(), 8, b"", b""
    while at < len(data):
        length, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + length]
        header, packed = (body, packed) if kind == b"IHDR" else (header, packed + body if kind == b"IDAT" else packed)
        at += 12 + length
    width, height = int.from_bytes(header[:4], "big"), int.from_bytes(header[4:8], "big")
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    picture = np.zeros((height, width, 3), int)
    for y in range(height):
        line = rows[y, 1:].reshape(width, 3).astype(int)
        up = picture[y - 1] if y else np.zeros((width, 3), int)
        for x in range(width):
            left, corner = (picture[y, x - 1], up[x - 1]) if x else (0, 0)
            if rows[y, 0] == 4:
                estimate = left + up[x] - corner
                distances = [abs(estimate - each) for each in (left, up[x], corner)]
                predicted = np.where((distances[0] <= distances[1]) & (distances[0] <= distances[2]), left,
                                     np.where(distances[1] <= distances[2], up[x], corner))
            else:
                predicted = [0, left, up[x], (left + up[x]) // 2][rows[y, 0]]
            picture[y, x] = (line[x] + predicted) % 256
    return picture


@pytest.mark.parametrize("options, words", [
    ({"shading": "phong", "antialias": "msaa:4", "light": (1, 1, 2), "background": (1, 1, 1)},
     ["--shading", "phong", "--antialias", "msaa:4", "--light", "1,1,2", "--background", "1,1,1"]),
    ({"shading": "flat", "blend": True, "opacity": 0.25, "draw_order": "back-to-front", "precision": "binary64"},
     ["--shading", "flat", "--blend", "--opacity", "0.25", "--draw-order", "back-to-front", "--precision", "binary64"]),
    ({"hidden_surface": "painter", "cull": "back", "viewport": (8, 6, 32, 24)},
     ["--hidden-surface", "painter", "--cull", "back", "--viewport", "8,6,32,24"]),
])
def test_pictures_are_those_of_the_command(tmp_path, options, words):
    scene, camera, path = view(tmp_path)
    rendered = fathom.pipeline.render(scene, camera, **options)
    fathom_command("render", cube, "--engine", "pipeline", "--camera", str(path), *words, "--channels", "Z,id",
                   "--image", str(tmp_path / "a.png"), "--stats", str(tmp_path / "s.json"), "-o", str(tmp_path / "a.exr"))
    assert rendered.picture.dtype == np.uint8
    assert (rendered.picture == pixels_of(tmp_path / "a.png")).all()
    by_command = fathom.read_map(str(tmp_path / "a.exr"))
    for channel in ("Z", "id"):
        assert np.array_equal(rendered.map[channel], by_command[channel])
    statistics = json.loads((tmp_path / "s.json").read_text())
    assert rendered.statistics["fragments"] == statistics["fragments"] > 0
    assert rendered.map.camera.near > 0


def test_traces_are_those_of_the_command(tmp_path):
    scene, camera, path = view(tmp_path)
    by_command = json.loads(fathom_command("pipeline", "trace", cube, "--camera", str(path), "--triangle", "3",
                                           "--pixel", "32,24", "--fragments", "--hidden-surface", "painter", "--json"))
    trace = fathom.pipeline.trace(scene, camera, 3, pixel=(32, 24), fragments=True, hidden_surface="painter", draw=True)
    assert trace == by_command
    assert trace["output_merger"] and trace["painter"]["steps"] and trace.svg.startswith("<svg")


def test_lines_of_files_are_traced_and_drawn(tmp_path):
    (tmp_path / "s.obj").write_text("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 3 1\nf 1 2 3\nl 1 4\np 2\n")
    scene, camera, path = view(tmp_path, str(tmp_path / "s.obj"), "32x24")
    assert [fathom.pipeline.trace(scene, camera, number)["primitive"] for number in range(3)] == ["triangle", "line", "point"]
    assert fathom.pipeline.render(scene, camera).statistics["lines"] == 1
    assert scene.triangle_count == 1


def test_single_stages_join(tmp_path):
    camera = {"width": 12, "height": 9, "fx": 9, "fy": 9, "cx": 6, "cy": 4.5, "near": 0.5, "far": 20, "pixel_centre": 0.5,
              "world_to_camera": [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)]}
    record = {"name": "t", "vertices": np.array([(-1, -1, 3), (-1, 1, 3), (1, 0, 2.5)]), "camera": camera}
    record = {**record, "vertices": record["vertices"].tolist()}
    stages = list(fathom.pipeline.stages())
    assert stages[0] == "primitive-assembly" and stages[-1] == "output-merger"
    for stage in stages[1:]:
        expected = json.loads(fathom_command("pipeline", "run", stage, "--precision", "binary64", input=json.dumps(record)))
        record = fathom.pipeline.run(stage, record, precision="binary64")
        assert record == expected
    assert record["name"] == "t" and len(record["fragments"]) == len(record["merged"]) > 10


def test_a_stretched_viewport_is_a_warning(tmp_path):
    scene, camera, _ = view(tmp_path)
    for call in (fathom.pipeline.render, fathom.pipeline.trace):
        with pytest.warns(fathom.ViewWarning, match="stretched"):
            call(scene, camera, viewport=(0, 0, 64, 24))


@pytest.mark.parametrize("options, error, words", [
    ({"shading": "phog"}, fathom.UsageError, "shading: 'phog'"),
    ({"shadng": "phong"}, fathom.UsageError, "shadng"),
    ({"opacity": 0.5}, fathom.UsageError, "opacity belongs to blend"),
    ({"help": True}, TypeError, "help: there is no such option"),
    ({"antialias": "area", "blend": True}, fathom.UsageError, "area"),
    ({"light": (0, 0, 0)}, fathom.UsageError, "light"),
    ({"texture": "missing.png"}, fathom.InputError, "missing.png"),
    ({"light": object()}, TypeError, "light: expected a number"),
])
def test_what_is_refused(tmp_path, options, error, words):
    scene, camera, _ = view(tmp_path)
    with pytest.raises(error, match=words) as raised:
        fathom.pipeline.render(scene, camera, **options)
    assert "--" not in str(raised.value) and "\n" not in str(raised.value)


def test_what_is_refused_of_traces_and_stages(tmp_path):
    scene, camera, _ = view(tmp_path)
    with pytest.raises(fathom.UsageError, match="primitive: there is no primitive 12"):
        fathom.pipeline.trace(scene, camera, 12)
    with pytest.raises(ValueError, match="pixel: x: expected 0 to 63"):
        fathom.pipeline.trace(scene, camera, pixel=(64, 0))
    with pytest.raises(ValueError, match="stage: expected"):
        fathom.pipeline.run("tessellation", {})
    with pytest.raises(fathom.InputError, match='"clip" is missing'):
        fathom.pipeline.run("clipping", {})
    with pytest.raises(ValueError, match="clip: 1/3 is not a number of binary64"):
        from fractions import Fraction

        fathom.pipeline.run("clipping", {"clip": [(Fraction(1, 3), 0, 0, 1)]})
