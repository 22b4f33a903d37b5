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
import typing

import numpy as np
import fathom

import exact
import toolkit
from compare_depth import judge
from dataset import read_depth, read_images, read_models, scene_folders
from gt_info import box, of_image
from mask_steps import STEPS, Measured, count, exact_masks, name_last_step

DELTA = 15


class Drawn(typing.NamedTuple):
    """Of an instance, as calc_gt_info.py has it."""

    silhouette: np.ndarray          # on the canvas
    visible: np.ndarray             # these on the image
    depth: np.ndarray
    distance: np.ndarray
    planes: tuple                   # near and far, as the renderer has chosen them


def toolkits_masks(canvas, instance, image, codes):
    from bop_toolkit_lib import misc, visibility

    width, height = image.size
    large, planes = canvas.depth(instance, image.K, (width, height))
    depth = large[height:2 * height, width:2 * width]
    model, measured = (misc.depth_im_to_dist_im_fast(each, image.K) for each in (depth, codes))
    visible = visibility.estimate_visib_mask_gt(measured, model, DELTA, visib_mode="bop19")
    return Drawn(large > 0, visible, depth, model, planes)


class Comparison:
    """Of the instances of all scenes, for one kind of depth image: adds up what differs."""

    def __init__(self, folder, models, kind, pixel_centre, shift):
        self.folder, self.models, self.kind = folder, models, kind
        self.pixel_centre, self.shift, self.drawn_at = pixel_centre, shift, 0.5 - shift
        self.reasons, self.several, self.of_canvas = collections.Counter(), collections.Counter(), 0

    def compare(self, scene_folder, im_id, image):
        """Prints a line for each instance."""
        width, height = image.size
        canvas = toolkit.Renderer(self.folder, (3 * width, 3 * height), self.shift)
        plain = toolkit.Renderer(self.folder, image.size, self.shift)
        codes = read_depth(scene_folder, im_id, image.depth_scale, self.kind)
        measured = Measured(image, self.models, codes, self.pixel_centre)
        areas = fathom.visible(exact.scene(image, self.models), exact.camera(image, self.pixel_centre)).objects
        partition = of_image(image, self.models, measured.exact, self.pixel_centre, None)
        by_delta = of_image(image, self.models, measured.stored, self.pixel_centre, DELTA)
        shown = collections.defaultdict(int)
        for number, instance in enumerate(image.instances):
            drawn = toolkits_masks(canvas, instance, image, codes)
            why = self.reasons_of(image, number, measured, drawn)
            self.reasons.update(why)
            self.of_canvas += int(((plain.depth(instance, image.K)[0] > 0) != (drawn.depth > 0)).sum())
            counted, truth = partition[number][2], by_delta[number][2]
            off = np.subtract([box(drawn.silhouette, image.size), box(drawn.visible)],
                              [truth["bbox_obj"], truth["bbox_visib"]])
            print(f"{int(scene_folder.name):5}{number:9}{areas.visible[number] / areas.unoccluded[number]:19.4f}"
                  f"{counted['visib_fract']:8.4f}{truth['visib_fract']:11.4f}"
                  f"{drawn.visible.sum() / drawn.silhouette.sum():9.4f}{truth['px_count_all']:22}"
                  f"{drawn.silhouette.sum():8}{np.abs(off).max():15}   {sum(why.values()):6}: " +
                  ", ".join(f"{n} {name}" for name, n in why.items() if n))
            for name, mask in (("exact", partition[number][1]), ("by delta", by_delta[number][1]),
                               ("toolkit", drawn.visible)):
                shown[name] = shown[name] + mask.astype(int)
        self.several.update({name: int((each > 1).sum()) for name, each in shown.items()})

    def reasons_of(self, image, number, measured, drawn):
        masks, by_formula = exact_masks(image, self.models, number, measured, DELTA, self.drawn_at)
        one = exact.alone(image.instances[number], self.models)
        classes = judge(drawn.depth, drawn.planes, one, image, self.drawn_at).classes
        return count(name_last_step(masks, drawn.visible, classes, drawn.distance, by_formula))


def main():
    asked = toolkit.arguments(__doc__)
    models, faulty = read_models(asked.folder), 0
    for kind, centre, shift in (("depth", 0, 0), ("depth_corner", 0.5, 0), ("depth", 0, 0.5)):
        print(f"\ndepth image with the first pixel's centre at {centre}; {shift} added to cx and cy for the renderer"
              "\n\nscene instance   visib_fract: area  exact   by delta  toolkit   px_count_all: exact toolkit"
              "   boxes off by   mask_visib differs in, because of")
        found = Comparison(asked.folder, models, kind, centre, shift)
        for folder in scene_folders(asked.folder):
            for im_id, image in read_images(folder).items():
                found.compare(folder, im_id, image)
        print("\npixels of mask_visib that differ, all scenes:")
        print(*(f"{found.reasons[name]:7} {name}: {told}" for name, told in STEPS.items()), sep="\n")
        print("pixels that are visible of several instances:", dict(found.several))
        print(f"pixels in which the silhouette on the canvas differs from that drawn on the image: {found.of_canvas}")
        faulty += found.reasons["unexplained"]
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
