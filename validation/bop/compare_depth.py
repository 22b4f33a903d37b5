#!/usr/bin/python3
"""Each instance alone, as bop_toolkit's renderer draws it, beside the exact depths.

    compare_depth.py FOLDER --bop-toolkit CHECKOUT

First, which pixel centre the renderer has: how far its depths are from exact ones with the first pixel's centre at 0
and at 0.5, in millimetres, where both see the model, how many pixels one alone sees, and what fathom.validate() finds
wrong with the centre at 0. Then the class that it gives to each pixel with the centre at 0.5, by its model of an OpenGL depth
buffer of 16 bits. Pixels that it leaves unexplained are listed; the exit status is 1 if there is one.
"""

import collections
import sys

import numpy as np
import fathom

import exact
import toolkit
from dataset import read_images, read_models, scene_folders


def judge(drawn, planes, one, image, pixel_centre):
    """fathom.Validation of a drawn map, with the near and far planes that the renderer had."""
    view = exact.camera(image, pixel_centre, near=planes[0], far=planes[1])
    return fathom.validate(fathom.Map({"Z": drawn}, view, background=0), one, view, "gl-unorm16")


def errors(drawn, truth):
    """Median and largest error where both see the model, and how many pixels one alone sees."""
    both = (drawn > 0) & (truth > 0)
    apart = np.abs(drawn - truth)[both]
    return np.median(apart), apart.max(), int(((drawn > 0) != (truth > 0)).sum())


def main():
    asked = toolkit.arguments(__doc__)
    models, classes, listed, told = read_models(asked.folder), collections.Counter(), [], set()
    print(f"{'':26}{'centre at 0, mm':^26} {'centre at 0.5, mm':^26}\n{'scene, instance, model':26}" +
          2 * f"{'median':>9}{'largest':>9}{'alone':>7}  " + "found with the centre at 0")
    for folder in scene_folders(asked.folder):
        for image in read_images(folder).values():
            renderer = toolkit.Renderer(asked.folder, image.size)
            told.update(toolkit.versions(renderer.own))
            for number, instance in enumerate(image.instances):
                drawn, planes = renderer.depth(instance, image.K)
                one = exact.alone(instance, models)
                by_centre = [errors(drawn, exact.depths(one, exact.camera(image, centre))) for centre in (0, 0.5)]
                wrong = judge(drawn, planes, one, image, 0)
                print(f"{int(folder.name):5}{number:10}{instance.obj_id:7}    " +
                      "  ".join("{:9.5f}{:9.4f}{:7}".format(*each) for each in by_centre) + "  " + wrong.cause[:58])
                found = judge(drawn, planes, one, image, 0.5)
                classes.update(found.counts)
                listed += [f"scene {folder.name} instance {number}: {each.text}" for each in found.findings]
                listed += [f"scene {folder.name} instance {number} pixel ({x}, {y}): {drawn[y, x]} mm, "
                           f"allowed {found.least[y, x]} to {found.greatest[y, x]}"
                           for y, x in np.argwhere(found.classes == fathom.validation.CLASSES.index("unexplained"))]
    print("\nall pixels, with the centre at 0.5:", ", ".join(f"{count} {name}" for name, count in classes.items()))
    print(f"{len(listed)} findings or unexplained pixels", *listed, sep="\n")
    print(*sorted(told), sep="\n")
    return 1 if listed else 0


if __name__ == "__main__":
    sys.exit(main())
