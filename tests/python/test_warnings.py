"""Suspicious cameras raise the same warnings in Python as in the program; a right view raises none."""

import subprocess
import os
import warnings

import numpy as np
import pytest

import fathom


@pytest.fixture
def camera(spot):
    return fathom.Camera.frame(spot, size=(80, 60))


def changed(camera, **changes):
    arguments = dict(width=camera.width, height=camera.height, fx=camera.fx, fy=camera.fy, cx=camera.cx, cy=camera.cy,
                     pixel_centre=0.5, world_to_camera=camera.world_to_camera)
    return fathom.Camera(**{**arguments, **changes})


def test_a_right_view_gives_none(spot, camera):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        spot.render(camera)
        spot.render(fathom.Camera.orbit_scene(spot, 20, size=(40, 30)))


def flipped(camera):
    return np.diag((1, -1, -1, 1)) @ camera.world_to_camera


@pytest.mark.parametrize("view, words", [
    (lambda c: changed(c, world_to_camera=c.camera_to_world), "camera-to-world"),
    (lambda c: changed(c, world_to_camera=flipped(c)), "OpenGL"),
    (lambda c: changed(c, cx=c.cx + 35), "principal point"),
    (lambda c: changed(c, world_to_camera=np.diag((1.1, 1, 1, 1)) @ c.world_to_camera), "rotation"),
    (lambda c: changed(c, world_to_camera=np.diag((2, 2, 2, 1)) @ c.world_to_camera), "scale"),
])
def test_a_wrong_view_gives_one(spot, camera, view, words, tmp_path):
    wrong = view(camera)
    with pytest.warns(fathom.ViewWarning, match=words) as told:
        spot.render(wrong)
    assert len(told) >= 1 and told[0].filename == __file__
    wrong.write(tmp_path / "camera.json")
    program = subprocess.run(
        [os.environ["FATHOM_PROGRAM"], "render", os.path.join(os.environ["FATHOM_SOURCE"], "data/meshes/spot.obj"),
         "--camera", tmp_path / "camera.json", "-o", tmp_path / "x.exr"], check=True, capture_output=True, text=True)
    for each in told:
        assert str(each.message) in program.stderr


def test_a_warning_of_many_cameras_is_given_once(spot, camera):
    wrong = [changed(camera, cx=camera.cx + 35 + i / 10) for i in range(20)]
    with pytest.warns(fathom.ViewWarning, match="principal point") as told:
        spot.render(wrong)
    assert len(told) == 1 and "20" in str(told[0].message)


def test_an_eye_inside_a_solid():
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6),
                      (0, 6, 4), (1, 5, 7), (1, 7, 3)])
    camera = fathom.Camera(8, 8, 4, 4, 4, 4, pixel_centre=0.5)
    scene, room = fathom.Scene(), fathom.Scene()
    scene.add_mesh(corners, faces)
    room.add_mesh(corners, faces[:, ::-1])
    with pytest.warns(fathom.ViewWarning, match="inside"):
        scene.render(camera)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        room.render(camera)


def test_a_file_that_does_not_say_pixel_centre(camera, tmp_path):
    text = "".join(line for line in camera.to_json().splitlines(True) if "pixel_centre" not in line)
    (tmp_path / "camera.json").write_text(text)
    with pytest.warns(fathom.ViewWarning, match="pixel_centre") as told:
        assert fathom.Camera.read(tmp_path / "camera.json") == camera
    assert told[0].filename == __file__


@pytest.mark.parametrize("call", [
    lambda scene, camera: scene.render(camera),
    lambda scene, camera: scene.render([camera, camera]),
    lambda scene, camera: fathom.render(scene.vertices(), scene.faces(), camera.K, camera.world_to_camera,
                                        camera.size, pixel_centre=0.5),
])
def test_a_warning_names_the_line_that_calls(spot, camera, call):
    with pytest.warns(fathom.ViewWarning, match="principal point") as told:
        call(spot, changed(camera, cx=camera.cx + 35))
    assert {each.filename for each in told} == {__file__}
