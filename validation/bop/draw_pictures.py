#!/usr/bin/python3
"""The pictures of docs/bop-microscope.md.

    draw_pictures.py FOLDER --bop-toolkit CHECKOUT

Writes docs/images/bop-masks.png, bop-distance.png and bop-vsd.png. The last needs FOLDER/vsd.csv of compare_vsd.py.
"""

import csv
import pathlib

import matplotlib
import numpy as np

import exact
import toolkit
from compare_depth import judge
from compare_distance import half_pixel
from compare_masks import DELTA, toolkits_masks
from dataset import read_depth, read_images, read_models, scene_folders
from mask_steps import Measured, exact_masks, name_last_step

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

images = pathlib.Path(__file__).resolve().parents[2] / "docs/images"
SHOWN = {"half pixel": "#1f5fbf", "delta": "#e07b00", "codes": "#7a3fa0", "edge": "#c00020"}
CROP = slice(185, 365), slice(250, 490)


def save(figure, name):
    figure.savefig(images / name, dpi=110, metadata={"Software": None})
    plt.close(figure)


def reasons(folder, scene_folder, image, models):
    """H×W: which reason the first differing mask has there, numbered from 1 in the order of SHOWN; 0 for none."""
    canvas = toolkit.Renderer(folder, tuple(3 * each for each in image.size))
    codes = read_depth(scene_folder, 0, image.depth_scale)
    measured = Measured(image, models, codes, 0)
    found = np.zeros(image.size[::-1], int)
    for number, instance in enumerate(image.instances):
        drawn = toolkits_masks(canvas, instance, image, codes)
        masks, by_formula = exact_masks(image, models, number, measured, DELTA)
        classes = judge(drawn.depth, drawn.planes, exact.alone(instance, models), image, 0.5).classes
        why = name_last_step(masks, drawn.visible, classes, drawn.distance, by_formula)
        for rank, name in enumerate(SHOWN, 1):
            found[(found == 0) & why[name]] = rank
    return measured.objects, found


def draw_masks(objects, found, count):
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.6), constrained_layout=True)
    seen = np.where(objects < count, objects, -1.0)
    seen[seen < 0] = np.nan
    extent = CROP[1].start - 0.5, CROP[1].stop - 0.5, CROP[0].stop - 0.5, CROP[0].start - 0.5
    axes[0].imshow(seen[CROP], cmap="Pastel1", vmin=0, vmax=8, interpolation="nearest", extent=extent)
    axes[0].set_title("exact: what each pixel shows", fontsize=9)
    axes[1].imshow(np.where(np.isnan(seen), 1, 0.88)[CROP], cmap="gray", vmin=0, vmax=1, interpolation="nearest",
                   extent=extent)
    colours = matplotlib.colors.ListedColormap(["#00000000", *SHOWN.values()])
    axes[1].imshow(found[CROP], cmap=colours, vmin=-0.5, vmax=len(SHOWN) + 0.5, interpolation="nearest", extent=extent)
    axes[1].set_title("where a mask_visib differs, by reason", fontsize=9)
    present = [(name, colour) for rank, (name, colour) in enumerate(SHOWN.items(), 1) if (found[CROP] == rank).any()]
    axes[1].legend(handles=[matplotlib.patches.Patch(color=colour, label=name) for name, colour in present], fontsize=8,
                   loc="lower right")
    for each in axes:
        each.tick_params(labelsize=7)
    save(figure, "bop-masks.png")


def draw_distance(image):
    apart = half_pixel(image.size, image.K, 1000)
    figure, axes = plt.subplots(figsize=(5.6, 3.9), constrained_layout=True)
    shown = axes.imshow(apart, cmap="RdBu_r", vmin=-0.72, vmax=0.72)
    lines = axes.contour(apart, levels=np.arange(-6, 7) / 10, colors="black", linewidths=0.5)
    axes.clabel(lines, fontsize=7, fmt="%.1f")
    axes.set_title("distance by the formula less the exact one, at a depth of 1000 mm", fontsize=9)
    axes.tick_params(labelsize=7)
    figure.colorbar(shown, label="mm").ax.tick_params(labelsize=7)
    save(figure, "bop-distance.png")


def draw_vsd(file):
    with open(file, encoding="utf-8", newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if row["error"] != "none"]
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.1), sharey=True, constrained_layout=True)
    for each, centre in zip(axes, ("0", "0.5")):
        values = np.array([(float(row["exact"]), float(row["toolkit"])) for row in rows if row["centre"] == centre])
        each.plot(values[:, 0], values[:, 1] - values[:, 0], ".", markersize=1.5, color="#1f5fbf", rasterized=True)
        each.axhline(0, color="black", linewidth=0.5)
        each.set_title(f"depth image with the first pixel's centre at {centre}", fontsize=9)
        each.set_xlabel("VSD, exact", fontsize=8)
        each.tick_params(labelsize=7)
    axes[0].set_ylabel("VSD, toolkit less exact", fontsize=8)
    save(figure, "bop-vsd.png")


def main():
    asked = toolkit.arguments(__doc__)
    models, folders = read_models(asked.folder), scene_folders(asked.folder)
    last, = read_images(folders[4]).values()
    draw_masks(*reasons(asked.folder, folders[4], last, models), len(last.instances))
    lmo, = read_images(folders[1]).values()
    draw_distance(lmo)
    draw_vsd(pathlib.Path(asked.folder) / "vsd.csv")


if __name__ == "__main__":
    main()
