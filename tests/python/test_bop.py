"""Masks, scene_gt_info and VSD of validation/bop, against values worked out by hand.

The camera is 64×48 with f = 1000 pixels, and its axis meets the image where four pixels meet: a plate across the view
at 1000 mm covers a pixel for each square millimetre, and its edges lie between pixels.

       12       31 32       51          the plate alone: 40×20 pixels; `cover` before its right half
    14 +---------+---------+
       | visible | hidden  |
    33 +---------+---------+
"""

import fractions
import json
import os
import pathlib
import random
import subprocess
import sys
import zlib

import cv2
import numpy as np
import pytest

import fathom
from fathom.validation import CLASSES

folder = pathlib.Path(os.environ["FATHOM_SOURCE"]) / "validation/bop"
sys.path.insert(0, str(folder))

import exact  # noqa: E402
import gt_info  # noqa: E402
from dataset import Image, Instance, read_depth, read_images  # noqa: E402
from make_scenes import boxes_meet, rotation_about, write_scene  # noqa: E402
from mask_steps import Measured, count, exact_masks, name_last_step  # noqa: E402
from models import diameter, write_ply  # noqa: E402
from vsd import TAUS, visibilities, vsd  # noqa: E402

PLATE, COVER = 1, 2
K = np.array([(1000, 0, 31.5), (0, 1000, 23.5), (0, 0, 1)])


def plate(width, height):
    x, y = width / 2, height / 2
    return np.array([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], float), np.array([(0, 1, 2), (0, 2, 3)])


MODELS = {PLATE: plate(40, 20), COVER: plate(16, 24)}


def at(obj_id, x, y, z):
    return Instance(obj_id, np.eye(3), np.array([x, y, z], float))


def image_of(*instances):
    return Image((64, 48), K, 0.1, list(instances))


def measured_in(image):
    return exact.distances(exact.scene(image, MODELS), exact.camera(image, 0))


def infos(image, delta):
    return [each for _, _, each in gt_info.of_image(image, MODELS, measured_in(image), 0, delta)]


alone = image_of(at(PLATE, 0, 0, 1000))
half_hidden = image_of(at(PLATE, 0, 0, 1000), at(COVER, 8, 0, 500))            # from column 32 to the last


@pytest.mark.parametrize("delta", [15, None])
def test_a_plate_half_hidden(delta):
    found, cover = infos(half_hidden, delta)
    assert found == {"px_count_all": 800, "px_count_valid": 800, "px_count_visib": 400, "visib_fract": 0.5,
                     "bbox_obj": [12, 14, 39, 19], "bbox_visib": [12, 14, 19, 19]}
    assert cover["px_count_all"] == 32 * 48 and cover["visib_fract"] == 1 and cover["bbox_obj"] == [32, 0, 31, 47]
    areas = fathom.visible(exact.scene(half_hidden, MODELS), exact.camera(half_hidden, 0)).objects
    assert areas.visible[0] == 400 and areas.unoccluded[0] == 800


def test_what_is_cut_off_counts():
    found, = infos(image_of(at(PLATE, -32, 0, 1000)), 15)                       # columns -20 to 19
    assert found == {"px_count_all": 800, "px_count_valid": 400, "px_count_visib": 400, "visib_fract": 0.5,
                     "bbox_obj": [-20, 14, 39, 19], "bbox_visib": [0, 14, 19, 19]}


def test_what_is_not_seen_has_no_boxes():
    found, _ = infos(image_of(at(PLATE, 0, 0, 1000), at(PLATE, 0, 0, 900)), 15)
    assert found["px_count_visib"] == 0 and found["visib_fract"] == 0
    assert found["bbox_obj"] == found["bbox_visib"] == [-1, -1, -1, -1]


def test_delta_makes_two_plates_visible_in_one_pixel():
    """10 mm apart along the axis, at most 10.01 along a ray: within delta of 15, beyond one of 9."""
    close = image_of(at(PLATE, 0, 0, 1000), at(PLATE, 19.8, 0, 990))            # its left edge is in column 31.5
    assert [infos(close, delta)[0]["px_count_visib"] for delta in (15, 9, None)] == [800, 400, 400]
    measured = Measured(close, MODELS, read_codes(close), 0)
    masks, by_formula = exact_masks(close, MODELS, 0, measured, 15)
    assert [name for name, _ in masks] == ["exact", "delta", "codes", "half pixel", "formula"]
    final = masks[2][1].copy()
    final[20:23, 20] = False                                                    # as if its renderer had these wrong
    classes = np.zeros(final.shape, int)
    classes[20, 20], classes[21, 20] = map(CLASSES.index, ("edge", "unexplained"))
    drawn = by_formula.copy()
    drawn[20, 20] = 0
    why = name_last_step(masks[:3], final, classes, drawn, by_formula)
    assert {name: n for name, n in count(why).items() if n} == {"delta": 400, "edge": 1, "16 bits": 1, "unexplained": 1}
    assert why["edge"][20, 20] and why["unexplained"][21, 20] and why["16 bits"][22, 20]
    assert why["delta"][14:34, 32:52].all()


def read_codes(image):
    return exact.scene(image, MODELS).render(exact.camera(image, 0), dtype=np.uint16, scale=10)["Z"] * 0.1


def test_nothing_measured_counts_as_visible():
    nothing = np.zeros((48, 64))
    (_, visible, found), = gt_info.of_image(alone, MODELS, nothing, 0, 15)
    assert found["px_count_visib"] == 800 and found["px_count_valid"] == 0 and visible.sum() == 800


def errors(true, estimate, measured, taus):
    S, S_hat = (exact.distances(exact.alone(each, MODELS), exact.camera(alone, 0)) for each in (true, estimate))
    return list(vsd(S, S_hat, measured, delta=15, taus=taus))


def test_vsd_of_the_true_pose_is_0_and_of_a_far_one_1():
    true = alone.instances[0]
    assert errors(true, true, measured_in(alone), [1, 100]) == [0, 0]
    assert errors(true, at(PLATE, 0, 21, 1000), measured_in(alone), [1, 100]) == [1, 1]
    assert list(vsd(*np.zeros((2, 48, 64)), measured_in(alone), delta=15, taus=[1])) == [1]           # seen in neither


def test_vsd_of_a_plate_moved_sideways():
    """By 10 columns in its own plane: 30 columns of 50 agree, and 10 of 20 where its right half is hidden."""
    true, moved = alone.instances[0], at(PLATE, 10, 0, 1000)
    assert errors(true, moved, measured_in(alone), [0.001]) == [20 / 50]
    assert errors(true, moved, measured_in(half_hidden), [0.001]) == [10 / 20]


def test_vsd_of_a_plate_moved_back():
    """By 20 mm: more than delta behind what is measured, visible because the true pose is; 20 to 20.01 mm off."""
    true, moved = alone.instances[0], at(PLATE, 0, 0, 1020)
    measured = measured_in(alone)
    assert errors(true, moved, measured, [19.99, 20.02]) == [1, 0]
    S, S_hat = (exact.distances(exact.alone(each, MODELS), exact.camera(alone, 0)) for each in (true, moved))
    V, V_hat = visibilities(S, S_hat, measured, 15)
    assert (V == V_hat).all() and not gt_info.is_visible(S_hat, measured, 15).any()
    # On the rays through pixels at (column - 31.5)/1000, (row - 23.5)/1000 the two are 20·|ray| apart.
    tau = 20.002
    rows, columns = np.indices((48, 64))
    near = 20 * np.sqrt(1 + ((columns - 31.5) / 1000) ** 2 + ((rows - 23.5) / 1000) ** 2) < tau
    assert errors(true, moved, measured, [tau]) == [(800 - near[14:34, 12:52].sum()) / 800]
    assert 0 < near[14:34, 12:52].sum() < 800


def test_two_planes():
    """A wall at 1100 mm is what is measured beside the plate. The estimate is 10 columns right and 5 mm nearer: of the
    50 columns that either has, 30 show both, 5 mm apart; its own 10 are before the wall, hence visible."""
    wall = np.full((48, 64), 1100.0)
    measured = measured_in(alone)
    measured = np.where(measured > 0, measured, exact.distances_of(wall, K, 0))
    true, moved = alone.instances[0], at(PLATE, 9.95, 0, 995)                   # columns 12 to 51, and 22 to 61
    assert errors(true, moved, measured, [4.99, 5.01]) == [1, 20 / 50]
    # Behind the wall by more than delta, its own columns are hidden: 40 remain, of which 10 are not the estimate's.
    behind = at(PLATE, 11.2, 0, 1120)                                           # 20·1000/1120 = 17.9: columns 24 to 59
    assert errors(true, behind, measured, [119.9, 120.1]) == [1, (800 - 28 * 18) / 800]


def test_distances_have_the_centre_that_is_asked_for():
    tilted = Instance(PLATE, rotation_about((1, 2, 3), 40), np.array([0.0, 0, 1000]))
    one = exact.alone(tilted, MODELS)
    for centre in (0, 0.5):
        view = exact.camera(alone, centre)
        truth, depths = exact.distances(one, view), exact.depths(one, view)
        np.testing.assert_allclose(exact.distances_of(depths, K, centre), truth, rtol=4 * 2.0**-53)
        other = exact.distances_of(depths, K, 0.5 - centre)
        assert np.abs(other - truth).max() > 1e-3
    assert len(TAUS) == 10 and TAUS[0] == 0.05 and TAUS[-1] == 0.5


def test_boxes_meet():
    one = np.zeros(3), np.eye(3), np.array([1.0, 1, 1])
    turned = rotation_about((0, 0, 1), 45)
    assert boxes_meet(one, (np.array([1.9, 0, 0]), np.eye(3), one[2]))
    assert not boxes_meet(one, (np.array([2.1, 0, 0]), np.eye(3), one[2]))
    assert boxes_meet(one, (np.array([2.4, 0, 0]), turned, one[2]))             # an edge reaches √2 towards the first
    assert not boxes_meet(one, (np.array([2.45, 0, 0]), turned, one[2]))
    assert not boxes_meet(one, (np.array([1.8, 1.8, 0]), turned, one[2]))       # between a face and an edge
    upright, level = (np.zeros(3), turned, one[2]), rotation_about((0, 1, 0), 45)   # edges towards each other, √2 far
    assert boxes_meet(upright, (np.array([2.82, 0, 0]), level, one[2]))
    assert not boxes_meet(upright, (np.array([2.84, 0, 0]), level, one[2]))


def pixels_of(png):
    data = png.read_bytes()
    start = data.index(b"IDAT")
    length = int.from_bytes(data[start - 4:start], "big")
    width, height = (int.from_bytes(data[at:at + 4], "big") for at in (16, 20))
    rows = np.frombuffer(zlib.decompress(data[start + 4:start + 4 + length]), np.uint8)
    return rows.reshape(height, width + 1)[:, 1:]


def test_a_folder_in_bops_layout(tmp_path):
    (tmp_path / "models").mkdir()
    for obj_id, mesh in MODELS.items():
        write_ply(tmp_path / f"models/obj_{obj_id:06}.ply", *mesh)
    assert diameter(MODELS[PLATE][0]) == pytest.approx(np.hypot(40, 20), rel=1e-15)
    scene = tmp_path / "test/000000"
    write_scene(scene, ((64, 48), (1000, 1000, 31.5, 23.5), 0.1), half_hidden.instances, MODELS)
    depth = read_depth(scene, 0, 0.1)
    assert depth[20, 20] == 1000 and depth[20, 40] == 500 and depth[5, 5] == 0
    image, = read_images(scene).values()
    assert image.size == (64, 48) and (image.K == K).all() and image.instances[1].t[2] == 500
    subprocess.run([sys.executable, "-B", folder / "gt_info.py", tmp_path], check=True)
    found = json.loads((scene / "scene_gt_info.json").read_text(encoding="utf-8"))
    assert found["0"] == infos(half_hidden, 15)
    mask, visible = (pixels_of(scene / name / "000000_000000.png") for name in ("mask", "mask_visib"))
    assert mask.shape == (48, 64) and mask.sum() == 800 * 255 and visible.sum() == 400 * 255
    assert (visible[14:34, 12:32] == 255).all()


def test_the_program_makes_the_same(tmp_path):
    (tmp_path / "models").mkdir()
    for obj_id, mesh in MODELS.items():
        write_ply(tmp_path / f"models/obj_{obj_id:06}.ply", *mesh)
    scene, out = tmp_path / "test/000000", tmp_path / "out"
    tilted = Instance(PLATE, rotation_about((1, 2, 3), 40), np.array([5, -3, 800.0]))
    write_scene(scene, ((64, 48), (1000, 1000, 31.5, 23.5), 0.1), [*half_hidden.instances, tilted], MODELS)
    subprocess.run([sys.executable, "-B", folder / "gt_info.py", tmp_path, "--partition"], check=True)
    subprocess.run([os.environ["FATHOM_PROGRAM"], "dataset", "bop", scene, "--models", tmp_path / "models", "--size",
                    "64x48", "--out", out], check=True)
    assert json.loads((out / "scene_gt_info.json").read_text()) == json.loads((scene / "scene_gt_info.json").read_text())
    for kind in ("mask", "mask_visib"):
        for png in (scene / kind).iterdir():
            assert (pixels_of(png) == cv2.imread(str(out / kind / png.name), -1)).all(), png


def test_the_canvas_is_of_the_same_camera():
    """Left and upper edges go exactly through centres of pixels, which the plate has: a cx + 64 that is rounded upwards
    would lose a column of them."""
    draw, rounded_upwards = random.Random(3), 0
    for _ in range(30):
        cx, cy = round(draw.uniform(20, 44), 4), round(draw.uniform(15, 33), 4)
        x, y = (np.array([float(fractions.Fraction(edge) - fractions.Fraction(c)) for edge in edges])
                for edges, c in (((10, 40.25), cx), ((12, 30.25), cy)))
        models = {PLATE: (np.array([(a, b, 0) for a, b in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))]),
                          np.array([(0, 1, 2), (0, 2, 3)]))}
        image = Image((64, 48), np.array([(1, 0, cx), (0, 1, cy), (0, 0, 1)]), 0.1, [at(PLATE, 0, 0, 1)])
        measured = exact.distances(exact.scene(image, models), exact.camera(image, 0))
        (silhouette, visible, found), = gt_info.of_image(image, models, measured, 0, 15)
        assert np.array_equal(silhouette[48:96, 64:128], visible)
        assert found["px_count_all"] == found["px_count_visib"] == 31 * 19 and found["visib_fract"] == 1
        rounded_upwards += fractions.Fraction(cx + 64) > fractions.Fraction(cx) + 64
    assert rounded_upwards > 5
