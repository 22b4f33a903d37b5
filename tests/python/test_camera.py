"""fathom.Camera: its conventions, judged by projections in NumPy; its files; what it refuses."""

import copy
import decimal
import functools
import inspect
import json
import math
import pickle
import random
import signal
import time

import numpy as np
import pytest

import fathom


def project(camera, points):
    """Pixel coordinates with (0, 0) at the image's corner, by the textbook."""
    p = np.c_[points, np.ones(len(points))] @ camera.world_to_camera.T
    return (p[:, :3] / p[:, 2:3] @ camera.K.T)[:, :2] + 0.5 - camera.pixel_centre


def sees(camera, point, radius=1e-3):
    """The pixels in which a tiny triangle around a point is drawn."""
    scene = fathom.Scene()
    corners = np.array(point) + radius * np.array([(-1, -1, 0), (1, -1, 0), (0, 1, 0)])
    scene.add_mesh(corners, [(0, 1, 2)])
    scene.add_mesh(corners[:, [2, 0, 1]] - np.array(point)[[2, 0, 1]] + point, [(0, 1, 2)])
    coverage = scene.render(camera, channels=("A",))["A"]
    return {(int(x), int(y)) for y, x in np.argwhere(coverage > 0)}


@pytest.mark.parametrize("pixel_centre", [0, 0.5])
def test_from_opencv_projects_as_opencv_does(pixel_centre):
    K = np.array([(100, 3, 31.25), (0, 110, 22.5), (0, 0, 1)])
    T = np.array([(0, -1, 0, 0.25), (1, 0, 0, -0.5), (0, 0, 1, 4), (0, 0, 0, 1)], float)
    camera = fathom.Camera.from_opencv(K, T, (64, 48), pixel_centre=pixel_centre, near=1, far=9)
    assert np.array_equal(camera.K, K) and np.array_equal(camera.world_to_camera, T)
    assert (camera.size, camera.near, camera.far, camera.skew) == ((64, 48), 1, 9, 3)
    for point in [(0, 0, 0), (0.5, 0.25, 1), (0.25, 0, -1)]:
        u, v = project(camera, np.array([point]))[0]
        assert (int(u), int(v)) in sees(camera, point)
    assert np.allclose(camera.camera_to_world @ camera.world_to_camera, np.eye(4), atol=1e-15)


def test_from_opengl_agrees_with_clip_coordinates():
    near, far, width, height = 0.5, 20.0, 64, 48
    projection = np.array([(1.5, 0, 0.125, 0), (0, 2, -0.25, 0),
                           (0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)), (0, 0, -1, 0)])
    modelview = np.eye(4)
    modelview[:3, 3] = (0.5, 0.25, -5)
    camera = fathom.Camera.from_opengl(projection, modelview, (width, height))
    points = np.array([(0, 0, 0), (1, 0.5, 1), (-1, -0.5, -2)], float)
    clip = np.c_[points, np.ones(3)] @ modelview.T @ projection.T
    window = np.c_[(1 + clip[:, 0] / clip[:, 3]) * width / 2, (1 - clip[:, 1] / clip[:, 3]) * height / 2]
    assert np.allclose(project(camera, points), window, atol=1e-12)
    assert np.isclose(camera.near, near) and np.isclose(camera.far, far)


def test_look_at_has_the_target_in_the_middle_and_up_upwards():
    camera = fathom.Camera.look_at((3, 1, 2), (0.5, 0, 0), size=(64, 48), fov=60)
    middle, above = project(camera, np.array([(0.5, 0, 0), (0.5, 0.1, 0)]))
    assert np.allclose(middle, (32, 24)) and above[1] < 24
    assert np.isclose(camera.fy, 24 / np.tan(np.pi / 6))
    assert fathom.Camera.look_at((0, 0, 3), size=(64, 48), focal=77).fx == 77
    flat = fathom.Camera.look_at((0, 0, 3), size=(64, 48), projection="orthographic", extent=2)
    assert flat.projection == "orthographic" and flat.fy == 24


def test_up_is_a_word_or_a_vector_everywhere(spot):
    words = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "-x": (-2, 0, 0), "-y": (0, -3, 0), "-z": (0, 0, -1e-9)}
    make = [lambda up: fathom.Camera.look_at((3, 1, 2), up=up),
            lambda up: fathom.Camera.orbit(1, distance=2, up=up)[0],
            lambda up: fathom.Camera.frame(spot, up=up),
            lambda up: fathom.Camera.orbit_scene(spot, 3, up=up)[2]]
    for camera_with in make:
        for word, vector in words.items():
            camera = camera_with(word)
            assert camera.to_json() == camera_with(vector).to_json()
            down = camera.world_to_camera[1, :3]
            assert np.dot(down, vector) < 0  # up in the world is up in the image
        up = np.array((0.3, -0.5, 2))
        right, down = camera_with(up).world_to_camera[:2, :3]
        assert abs(np.dot(right, up)) < 1e-15 and np.dot(down, up) < 0
        with pytest.raises(ValueError, match="up: expected 'x', 'y', 'z', '-x', '-y', '-z', found 'w'"):
            camera_with("w")
        with pytest.raises(ValueError, match="up"):
            camera_with((0, 0, 0))


def test_orbit_and_frame(spot):
    cameras = fathom.Camera.orbit(8, distance=2, centre=(1, 2, 3), up="z", elevation=0, azimuth=0)
    eyes = np.array([camera.camera_to_world[:3, 3] for camera in cameras])
    assert np.allclose(np.linalg.norm(eyes - (1, 2, 3), axis=1), 2) and np.allclose(eyes[:, 2], 3)
    for camera in [fathom.Camera.frame(spot, size=(64, 48)), *fathom.Camera.orbit_scene(spot, 5, size=(64, 48))]:
        (low, high) = spot.bounds
        corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        images = project(camera, corners)
        assert (images > 0).all() and (images < (64, 48)).all()


def test_json_keeps_every_bit(tmp_path):
    camera = fathom.Camera(7, 5, 1 / 3, 2 / 3, 0.1, 1e-300, pixel_centre=0.1, skew=1e300,
                           world_to_camera=[(1 / 7, 0, 0, 1e-5), (0, 1, 0, 2**60), (0, 0, -1, 3)], near=0.1)
    for again in (fathom.Camera.from_json(camera.to_json()), pickle.loads(pickle.dumps(camera)), copy.deepcopy(camera)):
        assert again == camera and hash(again) == hash(camera)
    camera.write(tmp_path / "camera.json")
    assert fathom.Camera.read(tmp_path / "camera.json") == camera
    fathom.write_cameras(tmp_path / "path.json", [camera, camera.with_size(9, 9)])
    path = fathom.read_cameras(tmp_path / "path.json")
    assert path == [camera, camera.with_size(9, 9)] and path[0] != path[1]
    assert camera.with_size((9, 7)) == camera.with_size(9, 7)
    assert isinstance(json.loads((tmp_path / "path.json").read_text()), list)
    with pytest.raises(ValueError, match="expected one camera, found 2"):
        fathom.Camera.read(tmp_path / "path.json")


def test_cameras_of_other_programs(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 100 110 32.5 24.5\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0.5 0.25 4 1 a.png\n\n2 1 0 0 0 0 0 5 1 b.png\n\n")
    colmap = fathom.Camera.from_colmap(tmp_path)
    assert list(colmap) == ["a.png", "b.png"]
    assert colmap["a.png"].pixel_centre == 0.5 and colmap["a.png"].world_to_camera[:3, 3].tolist() == [0.5, 0.25, 4]

    pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]]
    (tmp_path / "transforms.json").write_text(json.dumps(
        {"fl_x": 100, "fl_y": 110, "cx": 32, "cy": 24, "w": 64, "h": 48, "scale": 0.33,
         "frames": [{"file_path": "a", "transform_matrix": pose}]}))
    with pytest.warns(UserWarning, match="scale"):
        nerf = fathom.Camera.from_nerf(tmp_path / "transforms.json")
    assert nerf["a"].camera_to_world[:3, 3].tolist() == [0, 0, 4] and nerf["a"].world_to_camera[2, 2] == -1

    (tmp_path / "scene_camera.json").write_text(json.dumps({"3": {"cam_K": [100, 0, 32, 0, 110, 24, 0, 0, 1]}}))
    bop = fathom.Camera.from_bop(tmp_path / "scene_camera.json", (64, 48))
    assert bop["3"].pixel_centre == 0 and bop["3"].size == (64, 48)
    with pytest.raises(fathom.InputError, match="the image size is unknown"):
        fathom.Camera.from_bop(tmp_path)
    (tmp_path / "camera.json").write_text('{"width": 32, "height": 24}')
    assert fathom.Camera.from_bop(tmp_path)["3"].size == (32, 24)


def test_names_are_kept(tmp_path):
    camera = make(name="left/0001.jpg")
    assert camera.name == "left/0001.jpg" and make().name == ""
    assert repr(camera).endswith("pixel_centre=0.5, name='left/0001.jpg')") and "name" not in repr(make())
    for again in (fathom.Camera.from_json(camera.to_json()), pickle.loads(pickle.dumps(camera)), camera.with_size(2, 2)):
        assert again.name == camera.name
    assert fathom.Camera.from_json(camera.to_json()) == camera != make()
    for name, error in ((3, TypeError), ("a\0b", ValueError), ("\ud800", ValueError)):
        with pytest.raises(error, match="name: expected"):
            make(name=name)
    # A file's name may be any bytes; what is no UTF-8 is shown as such, here and in camera files.
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 100 110 32.5 24.5\n")
    (tmp_path / "images.txt").write_bytes(b"1 1 0 0 0 0.5 0.25 4 1 a\xff.png\n\n")
    (name, camera), = fathom.Camera.from_colmap(tmp_path).items()
    assert name == camera.name == "a\ufffd.png" and fathom.Camera.from_json(camera.to_json()).name == name


def test_a_name_that_no_image_has_is_answered_with_the_names_there_are(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 9 9 3 2\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 3 1 left.jpg\n\n2 1 0 0 0 0 0 3 1 right.jpg\n\n")
    cameras = fathom.Camera.from_colmap(tmp_path)
    with pytest.raises(KeyError, match="there is no camera 'left' of 2; did you mean 'left.jpg'"):
        cameras["left"]
    with pytest.raises(KeyError, match="there is no camera 7 of 2; the first is 'left.jpg'"):
        cameras[7]
    assert cameras.get("left") is None and list(cameras) == ["left.jpg", "right.jpg"]


def test_distorted_cameras_are_left_out_with_a_warning(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 FOV 64 48 9 9 3 2 4\n2 PINHOLE 64 48 9 9 3 2\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 3 1 a\n\n2 1 0 0 0 0 0 3 2 b\n\n")
    with pytest.warns(fathom.ViewWarning, match="1 of 2 cameras has lens distortion") as caught:
        assert list(fathom.Camera.from_colmap(tmp_path)) == ["b"]
    assert caught[0].filename == __file__
    assert list(fathom.Camera.from_colmap(tmp_path, ignore_distortion=True)) == ["a", "b"]


def test_importers_are_class_methods():
    importers = [name for name in vars(fathom.Camera) if name.startswith("from_")]
    assert len(importers) == 16
    for name in importers:
        assert isinstance(inspect.getattr_static(fathom.Camera, name), classmethod), name
        assert "cls" not in inspect.signature(getattr(fathom.Camera, name)).parameters, name

    class Own(fathom.Camera):
        pass

    (made,) = Own.from_matrices(K, [turned], (640, 480), direction="camera-to-world",
                                axes="opencv", pixel_centre=0).values()
    assert type(made) is type(Own.look_at((0, 0, 3))) is Own


# The eye at (2, 3, 4), a quarter turn about y: camera x is world −z, and z is x.
turned = np.array([(0, 0, 1, 2), (0, 1, 0, 3), (-1, 0, 0, 4), (0, 0, 0, 1)], float)
K = np.array([(500, 0, 320), (0, 510, 240), (0, 0, 1)], float)


def test_matrices():
    def of(poses, K=K, **changes):
        arguments = dict(size=(640, 480), direction="camera-to-world", axes="opencv", pixel_centre=0)
        return fathom.Camera.from_matrices(K, poses, **{**arguments, **changes})

    one = of([turned])["0"]
    assert np.array_equal(one.camera_to_world, turned) and np.array_equal(one.K, K) and one.pixel_centre == 0
    flip = np.diag((1, -1, -1, 1))
    for camera in (of([turned @ flip], axes="opengl")["0"],
                   of([np.linalg.inv(turned)], direction="world-to-camera")["0"],
                   of([flip @ np.linalg.inv(turned)], direction="world-to-camera", axes="opengl")["0"]):
        assert np.array_equal(camera.camera_to_world, turned)
    two = of([turned, np.eye(4)], K=[K, 2 * K - K * (K == 1)], names=["a", "b"])
    assert list(two) == ["a", "b"] and two["b"].fx == 1000 and two["b"].name == "b"
    assert of(np.array([turned])[:, :3])["0"] == one
    for poses, changes, words in (
        (turned, {}, "poses: expected shape n×4×4 or n×3×4, found 4×4"),
        ([2 * turned], {}, "the last rows to be 0 0 0 1"),
        ([turned], {"K": K[:2]}, "K: expected shape 3×3"),
        ([turned], {"K": [K, K]}, "2 matrices K and 1 poses"),
        ([turned], {"names": []}, "names: expected 1, found 0"),
        ([turned, turned], {"names": ["a", "a"]}, "two images have the name 'a'"),
        ([np.zeros((3, 4))], {}, "pose 0: the matrix is singular"),
        ([turned], {"direction": "world"}, "direction: expected"),
        ([turned], {"axes": "blender"}, "axes: expected"),
    ):
        with pytest.raises(ValueError, match=words):
            of(poses, **changes)
    with pytest.raises(TypeError):
        fathom.Camera.from_matrices(K, [turned], (640, 480))


def test_data_sets(tmp_path):
    rows = "".join(" ".join(map(repr, row)) + "\n" for row in turned.tolist())
    line = " ".join(map(repr, turned.ravel().tolist())) + "\n"

    def write(name, text):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
        return tmp_path / name

    # A quarter turn about y as a quaternion x y z w.
    trajectory = write("groundtruth.txt", "1.5 2 3 4 0 0.5 0 0.5\n")
    images = write("rgb.txt", "1.51 rgb/1.51.png\n9 rgb/9.png\n")
    write("seq/frame-000007.pose.txt", rows)
    write("scene/pose/0.txt", rows)
    write("scene/pose/1.txt", "-inf -inf -inf -inf\n" * 4)
    for stream, f in (("depth", 577), ("color", 1170)):
        write(f"scene/intrinsic/intrinsic_{stream}.txt", f"{f} 0 319.5 0\n0 {f} 239.5 0\n0 0 1 0\n0 0 0 1\n")
    write("room/traj.txt", line)
    write("cam_params.json", json.dumps({"camera": dict(w=1200, h=680, fx=600, fy=600, cx=599.5, cy=339.5)}))
    iphone = write("pose.json", json.dumps({"frame_0": {"intrinsic": K.tolist(), "aligned_pose": turned.tolist()}}))
    calibration = write("calib.txt", "P2: 500 0 320 50 0 510 240 0 0 0 1 0\n")
    poses = write("00.txt", " ".join(line.split()[:12]) + "\n")
    tum = fathom.Camera.from_tum(tmp_path, "ros")
    with pytest.warns(fathom.ViewWarning, match="1 of 2 cameras is left out"):
        of_images = fathom.Camera.from_tum(trajectory, (500, 510, 320, 240), images=images, pixel_centre=0.5)
    with pytest.warns(fathom.ViewWarning, match="1 of 2 cameras is left out"):
        depth, colour = (fathom.Camera.from_scannet(tmp_path / "scene", stream) for stream in ("depth", "colour"))
    found = [tum["1.5"], of_images["rgb/1.51.png"], fathom.Camera.from_7scenes(tmp_path / "seq")["frame-000007"],
             depth["0"], colour["0"], fathom.Camera.from_replica(tmp_path / "room")["frame000000"],
             fathom.Camera.from_scannetpp(iphone)["frame_0"]]
    for camera in found:
        assert np.array_equal(camera.camera_to_world, turned), camera
    assert [camera.fx for camera in found] == [525, 500, 585, 577, 1170, 600, 500]
    assert [camera.width for camera in found] == [640, 640, 640, 640, 1296, 1200, 1920]
    assert [camera.pixel_centre for camera in found] == [0, 0.5, 0, 0, 0, 0, 0]
    other = fathom.Camera.from_7scenes(tmp_path / "seq", K=K, size=(64, 48), pixel_centre=0.5)["frame-000007"]
    assert np.array_equal(other.K, K) and other.size == (64, 48) and other.pixel_centre == 0.5
    with pytest.raises(fathom.InputError, match="freiburg1: its colour images have lens distortion"):
        fathom.Camera.from_tum(tmp_path, "freiburg1")
    with pytest.raises(ValueError, match="give K, or one of ros, freiburg1"):
        fathom.Camera.from_tum(tmp_path, "kinect")

    beside = fathom.Camera.from_kitti(calibration, size=(1241, 376))["image_2"]
    assert beside.world_to_camera[:3, 3].tolist() == [0.1, 0, 0]
    along = fathom.Camera.from_kitti(calibration, poses=poses, camera=2, size=(1241, 376))["000000"]
    assert np.array_equal(along.world_to_camera, beside.world_to_camera @ np.linalg.inv(turned))
    with pytest.raises(ValueError, match="the number of a camera"):
        fathom.Camera.from_kitti(calibration, poses=poses, size=(1241, 376))

    lens = {"type": "orthographic", "orthographic": dict(xmag=4, ymag=3, znear=0, zfar=9)}
    gltf = write("a.gltf", json.dumps({"cameras": [lens],
                                       "nodes": [{"name": "eye", "camera": 0, "translation": [1, 2, 3]}]}))
    eye = fathom.Camera.from_gltf(gltf, (640, 480))["eye"]
    assert eye.projection == "orthographic" and eye.fx == 80 and eye.camera_to_world[:3, 3].tolist() == [1, 2, 3]
    sfm = write("a.sfm", json.dumps({
        "version": ["1", "2", "0"], "views": [{"viewId": "1", "poseId": "1", "intrinsicId": "1", "path": "/a/b.jpg"}],
        "intrinsics": [{"intrinsicId": "1", "width": "640", "height": "480", "type": "pinhole",
                        "pxFocalLength": ["500", "510"], "principalPoint": ["320", "240"]}],
        "poses": [{"poseId": "1", "pose": {"transform": {
            "rotation": turned[:3, :3].ravel().tolist(), "center": turned[:3, 3].tolist()}}}]}))
    camera = fathom.Camera.from_sfm_data(sfm)["b.jpg"]
    assert np.array_equal(camera.camera_to_world, turned) and np.array_equal(camera.K, K)


def make(**changes):
    arguments = dict(width=64, height=48, fx=40, fy=40, cx=32, cy=24, pixel_centre=0.5)
    return fathom.Camera(**{**arguments, **changes})


@pytest.mark.parametrize("changes, error, words", [
    ({"width": 0}, ValueError, "size: width: expected 1 to"),
    ({"height": -5}, ValueError, "size: height"),
    ({"width": 2.5}, TypeError, "size: width: expected an integer"),
    ({"fx": 0}, ValueError, "fx"),
    ({"fx": np.nan}, ValueError, "fx"),
    ({"cx": "a"}, TypeError, "cx: expected a number, found 'a'"),
    ({"near": -1}, ValueError, "near"),
    ({"near": 5, "far": 5}, ValueError, "far"),
    ({"pixel_centre": np.inf}, ValueError, "pixel_centre"),
    ({"projection": "fisheye"}, ValueError, "projection: expected 'perspective', 'orthographic', found 'fisheye'"),
    ({"world_to_camera": np.eye(3)}, ValueError, "world_to_camera: expected shape 4×4 or 3×4, found 3×3"),
    ({"world_to_camera": np.zeros((4, 4))}, ValueError, "expected the last row to be 0 0 0 1, found 0 0 0 0"),
    ({"world_to_camera": np.zeros((3, 4))}, ValueError, "singular|det"),
    ({"world_to_camera": np.array([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (5, 6, 7, 1)])}, ValueError,
     "is it transposed"),
    ({"world_to_camera": [[1, 2], [3]]}, TypeError, "world_to_camera: expected an array of numbers"),
])
def test_what_a_camera_refuses(changes, error, words):
    with pytest.raises(error, match=words) as raised:
        make(**changes)
    assert "\n" not in str(raised.value)


def test_K_is_looked_at():
    with pytest.raises(ValueError, match="K: .*is it transposed"):
        fathom.Camera.from_opencv(np.array([(40, 0, 0), (0, 40, 0), (32, 24, 1.0)]), np.eye(4), (64, 48), pixel_centre=0)
    with pytest.raises(ValueError, match="K: nan at \\[0, 2\\] is not a finite number"):
        fathom.Camera.from_opencv([(40, 0, np.nan), (0, 40, 0), (0, 0, 1)], np.eye(4), (64, 48), pixel_centre=0)


def test_a_camera_does_not_change():
    camera = make()
    for name in ("width", "fx", "anything"):
        with pytest.raises(AttributeError, match="does not change"):
            setattr(camera, name, 3)
    camera.world_to_camera[0, 0] = 9  # of an array of its own
    assert camera.world_to_camera[0, 0] == 1


def makers(spot):
    """The functions that make cameras with a lens."""
    return (functools.partial(fathom.Camera.look_at, (0, 0, 3)),
            functools.partial(fathom.Camera.orbit, 2, distance=3),
            functools.partial(fathom.Camera.frame, spot),
            functools.partial(fathom.Camera.orbit_scene, spot, 2))


@pytest.mark.parametrize("numbers", [
    {}, {"size": (64, 48), "fov": 60}, {"focal": 77, "near": 0.1, "far": 9},
    {"projection": "orthographic", "extent": 2},
])
def test_cameras_share_a_lens(spot, numbers):
    lens = fathom.Lens(**numbers)
    for make_one in makers(spot):
        assert make_one(lens=lens) == make_one(**numbers)
    assert eval(repr(lens), {"Lens": fathom.Lens, "inf": math.inf}) == lens
    assert pickle.loads(pickle.dumps(lens)) == lens and hash(copy.copy(lens)) == hash(lens)
    assert lens != fathom.Lens(size=(8, 6)) and lens.size == numbers.get("size", (1280, 720))


def test_a_lens_does_not_change_and_stands_alone(spot):
    lens = fathom.Lens(fov=60)
    with pytest.raises(AttributeError, match="a Lens does not change"):
        lens.fov = 3
    for make_one in makers(spot):
        with pytest.raises(TypeError, match="near: a lens is given, too: make a Lens with it"):
            make_one(lens=lens, near=1)
        with pytest.raises(TypeError, match="lens: expected a Lens, found 60"):
            make_one(lens=60)
        with pytest.raises(TypeError, match="unexpected keyword argument 'focus'"):
            make_one(focus=1)


@pytest.mark.parametrize("lens, words", [
    ({"fov": 40, "focal": 3}, "fov, focal: give one of them"),
    ({"extent": 3}, "extent: it is for orthographic cameras"),
    ({"projection": "orthographic", "extent": 3, "fov": 40}, "fov, focal: they are for perspective cameras"),
    ({"projection": "orthographic", "extent": 3, "focal": 40}, "fov, focal: they are for perspective cameras"),
])
def test_lenses_that_say_two_things_are_refused(spot, lens, words):
    for make_one in (*makers(spot), fathom.Lens):
        with pytest.raises(ValueError, match=words):
            make_one(**lens)


@pytest.mark.parametrize("change, size, words", [
    ({"w": 9}, (8, 8), "frame a: its size is 9×8 by w and h, 8×8 by the argument size"),
    ({"frames": ["a", "b", "a"]}, None, "frame a: there are two frames with this file_path"),
    ({"fl_x": None, "camera_angle_x": 3.2}, None, "camera_angle_x: expected an angle in radians between 0 and π"),
])
def test_what_a_transforms_json_must_not_say(tmp_path, change, size, words):
    pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]]

    def read(size=None, frames=("a",), **keys):
        content = {"fl_x": 100, "w": 8, "h": 8, **keys,
                   "frames": [{"file_path": name, "transform_matrix": pose} for name in frames]}
        file = tmp_path / "transforms.json"
        file.write_text(json.dumps({name: value for name, value in content.items() if value is not None}))
        return fathom.Camera.from_nerf(file, size)

    assert list(read((8, 8), ("a", "b"))) == ["a", "b"] and read(w=None, h=None, size=(4, 5))["a"].size == (4, 5)
    with pytest.raises(fathom.InputError, match="frame a: the focal lengths are -100 and .* expected positive ones"):
        read(fl_x=-100)
    assert read(fl_x=None, camera_angle_x=3.1)["a"].fx > 0
    with pytest.raises(fathom.InputError, match=f"transforms.json: {words}"):
        read(size, **change)


def test_errors_of_camera_files_name_them(tmp_path):
    with pytest.raises(fathom.InputError, match="missing: cannot be opened: No such file"):
        fathom.read_cameras(tmp_path / "missing")
    with pytest.raises(fathom.InputError, match="cannot be opened: Is a directory"):
        fathom.Camera.read(tmp_path)
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(fathom.InputError, match=r"binary: is not text, expected a camera file \(JSON\); fathom.read_map\('.*'\).camera is"):
        fathom.read_cameras(tmp_path / "binary")
    for place, words in ((tmp_path, "Is a directory"), ("/dev/full", "/dev/full: No space left on device")):
        with pytest.raises(fathom.OutputError, match=words):
            make().write(place)


@pytest.mark.parametrize("make_orbit", [
    lambda scene: fathom.Camera.orbit_scene(scene, 1_000_000),
    lambda scene: fathom.Camera.orbit(1_000_000, distance=3),
])
def test_signals_end_an_orbit(spot, make_orbit):
    """As Ctrl-C does. All of it would take many seconds; those of the processor are counted, whatever else it does."""
    class Enough(Exception):
        pass

    def stop(*_):
        raise Enough

    before = signal.signal(signal.SIGVTALRM, stop)
    try:
        started = time.process_time()
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.2)
        with pytest.raises(Enough):
            make_orbit(spot)
        assert time.process_time() - started < 2
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


class Exactly:
    """Sines and cosines by their series, with 80 digits: no library's."""

    def __init__(self):
        self.context = decimal.Context(prec=80)
        # Machin: π/4 = 4·arctan(1/5) − arctan(1/239).
        with decimal.localcontext(self.context):
            self.pi = 4 * (4 * self.arctan_of_inverse(5) - self.arctan_of_inverse(239))

    def arctan_of_inverse(self, n):
        with decimal.localcontext(self.context):
            return sum(decimal.Decimal((-1) ** k) / ((2 * k + 1) * decimal.Decimal(n) ** (2 * k + 1)) for k in range(60))

    def sine_and_cosine(self, degrees):
        with decimal.localcontext(self.context):
            x = decimal.Decimal(degrees) * self.pi / 180
            power, factorial, sums = decimal.Decimal(1), 1, [decimal.Decimal(0), decimal.Decimal(0)]
            for k in range(80):
                sums[k % 2] += (-1) ** (k // 2) * power / factorial
                power, factorial = power * x, factorial * (k + 1)
            return sums[1], sums[0]

    def focal_length(self, size, degrees):
        with decimal.localcontext(self.context):
            sine, cosine = self.sine_and_cosine(decimal.Decimal(degrees) / 2)
            return float(decimal.Decimal(size) / 2 * cosine / sine)


def test_a_field_of_view_gives_the_exact_focal_length_rounded_once():
    exactly, draw, off = Exactly(), random.Random(4), 0
    for i in range(400):
        fov = round(draw.uniform(0.1, 179.9), 1) if i % 2 else draw.uniform(1e-3, 179.999)
        height = draw.randrange(1, 5000)
        camera = fathom.Camera.look_at((0, 0, 3), size=(64, height), fov=fov)
        expected = exactly.focal_length(height, fov)
        assert camera.fx == camera.fy == expected, (fov, height)
        off += height / 2 / math.tan(fov * math.pi / 360) != expected
    assert off > 100  # the formula in binary64 is another camera


def test_an_orbit_has_exact_sines_and_cosines_rounded_once():
    exactly, count = Exactly(), 61
    for i, camera in enumerate(fathom.Camera.orbit(count, distance=3, azimuth=-170.3, elevation=17.7)):
        with decimal.localcontext(exactly.context):
            azimuth = decimal.Decimal(float(decimal.Decimal(-170.3) + decimal.Decimal(360 * i) / count))
            sine, cosine = exactly.sine_and_cosine(azimuth)
            up, flat = exactly.sine_and_cosine(decimal.Decimal(17.7))
            expected = [[cosine, 0, -sine], [up * sine, -flat, up * cosine], [-flat * sine, -up, -flat * cosine]]
        assert np.array_equal(camera.world_to_camera[:3, :3], np.array([[float(x) for x in row] for row in expected])), i
