"""How results are shown: reprs, pictures, and the tables of notebooks."""

import importlib
import inspect
import pkgutil
import re
import types
import zlib

import numpy as np
import pytest

import fathom
from fathom import compat, diagnosis, pipeline, questions, studies

returned_by_the_core = {"ChannelComparison", "DepthMetrics", "DifferenceSummary", "DisparityMetrics", "Estimate", "Finding"}


def public_types():
    """All classes of public modules, except exceptions."""
    for module in pkgutil.iter_modules(fathom.__path__):
        if not module.name.startswith("_"):
            for name, member in vars(importlib.import_module(f"fathom.{module.name}")).items():
                if inspect.isclass(member) and member.__module__ == f"fathom.{module.name}" and not name.startswith("_"):
                    if not issubclass(member, BaseException):
                        yield name


@pytest.fixture(scope="module")
def shown():
    """An object of each public type."""
    world = fathom.Scene()
    world.add_mesh([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)], name="sheet")
    camera = fathom.Camera(64, 48, 40, 40, 32, 24, pixel_centre=0.5)
    maps = world.render(camera, channels=("Z", "id"))
    moved = maps["Z"] * np.float32(1.5)
    compared = fathom.compare(maps["Z"], moved, metrics=True)
    disparities = fathom.compare(maps.to_disparity(1), fathom.Map({"disparity": maps.to_disparity(1)["disparity"]}), metrics=True)
    shifted = world.render(fathom.Camera(64, 48, 40, 40, 32.5, 24, pixel_centre=0.5))
    wrong = fathom.validate(shifted, world, camera, "float32-ray")
    evaluated = fathom.evaluate(world, world, camera, points=100, keep_points=True)
    areas = fathom.visible(world, camera)
    checked = fathom.verify(maps, world, pixels=4)
    drawn = pipeline.render(world, camera, shading="none")
    lit = fathom.areas(world, directions=[(0, 0, -1)], by="triangle")
    found = fathom.doctor(world, [camera], [maps["Z"]])
    fault = diagnosis.DataSetFault("units", "the depths are millimetres", found.given, found.corrected, ())
    casting = compat.RaycastingScene()
    casting.add_triangles([(-4, -4, 3), (4, -4, 5), (0, 4, 4)], [(0, 1, 2)])
    hits = casting.cast_rays([(0, 0, 0, 0, 0, 1)])
    mesh = types.SimpleNamespace(vertices=[(-4, -4, 3), (4, -4, 5), (0, 4, 4)], faces=[(0, 1, 2)])
    return {type(each).__name__: each for each in (
        world, world.objects[0], world.origin(0), camera, fathom.Lens(), maps, compared, compared.channels[0],
        compared.channels[0].absolute, compared.channels[0].depth_metrics, disparities.channels[0].disparity_metrics,
        wrong, wrong.findings[0], wrong.findings[0].estimates[0], evaluated, evaluated.depth, evaluated.accuracy, areas,
        areas.triangles, checked, questions.Disagreement(1, 2, "Z", "1", "2"), fathom.probe(world, camera, 32, 24)[0],
        fathom.render_deep(world, camera), fathom.DepthFormat("standard", "unorm24", near=1, far=9),
        studies.run("depth-resolution", near=0.1, far=10, samples=2), studies.names()["depth-resolution"], drawn,
        lit, lit.exact(0, 0), fathom.Rays([(0, 0, 0)], [(0, 0, 1)]), fathom.SurfacePoints([0], [(0.25, 0.5)]), casting, hits,
        hits["t_hit"], compat.RayMeshIntersector(mesh), found, found.given, found.noise, fault,
        *fathom.clip([[(0, 0), (4, 0), (0, 4)]], [[(0, 0), (2, 0), (2, 2), (0, 2)]]))}


def test_every_public_type_has_a_repr_of_its_own(shown):
    assert set(shown) >= {*public_types(), *returned_by_the_core}
    for name, each in shown.items():
        assert not re.search(r" object at 0x|\barray\(\[", repr(each)), name
        assert len(repr(each)) < 900, (name, repr(each))
        # A Finding is a sentence.
        assert name in repr(each) or name == "Finding", repr(each)


def pixels_of(png):
    """The colours of an 8-bit RGB PNG; only by the format's definition."""
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    chunks, at = {}, 8
    while at < len(png):
        length, name = int.from_bytes(png[at:at + 4], "big"), png[at + 4:at + 8]
        chunks[name] = chunks.get(name, b"") + png[at + 8:at + 8 + length]
        at += 12 + length
    width, height = (int.from_bytes(chunks[b"IHDR"][i:i + 4], "big") for i in (0, 4))
    assert chunks[b"IHDR"][8:10] == bytes([8, 2])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, 1 + 3 * width).astype(int)
    above = np.zeros(3 * width, int)
    picture = []
    for kind, *row in rows.tolist():
        for i, value in enumerate(row):
            left, up, corner = (row[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
            nearest = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))[2]
            row[i] = (value + (0, left, up, (left + up) // 2, nearest)[kind]) % 256
        picture.append(row)
        above = row
    return np.array(picture, np.uint8).reshape(height, width, 3)


@pytest.fixture(scope="module")
def pair():
    """A map of depths 2 and 4 and background, and another one in which one pixel differs."""
    truth = np.array([[2, 4], [4, np.inf]], np.float32)
    other = truth.copy()
    other[0, 1] = 5
    return fathom.Map({"Z": truth}), fathom.Map({"Z": other})


def test_a_preview_shows_the_colours_of_the_values(pair):
    picture = pair[0].preview(colormap="grey")
    assert picture.dtype == np.uint8 and picture.ndim == 3 and picture.shape[2] == 3
    colours = {tuple(each) for each in picture.reshape(-1, 3)}
    assert (0, 0, 0) in colours and (255, 255, 255) in colours
    # Twice the range: 4 is in its middle.
    middle = pair[0].preview(colormap="grey", range=(2, 6))
    counts = [int((middle == value).all(axis=2).sum()) for value in (127, 128)]
    assert max(counts) > 100
    assert not np.array_equal(pair[0].preview(), picture)


def test_a_preview_is_what_the_program_draws(spot, run_program, tmp_path):
    camera = fathom.Camera.frame(spot, size=(64, 48))
    maps = spot.render(camera, channels=("Z", "id", "N"))
    maps.write(tmp_path / "map.exr")
    for options, arguments in (({}, ()), ({"channel": "id"}, ("--channel", "id")), ({"channel": "N"}, ("--channel", "N")),
                               ({"colormap": "turbo", "range": (1, 9), "unit": "m"},
                                ("--colormap", "turbo", "--range", "1,9", "--unit", "m")),
                               ({"scale": "log"}, ("--scale", "log")),
                               ({"colormap": "diverging", "scale": "equalised"},
                                ("--colormap", "diverging", "--scale", "equalised"))):
        run_program("preview", tmp_path / "map.exr", "-o", tmp_path / "program.png", *arguments)
        picture = maps.preview(tmp_path / "new" / "python.png", **options)
        written = (tmp_path / "new" / "python.png").read_bytes()
        assert written == (tmp_path / "program.png").read_bytes(), options
        assert np.array_equal(pixels_of(written), picture)


def test_a_notebook_shows_pictures(pair):
    truth, other = pair
    assert np.array_equal(pixels_of(truth._repr_png_()), truth.preview())
    compared = fathom.compare(truth, other)
    assert np.array_equal(pixels_of(compared._repr_png_()), compared.preview())
    for each, words in ((truth, ("<td>Z</td>", "2 to 4", "surface in 75 %")),
                        (compared, ("the maps differ", "<td>66.67 %</td>", "<td>1</td>"))):
        html = each._repr_html_()
        assert 'src="data:image/png;base64,iVBOR' in html
        for word in words:
            assert word in html


def test_the_difference_of_a_comparison_is_drawn_by_each_measure(pair, tmp_path):
    truth, other = pair
    compared = fathom.compare(truth, other)
    pictures = [compared.preview(tmp_path / f"{by}.png", by=by) for by in ("absolute", "relative", "ulp")]
    assert len({each.tobytes() for each in pictures}) == 3
    assert np.array_equal(pixels_of((tmp_path / "ulp.png").read_bytes()), pictures[2])
    with pytest.raises(ValueError, match="by: expected 'absolute', 'relative', 'ulp', found 'ulps'"):
        compared.preview(by="ulps")


def test_a_notebook_shows_scenes_and_cameras(spot):
    html = spot._repr_html_()
    assert "spot" in html and "5856" in html and "base64" in html
    assert pixels_of(spot._repr_png_()).shape[2] == 3
    assert fathom.Scene()._repr_png_() is None and "0 objects" in fathom.Scene()._repr_html_()
    camera = fathom.Camera.look_at((1, 2, 3), size=(64, 48))
    html = camera._repr_html_()
    assert "<td>1, 2, 3</td>" in html and "<svg" in html and "64×48 pixels" in html


def test_names_are_escaped():
    scene = fathom.Scene()
    scene.add_mesh([(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(0, 1, 2)], name="<script>&")
    assert "<script>" not in scene._repr_html_() and "&lt;script&gt;&amp;" in scene._repr_html_()


def test_a_stack_shows_its_first_map(spot):
    cameras = fathom.Camera.orbit_scene(spot, 3, size=(32, 24))
    stack = spot.render(cameras)
    assert repr(stack).startswith("Map(3 views of 32×24 pixels; Z: float32, ")
    assert stack._repr_png_() == stack.view(0)._repr_png_()
    with pytest.raises(ValueError, match="it is a stack of 3 maps: take one by view"):
        stack.preview()


def test_nothing_to_draw_is_no_failure():
    assert fathom.Map()._repr_png_() is None and "without channels" in fathom.Map()._repr_html_()
    assert repr(fathom.Map({"x": np.array([["a"]])})) == "Map(1×1 pixels; x: <U1)"


def test_reprs_show_ranges_and_shares(triangle, K):
    maps = fathom.render(*triangle, K, np.eye(4), (64, 48), pixel_centre=0.5, channels=("Z", "id", "material"))
    covered = int((maps["id"] == 0).sum())
    depths = maps["Z"][maps["id"] == 0]
    assert repr(maps) == (f"Map(64×48 pixels; Z: float32, {depths.min():.6g} to {depths.max():.6g}; id: uint32, 0 to 0; "
                          f"material: uint32, no surface; surface in {100 * covered / 3072:.4g} %)")
    almost = np.full((200, 200), np.inf, np.float32)
    almost[0, 0] = 1
    assert repr(fathom.Map({"Z": almost})).endswith("surface in 0.01 %)")
    assert repr(fathom.Map({"Z": 1 / almost})).endswith("surface in 100 %)")
    scene = fathom.Scene()
    scene.add_mesh(*triangle)
    assert repr(scene) == "Scene(1 object, 1 mesh, 1 triangle; x -2 to 2, y -2 to 2, z 3 to 5)"


@pytest.mark.parametrize("path, error, text", [
    ("a.jpg", ValueError, "path: expected a name that ends in .png, found 'a.jpg'"),
    (3, TypeError, "path: expected the name of a file or folder, found 3"),
])
def test_a_picture_is_written_as_png(pair, path, error, text):
    with pytest.raises(error, match=re.escape(text)):
        pair[0].preview(path)


@pytest.mark.parametrize("options, error, text", [
    ({"channel": "z"}, ValueError, "the map has no channel 'z', only Z"),
    ({"colormap": "jet"}, ValueError, "colormap: expected 'viridis', 'magma', 'turbo', 'grey', 'diverging', found 'jet'"),
    ({"range": 3}, TypeError, "range: expected (low, high), found 3"),
    ({"range": (3, 2)}, ValueError, "low end is not below its high end"),
    ({"unit": 3}, TypeError, "unit: expected a string, found 3"),
])
def test_bad_arguments_of_previews_are_named(pair, options, error, text):
    with pytest.raises(error, match=re.escape(text)):
        pair[0].preview(**options)


def test_channels_are_attributes(pair):
    truth, _ = pair
    assert truth.Z is truth["Z"] and "Z" in dir(truth)
    with pytest.raises(AttributeError, match="the map has no channel 'z', only Z"):
        truth.z
    with pytest.raises(AttributeError, match=re.escape("Z: set a channel by map['Z'] = …")):
        truth.Z = 3
    assert not hasattr(truth, "N") and not hasattr(truth, "__array__")


def test_every_channel_is_a_known_attribute():
    """No channel is hidden by another attribute of maps, and type checkers know all."""
    source = inspect.getsource(fathom.Map)
    for name in [*fathom.maps.rendered, "disparity"]:
        assert not hasattr(fathom.Map(), name), name
        assert f"        {name}: npt.NDArray[" in source, name
