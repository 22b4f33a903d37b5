"""fathom.Scene: objects, numbers, files."""

from fractions import Fraction

import numpy as np
import pytest

import fathom


def test_instances_are_placed_exactly_and_numbered_in_order(triangle, K):
    scene = fathom.Scene()
    mesh = scene.add_mesh(*triangle, name="near")
    third = np.array([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1 / 3, 3)])
    assert scene.add_instance(mesh, third, name="far") == 1
    assert scene.add_instance(mesh) == 2
    assert [each.name for each in scene.objects] == ["near", "far", "object 2"]
    assert (scene.triangle_count, scene.mesh_count) == (3, 1)
    assert scene.origin(1) == (1, 0, 0)
    camera = fathom.Camera.from_opencv(K, np.eye(4), (64, 48), pixel_centre=0.5, near=4.2)
    found = fathom.probe(scene, camera, 32, 24)
    depths = {each.object: each.depth for each in found}
    a = Fraction(1, 2) / 40
    c = Fraction(1 / 3)
    assert depths[0] == 4 / (1 - a / 2) and depths[1] == (c * 4 + 3) / (1 - c * a / 2)
    maps = scene.render(camera, channels=("object",))
    assert maps.objects == ["near", "far", "object 2"] and maps["object"][24, 32] == 1


def test_bounds(triangle):
    scene = fathom.Scene()
    assert scene.bounds is None and scene.triangle_count == 0
    scene.add_mesh(*triangle, pose=[(1, 0, 0, 1), (0, 1, 0, 2), (0, 0, 1, 3)])
    assert scene.bounds == ((-1, 0, 6), (3, 4, 8))


def test_files_are_read_into_one_scene(spot, tmp_path):
    assert spot.triangle_count == len(spot.faces()) and spot.objects[0].source.endswith("spot.obj")
    (tmp_path / "odd.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n")
    with pytest.warns(UserWarning, match="fewer than three corners"):
        scene = fathom.Scene.read(tmp_path / "odd.obj", tmp_path / "odd.obj")
    assert scene.triangle_count == 2 and len(scene.objects) == 2
    with pytest.raises(fathom.InputError, match="none.obj"):
        fathom.Scene.read(tmp_path / "none.obj")
    (tmp_path / "bad.obj").write_text("v 0 0 zero\n")
    with pytest.raises(ValueError, match="bad.obj: line 1"):
        fathom.Scene.read(tmp_path / "bad.obj")
    with pytest.raises(TypeError, match="expected a file"):
        fathom.Scene.read()


def test_views_of_a_scene_outlive_it_and_are_not_written_to(triangle):
    scene = fathom.Scene()
    scene.add_mesh(*(array.copy() for array in triangle))
    vertices = scene.vertices()
    del scene
    assert np.array_equal(vertices, triangle[0])
    with pytest.raises(ValueError, match="read-only"):
        vertices[0, 0] = 1


def test_a_scene_keeps_its_arrays(triangle, K):
    import gc
    import weakref

    vertices = triangle[0].copy()
    kept = weakref.ref(vertices)
    scene = fathom.Scene()
    scene.add_mesh(vertices, triangle[1])
    del vertices
    gc.collect()
    assert kept() is not None
    camera = fathom.Camera.from_opencv(K, np.eye(4), (64, 48), pixel_centre=0.5)
    assert np.isfinite(scene.render(camera)["Z"]).any()
    del scene
    gc.collect()
    assert kept() is None, "and lets go of them"


def test_a_scene_that_is_in_use_is_not_changed(triangle, spot):
    scene = fathom.Scene.read(spot.objects[0].source)
    shown = scene.vertices()
    before = shown.copy()
    for _ in range(1000):  # in a moment: nothing is copied
        scene.add_instance(0)
    scene.add_mesh(*triangle)
    assert np.array_equal(shown, before) and scene.mesh_count == 2 and len(scene.objects) == 1002
    del shown
    scene.add_instance(1)
    assert scene.vertices(1).base is not None and np.array_equal(scene.vertices(1), triangle[0])


def test_what_scenes_refuse(triangle):
    scene = fathom.Scene()
    with pytest.raises(ValueError, match="mesh: the scene has no mesh yet"):
        scene.add_instance(0)
    scene.add_mesh(*triangle)
    with pytest.raises(ValueError, match="mesh: expected 0 to 0, found 1"):
        scene.add_instance(1)
    with pytest.raises(ValueError, match="pose: expected the last row"):
        scene.add_instance(0, np.zeros((4, 4)))
    with pytest.raises(TypeError, match="name: expected a string"):
        scene.add_mesh(*triangle, name=5)
    with pytest.raises(ValueError, match="triangle: expected 0 to 0"):
        scene.origin(1)
