"""fathom camera shutter: the rays of a rolling shutter against rational arithmetic, laws, and refusals."""

import json
import os
import subprocess
from fractions import Fraction

import fathom
import numpy as np
import pytest
from rational_motion import placement, rotated, rounded

cube = os.path.join(os.environ["FATHOM_SOURCE"], "data/meshes/cube.obj")

# Rows are measured from 1/16 s on, for 1/8 s: the shares of the path between poses are (v + 4)/16 for 9 rows.
path = "# time tx ty tz qx qy qz qw\n-1 0 0 0 0 0 0 1\n0 0.1 -0.2 0.05 0 0 0 1\n0.25 0.3 0.1 0 -0.2 0.1 -0.7 -0.9\n"
quaternions = ((1, 0, 0, 0), (-0.9, -0.2, 0.1, -0.7))
positions = ((0.1, -0.2, 0.05), (0.3, 0.1, 0))
times = ("--readout", 0.125, "--start", 0.0625)

at_zero = {"width": 7, "height": 9, "fx": 8.1, "fy": -7.3, "cx": 3.2, "cy": 4.7, "skew": 0.3, "pixel_centre": 0,
           "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}
moved = {**at_zero, "world_to_camera": [[0.9, 0.1, -0.3, 0.4], [-0.2, 1.1, 0.05, -0.7], [0.3, 0.02, 0.8, 2.1]]}
orthographic = {**moved, "projection": "orthographic"}


def run(*arguments, check=True, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], *map(str, arguments)], capture_output=True, text=True,
                          env=environment, check=check, **options)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "camera.json").write_text(json.dumps(at_zero))
    (tmp_path / "path.txt").write_text(path)
    return tmp_path


def inverse(rows):
    """Of a matrix, by the cross products of its rows."""
    a, b, c = rows
    cross = [[p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
             for p, q in ((b, c), (c, a), (a, b))]
    determinant = sum(x * y for x, y in zip(a, cross[0]))
    return [[cross[k][i] / determinant for k in range(3)] for i in range(3)]


def pose_of_row(camera, row):
    """World to camera, rounded once."""
    R, position = placement(positions, quaternions, Fraction(row + 4, 16))
    own = [[Fraction(x) for x in line] for line in camera["world_to_camera"]]
    turned = [[sum(line[j] * R[k][j] for j in range(3)) for k in range(3)] for line in own]
    shift = [line[3] - x for line, x in zip(own, rotated(turned, position))]
    return [[rounded(x) for x in (*line, t)] for line, t in zip(turned, shift)]


def expected_rays(camera):
    """By section 2 of the specification, in rational numbers."""
    fx, fy, cx, cy, skew = (Fraction(camera[key]) for key in ("fx", "fy", "cx", "cy", "skew"))
    rays = []
    for row in range(camera["height"]):
        pose = pose_of_row(camera, row)
        back = inverse([line[:3] for line in pose])
        for column in range(camera["width"]):
            y = (row + camera["pixel_centre"] - cy) / fy
            x = (column + camera["pixel_centre"] - cx - skew * y) / fx
            is_orthographic = camera.get("projection") == "orthographic"
            origin, direction = ((x, y, 0), (0, 0, 1)) if is_orthographic else ((0, 0, 0), (x, y, 1))
            rays.append(rotated(back, [a - line[3] for a, line in zip(origin, pose)]) + rotated(back, direction))
    return np.array([[float(x) for x in ray] for ray in rays])


@pytest.mark.parametrize("camera", [at_zero, moved, orthographic], ids=["at zero", "moved", "orthographic"])
def test_rays_are_those_of_the_specification(folder, camera):
    (folder / "camera.json").write_text(json.dumps(camera))
    run("camera", "shutter", "camera.json", "--poses", "path.txt", *times, "-o", "rays.npy", cwd=folder)
    expected = expected_rays(camera)
    assert np.array_equal(np.load(folder / "rays.npy"), expected)
    for threads in (1, 2):
        rays = fathom.Rays.shutter(fathom.Camera.read(folder / "camera.json"), folder / "path.txt", 0.125, start=0.0625,
                                   threads=threads)
        assert rays.shape == (9, 7) and rays.camera is None
        assert np.array_equal(np.concatenate([rays.origins, rays.directions], axis=-1).reshape(-1, 6), expected)


division = {**{key: value for key, value in moved.items() if key != "skew"}, "model": "DIVISION", "k": -0.3,
            "pixel_centre": 0.5}
mirrored = {**division, "world_to_camera": [[-x for x in line] if k == 1 else line
                                            for k, line in enumerate(moved["world_to_camera"])]}


def scaled(direction):
    """The greatest component becomes 1 or −1."""
    size = max(map(abs, direction))
    return [x / size for x in direction]


def rays_through(camera, direction_of):
    """The rays of a camera with a lens, from the exact direction of each pixel in the camera's frame."""
    rays = []
    for row in range(camera["height"]):
        pose = pose_of_row(camera, row)
        back = inverse([line[:3] for line in pose])
        origin = rotated(back, [-line[3] for line in pose])
        rays += [origin + rotated(back, scaled(direction_of(column, row))) for column in range(camera["width"])]
    return np.array([[float(x) for x in ray] for ray in rays])


def shutter(folder, camera, poses="path.txt", when=times):
    (folder / "camera.json").write_text(json.dumps(camera))
    run("camera", "shutter", "camera.json", "--poses", poses, *when, "-o", "rays.npy", cwd=folder)
    return np.load(folder / "rays.npy")


@pytest.mark.parametrize("camera", [division, mirrored], ids=["division", "mirrored"])
def test_rays_of_a_rational_lens_are_those_of_the_specification(folder, camera):
    fx, fy, cx, cy, k = (Fraction(camera[key]) for key in ("fx", "fy", "cx", "cy", "k"))

    def direction_of(column, row):
        x, y = (column + Fraction(1, 2) - cx) / fx, (row + Fraction(1, 2) - cy) / fy
        return [x, y, 1 + k * (x * x + y * y)]

    assert np.array_equal(shutter(folder, camera), rays_through(camera, direction_of))


def test_rays_of_a_table_are_its_directions(folder):
    random = np.random.default_rng(3)
    table = random.integers(-40, 41, (9, 7, 3)) / 8 + 1 / 64
    np.save(folder / "table.npy", table)
    camera = {"model": "TABLE", "width": 7, "height": 9, "directions": "table.npy",
              "world_to_camera": moved["world_to_camera"]}
    expected = rays_through(camera, lambda column, row: [Fraction(x) for x in table[row, column]])
    assert np.array_equal(shutter(folder, camera), expected)


@pytest.mark.parametrize("lens, is_plane", [
    ({"model": "OPENCV", "k1": -0.2, "k2": 0.03, "p1": 0.001, "p2": -0.002}, True),
    ({"model": "OPENCV_FISHEYE", "k1": 0.01, "k2": 0, "k3": 0, "k4": 0}, False),
    ({"model": "FISHEYE_EQUISOLID"}, False),
])
def test_rays_of_other_lenses(folder, lens, is_plane):
    """At rest, the directions of camera.directions(); on the path, these within their rounding."""
    (folder / "rest.txt").write_text("5 0 0 0 0 0 0 1\n")
    plain = {key: value for key, value in at_zero.items() if key != "skew"} | {"pixel_centre": 0.5, **lens}
    for camera in (plain, {**plain, "world_to_camera": moved["world_to_camera"]}):
        rays = shutter(folder, camera)
        handle = fathom.Camera.read(folder / "camera.json")
        directions = handle.directions()
        if is_plane:
            assert (directions[..., 2] == 1).sum() > 20  # where |x| and |y| are at most 1, z = 1 is the greatest
            directions = directions / directions[..., 2:]
        expected = []
        for row in range(9):
            back = inverse([line[:3] for line in pose_of_row(camera, row)])
            expected += [[float(x) for x in rotated(back, [Fraction(x) for x in d])] for d in directions[row]]
        assert np.allclose(rays[:, 3:], expected, rtol=0, atol=2e-15) and not np.array_equal(rays[:, 3:], expected)
        if camera is plain:
            at_rest = shutter(folder, camera, "rest.txt", ("--readout", 0))[:, 3:].reshape(9, 7, 3)
            unscaled = handle.directions()
            same = unscaled[..., 2] == 1 if is_plane else np.full((9, 7), True)
            assert np.array_equal(at_rest[same], unscaled[same])


def test_each_row_shows_what_its_own_camera_with_a_lens_shows(tmp_path):
    """Poses and directions are binary64 numbers here, so every row has the bits of a rendered map."""
    size, seen = 33, []
    (tmp_path / "path.txt").write_text("0 -1 0.03125 -4 0 0 0 1\n1 1 0.03125 -4 0 0 0 1\n")
    scene = fathom.Scene.read(cube)
    lens = {"model": "SIMPLE_DIVISION", "params": (32, 16.25, 16.125, -0.125), "pixel_centre": 0.5}
    rays = shutter(tmp_path, {"width": size, "height": size, "world_to_camera": at_zero["world_to_camera"], **lens},
                   when=("--readout", 1))
    hits = scene.cast(rays.reshape(size, size, 6), channels=("id", "distance"), dtype=np.float32)
    for row in range(size):
        eye = (-1 + row / 16, 0.03125, -4)
        camera = fathom.Camera(size, size, **lens, world_to_camera=np.hstack([np.eye(3), [[-x] for x in eye]]))
        shown = scene.render(camera, channels=("id", "distance"))
        assert np.array_equal(hits["id"][row], shown["id"][row])
        assert np.allclose(hits["distance"][row], shown["distance"][row], rtol=2e-7)
        seen.append(tuple(hits["id"][row]))
    assert len(set(seen)) > 8


def test_a_lens_that_bends_nothing_has_the_rays_of_the_pinhole(folder):
    plain = {key: value for key, value in at_zero.items() if key != "pixel_centre"} | {"pixel_centre": 0.5}
    rays = []
    for camera in (plain, {**plain, "model": "OPENCV", "k1": 0, "k2": 0, "p1": 0, "p2": 0}):
        (folder / "camera.json").write_text(json.dumps(camera))
        run("camera", "shutter", "camera.json", "--poses", "path.txt", *times, "-o", "rays.npy", cwd=folder)
        rays.append(np.load(folder / "rays.npy"))
    assert np.array_equal(*rays)


@pytest.mark.parametrize("camera", [moved, orthographic], ids=["perspective", "orthographic"])
def test_a_global_shutter_has_the_rays_of_the_camera(folder, camera):
    (folder / "camera.json").write_text(json.dumps(camera))
    plain = fathom.Camera.read(folder / "camera.json")
    (folder / "rest.txt").write_text("5 0 0 0 0 0 0 2\n")
    rays = fathom.Rays.shutter(plain, folder / "rest.txt", 0.5)
    assert all(np.array_equal(a, b) for a, b in zip((rays.origins, rays.directions), plain.rays()))

    rays = fathom.Rays.shutter(plain, folder / "path.txt", 0, start=0.0625)
    posed = fathom.Camera(*plain.size, plain.fx, plain.fy, plain.cx, plain.cy, skew=plain.skew, pixel_centre=0,
                          projection=plain.projection, world_to_camera=[[float(x) for x in line] for line in pose_of_row(camera, 0)])
    assert all(np.array_equal(a, b) for a, b in zip((rays.origins, rays.directions), posed.rays()))


def test_each_row_shows_what_its_own_camera_shows(tmp_path):
    """Poses and rays are binary64 numbers here, so every row has the bits of a rendered map."""
    size, seen = 33, []
    (tmp_path / "path.txt").write_text("0 -1 0.03125 -4 0 0 0 1\n1 1 0.03125 -4 0 0 0 1\n")
    scene = fathom.Scene.read(cube)
    rays = fathom.Rays.shutter(fathom.Camera(size, size, 32, 32, 16.25, 16.125, pixel_centre=0.5), tmp_path / "path.txt", 1)
    hits = scene.cast(rays, channels=("t", "id", "N"), dtype=np.float32)
    for row in range(size):
        eye = (-1 + row / 16, 0.03125, -4)
        camera = fathom.Camera(size, size, 32, 32, 16.25, 16.125, pixel_centre=0.5,
                               world_to_camera=np.hstack([np.eye(3), [[-x] for x in eye]]))
        shown = scene.render(camera, channels=("Z", "id", "N"))
        for name, channel in (("t", "Z"), ("id", "id"), ("N", "N")):
            assert np.array_equal(hits[name][row], shown[channel][row], equal_nan=True), (row, name)
        seen.append(tuple(hits["id"][row]))
    assert len(set(seen)) > 8


def test_the_bottom_row_may_come_first(folder):
    camera = fathom.Camera.read(folder / "camera.json")
    down = fathom.Rays.shutter(camera, folder / "path.txt", 0.125, start=0.0625)
    up = fathom.Rays.shutter(camera, folder / "path.txt", -0.125, start=0.1875)
    assert np.array_equal(up.origins, down.origins[::-1]) and not np.array_equal(up.origins, down.origins)


def test_an_image_with_a_single_row_is_measured_at_the_start(folder):
    (folder / "camera.json").write_text(json.dumps({**at_zero, "height": 1}))
    camera = fathom.Camera.read(folder / "camera.json")
    rays = [fathom.Rays.shutter(camera, folder / "path.txt", readout, start=0.0625).origins for readout in (0, 7)]
    assert np.array_equal(*rays)
    assert fathom.Rays.shutter(camera, folder / "path.txt", 7).origins.tolist() == [[[0, 0, 0]] * 7]


def test_cast_takes_the_rays(folder):
    run("camera", "shutter", "camera.json", "--poses", "path.txt", *times, "-o", "rays.npy", cwd=folder)
    run("cast", cube, "--rays", "rays.npy", "--channels", "t,id", "-o", "hits.npz", cwd=folder)
    rays = fathom.Rays.shutter(fathom.Camera.read(folder / "camera.json"), folder / "path.txt", 0.125, start=0.0625)
    hits = fathom.Scene.read(cube).cast(rays)
    with np.load(folder / "hits.npz") as written:
        assert np.isfinite(hits["t"]).any()
        assert all(np.array_equal(written[name], hits[name].ravel()) for name in ("t", "id"))


@pytest.mark.parametrize("given, status, message", [
    (("--poses", "path.txt", "--readout", 0.5), 3,
     "path.txt: the poses end at 0.25 s, but the sensor measures at 0.3125 s"),
    (("--poses", "path.txt", "--readout", -0.1, "--start", -1), 3,
     "path.txt: the poses begin at -1 s, but the sensor measures at -1.1 s"),
    (("--poses", "path.txt", "--readout", 0.1, "-o", "rays.csv"), 2, "'rays.csv' does not end in .npy"),
    (("--poses", "missing.txt", "--readout", 0.1), 3, "missing.txt: "),
    (("--poses", "path.txt"), 2, "--readout is required"),
    (("--readout", 0.1), 2, "--poses is required"),
])
def test_refusals_are_one_line(folder, given, status, message):
    start = () if "--start" in given else ("--start", -0.1875)
    output = () if "-o" in given else ("-o", "rays.npy")
    ran = run("camera", "shutter", "camera.json", *given, *start, *output, check=False, cwd=folder)
    assert ran.returncode == status and message in ran.stderr and ran.stderr.count("\n") == 1
    assert not list(folder.glob("rays*"))


@pytest.mark.parametrize("change, status, message", [
    ({"model": "FISHEYE_ORTHOGRAPHIC", "skew": 0, "fy": 7.3, "fx": 4, "pixel_centre": 0.5}, 3,
     "camera: the pixel in column 6, row 0 sees nothing by the lens; crop the image, or undistort it"),
    ({"world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [1e308, 1e308, 1e308, 1e308]]}, 3, "camera: row 0: "),
    ({"fx": 1e-300, "world_to_camera": [[1e-9, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}, 3,
     "camera: the ray of the pixel in column 0, row 0 is beyond binary64"),
])
def test_bad_cameras_are_one_line(folder, change, status, message):
    (folder / "camera.json").write_text(json.dumps({**at_zero, **change}))
    (folder / "path.txt").write_text("0 1.5 1.5 1.5 0.3 0.2 0.1 1\n")
    ran = run("camera", "shutter", "camera.json", "--poses", "path.txt", "--readout", 0, "-o", "rays.npy", check=False,
              cwd=folder)
    assert ran.returncode == status and message in ran.stderr and ran.stderr.count("\n") == 1
    assert not (folder / "rays.npy").exists()


def test_faults_of_arguments(folder):
    camera = fathom.Camera.read(folder / "camera.json")
    with pytest.raises(TypeError, match="camera: expected a Camera"):
        fathom.Rays.shutter("camera.json", folder / "path.txt", 0.1)
    with pytest.raises(TypeError, match="poses: expected the name of a file"):
        fathom.Rays.shutter(camera, None, 0.1)
    with pytest.raises(TypeError, match="readout: expected a number"):
        fathom.Rays.shutter(camera, folder / "path.txt", "fast")
    for times in ({"readout": float("nan")}, {"readout": 0.1, "start": float("inf")}):
        with pytest.raises(ValueError, match="expected finite numbers"):
            fathom.Rays.shutter(camera, folder / "path.txt", **times)
