"""fathom.validate(), assert_depth(), and the fixture of pytest's."""

import re
import subprocess
import sys

import numpy as np
import pytest

import fathom
from fathom.testing import assert_depth
from fathom.validation import CLASSES


@pytest.fixture(scope="module")
def camera(spot):
    return fathom.Camera.frame(spot, size=(80, 60), near=1, far=10)


@pytest.fixture(scope="module")
def depths(spot, camera):
    return spot.render(camera)["Z"]


def test_the_truth_is_equal_everywhere(spot, camera, depths):
    found = fathom.validate(depths, spot, camera, "float32-ray")
    assert found.is_good and found.counts == {CLASSES[0]: 80 * 60} and found.unexplained == 0
    assert found.classes.shape == (60, 80) and found.model == "float32-ray" and found.findings == []
    seen = np.isfinite(depths)
    assert (found.least[seen] <= depths[seen]).all() and (depths[seen] <= found.greatest[seen]).all()
    assert fathom.validate(depths, spot, camera).is_good


def stored(depths, camera, **format):
    """As a depth buffer would have it, decoded again."""
    codes = fathom.DepthFormat("standard", "unorm24", near=camera.near, far=camera.far)
    seen = np.isfinite(depths)
    result = depths.copy()
    result[seen] = codes.decode(codes.encode(depths[seen]))
    return result


@pytest.mark.parametrize("spoil, kind", [
    (lambda d: np.roll(d, 1, axis=1), "shift"),
    (lambda d: d[:, ::-1].copy(), "mirrored"),
    (lambda d: d[::-1].copy(), "mirrored"),
    (lambda d: d * np.float32(1000), "unit|scale"),
])
def test_faults_are_named(spot, camera, depths, spoil, kind):
    found = fathom.validate(spoil(depths), spot, camera, "float32-ray")
    assert not found.is_good and re.search(kind, found.findings[0].kind), found.findings
    assert found.findings[0].kind in found.cause and "\n" not in found.cause
    assert found.findings[0].pixels > 100


@pytest.mark.parametrize("model, params", [("SIMPLE_RADIAL", [70, 40, 30, -0.3]),
                                           ("OPENCV", [70, 70, 40, 30, -0.2, 0.03, 0.003, -0.002])])
def test_maps_of_lenses_are_judged(spot, model, params):
    pose = [[1, 0, 0, 0], [0, -1, 0, 0.1], [0, 0, -1, 2]]
    camera = fathom.Camera(80, 60, model=model, params=params, pixel_centre=0.5, world_to_camera=pose)
    maps = spot.render(camera, channels=("Z", "distance"))
    right = fathom.validate(maps["Z"], spot, camera)
    assert right.is_good and right.counts == {CLASSES[0]: 80 * 60} and right.camera == camera
    pinhole = fathom.Camera(80, 60, 70, 70, 40, 30, pixel_centre=0.5, world_to_camera=pose)
    for map, kind in ((maps["distance"], "ray-distance"), (spot.render(pinhole)["Z"], "lens-ignored")):
        found = fathom.validate(map, spot, camera)
        assert [each.kind for each in found.findings] == [kind] and found.unexplained < found.findings[0].pixels / 10
    with pytest.raises(ValueError, match="a graphics pipeline draws straight edges"):
        fathom.validate(maps["Z"], spot, camera, "gl-unorm24")


def test_quantities_are_estimated(spot, camera, depths):
    moved = fathom.Camera.from_json(camera.to_json().replace(f'"cx": {camera.cx:g}', f'"cx": {camera.cx + 0.25:g}'))
    assert moved != camera
    found = fathom.validate(spot.render(moved)["Z"], spot, camera, "float32-ray")
    assert found.findings[0].kind == "shift"
    assert np.isclose(found.findings[0].estimates[0].value, 0.25, atol=1e-3)


def test_maps_of_another_size_are_judged_as_what_explains_them(spot, camera, depths):
    def found(map):
        return fathom.validate(map, spot, camera, "float32-ray")

    cropped = found(depths[:, 2:].copy())
    assert cropped.findings[0].kind == "size" and "2 columns missing at the left" in cropped.cause
    assert cropped.camera.size == (78, 60) and cropped.camera.cx == camera.cx - 2
    assert cropped.classes.shape == (60, 78) and cropped.unexplained == 0

    exchanged = found(depths.T.copy())
    assert exchanged.findings[0].kind == "axes" and exchanged.camera == camera and exchanged.unexplained == 0

    larger = fathom.Camera.frame(spot, size=(160, 120), near=1, far=10)
    doubled = found(spot.render(larger)["Z"])
    assert doubled.findings[0].kind == "size" and doubled.camera.size == (160, 120)
    assert doubled.classes.shape == (120, 160) and doubled.unexplained == 0


def test_a_map_of_another_scene_is_called_so(camera, depths):
    scene = fathom.Scene()
    scene.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
    assert fathom.validate(depths, scene, camera, "float32-ray").findings[0].kind == "other-scene"


def test_a_wrong_model_is_blamed_alone_and_the_one_that_fits_is_named(spot, depths):
    near = fathom.Camera.frame(spot, size=(80, 60), near=0.001, far=10)
    found = fathom.validate(stored(depths, near), spot, near, "float32-ray")
    assert [finding.kind for finding in found.findings] == ["model"] and found.unexplained == 0
    assert found.verdict.startswith(f"failed: the model float32-ray does not fit: as {found.model} every pixel is")
    assert found.report().startswith(found.verdict + f"\nmodel: {found.model}\n")
    assert fathom.validate(stored(depths, near), spot, near).verdict == "every pixel is explained"


def test_a_report_of_another_size_is_kept(spot, camera, depths, tmp_path):
    with pytest.raises(AssertionError, match="2 columns missing"):
        assert_depth(depths[:, 2:].copy(), spot, camera, "float32-ray", report=tmp_path)
    assert np.load(tmp_path / "classes.npy").shape == fathom.read_map(tmp_path / "map.exr")["Z"].shape == (60, 78)


def test_a_single_wrong_pixel_is_found(spot, camera, depths):
    y, x = np.argwhere(np.isfinite(depths))[500]
    wrong = depths.copy()
    wrong[y, x] += 1
    with pytest.raises(AssertionError, match=rf"\({x}, {y}\)"):
        assert_depth(wrong, spot, camera, "float32-ray")
    assert assert_depth(depths, spot, camera, "float32-ray").is_good


def test_reports_are_kept(spot, camera, depths, tmp_path):
    with pytest.raises(AssertionError, match="report in"):
        assert_depth(depths[::-1].copy(), spot, camera, "float32-ray", report=tmp_path / "a/b")
    folder = tmp_path / "a/b"
    assert np.load(folder / "classes.npy").shape == (60, 80)
    assert fathom.Camera.read(folder / "camera.json") == camera
    assert np.array_equal(fathom.read_map(folder / "map.exr")["Z"], depths[::-1])
    assert "the vertical axis is flipped" in (folder / "report.txt").read_text()
    page = (folder / "report.html").read_text()
    assert "the vertical axis is flipped" in page and "<td>orange</td>" in page and "data:image/png;base64," in page


def test_the_fixture(tmp_path):
    (tmp_path / "conftest.py").write_text('pytest_plugins = ["fathom.testing"]\n')
    (tmp_path / "test_mine.py").write_text('''
import fathom

def setup():
    scene = fathom.Scene()
    scene.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
    camera = fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
    return scene, camera, scene.render(camera)["Z"]

def test_right(assert_depth):
    scene, camera, depths = setup()
    assert_depth(depths, scene, camera, model="float32-ray")

def test_mirrored(assert_depth):
    scene, camera, depths = setup()
    assert_depth(depths[:, ::-1].copy(), scene, camera, model="float32-ray")
''')
    told = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"], cwd=tmp_path,
                          capture_output=True, text=True).stdout
    assert "1 failed, 1 passed" in told and "AssertionError: mirrored: the image is mirrored" in told, told
    assert (tmp_path / "fathom-reports/test_mine/test_mirrored/report.txt").exists()
    assert not (tmp_path / "fathom-reports/test_mine/test_right").exists()


@pytest.mark.parametrize("report, words", [
    ("/proc/zz", "no report in /proc/zz: No such file or directory"),
    ("/dev/null/zz", "no report in /dev/null/zz: Not a directory"),
    ("z" * 300, "no report in z+: File name too long"),
    (b"x", "no report: expected the name of a folder, found b'x'"),
    (5, "no report: expected the name of a folder, found 5"),
])
def test_no_report_hides_the_failure(spot, camera, depths, report, words):
    with pytest.raises(AssertionError, match=rf"the vertical axis is flipped.*\({words}\)"):
        assert_depth(depths[::-1].copy(), spot, camera, "float32-ray", report=report)


def test_reports_of_lists_and_of_maps_that_cannot_be_written(spot, camera, depths, tmp_path):
    upside_down = depths[::-1].copy()
    with pytest.raises(AssertionError, match="flipped.*report in"):
        assert_depth({"Z": upside_down.tolist()}, spot, camera, "float32-ray", report=tmp_path / "list")
    assert np.array_equal(fathom.read_map(tmp_path / "list/map.exr")["Z"], upside_down)
    (tmp_path / "full/map.exr").mkdir(parents=True)
    with pytest.raises(AssertionError, match="flipped.*report in"):
        assert_depth(upside_down, spot, camera, "float32-ray", report=tmp_path / "full")
    assert "no map.exr: " in (tmp_path / "full/map.txt").read_text()
    assert np.load(tmp_path / "full/classes.npy").shape == (60, 80)


def test_every_failure_has_a_report_of_its_own(tmp_path):
    (tmp_path / "conftest.py").write_text('pytest_plugins = ["fathom.testing"]\n')
    (tmp_path / "pytest.ini").write_text("[pytest]\naddopts = --import-mode=importlib\n")
    (tmp_path / "inner").mkdir()
    for file in ("test_a.py", "inner/test_a.py"):
        (tmp_path / file).write_text('''
import fathom
import pytest

scene = fathom.Scene()
scene.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
camera = fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
mirrored = scene.render(camera)["Z"][:, ::-1].copy()

class TestA:
    def test_bad(self, assert_depth):
        assert_depth(mirrored, scene, camera, model="float32-ray")

class TestB:
    def test_bad(self, assert_depth):
        for _ in range(3):
            with pytest.raises(AssertionError, match="mirrored"):
                assert_depth(mirrored, scene, camera, model="float32-ray")

@pytest.mark.parametrize("name", ["a b", "a-b", "a/b", "a::b", "..", "x" * 300])
def test_bad(name, assert_depth):
    assert_depth(mirrored, scene, camera, model="float32-ray")
''')
    told = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"], cwd=tmp_path,
                          capture_output=True, text=True).stdout
    assert "14 failed, 2 passed" in told and "no report" not in told, told
    reports = tmp_path / "fathom-reports"
    kept = sorted(str(file.parent.relative_to(reports)) for file in reports.rglob("report.txt"))
    assert len(kept) == 2 * (1 + 3 + 6), kept
    for file in ("test_a", "inner/test_a"):
        for folder in ("TestA/test_bad", "TestB/test_bad", "TestB/test_bad/2", "TestB/test_bad/3", "test_bad-a-b"):
            assert f"{file}/{folder}" in kept, kept


@pytest.mark.parametrize("change, error, words", [
    ({"model": "gl-unorm25"}, ValueError, "gl-unorm25"),
    ({"model": 5}, TypeError, "model: expected a name"),
    ({"map": np.ones((3, 7), np.float32)}, ValueError, "map: has 7x3 pixels, the camera 80x60; expected the camera"),
    ({"map": np.zeros((60, 80), np.uint8)}, TypeError, "expected float32"),
    ({"map": np.ones((60, 80), np.uint16)}, ValueError, r"map: codes of uint16 need a scale: fathom.Map\({'Z': codes}, scale=1000\)"),
    ({"channel": "Y"}, ValueError, "Y"),
    ({"channel": None}, TypeError, "channel: expected a name, found None"),
    ({"scene": None}, TypeError, "scene: expected a Scene"),
    ({"camera": None}, TypeError, "camera: expected a Camera"),
])
def test_wrong_arguments(spot, camera, depths, change, error, words):
    arguments = {"map": depths, "scene": spot, "camera": camera, "model": "float32-ray", **change}
    with pytest.raises(error, match=words):
        fathom.validate(**arguments)


def test_models_that_need_near_and_far(spot, depths):
    with pytest.raises(fathom.UsageError, match="near and far"):
        fathom.validate(depths, spot, fathom.Camera.frame(spot, size=(80, 60)), "gl-unorm24")
