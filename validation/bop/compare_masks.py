#!/usr/bin/python3
"""scene_gt_info and mask_visib by bop_toolkit beside exact ones, and why each pixel of the masks differs.

    compare_masks.py FOLDER --bop-toolkit CHECKOUT

What scripts/calc_gt_info.py computes for an instance is computed by the toolkit's own functions (its renderer on a
canvas of three by three images, its distances and visibility), with delta = 15 mm: for depth images with the first
pixel's centre at 0, for those with it at 0.5, and for the former with half a pixel added to the principal point that
its renderer is given. Of visib_fract there are four: the exact area that no other instance hides, over that of the
whole silhouette (the border of the image hides nothing there); pixels of the exact partition; pixels by BOP's rule for
exact distances; and the toolkit's. See mask_steps.py for the reasons why a pixel differs. The exit status is 1 if one
has none.
"""

import collections
import sys

import numpy as np
import fathom

import exact
import toolkit
from compare_depth import judge
from dataset import read_depth, read_images, read_models, scene_folders
from gt_info import box, of_image
from mask_steps import STEPS, Measured, count, exact_masks, name_last_step

DELTA = 15


def toolkits_masks(renderers, instance, image, codes):
    """As calc_gt_info.py has them: silhouette on the canvas and what is visible, depths on the image; then the planes
    that the renderer had, and distances on the image."""
    from bop_toolkit_lib import misc, visibility

    width, height = image.size
    large, planes = renderers["canvas"].depth(instance, image.K, (width, height))
    depth = large[height:2 * height, width:2 * width]
    model, measured = (misc.depth_im_to_dist_im_fast(each, image.K) for each in (depth, codes))
    visible = visibility.estimate_visib_mask_gt(measured, model, DELTA, visib_mode="bop19")
    return large > 0, visible, depth, planes, model


def main():
    asked = toolkit.arguments(__doc__)
    models, edge = read_models(asked.folder), fathom.validation.CLASSES.index("edge")
    faulty = 0
    for kind, centre, shift in (("depth", 0, 0), ("depth_corner", 0.5, 0), ("depth", 0, 0.5)):
        print(f"\ndepth image with the first pixel's centre at {centre}; {shift} added to cx and cy for the renderer"
              "\n\nscene instance   visib_fract: area  exact   by delta  toolkit   px_count_all: exact toolkit"
              "   boxes off by   mask_visib differs in, because of")
        totals, canvas, several = collections.Counter(), 0, collections.Counter()
        for folder in scene_folders(asked.folder):
            for im_id, image in read_images(folder).items():
                width, height = image.size
                renderers = {"canvas": toolkit.Renderer(asked.folder, (3 * width, 3 * height), shift),
                             "image": toolkit.Renderer(asked.folder, image.size, shift)}
                codes = read_depth(folder, im_id, image.depth_scale, kind)
                measured = Measured(image, models, codes, centre)
                areas = fathom.visible(exact.scene(image, models), exact.camera(image, centre)).objects
                partition = of_image(image, models, measured.exact, centre, None)
                by_delta = of_image(image, models, measured.stored, centre, DELTA)
                shown = collections.Counter()
                for number, instance in enumerate(image.instances):
                    large, visible, depth, planes, model = toolkits_masks(renderers, instance, image, codes)
                    masks, by_formula = exact_masks(image, models, number, measured, DELTA, 0.5 - shift)
                    found = judge(depth, planes, exact.alone(instance, models), image, 0.5 - shift)
                    why = name_last_step(masks, visible, found.classes, edge, model, by_formula)
                    totals.update(count(why))
                    faulty += count(why)["unexplained"]
                    own = renderers["image"].depth(instance, image.K)[0]
                    canvas += int(((own > 0) != (depth > 0)).sum())
                    boxes = box(large, image.size), box(visible)
                    truth = by_delta[number][2]
                    off = max(np.abs(np.subtract(boxes[0], truth["bbox_obj"])).max(),
                              np.abs(np.subtract(boxes[1], truth["bbox_visib"])).max())
                    print(f"{int(folder.name):5}{number:9}{areas.visible[number] / areas.unoccluded[number]:19.4f}"
                          f"{partition[number][2]['visib_fract']:8.4f}{truth['visib_fract']:11.4f}"
                          f"{visible.sum() / large.sum():9.4f}{truth['px_count_all']:22}{large.sum():8}{off:15}   "
                          f"{(masks[0][1] != visible).sum():6}: " +
                          ", ".join(f"{n} {name}" for name, n in count(why).items() if n))
                    for name, mask in (("exact", masks[0][1]), ("by delta", by_delta[number][1]), ("toolkit", visible)):
                        shown[name] = shown[name] + mask.astype(int)
                several.update({name: int((each > 1).sum()) for name, each in shown.items()})
        print("\npixels of mask_visib that differ, all scenes:")
        print(*(f"{totals[name]:7} {name}: {told}" for name, told in STEPS.items()), sep="\n")
        print("pixels that are visible of several instances:", dict(several))
        print(f"pixels in which the silhouette on the canvas differs from that drawn on the image: {canvas}")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
