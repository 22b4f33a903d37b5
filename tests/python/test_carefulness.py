"""What people do with arrays and maps without thinking of it: shared memory, masks, copies, pools, odd names."""

import copy
import os
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import fathom

camera = fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
vertices = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 5)], float)
faces = np.array([(0, 1, 2)], np.uint32)


@pytest.fixture
def scene():
    made = fathom.Scene()
    made.add_mesh(vertices, faces)
    return made


def test_an_array_to_write_to_may_not_be_the_mesh():
    scene = fathom.Scene()
    corners = np.zeros((1024, 3), np.uint32)
    corners[:] = (0, 1, 2)
    scene.add_mesh(vertices, corners)
    for out in (corners.reshape(48, 64), corners.reshape(-1)[:3072].reshape(48, 64)):
        with pytest.raises(ValueError, match="out: the array for channel id shares memory with a mesh of the scene"):
            scene.render(camera, channels=("id",), out={"id": out})
    assert (corners == (0, 1, 2)).all()
    many = np.zeros((1024, 3))
    many[:3] = vertices
    scene.add_mesh(many, faces)
    with pytest.raises(ValueError, match="out: the array for channel Z shares memory"):
        scene.render(camera, dtype="float64", out={"Z": many.reshape(48, 64)})
    assert (many[:3] == vertices).all()


def test_arrays_to_write_to_lie_apart(scene):
    room = np.empty(2 * 48 * 64, np.float32)
    whole = room[:3072].reshape(48, 64)
    for other in (whole, room[10:3082].reshape(48, 64), room[3071:6143].reshape(48, 64)):
        with pytest.raises(ValueError, match="out: the arrays for channels Z and distance share memory"):
            scene.render(camera, channels=("Z", "distance"), out={"Z": whole, "distance": other})
    beside = scene.render(camera, channels=("Z", "distance"), out={"Z": whole, "distance": room[3072:].reshape(48, 64)})
    assert (beside["distance"] >= beside["Z"]).all()


def test_masks_are_refused_rather_than_ignored(scene):
    depths = scene.render(camera)["Z"]
    masked = np.ma.masked_invalid(depths)
    for call in (lambda: fathom.compare(depths, masked), lambda: fathom.validate(masked, scene, camera, "float32-ray"),
                 lambda: scene.add_mesh(np.ma.masked_greater(vertices, 4), faces)):
        with pytest.raises(TypeError, match="an array with a mask: fill it first"):
            call()
    assert fathom.compare(depths, masked.filled(np.inf)).within_tolerance
    assert fathom.compare(depths, np.ma.masked_array(depths)).within_tolerance


def test_a_mesh_is_added_whole_or_not_at_all(scene):
    for bad in ({"name": None}, {"name": "\udcff"}, {"pose": np.zeros(3)}, {"labels": [1, 2]}, {"materials": 7}):
        with pytest.raises((TypeError, ValueError)):
            scene.add_mesh(vertices, faces, **bad)
    assert scene.mesh_count == len(scene.objects) == 1 and scene.add_mesh(vertices, faces) == 1


def test_a_background_that_its_type_rounds_stays_the_background(scene):
    map = scene.render(camera, background=0.1)
    seen = map.mask()
    wide = map.stored_as("float64")
    assert (wide.mask() == seen).all() and 0 < seen.sum() < seen.size
    assert wide.background == float(np.float32(0.1)) and len(wide.points()) == seen.sum()
    assert (wide.stored_as("float32").mask() == seen).all()


def test_own_arrays_may_say_their_background_and_scale(scene):
    map = scene.render(camera)
    seen = map.mask()
    zeros = fathom.Map({"Z": np.where(seen, map["Z"], 0)}, camera, background=0)
    assert (zeros.mask() == seen).all() and np.array_equal(zeros.points(), map.points())
    codes = fathom.Map({"Z": np.where(seen, np.rint(map["Z"] * 1000), 0).astype(np.uint16)}, camera, scale=1000)
    assert np.allclose(codes.points(), map.points(), atol=1e-3) and (codes.mask() == seen).all()
    assert fathom.validate(codes, scene, camera, "float32-ray").unexplained == 0
    with pytest.raises(ValueError, match="scale: expected a number above 0"):
        fathom.Map({}, scale=0)
    with pytest.raises(ValueError, match="background: expected inf, nan or a number"):
        fathom.Map({}, background=-np.inf)


def test_a_stack_has_no_cryptomatte(scene):
    stack = scene.render([camera, camera])
    with pytest.raises(ValueError, match="it is a stack"):
        stack.add_cryptomatte(scene, camera)
    assert set(stack) == {"Z"}


def equal(a, b):
    return (type(a) is type(b) and a.cameras == b.cameras and a.metadata == b.metadata and a.tables == b.tables
            and a.scale == b.scale and list(a) == list(b) and all(np.array_equal(a[name], b[name]) for name in a))


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, fathom.Map.copy, lambda map: pickle.loads(pickle.dumps(map))])
def test_copies_are_maps_of_their_own(scene, duplicate):
    for map in (scene.render(camera, channels=("Z", "object"), background=0), scene.render([camera, camera]),
                scene.render(camera, dtype="uint16", scale=100)):
        other = duplicate(map)
        assert equal(map, other)
        if map.cameras == [camera]:
            other.add_cryptomatte(scene)
            assert len(other.metadata) > len(map.metadata) and "CryptoObject00.R" not in map
        else:
            assert equal(map.view(1), other.view(1))


def rendered_elsewhere(i):
    made = fathom.Scene()
    made.add_mesh(vertices + (0, 0, i), faces)
    return made.render(camera)


def test_maps_come_back_from_other_processes():
    with ProcessPoolExecutor(2) as pool:
        for i, map in enumerate(pool.map(rendered_elsewhere, range(3))):
            assert equal(map, rendered_elsewhere(i))


def test_maps_in_other_byte_orders_and_half_floats_are_written_as_what_they_are(scene, tmp_path):
    depths = scene.render(camera)["Z"]
    for array, expected in ((depths.astype(">f4"), depths), (depths.astype(np.float16), depths.astype(np.float16))):
        fathom.Map({"Z": array}, camera).write(tmp_path / "x.exr")
        read = fathom.read_map(tmp_path / "x.exr")["Z"]
        assert read.dtype == np.float32 and np.array_equal(read, expected.astype(np.float32))


def test_names_of_files_that_are_not_utf_8_stand_in_messages(tmp_path):
    with pytest.raises(fathom.InputError, match=r"caf\\xe9.obj"):
        fathom.Scene.read(os.fsencode(tmp_path) + b"/caf\xe9.obj")


def test_r_and_t_by_themselves_are_told_from_a_matrix(K=np.array([[40, 0, 32], [0, 40, 24], [0, 0, 1]], float)):
    R, t = np.eye(3), np.zeros(3)
    for T in ((R, t), [R.tolist(), t.tolist()], (R, t.reshape(3, 1))):
        with pytest.raises(ValueError, match=r"T: expected one matrix, found R and t: np.column_stack"):
            fathom.render(vertices, faces, K, T, (64, 48), pixel_centre=0.5)
        with pytest.raises(ValueError, match=r"T: expected one matrix"):
            fathom.Camera.from_opencv(K, T, (64, 48), pixel_centre=0.5)
    depths = fathom.render(vertices, faces, K, np.column_stack([R, t]), (64, 48), pixel_centre=0.5)["Z"]
    assert np.isfinite(depths).any()


@pytest.mark.parametrize("call, error, words", [
    (lambda m, s: m.write("x.exr", channel="nope"), ValueError, "channel: the map has no channel 'nope', only Z"),
    (lambda m, s: m.write("x.exr", channel=3), TypeError, "channel: expected a string, found 3"),
    (lambda m, s: m.write("x.exr", compression=None), TypeError, "compression: expected a string"),
    (lambda m, s: m.write("x.exr", names=[("Z", "Y")]), TypeError, "names: expected a dict"),
    (lambda m, s: m.write("newdir/x.bmp"), ValueError, "ends in .exr"),
    (lambda m, s: m.stored_as("foo"), TypeError, "dtype: expected float32, float64 or uint16, found 'foo'"),
    (lambda m, s: m.stored_as("float64", channel=None), TypeError, "channel: expected a string"),
    (lambda m, s: s.render(camera, channels=None), TypeError, "channels: expected a sequence of names"),
    (lambda m, s: s.render("cams.json"), TypeError,
     r"camera: expected a Camera or a sequence of them, found 'cams.json'; fathom.read_cameras\('cams.json'\) reads"),
    (lambda m, s: fathom.probe(s, "cams.json", 1, 1), TypeError,
     r"camera: expected a Camera, found 'cams.json'; fathom.read_cameras\('cams.json'\) reads a camera file"),
    (lambda m, s: fathom.Map({"A": m["Z"]}).write("x.png"), OSError,
     "channel 'A' is stored as floating point; write .exr, .npy or .npz"),
    (lambda m, s: m.write("x.npy", scale=1000), ValueError, "scale: only .png holds codes"),
    (lambda m, s: s.render(camera, channels="A,N").write("x.npy"), ValueError,
     "channel: this format holds one channel, and the map has A, N; name the one to write"),
    (lambda m, s: s.render(camera, channels="Z,N").write("x.pfm", channel="N"), ValueError,
     "channel: this format holds one channel, and N is N.X, N.Y, N.Z; name the one to write, or write .exr, .npy or .npz"),
    (lambda m, s: s.render(camera, dtype=None), TypeError, "dtype: expected float32"),
    (lambda m, s: s.render({"left.jpg": camera}), TypeError, r"found a dict: take list\(cameras.values\(\)\)"),
    (lambda m, s: s.render(camera for camera in (1 / 0,)), ZeroDivisionError, "division"),
    (lambda m, s: fathom.compare(m, m, channel=None), TypeError, "channel: expected a string"),
    (lambda m, s: fathom.compare(*[s.render(camera, channels="Z,N")] * 2, channel="N"), ValueError,
     "N is N.X, N.Y, N.Z; name one$"),
    (lambda m, s: fathom.validate(s.render(camera, channels="Z,N"), s, camera, channel="N"), ValueError,
     "N is N.X, N.Y, N.Z; name one$"),
    (lambda m, s: fathom.Map({1: m["Z"]}).write("x.exr"), TypeError, "channels: expected a string, found 1"),
    (lambda m, s: fathom.render(None, faces, np.eye(3), np.eye(4), (4, 4), pixel_centre=0), TypeError,
     "vertices: expected an array of numbers, found None"),
])
def test_words_for_wrong_arguments(scene, call, error, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=words):
        call(scene.render(camera), scene)
    assert not any(tmp_path.iterdir())
