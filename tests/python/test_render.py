"""fathom.render() and Scene.render(): judged by closed forms over fractions, and by the program."""

from fractions import Fraction

import numpy as np
import pytest

import fathom

size = (64, 48)
identity = np.eye(4)


def plane_depth(x, y, K, pixel_centre):
    """The depth of z = 4 + X/2 at the centre of a pixel, rounded once: X = z·a gives z = 4 / (1 − a/2)."""
    a = (Fraction(x) + Fraction(pixel_centre) - Fraction(K[0, 2])) / Fraction(K[0, 0])
    return np.float32(float(4 / (1 - a / 2)))


@pytest.mark.parametrize("pixel_centre", [0.5, 0, 0.25])
def test_every_depth_is_that_of_the_plane(triangle, K, pixel_centre):
    depths = fathom.render(*triangle, K, identity, size, pixel_centre=pixel_centre)["Z"]
    assert depths.shape == (48, 64) and depths.dtype == np.float32
    seen = np.argwhere(np.isfinite(depths))
    assert len(seen) > 500
    for y, x in seen:
        assert depths[y, x] == plane_depth(int(x), int(y), K, pixel_centre)


def test_pixel_centre_moves_the_image_and_has_no_default(triangle, K):
    with pytest.raises(TypeError, match="pixel_centre"):
        fathom.render(*triangle, K, identity, size)
    moved = K.copy()
    moved[:2, 2] += 0.5
    assert np.array_equal(
        fathom.render(*triangle, K, identity, size, pixel_centre=0)["Z"],
        fathom.render(*triangle, moved, identity, size, pixel_centre=0.5)["Z"],
    )


def test_T_is_world_to_camera_in_opencv_axes(triangle, K):
    vertices, faces = triangle
    moved = np.eye(4)
    moved[:3, 3] = (0.25, -0.5, 1)
    assert np.array_equal(
        fathom.render(vertices, faces, K, moved, size, pixel_centre=0.5)["Z"],
        fathom.render(vertices + moved[:3, 3], faces, K, identity[:3], size, pixel_centre=0.5)["Z"],
    )
    below = fathom.render(vertices + (0, 1, 0), faces, K, identity, size, pixel_centre=0.5)["Z"]
    assert np.isfinite(below[-1]).any() and not np.isfinite(below[0]).any(), "y points down"


def test_maps_are_those_of_the_program(spot, run_program, tmp_path):
    camera = fathom.Camera.frame(spot, size=(160, 90))
    camera.write(tmp_path / "camera.json")
    run_program("render", _spot(), "--camera", tmp_path / "camera.json",
                "--channels", "Z,A,id,N,P,bary,distance,Zlow,face,object,Nc,Ns", "-o", tmp_path / "map.exr")
    expected = fathom.read_map(tmp_path / "map.exr")
    found = spot.render(camera, channels=list(expected))
    assert set(found) == {"Z", "A", "id", "N", "P", "bary", "distance", "Zlow", "face", "object", "Nc", "Ns"}
    assert found["N"].shape == (90, 160, 3) and found["bary"].shape == (90, 160, 2)
    for name, values in expected.items():
        assert values.dtype == found[name].dtype
        assert values.tobytes() == found[name].tobytes(), name
    assert expected.camera == camera == found.camera


def _spot():
    from conftest import source

    return source / "data/meshes/spot.obj"


def test_shading_normals_are_of_the_file_or_of_the_triangles(tmp_path):
    square = "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\nvn 3 0 -4\nf 1//1 4//1 3//1 2//1\n"
    (tmp_path / "square.obj").write_text(square)
    scene = fathom.Scene.read(tmp_path / "square.obj")
    camera = fathom.Camera.from_opencv([[4, 0, 2], [0, 4, 2], [0, 0, 1]], identity, (4, 4), pixel_centre=0.5)
    maps = {source: scene.render(camera, channels=("Nc", "Ns"), normals=source) for source in ("file", "vertex", "place")}
    assert maps["file"]["Ns"].shape == (4, 4, 3)
    assert (maps["file"]["Ns"] == np.float32([0.6, 0, -0.8])).all()
    for source in ("vertex", "place"):
        assert (maps[source]["Ns"] == [0, 0, -1]).all() and (maps[source]["Nc"] == [0, 0, -1]).all()
        assert maps[source].metadata["fathom.normals"] == source
        assert fathom.verify(maps[source], scene, pixels=16).differing == 0
    assert fathom.verify(maps["file"], scene, pixels=16).differing == 0
    with pytest.raises(ValueError, match="normals: expected 'file', 'vertex', 'place'"):
        scene.render(camera, normals="smooth")


def test_both_engines_agree(spot):
    camera = fathom.Camera.frame(spot, size=(40, 30))
    channels = ("Z", "A", "id", "N")
    fast, reference = (spot.render(camera, channels=channels, engine=engine) for engine in ("fast", "reference"))
    for name in channels:
        assert fast[name].tobytes() == reference[name].tobytes()


def test_a_stack_of_cameras_gives_a_stack_of_maps(spot):
    for count in (3, 40):  # a map after another, and one in each thread
        cameras = fathom.Camera.orbit_scene(spot, count, size=(48, 32))
        stack = spot.render(cameras, channels=("Z", "N", "id"))
        assert stack["Z"].shape == (count, 32, 48) and stack["N"].shape == (count, 32, 48, 3)
        for i, camera in enumerate(cameras):
            for name, values in spot.render(camera, channels=("Z", "N", "id")).items():
                assert values.tobytes() == stack[name][i].tobytes()


def test_each_map_of_a_stack_knows_its_camera(spot, tmp_path):
    cameras = fathom.Camera.orbit_scene(spot, 3, size=(48, 32))
    stack = spot.render(cameras, channels=("Z", "N"), background=0)
    assert stack.cameras == cameras and stack.camera is None and stack.background == 0
    for i, camera in enumerate(cameras):
        one, single = stack.view(i), spot.render(camera, channels=("Z", "N"), background=0)
        assert one.cameras == [camera] and one.metadata == single.metadata and one.background == 0
        assert np.shares_memory(one["Z"], stack["Z"]) and one["N"].shape == (32, 48, 3)
        one.write(tmp_path / "one.exr"), single.write(tmp_path / "single.exr")
        assert (tmp_path / "one.exr").read_bytes() == (tmp_path / "single.exr").read_bytes()
    with pytest.raises(ValueError, match=r"it is a stack of 3 maps: take one by view\(i\)"):
        stack.write(tmp_path / "stack.exr")
    with pytest.raises(ValueError, match="i: expected 0 to 2, found 3"):
        stack.view(3)
    with pytest.raises(ValueError, match="view: the map is no stack"):
        stack.view(0).view(0)


def test_stacks_of_matrices(triangle, K):
    poses = np.stack([np.eye(4), np.eye(4)])
    poses[1, 0, 3] = 0.5
    stack = fathom.render(*triangle, K, poses, size, pixel_centre=0.5)["Z"]
    for i in range(2):
        assert np.array_equal(stack[i], fathom.render(*triangle, K, poses[i], size, pixel_centre=0.5)["Z"])
    both = fathom.render(*triangle, np.stack([K, K]), poses[:, :3], size, pixel_centre=0.5)["Z"]
    assert np.array_equal(both, stack)
    assert fathom.render(*triangle, K, poses[:1], size, pixel_centre=0.5)["Z"].shape == (1, 48, 64)
    with pytest.raises(ValueError, match="K and T: expected stacks of one length, found 3 and 2"):
        fathom.render(*triangle, np.stack([K] * 3), poses, size, pixel_centre=0.5)


@pytest.mark.parametrize("vertex_type", [np.float64, np.float32, ">f8", np.int16])
@pytest.mark.parametrize("face_type", [np.uint32, np.int32, np.int64, np.uint8, ">i4"])
def test_any_type_and_order_of_arrays_gives_the_same_map(triangle, K, vertex_type, face_type):
    vertices, faces = triangle
    expected = fathom.render(vertices, faces, K, identity, size, pixel_centre=0.5)["Z"]
    for arrange in (np.ascontiguousarray, np.asfortranarray, lambda a: np.repeat(a, 2, axis=0)[::2]):
        found = fathom.render(arrange(vertices.astype(vertex_type)), arrange(faces.astype(face_type)), K, identity, size,
                              pixel_centre=0.5)
        assert np.array_equal(found["Z"], expected)


def test_float32_is_taken_as_the_number_that_it_is(K):
    tenth = np.array([(-1, -1, 0.1), (1, -1, 0.1), (0, 1, 0.1)], np.float32)
    depths = fathom.render(tenth, [(0, 1, 2)], K, identity, size, pixel_centre=0.5, dtype=np.float64)["Z"]
    assert depths[24, 32] == float(np.float32(0.1))


def test_arrays_that_fit_are_not_copied(triangle):
    for face_type in (np.uint32, np.int32):
        vertices, faces = triangle[0], triangle[1].astype(face_type)
        scene = fathom.Scene()
        scene.add_mesh(vertices, faces)
        assert np.shares_memory(scene.vertices(), vertices) and np.shares_memory(scene.faces(), faces)
    read_only = triangle[0].copy()
    read_only.flags.writeable = False
    scene.add_mesh(read_only, faces)
    assert np.shares_memory(scene.vertices(1), read_only)


def test_results_own_their_memory(triangle, K):
    vertices, faces = (array.copy() for array in triangle)
    depths = fathom.render(vertices, faces, K, identity, size, pixel_centre=0.5)["Z"]
    before = depths.copy()
    vertices[:] = 0
    del vertices, faces
    for _ in range(20):
        fathom.render(*triangle, K, identity, size, pixel_centre=0.5, near=4.5)
    assert np.array_equal(depths, before) and depths.flags.writeable and depths.flags.c_contiguous


def test_options(triangle, K):
    def render(**options):
        return fathom.render(*triangle, K, identity, size, pixel_centre=0.5, **options)

    whole = render()["Z"]
    behind = render(near=4)["Z"]
    assert np.array_equal(behind, np.where(whole >= 4, whole, np.inf))
    assert np.array_equal(render(far=4)["Z"], np.where(whole <= 4, whole, np.inf))
    kinds = [np.isfinite(render(cull=cull)["Z"]).any() for cull in ("none", "back", "front")]
    assert kinds[0] and kinds[1] != kinds[2]
    wide = render(dtype="float64")["Z"]
    assert wide.dtype == np.float64 and np.array_equal(wide.astype(np.float32), whole)
    codes = render(dtype=np.uint16, scale=1000)
    assert codes.scale == 1000
    assert np.array_equal(codes["Z"], np.where(np.isfinite(wide), np.rint(np.where(np.isfinite(wide), wide, 0) * 1000), 0))
    stack = fathom.render(*triangle, K, np.stack([identity] * 2), size, pixel_centre=0.5, dtype=np.uint16, scale=1000)
    assert stack.scale == 1000 and np.array_equal(stack["Z"][1], codes["Z"])
    for threads in (1, 2, 7):
        assert np.array_equal(render(threads=threads)["Z"], whole)


@pytest.mark.parametrize("background", [0, np.nan, "nan", -1.5, "inf", np.inf])
def test_background(triangle, K, background):
    whole = fathom.render(*triangle, K, identity, size, pixel_centre=0.5)["Z"]
    found = fathom.render(*triangle, K, identity, size, pixel_centre=0.5, background=background, channels=("Z", "id"))
    assert np.array_equal(found["Z"], np.where(np.isfinite(whole), whole, np.float32(background)), equal_nan=True)
    assert found["id"][0, 0] == fathom.NO_SURFACE == 2**32 - 1


def test_out_is_written_to_and_returned(spot):
    cameras = fathom.Camera.orbit_scene(spot, 20, size=(48, 32))
    names = ("Z", "id", "N", "A")
    for camera in (cameras[3], cameras[:4], cameras):
        expected = spot.render(camera, channels=names)
        out = {name: np.full_like(values, 77) for name, values in expected.items()}
        found = spot.render(camera, channels=names, out=out)
        for name in names:
            assert found[name] is out[name] and found[name].tobytes() == expected[name].tobytes()
    again = spot.render(cameras[3], channels=names, out=spot.render(cameras[2], channels=names))
    assert again.camera == cameras[3] and again["Z"].tobytes() == spot.render(cameras[3])["Z"].tobytes()


@pytest.mark.parametrize("out, error, words", [
    ([], TypeError, "out: expected a dict of arrays by the names of channels, found list"),
    ({}, ValueError, "out: it has no array for channel Z"),
    ({"Z": [1, 2]}, TypeError, "out: channel Z: expected an array of float32, found list"),
    ({"Z": np.zeros((48, 64))}, TypeError, "out: channel Z: expected an array of float32, found float64"),
    ({"Z": np.zeros((48, 64), ">f4")}, TypeError, "found >f4"),
    ({"Z": np.zeros((64, 48), np.float32)}, ValueError, "out: channel Z: expected shape 48×64, found 64×48"),
    ({"Z": np.zeros((64, 48), np.float32).T}, ValueError, "out: channel Z: expected an array in C order"),
    ({"Z": np.broadcast_to(np.zeros((), np.float32), (48, 64))}, ValueError, "C order"),
])
def test_out_that_does_not_fit(triangle, K, out, error, words):
    with pytest.raises(error, match=words):
        fathom.render(*triangle, K, identity, size, pixel_centre=0.5, out=out)


def test_out_that_is_read_only(triangle, K):
    depths = np.zeros((48, 64), np.float32)
    depths.flags.writeable = False
    with pytest.raises(ValueError, match="out: channel Z: the array is read-only"):
        fathom.render(*triangle, K, identity, size, pixel_centre=0.5, out={"Z": depths})


def test_depths_without_a_code_are_an_output_error(triangle, K):
    with pytest.raises(fathom.OutputError, match="65535") as raised:
        fathom.render(*triangle, K, identity, size, pixel_centre=0.5, dtype=np.uint16, scale=20000)
    assert isinstance(raised.value, OSError)
