"""Every wrong argument is an exception of the right type, of one sentence that names it."""

import numpy as np
import pytest

import fathom

vertices = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float)
faces = np.array([(0, 1, 2)])
K = np.array([(4, 0, 2), (0, 4, 2), (0, 0, 1)], float)
good = dict(vertices=vertices, faces=faces, K=K, T=np.eye(4), size=(4, 4), pixel_centre=0.5)


def with_value(array, place, value):
    changed = array.copy()
    changed[place] = value
    return changed


cases = [
    ({"vertices": vertices[:, :2]}, ValueError, "vertices: expected shape N×3, found 3×2"),
    ({"vertices": vertices.ravel()}, ValueError, "vertices: expected shape N×3, found 9"),
    ({"vertices": vertices.astype(complex)}, TypeError, "vertices: expected float64 or float32 numbers, found complex"),
    ({"vertices": vertices.astype(str)}, TypeError, "vertices: expected float64 or float32"),
    ({"vertices": vertices.astype(object)}, TypeError, "vertices: expected an array of numbers"),
    ({"vertices": vertices.astype(np.longdouble)}, TypeError, "vertices: .*found float128"),
    ({"vertices": vertices > 0}, TypeError, "vertices: .*found bool"),
    ({"vertices": None}, TypeError, "vertices: expected an array of numbers"),
    ({"vertices": with_value(vertices, (1, 2), np.nan)}, ValueError, r"vertices: nan at \[1, 2\] is not a finite"),
    ({"vertices": with_value(vertices, (0, 0), np.inf)}, ValueError, r"vertices: inf at \[0, 0\]"),
    ({"vertices": np.array([(2**53 + 1, 0, 0)] * 3)}, ValueError, r"vertices: an integer beyond 2\^53 may be"),
    ({"faces": np.zeros((1, 4), int)}, ValueError, "faces: expected shape M×3"),
    ({"faces": faces.astype(float)}, TypeError, "faces: expected integers, found float64"),
    ({"faces": [(0, 1, 3)]}, IndexError, "faces: row 0 has vertex 3, but there are 3 vertices"),
    ({"faces": np.array([(0, 1, -1)])}, IndexError, "faces: row 0 has vertex -1"),
    ({"faces": np.array([(0, 1, -1)], np.int32)}, IndexError, "faces: row 0 has vertex -1, but"),
    ({"faces": np.array([(0, 1, 3)], np.uint32)}, IndexError, "faces: row 0 has vertex 3"),
    ({"faces": np.array([(0, 1, 2**40)])}, IndexError, "faces: row 0 has vertex 1099511627776"),
    ({"faces": np.zeros((0, 3), int)}, ValueError, "faces: a mesh needs at least one triangle"),
    ({"faces": []}, ValueError, "faces: a mesh needs at least one triangle"),
    ({"vertices": np.zeros((0, 3))}, IndexError, "there are 0 vertices"),
    ({"faces": [(0, 1), (0, 1, 2)]}, TypeError, "faces: expected an array of numbers"),
    ({"K": np.eye(2)}, ValueError, "K: expected shape 3×3, found 2×2"),
    ({"K": K.T}, ValueError, "K: .*transposed"),
    ({"T": np.eye(3)}, ValueError, "T: expected shape 4×4 or 3×4, found 3×3"),
    ({"T": with_value(np.eye(4), (0, 0), np.nan)}, ValueError, r"T: nan at \[0, 0\]"),
    ({"size": (4,)}, TypeError, r"size: expected \(width, height\)"),
    ({"size": 4}, TypeError, r"size: expected \(width, height\)"),
    ({"size": (0, 4)}, ValueError, "size: width: expected 1 to"),
    ({"size": (4, -1)}, ValueError, "size: height: expected 1 to"),
    ({"size": (4.0, 4)}, TypeError, "size: width: expected an integer, found 4.0"),
    ({"size": (2**31, 2**31)}, ValueError, r"more than 2\^44 pixels"),
    ({"size": (2**20, 2**20)}, MemoryError, "1048576×1048576 pixels needs 4398.0 GB; this machine has"),
    ({"size": (2**31, 2**3), "T": np.stack([np.eye(4)] * 9)}, MemoryError, "9 maps of 2147483648×8 pixels"),
    ({"pixel_centre": None}, TypeError, "pixel_centre: expected a number"),
    ({"channels": "Z,depths"}, ValueError, r"channels: there is no channel 'depths'; .*; did you mean 'depth'\?"),
    ({"channels": ("normals",)}, ValueError, r"channels: there is no channel 'normals'; .*; did you mean 'normal'\?"),
    ({"channels": (1,)}, TypeError, "channels: expected names, found 1"),
    ({"channels": ()}, ValueError, "channels: expected at least one"),
    ({"channels": ("Y",)}, ValueError, "channels: there is no channel 'Y'; there are Z, A, .* valid, depth, .* and mask$"),
    ({"near": -1}, ValueError, "near"),
    ({"near": "x"}, TypeError, "near: expected a number"),
    ({"far": 0}, ValueError, "far"),
    ({"cull": "both"}, ValueError, "cull: expected 'back', 'front', 'none', found 'both'"),
    ({"dtype": np.float16}, TypeError, "dtype: expected float32, float64 or uint16, found float16"),
    ({"dtype": "nonsense"}, TypeError, "dtype: expected float32"),
    ({"dtype": np.uint16, "scale": 0}, ValueError, "scale"),
    ({"dtype": np.uint16, "background": 7}, ValueError, "background: codes of uint16"),
    ({"background": "zero"}, TypeError, "background: expected a number, found 'zero'"),
    ({"threads": -1}, ValueError, "threads: expected 0 to 1024, found -1"),
    ({"threads": 1.5}, TypeError, "threads: expected an integer"),
    ({"T": np.zeros((0, 4, 4))}, ValueError, "camera: expected at least one"),
]


@pytest.mark.parametrize("changes, error, words", cases, ids=[f"{list(c)[0]}-{i}" for i, (c, _, _) in enumerate(cases)])
def test_wrong_arguments(changes, error, words):
    with pytest.raises(error, match=words) as raised:
        fathom.render(**{**good, **changes})
    assert "\n" not in str(raised.value)


def test_the_right_arguments():
    assert np.isfinite(fathom.render(**good)["Z"]).sum() == 2


@pytest.mark.parametrize("call", [
    lambda: fathom.Scene().render("camera"),
    lambda: fathom.Scene().render([None]),
    lambda: fathom.probe("scene", None, 0, 0),
    lambda: fathom.visible(fathom.Scene(), None),
    lambda: fathom.render_deep(None, None),
    lambda: fathom.Camera.frame(3),
    lambda: fathom.verify("map", fathom.Scene()),
    lambda: fathom.write_cameras("/dev/null", [1]),
])
def test_wrong_objects_are_type_errors(call):
    with pytest.raises(TypeError, match="expected a|channels"):
        call()


def test_cameras_of_a_stack_are_of_one_size():
    cameras = [fathom.Camera(w, 4, 4, 4, 2, 2, pixel_centre=0.5) for w in (4, 5)]
    with pytest.raises(ValueError, match="cameras of one size, found 4×4 and 5×4"):
        fathom.Scene().render(cameras)


def every_call_with_a_path(map, camera, scene):
    """The argument's name, and what is called with a path."""
    C, deep = fathom.Camera, fathom.render_deep(scene, camera)
    return [
        ("files", fathom.Scene.read), ("file", fathom.Map.read), ("file", fathom.read_map), ("file", map.write),
        ("file", map.write_points), ("file", lambda path: deep.write(path + ".exr" if isinstance(path, str) else path)),
        ("file", C.read), ("file", camera.write), ("file", fathom.read_cameras),
        ("file", lambda path: fathom.write_cameras(path, [camera])),
        ("folder", C.from_colmap), ("file", C.from_nerf), ("file", C.from_bop), ("file", C.from_sfm_data),
        ("file", lambda path: C.from_gltf(path, (4, 4))), ("trajectory", lambda path: C.from_tum(path, "ros")),
        ("images", lambda path: C.from_tum("none", "ros", images=path)), ("folder", C.from_7scenes),
        ("folder", C.from_scannet), ("file", C.from_scannetpp), ("folder", C.from_replica),
        ("calibration", lambda path: C.from_kitti(path, size=(4, 4))),
        ("poses", lambda path: C.from_kitti("none", poses=path, camera=2, size=(4, 4))),
    ]


@pytest.mark.parametrize("path, error", [("a\0b.exr", ValueError), ("\ud800.exr", ValueError), ("\udc41.exr", ValueError),
                                         (3, TypeError), (None, TypeError)])
def test_a_path_that_no_file_can_have(triangle, K, path, error):
    scene = fathom.Scene()
    scene.add_mesh(*triangle)
    camera = fathom.Camera.from_opencv(K, np.eye(4), (8, 6), pixel_centre=0.5)
    for name, call in every_call_with_a_path(scene.render(camera), camera, scene):
        if path is None and name in ("images", "poses"):  # which may be None
            continue
        with pytest.raises(error) as caught:
            call(path)
        assert str(caught.value).startswith(f"{name}: expected "), (name, call, caught.value)
        assert "\n" not in str(caught.value) and "incompatible function arguments" not in str(caught.value)


def test_a_path_may_be_any_bytes(tmp_path, triangle, K):
    scene = fathom.Scene()
    scene.add_mesh(*triangle)
    camera = fathom.Camera.from_opencv(K, np.eye(4), (8, 6), pixel_centre=0.5)
    folder = tmp_path / "\udcff"
    scene.render(camera).write(folder / "map.exr")
    assert np.array_equal(fathom.read_map(folder / "map.exr")["Z"], scene.render(camera)["Z"])
    camera.write(folder / "camera.json")
    assert fathom.Camera.read(folder / "camera.json") == camera
    (folder / "camera.json").write_text("{")
    with pytest.raises(fathom.InputError, match=r"camera\.json: "):
        fathom.Camera.read(folder / "camera.json")


def test_pixel_centre_has_two_spellings_and_no_default():
    british = fathom.render(**good)["Z"]
    american = {**good, "pixel_center": good["pixel_centre"]}
    del american["pixel_centre"]
    assert np.array_equal(fathom.render(**american)["Z"], british)
    with pytest.raises(TypeError, match="pixel_centre: it is given twice"):
        fathom.render(**good, pixel_center=0)
    assert fathom.Camera(4, 4, 4, 4, 2, 2, pixel_center=0).pixel_centre == 0
    poses = dict(direction="world-to-camera", axes="opencv")
    without = {name: value for name, value in good.items() if name != "pixel_centre"}
    for call in (lambda: fathom.render(**without), lambda: fathom.Camera(4, 4, 4, 4, 2, 2),
                 lambda: fathom.Camera.from_opencv(K, np.eye(4), (4, 4)),
                 lambda: fathom.Camera.from_matrices(K, [np.eye(4)], (4, 4), **poses)):
        with pytest.raises(TypeError, match=r"^pixel_centre: missing; expected .*: 0.5 \(COLMAP, OpenGL, NeRF\) or 0 \(OpenCV"):
            call()


def test_channels_may_be_one_text_as_on_the_command_line():
    maps = fathom.render(**good, channels="Z,id")
    assert list(maps) == ["Z", "id"]
    assert list(fathom.render(**good, channels="Z")) == ["Z"]
