"""evaluate: plates whose distances are plain, and the figures of its maps by NumPy."""

import os
import pathlib
import warnings

import numpy as np
import pytest

import fathom

SQUARE = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
FACES = [(0, 1, 2), (0, 2, 3)]


def plates(*depths):
    scene = fathom.Scene()
    for depth in depths:
        scene.add_mesh(SQUARE + (0, 0, depth), FACES)
    return scene


@pytest.fixture(scope="module")
def camera():
    return fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)


def test_plates_are_as_far_apart_as_they_stand():
    found = fathom.evaluate(plates(2.25), plates(2), within=[0.25, 0.5], points=500)
    assert found.depth is None
    assert found.accuracy == (500, 500, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, (0, 1), None, None, 0, 0)
    assert found.completeness == found.accuracy and found.f_scores == (0, 1)
    assert found.overall == 0.25


def test_only_what_is_seen_counts(camera):
    found = fathom.evaluate(plates(2, 9), plates(2, 5), camera, points=1000)
    assert found.accuracy.seen == found.completeness.seen == 500
    assert found.accuracy.max == found.completeness.max == found.depth.l1 == 0


def test_points_are_kept_on_demand(camera):
    found = fathom.evaluate(plates(2.25, 9), plates(2), camera, points=1000, keep_points=True).accuracy
    assert found.positions.shape == (found.seen, 3) and found.distances.shape == (found.seen,)
    assert (found.positions[:, 2] == 2.25).all() and (found.distances == 0.25).all()
    assert np.abs(found.positions[:, :2]).max() <= 1 and len(np.unique(found.positions, axis=0)) == found.seen


def test_it_is_shown_as_the_table_of_the_command(spot, run_program):
    data = pathlib.Path(os.environ["FATHOM_SOURCE"]) / "data"
    mesh, file = data / "meshes/spot.obj", data / "cameras/orthographic.json"
    table = run_program("evaluate", mesh, "--truth", mesh, "--camera", file, "--within", "0.5,1", "--points", 100,
                        "--max-distance", 2)
    found = fathom.evaluate(spot, spot, fathom.Camera.read(file), within=[0.5, 1], points=100, max_distance=2)
    assert found.table == table and repr(found) == "Evaluation:\n" + table.rstrip("\n")


def test_depths_agree_as_numpy_says(spot):
    cameras = [fathom.Camera.frame(spot, size=(60, 44), azimuth=azimuth) for azimuth in (30, 200)]
    flat = plates(0)
    found = fathom.evaluate(flat, spot, cameras, points=100)
    sums, alone, pixels, all_pixels, truth_pixels = 0.0, 0.0, 0, [], []
    for each in cameras:
        t = spot.render(each)["Z"].astype(float)
        d = flat.render(each)["Z"].astype(float)
        both = np.isfinite(t) & np.isfinite(d)
        sums += np.abs(d[both] - t[both]).sum()
        pixels += both.sum()
        alone += (np.isfinite(t) & ~np.isfinite(d)).sum()
        t, d = np.where(np.isfinite(t), t, 0), np.where(np.isfinite(d), d, 0)
        all_pixels.append(np.abs(d - t).mean())
        truth_pixels.append(np.abs(d - t)[t > 0].mean())
    depth = found.depth
    assert depth.views == depth.views_of_truth == 2 and depth.both == pixels and depth.only_truth == alone
    assert depth.l1 == pytest.approx(sums / pixels, rel=1e-12)
    assert depth.l1_of_all_pixels == pytest.approx(np.mean(all_pixels), rel=1e-12)
    assert depth.l1_of_truth_pixels == pytest.approx(np.mean(truth_pixels), rel=1e-12)


def test_points_are_measured_from_arrays_and_files(tmp_path):
    points = np.array([(0, 0, 2.5), (0, 0, 2.75), (1, 1, 4)], np.float32)
    found = fathom.evaluate(points, plates(2), within=[0.6], max_distance=2, density=0.3, keep_points=True)
    accuracy = found.accuracy
    assert (accuracy.cloud_points, accuracy.points, accuracy.outliers) == (3, 2, 1)
    assert accuracy.mean == 0.5 and accuracy.shares == (0.5,) and list(accuracy.distances) == [0.5, 2]
    assert found.completeness.cloud_points == 0 and found.depth is None
    assert found.overall == (0.5 + found.completeness.mean) / 2
    file = tmp_path / "cloud.obj"
    file.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in points))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene = fathom.Scene.read(file, clouds=True)
    of_file = fathom.evaluate(scene, plates(2), within=[0.6], max_distance=2, density=0.3)
    assert of_file.overall == found.overall and of_file.f_scores == found.f_scores
    assert of_file.accuracy[:9] == accuracy[:9]
    far = fathom.evaluate(points, points + 10, truth_density=5, max_distance=1)
    assert far.completeness.points == 1 and far.overall is None
    with pytest.warns(UserWarning, match="has no faces"):
        fathom.Scene.read(file)


def test_arguments_are_checked(camera):
    scene = plates(2)
    for wrong in (0, -1, float("inf"), float("nan")):
        with pytest.raises(ValueError, match="within: expected positive"):
            fathom.evaluate(scene, scene, within=[wrong])
    for wrong in (0.5, "0.5"):
        with pytest.raises(TypeError, match="within: expected numbers"):
            fathom.evaluate(scene, scene, within=wrong)
    for name in ("density", "truth_density", "max_distance"):
        with pytest.raises(ValueError, match=f"{name}: expected a positive number"):
            fathom.evaluate(scene, scene, **{name: 0})
        with pytest.raises(TypeError, match=f"{name}: expected a number"):
            fathom.evaluate(scene, scene, **{name: "1"})
    with pytest.raises(fathom.UsageError, match="density: thins a point cloud; the reconstruction has faces"):
        fathom.evaluate(scene, scene, density=1)
    with pytest.raises(TypeError, match="truth: expected a Scene or an N×3 array, found 'scan.ply'; Scene.read"):
        fathom.evaluate(scene, "scan.ply")
    with pytest.raises(ValueError, match="reconstruction: expected shape N×3, found 4"):
        fathom.evaluate(np.zeros(4), scene)
    with pytest.raises(fathom.InputError, match="the reconstruction: has neither faces nor points"):
        fathom.evaluate(np.zeros((0, 3)), scene)
    with pytest.raises(ValueError, match="points: expected 1 to"):
        fathom.evaluate(scene, scene, points=0)
    with pytest.raises(TypeError, match="cameras: expected a Camera or a sequence"):
        fathom.evaluate(scene, scene, {"a": camera})
    with pytest.raises(TypeError, match="camera: expected a Camera"):
        fathom.evaluate(scene, scene, [3])
    with pytest.raises(fathom.InputError, match="the truth: has neither faces nor points"):
        fathom.evaluate(scene, fathom.Scene())
