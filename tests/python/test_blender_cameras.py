"""Cameras of Blender: docs/blender/export_cameras.py exports them, `fathom camera import blender` imports them, and Fathom's
depths of the inside of a box are those that Cycles renders."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
exporter = source / "docs/blender/export_cameras.py"

# The object's scale has to be ignored; shifts and pixels that are not square count.
draw_a_box = """
import os
import bpy
folder = os.getcwd()
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_cube_add(size=2)
bpy.context.object.scale = (3, 4, 5)
render = scene.render
render.engine = "CYCLES"
render.resolution_x, render.resolution_y, render.resolution_percentage = 48, 32, 50
render.pixel_aspect_x, render.pixel_aspect_y = 1, 1.25
render.threads_mode, render.threads = "FIXED", 1
scene.cycles.device, scene.cycles.samples, scene.cycles.max_bounces = "CPU", 1, 0
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 0.01
layer = scene.view_layers[0]
layer.use_pass_z, layer.use_pass_combined = True, False
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
kinds = {
    "pinhole": {},
    "tall": {"sensor_fit": "VERTICAL", "sensor_height": 20},
    "flat": {"type": "ORTHO", "ortho_scale": 3},
    "panorama": {"panorama_type": "EQUIRECTANGULAR"},
    "part": {"panorama_type": "EQUIRECTANGULAR", "longitude_min": -0.5, "longitude_max": 2, "latitude_min": -1,
             "latitude_max": 0.5},
    "equidistant": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 3.5},
    "equisolid": {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_fov": 3, "fisheye_lens": 12},
    "polynomial": {"panorama_type": "FISHEYE_LENS_POLYNOMIAL", "fisheye_fov": 3, "fisheye_polynomial_k0": 0,
                   "fisheye_polynomial_k1": -0.0625, "fisheye_polynomial_k2": 0.0005,
                   "fisheye_polynomial_k3": -0.00002, "fisheye_polynomial_k4": 0.000001},
    "ball": {"panorama_type": "MIRRORBALL"},
}
for name, properties in kinds.items():
    camera = bpy.data.cameras.new(name)
    holder = bpy.data.objects.new(name, camera)
    holder.location, holder.rotation_euler, holder.scale = (0.5, -0.75, 1), (1.2, 0.3, -0.7), (2, 2, 2)
    scene.collection.objects.link(holder)
    camera.type = "PANO" if "panorama_type" in properties else "PERSP"
    camera.shift_x, camera.shift_y, camera.clip_start = 0.0625, -0.125, 0.01
    lens = camera if hasattr(camera, "panorama_type") or camera.type != "PANO" else camera.cycles
    for key, value in properties.items():
        setattr(lens, key, value)
bpy.context.view_layer.update()
for holder in [holder for holder in scene.objects if holder.type == "CAMERA"]:
    scene.camera = holder
    render.filepath = os.path.join(folder, holder.name + ".exr")
    bpy.ops.render.render(write_still=True)
"""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory, run_program):
    """The folder of Cycles' maps, and the imported cameras by name."""
    folder = tmp_path_factory.mktemp("blender")
    (folder / "draw.py").write_text(draw_a_box)
    subprocess.run(["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python",
                    folder / "draw.py", "--python", exporter, "--", folder / "cameras.json"], cwd=folder, check=True,
                   capture_output=True)
    run_program("camera", "import", "blender", folder / "cameras.json", "-o", folder / "imported.json")
    return folder, {camera.name: camera for camera in fathom.read_cameras(folder / "imported.json")}


@pytest.fixture(scope="module")
def box():
    corners = np.array([(x, y, z) for x in (-3.0, 3.0) for y in (-4.0, 4.0) for z in (-5.0, 5.0)])
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
             (1, 5, 7), (1, 7, 3)]
    scene = fathom.Scene()
    scene.add_mesh(corners, np.array(faces))
    return scene


@pytest.mark.filterwarnings("ignore::fathom.ViewWarning")
@pytest.mark.parametrize("name, hidden_rows", [("pinhole", 0), ("tall", 0), ("flat", 0), ("panorama", 2), ("part", 0),
                                               ("equidistant", 0), ("equisolid", 0), ("ball", 0)])
def test_depths_are_those_of_cycles(drawn, box, name, hidden_rows):
    """Cycles' panoramas go on beyond the pole, where Fathom's pixels have no ray: `hidden_rows`."""
    folder, cameras = drawn
    camera = cameras[name]
    ours = box.render(camera, channels=("Z", "distance"))["Z" if name in ("pinhole", "tall", "flat") else "distance"]
    theirs = next(values for channel, values in fathom.read_map(folder / f"{name}.exr").items() if "Depth" in channel)
    rows = slice(None, camera.height - hidden_rows)
    assert not np.isfinite(ours[camera.height - hidden_rows:]).any()
    seen = theirs[rows] < 1e9
    assert np.array_equal(np.isfinite(ours[rows]), seen) and seen.sum() > 250
    # Samples lie up to 10⁻⁵ pixel off the centre; a pixel of a panorama is 15° wide, and walls are up to 10 away.
    assert np.abs(ours[rows] - theirs[rows])[seen].max() < 1e-4


def test_the_script_reports_a_missing_file_name(tmp_path):
    done = subprocess.run(["blender", "-b", "--factory-startup", "-noaudio", "--python", exporter], cwd=tmp_path,
                          capture_output=True, text=True)
    assert "export_cameras.py: expected -- cameras.json [--animation]" in done.stdout + done.stderr


def test_frames_of_an_animation_have_the_names_of_images(tmp_path, run_program):
    (tmp_path / "move.py").write_text("""
import bpy
scene = bpy.context.scene
scene.frame_start, scene.frame_end, scene.frame_step = 9, 13, 2
scene.camera.location = (0, 0, 0)
scene.camera.keyframe_insert("location", frame=9)
scene.camera.location = (4, 0, 0)
scene.camera.keyframe_insert("location", frame=13)
""")
    subprocess.run(["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python",
                    tmp_path / "move.py", "--python", exporter, "--", tmp_path / "cameras.json", "--animation"], cwd=tmp_path,
                   check=True, capture_output=True)
    run_program("camera", "import", "blender", tmp_path / "cameras.json", "-o", tmp_path / "path.json")
    path = fathom.read_cameras(tmp_path / "path.json")
    assert [camera.name for camera in path] == ["0009", "0011", "0013"]
    assert [round(float(camera.eye[0]), 3) for camera in path] == [0, 2, 4]
