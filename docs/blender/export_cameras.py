"""Writes the cameras of a scene of Blender for `fathom camera import blender`:

    blender -b scene.blend --python export_cameras.py -- cameras.json [--animation]

All cameras of the scene at the present frame, by their names; with --animation the active camera at
each frame, by the frame's number, as 0001. Works with Blender 3 to 5.
"""

import json
import math
import struct
import sys

import bpy

PROPERTIES = [
    "type", "sensor_fit", "sensor_width", "sensor_height", "shift_x", "shift_y", "clip_start",
    "clip_end", "lens", "ortho_scale",
]
PANORAMA = [
    "panorama_type", "fisheye_lens", *(f"fisheye_polynomial_k{i}" for i in range(5)),
    "central_cylindrical_range_v_min", "central_cylindrical_range_v_max",
    "central_cylindrical_radius",
]
ANGLES = [
    "longitude_min", "longitude_max", "latitude_min", "latitude_max", "fisheye_fov",
    "central_cylindrical_range_u_min", "central_cylindrical_range_u_max",
]


def in_binary32(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def shortest(number, to_property=lambda x: x):
    """The shortest decimal number that is `number`, or becomes it, in Blender's binary32."""
    for digits in range(1, 10):
        decimal = float(f"{number:.{digits}g}")
        if in_binary32(to_property(decimal)) == in_binary32(to_property(number)):
            return decimal
    return number


def exported(value):
    return shortest(value) if isinstance(value, float) else value


def camera_entry(holder, scene, name):
    camera, render = holder.data, scene.render
    # Up to Blender 4 these are properties of Cycles.
    panorama = camera if hasattr(camera, "panorama_type") else camera.cycles
    entry = {
        "name": name,
        "width": render.resolution_x * render.resolution_percentage // 100,
        "height": render.resolution_y * render.resolution_percentage // 100,
        "pixel_aspect": [shortest(render.pixel_aspect_x), shortest(render.pixel_aspect_y)],
        "matrix_world": [list(row) for row in holder.matrix_world],
    }
    entry.update((key, exported(getattr(camera, key))) for key in PROPERTIES)
    if camera.type == "PANO":
        known = [key for key in PANORAMA if hasattr(panorama, key)]
        entry.update((key, exported(getattr(panorama, key))) for key in known)
        for key in ANGLES:
            if hasattr(panorama, key):
                entry[key] = shortest(math.degrees(getattr(panorama, key)), math.radians)
    return entry


def all_cameras(scene):
    holders = [holder for holder in scene.objects if holder.type == "CAMERA"]
    return [camera_entry(holder, scene, holder.name) for holder in holders]


def active_camera_of_each_frame(scene):
    entries = []
    for frame in range(scene.frame_start, scene.frame_end + 1, scene.frame_step):
        scene.frame_set(frame)
        entries.append(camera_entry(scene.camera, scene, f"{frame:04}"))
    return entries


def main(arguments):
    if not arguments or arguments[1:] not in ([], ["--animation"]):
        sys.exit("export_cameras.py: expected -- cameras.json [--animation]")
    scene = bpy.context.scene
    if scene.render.use_border and scene.render.use_crop_to_border:
        sys.exit("export_cameras.py: the render is cropped to a border, which is not supported")
    cameras = active_camera_of_each_frame(scene) if arguments[1:] else all_cameras(scene)
    with open(arguments[0], "w", encoding="utf-8") as file:
        json.dump({"blender": bpy.app.version_string, "cameras": cameras}, file, indent=1)
        file.write("\n")


main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
