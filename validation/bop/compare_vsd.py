#!/usr/bin/python3
"""VSD by bop_toolkit beside VSD of exact distances, for poses that are wrong by a known amount.

    compare_vsd.py FOLDER --bop-toolkit CHECKOUT

delta = 15 mm, taus of 0.05, 0.10, … 0.50 of the diameter, as in the BOP Challenge. For depth images with the first
pixel's centre at 0, and at 0.5, VSD is computed

    exact     with exact distances of that centre
    half      with the models half a pixel off, as the renderer has them, but right distances
    formula   with the models so, and the toolkit's formula for distances, of exact depths
    toolkit   by pose_error.vsd() with its renderer

and compared with "exact": the largest and mean difference over all estimates and taus, and how many of the decisions
VSD < θ, with θ = 0.05, 0.10, … 0.50, come out differently. Instances of which less than a tenth is visible are left
out, as in the challenge. FOLDER/vsd.csv gets all of it, a line for each estimate and tau.
"""

import collections
import csv
import pathlib

import numpy as np

import exact
import toolkit
from dataset import read_depth, read_diameters, read_images, read_models, scene_folders
from gt_info import is_visible
from mask_steps import Measured
from pose_errors import estimates
from vsd import TAUS, vsd

DELTA = 15
KINDS = ("half", "formula", "toolkit")


class Distances:
    """Of a pose, in the three ways that need no toolkit."""

    def __init__(self, instance, image, models, pixel_centre):
        one, half = exact.alone(instance, models), exact.camera(image, 0.5)
        self.exact = exact.distances(one, exact.camera(image, pixel_centre))
        self.half = exact.distances(one, half)
        self.formula = exact.distances_of(exact.depths(one, half), image.K, 0)


def all_vsd(renderer, image, models, diameters, number, measured, codes):
    """(what is wrong, {way: VSD for each τ})"""
    from bop_toolkit_lib import pose_error

    true = image.instances[number]
    truth, diameter = Distances(true, image, models, measured.pixel_centre), diameters[true.obj_id]
    if is_visible(truth.exact, measured.stored, DELTA).sum() < 0.1 * (truth.exact > 0).sum():
        return
    taus = TAUS * diameter
    for name, estimate in estimates(true, models[true.obj_id][0]):
        guess = Distances(estimate, image, models, measured.pixel_centre)
        found = {"exact": vsd(truth.exact, guess.exact, measured.stored, delta=DELTA, taus=taus),
                 "half": vsd(truth.half, guess.half, measured.stored, delta=DELTA, taus=taus),
                 "formula": vsd(truth.formula, guess.formula, measured.by_formula, delta=DELTA, taus=taus),
                 "toolkit": np.array(pose_error.vsd(
                     estimate.R, estimate.t.reshape(3, 1), true.R, true.t.reshape(3, 1), codes, image.K, DELTA,
                     list(TAUS), True, diameter, renderer, true.obj_id, "step"))}
        yield name, found


def decisions(errors):
    """For each τ and θ, whether the pose counts as right; errors of exactly θ do not."""
    return np.asarray(errors)[..., None] < TAUS


def main():
    asked = toolkit.arguments(__doc__)
    models, diameters = read_models(asked.folder), read_diameters(asked.folder)
    lines = [("centre", "scene", "instance", "error", "tau", "exact", *KINDS)]
    for kind, centre in (("depth", 0), ("depth_corner", 0.5)):
        results, flips = collections.defaultdict(list), []
        for folder in scene_folders(asked.folder):
            for im_id, image in read_images(folder).items():
                renderer = toolkit.Renderer(asked.folder, image.size)
                renderer.own.set_current()
                codes = read_depth(folder, im_id, image.depth_scale, kind)
                measured = Measured(image, models, codes, centre)
                for number in range(len(image.instances)):
                    for name, found in all_vsd(renderer.own, image, models, diameters, number, measured, codes):
                        results[name].append(found)
                        lines += [(centre, int(folder.name), number, name, tau, *values)
                                  for tau, *values in zip(TAUS, found["exact"], *(found[way] for way in KINDS))]
                        turned = decisions(found["exact"]) != decisions(found["toolkit"])
                        flips += [(int(folder.name), number, name, TAUS[tau], TAUS[theta], found["exact"][tau],
                                   found["toolkit"][tau]) for tau, theta in np.argwhere(turned)]
        print(f"\ndepth image with the first pixel's centre at {centre}\n\n{'':10}mean over instances and taus      "
              "largest difference from exact      decisions that differ\nerror      " +
              "   exact toolkit              " + "".join(f"{each:>9}" for each in KINDS) + "      " +
              "".join(f"{each:>9}" for each in KINDS) + f"{'of':>9}")
        everything = [found for each in results.values() for found in each]
        for name, each in [*results.items(), ("all", everything)]:
            arrays = {way: np.array([found[way] for found in each]) for way in ("exact", *KINDS)}
            largest = [np.abs(arrays[way] - arrays["exact"]).max() for way in KINDS]
            turned = [(decisions(arrays[way]) != decisions(arrays["exact"])).sum() for way in KINDS]
            print(f"{name:10}{arrays['exact'].mean():9.4f}{arrays['toolkit'].mean():8.4f}{'':14}" +
                  "".join(f"{value:9.4f}" for value in largest) + "      " + "".join(f"{n:9}" for n in turned) +
                  f"{arrays['exact'].size * len(TAUS):9}")
        own = np.array([[found[way] for found in everything] for way in ("exact", "toolkit")])
        recall = decisions(own).mean(axis=(1, 2, 3))
        print(f"mean recall over taus and thetas: exact {recall[0]:.4f}, toolkit {recall[1]:.4f}")
        print(f"mean difference of VSD {np.abs(own[0] - own[1]).mean():.5f}; "
              f"{len({each[:3] for each in flips})} of {len(everything)} estimates have a decision that differs")
        print("decisions that differ between exact and toolkit: scene, instance, error, tau, theta, VSD of each")
        for each in flips:
            print("{:5}{:4}  {:8}{:6.2f}{:6.2f}{:9.5f}{:9.5f}".format(*each))
    with open(pathlib.Path(asked.folder) / "vsd.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(lines)


if __name__ == "__main__":
    main()
