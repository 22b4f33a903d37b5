"""fathom.Map: files, comparison, conversion, points."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])

all_channels = ("Z", "A", "id", "object", "N", "P", "bary", "distance")


@pytest.fixture(scope="module")
def camera(spot):
    return fathom.Camera.frame(spot, size=(80, 60))


@pytest.fixture
def map(spot, camera):
    return spot.render(camera, channels=all_channels)


def test_exr_keeps_channels_camera_and_metadata(map, camera, tmp_path):
    map.write(tmp_path / "map.exr")
    again = fathom.read_map(tmp_path / "map.exr")
    assert set(again) == set(map)
    for name, values in map.items():
        assert again[name].tobytes() == values.tobytes() and again[name].shape == values.shape
    assert again.camera == camera and again.objects == map.objects == ["spot"]
    assert again.metadata["fathom.sources"] == map.metadata["fathom.sources"] != ""


def test_other_programs_read_what_is_written(map, tmp_path):
    map.write(tmp_path / "map.exr")
    code = ("import OpenImageIO, sys; b = OpenImageIO.ImageBuf(sys.argv[1]); n = b.spec().channelnames;"
            "p = b.get_pixels(OpenImageIO.FLOAT); print(n.index('Z') >= 0, float(p[30, 40, n.index('Z')]).hex())")
    told = subprocess.run(["/usr/bin/python3", "-c", code, str(tmp_path / "map.exr")], check=True, capture_output=True,
                          text=True).stdout.split()
    assert told == ["True", float(map["Z"][30, 40]).hex()]


def test_npz_keeps_everything_and_numpy_reads_it(map, camera, tmp_path):
    import json

    map.write(tmp_path / "map.npz")
    again = fathom.read_map(tmp_path / "map.npz")
    assert again.camera == camera
    with np.load(tmp_path / "map.npz") as file:
        assert json.loads(file["fathom"].item())
        for name, values in map.items():
            assert again[name].tobytes() == values.tobytes() and np.array_equal(file[name], values, equal_nan=True)


def test_vectors_in_npy(map, tmp_path):
    map.write(tmp_path / "n.npy", channel="N")
    assert np.array_equal(np.load(tmp_path / "n.npy"), map["N"])


def test_opencv_reads_a_channel_called_y(map, tmp_path):
    fathom.Map({"Z": map["Z"]}).write(tmp_path / "y.exr", names={"Z": "Y"})
    code = ("import os; os.environ['OPENCV_IO_ENABLE_OPENEXR'] = '1'; import cv2, sys;"
            "cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED).tofile(sys.argv[2])")
    subprocess.run(["/usr/bin/python3", "-c", code, tmp_path / "y.exr", tmp_path / "raw"], check=True)
    assert (tmp_path / "raw").read_bytes() == map["Z"].tobytes()
    assert np.array_equal(fathom.read_map(tmp_path / "y.exr")["Z"], map["Z"])
    with pytest.raises(TypeError, match="names: expected a string, found 5"):
        map.write(tmp_path / "y.exr", names={"Z": 5})


@pytest.mark.parametrize("value", [0, np.nan, -1.5])
def test_files_and_masks_know_the_background(spot, camera, map, value, tmp_path):
    other = spot.render(camera, channels=("Z", "distance"), background=value)
    assert np.array_equal(other.mask(), map.mask()) and np.array_equal(other.points(), fathom.Map({"Z": map["Z"]}, camera).points())
    other.write(tmp_path / "map.exr")
    again = fathom.read_map(tmp_path / "map.exr")
    assert np.array_equal(again.background, value, equal_nan=True) and np.array_equal(again.mask(), map.mask())
    compared = fathom.compare(map, again, channel="Z").channels[0]
    assert compared.within_tolerance and compared.both == map.mask().sum()
    assert np.array_equal(again.to_distance()["distance"][map.mask()], map.to_distance()["distance"][map.mask()])
    with pytest.raises(ValueError, match="expected a background of inf"):
        fathom.verify(again, spot)


def test_a_background_that_a_surface_has(spot, camera, map):
    depth = float(map["Z"][map.mask()][7])
    with pytest.raises(fathom.OutputError, match="a surface has the value .* so that it cannot be the background"):
        spot.render(camera, background=depth)


def test_metrics(map):
    seen = map.mask()
    truth = map["Z"].astype(float)[seen]
    other = map["Z"].copy()
    other[seen] *= np.random.default_rng(2).uniform(0.7, 1.4, seen.sum()).astype(np.float32)
    d = other.astype(float)[seen]
    found = fathom.compare(map, other, channel="Z", metrics=True).channels[0].depth_metrics
    ratio = np.maximum(d / truth, truth / d)
    assert found.pixels == seen.sum() and np.isclose(found.abs_rel, (abs(d - truth) / truth).mean(), rtol=1e-12)
    assert np.isclose(found.rmse, np.sqrt(((d - truth) ** 2).mean()), rtol=1e-12) and found.delta_1 == (ratio < 1.25).mean()
    found = fathom.compare(truth.reshape(1, -1), d.reshape(1, -1), metrics="disparity").channels[0].disparity_metrics
    assert found.bad_1 == (abs(d - truth) > 1).mean() and np.isclose(found.epe, abs(d - truth).mean(), rtol=1e-12)
    assert fathom.compare(map, other, channel="Z", tolerance_relative=0.5).within_tolerance
    assert not fathom.compare(map, other, channel="Z", tolerance_absolute=0.5).within_tolerance
    with pytest.raises(ValueError, match="metrics: expected"):
        fathom.compare(map, other, metrics="all")


def test_a_png_holds_the_depths_unless_another_channel_is_named(map, tmp_path):
    """As of `fathom render -o x.png`: Z, 1000 codes per scene unit."""
    file = tmp_path / "x.png"
    both = fathom.Map({"A": np.ones_like(map["Z"]), "Z": map["Z"]}, map.camera)
    for each in (both, fathom.Map({"Z": map["Z"]})):
        each.write(file)
        again = fathom.read_map(file)
        assert list(again) == ["Z"] and again.scale == 1000
        assert np.array_equal(again["Z"], map.stored_as("uint16", channel="Z", scale=1000)["Z"])
    codes = map.stored_as("uint16", channel="Z", scale=500)
    codes.write(file)
    assert fathom.read_map(file).scale == 500
    both.write(file, scale=200)
    assert fathom.read_map(file).scale == 200
    with pytest.raises(fathom.UsageError, match="name the one to write"):
        fathom.Map({"A": both["A"], "id": map["id"]}).write(file)


def test_names_of_contents_are_those_of_the_program(spot, camera):
    seen = spot.render(camera, channels=("depth", "normal", "segmentation", "mask"))
    assert list(seen) == ["Z", "N", "object", "id"]
    assert seen["depth"] is seen["Z"] and seen["normal"] is seen["N"] and seen["segmentation"] is seen["object"]
    assert np.array_equal(seen["mask"], seen.mask()) and "depth" not in seen
    assert list(spot.render(camera, channels="depth,Z")) == ["Z"]
    assert seen.depth is seen["Z"] and seen.normal is seen["N"]
    with pytest.raises(KeyError, match="the map has no channel 'camera-normal', only Z, N, object, id"):
        seen["camera-normal"]
    with pytest.raises(KeyError, match="has no channel 'z', only Z, N, object, id; did you mean 'Z'?"):
        seen["z"]
    with pytest.raises(AttributeError, match="has no channel 'distance'"):
        seen.distance
    with pytest.raises(ValueError, match="scale: uint16 needs codes per scene unit, for example scale=1000"):
        seen.stored_as("uint16", channel="Z")


def test_names_of_contents_choose_a_channel(spot, camera, tmp_path):
    seen = spot.render(camera, channels=("Z", "N"))
    seen.write(tmp_path / "z.pfm", channel="depth")
    assert np.array_equal(fathom.read_map(tmp_path / "z.pfm")["Z"], seen["Z"])
    seen.write(tmp_path / "n.npy", channel="normal")
    assert np.array_equal(np.load(tmp_path / "n.npy"), seen["N"])
    assert np.array_equal(seen.stored_as("float64", channel="depth")["Z"], seen["Z"])
    assert [each.truth_channel for each in fathom.compare(seen, seen, channel="depth").channels] == ["Z"]
    with pytest.raises(ValueError, match="has no channel 'mask'"):
        seen.write(tmp_path / "m.npy", channel="mask")


@pytest.mark.parametrize("suffix", ["pfm", "npy"])
def test_single_channels(map, tmp_path, suffix):
    file = tmp_path / f"map.{suffix}"
    map.write(file, channel="Z")
    again = fathom.Map.read(file)
    assert list(again.values())[0].tobytes() == map["Z"].tobytes()
    if suffix == "npy":
        assert np.array_equal(np.load(file), map["Z"])
    with pytest.raises(fathom.UsageError, match="name the one to write"):
        fathom.Map({"A": map["A"], "id": map["id"]}).write(file)


def test_maps_of_colmaps(spot, camera, tmp_path):
    map = spot.render(camera, channels=("Z", "Nc"))
    map.write(tmp_path / "depth.bin", channel="Z")
    map.write(tmp_path / "normal.bin", channel="Nc")
    depth, normal = fathom.read_map(tmp_path / "depth.bin"), fathom.read_map(tmp_path / "normal.bin")
    assert depth["Z"].tobytes() == map["Z"].tobytes() and np.array_equal(normal["Nc"], map["Nc"])
    assert np.array_equal(depth.mask(), map.mask()) and fathom.compare(map, depth).within_tolerance
    fathom.Map({"Z": map["Z"]}).write(tmp_path / "again.bin")
    assert (tmp_path / "again.bin").read_bytes() == (tmp_path / "depth.bin").read_bytes()
    with pytest.raises(fathom.OutputError, match="a COLMAP map holds planar depth"):
        map.to_distance().write(tmp_path / "distance.bin")
    (tmp_path / "bad.bin").write_bytes(b"1&1&1&" + np.float32(-1).tobytes())
    with pytest.raises(fathom.InputError, match="expected a finite number above 0"):
        fathom.read_map(tmp_path / "bad.bin")


def test_geotiff(spot, camera, tmp_path):
    down = fathom.Camera(40, 30, 16, 16, 20, 15, projection="orthographic", pixel_centre=0.5,
                         world_to_camera=[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 10]])
    plan = spot.render(down, channels=("Z", "P"))
    plan.write(tmp_path / "plan.tif")
    # A map of one's own, and one that was read.
    fathom.Map(dict(plan), down).write(tmp_path / "own.tif")
    plan.write(tmp_path / "plan.exr")
    fathom.read_map(tmp_path / "plan.exr").write(tmp_path / "read.tiff")
    code = ("import sys; from osgeo import gdal; gdal.UseExceptions(); file = gdal.Open(sys.argv[1]);"
            "bands = [file.GetRasterBand(1 + k) for k in range(4)];"
            "height = next(band for band in bands if band.GetDescription() == 'P.Z');"
            "print(file.GetGeoTransform(), sorted(band.GetDescription() for band in bands));"
            "height.ReadAsArray().tofile(sys.argv[2])")
    assert plan.mask().any() and not plan.mask().all()
    for name in ("plan.tif", "own.tif", "read.tiff"):
        said = subprocess.run(["/usr/bin/python3", "-c", code, tmp_path / name, tmp_path / "raw"], check=True,
                              capture_output=True, text=True).stdout
        assert said == f"{(-20 / 16, 1 / 16, 0.0, 15 / 16, 0.0, -1 / 16)} ['P.X', 'P.Y', 'P.Z', 'Z']\n"
        height = np.fromfile(tmp_path / "raw", np.float32).reshape(30, 40)
        assert np.array_equal(height, plan["P"][..., 2], equal_nan=True)
    with pytest.raises(fathom.OutputError, match="a GeoTIFF needs an orthographic camera"):
        spot.render(camera).write(tmp_path / "view.tif")
    with pytest.raises(fathom.OutputError, match="a GeoTIFF needs an orthographic camera"):
        fathom.Map({"Z": plan["Z"]}).write(tmp_path / "nowhere.tif")
    with pytest.raises(fathom.InputError, match="TIFF is written, not read"):
        fathom.read_map(tmp_path / "plan.tif")


def test_codes(spot, camera, tmp_path):
    codes = spot.render(camera, dtype=np.uint16, scale=2000)
    codes.write(tmp_path / "codes.png")
    again = fathom.read_map(tmp_path / "codes.png")
    assert again.scale == 2000 and np.array_equal(again["Z"], codes["Z"]) and again["Z"].dtype == np.uint16
    assert np.array_equal(again.mask(), codes.mask()) and codes.mask().any() and not codes.mask().all()


def test_a_png_of_depths_takes_a_scale(map, tmp_path):
    map.write(tmp_path / "a.png", channel="Z", scale=1000)
    map.stored_as("uint16", channel="Z", scale=1000).write(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    again = fathom.read_map(tmp_path / "a.png")
    seen = map.mask()
    assert again.scale == 1000 and np.array_equal(again.mask(), seen)
    assert np.array_equal(again["Z"][seen], np.rint(1000 * map["Z"][seen].astype(float)))


def test_a_part_of_a_channel_can_be_written(map, tmp_path):
    map.write(tmp_path / "n.npy", channel="N.Y")
    assert np.array_equal(np.load(tmp_path / "n.npy"), map["N"][..., 1])


def test_mask(map):
    assert np.array_equal(map.mask(), np.isfinite(map["Z"])) and np.array_equal(map.mask(), map["id"] != fathom.NO_SURFACE)
    assert np.array_equal(fathom.Map({"Z": map["Z"]}).mask(), map.mask())
    with pytest.raises(ValueError, match="mask: the map has none of"):
        fathom.Map({"A": map["A"]}).mask()


def test_compare(map):
    same = fathom.compare(map, map)
    assert same.within_tolerance and {c.truth_channel for c in same.channels} >= {"Z", "N.X", "id"}
    other = map["Z"].copy()
    y, x = np.argwhere(map.mask())[7]
    other[y, x] = np.nextafter(other[y, x], np.float32(np.inf))
    found = fathom.compare(map, other, channel="Z").channels[0]
    assert found.both == map.mask().sum() and found.bit_equal == found.both - 1 and found.ulp.max == 1
    assert found.absolute.worst == (x, y) and not found.within_tolerance
    assert fathom.compare(map, other, channel="Z", tolerance_ulp=1).within_tolerance
    holes = np.where(map["Z"] < np.median(map["Z"][map.mask()]), map["Z"], np.float32(0))
    found = fathom.compare(map["Z"], holes, other_background=0).channels[0]
    assert found.only_truth == (map.mask() & (holes == 0)).sum() > 0
    with pytest.raises(fathom.InputError, match="size"):
        fathom.compare(map, map["Z"][:, 1:])
    with pytest.raises(ValueError, match="other: expected an H×W array, a Map or the name of its file, found shape"):
        fathom.compare(map, np.zeros(3))


def test_quantities(map, camera):
    distance = map.to_distance()["distance"]
    seen = map.mask()
    assert np.allclose(distance[seen], map["distance"][seen], rtol=2e-7)
    only = fathom.Map({"distance": map["distance"]}, camera)
    assert np.allclose(only.to_depth()["Z"][seen], map["Z"][seen], rtol=2e-7)
    disparity = map.to_disparity(0.1, doffs=2)["disparity"]
    assert np.allclose(disparity[seen], camera.fx * 0.1 / map["Z"][seen].astype(float) - 2, rtol=1e-6)
    assert (disparity[~seen] == 0).all()
    assert np.isposinf(map.to_disparity(0.1, background=np.inf)["disparity"][~seen]).all()
    with pytest.raises(ValueError, match="camera: the map carries none: give one"):
        fathom.Map({"Z": map["Z"]}).to_distance()
    assert np.array_equal(fathom.Map({"Z": map["Z"]}).to_distance(camera)["distance"], distance)


def test_stored_as(map):
    codes = map.stored_as(np.uint16, channel="Z", scale=1000)
    seen = map.mask()
    assert np.array_equal(codes["Z"][seen], np.rint(map["Z"][seen].astype(float) * 1000)) and codes.scale == 1000
    assert map.stored_as("float64", channel="Z")["Z"].dtype == np.float64


def test_points_are_on_the_surface(map, camera, tmp_path):
    exact = map.points()
    assert exact.shape == (map.mask().sum(), 3)
    depths = fathom.Map({"Z": map["Z"]}, camera)
    assert np.allclose(depths.points(), exact, atol=1e-6)
    in_camera = depths.points(frame="camera")
    assert np.array_equal(in_camera[:, 2], map["Z"][map.mask()])
    assert np.allclose(in_camera @ camera.camera_to_world[:3, :3].T + camera.camera_to_world[:3, 3], exact, atol=1e-6)
    written = tmp_path / "points.ply"
    map.write_points(written)
    header, _, body = written.read_bytes().partition(b"end_header\n")
    row = sum({b"double": 8, b"float": 4, b"uint": 4}[line.split()[1]] for line in header.splitlines()
              if line.startswith(b"property"))
    stored = np.frombuffer(body, np.dtype({"names": "xyz", "formats": ["<f8"] * 3, "offsets": [0, 8, 16], "itemsize": row}))
    assert np.array_equal(np.stack([stored[axis] for axis in "xyz"], -1), exact)
    assert f"element vertex {len(exact)}".encode() in header and b"property double x" in header


def test_arrays_that_are_no_channels_of_a_map_are_refused(camera):
    depths = np.ones((60, 80), np.float32)
    with pytest.raises(TypeError, match="channels: expected a dict such as {'Z': array}, found ndarray"):
        fathom.Map(depths, camera)
    with pytest.raises(ValueError, match="channels: Z has 80×50 pixels, but the camera has 80×60"):
        fathom.Map({"Z": depths[:50]}, camera)
    with pytest.raises(ValueError, match=r"map: channel Z: expected shape H×W, found \(60, 80, 3\)"):
        fathom.Map({"Z": np.zeros((60, 80, 3), np.uint8)})
    assert fathom.Map({"Z": depths, "N": np.zeros((60, 80, 3), np.float32)}, camera).camera == camera


def test_formats_with_one_channel_hold_depths_by_default(spot, camera, tmp_path, run_program):
    seen = spot.render(camera, channels="N,Z,id")
    seen.write(tmp_path / "m.exr")
    for suffix in ("npy", "pfm", "png"):
        seen.write(tmp_path / f"python.{suffix}")
        run_program("convert", tmp_path / "m.exr", "-o", tmp_path / f"program.{suffix}")
        ours, theirs = (fathom.read_map(tmp_path / f"{by}.{suffix}") for by in ("python", "program"))
        assert np.array_equal(ours["Z"], theirs["Z"]) and ours["Z"].shape == (60, 80)


def test_errors_of_codes_name_the_file(spot, camera, tmp_path):
    with pytest.raises(fathom.OutputError, match=r"m.png: pixel \(.*does not fit the codes 1 to 65535"):
        spot.render(camera).write(tmp_path / "m.png", scale=1e6)


def test_clouds_are_ply_files(map, tmp_path):
    for name in ("p.pcd", "p.xyz", "p"):
        with pytest.raises(ValueError, match="file: a point cloud is a PLY: expected a name that ends in .ply, found "):
            map.write_points(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_maps_may_be_names_of_files(map, spot, camera, tmp_path):
    map.write(tmp_path / "m.exr")
    assert fathom.compare(tmp_path / "m.exr", str(tmp_path / "m.exr")).within_tolerance
    assert fathom.validate(tmp_path / "m.exr", spot, camera, "float32-ray", channel="Z").is_good
    with pytest.raises(fathom.InputError, match="none.exr: cannot be opened"):
        fathom.compare(map, "none.exr")


@pytest.fixture
def raw_codes(spot, camera, tmp_path, monkeypatch):
    """raw.png, codes of millimetres as other programs write them, without a scale, and m.exr, their map in metres."""
    monkeypatch.chdir(tmp_path)
    codes = spot.render(camera, dtype=np.uint16, scale=1000)
    codes.stored_as("float32").write("m.exr")
    fathom.Map({"Z": codes["Z"]}).write("raw.png")
    fathom.write_cameras("camera.json", [camera])


def refusal(*arguments):
    ran = subprocess.run([os.environ["FATHOM_PROGRAM"], *arguments], capture_output=True, text=True)
    assert ran.returncode in (2, 3) and ran.stderr.count("\n") == 1, ran
    return ran.stderr


def test_codes_of_other_programs_take_their_scale_from_the_option(raw_codes, camera, run_program):
    assert fathom.read_map("raw.png").scale is None
    for output in ("raw.exr", "raw.npy", "raw.png.npz", "scaled.png"):
        run_program("convert", "raw.png", "--png-scale", 1000, "--camera", "camera.json", "-o", output)
        found = fathom.read_map(output)
        assert found.scale == (1000 if output == "scaled.png" else None)
        depths = found.stored_as("float32")["Z"]
        assert np.array_equal(depths, fathom.read_map("m.exr").stored_as("float32")["Z"])
    run_program("convert", "raw.png", "--png-scale", 1000, "--camera", "camera.json", "-o", "raw.ply")
    run_program("convert", "scaled.png", "-o", "scaled.ply")
    assert pathlib.Path("raw.ply").read_bytes() == pathlib.Path("scaled.ply").read_bytes()
    run_program("convert", "raw.png", "--png-scale", 1000, "--camera", "camera.json", "--to", "distance", "-o", "distance.exr")
    distances = fathom.read_map("raw.exr").to_distance(camera)["distance"]
    assert np.allclose(fathom.read_map("distance.exr")["distance"], distances, rtol=1e-6)
    # A map with a scale of its own is written with the scale of the option, as always.
    run_program("convert", "scaled.png", "--png-scale", 500, "-o", "coarse.png")
    assert fathom.read_map("coarse.png").scale == 500


def test_the_option_is_named_and_refused_without_such_codes(raw_codes):
    assert "the codes carry no scale (fathom:scale), so their depth is not known; give 'fathom convert' one by --png-scale" in (
        refusal("convert", "raw.png", "--camera", "camera.json", "-o", "raw.ply"))
    to_cloud = ("--camera", "camera.json", "--png-scale", "5", "-o", "a.ply")
    assert "--png-scale: m.exr holds no codes" in refusal("convert", "m.exr", *to_cloud)
    fathom.Map({"Z": fathom.read_map("raw.png")["Z"]}, scale=1000).write("scaled.png")
    assert "--png-scale: scaled.png carries its scale, 1000" in refusal("convert", "scaled.png", *to_cloud)
    assert "--png-scale is for .png, not for a.npy" in refusal("convert", "m.exr", "--png-scale", "5", "-o", "a.npy")
    assert "a.pcd: the suffix of a map is one of .exr, .pfm, .png, .npy, .npz, .bin or .tif, the suffix of a point cloud is .ply" in (
        refusal("convert", "m.exr", "-o", "a.pcd"))


def test_codes_without_a_scale_are_compared_with_a_note(raw_codes):
    exact, codes = fathom.read_map("m.exr"), fathom.read_map("raw.png")["Z"]
    notes = fathom.compare(exact, codes).channels[0].notes
    assert any("other: the codes carry no scale and count as depths" in note for note in notes), notes
    for others in (codes, fathom.Map({"Z": codes}, scale=1000)):
        notes = fathom.compare(others, others).channels[0].notes
        assert not any("no scale" in note for note in notes), notes


def test_points_of_orthographic_cameras_and_codes(spot):
    camera = fathom.Camera.frame(spot, size=(40, 30), projection="orthographic")
    codes = spot.render(camera, dtype=np.uint16, scale=10000)
    exact = spot.render(camera, channels=("P",))
    assert np.allclose(codes.points(), exact.points(), atol=1e-4)


@pytest.mark.parametrize("channels, error, words", [
    ({}, ValueError, "map: it has no channels"),
    ({"Z": np.zeros(3, np.float32)}, ValueError, r"map: channel Z: expected shape H×W, found \(3,\)"),
    ({"Z": np.zeros((0, 3), np.float32)}, ValueError, "expected shape H×W"),
    ({"Z": np.zeros((2, 2), np.float32), "A": np.zeros((2, 3), np.float32)}, ValueError, "channels Z and A differ"),
    ({"Z": np.zeros((2, 2), np.int8)}, TypeError, "channel Z: expected float32, float64, uint16 or uint32, found int8"),
    ({"Z": np.zeros((2, 2), np.float64)}, ValueError, r"channel Z: an EXR does not hold float64 numbers; stored_as\('float32'"),
])
def test_maps_that_cannot_be_written(channels, error, words, tmp_path):
    with pytest.raises(error, match=words):
        fathom.Map(channels).write(tmp_path / "x.exr")


def test_files_that_cannot_be_read_or_written(map, tmp_path):
    with pytest.raises(fathom.InputError, match="none.exr"):
        fathom.read_map(tmp_path / "none.exr")
    (tmp_path / "short.exr").write_bytes(b"\x76\x2f\x31\x01\x02\x00\x00\x00")
    with pytest.raises(fathom.InputError, match="short.exr"):
        fathom.read_map(tmp_path / "short.exr")
    with pytest.raises(fathom.OutputError, match="short.exr/folder: the folder cannot be made: Not a directory"):
        map.write(tmp_path / "short.exr/folder/x.exr")
    map.write(tmp_path / "new/folder/x.exr")
    assert np.array_equal(fathom.read_map(tmp_path / "new/folder/x.exr")["Z"], map["Z"])
    with pytest.raises(fathom.UsageError, match="ends in"):
        map.write(tmp_path / "x.jpg")
    with pytest.raises(OSError, match="space"):
        write_to_full_disk(map, tmp_path)


def write_to_full_disk(map, folder):
    (folder / "full.exr").symlink_to("/dev/full")
    map.write(folder / "full.exr")


def test_normals_are_colours_and_are_read_again(spot, camera, tmp_path):
    maps = spot.render(camera, channels=("N", "Nc", "id"))
    surface = maps["id"] != fathom.NO_SURFACE
    for channel, bits, axes in (("N", 8, "opencv"), ("Nc", 16, "opencv"), ("Nc", 8, "opengl")):
        file = tmp_path / f"{channel}{bits}{axes}.png"
        maps.write(file, channel=channel, normal_bits=bits, normal_axes=axes)
        again = fathom.read_map(file)
        assert set(again) == {channel} and again.camera == camera
        assert (again[channel][~surface] == 0).all()
        assert np.abs(again[channel] - maps[channel])[surface].max() <= 1.001 / (2**bits - 1)
    for more, text in (({"normal_bits": 12}, "normal_bits: expected 8 or 16"),
                       ({"normal_axes": "blender"}, "normal_axes: expected 'opencv', 'opengl'"),
                       ({"normal_axes": "opengl"}, "normal_axes: those of OpenGL are for channel Nc")):
        with pytest.raises(ValueError, match=text):
            maps.write(tmp_path / "n.png", channel="N", **more)


def test_masks_are_those_of_the_map(camera, tmp_path):
    scene = fathom.Scene.read(source / "data/scenes/pair.json")
    maps = scene.render(fathom.Camera.frame(scene, size=(60, 40)), channels=("Z", "object"))
    maps.write_mask(tmp_path / "masks/all.png")
    assert (fathom.read_map(tmp_path / "masks/all.png")["mask"] == maps.mask()).all()
    for k in range(len(maps.objects)):
        maps.write_mask(tmp_path / f"{k}.png", object=k)
        mask = fathom.read_map(tmp_path / f"{k}.png")["mask"]
        assert (mask == (maps["object"] == k)).all() and mask.any()
    with pytest.raises(ValueError, match="expected a name that ends in .png"):
        maps.write_mask(tmp_path / "mask.exr")
    with pytest.raises(ValueError, match="the mask of an object needs channel object"):
        fathom.Map({"Z": maps["Z"]}).write_mask(tmp_path / "no.png", object=0)


def test_a_stack_is_one_cloud(spot, tmp_path):
    cameras = fathom.Camera.orbit_scene(spot, 3, size=(40, 30))
    stack = spot.render(cameras, channels=("Z", "id"))
    stack.write_points(tmp_path / "all.ply", dtype="float32")
    header, body = (tmp_path / "all.ply").read_bytes().split(b"end_header\n", 1)
    assert b"property uint view" in header
    points = np.frombuffer(body, [("xyz", "<f4", 3), ("id", "<u4"), ("view", "<u4")])
    for k in range(3):
        one = stack.view(k)
        chosen = points[points["view"] == k]
        assert (chosen["xyz"] == one.points().astype(np.float32)).all()
        assert (chosen["id"] == one["id"][one.mask()]).all()
    with pytest.raises(ValueError, match="write a cloud in the world"):
        stack.write_points(tmp_path / "no.ply", frame="camera")
