#!/usr/bin/python3
"""Makes a folder in BOP's layout: models, cameras, poses and depth images, the same ones every time.

    make_scenes.py FOLDER

    FOLDER/models/obj_00000N.ply, models_info.json      the meshes of data/meshes in millimetres
    FOLDER/test/00000N/scene_camera.json, scene_gt.json
    FOLDER/test/00000N/depth/000000.png                 exact depths, with the first pixel's centre at 0
    FOLDER/test/00000N/depth_corner/000000.png          the same with it at 0.5, for the sake of comparison

Scene 0 is that of docs/guides/bop.md. In scenes 1 to 3 six objects lie in a heap before the cameras of LM-O, YCB-V and
T-LESS. In scene 4 things touch or nearly touch, and one is cut off by the image. In none of these do the boxes of two
objects share more than a face.
"""

import json
import math
import pathlib
import random
import sys

import numpy as np

import exact
from dataset import Image, Instance
from models import MODELS, diameter, scaled_mesh, write_ply

LMO = (640, 480), (572.4114, 573.57043, 325.2611, 242.04899), 1.0
YCBV = (640, 480), (1066.778, 1067.487, 312.9869, 241.3109), 0.1
TLESS = (720, 540), (1075.65091572, 1073.90347929, 374.06888344, 255.15910000), 0.1
GUIDE = (640, 480), (572.4, 573.6, 325.3, 242.0), 0.1


def rotation_about(axis, degrees):
    """Rodrigues' formula."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    cross = np.array([(0, -z, y), (z, 0, -x), (-y, x, 0)])
    return np.eye(3) + s * cross + (1 - c) * cross @ cross


def boxes_meet(one, other):
    """Whether two boxes (centre, axes as rows, half sides) share a point: no axis separates them."""
    axes = [*one[1], *other[1], *(np.cross(a, b) for a in one[1] for b in other[1])]
    for axis in axes:
        reach = sum(abs(box[1] @ axis) @ box[2] for box in (one, other))
        if np.linalg.norm(axis) > 1e-9 and abs((one[0] - other[0]) @ axis) > reach:
            return False
    return True


def heap(seed, obj_ids, centre, spread):
    """Instances at random about a point, no two of whose boxes meet."""
    draw, boxes, instances = random.Random(seed), [], []
    for obj_id in obj_ids:
        vertices, _ = scaled_mesh(obj_id)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        while True:
            R = rotation_about([draw.uniform(-1, 1) for _ in range(3)], draw.uniform(0, 360))
            middle = np.array([c + draw.uniform(-s, s) for c, s in zip(centre, spread)])
            box = middle, R.T, (high - low) / 2
            if not any(boxes_meet(box, each) for each in boxes):
                break
        boxes.append(box)
        instances.append(Instance(obj_id, R, middle - R @ ((low + high) / 2)))
    return instances


def scenes():
    """(size, (fx, fy, cx, cy), depth_scale), instances"""
    upright = np.diag([1.0, -1.0, -1.0])
    turned = np.array([(0, 0, 1), (0, -1, 0), (1, 0, 0)], float)
    yield GUIDE, [Instance(1, upright, np.array([30.0, 10, 800])), Instance(1, turned, np.array([-20.0, 0, 900]))]
    yield LMO, heap(1, [1, 2, 3, 4, 5, 1], (0, 0, 700), (110, 90, 110))
    yield YCBV, heap(2, [2, 3, 1, 4, 5, 3], (0, 0, 900), (110, 85, 120))
    yield TLESS, heap(3, [3, 4, 5, 3, 4, 5], (0, 0, 750), (95, 75, 100))
    tilt = rotation_about((1, 0.2, 0), 25)
    on = tilt @ np.array([0, 0, -1.0])                   # away from the plate, towards the camera
    plate = np.array([15.0, 5, 700])
    yield LMO, [
        Instance(5, tilt, plate),
        Instance(3, tilt, plate + (4 + 55) * on + tilt @ (-25, 5, 0)),          # stands on the plate
        Instance(5, tilt @ rotation_about((0, 0, 1), 10), plate + (8 + 10) * on + tilt @ (95, 10, 0)),  # 10 mm above it
        Instance(4, tilt, plate + 80 * on + tilt @ (40, -40, 0)),
        Instance(1, upright, np.array([-330.0, 40, 650])),                      # cut off on the left
    ]


def write_scene(folder, kind, instances, models):
    (width, height), (fx, fy, cx, cy), depth_scale = kind
    image = Image((width, height), np.array([(fx, 0, cx), (0, fy, cy), (0, 0, 1)]), depth_scale, instances)
    for name, pixel_centre in (("depth", 0), ("depth_corner", 0.5)):
        (folder / name).mkdir(parents=True, exist_ok=True)
        maps = exact.scene(image, models).render(exact.camera(image, pixel_centre), dtype=np.uint16,
                                                 scale=1 / depth_scale)
        maps.write(folder / name / "000000.png")
    camera = {"cam_K": image.K.ravel().tolist(), "depth_scale": depth_scale}
    poses = [{"cam_R_m2c": each.R.ravel().tolist(), "cam_t_m2c": each.t.tolist(), "obj_id": each.obj_id}
             for each in instances]
    (folder / "scene_camera.json").write_text(json.dumps({"0": camera}), encoding="utf-8")
    (folder / "scene_gt.json").write_text(json.dumps({"0": poses}), encoding="utf-8")


def main(folder):
    (folder / "models").mkdir(parents=True, exist_ok=True)
    models, info = {}, {}
    for obj_id in MODELS:
        models[obj_id] = scaled_mesh(obj_id)
        write_ply(folder / f"models/obj_{obj_id:06}.ply", *models[obj_id])
        info[obj_id] = {"diameter": diameter(models[obj_id][0])}
    (folder / "models/models_info.json").write_text(json.dumps(info), encoding="utf-8")
    for number, (kind, instances) in enumerate(scenes()):
        write_scene(folder / f"test/{number:06}", kind, instances, models)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
