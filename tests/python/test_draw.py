"""fathom.draw() and fathom draw: the same files, which agree with the ids of triangles in a map, and refusals."""

import os
import re
import subprocess

import fathom
import numpy as np
import pytest

source = os.environ["FATHOM_SOURCE"]


def run(*arguments, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], "draw", *map(str, arguments)], capture_output=True, text=True,
                          env=environment, **options)


def lines_of(svg):
    """N×4: the ends of all lines."""
    lines = []
    for path in re.findall(r"M([^M\"]*)", svg):
        points = np.array(path.split(), float).reshape(-1, 2)
        lines.append(np.concatenate([points[:-1], points[1:]], axis=1))
    return np.concatenate(lines)


def pixels_of(lines, shape):
    """The pixels that lines pass through, and their neighbours."""
    marked = np.zeros(shape, bool)
    for line in lines:
        steps = np.linspace(0, 1, int(4 * np.abs(line[2:] - line[:2]).sum()) + 2)[:, None]
        u, v = np.floor(line[:2] * (1 - steps) + line[2:] * steps).astype(int).T
        marked[np.clip(v, 0, shape[0] - 1), np.clip(u, 0, shape[1] - 1)] = True
    return marked


def grown(marked):
    padded = np.pad(marked, 1)
    rows, columns = marked.shape
    return np.any([padded[i:i + rows, k:k + columns] for i in range(3) for k in range(3)], axis=0)


def edges_of(ids):
    """Pixels with a neighbour of another id."""
    edges = np.zeros(ids.shape, bool)
    for axis in (0, 1):
        first, second = (tuple(slice(*end) if k == axis else slice(None) for k in (0, 1)) for end in ((None, -1), (1, None)))
        differ = ids[first] != ids[second]
        edges[first] |= differ
        edges[second] |= differ
    return edges


@pytest.mark.parametrize("name", ["meshes/teapot.obj", "meshes/house.gltf", "scenes/pair.json"])
@pytest.mark.parametrize("orthographic", [False, True])
def test_drawings_agree_with_the_map_of_ids(name, orthographic, tmp_path):
    scene = fathom.Scene.read(os.path.join(source, "data", name))
    lens = {"projection": "orthographic"} if orthographic else {}
    camera = fathom.Camera.frame(scene, azimuth=25, elevation=35, size=(320, 240), **lens)
    fathom.draw(scene, camera, tmp_path / "all.svg", edges="all")
    drawn = pixels_of(lines_of((tmp_path / "all.svg").read_text()), (240, 320))
    ids = scene.render(camera, channels="id")["id"]
    edges = edges_of(ids)
    assert edges.any()
    assert not (drawn & ~grown(edges)).any()
    assert not (edges & ~grown(drawn)).any()
    fathom.draw(scene, camera, tmp_path / "outlines.svg", edges="silhouettes")
    outlines = pixels_of(lines_of((tmp_path / "outlines.svg").read_text()), (240, 320))
    assert not (edges_of(ids == fathom.NO_SURFACE) & ~grown(outlines)).any()
    assert outlines.sum() < drawn.sum()


@pytest.mark.parametrize("suffix", ["svg", "pdf"])
def test_the_command_writes_the_same_file(suffix, tmp_path):
    mesh = os.path.join(source, "data/meshes/cube.obj")
    scene = fathom.Scene.read(mesh)
    camera = fathom.Camera.frame(scene, azimuth=25, elevation=35, size=(64, 48))
    camera.write(tmp_path / "camera.json")
    fathom.draw(scene, camera, tmp_path / f"python.{suffix}", edges="all", stroke=0.5)
    run(mesh, "--camera", tmp_path / "camera.json", "--edges", "all", "--stroke", 0.5, "-o", tmp_path / f"command.{suffix}",
        check=True)
    assert (tmp_path / f"python.{suffix}").read_bytes() == (tmp_path / f"command.{suffix}").read_bytes()


def test_standard_output_is_svg():
    ran = run(os.path.join(source, "data/meshes/cube.obj"), "--size", "64x48", check=True)
    assert ran.stdout.startswith("<?xml") and '<g id="object-0"' in ran.stdout


@pytest.mark.parametrize("arguments, told", [
    (["-o", "drawing.png"], "-o: 'drawing.png' does not end in .svg or .pdf"),
    (["--crease-angle", "200"], "from 0 to 180 degrees"),
    (["--stroke", "0"], "above 0"),
    (["--edges", "some"], "silhouettes, creases and all"),
])
def test_the_command_refuses(arguments, told):
    ran = run(os.path.join(source, "data/meshes/cube.obj"), *arguments)
    assert ran.returncode == 2 and told in ran.stderr and ran.stderr.count("\n") == 1


def test_python_refuses(tmp_path):
    scene = fathom.Scene.read(os.path.join(source, "data/meshes/cube.obj"))
    camera = fathom.Camera.frame(scene, size=(64, 48))
    with pytest.raises(ValueError, match="path: expected a name that ends in .svg or .pdf"):
        fathom.draw(scene, camera, tmp_path / "drawing.png")
    with pytest.raises(fathom.UsageError, match="crease angle"):
        fathom.draw(scene, camera, tmp_path / "drawing.svg", crease_angle=-1)
    with pytest.raises(fathom.UsageError, match="stroke"):
        fathom.draw(scene, camera, tmp_path / "drawing.svg", stroke=0)
    with pytest.raises(fathom.OutputError):
        (tmp_path / "folder.svg").mkdir()
        fathom.draw(scene, camera, tmp_path / "folder.svg")
    bent = fathom.Camera.from_opencv(np.diag([60, 60, 1]), np.eye(4)[:3], (64, 48), pixel_centre=0, distortion=[0.1, 0, 0, 0])
    with pytest.raises(fathom.UsageError, match="lens"):
        fathom.draw(scene, bent, tmp_path / "drawing.svg")
