"""Rays of cameras meet what the cameras show, in every bit; rays that are kept and read."""

import os
import pathlib

import fathom
import numpy as np
import pytest
from fathom import _core

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
pytestmark = pytest.mark.filterwarnings("ignore::fathom.ViewWarning", "ignore::UserWarning")
channels = _core.ray_channels
size = (64, 48)


def shown(scene, camera, dtype, cull="none"):
    maps = scene.render(camera, channels=("Z", *channels[1:]), dtype=dtype, cull=cull)
    return {"t" if name == "Z" else name: array for name, array in maps.items()}


def assert_equal(scene, camera):
    rays = fathom.Rays.from_camera(camera)
    for dtype, cull in ((np.float32, "none"), (np.float64, "back"), (np.float64, "front")):
        hits = scene.cast(rays, channels=channels, dtype=dtype, cull=cull)
        for name, expected in shown(scene, camera, dtype, cull).items():
            assert hits[name].dtype == expected.dtype and hits[name].tobytes() == expected.tobytes(), (name, cull)
        seen = hits["id"] != fathom.NO_SURFACE
        assert (scene.occluded(rays, cull=cull) == seen).all()
    return seen


def mirrored(camera):
    """The camera of the mirror image: x is turned around."""
    pose = camera.world_to_camera.copy()
    pose[0] *= -1
    return fathom.Camera(*camera.size, camera.fx, camera.fy, camera.cx, camera.cy, world_to_camera=pose,
                         pixel_centre=camera.pixel_centre, projection=camera.projection, near=camera.near, far=camera.far)


meshes = sorted(path for folder in ("meshes", "scenes") for path in (source / "data" / folder).iterdir()
                if path.suffix in {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"} or path.name in {"mirrored.json", "pair.json"})


@pytest.mark.parametrize("file", meshes, ids=lambda path: path.name)
def test_every_scene_has_the_rays_of_its_cameras(file):
    scene = fathom.Scene.read(file)
    for projection in ("perspective", "orthographic"):
        camera = fathom.Camera.frame(scene, size=size, projection=projection)
        near = fathom.Camera(*size, camera.fx, camera.fy, camera.cx, camera.cy, world_to_camera=camera.world_to_camera,
                             pixel_centre=camera.pixel_centre, projection=projection,
                             near=float(np.median(scene.render(camera).points() @ camera.forward - camera.eye @ camera.forward))
                             if projection == "perspective" else 0)
        for each in (camera, mirrored(camera), near, mirrored(near)):
            assert_equal(scene, each)


@pytest.mark.parametrize("name", sorted(path.stem for path in (source / "data/scenes/hard").glob("*.obj")))
def test_hard_scenes(name):
    folder = source / "data/scenes/hard"
    scene = fathom.Scene.read(folder / f"{name}.obj")
    cameras = fathom.read_cameras(folder / f"{name}.camera.json")
    for each in (*cameras, *map(mirrored, cameras)):
        assert_equal(scene, each)


@pytest.mark.parametrize("model, numbers", [("OPENCV", [-0.25, 0.06, 0.001, -0.0005]), ("FISHEYE_STEREOGRAPHIC", []),
                                            ("SIMPLE_RADIAL", [-0.1])])
def test_lenses(model, numbers):
    scene = fathom.Scene.read(source / "data/meshes/spot.obj")
    framed = fathom.Camera.frame(scene, size=(32, 24))
    camera = fathom.Camera(32, 24, framed.fx, framed.fx, 16, 12, pixel_centre=0.5, world_to_camera=framed.world_to_camera,
                           model=model, distortion=numbers)
    assert assert_equal(scene, camera).any()


def test_rays_of_pixels_that_see_nothing_have_the_values_of_rays_that_meet_nothing():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(-8, -8, 1), (8, -8, 1), (0, 8, 1)], float), np.array([(0, 1, 2)]))
    away = fathom.Camera(4, 2, 4, 4, 2, 1, pixel_centre=0.5, world_to_camera=np.diag([1.0, -1, -1, 1]))
    nothing, missed = scene.cast(fathom.Rays.from_camera(away), channels=channels), scene.cast((0, 0, 0), (0, 0, -1), channels=channels)
    for name in channels:
        assert np.array_equal(nothing[name], np.broadcast_to(missed[name], nothing[name].shape), equal_nan=name in ("P", "bary")), name


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_all_hits_are_those_of_probe(projection):
    scene = fathom.Scene.read(source / "data/scenes/pair.json")
    framed = fathom.Camera.frame(scene, size=(24, 18), projection=projection)
    for camera, cull in ((framed, "none"), (mirrored(framed), "back"), (framed, "front")):
        rays = fathom.Rays.from_camera(camera)
        hits = scene.cast(rays, mode="all", cull=cull, channels="t,id,object,face")
        counts, nearest = scene.count(rays, cull=cull), scene.cast(rays, cull=cull)
        for pixel, (row, column) in enumerate(np.ndindex(*rays.shape)):
            expected = [each for each in fathom.probe(scene, camera, column, row, cull=cull) if each.counts]
            rows = slice(hits["splits"][pixel], hits["splits"][pixel + 1])
            assert counts[row, column] == len(expected) and (hits["ray"][rows] == pixel).all()
            assert [tuple(hits[name][rows][i] for name in ("id", "object", "face", "t")) for i in range(len(expected))] == [
                (each.id, each.object, each.face, float(each.depth)) for each in expected]
            assert (nearest["t"][row, column], nearest["id"][row, column]) == (
                (hits["t"][rows][0], hits["id"][rows][0]) if expected else (np.inf, fathom.NO_SURFACE))
        assert counts.max() > 1


def test_a_pixel_centre_on_an_edge_meets_one_of_two_triangles():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(0, 0, 1), (4, 0, 1), (4, 4, 1), (0, 4, 1)], float), np.array([(0, 1, 2), (0, 2, 3)]))
    camera = fathom.Camera(4, 4, 1, 1, 4, 4, pixel_centre=0.5, world_to_camera=np.diag([-1.0, -1, 1, 1]))
    found = scene.cast(fathom.Rays.from_camera(camera))["id"]
    assert (np.diag(found) == np.diag(scene.render(camera, channels=("id",))["id"])).all()
    moved_along_x = scene.cast(*camera.rays())["id"]  # rays that are no camera's have another rule
    assert set(np.diag(found)) == {1} and set(np.diag(moved_along_x)) == {0}


def test_rays_are_kept():
    scene = fathom.Scene()
    scene.add_mesh(np.array([(-8, -8, 1), (8, -8, 1), (0, 8, 1)], float), np.array([(0, 1, 2)]))
    directions = np.array([[(0, 0, 1), (0, 0, 2)], [(0, 0, 4), (0, 0, -1)]], float)
    for rays in (fathom.Rays((0, 0, 0), directions), fathom.Rays(np.concatenate([np.zeros((2, 2, 3)), directions], axis=-1))):
        assert rays.shape == (2, 2) and len(rays) == 4 and rays.camera is None and repr(rays) == "Rays(2×2)"
        assert rays.origins.shape == (2, 2, 3) and (rays.directions == directions).all()
        with pytest.raises(ValueError, match="read-only"):
            rays.origins[0] = 1
        assert scene.cast(rays)["t"].tolist() == [[1, 0.5], [0.25, np.inf]]
        assert scene.cast(rays, mode="all")["ray"].tolist() == [0, 1, 2]
        assert scene.count(rays, tmin=0.3).tolist() == [[1, 1], [0, 0]]
        assert scene.occluded(rays, tmax=0.6).tolist() == [[False, True], [True, False]]


def test_rays_of_a_camera_have_its_shape():
    camera = fathom.Camera(4, 2, 4, 4, 2, 1, pixel_centre=0.5)
    rays = fathom.Rays.from_camera(camera)
    assert rays.shape == (2, 4) and len(rays) == 8 and rays.camera == camera and "4×2" in repr(rays)
    for mine, expected in zip((rays.origins, rays.directions), camera.rays()):
        assert (mine == expected).all() and not mine.flags.writeable


def test_rays_are_read(tmp_path):
    table, array = tmp_path / "rays.csv", tmp_path / "rays.npy"
    table.write_text("dx,dy,dz,x,y,z\n0,0,1,0.1,2,3\n1,0,0.3,-1,0,1e-300\n")
    rows = np.array([(0.1, 2, 3, 0, 0, 1), (-1, 0, 1e-300, 1, 0, 0.3)])
    np.save(array, rows)
    for file in (table, array, str(table)):
        rays = fathom.Rays.read(file)
        assert (np.concatenate([rays.origins, rays.directions], axis=-1) == rows).all()


@pytest.mark.parametrize("text, message", [
    ("x,y,z,dx,dy\n", "line 1: expected a heading with the columns x, y, z, dx, dy and dz"),
    ("x,y,z,dx,dy,dz\n0,0,0,1,0,0\n0,0,0,0,0,0\n", "line 3: the direction is 0"),
    ("x,y,z,dx,dy,dz\n0,0,0,1,0\n", "line 2: expected 6 fields, found 5"),
    ("x,y,z,dx,dy,dz\n", "has a heading and no ray"),
    ("x,y,z,dx,dy,dz\n0,0,inf,1,0,0\n", "line 2: expected a finite number, found 'inf'"),
])
def test_faulty_files_are_refused(tmp_path, text, message):
    file = tmp_path / "rays.csv"
    file.write_text(text)
    with pytest.raises(fathom.InputError, match=message):
        fathom.Rays.read(file)


camera_rays = fathom.Rays.from_camera(fathom.Camera(4, 2, 4, 4, 2, 1, pixel_centre=0.5))
bent_rays = fathom.Rays.from_camera(fathom.Camera(4, 2, 4, 4, 2, 1, pixel_centre=0.5, model="SIMPLE_RADIAL", distortion=[0.1]))


@pytest.mark.parametrize("call, kind, message", [
    (lambda scene: scene.cast(camera_rays, (0, 0, 1)), TypeError, "directions: not with fathom.Rays"),
    (lambda scene: scene.cast(fathom.Rays((0, 0, 0), (0, 0, 1)), (0, 0, 1)), TypeError, "directions: not with fathom.Rays"),
    (lambda scene: scene.cast(camera_rays, tmax=3), ValueError, "tmin, tmax and open: not for rays of a camera: set near and far"),
    (lambda scene: scene.cast(camera_rays, open=True), ValueError, "tmin, tmax and open: not for rays of a camera"),
    (lambda scene: scene.occluded(camera_rays, tmin=1), ValueError, "tmin, tmax and open: not for rays of a camera"),
    (lambda scene: scene.cast(camera_rays, mode="all", channels="P"), ValueError, "channels: expected 't', 'id', 'object', 'face'"),
    (lambda scene: scene.cast(camera_rays, mode="all", dtype="float32"), TypeError, "all hits of a camera's rays have t in float64"),
    (lambda scene: scene.count(camera_rays, tmax=1), ValueError, "tmin, tmax and open: not for rays of a camera"),
    (lambda scene: scene.count(bent_rays), fathom.UsageError, "the lens SIMPLE_RADIAL"),
    (lambda scene: fathom.Rays.from_camera("camera"), TypeError, "camera: expected a Camera"),
    (lambda scene: fathom.Rays((0, 0, 0), (0, 0, 0)), ValueError, r"directions: the direction at \[\] is 0"),
    (lambda scene: fathom.Rays(np.zeros((2, 5))), ValueError, "origins: expected shape N×6 without directions, found 2×5"),
    (lambda scene: fathom.Rays.read("none.csv"), fathom.InputError, "none.csv"),
])
def test_refusals(call, kind, message):
    scene = fathom.Scene()
    scene.add_mesh(np.array([(-8, -8, 1), (8, -8, 1), (0, 8, 1)], float), np.array([(0, 1, 2)]))
    with pytest.raises(kind, match=message):
        call(scene)
