"""fathom doctor: data sets from exact depths, into which NumPy puts one fault or two; each fault is named, and the printed
command makes cameras and depth images with which all is well. Right data sets, with noise and holes too, have no fault."""

import copy
import json
import os
import shlex
import struct
import subprocess
import zlib

import fathom
import numpy as np
import pytest

root = os.environ["FATHOM_SOURCE"]
size = (240, 180)
# scripts/check-long tries every fault on more scenes, with all five views.
thorough = os.environ.get("FATHOM_DOCTOR") == "thorough"
few_views = None if thorough else 3


def program(*arguments, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([os.environ["FATHOM_PROGRAM"], *map(str, arguments)], capture_output=True, text=True, timeout=300,
                          env=environment, **options)


def orbit(mesh, *more):
    ran = program("camera", "orbit", os.path.join(root, mesh), "--views", 5, "--size", "{}x{}".format(*size), *more, check=True)
    return json.loads(ran.stdout)


def inside(*eyes):
    """Cameras in the room that look at the animal, from different sides."""
    cameras = []
    for eye in eyes:
        ran = program("camera", "look-at", "--eye", eye, "--target", "0.3,-0.2,-4", "--fov", 70, "--size",
                      "{}x{}".format(*size), check=True)
        cameras.append(json.loads(ran.stdout))
    return cameras


scenes = {
    "spot": ("data/meshes/spot.obj", lambda: orbit("data/meshes/spot.obj", "--view", "35,25")),
    "teapot": ("data/meshes/teapot.obj", lambda: orbit("data/meshes/teapot.obj", "--view", "10,35", "--fov", 60)),
    "house": ("data/meshes/house.glb", lambda: orbit("data/meshes/house.glb", "--view", "20,15")),
    "room": ("data/scenes/room.json", lambda: inside("-0.9,0.5,-1.2", "0.8,0.2,-1", "-0.4,0.7,-2", "0.6,-0.5,-1.5")),
    "pair": ("data/scenes/pair.json", lambda: orbit("data/scenes/pair.json", "--view", "35,25")),
}


def png(codes):
    """A 16-bit grey PNG."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in codes)
    header = struct.pack(">IIBBBBB", codes.shape[1], codes.shape[0], 16, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def put_lens(camera, model, numbers):
    for key in ("projection", "k1", "k2", "k3", "k4", "p1", "p2"):
        camera.pop(key, None)
    camera["model"] = model
    camera.update(numbers)


class Data:
    """Exact depths of a scene, which faults change afterwards."""

    def __init__(self, name, lens=None, views=None):
        self.mesh = os.path.join(root, scenes[name][0])
        self.cameras = scenes[name][1]()[:views]
        for i, camera in enumerate(self.cameras):
            camera["name"] = f"view{i}"
            if lens:
                put_lens(camera, *lens)
        self.render()

    def render(self):
        scene = fathom.Scene.read(self.mesh)
        maps = [scene.render(fathom.Camera.from_json(json.dumps(c)), channels=["Z", "distance"]) for c in self.cameras]
        self.depth = [np.array(m["Z"], dtype=float) for m in maps]
        self.distance = [np.array(m["distance"], dtype=float) for m in maps]
        self.codes = None

    def poses(self, change):
        for camera in self.cameras:
            matrix = np.vstack([camera["world_to_camera"], [0, 0, 0, 1]])
            camera["world_to_camera"] = change(matrix)[:3].tolist()

    def encode(self, per_unit, rounding=np.rint):
        self.codes = [np.where(np.isfinite(d), rounding(d * per_unit), 0) for d in self.depth]

    def write(self, folder):
        (folder / "depth").mkdir()
        (folder / "cameras.json").write_text(json.dumps(self.cameras))
        for i, camera in enumerate(self.cameras):
            if self.codes is None:
                np.save(folder / "depth" / f"view{i}.npy", self.depth[i])
            else:
                (folder / "depth" / f"view{i}.png").write_bytes(png(self.codes[i].astype(np.uint16)))
        suffix = "npy" if self.codes is None else "png"
        return ["doctor", self.mesh, "--camera", "cameras.json", "--depth", f"depth/{{stem}}.{suffix}"]


def examine(arguments, folder):
    ran = program(*arguments, "--json", cwd=folder)
    assert ran.returncode in (0, 1), ran.stderr
    answer = json.loads(ran.stdout)
    assert ran.returncode == (0 if answer["verdict"] == "well" else 1)
    return answer


def names(answer):
    return [fault["name"] for fault in answer["faults"]]


def rotation(*rows):
    matrix = np.eye(4)
    matrix[:3, :3] = rows
    return matrix


opengl = np.diag([1.0, -1, -1, 1])
z_up = rotation((1, 0, 0), (0, 0, -1), (0, 1, 0))  # y of the mesh is z of the cameras


# The faults. Each takes right data and makes it wrong.

def camera_axes(data):
    data.poses(lambda m: opengl @ m)


def world_axes(data):
    data.poses(lambda m: m @ np.linalg.inv(z_up))


def camera_to_world(data):
    data.poses(np.linalg.inv)


def camera_to_world_of_opengl(data):
    data.poses(lambda m: np.linalg.inv(opengl @ m))


def millimetre_positions(data):
    def scaled(m):
        m = m.copy()
        m[:3, 3] *= 1000
        return m
    data.poses(scaled)


def units(data):
    """Cameras and depths in millimetres, the mesh in metres."""
    millimetre_positions(data)
    data.depth = [1000 * d for d in data.depth]


def depth_scale(data):
    data.depth = [5 * d for d in data.depth]


def ray_distance(data):
    data.depth = data.distance


def half_pixel(data):
    for camera in data.cameras:
        camera["cx"] -= 0.5
        camera["cy"] -= 0.5


def half_pixel_of_columns(data):
    for camera in data.cameras:
        camera["cx"] += 0.5


def every_second_pixel(data):
    """As cv2.INTER_NEAREST halves an image: pixel (x, y) is pixel (2x, 2y)."""
    halved = copy.deepcopy(data.cameras)
    halved_size(data)
    data.render()
    data.depth = [d[::2, ::2].copy() for d in data.depth]
    data.cameras = halved


def mirrored(data):
    data.depth = [d[:, ::-1].copy() for d in data.depth]


def upside_down(data):
    data.depth = [d[::-1].copy() for d in data.depth]


def turned(data):
    data.depth = [np.rot90(d).copy() for d in data.depth]


def halved_size(data):
    """Cameras of images of twice the size."""
    for camera in data.cameras:
        for key in ("fx", "fy", "cx", "cy", "width", "height"):
            camera[key] *= 2


def middle(data):
    for camera in data.cameras:
        camera["width"] += 80
        camera["height"] += 60
        camera["cx"] += 40
        camera["cy"] += 30


def truncated(data):
    data.encode(1000, np.floor)


def clipped(data):
    limit = np.quantile(np.concatenate([d[np.isfinite(d)] for d in data.depth]), 0.7)
    data.depth = [np.where(np.isfinite(d), np.minimum(d, limit), d) for d in data.depth]


def no_value(data):
    data.encode(1000)
    data.codes = [np.where(c == 0, 65535, c) for c in data.codes]


single = {
    camera_axes: "camera-axes", world_axes: "world-axes", camera_to_world: "camera-to-world",
    millimetre_positions: "units", units: "units", depth_scale: "depth-scale", ray_distance: "ray-distance",
    half_pixel: "half-pixel", half_pixel_of_columns: "half-pixel",
    every_second_pixel: "half-pixel", mirrored: "mirrored", upside_down: "mirrored",
    turned: "mirrored", halved_size: "image-size", middle: "image-size", truncated: "truncated-codes", clipped: "clipped",
}


def check(data, folder, expected):
    arguments = data.write(folder)
    answer = examine(arguments, folder)
    assert sorted(names(answer)) == sorted(expected), answer
    assert answer["verdict"] == "faulty"
    for fault in answer["faults"]:
        assert fault["after"]["explained"] > fault["before"]["explained"]
    words = shlex.split(answer["command"])
    assert words[:2] == ["fathom", "doctor"]
    program(*words[1:], cwd=folder)
    right = examine(["doctor", data.mesh, "--camera", "corrected/cameras.json", "--depth", "corrected/depth/{stem}.exr"],
                    folder)
    assert right["verdict"] == "well" and not right["faults"], right
    return answer


@pytest.mark.parametrize("fault", single, ids=lambda f: f.__name__)
@pytest.mark.parametrize("scene", ["spot", "room", "house"] if thorough else ["spot"])
def test_fault_is_named_and_corrected(tmp_path, scene, fault):
    data = Data(scene, views=few_views)
    fault(data)
    check(data, tmp_path, [single[fault]])


pairs_of_faults = [
    (camera_axes, units), (camera_axes, depth_scale), (camera_axes, half_pixel), (camera_axes, ray_distance),
    (camera_axes, mirrored), (camera_to_world, depth_scale), (camera_to_world, ray_distance), (world_axes, camera_axes),
    (world_axes, millimetre_positions), (world_axes, half_pixel), (mirrored, depth_scale), (ray_distance, upside_down),
    (ray_distance, depth_scale), (depth_scale, half_pixel), (ray_distance, half_pixel), (half_pixel, truncated),
    (halved_size, camera_axes)]


@pytest.mark.parametrize("first, second", pairs_of_faults if thorough else pairs_of_faults[::4],
                         ids=lambda f: f.__name__)
@pytest.mark.parametrize("scene", ["spot", "room"] if thorough else ["spot"])
def test_two_faults_are_named_and_corrected(tmp_path, scene, first, second):
    data = Data(scene, views=few_views)
    first(data)
    second(data)
    check(data, tmp_path, [single[first], single[second]])


def test_inverse_of_opengl_is_two_faults(tmp_path):
    data = Data("room")
    camera_to_world_of_opengl(data)
    check(data, tmp_path, ["camera-to-world", "camera-axes"])


def test_world_to_camera_of_opengl_is_one_fault(tmp_path):
    """A transforms.json whose matrices were not inverted, imported as NeRF's."""
    data = Data("spot")
    data.poses(lambda m: opengl @ np.linalg.inv(opengl @ m))
    answer = check(data, tmp_path, ["camera-to-world"])
    assert "read as camera to world with OpenGL's axes" in answer["faults"][0]["text"]


def test_scale_of_codes_is_an_option(tmp_path):
    data = Data("spot")
    data.encode(5000)
    arguments = data.write(tmp_path)
    answer = examine(arguments, tmp_path)
    assert names(answer) == ["depth-scale"] and "--png-scale 5000 reads" in answer["faults"][0]["text"]
    assert examine([*arguments, "--png-scale", "5000"], tmp_path)["verdict"] == "well"


def test_cameras_that_miss_the_mesh_have_no_residual(tmp_path):
    data = Data("spot")
    camera_axes(data)
    arguments = data.write(tmp_path)
    given = examine(arguments, tmp_path)["given"]
    assert given["pixels"] > 0 and given["median_residual"] is None and given["largest_residual"] is None
    assert "explained: the mesh is at none of them\n" in program(*arguments, cwd=tmp_path).stdout


def test_65535_is_no_value(tmp_path):
    data = Data("spot")
    no_value(data)
    answer = check(data, tmp_path, ["no-value"])
    evidence = answer["faults"][0]
    surfaces = sum(int(np.isfinite(d).sum()) for d in data.depth)
    assert evidence["before"] == answer["given"] and evidence["after"] == answer["corrected"]
    assert evidence["before"]["pixels"] == len(data.cameras) * size[0] * size[1]  # 65535 is a depth
    assert evidence["after"]["pixels"] == surfaces and evidence["after"]["silhouettes"] == 1


barrel = ("OPENCV", {"k1": -0.25, "k2": 0.08, "p1": 0.01, "p2": -0.015})


lenses_of_images = {
    "ignored": (None, "do not have the lens"),
    "swapped": (("OPENCV", {"k1": -0.25, "k2": 0.08, "p1": -0.015, "p2": 0.01}), "swapped"),
    "fisheye": (("OPENCV_FISHEYE", {"k1": -0.25, "k2": 0.08, "k3": 0.01, "k4": -0.015}), "OPENCV_FISHEYE"),
    "k3": (("FULL_OPENCV", {"k1": -0.25, "k2": 0.08, "k3": 0.01}), "k3")}


@pytest.mark.parametrize("name", lenses_of_images if thorough else ["ignored", "swapped"])
def test_lens_is_named_and_corrected(tmp_path, name):
    made_with, text = lenses_of_images[name]
    data = Data("room", made_with, views=None if thorough else 2)
    for camera in data.cameras:
        put_lens(camera, *barrel)
    assert text in check(data, tmp_path, ["lens"])["faults"][0]["text"]


def noisy(data, of_depth, holes):
    random = np.random.default_rng(7)
    for i, depth in enumerate(data.depth):
        depth = depth * (1 + of_depth * random.standard_normal(depth.shape))
        depth[random.random(depth.shape) < holes] = np.inf
        data.depth[i] = depth


@pytest.mark.parametrize("scene", scenes)
@pytest.mark.parametrize("kind", ["exact", "codes", "coarse-codes", "sensor", "bad-sensor", "lens"] if thorough
                         else ["coarse-codes", "bad-sensor"])
def test_right_data_has_no_fault(tmp_path, scene, kind):
    data = Data(scene, barrel if kind == "lens" else None, views=few_views)
    if "sensor" in kind:
        noisy(data, *((0.005, 0.1) if kind == "sensor" else (0.02, 0.4)))
    if kind in ("codes", "sensor", "bad-sensor"):
        data.encode(1000)
    if kind == "coarse-codes":
        data.encode(100)
    arguments = data.write(tmp_path)
    if kind == "coarse-codes":
        arguments += ["--png-scale", "100"]
    answer = examine(arguments, tmp_path)
    assert not answer["faults"], answer
    assert answer["verdict"] == "well", answer
    assert answer["given"]["explained"] > 0.9


@pytest.mark.parametrize("rounding", [lambda z: np.round(z, 3), lambda z: np.round(z, 2), np.float16],
                         ids=["millimetres", "centimetres", "half"])
def test_rounded_depths_of_a_wall_are_not_clipped(tmp_path, rounding):
    """The wall is the farthest surface, and its depth is rounded down."""
    corners = [(-3, -3, 3.0004), (3, -3, 3.0004), (3, 3, 3.0004), (-3, 3, 3.0004),
               (-0.5, -0.5, 2), (0.6, -0.5, 2.2), (0.6, 0.4, 2.4), (-0.5, 0.3, 2.1)]
    lines = ["v {} {} {}\n".format(*corner) for corner in corners]
    (tmp_path / "wall.obj").write_text("".join(lines) + "f 1 2 3 4\nf 5 6 7\nf 5 7 8\n")
    camera = {"width": 160, "height": 120, "fx": 150, "fy": 150, "cx": 80, "cy": 60, "pixel_centre": 0.5,
              "world_to_camera": np.eye(4).tolist()}
    (tmp_path / "camera.json").write_text(json.dumps(camera))
    program("render", "wall.obj", "--camera", "camera.json", "-o", "exact.npy", cwd=tmp_path, check=True)
    np.save(tmp_path / "depth.npy", rounding(np.load(tmp_path / "exact.npy")).astype(np.float32))
    ran = program("doctor", "wall.obj", "--camera", "camera.json", "--depth", "depth.npy", cwd=tmp_path)
    assert ran.returncode == 0 and ran.stdout.startswith("all is well\n"), ran.stdout + ran.stderr


@pytest.mark.parametrize("fault", [camera_axes, camera_to_world, units, ray_distance, mirrored], ids=lambda f: f.__name__)
def test_fault_is_named_under_noise(tmp_path, fault):
    data = Data("room", views=few_views)
    fault(data)
    noisy(data, 0.01, 0.2)
    answer = examine(data.write(tmp_path), tmp_path)
    assert names(answer) == [single[fault]], answer


@pytest.mark.parametrize("scene", ["spot", "room"])
def test_noise_is_a_number(tmp_path, scene):
    """Noise of 5 % puts two thirds of the pixels beyond 2 %."""
    data = Data(scene)
    noisy(data, 0.05, 0.1)
    arguments = data.write(tmp_path)
    answer = examine(arguments, tmp_path)
    assert answer["verdict"] == "well" and not answer["faults"], answer
    assert abs(answer["noise"]["median"]) < 0.001 and abs(answer["noise"]["spread"] - 0.05) < 0.001
    text = program(*arguments, cwd=tmp_path).stdout
    assert text.startswith("no fault, but noisy depths\n") and "with a spread of 5 %" in text, text


def test_fault_is_named_under_heavy_noise(tmp_path):
    data = Data("room")
    camera_axes(data)
    noisy(data, 0.05, 0.1)
    answer = examine(data.write(tmp_path), tmp_path)
    assert names(answer) == ["camera-axes"] and abs(answer["noise"]["spread"] - 0.05) < 0.001, answer


def test_zero_of_codes_is_a_note(tmp_path):
    data = Data("spot")
    data.encode(1000)
    answer = examine(data.write(tmp_path), tmp_path)
    zeros = sum(int((c == 0).sum()) for c in data.codes)
    assert answer["notes"] == [f"0 stands for no value, in {zeros} pixels"]


def test_symmetric_mesh_has_the_simplest_fault(tmp_path):
    """A cube looks the same with several world axes, each of which would be a second fault."""
    data = Data("spot")
    data.mesh = os.path.join(root, "data/meshes/cube.obj")
    data.cameras = orbit("data/meshes/cube.obj", "--view", "35,25")
    for i, camera in enumerate(data.cameras):
        camera["name"] = f"view{i}"
    data.render()
    camera_axes(data)
    answer = examine(data.write(tmp_path), tmp_path)
    assert answer["verdict"] == "faulty" and names(answer) == ["camera-axes"]


def test_nothing_explains_another_mesh(tmp_path):
    data = Data("teapot")
    data.mesh = os.path.join(root, "data/meshes/house.glb")
    answer = examine(data.write(tmp_path), tmp_path)
    assert answer["verdict"] == "unknown" and answer["command"] is None, answer
    assert "the best attempt explains" in answer["notes"][0] and answer["noise"]["same_side"] > 0.9, answer


def test_foreign_files_are_not_replaced(tmp_path):
    """A foreign file ends the command before the depth images are read."""
    data = Data("spot")
    camera_axes(data)
    arguments = data.write(tmp_path)
    corrected = tmp_path / "corrected"
    for file in ("cameras.json", "depth/view3.exr"):
        (corrected / file).parent.mkdir(parents=True, exist_ok=True)
        (corrected / file).write_text("mine")
        ran = program(*arguments[:-1], "depth/missing-{stem}.npy", "-o", "corrected", cwd=tmp_path)
        assert ran.returncode == 2 and not ran.stdout
        assert ran.stderr == (f"fathom: error: corrected/{file}: exists and was not made by this command; name another folder, or "
                              "give --overwrite\n")
        assert (corrected / file).read_text() == "mine"
        (corrected / file).unlink()
    (corrected / "cameras.json").write_text("mine")
    for more in (["--overwrite"], []):  # the second run replaces the files of the first
        assert program(*arguments, "-o", "corrected", *more, cwd=tmp_path).returncode == 1
        assert json.loads((corrected / "cameras.json").read_text())[0]["name"] == "view0"


def test_output_is_a_folder_and_no_input(tmp_path):
    data = Data("spot")
    arguments = data.write(tmp_path)
    ran = program(*arguments, "-o", "-", cwd=tmp_path)
    assert ran.returncode == 2 and ran.stderr.count("\n") == 1 and "name one in place of '-'" in ran.stderr, ran.stderr
    assert not (tmp_path / "-").exists()
    ran = program(*arguments, "-o", ".", "--overwrite", cwd=tmp_path)
    assert ran.returncode == 2 and ran.stderr == "fathom: error: ./cameras.json: is an input of this command; name another output\n"


def test_python_has_the_figures_and_the_command(tmp_path, monkeypatch):
    data = Data("spot")
    ray_distance(data)
    data.encode(5000)
    arguments = data.write(tmp_path)
    answer = examine([*arguments, "--png-scale", "5000", "--images", "3"], tmp_path)
    monkeypatch.chdir(tmp_path)
    files = [f"depth/view{i}.png" for i in range(len(data.cameras))]
    cameras = fathom.read_cameras("cameras.json")
    codes = [c.astype(np.uint16) for c in data.codes]
    by_file = fathom.doctor(data.mesh, "cameras.json", files, png_scale=5000, images=3)
    by_array = fathom.doctor(fathom.Scene.read(data.mesh), cameras, codes, png_scale=5000, images=3)
    for found in (by_file, by_array):
        assert found.verdict == "faulty" and not found.is_good and found.images == 3
        assert [fault._asdict() | {"before": fault.before._asdict(), "after": fault.after._asdict()} for fault in found.faults] == [
            figures(fault) for fault in answer["faults"]]
        assert found.corrected._asdict() == figures(answer["corrected"]) and found.notes == answer["notes"]
        assert list(found.noise) == list(answer["noise"].values())
    assert by_array.command is None and "to correct" not in by_array.report()
    words = shlex.split(by_file.command)
    assert words[:2] == ["fathom", "doctor"] and program(*words[1:]).returncode == 1
    for i, camera in enumerate(fathom.read_cameras("corrected/cameras.json")):
        map = fathom.read_map(f"corrected/depth/view{i}.exr")
        for found, depths in ((by_file, files[i]), (by_array, codes[i])):
            corrected, depth = found.correct(cameras[i], depths)
            assert corrected.to_json() == camera.to_json() and np.array_equal(depth["Z"], map["Z"])
    assert fathom.doctor(data.mesh, "corrected/cameras.json",
                         [f"corrected/depth/view{i}.exr" for i in range(len(files))]).is_good
    with pytest.raises(ValueError, match="a depth image for each of 5 cameras, found 4"):
        fathom.doctor(data.mesh, "cameras.json", files[1:])
    with pytest.raises(ValueError, match="5 cameras, found 1; patterns are for the program: list the names of the files"):
        fathom.doctor(data.mesh, cameras, "depth/view{index}.png")
    assert str(by_array) == by_array.report().rstrip() and "ray-distance: the depths are distances" in str(by_array)
    with pytest.raises(fathom.InputError, match="no pixel has a depth"):
        fathom.doctor(data.mesh, cameras[0], np.zeros(size[::-1]))


def figures(answer):
    """Figures of JSON with the names of Python, which are the same."""
    named = {name: figures(value) if isinstance(value, dict) else value for name, value in answer.items()}
    return named | {"alternatives": tuple(named.get("alternatives", ()))} if "text" in named else named


def test_two_explanations_are_not_told_apart(tmp_path):
    """A box looks the same turned by half about x, so both quarter turns of the world explain the images."""
    box = [(x, y, z) for x in (-1, 1) for y in (-0.6, 0.6) for z in (-0.4, 0.4)]
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    (tmp_path / "box.obj").write_text("".join("v {} {} {}\n".format(*corner) for corner in box) +
                                      "".join("f {} {} {} {}\n".format(*quad) for quad in quads))
    data = Data("spot")
    data.mesh = str(tmp_path / "box.obj")
    data.cameras = orbit(data.mesh, "--view", "35,25")
    for i, camera in enumerate(data.cameras):
        camera["name"] = f"view{i}"
    data.render()
    world_axes(data)
    arguments = data.write(tmp_path)
    answer = examine(arguments, tmp_path)
    assert answer["verdict"] == "unclear" and answer["command"] is None and names(answer) == ["world-axes"], answer
    texts = [answer["faults"][0]["text"], *answer["faults"][0]["alternatives"]]
    assert sum("the cameras have z up, the mesh y" in text for text in texts) == 1, texts
    assert sum("the cameras have y up, the mesh z" in text for text in texts) == 1, texts
    ran = program(*arguments, "-o", "corrected", cwd=tmp_path)
    assert ran.returncode == 3 and "not written: the faults are not certain" in ran.stderr and not ran.stdout
    assert not (tmp_path / "corrected").exists()
    assert program(*arguments, cwd=tmp_path).stdout.startswith("cannot tell: several explanations fit equally well\n")


def test_every_image_that_is_asked_for_counts(tmp_path):
    data = Data("spot")
    data.cameras = [dict(camera, name=f"view{5 * k + i}") for k in range(2) for i, camera in enumerate(data.cameras)]
    data.depth *= 2
    arguments = data.write(tmp_path)
    pixels = [examine([*arguments, "--images", n], tmp_path)["given"]["pixels"] for n in (5, 10)]
    assert pixels[1] > 1.9 * pixels[0]
