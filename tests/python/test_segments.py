"""Materials, groups, parts and labels: of arrays, of files, and against a reader of OBJ of its own."""

import json
import os
import pathlib

import numpy as np
import pytest

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
corners = np.array([(-1, -1, 4), (1, -1, 4), (1, 1, 4), (-1, 1, 4)], float)
faces = np.array([(0, 1, 2), (0, 2, 3)])
camera = fathom.Camera.look_at(eye=(0, 0, 0), target=(0, 0, 4), up=(0, -1, 0), size=(32, 32), fov=40)


def shown(maps, channel):
    return sorted(set(np.unique(maps[channel][maps["id"] != fathom.NO_SURFACE]).tolist()))


def test_arrays_have_labels_and_materials():
    scene = fathom.Scene()
    scene.add_mesh(corners, faces, labels=[7, -1], materials=["steel", "oak"])
    scene.add_mesh(corners + (0, 0, 1), faces, materials=["oak", None])
    assert scene.tables == {"material": {0: "steel", 1: "oak"}}
    maps = scene.render(camera, channels=("id", "label", "material", "part"))
    assert np.array_equal(maps["label"][maps["id"] == 0], np.full((maps["id"] == 0).sum(), 7))
    assert shown(maps, "label") == [7, fathom.NO_SEGMENT] and shown(maps, "material") == [0, 1]
    assert shown(maps, "part") == [fathom.NO_SEGMENT]
    assert maps.tables["material"] == {0: "steel", 1: "oak"} and "part" not in maps.tables
    assert maps.tables["object"] == {0: "mesh 0", 1: "mesh 1"}
    assert (maps["material"][maps["id"] == fathom.NO_SURFACE] == fathom.NO_SURFACE).all()
    stack = scene.render([camera, camera], channels=("material",))
    assert stack["material"].shape == (2, 32, 32) and stack.tables == {"material": {0: "steel", 1: "oak"}}


def test_one_label_and_one_name_for_all():
    scene = fathom.Scene()
    scene.add_mesh(corners, faces, labels=np.uint8(200), materials="é")
    maps = scene.render(camera, channels=("id", "label", "material"))
    assert shown(maps, "label") == [200] and maps.tables["material"] == {0: "é"}


@pytest.mark.parametrize(
    "labels, error",
    [([1.5, 2], TypeError), ([1], ValueError), ([1, 2, 3], ValueError), ([[1, 2]], ValueError), ([0, 2**32 - 2], ValueError)],
)
def test_labels_that_are_wrong_are_refused(labels, error):
    with pytest.raises(error, match="labels: "):
        fathom.Scene().add_mesh(corners, faces, labels=labels)


@pytest.mark.parametrize("materials, error", [(["a"], ValueError), ([1, 2], TypeError)])
def test_materials_that_are_wrong_are_refused(materials, error):
    with pytest.raises(error, match="materials: "):
        fathom.Scene().add_mesh(corners, faces, materials=materials)


@pytest.mark.parametrize("suffix", [".exr", ".npz"])
def test_files_keep_the_tables(tmp_path, suffix):
    scene = fathom.Scene()
    scene.add_mesh(corners, faces, labels=[7, -1], materials=["steel", ""])
    maps = scene.render(camera, channels=("Z", "label", "material"))
    maps.write(tmp_path / f"map{suffix}")
    back = fathom.read_map(tmp_path / f"map{suffix}")
    assert back.tables == maps.tables
    assert np.array_equal(back["material"], maps["material"]) and np.array_equal(back["label"], maps["label"])


def names_of_faces(text):
    """For each face of an OBJ the last usemtl, g and o before it: this file's own reading, with no code of Fathom's."""
    current = {"usemtl": None, "g": None, "o": None}
    found = []
    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word in current:
            current[word] = rest.strip()
        elif word == "f":
            found.append(dict(current))
    return found


def obj_with_names(path):
    """A real mesh, its faces shared out among materials, groups and parts."""
    lines = (source / "data/meshes/teapot.obj").read_text().splitlines()
    written, count = [], 0
    for line in lines:
        word = line.split(" ")[0]
        if word in ("usemtl", "g", "o"):
            continue
        if word == "f":
            if count % 37 == 5:
                written.append(f"usemtl material {count * 7919 % 13}")
            if count % 100 == 50:
                written.append(f"g a{count} b")
            if count % 400 == 200:
                written.append(f"o part {count % 3}")
            count += 1
        written.append(line)
    path.write_text("\n".join(written) + "\n")


def test_channels_hold_what_the_obj_says_of_the_face_of_every_pixel(tmp_path):
    file = tmp_path / "teapot.obj"
    obj_with_names(file)
    truth = names_of_faces(file.read_text())
    scene = fathom.Scene.read(file)
    view = fathom.Camera.frame(scene, size=(320, 240))
    for engine in ("fast", "reference"):
        maps = scene.render(view, channels=("face", "material", "group", "part"), engine=engine)
        seen = set()
        for channel, keyword in (("material", "usemtl"), ("group", "g"), ("part", "o")):
            table = {**maps.tables[channel], fathom.NO_SEGMENT: None}
            for face, number in zip(maps["face"].ravel().tolist(), maps[channel].ravel().tolist()):
                if face == fathom.NO_SURFACE:
                    assert number == fathom.NO_SURFACE
                else:
                    assert table[number] == truth[face][keyword], (channel, face)
                    seen.add(table[number])
        assert None in seen and len(seen) > 30


def test_the_program_names_them_too(run_program, tmp_path):
    file = tmp_path / "teapot.obj"
    obj_with_names(file)
    map_file = tmp_path / "map.exr"
    run_program("render", file, "--size", "160x120", "--channels", "Z,face,material,part", "-o", map_file)
    maps = fathom.read_map(map_file)
    truth = names_of_faces(file.read_text())
    told = json.loads(run_program("info", map_file, "--json"))
    assert told["materials"] == list(maps.tables["material"].values()) and told["parts"] == list(maps.tables["part"].values())
    row, column = (int(i) for i in np.argwhere(maps["material"] < 100)[0])
    asked = ["probe", file, "--size", "160x120", "--pixel", f"{column},{row}"]
    visible = json.loads(run_program(*asked, "--json"))["triangles"][0]
    assert visible["face"] == maps["face"][row, column]
    assert visible["material"] == truth[visible["face"]]["usemtl"] == maps.tables["material"][maps["material"][row, column]]
    text = run_program(*asked)
    assert f"  material {visible['material']}" in text and visible["label"] is None
