"""Every function of fathom.h computes the same in each floating-point mode, which it leaves as it was. The functions are
those that the header declares and the library exports: a new one fails until it has a call here."""

import ctypes
import os
import pathlib
import re
import subprocess

import pytest
from floating_point_modes import in_every_mode

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
library_file = os.environ["FATHOM_C_LIBRARY"]
library = ctypes.CDLL(library_file)
header = (source / "lib/c/fathom.h").read_text(encoding="utf-8")
declared = set(re.findall(r"FATHOM_API [^;(]*?\b(fathom_\w+)\(", header))
infinity = float("inf")
doubles = ctypes.c_double * 3


class Camera(ctypes.Structure):
    _fields_ = [("width", ctypes.c_uint32), ("height", ctypes.c_uint32), ("orthographic", ctypes.c_int),
                *((name, ctypes.c_double) for name in ("fx", "fy", "cx", "cy", "skew", "pixel_centre")),
                ("world_to_camera", ctypes.c_double * 4 * 3), ("near", ctypes.c_double), ("far", ctypes.c_double),
                ("lens", ctypes.c_void_p)]


for text in re.findall(r"FATHOM_API ([^;(]*?\bfathom_\w+)\(", header):
    kind, name = re.fullmatch(r"(.*?)\s*(fathom_\w+)", text, re.S).groups()
    getattr(library, name).restype = {
        "const char*": ctypes.c_char_p, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64, "void": None,
        "const float*": ctypes.POINTER(ctypes.c_float), "const double*": ctypes.POINTER(ctypes.c_double),
        "const uint64_t*": ctypes.POINTER(ctypes.c_uint64),
        "const uint32_t*": ctypes.POINTER(ctypes.c_uint32), "const uint16_t*": ctypes.POINTER(ctypes.c_uint16),
        "double": ctypes.c_double, "fathom_status": ctypes.c_int}[kind]


def camera():
    view = Camera(8, 6, 0, 8.1, 7.9, 4, 3, 0.1, 0.5, ((1, 0, 0, 0.1), (0, 1, 0, 0), (0, 0, 1, 5e-324)), 0.3, infinity, None)
    return view


def bytes_of(structure):
    return bytes(memoryview(structure))


class Given:
    """A scene, its map, and files of them, made in the standard mode."""

    def __init__(self, folder):
        self.folder = folder
        self.scene = ctypes.c_void_p()
        vertices = (ctypes.c_double * 12)(-2, -2, 3, 2, -2, 5, 0, 2, 4.1, 0, 0, 5e-324)
        corners = (ctypes.c_uint32 * 6)(0, 1, 2, 0, 1, 3)
        assert library.fathom_scene_new(ctypes.byref(self.scene)) == 0
        assert library.fathom_scene_add(self.scene, vertices, ctypes.c_size_t(4), corners, ctypes.c_size_t(2), None, b"it", 0) == 0
        self.map = self.rendered(False)
        self.wide_map = self.rendered(True)
        self.scene_file = folder / "mesh.obj"
        self.scene_file.write_text("v -2.1 -2 3\nv 2 -2.3 5\nv 0 2 4.1\nv 0 0 5e-324\nusemtl oak\nf 1 2 3\nf 1 2 4\n")
        self.camera_file = folder / "camera.json"
        self.camera_file.write_text('{"width": 8, "height": 6, "fx": 8.1, "fy": 7.9, "cx": 4, "cy": 3, "pixel_centre": 0.5,'
                                    '"world_to_camera": [[1, 0, 0, 0.1], [0, 1, 0, 0], [0, 0, 1, 5e-324]]}')
        self.lens = ctypes.c_void_p()
        numbers = (ctypes.c_double * 4)(-0.3, 5e-324, 0.1, 0)
        assert library.fathom_lens_new(b"OPENCV", numbers, ctypes.c_size_t(4), ctypes.c_double(0.7), ctypes.byref(self.lens)) == 0
        self.rays = ctypes.c_void_p()
        assert library.fathom_rays_new(self.scene, 0, ctypes.byref(self.rays)) == 0
        self.map_file = folder / "map.exr"
        assert library.fathom_map_write(self.map, bytes(self.map_file), None) == 0

    def rendered(self, wide):
        rendered = ctypes.c_void_p()
        options = Options(0, int(wide), 1, None, None)
        view = camera()
        channels = b"Z" if wide else b"Z,A,id,N,P,distance,object,Nc,bary"
        assert library.fathom_render(self.scene, ctypes.byref(view), channels, ctypes.byref(options), ctypes.byref(rendered)) == 0
        return rendered


class Options(ctypes.Structure):
    _fields_ = [("cull", ctypes.c_int), ("float64", ctypes.c_int), ("threads", ctypes.c_int), ("progress", ctypes.c_void_p),
                ("data", ctypes.c_void_p)]


def contents(rendered):
    """All that a map has, as bytes."""
    found, number = [], 0
    size = library.fathom_map_width(rendered) * library.fathom_map_height(rendered)
    while (name := library.fathom_map_channel(rendered, ctypes.c_size_t(number))) is not None:
        for values in ("float32", "float64", "uint32", "uint16"):
            first = getattr(library, f"fathom_map_{values}")(rendered, name)
            if first:
                found.append((name, ctypes.string_at(first, size * ctypes.sizeof(first.contents))))
        number += 1
    return found + [library.fathom_map_text(rendered, b"fathom.camera")]


def values(kind):
    def call(given):
        first = getattr(library, f"fathom_map_{kind}")(given.wide_map if kind == "float64" else given.map,
                                                       b"id" if kind == "uint32" else b"Z")
        return ctypes.string_at(first, 48 * ctypes.sizeof(first.contents)) if first else None
    return call


def made(function, *arguments):
    """A handle that a function makes, what it holds, and the end of it."""
    handle = ctypes.c_void_p()
    assert function(*arguments, ctypes.byref(handle)) == 0, library.fathom_error()
    return handle


def new_scene(given):
    scene = made(library.fathom_scene_new)
    count = library.fathom_scene_triangle_count(scene)
    library.fathom_scene_free(scene)
    return count


def bounds_of(scene):
    lower, upper = doubles(), doubles()
    assert library.fathom_scene_bounds(scene, lower, upper) == 0
    return list(lower), list(upper)


def read_scene(given):
    files = (ctypes.c_char_p * 1)(bytes(given.scene_file))
    scene = made(library.fathom_scene_read, files, ctypes.c_size_t(1))
    found = bounds_of(scene)
    library.fathom_scene_free(scene)
    return found


def add(given):
    scene = made(library.fathom_scene_new)
    pose = (ctypes.c_double * 12)(0.1, 0, 0, 1e9, 0, 0.3, 0, 0, 0, 0, 0.7, 5e-324)
    vertices = (ctypes.c_double * 9)(-2, -2, 3, 2, -2, 5, 0, 2, 4.1)
    corners = (ctypes.c_uint32 * 3)(0, 1, 2)
    assert library.fathom_scene_add(scene, vertices, ctypes.c_size_t(3), corners, ctypes.c_size_t(1), pose, None, 0) == 0
    found = bounds_of(scene)
    library.fathom_scene_free(scene)
    return found


def camera_from(function, *arguments):
    view = Camera()
    assert function(*arguments, ctypes.byref(view)) == 0, library.fathom_error()
    return bytes_of(view)


def look_at(given):
    return camera_from(library.fathom_camera_look_at, doubles(1, 0.2, 0.3), doubles(0.1, 0.7, 9), doubles(0, 1, 0.1), 64, 48,
                       ctypes.c_double(41.3))


def frame(given):
    return camera_from(library.fathom_camera_frame, given.scene, ctypes.c_double(35), ctypes.c_double(20.1), 64, 48,
                       ctypes.c_double(41.3))


def render(given):
    rendered = given.rendered(False)
    found = contents(rendered)
    library.fathom_map_free(rendered)
    return found


def read_map(given):
    read = made(library.fathom_map_read, bytes(given.map_file))
    found = contents(read)
    library.fathom_map_free(read)
    return found


def write_map(given):
    found = []
    for name, channel in (("w.exr", None), ("w.png", b"Z"), ("w.npz", None), ("w.pfm", b"Z"), ("w.npy", b"A")):
        status = library.fathom_map_write(given.map, bytes(given.folder / name), channel)
        found.append((name, status, (given.folder / name).read_bytes() if status == 0 else library.fathom_error()))
    return found


def check(given):
    flat = camera()
    flat.world_to_camera[0][0] = 5e-324
    return library.fathom_camera_check(ctypes.byref(flat)), library.fathom_camera_check(None)


def new_lens(given):
    numbers = (ctypes.c_double * 2)(-0.1, 5e-324)
    return made(library.fathom_lens_new, b"RADIAL", numbers, ctypes.c_size_t(2), ctypes.c_double(infinity))


def lens_model(given):
    lens = new_lens(given)
    name = library.fathom_lens_model(lens)
    library.fathom_lens_free(lens)
    return name


def lens_distortion(given):
    count = ctypes.c_size_t()
    numbers = library.fathom_lens_distortion(given.lens, ctypes.byref(count))
    return ctypes.string_at(numbers, 8 * count.value)


def verify(given):
    differing, view, options = ctypes.c_uint64(7), camera(), Options(0, 0, 1, None, None)
    status = library.fathom_verify(given.map, given.scene, ctypes.byref(view), ctypes.byref(options), ctypes.c_uint64(30),
                                   ctypes.byref(differing))
    return status, differing.value


class RayArray(ctypes.Structure):
    _fields_ = [("count", ctypes.c_size_t), ("origins", ctypes.POINTER(ctypes.c_double)),
                ("directions", ctypes.POINTER(ctypes.c_double)), ("origin_stride", ctypes.c_size_t),
                ("direction_stride", ctypes.c_size_t)]


class HitArrays(ctypes.Structure):
    _fields_ = [("triangle", ctypes.POINTER(ctypes.c_uint32)),
                *((name, ctypes.POINTER(ctypes.c_double)) for name in ("t", "distance", "position", "barycentric", "normal")),
                ("object", ctypes.POINTER(ctypes.c_uint32)), ("face", ctypes.POINTER(ctypes.c_uint32)),
                ("stride", ctypes.c_size_t)]


ray_count = 3
some_rays = RayArray(ray_count, (ctypes.c_double * 9)(0.1, 0.2, 0, 5e-324, 0.1, 0, 0.3, 0, 1),
                     (ctypes.c_double * 9)(0.01, 0, 1.1, 0, 0, 5e-324, 0.1, 0.2, 0.3), 0, 0)


def values_of(write, count):
    """All that is written about so many hits."""
    values = [(ctypes.c_double * (count * width))() for width in (1, 1, 3, 2, 3)]
    numbers = [(ctypes.c_uint32 * count)() for _ in range(3)]
    status = write(ctypes.byref(HitArrays(numbers[0], *values, *numbers[1:], 0)))
    return status, [bytes_of(array) for array in (*values, *numbers)]


def of_rays(function, kind):
    def call(given):
        found = (kind * ray_count)()
        return function(given.rays, ctypes.byref(some_rays), None, found), list(found)
    return call


def all_hits(given):
    return made(library.fathom_all_hits, given.rays, ctypes.byref(some_rays), None)


def of_hits(ask):
    def call(given):
        hits = all_hits(given)
        found = ask(hits)
        library.fathom_hits_free(hits)
        return found
    return call


def contains(given):
    inside, points = (ctypes.c_uint8 * 2)(9, 9), (ctypes.c_double * 6)(0.1, 0.2, 0, 5e-324, 0.1, 4)
    return library.fathom_contains(given.rays, points, ctypes.c_size_t(2), ctypes.c_size_t(0), 0, inside), list(inside)
class Areas(ctypes.Structure):
    _fields_ = [("lights", ctypes.c_size_t), ("items", ctypes.c_size_t),
                *((name, ctypes.POINTER(ctypes.c_double)) for name in ("visible", "projected", "fraction", "lit", "centroid"))]


def areas_of(given):
    directions = (ctypes.c_double * 6)(0.1, 0.2, -1, 0.1, 0.3, -0.7)
    areas = ctypes.POINTER(Areas)()
    assert library.fathom_areas(given.scene, ctypes.c_size_t(2), directions, 0, None, ctypes.byref(areas)) == 0
    return areas


def areas(given):
    found = areas_of(given)
    count = found.contents.lights * found.contents.items
    values = [ctypes.string_at(getattr(found.contents, name), 8 * count) for name in ("visible", "lit")]
    values.append(ctypes.string_at(found.contents.centroid, 24 * count))
    library.fathom_areas_free(found)
    return values


def freed(make, free):
    def call(given):
        handle = make(given)
        free(handle)
        return free(None)
    return call


calls = {
    "fathom_error": lambda given: (library.fathom_camera_check(None), library.fathom_error()),
    "fathom_version": lambda given: library.fathom_version(),
    "fathom_scene_new": new_scene,
    "fathom_scene_read": read_scene,
    "fathom_scene_free": freed(lambda given: made(library.fathom_scene_new), library.fathom_scene_free),
    "fathom_scene_add": add,
    "fathom_scene_triangle_count": lambda given: library.fathom_scene_triangle_count(given.scene),
    "fathom_scene_bounds": lambda given: bounds_of(given.scene),
    "fathom_lens_new": lens_model,
    "fathom_lens_free": freed(new_lens, library.fathom_lens_free),
    "fathom_lens_model": lambda given: library.fathom_lens_model(given.lens),
    "fathom_lens_distortion": lens_distortion,
    "fathom_lens_max_radius": lambda given: library.fathom_lens_max_radius(given.lens),
    "fathom_camera_look_at": look_at,
    "fathom_camera_frame": frame,
    "fathom_camera_read": lambda given: camera_from(library.fathom_camera_read, bytes(given.camera_file)),
    "fathom_camera_check": check,
    "fathom_render": render,
    "fathom_map_read": read_map,
    "fathom_map_write": write_map,
    "fathom_map_free": freed(lambda given: given.rendered(False), library.fathom_map_free),
    "fathom_map_width": lambda given: library.fathom_map_width(given.map),
    "fathom_map_height": lambda given: library.fathom_map_height(given.map),
    "fathom_map_channel": lambda given: library.fathom_map_channel(given.map, ctypes.c_size_t(1)),
    "fathom_map_float32": values("float32"),
    "fathom_map_float64": values("float64"),
    "fathom_map_uint32": values("uint32"),
    "fathom_map_uint16": values("uint16"),
    "fathom_map_name": lambda given: library.fathom_map_name(given.map, b"object", 0),
    "fathom_map_text": lambda given: library.fathom_map_text(given.map, b"fathom.camera"),
    "fathom_verify": verify,
    "fathom_rays_new": lambda given: library.fathom_rays_free(made(library.fathom_rays_new, given.scene, 0)),
    "fathom_rays_free": freed(lambda given: made(library.fathom_rays_new, given.scene, 0), library.fathom_rays_free),
    "fathom_cast": lambda given: values_of(
        lambda hits: library.fathom_cast(given.rays, ctypes.byref(some_rays), None, hits), ray_count),
    "fathom_occluded": of_rays(library.fathom_occluded, ctypes.c_uint8),
    "fathom_count_hits": of_rays(library.fathom_count_hits, ctypes.c_uint32),
    "fathom_all_hits": of_hits(lambda hits: library.fathom_hits_count(hits)),
    "fathom_hits_free": freed(all_hits, library.fathom_hits_free),
    "fathom_hits_count": of_hits(library.fathom_hits_count),
    "fathom_hits_splits": of_hits(lambda hits: library.fathom_hits_splits(hits)[:ray_count + 1]),
    "fathom_hits_values": of_hits(lambda hits: values_of(lambda to: library.fathom_hits_values(hits, to),
                                                         library.fathom_hits_count(hits))),
    "fathom_contains": contains,
    "fathom_areas": areas,
    "fathom_areas_free": freed(areas_of, library.fathom_areas_free),
}


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    return Given(tmp_path_factory.mktemp("c"))


def test_every_function_has_a_call():
    symbols = subprocess.run(["nm", "-D", "--defined-only", library_file], check=True, capture_output=True, text=True).stdout
    exported = {line.split()[-1] for line in symbols.splitlines() if line.split()[-2] in "TW"}
    assert exported == declared
    assert set(calls) == declared


@pytest.mark.parametrize("name", sorted(declared))
def test_every_mode_gives_the_same(name, given):
    outcomes = dict(in_every_mode(lambda: calls[name](given)))
    for mode, outcome in outcomes.items():
        assert outcome == outcomes["standard"], mode
