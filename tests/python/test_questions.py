"""probe, visible, render_deep, verify: judged by fractions, by sums, and by each other."""

import copy
import os
from fractions import Fraction

import numpy as np
import pytest

import fathom
from conftest import source as fathom_source


@pytest.fixture(scope="module")
def camera(spot):
    return fathom.Camera.frame(spot, size=(60, 44))


def test_probe_gives_exact_depths_that_maps_round(spot, camera):
    map = spot.render(camera, channels=("Z", "id"))
    for y, x in np.argwhere(map.mask())[::97]:
        found = fathom.probe(spot, camera, int(x), int(y))
        assert isinstance(found[0].depth, Fraction) and found[0].counts and found[0].edges == (1, 1, 1)
        assert np.float32(float(found[0].depth)) == map["Z"][y, x] and found[0].id == map["id"][y, x]
        assert [each.depth for each in found] == sorted(each.depth for each in found)
        assert found[0].decided_by[0] == "CGAL::determinant over CGAL::Interval_nt"
        assert set(found[0].decided_by[1:]) == {"a linear form over CGAL::Interval_nt"}
    assert fathom.probe(spot, camera, 0, 0) == []
    for place in ((60, 0), (0, 44), (-1, 0)):
        with pytest.raises(ValueError, match="[xy]: expected 0 to"):
            fathom.probe(spot, camera, *place)


def test_visible_areas_are_those_of_rectangles():
    scene = fathom.Scene()
    square = np.array([(0, 0, 1), (8, 0, 1), (8, 8, 1), (0, 8, 1)], float)
    faces = [(0, 1, 2), (0, 2, 3)]
    far = scene.add_mesh(square + (0, 0, 1), faces, name="far")
    scene.add_instance(far, [(0.5, 0, 0, 0), (0, 0.5, 0, 0), (0, 0, 1, -1)], name="near")
    camera = fathom.Camera(16, 16, 1, 1, 0, 0, pixel_centre=0.5, projection="orthographic")
    areas = fathom.visible(scene, camera)
    assert areas.objects.visible.tolist() == [48, 16] and areas.objects.unoccluded.tolist() == [64, 16]
    assert areas.objects.ratio.tolist() == [0.75, 1] and areas.triangles.visible.sum() == 64


def test_visible_areas_add_up_to_coverage(spot, camera):
    areas = fathom.visible(spot, camera)
    coverage = spot.render(camera, channels=("A",))["A"]
    assert np.isclose(areas.triangles.visible.sum(), coverage.sum(dtype=float), rtol=1e-6)
    assert len(areas.triangles.visible) == spot.triangle_count
    assert np.isnan(areas.triangles.ratio[areas.triangles.unoccluded == 0]).all()


def test_deep_maps_are_ragged_arrays(spot, camera):
    deep = fathom.render_deep(spot, camera)
    coverage = spot.render(camera, channels=("A",))["A"]
    assert deep.counts.shape == (44, 60) and deep.counts.sum() == len(deep.Z) == len(deep.id) == deep.offsets[-1]
    sums = np.add.reduceat(np.append(deep.area.astype(float), 0), deep.offsets[:-1].astype(int)).reshape(44, 60)
    assert np.allclose(np.where(deep.counts > 0, sums, 0), coverage, atol=1e-6)
    y, x = np.argwhere(deep.counts > 2)[0]
    depths = deep.Z[deep.at(int(x), int(y))]
    assert len(depths) == deep.counts[y, x] and (np.diff(depths) >= 0).all()


def test_deep_maps_are_written_as_the_program_writes_them(spot, camera, run_program, tmp_path):
    camera.write(tmp_path / "camera.json")
    run_program("render", fathom_source / "data/meshes/spot.obj", "--camera", tmp_path / "camera.json", "--deep", "-o",
                tmp_path / "theirs.exr")
    deep = fathom.render_deep(spot, camera)
    deep.write(tmp_path / "new/folder/ours.exr")
    assert (tmp_path / "new/folder/ours.exr").read_bytes() == (tmp_path / "theirs.exr").read_bytes()
    assert fathom.Camera.from_json(deep.metadata["fathom.camera"]) == camera == deep.camera


@pytest.mark.parametrize("compression", ["none", "rle", "zips"])
def test_deep_maps_are_read_back_bit_for_bit(spot, camera, tmp_path, compression):
    deep = fathom.render_deep(spot, camera)
    deep.write(tmp_path / "deep.exr", compression=compression)
    again = fathom.DeepMap.read(tmp_path / "deep.exr")
    for name in ("Z", "ZBack", "area", "A", "id", "offsets"):
        kept, found = getattr(deep, name), getattr(again, name)
        assert kept.dtype == found.dtype and kept.tobytes() == found.tobytes(), name
    assert again.camera == camera and again.metadata["fathom.sources"] == deep.metadata["fathom.sources"]
    again.write(tmp_path / "again.exr", compression=compression)
    assert (tmp_path / "again.exr").read_bytes() == (tmp_path / "deep.exr").read_bytes()


def test_reading_a_deep_map_as_a_map_names_its_reader(spot, camera, tmp_path):
    fathom.render_deep(spot, camera).write(tmp_path / "deep.exr")
    with pytest.raises(fathom.InputError, match=r"DeepMap\.read in Python"):
        fathom.read_map(tmp_path / "deep.exr")


def test_files_that_are_no_deep_maps_are_refused(spot, camera, tmp_path):
    spot.render(camera).write(tmp_path / "flat.exr")
    (tmp_path / "text.exr").write_text("no")
    fathom.render_deep(spot, camera).write(tmp_path / "cut.exr")
    (tmp_path / "cut.exr").write_bytes((tmp_path / "cut.exr").read_bytes()[:-1])
    for name, text in (("flat.exr", "not a deep map: expected an EXR of deep scan lines in one part"),
                       ("text.exr", r"expected a deep map \(EXR\)"), ("cut.exr", "truncated"), ("missing.exr", "")):
        with pytest.raises(fathom.InputError, match=f"{name}: .*{text}"):
            fathom.DeepMap.read(tmp_path / name)


def test_deep_maps_that_do_not_fit_together_are_refused(spot, camera, tmp_path):
    rendered = fathom.render_deep(spot, camera)

    def change(name, value):
        deep = copy.copy(rendered)
        setattr(deep, name, value(getattr(deep, name)))
        deep.write(tmp_path / "never.exr")

    for name in ("ZBack", "area", "A", "id"):
        with pytest.raises(ValueError, match=f"{name}: expected an array of"):
            change(name, lambda column: column[:-1])
        with pytest.raises(ValueError, match=f"{name}: expected an array of"):
            change(name, lambda column: column.astype(np.float64))
    with pytest.raises(ValueError, match="offsets: expected numbers that rise"):
        change("offsets", lambda offsets: offsets[::-1].copy())
    with pytest.raises(ValueError, match="offsets: expected numbers that rise"):
        change("offsets", lambda offsets: offsets + np.uint64(1))
    for name in ("Z", "ZBack", "area", "A"):
        with pytest.raises(ValueError, match=f"{name}: fragment 7 has NaN"):
            change(name, lambda column: np.where(np.arange(len(column)) == 7, np.float32(np.nan), column))
    with pytest.raises(ValueError, match="ZBack: fragment 3 ends nearer than its Z"):
        change("ZBack", lambda column: np.where(np.arange(len(column)) == 3, np.float32(0), column))
    with pytest.raises(ValueError, match="camera: its image has 44×60 pixels, the deep map 60×44 pixels"):
        change("camera", lambda camera: camera.with_size(44, 60))
    with pytest.raises(ValueError, match="never.npz: expected a name that ends in .exr"):
        rendered.write(tmp_path / "never.npz")
    with pytest.raises(ValueError, match="zips, rle or none"):
        rendered.write(tmp_path / "never.exr", compression="piz")
    assert list(tmp_path.iterdir()) == []


def test_deep_maps_are_written_nearest_first(spot, camera, tmp_path):
    deep = fathom.render_deep(spot, camera)
    steps = np.diff(deep.Z)
    # From one pixel to the next, depths may fall.
    assert (steps < 0).any()
    starts = set(deep.offsets.tolist())
    second = next(i + 1 for i in np.flatnonzero(steps > 0).tolist() if i + 1 not in starts)
    for column in (deep.Z, deep.ZBack):
        column[[second - 1, second]] = column[[second, second - 1]]
    with pytest.raises(ValueError, match=f"Z: fragment {second} is nearer than the one before it in its pixel"):
        deep.write(tmp_path / "never.exr")


def test_cryptomatte_is_what_the_program_writes(spot, camera, run_program, tmp_path):
    camera.write(tmp_path / "camera.json")
    run_program("render", fathom_source / "data/meshes/spot.obj", "--camera", tmp_path / "camera.json",
                "--cryptomatte", "-o", tmp_path / "theirs.exr")
    map = spot.render(camera, channels=("Z", "A"))
    map.add_cryptomatte(spot)
    map.write(tmp_path / "ours.exr")
    assert (tmp_path / "ours.exr").read_bytes() == (tmp_path / "theirs.exr").read_bytes()
    # One object: what it covers is the coverage.
    assert np.array_equal(map["CryptoObject00.G"], map["A"]) and not map["CryptoObject01.G"].any()
    assert sum("spot" in text for name, text in map.metadata.items() if name.endswith("/manifest")) == 1


def test_verify(spot, camera):
    map = spot.render(camera, channels=("Z", "id", "N"))
    right = fathom.verify(map, spot, pixels=500)
    assert (right.verified, right.differing, right.first) == (500, 0, None)
    map["Z"][:] = np.nextafter(map["Z"], np.float32(0))
    wrong = fathom.verify(map, spot, camera, pixels=10**9)
    assert wrong.verified == 60 * 44 and wrong.differing >= map.mask().sum() and wrong.first.channel == "Z"
    with pytest.raises(ValueError, match="found colour"):
        fathom.verify(fathom.Map({"colour": map["Z"]}, camera), spot)
    with pytest.raises(ValueError, match="camera"):
        fathom.verify(fathom.Map({"Z": map["Z"]}), spot)


@pytest.mark.filterwarnings("ignore::fathom.ViewWarning")
def test_cameras_of_all_exponents():
    """Depths, focal lengths, near and far have any exponents, subnormal ones included: every pixel of every channel is
    that of exact arithmetic. FATHOM_FUZZ_CALLS: how many cameras."""
    partly = 0
    for seed in range(int(os.environ.get("FATHOM_FUZZ_CALLS", "100"))):
        draw = np.random.default_rng(seed)
        depth, *across = (int(each) for each in draw.integers(-1074, 1023, 3))
        if seed % 3 == 0:
            depth = int(draw.integers(-1060, -1020))  # 1/far may be infinite
        if seed % 3 < 2:
            across = [depth, depth]
        with np.errstate(over="ignore"):
            focal = np.ldexp(draw.uniform(1, 2, 2) * 8, depth - np.array(across))
        if not (np.isfinite(focal) & (focal != 0)).all():
            continue
        z = draw.uniform(1, 2, 6) - (0 if seed % 2 else draw.integers(0, 4, 6))
        xy = draw.uniform(-0.8, 0.8, (6, 2)) * np.where(z < 0.1, 1, z)[:, None]
        vertices = np.column_stack([np.ldexp(xy, across), np.ldexp(z, depth)])
        ends = np.sort(np.ldexp(draw.uniform(1, 2, 2), [depth, depth if seed % 4 < 3 else int(draw.integers(-1074, 1023))]))
        if not np.isfinite(vertices).all() or not ends[0] < ends[1] < np.inf:
            continue
        scene = fathom.Scene()
        scene.add_mesh(vertices, [(0, 1, 2), (3, 4, 5), (0, 3, 5)])
        camera = fathom.Camera(16, 12, *map(float, focal), 8, 6, pixel_centre=0.5, near=float(ends[0]), far=float(ends[1]))
        channels = ("Z", "A", "Zlow", "distance", "id", "N", "Nc", "P", "bary")
        found = scene.render(camera, channels=channels)
        assert fathom.verify(found, scene, pixels=16 * 12).differing == 0, seed
        partly += int(((found["A"] > 0) & (found["A"] < 1)).sum())
    assert partly > 500
