"""Ray casters of other libraries, by their names, with exact decisions: no ray is lost between two triangles that share an
edge, and no ray meets both there. RaycastingScene takes the place of Open3D's, RayMeshIntersector that of trimesh's."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _core, _rays
from ._arguments import as_count, as_finite, as_number, as_numbers, in_words
from ._meshes import arrays_of
from .camera import Camera
from .scene import Scene

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._meshes import Mesh

    Numbers = npt.NDArray[np.float64]


class Tensor(np.ndarray):  # type: ignore[type-arg]
    """A NumPy array with two methods of Open3D's tensors."""

    def numpy(self) -> npt.NDArray[Any]:
        """The array."""
        return self.view(np.ndarray)

    def cpu(self) -> Tensor:
        """Itself."""
        return self

    def __getitem__(self, place: Any) -> Tensor:
        return np.asarray(super().__getitem__(place)).view(Tensor)  # numbers, too


class Hits(Mapping[str, Tensor]):
    """Arrays by name, as Open3D's dictionaries. primitive_uvs and primitive_normals take longer than the rest: they are
    computed when they are first read."""

    def __init__(self, known: dict[str, Tensor], later: dict[str, Callable[[], Tensor]]) -> None:
        self._known, self._later = known, later

    def __getitem__(self, name: str) -> Tensor:
        if name not in self._known:
            self._known[name] = self._later[name]()
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter([*self._known, *(name for name in self._later if name not in self._known)])

    def __len__(self) -> int:
        return len(set(self._known) | set(self._later))

    def __repr__(self) -> str:
        return f"Hits({', '.join(self)})"


class RaycastingScene:
    """Takes the place of open3d.t.geometry.RaycastingScene: the same names, defaults, keys, types and shapes.

    Arguments are arrays, Open3D's tensors or its meshes. Vertices and rays may have float64 numbers, which are taken exactly.
    Results are NumPy arrays that also have numpy() and cpu().

    Other than Open3D's: every decision is exact; hits are listed by t; a direction of 0 and numbers that are not finite raise
    ValueError. Distances and closest points are not available.

    >>> scene = RaycastingScene()
    >>> scene.add_triangles([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)])
    0
    >>> scene.cast_rays([(0.25, 0.125, 1, 0, 0, -2), (9, 9, 9, 1, 0, 0)])["t_hit"].numpy()
    array([0.5, inf], dtype=float32)
    """

    #: The value of identifiers where a ray meets nothing.
    INVALID_ID = 4294967295

    def __init__(self, nthreads: int = 0, device: object = None) -> None:
        if device is not None and not str(device).upper().startswith("CPU"):
            raise ValueError(f"device: rays are cast by the CPU, found {device}")
        self._threads = as_count("nthreads", nthreads, 0, 2**31 - 1)
        self._scene = Scene()

    def __repr__(self) -> str:
        return f"RaycastingScene({self._scene!r})"

    def add_triangles(
        self, vertex_positions: npt.ArrayLike | Mesh | None = None, triangle_indices: npt.ArrayLike | None = None, *,
        mesh: Mesh | None = None,
    ) -> int:
        """Adds N×3 vertices and M×3 triangles, which are copied, or a mesh. Returns its geometry id."""
        given: Any = mesh if vertex_positions is None else vertex_positions
        if triangle_indices is None:
            vertices, triangles = arrays_of(given)
        else:
            vertices, triangles = np.array(_array(given)), np.array(_array(triangle_indices))
        return self._scene.add_mesh(vertices, triangles)  # each has one object, with the same number

    def cast_rays(self, rays: npt.ArrayLike, nthreads: int = 0) -> Hits:
        """The first hits of rays (…×6: origins and directions), with keys t_hit (float32), geometry_ids and primitive_ids
        (uint32), …; primitive_uvs, …×2, the weights of the second and third corner, and primitive_normals, …×3, unit
        normals by the order of the corners (float32). Without a hit: inf, INVALID_ID, 0."""
        question = self._asked(rays, nthreads=nthreads)
        prepared = self._prepared()
        found = _core.cast_rays(prepared, question.origins, question.directions, *question.options)
        return _hits(prepared, question, found, question.shape)

    def test_occlusions(
        self, rays: npt.ArrayLike, tnear: float = 0.0, tfar: float = math.inf, nthreads: int = 0
    ) -> Tensor:
        """Whether rays have a hit with tnear ≤ t ≤ tfar; bool."""
        question = self._asked(rays, tnear, tfar, nthreads)
        found = _core.occluded(self._prepared(), question.origins, question.directions, *question.options)
        return _tensor(found.astype(bool), question.shape)

    def count_intersections(self, rays: npt.ArrayLike, nthreads: int = 0) -> Tensor:
        """How many triangles rays meet; int32. Triangles that share an edge count once there."""
        question = self._asked(rays, nthreads=nthreads)
        found = _core.count_hits(self._prepared(), question.origins, question.directions, *question.options)
        return _tensor(found.astype(np.int32), question.shape)

    def list_intersections(self, rays: npt.ArrayLike, nthreads: int = 0) -> Hits:
        """All hits, ray by ray, by t, with the keys of cast_rays() except primitive_normals, and with ray_ids and
        ray_splits (uint32): the hits of ray i are those from ray_splits[i] to ray_splits[i + 1]."""
        question = self._asked(rays, nthreads=nthreads)
        prepared = self._prepared()
        of_hits, splits, ray, found = _rays.all_hits(prepared, question)
        if len(ray) > self.INVALID_ID:
            raise ValueError("rays: they have more than 2^32 - 1 hits: list those of fewer rays")
        hits = _hits(prepared, of_hits, found, ray.shape)
        hits._later.pop("primitive_normals")
        hits._known |= {"ray_splits": _tensor(splits.astype(np.uint32)), "ray_ids": _tensor(ray.astype(np.uint32))}
        return hits

    def compute_occupancy(self, query_points: npt.ArrayLike, nthreads: int = 0, nsamples: int = 1) -> Tensor:
        """1 for points (…×3) inside closed surfaces, else 0; float32. Inside: a ray meets an odd number of triangles. One
        ray is enough, so `nsamples` changes nothing."""
        if as_count("nsamples", nsamples, 1, 2**31 - 1) % 2 == 0:
            raise ValueError(f"nsamples: expected an odd number, found {nsamples}")
        points = _with_rows("query_points", query_points, 3)
        return _tensor(_is_inside(self._scene, points, self._threads_of(nthreads)).astype(np.float32), points.shape[:-1])

    def compute_closest_points(self, query_points: npt.ArrayLike, nthreads: int = 0) -> Hits:
        """Not available: raises NotImplementedError."""
        raise NotImplementedError("compute_closest_points: fathom.compat casts rays only; use Open3D for closest points")

    def compute_distance(self, query_points: npt.ArrayLike, nthreads: int = 0) -> Tensor:
        """Not available: raises NotImplementedError."""
        raise NotImplementedError("compute_distance: fathom.compat casts rays only; use Open3D for distances")

    def compute_signed_distance(self, query_points: npt.ArrayLike, nthreads: int = 0, nsamples: int = 1) -> Tensor:
        """Not available: raises NotImplementedError."""
        raise NotImplementedError("compute_signed_distance: fathom.compat casts rays only; use Open3D for distances, and "
                                  "compute_occupancy() for their signs")

    @staticmethod
    def create_rays_pinhole(*arguments: Any, **keywords: Any) -> Tensor:
        """The rays of a pinhole camera, height×width×6, float32. Their directions have planar depth 1, so that t_hit is a
        planar depth. Either of

        create_rays_pinhole(intrinsic_matrix, extrinsic_matrix, width_px, height_px)
            K (3×3), whose pixel centres are at 0.5, 1.5, …, and world to camera (4×4)
        create_rays_pinhole(fov_deg, center, eye, up, width_px, height_px)
            the horizontal field of view in degrees, the point that the camera looks at, its place, and the direction in
            which rows are counted: Open3D's `up` points downwards in the image
        """
        def are(names: tuple[str, ...]) -> bool:
            return len(arguments) <= len(names) and set(keywords) == set(names[len(arguments):])

        if are(_by_matrices):
            return _rays_by_matrices(*arguments, **keywords)
        if are(_by_view):
            return _rays_by_view(*arguments, **keywords)
        raise TypeError(f"create_rays_pinhole: expected {', '.join(_by_matrices)}, or {', '.join(_by_view)}")

    def __deepcopy__(self, memo: object) -> RaycastingScene:
        twin = RaycastingScene(self._threads)
        for mesh in range(self._scene.mesh_count):
            twin.add_triangles(self._scene.vertices(mesh), self._scene.faces(mesh))
        return twin

    def _threads_of(self, nthreads: int) -> int:
        return as_count("nthreads", nthreads, 0, 2**31 - 1)

    def _asked(self, rays: npt.ArrayLike, tnear: float = 0.0, tfar: float = math.inf, nthreads: int = 0) -> _rays.Asked:
        given = _with_rows("rays", rays, 6)
        first, last = as_number("tnear", tnear), as_number("tfar", tfar)
        if not first <= last:  # Open3D finds nothing
            first = last = math.inf
        return _rays.asked(given[..., :3], given[..., 3:], first, last, False, "none", self._threads_of(nthreads))

    def _prepared(self) -> _core.Rays:
        return self._scene._prepared_rays(self._threads)


_by_matrices = ("intrinsic_matrix", "extrinsic_matrix", "width_px", "height_px")
_by_view = ("fov_deg", "center", "eye", "up", "width_px", "height_px")


def _rays_by_matrices(
    intrinsic_matrix: npt.ArrayLike, extrinsic_matrix: npt.ArrayLike, width_px: int, height_px: int
) -> Tensor:
    camera = Camera.from_opencv(_array(intrinsic_matrix), _array(extrinsic_matrix), (width_px, height_px), pixel_centre=0.5)
    with _core.standard_arithmetic():
        return _tensor(np.concatenate(camera.rays(), axis=-1).astype(np.float32))


def _rays_by_view(
    fov_deg: float, center: npt.ArrayLike, eye: npt.ArrayLike, up: npt.ArrayLike, width_px: int, height_px: int
) -> Tensor:
    target, place, y = (as_finite(name, _array(value), (3,)) for name, value in (("center", center), ("eye", eye), ("up", up)))
    with _core.standard_arithmetic():
        focal = 0.5 * width_px / math.tan(math.radians(as_number("fov_deg", fov_deg)) / 2)
        intrinsics = np.array([(focal, 0, 0.5 * width_px), (0, focal, 0.5 * height_px), (0, 0, 1)])
        z = _unit("center", target - place)
        x = _unit("up", np.cross(y, z))
        pose = np.eye(4)
        pose[:3, :3] = x, np.cross(z, x), z
        pose[:3, 3] = -pose[:3, :3] @ place
    return _rays_by_matrices(intrinsics, pose, width_px, height_px)


def _unit(name: str, vector: Numbers) -> Numbers:
    length = float(np.linalg.norm(vector))
    if not 0 < length < math.inf:
        raise ValueError(f"{name}: it leaves the camera without a direction")
    return vector / length


def _hits(
    prepared: _core.Rays, question: _rays.Asked, found: tuple[npt.NDArray[np.uint32], Numbers], shape: tuple[int, ...]
) -> Hits:
    """The arrays of Open3D: those of hits, one for each row of the question."""
    kind = np.dtype(np.float32)
    cheap = _rays.hit_arrays(prepared, question, found, ("t", "object", "face"), kind)
    costly: dict[str, npt.NDArray[Any]] = {}

    def values() -> dict[str, npt.NDArray[Any]]:
        if not costly:
            costly.update(_rays.hit_arrays(prepared, question, found, ("bary", "N", "front"), kind))
        return costly

    def weights() -> Tensor:
        bary = values()["bary"]
        bary[found[0] == RaycastingScene.INVALID_ID] = 0
        return _tensor(bary, (*shape, 2))

    def normals() -> Tensor:
        is_back = (values()["front"] == 0) & (found[0] != RaycastingScene.INVALID_ID)
        return _tensor(np.where(is_back[:, None], -values()["N"], values()["N"]), (*shape, 3))

    known = {"t_hit": cheap["t"], "geometry_ids": cheap["object"], "primitive_ids": cheap["face"]}
    return Hits({name: _tensor(array, shape) for name, array in known.items()},
                {"primitive_uvs": weights, "primitive_normals": normals})


class RayMeshIntersector:
    """Takes the place of trimesh's class of this name: `mesh.ray = RayMeshIntersector(mesh)`. The mesh has `vertices` and
    `faces`; changes to these are noticed. Every decision is exact.

    Other than trimesh's: hits are listed ray by ray and by their distance; there are as many as there are, and one at an
    edge; a hit at the origin of a ray counts; arguments after the directions have names.

    >>> from types import SimpleNamespace
    >>> sheet = SimpleNamespace(vertices=[(0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4)], faces=[(0, 1, 2), (0, 2, 3)])
    >>> RayMeshIntersector(sheet).intersects_location([(1, 1, 0)], [(0, 0, 1)])
    (array([[1., 1., 4.]]), array([0]), array([0]))
    """

    def __init__(self, mesh: Any, scale_to_box: bool = True) -> None:
        self.mesh = mesh  # which needs no scaling
        self._known: tuple[npt.NDArray[Any], npt.NDArray[Any], Scene] | None = None

    def __repr__(self) -> str:
        return f"RayMeshIntersector({self._scene()!r})"

    def intersects_id(
        self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike, *, return_locations: bool = False,
        multiple_hits: bool = True, max_hits: int | None = None,
    ) -> tuple[npt.NDArray[Any], ...]:
        """The hits of rays (N×3 each): numbers of faces, numbers of rays (int64), and with `return_locations` the places,
        h×3. Without `multiple_hits`, only the first hit of each ray; with `max_hits`, not more than that many."""
        channels = "id,P" if return_locations else "id"
        scene, rays = self._scene(), _rows_of_rays(ray_origins, ray_directions)
        chosen: Any = slice(None)
        if multiple_hits:
            hits = scene.cast(*rays, mode="all", channels=channels)
            ray = hits["ray"]
            if max_hits is not None:
                rank = np.arange(len(ray)) - hits["splits"][ray]
                chosen = rank < as_count("max_hits", max_hits, 0, 2**63 - 1)
        else:
            hits = scene.cast(*rays, channels=channels)
            ray, chosen = np.arange(len(hits["id"])), hits["id"] != RaycastingScene.INVALID_ID
        found = (hits["id"][chosen].astype(np.int64), ray[chosen].astype(np.int64))
        return (*found, hits["P"][chosen]) if return_locations else found

    def intersects_location(
        self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike, **keywords: Any
    ) -> tuple[npt.NDArray[Any], ...]:
        """The places of hits, h×3, and the numbers of their rays and faces; arguments as of intersects_id()."""
        face, ray, places = self.intersects_id(ray_origins, ray_directions, return_locations=True, **keywords)
        return places, ray, face

    def intersects_first(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """The face that each ray meets first, or -1."""
        found = self._scene().cast(*_rows_of_rays(ray_origins, ray_directions), channels=("id",))["id"]
        return np.where(found == RaycastingScene.INVALID_ID, -1, found.astype(np.int64))

    def intersects_any(self, ray_origins: npt.ArrayLike, ray_directions: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Whether each ray meets the mesh."""
        return self._scene().occluded(*_rows_of_rays(ray_origins, ray_directions))

    def contains_points(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Whether points (N×3) are inside the closed mesh: a ray meets an odd number of faces."""
        return _is_inside(self._scene(), _with_rows("points", points, 3), 0)

    def _scene(self) -> Scene:
        vertices, faces = np.asarray(self.mesh.vertices), np.asarray(self.mesh.faces)
        if self._known is None or not (np.array_equal(vertices, self._known[0]) and np.array_equal(faces, self._known[1])):
            scene = Scene()
            kept = vertices.copy(), faces.copy()
            scene.add_mesh(*kept)
            self._known = (*kept, scene)
        return self._known[2]


def _rows_of_rays(origins: npt.ArrayLike, directions: npt.ArrayLike) -> tuple[Numbers, Numbers]:
    o, d = as_finite("ray_origins", origins), as_finite("ray_directions", directions)
    if o.shape != d.shape or o.ndim != 2 or o.shape[1] != 3:
        raise ValueError("ray_origins and ray_directions: expected two arrays of one shape N×3, found "
                         f"{in_words(o.shape)} and {in_words(d.shape)}")
    return o, d


def _is_inside(scene: Scene, points: Numbers, threads: int) -> npt.NDArray[np.bool_]:
    """Whether a ray from each point meets an odd number of triangles: each changes the winding number by 1."""
    inside: npt.NDArray[np.bool_] = scene._winding_numbers(points, threads) % 2 != 0
    return inside


def _with_rows(name: str, value: npt.ArrayLike, width: int) -> Numbers:
    numbers = as_numbers(name, _array(value))
    if numbers.ndim < 2 or numbers.shape[-1] != width:
        raise ValueError(f"{name}: expected shape …×{width} of two dimensions or more, found {in_words(numbers.shape)}")
    return numbers


def _array(value: Any) -> Any:
    """Of Open3D's tensors, which np.asarray() does not take."""
    return value.cpu().numpy() if hasattr(value, "cpu") and hasattr(value, "numpy") else value


def _tensor(array: npt.NDArray[Any], shape: tuple[int, ...] | None = None) -> Tensor:
    return (array if shape is None else array.reshape(shape)).view(Tensor)
