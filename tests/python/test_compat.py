"""fathom.compat, by the cases of Open3D's and trimesh's own tests of rays, and where those libraries lose rays."""

import copy
import pathlib
import os
from types import SimpleNamespace

import fathom
import numpy as np
import pytest
from fathom.compat import RaycastingScene, RayMeshIntersector

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
triangle = [(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)]
corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32)
quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
sides = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.uint32)
two_rays = np.array([[0.2, 0.1, 1, 0, 0, -1], [10, 10, 10, 1, 0, 0]], np.float32)
three_rays = np.array([[0.5, 0.5, -1, 0, 0, 1], [0.5, 0.5, 0.5, 0, 0, 1], [10, 10, 10, 1, 0, 0]], np.float32)


class OfOpen3D:
    """An array as Open3D has it: np.asarray() makes an object of it."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def cpu(self):
        return self

    def numpy(self):
        return self.array

    def __len__(self):
        return len(self.array)


def scene_of(*mesh):
    scene = RaycastingScene()
    assert scene.add_triangles(*mesh) == 0
    return scene


def box():
    return scene_of(corners, sides)


def sphere(radius, resolution=20):
    """Open3D's create_sphere: poles along z, circles of 2·resolution points."""
    step = np.pi / resolution
    rings = [(radius * np.sin(step * i) * np.cos(step * j), radius * np.sin(step * i) * np.sin(step * j), radius * np.cos(step * i))
             for i in range(1, resolution) for j in range(2 * resolution)]
    vertices = np.array([(0, 0, radius), (0, 0, -radius), *rings])
    around = 2 * resolution

    def at(i, j):
        return 2 + (i - 1) * around + j % around

    faces = [(0, at(1, j), at(1, j + 1)) for j in range(around)]
    faces += [(1, at(resolution - 1, j + 1), at(resolution - 1, j)) for j in range(around)]
    for i in range(1, resolution - 1):
        for j in range(around):
            faces += [(at(i + 1, j), at(i, j + 1), at(i, j)), (at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))]
    return vertices, np.array(faces)


def test_cast_rays():
    hits = scene_of(*triangle).cast_rays(two_rays)
    assert list(hits) == ["t_hit", "geometry_ids", "primitive_ids", "primitive_uvs", "primitive_normals"] and len(hits) == 5
    assert hits["geometry_ids"].tolist() == [0, RaycastingScene.INVALID_ID] and hits["t_hit"].tolist() == [1, np.inf]
    assert hits["primitive_ids"].tolist() == [0, RaycastingScene.INVALID_ID]
    assert hits["primitive_uvs"].tolist() == [[np.float32(0.2) - np.float32(0.1), np.float32(0.1)], [0, 0]]
    assert hits["primitive_normals"].tolist() == [[0, 0, 1], [0, 0, 0]] and not np.signbit(hits["primitive_normals"]).any()
    types = {name: array.dtype.name for name, array in hits.items()}
    assert types == {"t_hit": "float32", "geometry_ids": "uint32", "primitive_ids": "uint32", "primitive_uvs": "float32",
                     "primitive_normals": "float32"}
    assert hits["t_hit"][0].cpu().numpy() == 1 and hits["t_hit"][1].item() == np.inf
    assert "t_hit" in hits and "points" not in hits and hits.get("points") is None


def test_normals_follow_the_order_of_corners_and_not_the_ray():
    rays = np.array([[0.2, 0.1, 1, 0, 0, -1], [0.2, 0.1, -1, 0, 0, 1]])
    assert scene_of(*triangle).cast_rays(rays)["primitive_normals"].tolist() == [[0, 0, 1], [0, 0, 1]]
    turned = scene_of(triangle[0], [(0, 2, 1)])
    assert turned.cast_rays(rays)["primitive_normals"].tolist() == [[0, 0, -1], [0, 0, -1]]


def test_test_occlusions():
    scene = scene_of(*triangle)
    assert scene.test_occlusions(two_rays).tolist() == [True, False] and scene.test_occlusions(two_rays).dtype == bool
    assert not scene.test_occlusions(two_rays, tfar=0.5).any() and not scene.test_occlusions(two_rays, tnear=1.5).any()
    assert not scene.test_occlusions(two_rays, 2, 1).any() and scene.test_occlusions(two_rays, 1, 1).any()


@pytest.mark.parametrize("mesh", [(corners, sides), (OfOpen3D(corners), OfOpen3D(sides)), (SimpleNamespace(vertices=corners, faces=sides),),
                                  (SimpleNamespace(vertex={"positions": OfOpen3D(corners)}, triangle={"indices": OfOpen3D(sides)}),)])
def test_count_intersections(mesh):
    scene = scene_of(*mesh)
    assert scene.count_intersections(three_rays).tolist() == [2, 1, 0]
    assert scene.count_intersections(OfOpen3D(three_rays)).dtype == np.int32
    assert scene.count_intersections(rays=three_rays, nthreads=1).numpy().tolist() == [2, 1, 0]


def test_list_intersections():
    hits = box().list_intersections(three_rays)
    assert set(hits) == {"ray_splits", "ray_ids", "t_hit", "geometry_ids", "primitive_ids", "primitive_uvs"}
    assert hits["t_hit"].tolist() == [1, 2, 0.5]
    assert hits["ray_splits"].tolist() == [0, 2, 3, 3] and hits["ray_ids"].tolist() == [0, 0, 1]
    assert {name: hits[name].dtype.name for name in ("ray_splits", "ray_ids", "primitive_ids")} == {
        "ray_splits": "uint32", "ray_ids": "uint32", "primitive_ids": "uint32"}
    weights = np.concatenate([1 - hits["primitive_uvs"].sum(axis=1, keepdims=True), hits["primitive_uvs"]], axis=1)
    places = (corners[sides[hits["primitive_ids"]]] * weights[:, :, None]).sum(axis=1)
    by_rays = three_rays[hits["ray_ids"], :3] + three_rays[hits["ray_ids"], 3:] * hits["t_hit"][:, None]
    assert (places == by_rays).all()


def test_compute_occupancy():
    points = np.array([[0.5, 0.5, 0.5], [-0.5, -0.5, -0.5]], np.float32)
    found = box().compute_occupancy(points)
    assert found.tolist() == [1, 0] and found.dtype == np.float32
    assert scene_of(corners, sides[:, ::-1]).compute_occupancy(points).tolist() == [1, 0]
    nested = box()
    assert nested.add_triangles(corners * 3 - 1, sides) == 1
    assert nested.compute_occupancy(np.array([[0.5, 0.5, 0.5], [-0.5, 0.5, 0.5]])).tolist() == [0, 1]


def test_sphere_whose_vertices_and_edges_rays_hit():
    """Open3D's case test_sphere_wrong_occupancy, for which it moves its rays at random since 0.17."""
    vertices, faces = sphere(0.8)
    axis = np.linspace(vertices.min(axis=0) * 1.1, vertices.max(axis=0) * 1.1, num=6)
    points = np.stack(np.meshgrid(*axis.T), axis=-1).astype(np.float32)
    ring = [[0, 0, 0, 0, 0, 0], [0, 0, 1, 1, 0, 0], [0, 1, 1, 1, 1, 0], [0, 1, 1, 1, 1, 0], [0, 0, 1, 1, 0, 0], [0] * 6]
    middle = [[0] * 6, *[[0, 1, 1, 1, 1, 0]] * 4, [0] * 6]
    expected = [[[0] * 6] * 6, ring, middle, middle, ring, [[0] * 6] * 6]
    scene = scene_of(vertices.astype(np.float32), faces)
    assert scene.compute_occupancy(points).tolist() == expected
    assert scene.compute_occupancy(points, nsamples=3).tolist() == expected


def test_rays_at_corners_of_a_sphere_meet_it_twice():
    vertices, faces = sphere(0.8)
    vertices = vertices.astype(np.float32)
    scene = scene_of(vertices, faces)
    inside = np.concatenate([np.zeros_like(vertices), vertices], axis=1)
    assert (scene.count_intersections(inside) == 1).all()
    assert (scene.cast_rays(inside)["t_hit"] == 1).all()


@pytest.mark.parametrize("shape", [(11,), (1, 2, 3), (32, 14), (0,), (0, 3)])
def test_output_shapes(shape):
    random = np.random.RandomState(123)
    scene = scene_of(*triangle)
    rays, points = random.uniform(size=(*shape, 6)).astype(np.float32), random.uniform(size=(*shape, 3)).astype(np.float32)
    assert scene.count_intersections(rays).shape == shape and scene.compute_occupancy(points).shape == shape
    assert scene.test_occlusions(rays).shape == shape
    last = {"primitive_uvs": (2,), "primitive_normals": (3,)}
    for name, array in scene.cast_rays(rays).items():
        assert array.shape == shape + last.get(name, ()), name
    count = int(scene.count_intersections(rays).sum())
    for name, array in scene.list_intersections(rays).items():
        assert array.shape == ((int(np.prod(shape)) + 1,) if name == "ray_splits" else (count, *last.get(name, ()))), name


def test_many_rays():
    random = np.random.RandomState(123)
    rays = random.rand(300_000, 6).astype(np.float32)
    scene = box()
    counts = scene.count_intersections(rays)
    assert (counts == 1).all()  # each begins inside
    hits = scene.cast_rays(rays)
    assert (hits["geometry_ids"] == 0).all() and (scene.list_intersections(rays)["t_hit"] == hits["t_hit"]).all()


def test_t_is_rounded_once():
    """t = 1 + 2^-24 + 2^-60: as float64 it is half-way between two float32 numbers, and then would be 1."""
    scene = scene_of([(-8, -8, 1), (8, -8, 1), (0, 8, 1)], [(0, 1, 2)])
    rays = np.array([[0, 0, -(2.0**-24 + 2.0**-60), 0, 0, 1], [0, 0, -(2.0**-24), 0, 0, 1], [0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0, 1]])
    assert scene.cast_rays(rays)["t_hit"].tolist() == [1 + 2.0**-23, 1, 0, np.inf]
    near = scene_of([(-8, -8, 2.0**-150), (8, -8, 2.0**-150), (0, 8, 2.0**-150)], [(0, 1, 2)])
    subnormal = np.array([[0, 0, -(2.0**-210), 0, 0, 1], [0, 0, 0, 0, 0, 1]])
    assert near.cast_rays(subnormal)["t_hit"].tolist() == [2.0**-149, 0]


def test_pinholes_by_matrices():
    """What Open3D 0.16 returns."""
    K, T = np.array([[40, 0, 32], [0, 40, 24], [0, 0, 1.0]]), np.eye(4)
    rays = RaycastingScene.create_rays_pinhole(K, T, 64, 48)
    assert rays.shape == (48, 64, 6) and rays.dtype == np.float32
    assert (rays[0, 0] == np.float32([0, 0, 0, -0.7875, -0.5875, 1])).all()
    assert (rays[47, 63] == np.float32([0, 0, 0, 0.7875, 0.5875, 1])).all()
    named = RaycastingScene.create_rays_pinhole(extrinsic_matrix=OfOpen3D(T), intrinsic_matrix=OfOpen3D(K), width_px=64, height_px=48)
    assert (named == rays).all()


def test_pinholes_by_view():
    """What Open3D 0.16 returns, whose arithmetic differs in the last bits."""
    rays = RaycastingScene.create_rays_pinhole(60, [0.5, 0.5, 0.5], [-1, -1, -1], [0, 0, 1], 8, 6)
    np.testing.assert_allclose(rays[0, 0], [-1, -1, -1, 1.0818814, 0.3674469, 0.28272244], rtol=1e-6)
    np.testing.assert_allclose(rays[5, 7], [-1, -1, -1, 0.07281905, 0.7872536, 0.87197804], rtol=1e-6)
    named = box().create_rays_pinhole(fov_deg=60, center=[0.5] * 3, eye=[-1] * 3, up=[0, 0, 1], width_px=8, height_px=6)
    assert (named == rays).all()
    assert np.isfinite(box().cast_rays(named)["t_hit"]).any()


def test_depths_of_pinholes_are_those_of_maps():
    scene = fathom.Scene.read(source / "data/meshes/spot.obj")
    camera = fathom.Camera.frame(scene, size=(64, 48))
    theirs = scene_of(scene.vertices(), scene.faces())
    rays = RaycastingScene.create_rays_pinhole(camera.K, camera.world_to_camera, 64, 48)
    depths, maps = theirs.cast_rays(rays)["t_hit"], scene.render(camera)["Z"]
    both = np.isfinite(depths) & np.isfinite(maps)
    assert both.sum() > 300 and (np.isfinite(depths) != np.isfinite(maps)).sum() < 10  # their rays are rounded
    differences = np.abs(depths[both] - maps[both])
    assert differences.max() < 1e-2 and np.median(differences) < 1e-6


def test_scenes_are_copied():
    scene = box()
    twin = copy.deepcopy(scene)
    twin.add_triangles(*triangle)
    assert twin.count_intersections([[0.75, 0.25, -1, 0, 0, 1]]).tolist() == [3]
    assert scene.count_intersections([[0.75, 0.25, -1, 0, 0, 1]]).tolist() == [2]


@pytest.mark.parametrize("call, kind, message", [
    (lambda scene: scene.cast_rays(np.zeros(6)), ValueError, "rays: expected shape …×6 of two dimensions or more, found 6"),
    (lambda scene: scene.cast_rays(np.zeros((2, 5))), ValueError, "rays: expected shape …×6 of two dimensions or more, found 2×5"),
    (lambda scene: scene.cast_rays(np.zeros((2, 6))), ValueError, r"directions: the direction at \[0\] is 0"),
    (lambda scene: scene.compute_occupancy(np.zeros((2, 3)), nsamples=2), ValueError, "nsamples: expected an odd number, found 2"),
    (lambda scene: scene.compute_distance(np.zeros((2, 3))), NotImplementedError, "compute_distance: fathom.compat casts rays only"),
    (lambda scene: scene.compute_signed_distance(np.zeros((2, 3))), NotImplementedError, "compute_occupancy"),
    (lambda scene: scene.compute_closest_points(np.zeros((2, 3))), NotImplementedError, "use Open3D for closest points"),
    (lambda scene: scene.create_rays_pinhole(np.eye(3), np.eye(4), 4), TypeError, "expected intrinsic_matrix, extrinsic_matrix"),
    (lambda scene: scene.create_rays_pinhole(60, [0, 0, 1], [0, 0, 1], [0, 1, 0], 4, 4), ValueError, "center: it leaves"),
    (lambda scene: RaycastingScene(device="CUDA:0"), ValueError, "device: rays are cast by the CPU, found CUDA:0"),
])
def test_refusals(call, kind, message):
    with pytest.raises(kind, match=message):
        call(box())


@pytest.fixture
def intersector():
    return RayMeshIntersector(SimpleNamespace(vertices=corners.astype(float), faces=sides.astype(np.int64)))


def test_intersects_id(intersector):
    origins, directions = three_rays[:, :3], three_rays[:, 3:]
    faces, rays = intersector.intersects_id(origins, directions)
    assert rays.tolist() == [0, 0, 1] and faces.dtype == rays.dtype == np.int64
    assert (corners[sides[faces]][:, :, 2].min(axis=1) == corners[sides[faces]][:, :, 2].max(axis=1)).all()
    first = intersector.intersects_id(origins, directions, multiple_hits=False)
    assert first[0].tolist() == [faces[0], faces[2]] and first[1].tolist() == [0, 1]
    most = intersector.intersects_id(origins, directions, max_hits=1)
    assert most[0].tolist() == first[0].tolist() and most[1].tolist() == [0, 1]


def test_intersects_location(intersector):
    places, rays, faces = intersector.intersects_location(ray_origins=three_rays[:, :3], ray_directions=7 * three_rays[:, 3:])
    assert places.tolist() == [[0.5, 0.5, 0], [0.5, 0.5, 1], [0.5, 0.5, 1]] and places.dtype == np.float64
    assert rays.tolist() == [0, 0, 1] and len(faces) == 3
    found = intersector.intersects_id(three_rays[:, :3], three_rays[:, 3:], return_locations=True)
    assert [each.tolist() for each in found] == [faces.tolist(), rays.tolist(), places.tolist()]
    assert intersector.intersects_location(three_rays[:, :3], three_rays[:, 3:], multiple_hits=False)[1].tolist() == [0, 1]
    nothing = intersector.intersects_location([(9, 9, 9)], [(0, 0, 1)])
    assert nothing[0].shape == (0, 3) and nothing[1].shape == nothing[2].shape == (0,)


def test_intersects_first_and_any(intersector):
    faces = intersector.intersects_first(three_rays[:, :3], three_rays[:, 3:])
    assert (faces >= 0).tolist() == [True, True, False] and faces[2] == -1 and faces.dtype == np.int64
    assert intersector.intersects_any(three_rays[:, :3], three_rays[:, 3:]).tolist() == [True, True, False]


def test_contains_points(intersector):
    assert intersector.contains_points([(0.5, 0.5, 0.5), (1.5, 0.5, 0.5), (0.25, 0.25, 0.25)]).tolist() == [True, False, True]
    vertices, faces = sphere(0.8)
    of_sphere = RayMeshIntersector(SimpleNamespace(vertices=vertices, faces=faces))
    grid = np.random.default_rng(5).uniform(-1, 1, (500, 3))
    radii = np.linalg.norm(grid, axis=1)
    clear = (radii < 0.78) | (radii > 0.8)
    assert (of_sphere.contains_points(grid)[clear] == (radii < 0.79)[clear]).all() and clear.sum() > 400


def test_changes_of_the_mesh_are_noticed(intersector):
    ray = [(0.5, 0.5, -9)], [(0, 0, 1)]
    assert intersector.intersects_location(*ray)[0][:, 2].tolist() == [0, 1]
    intersector.mesh.vertices[:, 2] *= 2
    assert intersector.intersects_location(*ray)[0][:, 2].tolist() == [0, 2]
    intersector.mesh.faces = intersector.mesh.faces[:4]
    assert not intersector.intersects_any(*ray).any()


def test_shapes_of_rays_are_those_of_trimesh(intersector):
    with pytest.raises(ValueError, match="expected two arrays of one shape N×3, found 2×3 and 1×3"):
        intersector.intersects_any(np.zeros((2, 3)), np.ones((1, 3)))
    with pytest.raises(TypeError):
        intersector.intersects_id(np.zeros((1, 3)), np.ones((1, 3)), True)
