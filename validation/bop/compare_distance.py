#!/usr/bin/python3
"""bop_toolkit's distance formula beside exact distances.

    compare_distance.py FOLDER --bop-toolkit CHECKOUT

Of each scene: how far misc.depth_im_to_dist_im() and depth_im_to_dist_im_fast() are from the exact distances, in
millimetres, when they are given the exact depths of the same view, with the first pixel's centre at 0 and at 0.5; and
what half a pixel makes of a depth of 1000 mm in the corners of the image.
"""

import numpy as np

import exact
import toolkit
from dataset import read_images, read_models, scene_folders


def formula_error(formula, scene, view, K):
    """H×W, the formula's distance less the exact one; NaN where nothing is seen."""
    truth = exact.distances(scene, view)
    return np.where(truth > 0, formula(exact.depths(scene, view), K) - truth, np.nan)


def half_pixel(size, K, depth):
    """H×W: distance with the centre at 0 less that with it at 0.5, of a plane across the view."""
    plane = np.full(size[::-1], float(depth))
    return exact.distances_of(plane, K, 0) - exact.distances_of(plane, K, 0.5)


def main():
    asked = toolkit.arguments(__doc__)
    from bop_toolkit_lib import misc

    models = read_models(asked.folder)
    print("scene  formula                    centre at 0: largest   centre at 0.5: least   median   greatest, mm")
    for folder in scene_folders(asked.folder):
        for image in read_images(folder).values():
            scene = exact.scene(image, models)
            for formula in (misc.depth_im_to_dist_im, misc.depth_im_to_dist_im_fast):
                zero, half = (formula_error(formula, scene, exact.camera(image, centre), image.K)
                              for centre in (0, 0.5))
                print(f"{int(folder.name):5}  {formula.__name__:26}{np.nanmax(abs(zero)):22.1e}"
                      f"{np.nanmin(half):23.3f}{np.nanmedian(half):9.3f}{np.nanmax(half):11.3f}")
    print("\nat a depth of 1000 mm, corners of the image: top left, top right, bottom left, bottom right, mm")
    for folder in scene_folders(asked.folder):
        for image in read_images(folder).values():
            apart = half_pixel(image.size, image.K, 1000)
            print(f"{int(folder.name):5}", *(f"{apart[y, x]:9.3f}" for y in (0, -1) for x in (0, -1)))


if __name__ == "__main__":
    main()
