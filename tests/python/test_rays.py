"""Scene.cast() and its companions, against brute force in fractions."""

from fractions import Fraction

import fathom
import numpy as np
import pytest
from exact_rays import fractions, hits_of


@pytest.fixture(scope="module")
def grid():
    random = np.random.default_rng(3)
    vertices = random.integers(-4, 5, (30, 3)).astype(float)
    faces = random.integers(0, 30, (40, 3))
    scene = fathom.Scene()
    scene.add_mesh(vertices, faces)
    origins = random.integers(-6, 7, (200, 3)).astype(float)
    directions = vertices[random.integers(0, 30, 200)] - origins
    directions[(directions == 0).all(axis=1)] = (0, 1, 0)
    corners = fractions(vertices)
    return scene, origins, directions, [[corners[i] for i in face] for face in faces]


def test_hits_are_those_of_fractions(grid):
    scene, origins, directions, triangles = grid
    last = 1.5
    nearest = scene.cast(origins, directions, tmax=last, channels=("t", "id", "bary", "P"))
    lists = scene.cast(origins, directions, tmax=last, mode="all")
    counts, occluded = scene.count(origins, directions, tmax=last), scene.occluded(origins, directions, tmax=last)
    some = 0
    for i, (o, d) in enumerate(zip(fractions(origins), fractions(directions))):
        expected = hits_of(o, d, triangles, 0, Fraction(last))
        some += len(expected)
        rows = slice(lists["splits"][i], lists["splits"][i + 1])
        assert lists["id"][rows].tolist() == [hit[1] for hit in expected]
        assert lists["t"][rows].tolist() == [float(hit[0]) for hit in expected]
        assert (lists["ray"][rows] == i).all()
        assert counts[i] == len(expected) and occluded[i] == bool(expected)
        if not expected:
            assert nearest["id"][i] == fathom.NO_SURFACE and nearest["t"][i] == np.inf and np.isnan(nearest["P"][i]).all()
            continue
        t, number, u, v = expected[0]
        assert (nearest["t"][i], nearest["id"][i]) == (float(t), number)
        assert nearest["bary"][i].tolist() == [float(u), float(v)]
        assert nearest["P"][i].tolist() == [float(x + t * y) for x, y in zip(o, d)]
    assert some > 100


def test_results_have_the_shape_of_the_rays(grid):
    scene, origins, directions, _ = grid
    flat = scene.cast(origins, directions, channels="t,N,id,object,face")
    folded = scene.cast(origins.reshape(10, 20, 3), directions.reshape(10, 20, 3), channels="t,N,id,object,face")
    for name, array in flat.items():
        assert (folded[name] == array.reshape((10, 20) + array.shape[1:])).all()
    assert folded["N"].shape == (10, 20, 3)
    hit = flat["id"] != fathom.NO_SURFACE
    assert (flat["object"][hit] == 0).all() and (flat["face"] == flat["id"]).all()
    one = scene.cast(origins[0], directions[:5])
    assert one["t"].shape == (5,) and scene.count(origins[0], directions[0]).shape == ()


def test_rays_may_be_rows_of_six(grid):
    scene, origins, directions, _ = grid
    rays = np.concatenate([origins, directions], axis=1)
    expected, found = scene.cast(origins, directions), scene.cast(rays.reshape(10, 20, 6))
    assert (found["id"] == expected["id"].reshape(10, 20)).all()
    assert (found["t"] == expected["t"].reshape(10, 20)).all()
    assert (scene.count(rays) == scene.count(origins, directions)).all()
    assert (scene.occluded(rays, tmax=0.5) == scene.occluded(origins, directions, 0, 0.5)).all()


def test_the_ends_of_a_segment_may_have_no_names(grid):
    scene, origins, directions, _ = grid
    for ask in (scene.occluded, scene.count, lambda *all, **named: scene.cast(*all, **named)["id"]):
        expected = ask(origins, directions, tmin=0.25, tmax=1.5)
        assert (ask(origins, directions, 0.25, 1.5) == expected).all()
        assert (ask(origins, directions) != expected).any()


def test_float32_is_rounded_once():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(-8, -8, 1), (8, -8, 1), (0, 8, 1)], float), np.array([(0, 1, 2)]))
    # t = 1 + 2^-24 + 2^-60: as float64 it would be half-way between two float32 numbers, and then 1.
    hits = scene.cast((0, 0, -(2.0**-24 + 2.0**-60)), [(0, 0, 1)], dtype=np.float32)
    assert hits["t"].dtype == np.float32
    assert hits["t"][0] == np.float32(1 + 2.0**-23)
    assert scene.cast((0, 0, -(2.0**-24 + 2.0**-60)), (0, 0, 1))["t"] == 1 + 2.0**-24


def test_points_are_inside_a_closed_surface():
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    scene = fathom.Scene()
    scene.add_mesh(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))
    axis = np.array([-0.5, 0.0, 0.25, 0.5, 1.0, 1.5])
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    # A point of the surface belongs to the side that the point moved by (ε, ε², ε³) is on.
    within = (points >= 0) & (points < 1)
    assert (scene.contains(points) == within.all(axis=-1)).all()


def test_meshes_that_are_added_count():
    scene = fathom.Scene()
    sheet = scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)], float), np.array([(0, 1, 2)]))
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 4
    scene.add_instance(sheet, [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, -2)])
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 2
    scene.add_mesh(np.array([(0, 0, 1), (4, 0, 1), (0, 4, 1)], float), np.array([(0, 1, 2)]))
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 1


def test_a_mesh_that_is_added_while_rays_are_prepared_counts(monkeypatch):
    scene = fathom.Scene()
    sheet = scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)], float), np.array([(0, 1, 2)]))
    prepare = fathom._core.prepare_rays

    def prepare_and_add(*arguments):
        prepared = prepare(*arguments)
        monkeypatch.undo()
        scene.add_instance(sheet, [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, -2)])
        return prepared

    monkeypatch.setattr(fathom._core, "prepare_rays", prepare_and_add)
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 4
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 2


def test_rays_are_prepared_once(monkeypatch):
    scene = fathom.Scene()
    scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)], float), np.array([(0, 1, 2)]))
    scene.cast((1, 1, 0), (0, 0, 1))
    monkeypatch.delattr(fathom._core, "prepare_rays")
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 4


def test_a_vertex_without_a_triangle_may_be_anywhere():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4), (1e300, 0, 0)]), np.array([(0, 1, 2)]))
    assert scene.cast((1, 1, 0), (0, 0, 1))["t"] == 4


def test_each_triangle_of_a_crowd_counts():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)], float), np.full((1000, 3), (0, 1, 2)))
    assert scene.count((1, 1, 0), (0, 0, 1)) == 1000
    assert scene.cast((1, 1, 0), (0, 0, 1))["id"] == 0
    assert scene.cast((1, 1, 0), (0, 0, 1), mode="all")["id"].tolist() == list(range(1000))


@pytest.mark.parametrize("arguments, options, message", [
    (((0, 0, 0),), {}, "origins: expected shape N×6 without directions, found 3"),
    (((0, 0), (0, 0, 1)), {}, "origins: expected shape N×3, found 2"),
    (((0, 0, 0), [(0, 0, 1), (0, 0, 0)]), {}, r"directions: the direction at \[1\] is 0"),
    (((0, 0, 0), (0, 0, np.nan)), {}, "directions: nan at"),
    (((0, 0, 0), (0, 0, 1)), {"tmin": 2, "tmax": 1}, "tmin: expected a number that is at most tmax"),
    (((0, 0, 0), (0, 0, 1)), {"tmin": np.nan}, "tmin: expected a number that is at most tmax"),
    (((0, 0, 0), (0, 0, 1)), {"cull": "all"}, "cull: expected 'back', 'front', 'none'"),
    (((0, 0, 0), (0, 0, 1)), {"mode": "first"}, "mode: expected 'nearest', 'all'"),
    (((0, 0, 0), (0, 0, 1)), {"channels": ("Z",)}, "channels: there is no channel 'Z'; there are t, id"),
    (((0, 0, 0), (0, 0, 1)), {"channels": ("seg",)}, "did you mean 'object'?"),
    ((np.zeros((2, 3)), np.ones((3, 3))), {}, "directions: the shape 3×3 does not fit 2×3"),
])
def test_wrong_arguments_are_named(grid, arguments, options, message):
    with pytest.raises(ValueError, match=message):
        grid[0].cast(*arguments, **options)


def test_faults_of_the_scene_are_named():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(0, 0, np.nan), (4, 0, 4), (0, 4, 4)]), np.array([(0, 1, 2)]))
    with pytest.raises(ValueError, match="vertices: nan at"):
        scene.cast((0, 0, 0), (0, 0, 1))
