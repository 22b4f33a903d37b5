"""Cameras whose pixels see given directions."""

import copy
import pickle

import numpy as np
import pytest

import fathom

pose = np.array([[1.0, 0, 0, 0.1], [0, 1, 0, -0.05], [0, 0, 1, 3]])


def cube():
    scene = fathom.Scene()
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    scene.add_mesh(corners, faces)
    return scene


def pinhole():
    return fathom.Camera(16, 12, 8, 8, 8, 6, pixel_centre=0.5, world_to_camera=pose)


def test_a_table_of_a_pinhole_is_the_pinhole():
    camera = pinhole()
    directions = camera.directions()
    assert directions.shape == (12, 16, 3) and directions.dtype == np.float64
    np.testing.assert_array_equal(directions[0, 0], np.array([-7.5 / 8, -5.5 / 8, 1]))
    table = fathom.Camera.from_directions(directions, world_to_camera=pose)
    assert table.model == "TABLE" and table.size == camera.size and table.distortion == []
    for mine, other in zip(cube().render(table).values(), cube().render(camera).values()):
        np.testing.assert_array_equal(mine, other)
    np.testing.assert_array_equal(table.directions(), directions)


def test_float32_is_widened_and_pixels_without_a_ray_see_nothing():
    directions = np.zeros((2, 3, 3), np.float32) + np.array([0.1, 0, 1], np.float32)
    directions[0, 1] = 0
    directions[1, 2, 0] = np.nan
    camera = fathom.Camera.from_directions(directions, near=1, far=50)
    assert (camera.near, camera.far) == (1, 50)
    maps = cube().render(camera, channels=("distance", "valid"))
    assert maps["valid"].tolist() == [[1, 0, 1], [1, 1, 0]]
    assert np.isinf(maps["distance"][0, 1])
    again = camera.directions()
    assert again[0, 0].tolist() == [float(np.float32(0.1)), 0, 1]
    assert again[0, 1].tolist() == again[1, 2].tolist() == [0, 0, 0]


def test_lenses_have_directions_and_parallel_rays_have_none():
    lens = fathom.Camera(16, 12, 8, 8, 8, 6, pixel_centre=0.5, model="OPENCV", distortion=[-0.2, 0, 0, 0])
    directions = lens.directions()
    assert (np.abs(directions).max(axis=2) == 1)[np.any(directions != 0, axis=2)].all()
    table = fathom.Camera.from_directions(directions)
    np.testing.assert_allclose(cube().render(table)["Z"], cube().render(lens)["Z"], rtol=1e-6)
    with pytest.raises(ValueError, match="orthographic camera has one direction"):
        fathom.Camera(4, 4, 1, 1, 2, 2, pixel_centre=0.5, projection="orthographic").directions()


def test_tables_are_copied_compared_and_pickled():
    directions = pinhole().directions()
    camera = fathom.Camera.from_directions(directions, name="left")
    assert repr(camera) == "Camera(16×12, TABLE, name='left')"
    for other in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
        assert other == camera and hash(other) == hash(camera)
        np.testing.assert_array_equal(cube().render(other)["Z"], cube().render(camera)["Z"])
    directions[3, 4, 0] += 1e-9
    assert fathom.Camera.from_directions(directions, name="left") != camera


def test_camera_files_name_tables(tmp_path):
    directions = pinhole().directions()
    (tmp_path / "in").mkdir()
    np.save(tmp_path / "in" / "rays.npy", directions)
    text = '{"width": 16, "height": 12, "model": "TABLE", "directions": "rays.npy", "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}'
    (tmp_path / "in" / "camera.json").write_text(text)
    camera = fathom.Camera.read(tmp_path / "in" / "camera.json")
    np.testing.assert_array_equal(camera.directions(), directions)
    camera.write(tmp_path / "in" / "again.json")
    assert fathom.Camera.read(tmp_path / "in" / "again.json") == camera
    np.save(tmp_path / "in" / "rays.npy", -directions)
    with pytest.raises(fathom.InputError, match="directions_sha256: the file 'rays.npy' has the SHA-256"):
        fathom.Camera.read(tmp_path / "in" / "again.json")


def test_the_camera_of_a_map_is_named_only(tmp_path):
    camera = fathom.Camera.from_directions(pinhole().directions())
    depth = cube().render(camera)
    assert depth.camera == camera
    depth.write(tmp_path / "map.exr")
    read = fathom.Map.read(tmp_path / "map.exr")
    np.testing.assert_array_equal(read["Z"], depth["Z"])
    assert read.camera == camera  # the same numbers, by their hash
    with pytest.raises(fathom.InputError, match="was an array and is in no file"):
        cube().render(read.camera)
    assert pickle.loads(pickle.dumps(read.camera)) == camera


@pytest.mark.parametrize("directions, error, message", [
    (np.ones((2, 3)), ValueError, "expected shape H×W×3, found 2×3"),
    (np.ones((2, 3, 4)), ValueError, "expected shape H×W×3"),
    (np.ones((0, 3, 3)), ValueError, "expected shape H×W×3"),
    (np.full((2, 3, 3), np.inf), fathom.InputError, "column 0, row 0 has an infinite component"),
    (np.ones((2, 3, 3), complex), TypeError, "expected float64 or float32"),
])
def test_other_arrays_are_refused(directions, error, message):
    with pytest.raises(error, match=message):
        fathom.Camera.from_directions(directions)


def test_what_needs_straight_edges_refuses_tables(tmp_path):
    camera = fathom.Camera.from_directions(pinhole().directions())
    for call in (lambda: camera.project((0, 0, 1)), lambda: camera.unproject((0, 0), 1), camera.rays,
                 lambda: camera.scaled(0.5), lambda: camera.with_size(4, 4), lambda: cube().render(camera, channels=("A",))):
        with pytest.raises(ValueError, match="TABLE|table"):
            call()
    with pytest.raises(fathom.OutputError, match="a table of directions is in no file"):
        camera.write(tmp_path / "camera.json")
