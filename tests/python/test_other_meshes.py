"""Meshes of trimesh, Open3D and PyVista, by stand-ins with their attributes, and by the library itself where it is
installed."""

import importlib.util
import re
import types

import numpy as np
import pytest

import fathom

corners = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4), (0, 0, 3)], np.float64)
triangles = np.array([(0, 1, 2), (0, 1, 3)], np.int64)


class Tensor:
    def __init__(self, array):
        self.array = array

    def cpu(self):
        return self

    def numpy(self):
        return self.array


def of_trimesh():
    return types.SimpleNamespace(vertices=corners, faces=triangles)


def of_pyvista():
    return types.SimpleNamespace(points=corners.astype(np.float32), faces=np.insert(triangles, 0, 3, axis=1).ravel(),
                                 extract_surface=None)


class Vectors:
    """Open3D's lists of vectors: arrays only by conversion."""

    def __init__(self, array):
        self.array = array

    def __len__(self):
        return len(self.array)

    def __getitem__(self, i):
        return self.array[i]

    def __array__(self, dtype=None, copy=None):
        return self.array


def of_open3d():
    return types.SimpleNamespace(vertices=Vectors(corners), triangles=Vectors(triangles.astype(np.int32)))


def of_open3d_tensors():
    return types.SimpleNamespace(vertex={"positions": Tensor(corners.astype(np.float32))}, triangle={"indices": Tensor(triangles)})


@pytest.mark.parametrize("make", [of_trimesh, of_pyvista, of_open3d, of_open3d_tensors])
def test_meshes_of_other_libraries(make):
    scene = fathom.Scene()
    number = scene.add_mesh(make(), name="it")
    assert np.array_equal(scene.vertices(number), corners) and np.array_equal(scene.faces(number), triangles)
    assert scene.objects[0].name == "it"
    assert not np.shares_memory(scene.vertices(number), corners)


@pytest.mark.skipif(importlib.util.find_spec("open3d") is None, reason="Open3D is not installed")
def test_a_mesh_of_open3d_itself():
    import open3d

    sphere = open3d.geometry.TriangleMesh.create_sphere(resolution=5)
    scene = fathom.Scene()
    scene.add_mesh(sphere)
    assert np.array_equal(scene.vertices(), np.asarray(sphere.vertices))
    assert np.array_equal(scene.faces(), np.asarray(sphere.triangles))
    scene.add_mesh(open3d.t.geometry.TriangleMesh.from_legacy(sphere))
    assert np.array_equal(scene.faces(1), np.asarray(sphere.triangles))


@pytest.mark.parametrize("mesh, error, text", [
    (types.SimpleNamespace(geometry={}, graph=None), TypeError, "mesh: found a scene of several meshes: add each"),
    (types.SimpleNamespace(points=corners, cells=[], extract_surface=None), TypeError,
     "mesh: found a grid of cells: add mesh.extract_surface().triangulate()"),
    (types.SimpleNamespace(points=corners, faces=np.array([4, 0, 1, 2, 3])), ValueError,
     "mesh.faces: expected triangles only, found other polygons: add mesh.triangulate()"),
    (types.SimpleNamespace(vertex={}, triangle={}), ValueError, "mesh.vertex: it has no positions"),
    (types.SimpleNamespace(vertices=corners[:, :2], faces=triangles), ValueError, "vertices: expected shape N×3, found 4×2"),
    (types.SimpleNamespace(vertices=corners, faces=triangles + 9), IndexError, "faces: row 0 has vertex 9"),
    (corners, TypeError, "faces: missing; expected M×3 triangles, or instead of both arrays a mesh of trimesh, Open3D or "
                         "PyVista, found ndarray alone"),
    (None, TypeError, "faces: missing; expected M×3 triangles"),
])
def test_what_is_no_mesh_of_triangles_is_refused(mesh, error, text):
    with pytest.raises(error, match=re.escape(text)):
        fathom.Scene().add_mesh(mesh)
