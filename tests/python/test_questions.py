"""probe, visible, render_deep, verify: judged by fractions, by sums, and by each other."""

from fractions import Fraction

import numpy as np
import pytest

import fathom


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
