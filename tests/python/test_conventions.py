"""The pictures of docs/conventions-in-pictures.md are those that docs/site/diagrams.py draws, and what they state is what
the library computes."""

import json
import os
import pathlib
import sys

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
sys.path.append(str(source / "docs/site"))
import diagrams  # noqa: E402

size, K = (320, 240), np.array([(100, 0, 160), (0, 100, 120), (0, 0, 1)], float)


@pytest.mark.parametrize("name", diagrams.PICTURES)
def test_pictures_are_what_the_program_draws(name):
    assert (source / "docs/images" / name).read_text(encoding="utf-8") == diagrams.PICTURES[name]()


def from_colmap(folder):
    (folder / "cameras.txt").write_text("1 PINHOLE 320 240 100 100 160 120\n")
    (folder / "images.txt").write_text("1 1 0 0 0 0 0 0 1 a.jpg\n\n")
    return fathom.Camera.from_colmap(folder)["a.jpg"]


def from_bop(folder):
    matrix = {"cam_K": K.ravel().tolist(), "depth_scale": 1}
    (folder / "scene_camera.json").write_text(json.dumps({"0": matrix}))
    return fathom.Camera.from_bop(folder / "scene_camera.json", size)["0"]


def from_nerf(folder):
    frame = {"file_path": "a", "transform_matrix": np.eye(4).tolist()}
    (folder / "transforms.json").write_text(json.dumps({"fl_x": 100, "w": 320, "h": 240, "frames": [frame]}))
    return fathom.Camera.from_nerf(folder / "transforms.json")["a"]


def from_opengl(folder):
    projection = np.array([(0.625, 0, 0, 0), (0, 200 / 240, 0, 0), (0, 0, -1.02, -0.202), (0, 0, -1, 0)])
    return fathom.Camera.from_opengl(projection, np.eye(4), size)


def from_opencv(folder):
    return fathom.Camera.from_opencv(K, np.eye(4), size, pixel_centre=0)


@pytest.mark.parametrize("program, make", [("Fathom", from_opencv), ("OpenCV", from_opencv), ("COLMAP", from_colmap),
                                           ("BOP", from_bop), ("NeRF", from_nerf), ("OpenGL", from_opengl)])
def test_a_point_is_where_the_picture_of_the_axes_says(program, make, tmp_path):
    """The camera's frame is the world: a small triangle about the point is seen right of the middle and below it."""
    frame, = (frame for frame in diagrams.FRAMES if program in frame["programs"].split(", "))
    place = np.array(diagrams.coordinates(frame), float)
    camera = make(tmp_path)
    assert (camera.world_to_camera @ [*place, 1]).tolist() == [diagrams.RIGHT, diagrams.DOWN, diagrams.FORWARD, 1]
    corners = place + np.array([(-0.2, -0.2, 0), (0.2, -0.2, 0), (0, 0.2, 0)])
    scene = fathom.Scene()
    scene.add_mesh(corners, [(0, 1, 2)])
    depth = scene.render(camera)["Z"]
    rows, columns = np.nonzero(np.isfinite(depth))
    assert set(depth[rows, columns]) == {diagrams.FORWARD}
    assert abs(columns.mean() - (160 + 100 * diagrams.RIGHT / diagrams.FORWARD)) < 2
    assert abs(rows.mean() - (120 + 100 * diagrams.DOWN / diagrams.FORWARD)) < 2
    assert diagrams.point(diagrams.coordinates(frame)) in (source / "docs/images/conventions-axes.svg").read_text()


def test_frames_are_those_of_the_page():
    text = (source / "docs/conventions.md").read_text(encoding="utf-8")
    for frame in diagrams.FRAMES:
        assert (np.array(frame["to_fathom"]) * diagrams.coordinates(frame)).tolist() == [1, 2, 5]
        matrix = "diag" + diagrams.point(frame["to_fathom"])
        assert matrix == "diag(1, 1, 1)" or matrix in text


def wall(distance):
    scene = fathom.Scene()
    scene.add_mesh([(-99, -99, distance), (99, -99, distance), (99, 99, distance), (-99, 99, distance)], [(0, 1, 2), (0, 2, 3)])
    return scene


def test_pixels_lie_where_the_picture_says():
    """At depth 1 with focal length 1, a point is as far from the axis as its pixel is from the principal point."""
    maps = []
    for counting in diagrams.COUNTINGS:
        cx, cy = diagrams.principal_point(counting)
        camera = fathom.Camera(diagrams.COLUMNS, diagrams.ROWS, 1, 1, cx, cy, pixel_centre=counting["pixel_centre"])
        points = wall(1).render(camera, channels=("P",))["P"]
        for column, row in ((0, 0), (diagrams.COLUMN, diagrams.ROW)):
            u, v = diagrams.position(counting, column, row)
            assert points[row, column].tolist() == [u - cx, v - cy, 1]
        maps.append(points)
    assert np.array_equal(*maps)
    assert diagrams.position(diagrams.COUNTINGS[0], 0, 0) == (0.5, 0.5)
    assert diagrams.position(diagrams.COUNTINGS[1], 0, 0) == (0, 0)


def test_planar_depth_and_distance_are_those_of_the_picture():
    drawn = (source / "docs/images/conventions-depth.svg").read_text(encoding="utf-8")
    # The focal length is the depth of the wall, so that a step of a pixel is a step of 1 on it; pixel 8 is on the axis.
    camera = fathom.Camera(17, 1, diagrams.WALL, diagrams.WALL, 8.5, 0.5, pixel_centre=0.5)
    maps = wall(diagrams.WALL).render(camera, channels=("Z", "distance", "P"))
    for side in diagrams.SIDES:
        assert maps["P"][0, 8 + side].tolist() == [side, 0, diagrams.WALL]
        assert f"Z = {maps['Z'][0, 8 + side]:g}, distance = {maps['distance'][0, 8 + side]:g}" in drawn
    assert len(set(maps["Z"][0])) == 1 and (np.diff(maps["distance"][0, 8:]) > 0).all()
