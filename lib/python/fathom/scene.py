"""Scenes: meshes, and objects that place them in the world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core, _rays, sight
from ._arguments import (
    as_count,
    as_text,
    as_threads,
    camera_handle,
    check_elements,
    culls,
    faces_of,
    labels_of,
    names_of,
    one_of,
    pose_of,
    vertices_of,
)
from ._files import Path, path_of
from ._meshes import arrays_of
from ._render import background_value, render_cameras
from ._shown import html_of, png_of
from ._warnings import warn
from .camera import Camera
from .maps import NO_SURFACE, Map
from .rays import arrays_of_rays, camera_of, require_whole_rays

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt

    from ._meshes import Mesh
    from ._shown import Picture
    from .names import Background, Channels, Cull, EdgeRule, Engine, Normals, RayChannels, RayMode
    from .rays import RaysLike

#: Larger scenes are shown in notebooks without a picture, and more objects are counted.
most_triangles_to_draw = 10_000_000
most_objects_to_list = 20


class Object(NamedTuple):
    """A mesh placed in the world; channel `object` contains its number."""

    name: str
    mesh: int
    #: The file that it was read from.
    source: str


class Origin(NamedTuple):
    """The object, mesh triangle and face behind a triangle number of channel `id`."""

    object: int
    #: Its number within its object's mesh.
    triangle: int
    #: The number of its face within its file.
    face: int


class Scene:
    """Meshes and the objects that place them. Triangles are numbered from 0, through all objects in
    order.

    >>> import numpy as np
    >>> scene = Scene()
    >>> corners = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float)
    >>> sheet = scene.add_mesh(corners, np.array([(0, 1, 2)]), name="sheet")
    >>> scene.add_instance(sheet, [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 2)], name="two behind")
    1
    >>> scene.triangle_count, [each.name for each in scene.objects]
    (2, ['sheet', 'two behind'])
    """

    __slots__ = ("_handle", "_rays")
    _handle: _core.Scene
    #: The number of objects that rays were prepared for, and what was prepared.
    _rays: tuple[int, _core.Rays] | None

    def __init__(self) -> None:
        self._handle = _core.Scene()
        self._rays = None

    @classmethod
    def read(cls, *files: Path, threads: int = 0, clouds: bool = False) -> Scene:
        """Reads meshes (OBJ, PLY, STL, OFF, glTF/GLB; with the program fathom-formats also the
        formats of assimp) and scene files (JSON) into one scene, in the given order. Tolerated
        faults are warnings; InputError names the file.

        clouds  a file with vertices and without faces is a point cloud for evaluate(), and no reason for a warning
        """
        if not files:
            raise TypeError("read: expected a file")
        scene = cls()
        import shutil  # slow to import, and not needed elsewhere

        paths = [path_of("files", file) for file in files]
        formats = shutil.which("fathom-formats") or ""
        scene._handle, notes = _core.read_scene(paths, formats, as_threads(threads), bool(clouds))
        warn(notes, UserWarning)
        return scene

    def add_mesh(
        self,
        vertices: npt.ArrayLike | Mesh,
        faces: npt.ArrayLike | None = None,
        *,
        pose: npt.ArrayLike | None = None,
        name: str = "",
        labels: npt.ArrayLike | None = None,
        materials: str | Sequence[str | None] | None = None,
    ) -> int:
        """Adds a mesh, and an object that places it. Returns the number of the mesh, for
        add_instance().

        vertices   N×3 in the mesh's own frame; float64, float32 or integers, taken as exact numbers
        faces      M×3 triangles: vertex numbers from 0, integers of any type. Without faces,
                   `vertices` is a mesh of trimesh (Trimesh), Open3D (TriangleMesh) or PyVista
                   (PolyData), whose vertices and triangles are copied
        pose       4×4 or 3×4, mesh to world (default: the identity)
        name       name of the object (default: "mesh 0", "mesh 1", …)
        labels     an integer for each face, or one for all, for channel `label`. Negative: no label
        materials  a name for each face, or one for all; channel `material` numbers them by first
                   appearance in the scene. None and "" mean no material

        Arrays in C order, of float64 and of int32 or uint32, are not copied: later changes to them
        change the scene. Do not change them during a render.
        """
        placed = None if pose is None else pose_of("pose", pose)
        called = as_text("name", name)
        if faces is None:
            vertices, faces = arrays_of(vertices)
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
        """Places a mesh again; `pose` and `name` are as in add_mesh(). Returns the number of the
        object."""
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
        """Number of triangles in all objects."""
        return self._handle.triangle_count

    @property
    def objects(self) -> list[Object]:
        """The objects in the order of their numbers."""
        return [Object(*each) for each in self._handle.objects()]

    @property
    def tables(self) -> dict[str, dict[int, str]]:
        """The names behind the numbers of channels `material`, `group` and `part`, as in
        Map.tables."""
        found = {channel: self._handle.names(channel) for channel in ("material", "group", "part")}
        return {channel: dict(enumerate(names)) for channel, names in found.items() if names}

    @property
    def bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
        """The smallest box that contains all triangles, (lower, upper) in the world, rounded
        outwards; None without triangles."""
        box = self._handle.bounds()
        return None if box is None else (tuple(box[0]), tuple(box[1]))

    def vertices(self, mesh: int = 0) -> npt.NDArray[np.float64]:
        """The vertices of a mesh: N×3, in its own frame. Not a copy; do not write to it."""
        return self._handle.vertices(as_count("mesh", mesh, 0, self.mesh_count - 1))

    def faces(self, mesh: int = 0) -> npt.NDArray[np.uint32]:
        """The faces of a mesh: M×3 vertex numbers from 0. Not a copy; do not write to it."""
        return self._handle.faces(as_count("mesh", mesh, 0, self.mesh_count - 1))

    def origin(self, triangle: int) -> Origin:
        """The origin of a triangle, by its number in channel `id`."""
        number = as_count("triangle", triangle, 0, self.triangle_count - 1)
        return Origin(*self._handle.origin(number))

    def render(
        self,
        camera: Camera | Sequence[Camera],
        *,
        channels: Channels = ("Z",),
        cull: Cull = "none",
        dtype: npt.DTypeLike = "float32",
        scale: float = 1000,
        background: Background = float("inf"),
        engine: Engine = "fast",
        normals: Normals = "file",
        threads: int = 0,
        out: Mapping[str, npt.NDArray[Any]] | None = None,
    ) -> Map:
        """Renders the scene: H×W arrays for one camera, n×H×W arrays for a sequence of n cameras of
        one image size. `engine` is "fast" or "reference", which returns the same map slowly. The
        other arguments, results and errors are as in fathom.render()."""
        nothing = background_value(background, dtype)
        try:
            arrays, views, notes = render_cameras(self._handle, camera, channels, cull, dtype,
                                                  scale, engine, threads, normals, out)
        except _core.InputError:
            self._check()
            raise
        result = Map(arrays, *views[0]) if isinstance(camera, Camera) else _stack(arrays, views)
        if nothing is not None:
            result._set_background(nothing)
        warn(notes)
        return result

    def cast(
        self,
        origins: RaysLike,
        directions: npt.ArrayLike | None = None,
        tmin: float = 0,
        tmax: float = float("inf"),
        *,
        open: bool = False,
        cull: Cull = "none",
        mode: RayMode = "nearest",
        channels: RayChannels = ("t", "id"),
        dtype: npt.DTypeLike = "float64",
        threads: int = 0,
    ) -> dict[str, npt.NDArray[Any]]:
        """Finds the triangles that rays meet. Every decision is exact: no ray passes between two triangles that share an
        edge, and none meets both there.

        origins     N×3, or any shape that ends in 3; one origin fits many directions. Numbers are taken exactly
        directions  likewise; they need no length of 1: t counts their lengths. Without directions, `origins` has N×6 numbers,
                    the origin and the direction of each ray, or is a fathom.Rays
        tmin, tmax  which hits count: tmin ≤ t ≤ tmax, or tmin < t < tmax if `open`. tmin may be -inf
        cull        leaves out "back" or "front" faces. A face is a front face if its normal points against the ray
        mode        "nearest": the hit with the least t, among equals the lowest triangle number. "all": every hit, by t,
                    then by number
        channels    "t"; "id", the triangle number (NO_SURFACE without a hit); "distance"; "P", the point; "bary", the
                    weights of the second and third corner; "N", the unit normal against the ray; "object", "face"
        dtype       float64 or float32, of t, distance, P, bary and N: each is the exact number rounded once

        Returns an array for each channel. Of "nearest" it has the shape of the rays; without a hit t and distance are
        inf, P and bary nan, N 0. Of "all" it has a row for each hit; the hits of ray i (in C order) are those from
        splits[i] to splits[i + 1], and "ray" is the number of each hit's ray.

        The scene is prepared when rays are first cast. After that, do not change arrays given to add_mesh().

        >>> import numpy as np
        >>> scene = Scene()
        >>> _ = scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)]), np.array([(0, 1, 2)]))
        >>> hits = scene.cast((1, 1, 0), [(0, 0, 1), (0, 0, -1)])
        >>> hits["t"].tolist(), (hits["id"] != 4294967295).tolist()
        ([4.0, inf], [True, False])
        """
        names, kind = _rays.checked_channels(channels), _rays.real_type(dtype)
        is_nearest = one_of("mode", mode, _rays.ray_modes) == "nearest"
        if camera := camera_of(origins):
            require_whole_rays(directions, tmin, tmax, open)
            if is_nearest:
                return self._hits_of(camera, names, cull, kind, threads)
            return self._all_hits_of(camera, names, cull, kind, threads)
        question = _rays.asked(*arrays_of_rays(origins, directions), tmin, tmax, open, cull, threads)
        prepared = self._prepared_rays(threads)
        if not is_nearest:
            return _rays.hit_lists(prepared, question, names, kind)
        found = _core.cast_rays(prepared, question.origins, question.directions, *question.options)
        arrays = _rays.hit_arrays(prepared, question, found, names, kind)
        return {name: array.reshape(question.shape + array.shape[1:]) for name, array in arrays.items()}

    def occluded(
        self, origins: RaysLike, directions: npt.ArrayLike | None = None, tmin: float = 0,
        tmax: float = float("inf"), *, open: bool = False, cull: Cull = "none", threads: int = 0,
    ) -> npt.NDArray[np.bool_]:
        """Whether each ray meets a triangle. The arguments are as in cast()."""
        if camera := camera_of(origins):
            require_whole_rays(directions, tmin, tmax, open)
            seen: npt.NDArray[np.bool_] = self._hits_of(camera, ["id"], cull, threads=threads)["id"] != NO_SURFACE
            return seen
        question = _rays.asked(*arrays_of_rays(origins, directions), tmin, tmax, open, cull, threads)
        found = _core.occluded(self._prepared_rays(threads), question.origins, question.directions, *question.options)
        return found.reshape(question.shape).astype(bool)

    def count(
        self, origins: RaysLike, directions: npt.ArrayLike | None = None, tmin: float = 0,
        tmax: float = float("inf"), *, open: bool = False, cull: Cull = "none", threads: int = 0,
    ) -> npt.NDArray[np.uint32]:
        """How many triangles each ray meets. The arguments are as in cast()."""
        if camera := camera_of(origins):
            require_whole_rays(directions, tmin, tmax, open)
            splits, _, _ = self._hits_of_pixels(camera, cull, threads)
            counts: npt.NDArray[np.uint32] = np.diff(splits).astype(np.uint32)
            return counts.reshape(camera.height, camera.width)
        question = _rays.asked(*arrays_of_rays(origins, directions), tmin, tmax, open, cull, threads)
        found = _core.count_hits(self._prepared_rays(threads), question.origins, question.directions, *question.options)
        return found.reshape(question.shape)

    def contains(self, points: npt.ArrayLike, *, threads: int = 0) -> npt.NDArray[np.bool_]:
        """Whether points (N×3, or any shape that ends in 3) are inside: whether the surface winds around them, seen along
        +x. For a closed surface every point is inside or outside, also on the surface; for an open surface the result
        depends on that direction."""
        inside: npt.NDArray[np.bool_] = self._winding_numbers(points, threads) != 0
        return inside

    def _winding_numbers(self, points: npt.ArrayLike, threads: int) -> npt.NDArray[np.int64]:
        given = _rays.rows_of_three("points", points)
        numbers = _core.winding_numbers(self._prepared_rays(threads), given.reshape(-1, 3), as_threads(threads))
        return numbers.reshape(given.shape[:-1])

    def _hits_of(
        self, camera: Camera, channels: Sequence[str], cull: Cull, kind: np.dtype[Any] | None = None, threads: int = 0
    ) -> dict[str, npt.NDArray[Any]]:
        """The nearest hits of a camera's rays: what the camera shows."""
        names = ["Z" if name == "t" else name for name in channels]
        maps = self.render(camera, channels=",".join(names), cull=cull, dtype=kind or "float32", threads=threads)
        return {name: maps[of_map] for name, of_map in zip(channels, names)}

    def sees(
        self, eyes: npt.ArrayLike | sight.SurfacePoints, points: npt.ArrayLike | sight.SurfacePoints, pairs: bool = True,
        edges: EdgeRule = "closed", *, threads: int = 0,
    ) -> npt.NDArray[np.bool_]:
        """Whether points are seen from eyes: whether no triangle has a point in the open segment between them. Triangles
        on which an end lies, or in a plane with the segment, hide nothing. Every decision is exact.

        eyes, points  N×3, or any shape that ends in 3; numbers are taken exactly. Or SurfacePoints: coordinates of a
                      surface that were rounded lie beside it, perhaps behind it
        pairs         eyes and points are pairs, and one eye fits many points; False: all eyes and all points
        edges         "closed": every edge of a triangle hides the points behind it. "generic": each edge belongs to one
                      triangle, as in cast()

        Returns an array of the shape of the pairs, or of eyes and points one after the other.

        >>> import numpy as np
        >>> scene = Scene()
        >>> _ = scene.add_mesh(np.array([(0, 0, 4), (4, 0, 4), (0, 4, 4)]), np.array([(0, 1, 2)]))
        >>> scene.sees((1, 1, 0), [(1, 1, 3), (1, 1, 4), (1, 1, 5)]).tolist()
        [True, True, False]
        """
        return sight.sees(self._prepared_rays(threads), eyes, points, pairs, edges, threads)

    def seen_by(
        self, points: npt.ArrayLike | sight.SurfacePoints, cameras: Camera | Iterable[Camera], cull: Cull = "none", *,
        threads: int = 0,
    ) -> npt.NDArray[np.bool_]:
        """Whether cameras see points: an array of the shape of the points, then a column for each camera.

        A camera sees a point whose depth is above 0 and from near to far and whose image is in the closed rectangle of
        the image, if no triangle that culling keeps, its edges included, is nearer there. Of SurfacePoints it sees
        those whose triangle it does not see edge on and culling keeps. Cameras whose lens bends rays are refused.

        points   as in sees()
        cameras  a camera, or several
        cull     leaves out "back" or "front" faces
        """
        return sight.seen_by(self._prepared_rays(threads), points, cameras, cull, threads)

    def _all_hits_of(
        self, camera: Camera, channels: Sequence[str], cull: Cull, kind: np.dtype[Any], threads: int
    ) -> dict[str, npt.NDArray[Any]]:
        """All hits of a camera's rays, pixel by pixel."""
        for name in channels:
            one_of("channels", name, ("t", "id", "object", "face"))
        if kind != "float64":
            raise TypeError(f"dtype: all hits of a camera's rays have t in float64, found {kind}")
        given, triangles, t = self._hits_of_pixels(camera, cull, threads)
        splits, ray = _rays.splits_and_rays(given)
        arrays: dict[str, npt.NDArray[Any]] = {"splits": splits, "ray": ray, "t": t, "id": triangles}
        if not {"object", "face"}.isdisjoint(channels):
            arrays["object"], arrays["face"] = _core.origins_of(self._prepared_rays(threads), triangles)
        return {name: arrays[name] for name in ("splits", "ray", *channels)}

    def _hits_of_pixels(
        self, camera: Camera, cull: Cull, threads: int
    ) -> tuple[npt.NDArray[np.uint64], npt.NDArray[np.uint32], npt.NDArray[np.float64]]:
        try:
            return _core.hits_of_pixels(self._handle, camera_handle(camera), one_of("cull", cull, culls), as_threads(threads))
        except _core.InputError:
            self._check()
            raise

    def _prepared_rays(self, threads: int) -> _core.Rays:
        objects = self._handle.object_count
        known = self._rays
        if known is not None and known[0] == objects:
            return known[1]
        try:
            # Another thread may add an object meanwhile.
            prepared = _core.prepare_rays(self._handle, as_threads(threads))
        except _core.InputError:
            self._check()
            raise
        self._rays = objects, prepared
        return prepared

    def _check(self) -> None:
        """Raises an exception that names the faulty argument, if one is faulty."""
        for mesh in range(self.mesh_count):
            check_elements(self.vertices(mesh), self.faces(mesh))

    def _picture(self) -> Picture:
        """The depths of a view of the whole scene."""
        camera = Camera.frame(self, size=(480, 360))
        arrays, views, _ = render_cameras(self._handle, camera, ("Z",), "none", "float32", 1000, "fast", 0, "file", None)
        return Map(arrays, *views[0]).preview()

    def _repr_png_(self) -> bytes | None:
        return png_of(self._picture) if 0 < self.triangle_count <= most_triangles_to_draw else None

    def _repr_html_(self) -> str:
        rows = [("object", "name", "mesh", "triangles", "file"),
                *((str(number), each.name, str(each.mesh), str(len(self.faces(each.mesh))), each.source)
                  for number, each in enumerate(self.objects[:most_objects_to_list]))]
        more = self._handle.object_count - most_objects_to_list
        return html_of(self._in_words(), rows, self._repr_png_(), f"<p>and {more} more objects</p>" if more > 0 else "")

    def __repr__(self) -> str:
        return f"Scene({self._in_words()})"

    def _in_words(self) -> str:
        text = (f"{_counted(self._handle.object_count, 'object')}, {_counted(self.mesh_count, 'mesh', 'meshes')}, "
                f"{_counted(self.triangle_count, 'triangle')}")
        if self.bounds is None:
            return text
        with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
            return text + "; " + ", ".join(f"{axis} {low:.6g} to {high:.6g}" for axis, low, high in zip("xyz", *self.bounds))


def _counted(count: int, one: str, several: str = "") -> str:
    return f"{count} {one if count == 1 else several or one + 's'}"


def _stack(
    arrays: dict[str, npt.NDArray[Any]], views: list[tuple[Camera, _core.Map]]
) -> Map:
    stack = Map(arrays, _views=views)
    _, first = views[0]
    stack._description.png_scale, stack._description.tables = first.png_scale, first.tables
    return stack


def _no_mesh() -> int:
    raise ValueError("mesh: the scene has no mesh yet: add_mesh() adds one")
