"""What the library's tables list, channels of maps and of rays, formats of maps and meshes, lens models, depth formats, models of
renderers, exit statuses and names of options, is in the help, the docstrings, the C header and the pages that list it for users."""

import json
import os
import pathlib
import re
import subprocess
import typing
import warnings

import numpy as np
import pytest

import fathom
from fathom import _core, lens, maps, names

source = pathlib.Path(os.environ["FATHOM_SOURCE"])


def read(path):
    return (source / path).read_text(encoding="utf-8")


def between(text, first, last):
    """The part from one text to another; both are there."""
    assert first in text and last in text.partition(first)[2], (first, last)
    return text.partition(first)[2].partition(last)[0]


def missing(names, text):
    """The names that the text does not have as words; a suffix may be that of a file."""
    before = {name: "" if name.startswith(".") else r"(?<![\w.-])" for name in names}
    return [name for name in names if not re.search(rf"{before[name]}{re.escape(name)}(?![\w-])", text)]


def first_cells(table):
    return "\n".join(re.findall(r"^\| ([^|]*) \|", table, re.M))


def names_in(table):
    """The names in the first column of a table."""
    return sorted(re.findall(r"`([^`]+)`", first_cells(table)))


def without_remarks(text):
    return re.sub(r"\([^)]*\)", "", text)


channels = list(maps.rendered)
c_header = read("lib/c/fathom.h")
specification = between(read("docs/specification.md"), "\n## 6.", "\n## 7.")
lists_of_channels = {
    "docs/specification.md, section 6": first_cells(specification),
    "docs/reference/channels.md": first_cells(read("docs/reference/channels.md")),
    "docs/python.md": between(read("docs/python.md"), "| `channels` |", "\n"),
    "lib/c/fathom.h": between(c_header, "*   channels ", "*   options "),
    "fathom.render()": without_remarks(between(fathom.render.__doc__, "channels  ", "\n    near, far  ")),
}


@pytest.mark.parametrize("place", lists_of_channels)
def test_every_channel_is_listed(place):
    # Parts have rows of their own where a table has columns.
    assert missing(channels, re.sub(r"\.[A-Z]\b", "", lists_of_channels[place])) == []


def types_and_backgrounds(page):
    """What the first table of channels in a page says of each: its type, and its value without a surface."""
    lines = [line for line in page.splitlines() if line.startswith("| ")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    column = rows[0].index("type")
    return {name: (row[column], row[-1]) for row in rows for name in re.findall(r"`([\w.]+)`", row[0])}


@pytest.mark.parametrize("page", [specification, read("docs/reference/channels.md")], ids=["specification", "channels"])
def test_types_and_backgrounds_are_those_of_a_map_without_surfaces(page):
    camera = fathom.Camera(1, 1, 1, 1, 0, 0, pixel_centre=0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        empty = fathom.Scene().render(camera, channels=channels)
    described = types_and_backgrounds(page)
    names = [f"{name}.{part}" for name in channels for part in maps.parts_of.get(name, "")]
    names += [name for name in channels if name not in maps.parts_of]
    assert len(names) >= 24
    types = {"FLOAT": np.float32, "UINT": np.uint32}
    for name in names:
        values = empty[name.partition(".")[0]]
        type_, background = described[name]
        assert values.dtype == types[type_], name
        np.testing.assert_array_equal(values, float(background.replace("∞", "inf")), err_msg=name)


rays_in_specification = between(read("docs/specification.md"), "\n## 11.", "\n## 12.")


@pytest.mark.parametrize("text", [
    first_cells(rays_in_specification),
    without_remarks(between(fathom.Scene.cast.__doc__, "channels  ", "dtype  ")),
], ids=["specification", "Scene.cast()"])
def test_every_channel_of_rays_is_listed(text):
    assert missing(_core.ray_channels, text) == []


def test_numbers_of_rays_are_those_of_the_specification():
    described = {}
    for line in re.findall(r"^\| `.*", rays_in_specification, re.M):
        names, numbers, *_, without_hit = [cell.strip() for cell in line.strip("|").split("|")]
        described.update((name, (int(numbers), float(without_hit.replace("∞", "inf"))))
                         for name in re.findall(r"`(\w+)`", names))
    missed = fathom.Scene().cast((0, 0, 0), (0, 0, 1), channels=_core.ray_channels)
    assert described.keys() == missed.keys()
    for name, (numbers, without_hit) in described.items():
        assert missed[name].size == numbers
        np.testing.assert_array_equal(missed[name], without_hit, err_msg=name)


def test_the_help_of_cast_has_every_channel_of_rays(run_program):
    option = between(run_program("cast", "--help=completion"), "option\t--channels\t", "\n")
    assert option.split("\t")[2].split() == _core.ray_channels
    assert missing(_core.ray_channels, without_remarks(option.split("\t")[-1])) == []


def suffixes_of_maps():
    with pytest.raises(ValueError, match="expected a name that ends in") as refusal:
        fathom.Map({"Z": [[1.0]]}).write("map.nothing")
    return re.findall(r"\.\w+", str(refusal.value).partition("ends in")[2])


def test_suffixes_are_those_of_the_library():
    assert len(suffixes_of_maps()) >= 7 and {".exr", ".npz", ".tif"} <= set(suffixes_of_maps())


def help_of_output(run_program, command):
    return between(run_program(command, "--help=completion"), "option\t-o --output\t", "\n")


@pytest.mark.parametrize("command", ["render", "convert"])
def test_every_suffix_is_in_the_help_of_output(command, run_program):
    assert missing(suffixes_of_maps(), help_of_output(run_program, command)) == []


lists_of_formats = {
    "docs/reading-maps.md": read("docs/reading-maps.md"),
    "Map.write()": fathom.Map.write.__doc__,
    "lib/c/fathom.h": between(c_header, "fathom_map_read(", "fathom_map_write("),
}


@pytest.mark.parametrize("place", lists_of_formats)
def test_every_format_is_listed(place):
    assert missing(suffixes_of_maps(), lists_of_formats[place]) == []


def names_of_readable_maps(tmp_path):
    (tmp_path / "nothing").write_bytes(b"nothing")
    with pytest.raises(_core.InputError, match="expected an") as refusal:
        fathom.read_map(tmp_path / "nothing")
    return re.findall(r"[A-Z]{3,}", str(refusal.value).partition("expected an")[2])


def test_every_format_that_is_read_is_in_the_c_header(tmp_path):
    names = names_of_readable_maps(tmp_path)
    assert len(names) >= 6
    assert missing(names, c_header.partition("fathom_map_read(")[0].rpartition("/*")[2]) == []


def test_formats_that_are_read_and_written_are_in_the_specification(tmp_path):
    assert missing([*names_of_readable_maps(tmp_path), "GeoTIFF"], specification) == []


names_of_formats = {
    "README.md": ("your renderer's depth along the optical axis (", ";"),
    "docs/doctor.md": ("`--depth` names depth images (", ")"),
    "docs/guides/validating-a-renderer.md": ("Any renderer that writes ", " can be validated"),
    "docs/guides/tour.md": ("The suffix of `-o` selects the format: ", ".\n"),
    "docs/python.md": ("- `write` writes all channels to ", ".\n"),
    "docs/reference/channels.md": ("channel under another name. ", " hold all."),
    "lib/fathom/image/README.md": ("| `map_formats.h`, `map_files.h` |", "|\n"),
}
lists_that_write = ["docs/guides/tour.md", "docs/python.md", "docs/reference/channels.md", "lib/fathom/image/README.md"]


@pytest.mark.parametrize("page", names_of_formats)
def test_every_format_is_listed_by_name(page, tmp_path):
    names = [*names_of_readable_maps(tmp_path), *(["GeoTIFF"] if page in lists_that_write else [])]
    assert missing(names, between(read(page), *names_of_formats[page])) == []


def test_every_suffix_for_assimp_is_listed():
    suffixes = re.findall(r'"(\w+)"', between(read("lib/fathom/mesh_files/foreign_formats.h"), "foreign_suffixes{", "}"))
    listed = between(read("docs/conventions.md"), "**Formats that assimp reads**", ".\n").partition("`")[2].rstrip("`")
    assert len(suffixes) >= 30 and listed.split() == suffixes


@pytest.mark.parametrize("place", ["docs/conventions.md", "lib/c/fathom.h"])
def test_every_mesh_format_is_listed(place, run_program):
    words = between(run_program("render", "--help=completion"), "option\t--mesh-format\t", "\n").split("\t")[2].split()
    assert len(words) >= 6
    assert missing([word for word in words if word != "glb"], read(place).lower()) == []


pages_of_depth_formats = {
    "docs/specification.md": ("\n## 9.", "\n## 10."),
    "docs/depth-formats.md": ("A format is a *mapping*", "\n## "),
}


@pytest.mark.parametrize("page", pages_of_depth_formats)
def test_every_mapping_and_storage_is_listed(page):
    text = between(read(page), *pages_of_depth_formats[page])
    assert names_in(text) == sorted(_core.mappings)
    assert re.findall(r"`((?:unorm|float)\d+)`", text) == _core.storages


def test_every_model_of_renderers_is_listed():
    page = read("docs/validation.md")
    models = between(page, "\n## Models\n", "\n**`auto`**")
    assert names_in(models) == sorted(["auto", *_core.model_names.split(", ")])
    classes = re.findall(r"^\| ([^|]*) \|", between(page, "\n## Classes\n", "\n## "), re.M)
    assert classes == ["class", "---", *_core.class_names]


def test_every_fault_of_a_data_set_is_listed():
    code = read("apps/doctor/hypothesis.cpp")
    names = re.findall(r'return "([\w-]+)"', between(code, "std::string name_of(Fault fault)", "\n}"))
    others = ["clipped", "no-value"]  # of stored depths (apps/doctor/diagnosis.cpp)
    assert len(names) >= 11
    assert names_in(between(read("docs/doctor.md"), "\n## Faults\n", "\n## ")) == sorted([*names, *others])


def test_every_exit_status_is_listed():
    statuses = between(read("apps/shell/failures.h"), "enum ExitStatus : int {", "}")
    statuses = {name: int(number) for name, number in re.findall(r"(\w+) = (\d+)", statuses)}
    page = read("docs/reference/exit-statuses.md")
    of_scripts = 125
    assert f"exit {of_scripts}" in read("scripts/fathom")
    assert [int(each) for each in re.findall(r"^\| (\d+) \|", page, re.M)] == sorted([*statuses.values(), of_scripts])
    in_c = {name: int(number) for name, number in re.findall(r"FATHOM_(\w+) = (\d+)", between(c_header, "FATHOM_OK", "}"))}
    in_c["OK"] = 0
    same = {"OK": "done", "USAGE": "wrong_usage", "INPUT": "unusable_input", "OUTPUT": "unwritable_output"}
    assert {in_c[name] for name in same} == {statuses[name] for name in same.values()} == {0, 2, 3, 4}
    assert "0, 2, 3 and 4 mean the same there" in page


def test_the_header_for_c_has_every_cull():
    assert {name.lower() for name in re.findall(r"FATHOM_CULL_(\w+) =", c_header)} == set(_core.culls)


@pytest.mark.parametrize("name, words", {
    "Channel": [*channels, *_core.contents], "RayChannel": _core.ray_channels,
    "Cull": _core.culls, "Normals": _core.normal_sources, "Engine": _core.engines,
    "Compression": _core.compressions, "Mapping": _core.mappings, "Storage": _core.storages,
    "NormalAxes": _core.normal_axes,
    "Model": ["auto", *_core.model_names.split(", ")]}.items())
def test_types_for_checkers_have_every_word(name, words):
    given = typing.get_args(getattr(names, name))
    assert sorted(given) == sorted(words) and len(given) >= 2


def test_deep_compressions_are_those_that_are_written(tmp_path):
    scene = fathom.Scene()
    scene.add_mesh([(0, 0, 1), (2, 0, 1), (0, 2, 1)], [(0, 1, 2)])
    deep = fathom.render_deep(scene, fathom.Camera(2, 2, 1, 1, 0, 0, pixel_centre=0.5))
    for each in _core.compressions:
        if each in typing.get_args(names.DeepCompression):
            deep.write(tmp_path / f"{each}.exr", compression=each)
        else:
            with pytest.raises(fathom.UsageError, match="compressed by"):
                deep.write(tmp_path / f"{each}.exr", compression=each)


def test_projections_are_those_of_camera_files():
    assert set(typing.get_args(lens.Projection)) == set(lens.projections)
    for word in lens.projections:
        camera = fathom.Camera(1, 1, 1, 1, 0, 0, pixel_centre=0.5, projection=word)
        assert f'"projection": "{word}"' in _core.camera_to_json(camera._handle)


def refused_camera(**keys):
    with pytest.raises(ValueError, match="expected") as refusal:
        fathom.Camera.from_json(json.dumps({"width": 1, "height": 1, **keys}))
    return re.split(r", | or ", str(refusal.value).partition("expected ")[2].removeprefix("one of "))


def parameters_of(model):
    """In the order of the model, which is that of the keys that camera files have."""
    keys = refused_camera(model=model, no_key=0)
    if "params" not in keys:
        return []
    return [key for key in keys[keys.index("max_radius") + 1:keys.index("pixel_centre")] if key != "skew"]


def lenses_in(table):
    """The parameters of each model in the first two columns of a page's table. A row may have two models, and their
    parameters on the two sides of a semicolon; and it may continue the row of another model."""
    lenses = {}
    for names, texts in re.findall(r"^\| ([A-Z][^|]*) \| ([^|]*) \|", table, re.M):
        models = without_remarks(names).replace(",", "").split()
        lists = texts.split("; ")[:len(models)]
        assert len(lists) == len(models), names
        for model, text in zip(models, lists):
            base, then, more = text.rpartition(", then ")
            lenses[model] = (lenses[base.removeprefix("as ")] if then else []) + more.replace("none", "").split()
    return lenses


@pytest.mark.parametrize("table", [
    between(read("docs/specification.md"), "**Lenses.**", "**Which preimage.**"),
    between(read("docs/lenses.md"), "\n## Models\n", "\n## "),
], ids=["specification", "lenses"])
def test_every_lens_model_is_listed_with_its_parameters(table):
    models = refused_camera(model="no model")
    assert len(models) >= 18
    assert lenses_in(table) == {model: parameters_of(model) for model in models}


@pytest.mark.parametrize("words, text", [
    ([word for word in _core.culls if word != "none"], between(fathom.render.__doc__, "cull  ", "dtype  ")),
    (_core.stored_types, between(fathom.render.__doc__, "dtype  ", "background  ")),
    (_core.normal_sources, without_remarks(between(fathom.render.__doc__, "normals  ", "threads  "))),
    (_core.normal_sources, between(read("docs/python.md"), "| `normals` |", "\n")),
    (_core.stored_types, between(read("docs/python.md"), "| `dtype` |", "\n")),
    (_core.engines, fathom.Scene.render.__doc__),
    (_core.compressions, fathom.Map.write.__doc__),
    (_core.mappings, fathom.DepthFormat.__doc__),
    (_core.storages, fathom.DepthFormat.__doc__),
], ids=["cull", "dtype", "normals", "normals-page", "dtype-page", "engine", "compression", "mapping", "storage"])
def test_docstrings_and_pages_have_every_word(words, text):
    assert len(words) >= 2 and missing(words, text) == []


def test_texts_of_maps_are_in_the_page():
    keys = re.findall(r'"(fathom\.[a-z_-]+)"', read("lib/fathom/image/depth_map.h"))
    assert len(keys) >= 10 and missing(keys, between(read("docs/reading-maps.md"), "## The header of an EXR", "OpenEXR multiplies")) == []


def test_texts_of_files_have_one_spelling():
    """Nothing in the library or the programs spells a key itself, but the two headers that list the keys."""
    lists = [source / "lib/fathom/image" / header for header in ("depth_map.h", "files/file_texts.h")]
    keys = [key for header in lists for key in
            re.findall(r'"(fathom[.:][a-z_-]+)"', header.read_text(encoding="utf-8"))]
    assert len(keys) >= 14
    files = [path for folder in ("lib/fathom", "apps", "validation") for path in (source / folder).rglob("*")
             if path.suffix in (".h", ".cpp") and path not in lists]
    assert len(files) > 500
    assert [path for path in files if any(f'"{key}"' in path.read_text(encoding="utf-8") for key in keys)] == []


def test_info_recognises_maps_of_every_format(tmp_path, run_program):
    """By a list of its own (map_files.cpp), since meshes come in ZIP archives, too."""
    camera = fathom.Camera(2, 1, 1, 1, 0, 0, pixel_centre=0.5, projection="orthographic",
                           world_to_camera=np.diag([1, -1, -1, 1]))
    depths = fathom.Map({"Z": np.array([[1, 2]], np.float32)}, camera)
    for suffix in suffixes_of_maps():
        file = tmp_path / f"map{suffix}"
        depths.write(file, scale=1000 if suffix == ".png" else None)
        if suffix == ".tif":
            with pytest.raises(subprocess.CalledProcessError) as refusal:
                run_program("info", file)
            assert "TIFF is written, not read" in refusal.value.stderr
        else:
            assert "a map of 2x1 pixels" in run_program("info", file)
