#!/usr/bin/python3
"""scene_gt_info.json and masks of a folder in BOP's layout, from exact distances.

    gt_info.py FOLDER [--delta 15] [--partition]

Writes test/*/scene_gt_info.json, and mask/ and mask_visib/ beside it. A pixel of a model is visible where BOP's rule
says so: at most `delta` millimetres behind what the depth image has there, or where that has nothing. With --partition
it is visible where the model is what the exact map of all instances shows: then no pixel belongs to two.
"""

import argparse
import json

import numpy as np

import exact
from dataset import read_depth, read_images, read_models, scene_folders
from write_png import write_mask


def is_visible(model, measured, delta):
    """H×W of bool: BOP's rule ("bop19"), for distances in which 0 is "none"."""
    return (model > 0) & ((measured == 0) | (model - measured <= delta))


def box(mask, offset=(0, 0)):
    """BOP's (x, y, width, height): from the first pixel's centre to the last one's, so one pixel alone has width 0."""
    rows, columns = np.nonzero(mask)
    if len(rows) == 0:
        return [-1, -1, -1, -1]
    return [int(columns.min()) - offset[0], int(rows.min()) - offset[1],
            int(columns.max() - columns.min()), int(rows.max() - rows.min())]


def info(visible, silhouette, measured):
    """What scene_gt_info.json has of an instance. `silhouette` is on a canvas of three by three images."""
    height, width = visible.shape
    inside = silhouette[height:2 * height, width:2 * width]
    whole, seen = int(silhouette.sum()), int(visible.sum())
    return {"px_count_all": whole, "px_count_valid": int((inside & (measured > 0)).sum()), "px_count_visib": seen,
            "visib_fract": seen / whole if whole else 0.0,
            "bbox_obj": box(silhouette, (width, height)) if seen else [-1] * 4, "bbox_visib": box(visible)}


def of_image(image, models, measured, pixel_centre, delta):
    """(silhouette on the canvas, visible, info) of each instance. `measured` has the distances of the depth image;
    `delta` is None for the partition."""
    view, canvas = exact.camera(image, pixel_centre), exact.canvas(image, pixel_centre)
    shown = exact.scene(image, models).render(view, channels=("object",))["object"]
    found = []
    for number, instance in enumerate(image.instances):
        one = exact.alone(instance, models)
        silhouette = exact.depths(one, canvas) > 0
        visible = shown == number if delta is None else is_visible(exact.distances(one, view), measured, delta)
        found.append((silhouette, visible, info(visible, silhouette, measured)))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--delta", type=float, default=15)
    parser.add_argument("--partition", action="store_true")
    asked = parser.parse_args()
    models = read_models(asked.folder)
    for folder in scene_folders(asked.folder):
        infos = {}
        for im_id, image in read_images(folder).items():
            measured = exact.distances_of(read_depth(folder, im_id, image.depth_scale), image.K, 0)
            found = of_image(image, models, measured, 0, None if asked.partition else asked.delta)
            infos[im_id] = [each for _, _, each in found]
            height, width = measured.shape
            for number, (silhouette, visible, _) in enumerate(found):
                name = f"{im_id:06}_{number:06}.png"
                write_mask(folder / "mask" / name, silhouette[height:2 * height, width:2 * width])
                write_mask(folder / "mask_visib" / name, visible)
        (folder / "scene_gt_info.json").write_text(json.dumps(infos, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
