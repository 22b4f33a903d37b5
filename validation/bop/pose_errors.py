"""Estimates of a pose that are wrong by a known amount, the same ones every time."""

import numpy as np

from dataset import Instance
from make_scenes import rotation_about

TRANSLATIONS = (1, 2, 3, 5, 7, 10, 15, 20, 30)          # mm, across and along the view
ROTATIONS = (1, 2, 5, 10, 20, 45)                       # degrees, about two axes through the middle of the model


def estimates(instance, vertices):
    """(what is wrong, Instance)"""
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    found = [("none", instance)]
    for name, axis in (("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))):
        for length in TRANSLATIONS:
            t = instance.t + length * np.array(axis)
            found.append((f"{length} mm {name}", Instance(instance.obj_id, instance.R, t)))
    for name, axis in (("x", (1, 0, 0)), ("z", (0, 0, 1))):
        for angle in ROTATIONS:
            R = rotation_about(axis, angle) @ instance.R
            t = instance.t + (instance.R - R) @ middle              # the middle stays where it is
            found.append((f"{angle}° {name}", Instance(instance.obj_id, R, t)))
    return found
