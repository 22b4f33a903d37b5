"""From the exact mask of what is visible to bop_toolkit's, one ingredient at a time.

Each pixel in which the two differ is put down to the step at which it took its last value.
"""

import collections

import numpy as np
from fathom.validation import CLASSES

import exact
from gt_info import is_visible

STEPS = {
    "delta": "hidden by something less than delta in front of it: visible by BOP's rule",
    "codes": "the depth image has codes of depth_scale mm",
    "half pixel": "the renderer samples half a pixel right of and below the pixel's centre",
    "formula": "the distance formula takes the pixel's ray half a pixel from where its depth was sampled",
    "edge": "closer to a projected edge than the rasterizer resolves",
    "16 bits": "the depth buffer's 16 bits take it across delta",
    "unexplained": "none of these",
}


class Measured:
    """The depth image in three ways, as distances; `pixel_centre` is the one that it was made with."""

    def __init__(self, image, models, codes, pixel_centre):
        view = exact.camera(image, pixel_centre)
        shown = exact.scene(image, models).render(view, channels=("distance", "object"), dtype=np.float64, background=0)
        self.pixel_centre, self.objects, self.exact = pixel_centre, shown["object"], shown["distance"]
        self.stored = exact.distances_of(codes, image.K, pixel_centre)
        self.by_formula = exact.distances_of(codes, image.K, 0)


def exact_masks(image, models, number, measured, delta, drawn_at=0.5):
    """The masks that lead to the toolkit's, with the name of the step that each takes, and the distances of the last
    one, which is short of its renderer alone. `drawn_at` is the pixel centre that the renderer has."""
    one = exact.alone(image.instances[number], models)
    at_image, as_drawn = exact.camera(image, measured.pixel_centre), exact.camera(image, drawn_at)
    model = exact.distances(one, at_image)
    by_formula = exact.distances_of(exact.depths(one, as_drawn), image.K, 0)
    return [("exact", measured.objects == number),
            ("delta", is_visible(model, measured.exact, delta)),
            ("codes", is_visible(model, measured.stored, delta)),
            ("half pixel", is_visible(exact.distances(one, as_drawn), measured.stored, delta)),
            ("formula", is_visible(by_formula, measured.by_formula, delta))], by_formula


def name_last_step(masks, final, classes, drawn, by_formula):
    """For each step, the pixels (H×W of bool) in which `final` differs from the first mask because of it.

    classes     fathom.validate()'s, of the depths that were drawn
    drawn       distances of these depths by the formula, 0 for none; by_formula those of exact depths
    """
    found, differ = {}, masks[0][1] != final
    last = np.full(final.shape, "", object)
    for (_, before), (name, after) in zip(masks, masks[1:]):
        last[before != after] = name
    turned = masks[-1][1] != final
    both = (drawn > 0) & (by_formula > 0)
    last[turned] = "unexplained"
    last[turned & both & (classes != CLASSES.index("unexplained"))] = "16 bits"
    last[turned & (classes == CLASSES.index("edge"))] = "edge"
    for name in STEPS:
        found[name] = differ & (last == name)
    return found


def count(found):
    return collections.Counter({name: int(pixels.sum()) for name, pixels in found.items()})
