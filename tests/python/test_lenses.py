"""Cameras with lenses: OpenCV and formulas of COLMAP and Nerfstudio, written down again, take the points that a map
shows back to the centres of its pixels. The picture of docs/lenses.md shows lenses of the library. The program refuses bad
lenses."""

import copy
import json
import os
import pathlib
import pickle
import subprocess
import sys

import cv2
import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
sys.path.append(str(source / "docs/site"))
import lens_diagrams  # noqa: E402

pose = np.array([[0.8, 0.0, 0.6, 0.1], [0.0, 1.0, 0.0, -0.05], [-0.6, 0.0, 0.8, 3.0]])
size = (64, 48)
intrinsics = np.array([[52.0, 0, 32.5], [0, 55.0, 23.25], [0, 0, 1]])
opencv_distortions = [
    [-0.25, 0.06, 0.001, -0.0005],
    [-0.25, 0.06, 0.001, -0.0005, 0.01],
    [0.1, -0.06, 0.004, 0.003, 0.02, 0.3, -0.05, 0.01],
    [0.1, -0.06, 0.004, 0.003, 0.02, 0.3, -0.05, 0.01, 0.002, -0.001, 0.003, 0.0005],
    [0.1, -0.06, 0.004, 0.003, 0.02, 0.3, -0.05, 0.01, 0.002, -0.001, 0.003, 0.0005, 0.05, -0.08],
]


def shown_points(camera):
    """The points that a wall of two triangles shows in the camera's frame, and the pixels that show them."""
    corners = np.array([(-40, -40, 2.5), (40, -40, 3.5), (40, 40, 3.5), (-40, 40, 2.5)], np.float64)
    rotation, shift = camera.world_to_camera[:3, :3], camera.world_to_camera[:3, 3]
    world = np.linalg.solve(rotation, (corners - shift).T).T
    scene = fathom.Scene()
    scene.add_mesh(world, [(0, 1, 2), (0, 2, 3)])
    maps = scene.render(camera, channels=("P", "id", "valid"))
    shown = maps["id"] != fathom.NO_SURFACE
    assert (maps["valid"][shown] == 1).all() and shown.sum() > 100
    rows, columns = np.nonzero(shown)
    points = maps["P"][shown].astype(np.float64) @ rotation.T + shift
    return points, np.c_[columns, rows]


def check(camera, project, pixel_centre):
    """Points are rounded to binary32, which is about 10⁻⁵ pixel here."""
    points, pixels = shown_points(camera)
    np.testing.assert_allclose(project(points), pixels + pixel_centre, atol=1e-4)


@pytest.mark.parametrize("distortion", opencv_distortions)
def test_opencv_takes_the_points_of_a_map_back_to_its_pixels(distortion):
    camera = fathom.Camera.from_opencv(intrinsics, pose, size, pixel_centre=0, distortion=distortion)
    assert camera.model == "OPENCV_14" and camera.distortion == distortion + [0] * (14 - len(distortion))

    def project(points):
        return cv2.projectPoints(points, np.zeros(3), np.zeros(3), intrinsics, np.array(distortion))[0][:, 0]

    check(camera, project, 0)


def test_shorter_opencv_models_are_the_longest():
    for distortion, model in ((opencv_distortions[0], "OPENCV"), (opencv_distortions[2], "FULL_OPENCV")):
        long = fathom.Camera.from_opencv(intrinsics, pose, size, pixel_centre=0.5, distortion=distortion)
        short = fathom.Camera(*size, 52, 55, 32.5, 23.25, pixel_centre=0.5, world_to_camera=pose, model=model,
                              distortion=distortion)
        assert short.model == model and short != long
        for mine, other in zip(shown_points(short), shown_points(long)):
            np.testing.assert_array_equal(mine, other)


def radial(*k):
    """COLMAP's models with a polynomial in r², Nerfstudio's with four terms."""
    def project(points):
        x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
        squared = x * x + y * y
        factor = 1 + sum(each * squared ** (i + 1) for i, each in enumerate(k))
        return np.c_[50 * x * factor + 32, 50 * y * factor + 24]
    return project


@pytest.mark.parametrize("model, params, project", [
    ("SIMPLE_PINHOLE", [50, 32, 24], radial()),
    ("PINHOLE", [50, 50, 32, 24], radial()),
    ("SIMPLE_RADIAL", [50, 32, 24, -0.2], radial(-0.2)),
    ("RADIAL", [50, 32, 24, -0.2, 0.05], radial(-0.2, 0.05)),
    ("BROWN", [50, 50, 32, 24, -0.2, 0.05, 0.02, -0.01, 0, 0], radial(-0.2, 0.05, 0.02, -0.01)),
])
def test_points_of_other_models_go_back_to_their_pixels(model, params, project):
    camera = fathom.Camera(*size, pixel_centre=0.5, world_to_camera=pose, model=model, params=params)
    check(camera, project, 0.5)


@pytest.mark.parametrize("model, params, k", [
    ("SIMPLE_DIVISION", [50, 32, 24, -0.3], -0.3),
    ("DIVISION", [50, 50, 32, 24, 0.2], 0.2),
    ("FISHEYE_STEREOGRAPHIC", [50, 50, 32, 24], -0.25),
])
def test_the_division_model_undistorts_by_division(model, params, k):
    camera = fathom.Camera(*size, pixel_centre=0.5, world_to_camera=pose, model=model, params=params)
    points, pixels = shown_points(camera)
    distorted = (pixels + 0.5 - (32, 24)) / 50
    undistorted = distorted / (1 + k * (distorted**2).sum(axis=1, keepdims=True))
    np.testing.assert_allclose(points[:, :2] / points[:, 2:], undistorted, atol=1e-5)


def over(denominator):
    """x_d and y_d are x and y over the denominator, a function of √(x² + y²), z and √(x² + y² + z²)."""
    def project(points):
        aside, length = np.linalg.norm(points[:, :2], axis=1), np.linalg.norm(points, axis=1)
        return 50 * points[:, :2] / denominator(aside, points[:, 2], length)[:, None] + (32, 24)
    return project


@pytest.mark.parametrize("model, numbers, project", [
    ("FOV", [0.9], over(lambda aside, z, length: aside * 0.9 / np.arctan(2 * aside / z * np.tan(0.45)))),
    ("FISHEYE_ORTHOGRAPHIC", [], over(lambda aside, z, length: length)),
    ("FISHEYE_EQUISOLID", [], over(lambda aside, z, length: aside / (2 * np.sin(np.arctan2(aside, z) / 2)))),
    ("UCM", [0.6], over(lambda aside, z, length: 0.6 * length + 0.4 * z)),
    ("EUCM", [0.7, 1.5], over(lambda aside, z, length: 0.7 * np.sqrt(1.5 * aside**2 + z**2) + 0.3 * z)),
    ("DOUBLE_SPHERE", [-0.2, 0.6], over(lambda aside, z, length: 0.6 * np.hypot(aside, z - 0.2 * length)
                                        + 0.4 * (z - 0.2 * length))),
    ("OMNI", [0.9], over(lambda aside, z, length: z + 0.9 * length)),
])
def test_models_with_a_formula_show_points_where_their_publications_do(model, numbers, project):
    params = [50, 50, 32, 24, *numbers]
    check(fathom.Camera(*size, pixel_centre=0.5, world_to_camera=pose, model=model, params=params), project, 0.5)


def test_a_polynomial_is_the_angle_to_the_axis():
    p = [0, 0.9, 0.1, -0.05, 0.02, 0.01]
    camera = fathom.Camera(*size, pixel_centre=0.5, world_to_camera=pose, model="FTHETA", params=[50, 50, 32, 24, *p])
    points, pixels = shown_points(camera)
    distorted = (pixels + 0.5 - (32, 24)) / 50
    aside = np.linalg.norm(points[:, :2], axis=1)
    angle = np.polynomial.polynomial.polyval(np.linalg.norm(distorted, axis=1), p)
    np.testing.assert_allclose(np.arctan2(aside, points[:, 2]), angle, atol=1e-6)
    np.testing.assert_allclose(points[:, 0] * distorted[:, 1], points[:, 1] * distorted[:, 0], atol=1e-5)


@pytest.mark.parametrize("xi, distortion", [(0.25, []), (1.5, []), (1.1, [-0.1, 0.05, 0.002, -0.003])])
def test_opencv_takes_the_points_of_an_omnidirectional_camera_back_to_its_pixels(xi, distortion):
    camera = fathom.Camera(*size, pixel_centre=0, world_to_camera=pose, model="OMNI",
                           params=[60, 62, 32.5, 23.25, xi, *distortion])

    def project(points):
        return cv2.omnidir.projectPoints(points[:, None], np.zeros(3), np.zeros(3),
                                         np.array([[60.0, 0, 32.5], [0, 62.0, 23.25], [0, 0, 1]]), xi,
                                         np.array([distortion or [0, 0, 0, 0]], np.float64))[0].reshape(-1, 2)
    check(camera, project, 0)


@pytest.mark.parametrize("distortion", [[0, 0, 0, 0], [0.05, -0.02, 0.003, -0.001]])
def test_opencv_takes_the_points_of_a_fisheye_back_to_its_pixels(distortion):
    params = [20.0, 21.0, 32.5, 23.25, *distortion]
    camera = fathom.Camera(*size, pixel_centre=0, world_to_camera=pose, model="OPENCV_FISHEYE", params=params)

    def project(points):
        return cv2.fisheye.projectPoints(points[:, None], np.zeros(3), np.zeros(3),
                                         np.array([[20.0, 0, 32.5], [0, 21.0, 23.25], [0, 0, 1]]),
                                         np.array(distortion, float))[0][:, 0]
    check(camera, project, 0)


def test_an_equidistant_fisheye_sees_walls_before_and_behind_it():
    """Z is that of the walls, ±1; the distance is 1/│cos θ│, where θ is the pixel's distance from the middle over f."""
    f, side = 30.0, 160
    scene = fathom.Scene()
    for z in (-1.0, 1.0):
        scene.add_mesh([(-1e4, -1e4, z), (1e4, -1e4, z), (0, 2e4, z)], [(0, 1, 2)])
    camera = fathom.Camera(side, side, pixel_centre=0.5, model="SIMPLE_FISHEYE", params=[f, side / 2, side / 2])
    maps = scene.render(camera, channels=("Z", "distance", "valid"))
    v, u = np.mgrid[0:side, 0:side] + 0.5 - side / 2
    angle = np.hypot(u, v) / f
    np.testing.assert_array_equal(maps["valid"], angle < np.pi)
    front, behind = angle < 1.57, (angle > 1.572) & (angle < np.pi)
    assert front.sum() > 5000 and behind.sum() > 15000
    np.testing.assert_array_equal(maps["Z"][front], 1)
    np.testing.assert_array_equal(maps["Z"][behind], -1)
    np.testing.assert_allclose(maps["distance"][front | behind], 1 / abs(np.cos(angle[front | behind])), rtol=1e-6)


def test_panoramas_see_as_their_definition_says():
    width, height = 36, 20
    v, u = np.mgrid[0:height, 0:width] + 0.5
    around, down = 2 * np.pi * (u - 17.25) / 30, np.pi * (v - 9.5) / 18
    level = np.where(abs(v - 9.5) <= 9, np.cos(down), np.nan)
    sphere = np.stack([level * np.sin(around), np.sin(down), level * np.cos(around)], axis=-1)
    cylinder = np.stack([np.sin(around), (v - 9.5) / 18, np.cos(around)], axis=-1)
    for model, expected in (("EQUIRECTANGULAR", sphere), ("CYLINDRICAL", cylinder)):
        camera = fathom.Camera(width, height, pixel_centre=0.5, model=model, params=[30, 18, 17.25, 9.5])
        seen = camera.directions()
        has_ray = np.isfinite(expected).all(axis=-1)
        assert has_ray.mean() > 0.8
        np.testing.assert_array_equal(np.any(seen != 0, axis=-1), has_ray)
        greatest = abs(expected[has_ray]).max(axis=-1, keepdims=True)
        np.testing.assert_allclose(seen[has_ray], expected[has_ray] / greatest, rtol=0, atol=1e-14)
        assert fathom.Camera.from_json(camera.to_json()) == camera
        assert camera.scaled(0.5).fx == 15 and camera.scaled(0.5).model == model


def test_a_panorama_sees_the_box_around_it():
    camera = fathom.Camera(64, 32, pixel_centre=0.5, model="EQUIRECTANGULAR", params=[64, 32])
    assert (camera.fx, camera.fy, camera.cx, camera.cy) == (64, 32, 32, 16)
    scene = fathom.Scene()
    corners = np.array([(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (-2, 2)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    scene.add_mesh(corners, [(q[0], q[i], q[i + 1]) for q in quads for i in (1, 2)])
    maps = scene.render(camera, channels=("Z", "distance", "valid"))
    assert maps["valid"].all() and np.isfinite(maps["distance"]).all()
    rays = camera.directions()  # with a greatest component of 1: the ray meets the box at 2 of it
    np.testing.assert_allclose(maps["distance"], 2 * np.linalg.norm(rays, axis=-1), rtol=1e-6)
    np.testing.assert_allclose(maps["Z"], 2 * rays[..., 2], rtol=1e-6, atol=1e-6)


def test_lenses_are_kept():
    camera = fathom.Camera(*size, 52, 55, 32.5, 23.25, pixel_centre=0, world_to_camera=pose, model="OPENCV", skew=0.5,
                           distortion=opencv_distortions[0], max_radius=0.9, name="a.png", near=1, far=9)
    assert (camera.model, camera.distortion, camera.max_radius) == ("OPENCV", opencv_distortions[0], 0.9)
    for same in (fathom.Camera.from_json(camera.to_json()), pickle.loads(pickle.dumps(camera)), copy.deepcopy(camera)):
        assert same == camera and hash(same) == hash(camera)
    assert camera.with_size(32, 24).distortion == camera.distortion
    assert (camera.with_size(32, 24).fx, camera.with_size(32, 24).width) == (52, 32)
    assert camera.scaled(0.5).fx == 26 and camera.scaled(0.5).model == "OPENCV"
    assert "OPENCV" in repr(camera)
    keys = json.loads(camera.to_json())
    assert (keys["model"], keys["k1"], keys["max_radius"], keys["skew"]) == ("OPENCV", -0.25, 0.9, 0.5)
    # An image of other proportions has two focal lengths.
    one = fathom.Camera(*size, pixel_centre=0.5, model="SIMPLE_RADIAL", params=[50, 32, 24, -0.2])
    other = one.scaled(size=(64, 24))
    assert (other.model, other.distortion, other.fx, other.fy) == ("OPENCV", [-0.2, 0, 0, 0], 50, 25)
    skewed = fathom.Camera(*size, pixel_centre=0, model="OPENCV", params=[52, 55, 32.5, 23.25, 0, 0, 0, 0], skew=0.5)
    assert skewed.skew == 0.5
    plain = fathom.Camera(*size, 52, 55, 32.5, 23.25, pixel_centre=0)
    assert (plain.model, plain.distortion, plain.max_radius) == (None, [], np.inf)


def test_what_has_no_ray_shows_nothing():
    camera = fathom.Camera(*size, pixel_centre=0.5, model="SIMPLE_RADIAL", params=[20, 32, 24, -0.25])
    scene = fathom.Scene()
    scene.add_mesh([(-99, -99, 2), (99, -99, 2), (0, 99, 2)], [(0, 1, 2)])
    maps = scene.render(camera, channels=("Z", "valid", "id"))
    valid = maps["valid"] == 1
    assert 0 < valid.sum() < valid.size and np.isinf(maps["Z"][~valid]).all()
    # The fold is at r = 1/√(3·0.25), whose image is at r·(1 − 1/3).
    y, x = np.mgrid[0:48, 0:64] + 0.5
    radius = np.hypot(x - 32, y - 24) / 20
    assert (valid == (radius < np.sqrt(4 / 3) * 2 / 3)).all()
    assert (scene.render(fathom.Camera(*size, 20, 20, 32, 24, pixel_centre=0.5), channels="valid")["valid"] == 1).all()


@pytest.mark.parametrize("changes, error, words", [
    ({"model": "OPENVC", "distortion": [0.1]}, ValueError, "did you mean 'OPENCV'"),
    ({"model": "OPENCV", "distortion": [0.1]}, ValueError, "found 1 number, OPENCV has 4"),
    ({"model": "OPENCV", "distortion": [np.nan] * 4}, ValueError, "distortion"),
    ({"distortion": [-0.2, 0.1, 0, 0]}, ValueError, "distortion: expected a model"),
    ({"max_radius": 0.5}, ValueError, "max_radius: expected a model"),
    ({"model": "OPENCV", "near": np.nan}, ValueError, "near: expected a finite number"),
    ({"model": "OPENCV", "far": np.nan}, ValueError, "far: expected a finite number"),
    ({"model": "OPENCV", "far": -np.inf}, ValueError, "far: expected a finite number"),
    ({"model": "OPENCV", "max_radius": np.nan}, ValueError, "max_radius: expected a finite number"),
    ({"model": "OPENCV", "skew": np.inf}, ValueError, "skew: expected a finite number"),
    ({"params": [50, 32, 24, 0]}, ValueError, "params: expected a model"),
    ({"model": "SIMPLE_RADIAL", "params": [50, 32, 24, 0]}, ValueError, "params: has fx"),
    ({"model": "OPENCV", "projection": "orthographic"}, ValueError, "an orthographic camera has no lens"),
])
def test_what_a_lens_refuses(changes, error, words):
    with pytest.raises(error, match=words) as raised:
        fathom.Camera(*size, 52, 55, 32.5, 23.25, pixel_centre=0, **changes)
    assert "\n" not in str(raised.value)


def test_what_needs_straight_edges_says_so(spot):
    camera = fathom.Camera(*size, pixel_centre=0.5, model="SIMPLE_RADIAL", params=[50, 32, 24, -0.2])
    for call in (lambda: camera.project([(0, 0, 1)]), camera.rays, lambda: spot.render(camera, channels=("Z", "A")),
                 lambda: fathom.render_deep(spot, camera)):
        with pytest.raises(ValueError, match="the lens SIMPLE_RADIAL: "):
            call()


@pytest.mark.parametrize("lens", lens_diagrams.LENSES, ids=lambda lens: lens["title"])
def test_the_picture_draws_the_lenses_of_the_library(lens):
    width, height = lens_diagrams.WIDTH, lens_diagrams.HEIGHT
    camera = fathom.Camera(width, height, pixel_centre=0.5, model=lens["model"], params=lens_diagrams.params(lens))
    directions = camera.directions()
    rows, columns = np.nonzero(directions[..., 2] > 0)
    assert len(rows) > width * height / 2
    for row, column in zip(rows[::37], columns[::37]):
        x, y, z = directions[row, column]
        u, v = lens_diagrams.image_of(lens, x / z, y / z)
        assert abs(u - column - 0.5) < 1e-9 and abs(v - row - 0.5) < 1e-9
    v, u = np.mgrid[0:height, 0:width] + 0.5
    radius = lens_diagrams.fold_radius(lens) or np.inf
    has_ray = np.any(directions != 0, axis=2)
    assert (has_ray == (np.hypot(u - width / 2, v - height / 2) < radius)).all()
    assert has_ray.all() == (lens["title"] != "barrel")


@pytest.mark.parametrize("name", lens_diagrams.PICTURES)
def test_pictures_are_what_the_program_draws(name):
    assert (source / "docs/images" / name).read_text(encoding="utf-8") == lens_diagrams.PICTURES[name]()


straight = {"width": 16, "height": 12, "pixel_centre": 0.5}
focal = {"fx": 15, "fy": 15, "cx": 8, "cy": 6}
one_focal = {"f": 15, "cx": 8, "cy": 6}
table = {"width": 16, "height": 12, "model": "TABLE"}


@pytest.mark.parametrize("camera, words", [
    ({**straight, **focal, "model": "OPENVC"}, "did you mean 'OPENCV'"),
    ({**straight, **focal, "model": 7}, "model: is a number"),
    ({**straight, "model": "OPENCV", "params": [15, 15, 8, 6, 0.1]}, "params: found 5 numbers, OPENCV has 8"),
    ({**straight, "model": "OPENCV", "params": [15] * 9}, "params: found 9 numbers, OPENCV has 8"),
    ({**straight, **focal, "model": "OPENCV_14", "distortion": [0.1] * 3}, "has 4, 5, 8, 12 or 14"),
    ({**straight, **one_focal, "model": "SIMPLE_RADIAL", "k1": 0.2}, 'unknown key "k1"'),
    ({**straight, **focal, "model": "SIMPLE_RADIAL", "k": 0.2}, 'unknown key "fx"'),
    ({**straight, **focal, "model": "OPENCV", "k1": np.nan}, "not JSON"),
    ({**straight, **focal, "model": "OPENCV", "k1": np.inf}, "not JSON"),
    ({**straight, **focal, "model": "OPENCV", "k1": "a"}, "k1: is a string, expected a number"),
    ({**straight, **focal, "model": "OPENCV", "fx": 0}, "fx is 0"),
    ({**straight, "model": "SIMPLE_RADIAL", "params": [0, 8, 6, 0.1]}, "is 0"),
    ({**straight, "model": "EQUIRECTANGULAR", "params": [16, 0]}, "h is not greater than 0"),
    ({**straight, "model": "EQUIRECTANGULAR", "params": [16, 12, 8]}, "found 3 numbers, EQUIRECTANGULAR has 4"),
    ({**straight, **focal, "model": "CYLINDRICAL"}, 'unknown key "fx"'),
    ({**straight, **focal, "model": "OPENCV_14", "tauX": 1.6}, "tauX is not between -pi/2 and pi/2"),
    ({**straight, **focal, "model": "OPENCV", "max_radius": 0}, "max_radius is not greater than 0"),
    ({**straight, **focal, "model": "OPENCV", "max_radius": -1}, "max_radius is not greater than 0"),
    ({**straight, **focal, "model": "OPENCV", "projection": "orthographic"}, "an orthographic camera has no lens"),
    ({**straight, **focal, "k1": 0.1}, 'unknown key "k1"'),
    ({**straight, **focal, "model": "OPENCV", "k1": 0.1, "distortion": [0.1, 0, 0, 0]}, 'has both "distortion" and "k1"'),
    ({**table}, "directions"),
    ({**table, "directions": "missing.npy"}, "missing.npy"),
    ({**table, "directions": "other-size.npy"}, "expected the size of the image, 16x12"),
    ({**table, "directions": "infinite.npy"}, "column 4, row 3 has an infinite component"),
    ({**table, "directions": "two.npy"}, "expected directions, 3 numbers"),
    ({**table, "directions": "rays.npy", "fx": 3}, 'unknown key "fx"'),
    ({**table, "directions": "rays.npy", "directions_sha256": "00"}, "directions_sha256"),
    ({**table, "directions": "rays.npy", "origins": "rays.npy"}, "origins: not supported yet"),
])
def test_the_program_refuses_a_bad_lens_in_one_line(tmp_path, camera, words):
    rays = np.zeros((12, 16, 3)) + (0, 0, 1)
    infinite = rays.copy()
    infinite[3, 4, 0] = np.inf
    for name, directions in (("rays", rays), ("other-size", rays[:11]), ("infinite", infinite), ("two", rays[..., :2])):
        np.save(tmp_path / f"{name}.npy", directions)
    camera = {"world_to_camera": np.eye(4)[:3].tolist(), **camera}
    (tmp_path / "camera.json").write_text(json.dumps(camera))
    before = set(os.listdir(tmp_path))
    ran = subprocess.run([os.environ["FATHOM_PROGRAM"], "render", str(source / "data/meshes/cube.obj"), "--camera", "camera.json",
                          "-o", "map.npz"], cwd=tmp_path, capture_output=True, text=True)
    assert (ran.returncode, ran.stdout, ran.stderr.count("\n")) == (3, "", 1), ran.stderr
    assert words in ran.stderr
    assert set(os.listdir(tmp_path)) == before
