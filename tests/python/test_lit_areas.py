"""fathom.areas(), `fathom areas` and `fathom sun`."""

import csv
import datetime
import json
import math
import os
import pathlib
import subprocess
import sys
import types
from fractions import Fraction

import fathom
import numpy as np
import pytest

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
satellite = source / "data/scenes/satellite.json"
louvre = source / "data/scenes/louvre.json"


def run(*arguments, status=0, **options):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    ran = subprocess.run([os.environ["FATHOM_PROGRAM"], *map(str, arguments)], capture_output=True, text=True,
                         env=environment, **options)
    assert ran.returncode == status, ran.stderr
    return ran.stdout if status == 0 else ran.stderr


# The satellite of sksat/orts, issue 407: docs/areas-satellite.md.

suns = [(1, -1, 0), (15, -26, 0), (4, -11, 0)]
panel_shares = [Fraction(4, 5), Fraction(37, 60), Fraction(29, 80)]
face_shares = [Fraction(3, 5), Fraction(29, 52), Fraction(59, 110)]


def test_fractions_of_a_satellite():
    found = fathom.areas(fathom.Scene.read(satellite), directions=suns, alone=True)
    panel, face = found.names.index("panel +y"), found.names.index("face -y")
    for i in range(3):
        assert found.exact(i, panel).fraction == panel_shares[i]
        assert found.exact(i, face).fraction == face_shares[i]
        assert found.fraction[i, panel] == float(panel_shares[i])
    np.testing.assert_array_equal(found.lit[:, panel], [float(200 * share) for share in panel_shares])
    assert found.centroid[1, panel].tolist() == [0, float(Fraction(119, 6)), 0]
    assert found.centroid[2, face].tolist() == [float(Fraction(51, 22)), -5, 0]
    assert found.background is None


def test_the_published_table_of_the_satellite_is_a_sampled_one():
    published = [("80.0", "60.0"), ("61.8", "55.8"), ("36.3", "53.8")]

    def shares(tau):
        return 1.05 - tau / 4, 0.5 + 0.1 / tau

    def sampled(share, count):
        """The share of midpoints that a border at this share leaves, in percent with one digit, rounded half up."""
        lit = sum((k + 0.5) / count < share - 1e-12 for k in range(count))
        return f"{math.floor(1000 * lit / count + 0.5) / 10:.1f}"

    tangents = [math.tan(math.radians(theta)) for theta in (45, 60, 70)]
    fitting = [count for count in range(10, 1001)
               if all((sampled(panel, count), sampled(face, count)) == text
                      for text, (panel, face) in zip(published, map(shares, tangents)))]
    assert fitting == [400]


# The window behind louvres: docs/areas-window.md.

@pytest.mark.parametrize("azimuth, elevation", [(180, 30), (200, 20), (150.5, 12.25), (180, 44), (180, 46), (119, 1), (0, 30)])
def test_a_window_behind_louvres_has_a_closed_form(tmp_path, azimuth, elevation):
    (tmp_path / "suns.csv").write_text(f"azimuth,elevation\n{azimuth},{elevation}\n")
    run("areas", louvre, "--directions", "suns.csv", "--alone", "-o", "areas.npz", cwd=tmp_path)
    with np.load(tmp_path / "areas.npz") as arrays:
        window = arrays["names"].tolist().index("window")
        found = arrays["fraction"][0, window]
    cosine = math.cos(math.radians(azimuth - 180))
    expected = 1 - math.tan(math.radians(elevation)) / cosine if cosine > 0 else 1
    assert found == pytest.approx(max(expected, 0), abs=1e-14)


# The answers of Python.

def plates():
    """A square of 4 above half of a rectangle of 8."""
    scene = fathom.Scene()
    scene.add_mesh([(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)], [(0, 1, 2), (0, 2, 3)], name="upper")
    scene.add_mesh([(0, 0, 0), (4, 0, 0), (4, 2, 0), (0, 2, 0)], [(0, 1, 2), (0, 2, 3)], name="lower")
    return scene


def test_areas_have_a_row_for_each_light_and_a_column_for_each_item():
    found = fathom.areas(plates(), directions=[(0, 0, 5), (0, 0, -1), (1, 0, 0)], alone=True)
    assert repr(found) == "Areas(3 × 2 by object)" and found.names == ["upper", "lower"]
    assert found.visible.tolist() == [[4, 4], [0, 8], [0, 0]]
    np.testing.assert_array_equal(found.fraction, [[1, 0.5], [0, 1], [math.nan, math.nan]])
    assert found.centroid.shape == (3, 2, 3) and found.centroid[0, 1].tolist() == [3, 1, 0]
    assert np.isnan(found.centroid[1, 0]).all()
    assert found.sides is None and found.objects is None
    assert np.isnan(fathom.areas(plates(), directions=(0, 0, 1)).fraction).all()


def test_areas_of_triangles_have_sides_and_origins():
    found = fathom.areas(plates(), directions=[(0, 0, 1), (0, 0, -1), (0, 1, 0)], by="triangle")
    assert found.sides.tolist() == [[1] * 4, [-1] * 4, [0] * 4]
    assert found.objects.tolist() == [0, 0, 1, 1] and found.faces.tolist() == [0, 1, 0, 1]
    assert found.exact(0, 2).fraction + found.exact(0, 3).fraction == 1
    faces = fathom.areas(fathom.Scene.read(satellite), directions=suns, by="face")
    assert len(faces.names) == 8 and faces.faces.tolist() == [0] * 8


def test_exact_areas_are_fractions_where_they_are_rational():
    found = fathom.areas(plates(), directions=[(3, 0, 4), (1, 0, 1)], alone=True)
    area = found.exact(0, 1)
    assert (area.visible, area.projected, area.fraction) == (Fraction(22, 5), Fraction(32, 5), Fraction(11, 16))
    askew = found.exact(1, 1)
    assert askew.fraction == Fraction(3, 4)
    with pytest.raises(ValueError, match="visible: not rational: it is 3 times the square root of 2"):
        askew.visible
    with pytest.raises(ValueError, match="alone=True"):
        fathom.areas(plates(), directions=(0, 0, 1)).exact(0, 0).fraction
    with pytest.raises(ValueError, match="projected area is 0"):
        fathom.areas(plates(), directions=(1, 0, 0), alone=True).exact(0, 0).fraction
    with pytest.raises(ValueError, match="j: expected 0 to 1, found 2"):
        found.exact(0, 2)


def test_areas_from_cameras_are_those_of_visible():
    scene = fathom.Scene.read(source / "data/meshes/house.gltf")
    cameras = [fathom.Camera.frame(scene, azimuth=azimuth, elevation=12, size=(64, 48)) for azimuth in (30, 75)]
    found = fathom.areas(scene, camera=cameras, alone=True)
    for i, camera in enumerate(cameras):
        objects = fathom.visible(scene, camera).objects
        np.testing.assert_array_equal(found.visible[i], objects.visible)
        np.testing.assert_array_equal(found.projected[i], objects.unoccluded)
        np.testing.assert_array_equal(found.fraction[i], objects.ratio)
    assert found.background == pytest.approx(64 * 48 - found.visible.sum(axis=1), rel=1e-12)
    assert found.exact(1, 0).visible == pytest.approx(found.visible[1, 0], rel=1e-15)
    one = fathom.areas(scene, camera=cameras[1], by="triangle", threads=1)
    assert one.lit.shape == (1, 32)
    np.testing.assert_array_equal(one.visible[0], fathom.visible(scene, cameras[1]).triangles.visible)


def test_areas_from_points_are_shares():
    found = fathom.areas(plates(), points=[(1, 1, 0.5), (1, 1, 9)], by="triangle")
    assert found.fraction[0].tolist()[:2] == [1, 1] and np.isnan(found.visible).all()
    assert found.exact(0, 0).fraction == 1
    assert 0 < found.exact(1, 2).fraction < 1
    groups = fathom.areas(plates(), points=(1, 1, 0.5))
    assert groups.lit[0].tolist() == [4, 8]


def test_a_scene_that_grows_later_keeps_its_areas():
    scene = plates()
    found = fathom.areas(scene, directions=(0, 0, 1), alone=True)
    scene.add_mesh([(-9, -9, 5), (9, -9, 5), (0, 30, 5)], [(0, 1, 2)])
    assert found.exact(0, 0).fraction == 1


def test_dataframes_have_the_columns_of_the_table(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pandas", None)
    found = fathom.areas(plates(), directions=[(0, 0, 1), (0, 0, -1)], by="triangle")
    with pytest.raises(ImportError, match="needs pandas"):
        found.to_dataframe()
    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=dict))
    columns = found.to_dataframe()
    assert list(columns) == ["direction", "name", "number", "object", "face", "side", "projected", "visible", "fraction",
                             "lit", "x", "y", "z"]
    assert {len(values) for values in columns.values()} == {8}
    assert columns["direction"].tolist() == [0] * 4 + [1] * 4
    assert columns["side"].tolist() == ["front"] * 4 + ["back"] * 4
    assert columns["name"][2] == "lower" and columns["object"].tolist() == [0, 0, 1, 1] * 2


@pytest.mark.parametrize("arguments, error, message", [
    ({}, ValueError, "expected one of directions, points and camera, found none"),
    ({"directions": (0, 0, 1), "points": (0, 0, 1)}, ValueError, "found directions and points"),
    ({"directions": [(0, 0, 1), (0, 0, 0)]}, ValueError, "the direction at 1 is 0"),
    ({"directions": (0, math.nan, 1)}, ValueError, "is not a finite number"),
    ({"directions": (0, 1)}, ValueError, "expected shape N×3, found 2"),
    ({"directions": np.empty((0, 3))}, ValueError, "expected shape N×3, found 0×3"),
    ({"directions": (0, 0, 1), "by": "objects"}, ValueError, "by: expected 'object'"),
    ({"directions": (0, 0, 1), "centroid": "on"}, ValueError, "centroid: expected 'across'"),
    ({"points": (0, 0, 1), "centroid": "across"}, ValueError, "'across' is for directions"),
    ({"points": (0, 0, 1), "alone": True}, ValueError, "groups have no projected area"),
    ({"camera": "camera.json"}, TypeError, "fathom.read_cameras"),
    ({"camera": []}, ValueError, "an empty list"),
    ({"directions": (0, 0, 1), "threads": -1}, ValueError, "threads"),
])
def test_other_arguments_are_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        fathom.areas(plates(), **arguments)


# Tables.

def numbers_of(rows, name):
    return np.array([float(row[name] or "nan") for row in rows])


@pytest.mark.parametrize("by", ["object", "face", "triangle"])
def test_csv_json_and_npz_have_what_python_answers(tmp_path, by):
    (tmp_path / "suns.csv").write_text("name,x,y,z,visible\nmörgen,1,-1,0,a\nnoon,15,-26,0,\n")
    alone = [] if by == "triangle" else ["--alone"]
    found = fathom.areas(fathom.Scene.read(satellite), directions=suns[:2], by=by, alone=bool(alone))
    files = [tmp_path / f"areas.{suffix}" for suffix in ("csv", "json", "npz")]
    for file in files:
        run("areas", satellite, "--directions", "suns.csv", "--by", by, *alone, "-o", file, cwd=tmp_path)
    with open(files[0], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    listed = json.loads(files[1].read_text(encoding="utf-8"))
    assert list(listed[0]) == list(rows[0]) and len(rows) == len(listed) == found.lit.size
    with np.load(files[2]) as arrays:
        for name in ("projected", "visible", "fraction", "lit"):
            expected = getattr(found, name)
            np.testing.assert_array_equal(arrays[name], expected)
            np.testing.assert_array_equal(numbers_of(rows, name), expected.ravel())
            np.testing.assert_array_equal(np.array([row[name] for row in listed], float), expected.ravel())
        np.testing.assert_array_equal(arrays["centroid"], found.centroid)
        assert arrays["names"].tolist() == found.names and arrays["number"].tolist() == found.numbers.tolist()
        assert arrays["lights"].tolist() == [list(sun) for sun in suns[:2]]
        assert arrays["name"].tolist() == ["mörgen", "noon"] and arrays["light_visible"].tolist() == ["a", ""]
        assert ("side" in arrays) == (by == "triangle")
        if by == "triangle":
            np.testing.assert_array_equal(arrays["side"], found.sides)
        if by != "object":
            np.testing.assert_array_equal(arrays["object"], found.objects)
            np.testing.assert_array_equal(arrays["face"], found.faces)


def test_npz_of_cameras_and_of_a_scene_without_triangles(tmp_path):
    run("areas", satellite, "--size", "32x24", "-o", tmp_path / "areas.npz")
    with np.load(tmp_path / "areas.npz") as arrays:
        assert arrays["visible"].shape == (1, 8) and "lights" not in arrays
    (tmp_path / "points.obj").write_text("v 0 0 0\nv 1 0 0\n")
    (tmp_path / "suns.csv").write_text("x,y,z\n0,0,1\n")
    run("areas", "points.obj", "--directions", "suns.csv", "-o", "areas.npz", cwd=tmp_path)
    with np.load(tmp_path / "areas.npz") as arrays:
        assert arrays["visible"].tolist() == [[0]] and arrays["names"].tolist() == ["points"]


@pytest.mark.parametrize("suffix", ["csv", "json", "npz"])
def test_a_table_that_does_not_fit_the_disk_leaves_no_file(tmp_path, suffix):
    lines = "".join(f"{k},1,2\n" for k in range(200))
    (tmp_path / "suns.csv").write_text("x,y,z\n" + lines)
    program = os.environ["FATHOM_PROGRAM"]
    limited = f"ulimit -f 16; trap '' XFSZ; exec {program} areas {satellite} --directions suns.csv -o areas.{suffix}"
    ran = subprocess.run(["/bin/bash", "-c", limited], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 4 and f"areas.{suffix}: File too large" in ran.stderr
    assert [file.name for file in tmp_path.iterdir()] == ["suns.csv"]


# Positions of the sun.

place = ("--latitude", 48.1, "--longitude", 11.6)


def test_a_year_of_hours():
    rows = list(csv.DictReader(run("sun", *place, "--dates", "2026-01-01:2026-12-31").splitlines()))
    assert len(rows) == 8760 and list(rows[0]) == ["time", "azimuth", "elevation", "x", "y", "z", "name"]
    assert rows[0]["time"] == "2026-01-01T00:00:00Z" and rows[-1]["name"] == "2026-12-31 23:00"
    x, y, z, a, e = (numbers_of(rows, name) for name in ("x", "y", "z", "azimuth", "elevation"))
    np.testing.assert_allclose(np.hypot(np.hypot(x, y), z), 1, rtol=1e-15)
    np.testing.assert_allclose(np.degrees(np.arctan2(x, y)) % 360, a, atol=1e-9)
    np.testing.assert_allclose(np.degrees(np.arcsin(z)), e, atol=1e-7)
    assert 65 < e.max() < 65.34 and -65.34 < e.min() < -65
    assert ((a >= 0) & (a < 360)).all()


def test_known_positions():
    # NREL/TP-560-34302, table A5.1, without refraction.
    golden = ("--latitude", 39.742476, "--longitude", -105.1786, "--utc-offset", "-07:00")
    rows = list(csv.DictReader(run("sun", *golden, "--dates", "2003-10-17", "--every", "30s").splitlines()))
    row = next(row for row in rows if row["time"] == "2003-10-17T12:30:30-07:00")
    assert row["name"] == "2003-10-17 12:30:30"
    assert float(row["azimuth"]) == pytest.approx(194.340241, abs=0.01)
    assert float(row["elevation"]) == pytest.approx(39.872046, abs=0.01)


def test_days_begin_by_the_local_clock_and_nights_may_be_left_out():
    whole = list(csv.DictReader(run("sun", *place, "--dates", "2024-02-28:2024-03-01", "--every", "15m", "--utc-offset",
                                    "+05:45").splitlines()))
    assert len(whole) == 3 * 96 and whole[96]["time"] == "2024-02-29T00:00:00+05:45"
    utc = datetime.datetime.fromisoformat(whole[0]["time"]).astimezone(datetime.timezone.utc)
    assert (utc.day, utc.hour, utc.minute) == (27, 18, 15)
    day = list(csv.DictReader(run("sun", *place, "--dates", "2024-02-28:2024-03-01", "--every", "15m", "--utc-offset",
                                  "5.75", "--above", "0").splitlines()))
    assert day == [row for row in whole if float(row["elevation"]) > 0] and 100 < len(day) < 150


def test_areas_read_tables_of_the_sun(tmp_path):
    run("sun", *place, "--dates", "2026-06-21", "--every", "6h", "-o", "suns.csv", cwd=tmp_path)
    rows = list(csv.DictReader(run("areas", louvre, "--directions", "suns.csv", cwd=tmp_path).splitlines()))
    assert rows[6]["light_name"] == "2026-06-21 06:00"
    assert float(rows[6]["elevation"]) > 0 and float(rows[6 * 2 + 1]["lit"]) > 0


@pytest.mark.parametrize("arguments, message", [
    (("--latitude", 91, "--longitude", 0, "--dates", "2026-01-01"), "'91' is not a latitude"),
    (("--latitude", 0, "--longitude", "181", "--dates", "2026-01-01"), "'181' is not a longitude"),
    ((*place, "--dates", "2026-02-29"), "'2026-02-29' is in no calendar"),
    ((*place, "--dates", "1949-12-31"), "outside the years 1950 to 2050"),
    ((*place, "--dates", "2026-1-1"), "is not a date like"),
    ((*place, "--dates", "2026-01-02:2026-01-01"), "ends before it begins"),
    ((*place, "--dates", "2026-01-01", "--every", "0h"), "is not a time span"),
    ((*place, "--dates", "2026-01-01", "--every", "1.5h"), "is not a time span"),
    ((*place, "--dates", "1950-01-01:2050-12-31", "--every", "1s"), "expected at most 10000000"),
    ((*place, "--dates", "2026-01-01", "--utc-offset", "15"), "is not an offset"),
    ((*place, "--dates", "2026-01-01", "--utc-offset", "1:5"), "is not an offset"),
    ((*place, "--dates", "1950-01-01", "--utc-offset", "1"), "outside the years 1950 to 2050 in UTC"),
    (place, "--dates"),
])
def test_other_requests_are_refused(arguments, message):
    told = run("sun", *arguments, status=2)
    assert message in told and told.count("\n") == 1
