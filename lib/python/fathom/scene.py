"""Scenes: meshes, and objects that place them in the world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _core
from ._arguments import (
    as_count,
    as_text,
    as_threads,
    check_elements,
    faces_of,
    labels_of,
    names_of,
    pose_of,
    vertices_of,
)
from ._files import Path, path_of
from ._render import Background, Cull, Normals, Rendered, render_cameras
from ._warnings import warn
from .maps import Map

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from .camera import Camera


class Object(NamedTuple):
    """A mesh that is placed in the world: channel `object` holds its number."""

    name: str
    mesh: int
    #: The file that it comes from.
    source: str


class Origin(NamedTuple):
    """Where a triangle of a scene, numbered as channel `id` does, comes from."""

    object: int
    #: Its number within its object's mesh.
    triangle: int
    #: The number of its face within its file.
    face: int


class Scene:
    """Meshes and the objects that place them. Triangles are numbered from 0 over all objects in
    their order.

    >>> import numpy as np
    >>> scene = Scene()
    >>> corners = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float)
    >>> sheet = scene.add_mesh(corners, np.array([(0, 1, 2)]), name="sheet")
    >>> scene.add_instance(sheet, [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 2)], name="two behind")
    1
    >>> scene.triangle_count, [each.name for each in scene.objects]
    (2, ['sheet', 'two behind'])
    """

    __slots__ = ("_handle",)
    _handle: _core.Scene

    def __init__(self) -> None:
        self._handle = _core.Scene()

    @classmethod
    def read(cls, *files: Path, threads: int = 0) -> Scene:
        """Reads meshes (OBJ, PLY, STL, OFF, glTF/GLB, and what assimp reads where the program
        fathom-formats is installed) and scene files (JSON), in this order, into one scene. What a
        reader notices is a warning."""
        if not files:
            raise TypeError("read: expected a file")
        scene = cls()
        import shutil  # which takes a while, and is not needed elsewhere

        paths = [path_of("files", file) for file in files]
        formats = shutil.which("fathom-formats") or ""
        scene._handle, notes = _core.read_scene(paths, formats, as_threads(threads))
        warn(notes, UserWarning)
        return scene

    def add_mesh(
        self,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike,
        *,
        pose: npt.ArrayLike | None = None,
        name: str = "",
        labels: npt.ArrayLike | None = None,
        materials: str | Sequence[str | None] | None = None,
    ) -> int:
        """Adds a mesh, and an object that places it. Returns the number of the mesh, for
        add_instance().

        vertices   N×3; float64, or float32 and integers, taken as the exact numbers that they are
        faces      M×3 triangles; integers of any type, numbers of vertices from 0
        pose       4×4 or 3×4, mesh to world; the identity where it is left out
        name       of the object; "mesh 0", "mesh 1", … where it is left out
        labels     an integer for each face, or one for all, for channel `label`. Negative: no label
        materials  a name for each face, or one for all, numbered in channel `material` by first
                   appearance in the scene; None and "" are none

        Arrays in C order, of float64 and of int32 or uint32, are not copied: what is changed in
        them later is changed in the scene, and must not be while something is rendered.
        """
        placed = None if pose is None else pose_of("pose", pose)
        called = as_text("name", name)
        numbers = vertices_of(vertices)
        corners = faces_of(faces, len(numbers))
        of_labels = None if labels is None else labels_of(labels, len(corners))
        of_materials = None if materials is None else names_of("materials", materials, len(corners))
        mesh = self._handle.add_mesh(numbers, corners)
        if of_labels is not None:
            self._handle.set_segments(mesh, "label", of_labels, [])
        if of_materials is not None:
            self._handle.set_segments(mesh, "material", *of_materials)
        self._handle.add_object(mesh, placed, called or f"mesh {mesh}")
        return mesh

    def add_instance(self, mesh: int, pose: npt.ArrayLike | None = None, *, name: str = "") -> int:
        """Places a mesh once more. `pose` is as in add_mesh(). Returns the number of the object."""
        number = as_count("mesh", mesh, 0, self.mesh_count - 1) if self.mesh_count else _no_mesh()
        placed = None if pose is None else pose_of("pose", pose)
        objects = self._handle.object_count
        self._handle.add_object(number, placed, as_text("name", name) or f"object {objects}")
        return objects

    @property
    def mesh_count(self) -> int:
        return self._handle.mesh_count

    @property
    def triangle_count(self) -> int:
        """In all objects."""
        return self._handle.triangle_count

    @property
    def objects(self) -> list[Object]:
        """In the order of their numbers."""
        return [Object(*each) for each in self._handle.objects()]

    @property
    def tables(self) -> dict[str, dict[int, str]]:
        """What the numbers in channels `material`, `group` and `part` stand for, as Map.tables has
        it."""
        found = {channel: self._handle.names(channel) for channel in ("material", "group", "part")}
        return {channel: dict(enumerate(names)) for channel, names in found.items() if names}

    @property
    def bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
        """The smallest box of the world, (lower, upper), that holds all triangles, rounded
        outwards; None where there are none."""
        box = self._handle.bounds()
        return None if box is None else (tuple(box[0]), tuple(box[1]))

    def vertices(self, mesh: int = 0) -> npt.NDArray[np.float64]:
        """N×3, of a mesh, in its own frame; not a copy, and not to be written to."""
        return self._handle.vertices(as_count("mesh", mesh, 0, self.mesh_count - 1))

    def faces(self, mesh: int = 0) -> npt.NDArray[np.uint32]:
        """M×3, likewise."""
        return self._handle.faces(as_count("mesh", mesh, 0, self.mesh_count - 1))

    def origin(self, triangle: int) -> Origin:
        """Where a triangle comes from, by its number in channel `id`."""
        number = as_count("triangle", triangle, 0, self.triangle_count - 1)
        return Origin(*self._handle.origin(number))

    def render(
        self,
        camera: Camera | Sequence[Camera],
        *,
        channels: Sequence[str] = ("Z",),
        cull: Cull = "none",
        dtype: npt.DTypeLike = "float32",
        scale: float = 1000,
        background: Background = float("inf"),
        engine: str = "fast",
        normals: Normals = "file",
        threads: int = 0,
        out: Mapping[str, npt.NDArray[Any]] | None = None,
    ) -> Map:
        """Renders the scene as a camera sees it, or as many of one image size do: see
        fathom.render(), whose other arguments these are. One camera gives arrays of H×W, a sequence
        of n cameras arrays of n×H×W."""
        try:
            rendered = render_cameras(self._handle, camera, channels, cull, dtype, scale,
                                      background, engine, threads, normals, out)
        except _core.InputError:
            self._check()
            raise
        result = _map_of(rendered)
        if rendered.background is not None:
            result._set_background(rendered.background)
        warn(rendered.notes)
        return result

    def _check(self) -> None:
        """Raises an exception that names the argument at fault, if one is."""
        for mesh in range(self.mesh_count):
            check_elements(self.vertices(mesh), self.faces(mesh))

    def __repr__(self) -> str:
        return (f"Scene({self._handle.object_count} objects, {self.mesh_count} meshes, "
                f"{self.triangle_count} triangles)")


def _map_of(rendered: Rendered) -> Map:
    camera, description = rendered.views[0]
    if not rendered.is_stack:
        return Map(rendered.arrays, camera, description)
    stack = Map(rendered.arrays, _views=rendered.views)
    stack._description.png_scale = description.png_scale
    stack._description.tables = description.tables
    return stack


def _no_mesh() -> int:
    raise ValueError("mesh: the scene has no mesh yet: add_mesh() adds one")
