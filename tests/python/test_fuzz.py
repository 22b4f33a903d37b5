"""Any call with any arguments returns or raises one of Python's exceptions, of one sentence; nothing crashes.

FATHOM_FUZZ_CALLS: how many calls of each kind (default 150).
"""

import os

import hypothesis
import numpy as np
import pytest
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import fathom

pytestmark = pytest.mark.filterwarnings("ignore::fathom.ViewWarning")
calls = int(os.environ.get("FATHOM_FUZZ_CALLS", "150"))
fuzz = hypothesis.settings(max_examples=calls, deadline=None, database=None,
                           suppress_health_check=list(hypothesis.HealthCheck))
allowed = (TypeError, ValueError, IndexError, MemoryError, fathom.Error)

any_float = st.floats(width=64)
number = st.one_of(any_float, st.integers(-(2**70), 2**70), st.none(), st.text(max_size=3), st.sampled_from([0, 0.5, 1, 40]))
types = st.sampled_from([np.float64, np.float32, np.float16, np.int32, np.uint32, np.int64, np.uint8, bool, complex, ">f8",
                         ">i4", "U2", object])


@st.composite
def arrays(draw, *shapes):
    """Mostly of a shape and a type that fit, with numbers of all sizes; now and then of any other."""
    if draw(st.integers(0, 9)):
        shape = draw(st.sampled_from(shapes))
    else:
        shape = draw(hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=5))
    kind = draw(st.sampled_from(["near", "integers", "any"]))
    if kind == "near":
        array = draw(hnp.arrays(np.float64, shape, elements=st.floats(-4, 4)))
    elif kind == "integers":
        array = draw(hnp.arrays(np.int64, shape, elements=st.integers(-3, 9)))
    else:
        array = draw(hnp.arrays(np.float64, shape, elements=any_float))
    if not draw(st.integers(0, 5)):
        with np.errstate(all="ignore"):
            array = array.astype(draw(types))
    if array.ndim and not draw(st.integers(0, 3)):
        array = array[::-1] if draw(st.booleans()) else np.asfortranarray(array)
    if not draw(st.integers(0, 9)):
        array.flags.writeable = False
    return array.tolist() if not draw(st.integers(0, 9)) else array


@st.composite
def corner_arrays(draw):
    if not draw(st.integers(0, 5)):
        return draw(arrays((1, 3), (4, 3)))
    kind = draw(st.sampled_from([np.uint32, np.int32, np.int64, np.uint8]))
    return draw(hnp.arrays(kind, draw(st.sampled_from([(1, 3), (2, 3), (5, 3)])), elements=st.integers(0, 4)))


matrices = st.one_of(st.just(np.eye(4)), st.just(np.eye(4)[:3]), arrays((4, 4), (3, 4), (2, 4, 4)))
intrinsics = st.one_of(st.just([(4, 0, 4), (0, 4, 3), (0, 0, 1)]), arrays((3, 3), (2, 3, 3)))
sizes = st.one_of(st.just((8, 6)), st.tuples(st.integers(-1, 40), st.integers(-1, 40)), st.just((2**31, 2**31)), number)
vertex_arrays = arrays((3, 3), (5, 3), (9, 3))


def attempt(call):
    try:
        return call()
    except allowed as error:
        assert "\n" not in str(error) and "incompatible function arguments" not in str(error), error
        return None


def check_map(maps, size):
    for values in maps.values():
        assert values.shape[-2:] == size[::-1] or values.shape[-3:-1] == size[::-1]
        values.sum()  # all of it is there


@fuzz
@hypothesis.given(vertex_arrays, corner_arrays(), intrinsics, matrices, sizes, st.sampled_from([0, 0.5]) | number,
                  st.fixed_dictionaries({}, optional={
                      "channels": st.lists(st.sampled_from(["Z", "A", "id", "N", "P", "distance", "x"]), max_size=3) | number,
                      "near": number, "far": number, "cull": st.sampled_from(["back", "front"]) | number,
                      "dtype": types, "scale": number, "background": number, "threads": st.sampled_from([1, 2]) | number}))
def test_render(vertices, faces, K, T, size, pixel_centre, options):
    maps = attempt(lambda: fathom.render(vertices, faces, K, T, size, pixel_centre=pixel_centre, **options))
    if maps is not None:
        check_map(maps, tuple(size))


@fuzz
@hypothesis.given(vertex_arrays, corner_arrays(), matrices, number, number, st.integers(-1, 9), st.integers(-1, 7))
def test_questions(vertices, faces, pose, mesh, triangle, x, y):
    scene = fathom.Scene()
    attempt(lambda: scene.add_mesh(vertices, faces, pose=pose))
    attempt(lambda: scene.add_instance(mesh, pose))
    attempt(lambda: scene.origin(triangle))
    attempt(lambda: scene.bounds)
    camera = fathom.Camera(8, 6, 4, 4, 4, 3, pixel_centre=0.5)
    attempt(lambda: fathom.probe(scene, camera, x, y))
    attempt(lambda: fathom.visible(scene, camera))
    attempt(lambda: fathom.areas(scene, directions=vertices, alone=True).exact(0, 0).fraction)
    attempt(lambda: fathom.areas(scene, camera=camera, by="triangle").background)
    attempt(lambda: fathom.render_deep(scene, camera))
    attempt(lambda: fathom.Camera.frame(scene, size=(8, 6)))
    maps = attempt(lambda: scene.render(camera, channels=("Z", "id")))
    if maps is not None:
        assert fathom.verify(maps, scene).differing == 0


@fuzz
@hypothesis.given(number, number, number, number, number, number, number, number, matrices)
def test_camera(width, height, fx, fy, cx, cy, pixel_centre, near, pose):
    camera = attempt(lambda: fathom.Camera(width, height, fx, fy, cx, cy, pixel_centre=pixel_centre, near=near,
                                           world_to_camera=pose))
    if camera is not None:
        assert fathom.Camera.from_json(camera.to_json()) == camera


@fuzz
@hypothesis.given(arrays((3,)), arrays((3,)), arrays((3,)), number, arrays((4, 4)), arrays((4, 4)), st.text(max_size=40))
def test_making_cameras(eye, target, up, fov, projection, modelview, text):
    attempt(lambda: fathom.Camera.look_at(eye, target, up, fov=fov))
    attempt(lambda: fathom.Camera.orbit(3, distance=fov, centre=eye))
    attempt(lambda: fathom.Camera.from_opengl(projection, modelview, (8, 6)))
    attempt(lambda: fathom.Camera.from_json(text))


@fuzz
@hypothesis.given(st.dictionaries(st.sampled_from(["Z", "id", "N", "x", "", "a\0b"]), arrays((6, 8), (6, 8, 3)), max_size=3),
                  arrays((6, 8)), number)
def test_maps(channels, other, tolerance):
    camera = fathom.Camera(8, 6, 4, 4, 4, 3, pixel_centre=0.5)
    maps = attempt(lambda: fathom.Map(channels, camera))
    if maps is None:
        return
    attempt(lambda: maps.mask())
    attempt(lambda: maps.points())
    attempt(lambda: maps.to_distance())
    attempt(lambda: maps.to_disparity(tolerance))
    attempt(lambda: maps.stored_as("uint16", scale=tolerance))
    attempt(lambda: fathom.compare(maps, other, tolerance_ulp=tolerance))
    attempt(lambda: maps.write("/dev/null/x.exr"))


@fuzz
@hypothesis.given(st.sampled_from(["standard", "log", "reversed_infinite"]) | number, st.sampled_from(["unorm16", "float32"]),
                  number, number, arrays((3,), (2, 2)))
def test_depth_formats(mapping, storage, near, far, values):
    format = attempt(lambda: fathom.DepthFormat(mapping, storage, near=near, far=far))
    if format is not None:
        for call in (format.encode, format.decode, format.resolution, format.bin_width, format.separation_behind):
            attempt(lambda: call(values))


point = st.tuples(st.integers(-3, 3) | st.fractions() | any_float, st.integers(-3, 3))


@fuzz
@hypothesis.given(st.lists(st.lists(point, max_size=5), max_size=3), st.lists(st.lists(point, max_size=5), max_size=3))
def test_clipping(subject, window):
    pieces = attempt(lambda: fathom.clip(subject, window))
    if pieces is not None:
        assert pieces == fathom.clip(subject, window, algorithm="cgal")
