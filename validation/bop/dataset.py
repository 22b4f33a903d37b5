"""What a folder in BOP's layout holds: models, and images with a camera and the poses of what they show.

Lengths are millimetres; a pose takes the model's frame to the camera's (x right, y down, z forward).
"""

import dataclasses
import json
import pathlib

import numpy as np
import fathom


@dataclasses.dataclass
class Instance:
    obj_id: int
    R: np.ndarray           # 3×3, model to camera
    t: np.ndarray           # 3

    @property
    def pose(self):
        return np.column_stack([self.R, self.t])


@dataclasses.dataclass
class Image:
    size: tuple             # width, height
    K: np.ndarray           # 3×3
    depth_scale: float      # millimetres in a code of the depth image
    instances: list


def read_models(folder):
    """obj_id: (vertices, faces)"""
    models = {}
    for file in sorted(pathlib.Path(folder).glob("models/obj_*.ply")):
        mesh = fathom.Scene.read(file)
        models[int(file.stem[4:])] = mesh.vertices().copy(), mesh.faces().copy()
    return models


def read_diameters(folder):
    info = json.loads((pathlib.Path(folder) / "models/models_info.json").read_text(encoding="utf-8"))
    return {int(obj_id): each["diameter"] for obj_id, each in info.items()}


def scene_folders(folder):
    return sorted((pathlib.Path(folder) / "test").iterdir())


def read_depth(scene_folder, im_id, depth_scale, kind="depth"):
    """H×W float64, in millimetres; 0 where nothing was measured."""
    codes = fathom.read_map(scene_folder / kind / f"{im_id:06}.png")["Z"]
    return codes * float(depth_scale)


def read_images(scene_folder):
    """im_id: Image"""
    cameras = json.loads((scene_folder / "scene_camera.json").read_text(encoding="utf-8"))
    poses = json.loads((scene_folder / "scene_gt.json").read_text(encoding="utf-8"))
    images = {}
    for name, camera in cameras.items():
        height, width = fathom.read_map(scene_folder / f"depth/{int(name):06}.png")["Z"].shape
        instances = [Instance(each["obj_id"], np.reshape(each["cam_R_m2c"], (3, 3)).astype(float),
                              np.array(each["cam_t_m2c"], float)) for each in poses[name]]
        images[int(name)] = Image((width, height), np.reshape(camera["cam_K"], (3, 3)).astype(float),
                                  camera["depth_scale"], instances)
    return images
