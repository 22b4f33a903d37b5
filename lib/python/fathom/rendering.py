"""render(): the maps of one mesh, from arrays."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ._arguments import as_array, require_one_matrix, takes_pixel_centre
from .camera import Camera
from .scene import Scene

if TYPE_CHECKING:
    import numpy.typing as npt

    from .maps import Map
    from .names import Background, Channels, Cull, Normals


@takes_pixel_centre
def render(
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    K: npt.ArrayLike,
    T: npt.ArrayLike,
    size: Sequence[int],
    *,
    pixel_centre: float,
    channels: Channels = ("Z",),
    near: float = 0,
    far: float = math.inf,
    cull: Cull = "none",
    dtype: npt.DTypeLike = "float32",
    scale: float = 1000,
    background: Background = math.inf,
    normals: Normals = "file",
    threads: int = 0,
    out: Mapping[str, npt.NDArray[Any]] | None = None,
) -> Map:
    """Renders the exact depth map of a mesh: every value is the exact number, rounded once.

    vertices      N×3, float64 or float32, in the world
    faces         M×3 triangles: vertex numbers from 0, integers of any type
    K             3×3, fx skew cx / 0 fy cy / 0 0 1, in pixels; or a stack, n×3×3
    T             4×4 or 3×4, world to camera, x right, y down, z forward (OpenCV); or a stack of n
    size          (width, height) in pixels
    pixel_centre  image coordinate of the first pixel's centre in K's convention: 0.5 (COLMAP,
                  OpenGL) or 0 (OpenCV, BOP). Required, because half a pixel is the most common
                  error.
    channels      channels to render, as ("Z", "id") or "Z,id": Z (planar depth), A (coverage), Zlow
                  (exact depth minus Z), distance (along the ray), id, face, object (numbers of the
                  visible triangle, face and object; NO_SURFACE without a surface), material, group,
                  part, label (of a Scene; NO_SEGMENT if the visible triangle has no such name or
                  label), N (normal) and P (position), both in the world, bary (weights of the
                  triangle's second and third corner), Nc (normal in the camera frame), Ns
                  (interpolated normals of the corners, in the world), valid (1 where a lens has a
                  ray). The names depth, normal, camera-normal, segmentation and mask mean Z, N, Nc,
                  object and id, and are found in the map
    near, far     range of planar depths that are rendered, in scene units
    cull          "back" or "front" leaves out triangles that face this way
    dtype         type of Z and distance: float32, float64, or uint16 for codes
                  round(scale · depth), 0 for no surface
    background    value of Z and distance without a surface (and for a depth beyond the greatest
                  number of the type): inf, nan, 0 or any other number
    normals       normals that Ns interpolates: "file" (like "vertex" if the file has no normals),
                  "vertex" (sums over the triangles at each vertex, weighted by area) or "place"
                  (sums over the triangles at all vertices at the same place)
    threads       number of threads; 0: all. Results never depend on it.
    out           arrays to write to, by channel, for example the result of an earlier call: saves
                  the time for allocating memory. Their shapes and types must fit; the same arrays
                  are returned.

    Returns a dict of arrays by channel: H×W, H×W×3 for N, P, Nc and Ns, H×W×2 for bary; with n
    cameras n×H×W(×3). Arrays of vertices and faces that fit (see Scene.add_mesh()) are not copied.
    Other Python threads run meanwhile, and Ctrl-C ends the call.

    Warns (ViewWarning) if the view is suspicious: nothing is in front of the camera, the matrix is
    camera to world or no rotation, the principal point is far from the middle, the eye is inside a
    solid, or metres are mixed with millimetres.

    Raises TypeError, ValueError or IndexError, which name the argument; MemoryError; OutputError if
    a depth has no code.

    >>> corners = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float)
    >>> K = np.array([[4, 0, 2], [0, 4, 2], [0, 0, 1]], float)
    >>> render(corners, [(0, 1, 2)], K, np.eye(4), (4, 4), pixel_centre=0.5)["Z"]
    array([[inf, inf, inf, inf],
           [inf,  4.,  4., inf],
           [inf, inf, inf, inf],
           [inf, inf, inf, inf]], dtype=float32)
    """
    scene = Scene()
    scene.add_mesh(vertices, faces)
    cameras = cameras_of(K, T, size, pixel_centre, near, far)
    return scene.render(cameras, channels=channels, cull=cull, dtype=dtype, scale=scale,
                        background=background, normals=normals, threads=threads, out=out)


def cameras_of(
    K: npt.ArrayLike,
    T: npt.ArrayLike,
    size: Sequence[int],
    pixel_centre: float,
    near: float,
    far: float,
) -> Camera | list[Camera]:
    """One camera; or a list, if K or T is a stack. The other may be a single matrix for all."""
    require_one_matrix("T", T)
    intrinsics, poses = as_array("K", K), as_array("T", T)
    counts = {len(stack) for stack in (intrinsics, poses) if stack.ndim == 3}
    if not counts:
        return Camera.from_opencv(K, T, size, pixel_centre=pixel_centre, near=near, far=far)
    if len(counts) > 1:
        raise ValueError("K and T: expected stacks of one length, found "
                         f"{len(intrinsics)} and {len(poses)}")
    count = counts.pop()

    def each(stack: npt.NDArray[np.float64], i: int) -> npt.NDArray[np.float64]:
        return cast("npt.NDArray[np.float64]", stack[i]) if stack.ndim == 3 else stack

    return [
        Camera.from_opencv(each(intrinsics, i), each(poses, i), size, pixel_centre=pixel_centre,
                           near=near, far=far)
        for i in range(count)
    ]
