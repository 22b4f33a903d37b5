"""Exact depths and distances of an image's instances, all together or each alone.

`pixel_centre` is the image coordinate of the first pixel's centre, as K counts: 0 is BOP's (OpenCV's), 0.5 is what
OpenGL has unless it is told otherwise. Nothing here has a default for it.
"""

import numpy as np
import fathom


def camera(image, pixel_centre, *, near=0, far=np.inf):
    K = image.K
    return fathom.Camera(*image.size, K[0, 0], K[1, 1], K[0, 2], K[1, 2], skew=K[0, 1], pixel_centre=pixel_centre,
                         near=near, far=far)


def canvas(image, pixel_centre):
    """The same camera with an image more on each side, for what is cut off. Depths and what is seen are exact; rays
    have other lengths. Binary64 need not hold cx + width: world_to_camera adds the width, u·z = fx·x + skew·y +
    width·z + cx·z, and has the focal lengths, too."""
    width, height = image.size
    K = image.K
    rows = ((K[0, 0], K[0, 1], width, 0), (0, K[1, 1], height, 0), (0, 0, 1, 0), (0, 0, 0, 1))
    return fathom.Camera(3 * width, 3 * height, 1, 1, K[0, 2], K[1, 2], pixel_centre=pixel_centre, world_to_camera=rows)


def scene(image, models):
    """The instances, numbered as in the image."""
    together, meshes = fathom.Scene(), {}
    for number, each in enumerate(image.instances):
        if each.obj_id in meshes:
            together.add_instance(meshes[each.obj_id], each.pose, name=str(number))
        else:
            meshes[each.obj_id] = together.add_mesh(*models[each.obj_id], pose=each.pose, name=str(number))
    return together


def alone(instance, models):
    one = fathom.Scene()
    one.add_mesh(*models[instance.obj_id], pose=instance.pose)
    return one


def distances(one, view):
    """H×W float64: how far from the camera's centre what each pixel sees lies; 0 where it sees nothing."""
    return one.render(view, channels=("distance",), dtype=np.float64, background=0)["distance"]


def depths(one, view):
    """The same along the optical axis."""
    return one.render(view, dtype=np.float64, background=0)["Z"]


def distances_of(depth, K, pixel_centre):
    """Distances of a depth image: each depth times the length of its pixel's ray, whose z is 1."""
    rows, columns = np.indices(depth.shape) + pixel_centre
    x, y = (columns - K[0, 2]) / K[0, 0], (rows - K[1, 2]) / K[1, 1]
    return depth * np.sqrt(1 + x * x + y * y)
