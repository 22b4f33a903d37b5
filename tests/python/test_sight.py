"""Scene.sees() and Scene.seen_by(), against brute force in fractions and by laws."""

from fractions import Fraction

import fathom
import numpy as np
import pytest
from exact_rays import cross, dot, fractions, meet, minus, sign


def point_of(corners, v, w):
    a, b, c = corners
    return [x + Fraction(float(v)) * (y - x) + Fraction(float(w)) * (z - x) for x, y, z in zip(a, b, c)]


def hides(p, q, corners):
    """Section 12 of the specification by the sides of the plane and of the edges."""
    a, b, c = corners
    n = cross(minus(b, a), minus(c, a))
    of_p, of_q = dot(n, minus(p, a)), dot(n, minus(q, a))
    if sign(of_p) * sign(of_q) >= 0:
        return False
    share = of_p / (of_p - of_q)
    at = [x + share * (y - x) for x, y in zip(p, q)]
    return all(dot(cross(minus(to, of), minus(at, of)), n) >= 0 for of, to in ((a, b), (b, c), (c, a)))


def hides_from_ray(p, q, corners):
    direction = minus(q, p)
    hit = meet(p, direction, corners) if any(direction) else None
    return hit is not None and 0 < hit[0] < 1


@pytest.fixture(scope="module")
def soup():
    random = np.random.default_rng(8)
    vertices = random.integers(-4, 5, (20, 3)).astype(float)
    vertices[:4] *= 2.0**-60
    faces = random.integers(0, 20, (14, 3))
    faces[-3:] = faces[:3]
    scene = fathom.Scene()
    scene.add_mesh(vertices, faces)
    exact = fractions(vertices)
    return scene, vertices, [[exact[i] for i in face] for face in faces]


@pytest.fixture(scope="module")
def ends(soup):
    """Coordinates, among them corners, and points of triangles."""
    _, vertices, triangles = soup
    random = np.random.default_rng(9)
    places = np.concatenate([vertices[random.integers(0, 20, 6)], random.integers(-9, 10, (6, 3)) / 2])
    numbers = random.integers(0, len(triangles), 12)
    weights = np.stack([random.integers(0, 5, 12) / 4, random.random(12) / 4], axis=1)
    on_surface = fathom.SurfacePoints(numbers, weights)
    exact = [point_of(triangles[t], v, w) for t, (v, w) in zip(numbers, weights)]
    return places, on_surface, fractions(places), exact


@pytest.mark.parametrize("edges, hidden", [("closed", hides), ("generic", hides_from_ray)])
def test_sight_is_that_of_fractions(soup, ends, edges, hidden):
    scene, _, triangles = soup
    places, on_surface, exact_places, exact_surface = ends
    some = 0
    for eyes, exact_eyes in ((places, exact_places), (on_surface, exact_surface)):
        for points, exact_points in ((places, exact_places), (on_surface, exact_surface)):
            found = scene.sees(eyes, points, False, edges)
            assert found.dtype == bool and found.shape == (len(eyes), len(points))
            expected = [[not any(hidden(p, q, t) for t in triangles) for q in exact_points] for p in exact_eyes]
            assert found.tolist() == expected
            assert scene.sees(points, eyes, False, edges).tolist() == np.transpose(expected).tolist()
            assert scene.sees(eyes, points, edges=edges).tolist() == np.diagonal(expected).tolist()
            some += found.sum()
    assert 50 < some < 500


def test_one_eye_fits_many_points(soup, ends):
    scene, *_ = soup
    places, on_surface, *_ = ends
    eye = (9, -8, 7)
    assert scene.sees(eye, on_surface).tolist() == scene.sees([eye], on_surface, pairs=False)[0].tolist()
    assert scene.sees(on_surface, eye).tolist() == scene.sees(eye, on_surface).tolist()
    grid = places.reshape(3, 4, 3)
    assert scene.sees(eye, grid).shape == (3, 4) and scene.sees(grid, grid, pairs=False).shape == (3, 4, 3, 4)
    assert scene.sees(eye, places[0]).shape == () and scene.sees(np.empty((0, 3)), eye).shape == (0,)


def is_seen(camera, corners_of_all, point, own, near, far):
    """Section 10 for a camera without skew that keeps all triangles."""
    pose = fractions(camera.world_to_camera)
    at = [sum(row[k] * point[k] for k in range(3)) + row[3] for row in pose]
    fx, fy, cx, cy = (Fraction(x) for x in (camera.K[0][0], camera.K[1][1], camera.K[0][2], camera.K[1][2]))
    if at[2] <= 0 or at[2] < near or at[2] > far:
        return False
    width, height = camera.size
    u, v = fx * at[0] / at[2] + cx, fy * at[1] / at[2] + cy
    if not (0 <= u <= width and 0 <= v <= height):
        return False
    placed = [[[sum(row[k] * p[k] for k in range(3)) + row[3] for row in pose] for p in corners] for corners in corners_of_all]
    for number, corners in enumerate(placed):
        a, b, c = corners
        n = cross(minus(b, a), minus(c, a))
        if dot(n, a) == 0:
            if number == own:
                return False
            continue
        if dot(n, at) == 0:
            continue
        s = dot(n, a) / dot(n, at)
        hit = [s * x for x in at]
        inside = all(dot(cross(minus(to, of), minus(hit, of)), n) >= 0 for of, to in ((a, b), (b, c), (c, a)))
        if inside and 0 < s < 1 and hit[2] >= near:
            return False
    return True


@pytest.mark.parametrize("near, far", [(0, float("inf")), (3, 12)])
def test_cameras_see_what_fractions_see(soup, ends, near, far):
    scene, _, triangles = soup
    places, on_surface, exact_places, exact_surface = ends
    poses = [np.eye(4), np.array([[0, 0, 1, 0], [0, 1, 0, 1], [-1, 0, 0, 9], [0, 0, 0, 1]], float)]
    poses[0][2, 3] = 8
    cameras = [fathom.Camera(64, 64, 32, 32, 32, 32, world_to_camera=pose, near=near, far=far, pixel_centre=0.5)
               for pose in poses]
    some = 0
    for points, exact, own in ((places, exact_places, [None] * 12), (on_surface, exact_surface, on_surface.triangles)):
        found = scene.seen_by(points, cameras)
        assert found.shape == (12, 2) and found.dtype == bool
        limit = Fraction(10**9) if far == float("inf") else Fraction(far)
        assert found.tolist() == [[is_seen(camera, triangles, p, t, near, limit) for camera in cameras]
                                  for p, t in zip(exact, own)]
        assert scene.seen_by(points, cameras[0]).tolist() == found[:, :1].tolist()
        some += found.sum()
    assert some > 3


def test_a_camera_sees_what_its_eye_sees(soup, ends):
    scene, *_ = soup
    _, on_surface, *_ = ends
    places = np.random.default_rng(4).integers(-9, 10, (200, 3)) / 2
    pose = np.eye(4)
    eye = (1, -2, -9)
    pose[:3, 3] = [-x for x in eye]
    camera = fathom.Camera(4096, 4096, 64, 64, 2048, 2048, world_to_camera=pose, pixel_centre=0.5)
    found = scene.seen_by(places, camera)[:, 0]
    assert found.tolist() == scene.sees(eye, places).tolist() and 20 < found.sum() < 180
    # Its own triangle may be seen edge on.
    assert not (scene.seen_by(on_surface, camera)[:, 0] & ~scene.sees(eye, on_surface)).any()


def test_surface_points_of_a_map_are_seen_by_its_camera(soup):
    scene, *_ = soup
    camera = fathom.Camera.look_at((9, 3, 20), size=(96, 72))
    maps = scene.render(camera, channels=("id", "bary"), dtype="float64")
    shown = maps["id"] != fathom.NO_SURFACE
    points = fathom.SurfacePoints(maps["id"][shown], maps["bary"][shown])
    assert len(points) > 50 and scene.seen_by(points, camera).mean() > 0.95


@pytest.mark.parametrize("call, failure, message", [
    (lambda s: s.sees((0, 0, 0), (0, 0)), ValueError, "points: expected shape N×3, found 2"),
    (lambda s: s.sees(np.zeros((2, 3)), np.zeros((3, 3))), ValueError, "points: the shape 3 does not fit 2 of eyes"),
    (lambda s: s.sees((0, 0, np.nan), (0, 0, 0)), ValueError, "eyes: "),
    (lambda s: s.sees((0, 0, 0), (0, 0, 0), edges="open"), ValueError, "edges: expected 'closed', 'generic'"),
    (lambda s: s.sees((0, 0, 0), fathom.SurfacePoints([99], [(0, 0)])), fathom.InputError, "point 0: there is no triangle 99"),
    (lambda s: s.seen_by((0, 0, 0), "camera.json"), TypeError, "cameras: expected a Camera"),
    (lambda s: s.seen_by((0, 0, 0), [], cull="left"), ValueError, "cull: expected"),
    (lambda _: fathom.SurfacePoints([0.5], [(0, 0)]), TypeError, "triangles: expected integers"),
    (lambda _: fathom.SurfacePoints([-1], [(0, 0)]), ValueError, "triangles: expected numbers from 0"),
    (lambda _: fathom.SurfacePoints([0, 1], [(0, 0)]), ValueError, "weights: expected shape 2×2, found 1×2"),
    (lambda _: fathom.SurfacePoints([0], [(0, np.inf)]), ValueError, "weights: "),
])
def test_bad_arguments_are_named(soup, call, failure, message):
    with pytest.raises(failure) as raised:
        call(soup[0])
    assert str(raised.value).startswith(message)
