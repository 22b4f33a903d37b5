"""Meshes of other libraries as arrays. None of these libraries is imported: their meshes are recognised by attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Union

import numpy as np

from ._arguments import as_array

if TYPE_CHECKING:
    import numpy.typing as npt


class TrimeshMesh(Protocol):
    """trimesh.Trimesh"""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class PyVistaMesh(Protocol):
    """pyvista.PolyData"""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class Open3DMesh(Protocol):
    """open3d.geometry.TriangleMesh"""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class Open3DTensorMesh(Protocol):
    """open3d.t.geometry.TriangleMesh"""

    @property
    def vertex(self) -> Any: ...
    @property
    def triangle(self) -> Any: ...


Mesh = Union[TrimeshMesh, PyVistaMesh, Open3DMesh, Open3DTensorMesh]


def arrays_of(mesh: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Copies of the vertices, N×3, and of the triangles, M×3, of a mesh: Open3D may move its arrays."""

    def has(*names: str) -> bool:
        return all(hasattr(mesh, name) for name in names)

    if has("vertices", "faces"):
        return _copy("mesh.vertices", mesh.vertices), _copy("mesh.faces", mesh.faces)
    if has("points", "faces"):
        return _copy("mesh.points", mesh.points), _triangles_of_padded(mesh.faces)
    if has("vertices", "triangles"):
        return _copy("mesh.vertices", mesh.vertices), _copy("mesh.triangles", mesh.triangles)
    if has("vertex", "triangle"):
        return _copy_tensor("mesh.vertex", mesh.vertex, "positions"), _copy_tensor("mesh.triangle", mesh.triangle, "indices")
    if has("geometry", "graph"):
        raise TypeError("mesh: found a scene of several meshes: add each, such as those of scene.dump()")
    if has("extract_surface"):
        raise TypeError("mesh: found a grid of cells: add mesh.extract_surface().triangulate()")
    raise TypeError(f"faces: missing; expected M×3 triangles, or instead of both arrays a mesh of trimesh, Open3D or PyVista, "
                    f"found {type(mesh).__name__} alone")


def _copy(name: str, value: object) -> npt.NDArray[Any]:
    return np.array(as_array(name, value))


def _copy_tensor(name: str, tensors: Any, key: str) -> npt.NDArray[Any]:
    if key not in tensors:
        raise ValueError(f"{name}: it has no {key}")
    return _copy(f"{name}.{key}", tensors[key].cpu().numpy())


def _triangles_of_padded(value: object) -> npt.NDArray[Any]:
    """VTK's list of polygons: the number of corners before each."""
    faces = as_array("mesh.faces", value).ravel()
    if faces.size % 4 or (faces[::4] != 3).any():
        raise ValueError("mesh.faces: expected triangles only, found other polygons: add mesh.triangulate()")
    return np.array(faces.reshape(-1, 4)[:, 1:])
