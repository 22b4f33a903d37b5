"""Projecting, unprojecting, rays and other resolutions of cameras, against fractions: each number is rounded once."""

import math
import re
from fractions import Fraction

import numpy as np
import pytest

import fathom

turned = [[0.36, 0.48, -0.8, 0.1], [-0.8, 0.6, 0.0, -0.3], [0.48, 0.64, 0.6, 2.7]]
cameras = {
    "plain": fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5),
    "opencv": fathom.Camera(64, 48, 41.3, 39.7, 31.4, 23.6, pixel_centre=0, skew=0.7, world_to_camera=turned),
    "mirrored": fathom.Camera(5, 3, -2.3, 1.9, 2.5, 1.5, pixel_centre=0.5, world_to_camera=turned),
    "tiny": fathom.Camera(5, 3, 1e-120, 1e-120, 2.5, 1.5, pixel_centre=0.5, world_to_camera=turned),
    "map": fathom.Camera(64, 48, 8.1, 7.7, 32, 24, pixel_centre=0.5, projection="orthographic", skew=-0.3,
                         world_to_camera=turned),
}


@pytest.fixture(params=cameras, name="camera")
def each_camera(request):
    return cameras[request.param]


def exactly(array):
    return [[Fraction(float(each)) for each in row] for row in np.asarray(array)]


def nearest(fraction):
    """Python divides integers with one rounding."""
    return fraction.numerator / fraction.denominator


def point_of(camera, u, v, depth):
    """The exact point, by Cramer's rule; docs/specification.md, section 2."""
    fx, fy, cx, cy, skew, u, v, d = (Fraction(each) for each in
                                     (camera.fx, camera.fy, camera.cx, camera.cy, camera.skew, u, v, depth))
    w = d if camera.projection == "perspective" else 1
    y = (v - cy) * w / fy
    x = ((u - cx) * w - skew * y) / fx
    pose = exactly(camera.world_to_camera)
    right = [p - row[3] for p, row in zip((x, y, d), pose)]

    def det(m):
        return sum(m[0][i] * (m[1][i - 2] * m[2][i - 1] - m[1][i - 1] * m[2][i - 2]) for i in range(3))

    R = [row[:3] for row in pose[:3]]
    return [det([[right[i] if k == column else R[i][k] for k in range(3)] for i in range(3)]) / det(R) for column in range(3)]


def test_projected_points_are_exact_numbers_rounded_once(camera):
    points = np.random.default_rng(1).normal(size=(200, 3))
    pixels, depths = camera.project(points)
    assert pixels.shape == (200, 2) and depths.shape == (200,)
    for X, (u, v), depth in zip(exactly(points), pixels, depths):
        x, y, z = (sum(a * b for a, b in zip(row, [*X, 1])) for row in exactly(camera.world_to_camera)[:3])
        assert depth == nearest(z)
        if camera.projection == "perspective" and z <= 0:
            assert math.isnan(u) and math.isnan(v)
            continue
        w = z if camera.projection == "perspective" else 1
        assert u == nearest((Fraction(camera.fx) * x + Fraction(camera.skew) * y) / w + Fraction(camera.cx))
        assert v == nearest(Fraction(camera.fy) * y / w + Fraction(camera.cy))


def test_unprojected_points_are_exact_numbers_rounded_once(camera):
    random = np.random.default_rng(2)
    pixels, depths = random.uniform(-9, 70, (200, 2)), random.uniform(0.1, 9, 200)
    points = camera.unproject(pixels, depths)
    for (u, v), depth, point in zip(pixels, depths, points):
        assert point.tolist() == [nearest(each) for each in point_of(camera, u, v, depth)]
    inside = camera.unproject(pixels, depths, frame="camera")
    unposed = fathom.Camera(camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, skew=camera.skew,
                            pixel_centre=camera.pixel_centre, projection=camera.projection)
    assert np.array_equal(inside, unposed.unproject(pixels, depths)) and np.array_equal(inside[:, 2], depths)


def test_rays_are_exact_numbers_rounded_once(camera):
    origins, directions = camera.rays()
    assert origins.shape == directions.shape == (camera.height, camera.width, 3)
    for row in range(0, camera.height, 2):
        for column in range(camera.width):
            u, v = column + Fraction(camera.pixel_centre), row + Fraction(camera.pixel_centre)
            at_0, at_1 = point_of(camera, u, v, 0), point_of(camera, u, v, 1)
            assert origins[row, column].tolist() == [nearest(each) for each in at_0]
            assert directions[row, column].tolist() == [nearest(b - a) for a, b in zip(at_0, at_1)]


def test_rays_in_the_cameras_frame():
    origins, directions = cameras["opencv"].rays(frame="camera")
    assert not origins.any() and (directions[..., 2] == 1).all()
    origins, directions = cameras["map"].rays(frame="camera")
    assert not origins[..., 2].any() and (directions == [0, 0, 1]).all()


def test_eye_and_forward():
    camera = fathom.Camera.look_at((1, 2, 3), (1, 2, 8))
    assert camera.eye.tolist() == [1, 2, 3] and camera.forward.tolist() == [0, 0, 1]
    turned_camera = cameras["opencv"]
    assert np.array_equal(turned_camera.eye, turned_camera.camera_to_world[:3, 3])
    assert turned_camera.unproject((31.4, 23.6), 1).tolist() == [nearest(a) for a in point_of(turned_camera, 31.4, 23.6, 1)]


def test_rays_meet_the_surface_that_is_rendered(spot):
    camera = fathom.Camera.frame(spot, size=(64, 48))
    maps = spot.render(camera, channels=("Z", "P"), dtype="float64")
    origins, directions = camera.rays()
    surface = maps.mask()
    points = origins + maps.Z[..., None] * directions
    assert np.abs(points - maps.P)[surface].max() < 1e-6
    rows, columns = np.mgrid[:48, :64]
    pixels, depths = camera.project(maps.P[surface])
    assert np.abs(pixels - np.stack([columns, rows], -1)[surface] - camera.pixel_centre).max() < 1e-4
    assert np.abs(depths - maps.Z[surface]).max() < 1e-6
    again = camera.unproject(np.stack([columns, rows], -1) + camera.pixel_centre, maps.Z)
    assert np.array_equal(np.isnan(again[..., 0]), ~surface)
    assert np.abs(again - maps.P)[surface].max() < 1e-6


@pytest.mark.parametrize("pixel_centre", [0, 0.5, 0.25])
def test_a_scaled_camera_shows_the_same_view(pixel_centre):
    camera = fathom.Camera(64, 48, 41, 39, 31.4, 23.6, pixel_centre=pixel_centre, skew=0.7, world_to_camera=turned, near=1,
                           far=9, name="left")
    small = camera.scaled(0.5)
    assert small.size == (32, 24) and (small.near, small.far, small.name) == (1, 9, "left")
    # The corner between four pixels of the large image is the centre of one of the small image.
    for column, row in ((0, 0), (13, 7), (31, 23)):
        large = camera.unproject((2 * column + 0.5 + pixel_centre, 2 * row + 0.5 + pixel_centre), 3)
        assert np.allclose(small.unproject((column + pixel_centre, row + pixel_centre), 3), large, rtol=0, atol=1e-14)
    assert small.scaled(2) == camera and camera.scaled(1) == camera and camera.scaled(size=(32, 24)) == small


def test_a_camera_is_scaled_by_exact_numbers_rounded_once():
    camera = fathom.Camera(1025, 767, 41.3, 39.7, 31.4, 23.6, pixel_centre=0, skew=0.7)
    small = camera.scaled(0.3)
    assert small.size == (308, 230)  # 307.5, to even, and 230.1
    across, down, half = Fraction(308, 1025), Fraction(230, 767), Fraction(1, 2)
    assert small.fx == nearest(Fraction(camera.fx) * across) and small.skew == nearest(Fraction(camera.skew) * across)
    assert small.fy == nearest(Fraction(camera.fy) * down)
    assert small.cx == nearest((Fraction(camera.cx) + half) * across - half)
    assert small.cy == nearest((Fraction(camera.cy) + half) * down - half)
    assert fathom.Camera(2, 900, 1, 1, 1, 1, pixel_centre=0.5).scaled(0.1).size == (1, 90)


def test_shapes_are_kept():
    camera = cameras["opencv"]
    points = np.ones((2, 3, 3))
    pixels, depths = camera.project(points)
    assert pixels.shape == (2, 3, 2) and depths.shape == (2, 3)
    assert camera.unproject(pixels, depths).shape == (2, 3, 3) and camera.unproject(pixels, 2).shape == (2, 3, 3)
    assert camera.project(np.empty((0, 3)))[0].shape == (0, 2) and camera.unproject((1, 2), 3).shape == (3,)


@pytest.mark.parametrize("call, error, text", [
    (lambda camera: camera.project((1, 2)), ValueError, "points: expected shape …×3, found 2"),
    (lambda camera: camera.project(1), ValueError, "points: expected shape …×3, found a single number"),
    (lambda camera: camera.project((1, 2, math.nan)), ValueError, "points: nan at [2] is not a finite number"),
    (lambda camera: camera.unproject((1, 2, 3), 1), ValueError, "pixels: expected shape …×2, found 3"),
    (lambda camera: camera.unproject([(1, 2)], (1, 2)), ValueError, "depths: expected shape 1 or a number, found 2"),
    (lambda camera: camera.unproject((1, 2), 1, frame="eye"), ValueError, "frame: expected 'world', 'camera', found 'eye'"),
    (lambda camera: camera.rays(frame="eye"), ValueError, "frame: expected 'world', 'camera', found 'eye'"),
    (lambda camera: camera.scaled(), TypeError, "scaled: expected either a factor or a size"),
    (lambda camera: camera.scaled(0.5, size=(1, 1)), TypeError, "scaled: expected either a factor or a size"),
    (lambda camera: camera.scaled(-1), ValueError, "factor: expected a positive number, found -1.0"),
    (lambda camera: camera.scaled("half"), TypeError, "factor: expected a number, found 'half'"),
    (lambda camera: camera.scaled(size=(0, 1)), ValueError, "size: width: expected 1 to 4294967295, found 0"),
    (lambda camera: camera.scaled(1e300), ValueError, "factor: the image would have more than 4294967295 pixels a side"),
])
def test_bad_arguments_are_named(call, error, text):
    with pytest.raises(error, match=re.escape(text)):
        call(cameras["plain"])
