"""The extension module: what core/*.cpp bind. Its callers have checked what they pass."""

from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Codes = npt.NDArray[np.uint64]
Rows = tuple[tuple[float, ...], ...]
Named = list[tuple[str, Camera]]

version: str
no_surface: int
no_segment: int
background_text: str
camera_text: str
normals_text: str
compressions: list[str]
color_maps: list[str]
color_scales: list[str]
point_frames: list[str]
normal_axes: list[str]
quantities: list[str]
ray_channels: list[str]
culls: list[str]
edge_selections: list[str]
contents: dict[str, str]
most_pixels: int
too_many_pixels: str
png_scale: float
engines: list[str]
normal_sources: list[str]
segment_channels: list[str]
stored_types: list[str]
mappings: list[str]
storages: list[str]
class_names: list[str]
model_names: str

class Error(Exception): ...
class UsageError(Error, ValueError): ...
class InputError(Error, ValueError): ...
class OutputError(Error, OSError): ...

class standard_arithmetic:
    """A context in which this thread rounds to nearest and keeps subnormal numbers."""

    def __init__(self) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, *raised: object) -> None: ...

class Camera:
    def __init__(
        self,
        width: int,
        height: int,
        orthographic: bool,
        intrinsics: list[float],
        pixel_centre: float,
        pose: Rows,
        near: float,
        far: float,
        name: str,
    ) -> None: ...
    name: str
    width: int
    height: int
    orthographic: bool
    fx: float
    fy: float
    cx: float
    cy: float
    skew: float
    pixel_centre: float
    lens: tuple[str, list[float], float] | None
    near: float
    far: float
    world_to_camera: list[list[float]]
    camera_to_world: list[list[float]]

class Lens:
    def __init__(
        self,
        width: int,
        height: int,
        orthographic: bool,
        fov: float | None,
        focal: float | None,
        extent: float | None,
        near: float,
        far: float,
    ) -> None: ...

class View:
    def __init__(self, azimuth: float, elevation: float, up: list[float]) -> None: ...

def look_at(eye: list[float], target: list[float], up: list[float], lens: Lens) -> Camera: ...
def orbit(view: View, count: int, centre: list[float], distance: float, lens: Lens) -> list[Camera]: ...
def frame_scene(scene: Scene, view: View, lens: Lens) -> Camera: ...
def orbit_scene(scene: Scene, view: View, count: int, lens: Lens) -> list[Camera]: ...
def project(camera: Camera, points: Floats) -> Floats: ...
def unproject(camera: Camera, pixels: Floats, depths: Floats, frame: str) -> Floats: ...
def rays_of_pixels(camera: Camera, frame: str) -> Floats: ...
def resized(camera: Camera, width: int, height: int) -> Camera: ...
def scaled(camera: Camera, factor: float) -> Camera: ...
def with_size(camera: Camera, width: int, height: int) -> Camera: ...
def import_colmap(folder: str, ignore_distortion: bool) -> tuple[Named, list[str]]: ...
def import_nerf(file: str, width: int, height: int, ignore_distortion: bool) -> tuple[Named, list[str]]: ...
def import_bop(file: str, width: int, height: int) -> tuple[Named, list[str]]: ...
def import_sfm_data(file: str, ignore_distortion: bool) -> tuple[Named, list[str]]: ...
def import_gltf(file: str, width: int, height: int) -> tuple[Named, list[str]]: ...

class GivenLens:
    def __init__(self, width: int, height: int, K: list[float] | None, pixel_centre: float | None) -> None: ...

def import_matrices(
    poses: list[tuple[str, Rows]],
    K: list[list[float]],
    camera_to_world: bool,
    opengl: bool,
    pixel_centre: float,
    width: int,
    height: int,
) -> tuple[Named, list[str]]: ...
def import_tum(
    trajectory: str, images: str | None, lens: str, given: GivenLens, ignore_distortion: bool
) -> tuple[Named, list[str]]: ...
def import_7scenes(folder: str, given: GivenLens) -> tuple[Named, list[str]]: ...
def import_scannet(folder: str, colour: bool, given: GivenLens) -> tuple[Named, list[str]]: ...
def import_scannetpp(file: str, given: GivenLens) -> tuple[Named, list[str]]: ...
def import_replica(folder: str, given: GivenLens) -> tuple[Named, list[str]]: ...
def import_kitti(
    calibration: str, poses: str | None, number: int | None, given: GivenLens
) -> tuple[Named, list[str]]: ...
def camera_from_opengl(projection: list[float], modelview: list[float], width: int, height: int) -> Camera: ...
def cameras_from_json(text: str, name: str | bytes, is_file: bool) -> tuple[list[Camera], list[str]]: ...
def cameras_to_json(cameras: list[Camera]) -> str: ...
def camera_to_json(camera: Camera) -> str: ...
def directions_of(camera: Camera) -> Floats: ...
def camera_with_table(text: str, numbers: Floats) -> Camera: ...
def table_of(camera: Camera) -> Floats | None: ...
def has_table_without_file(camera: Camera) -> bool: ...

class Scene:
    mesh_count: int
    object_count: int
    triangle_count: int
    def add_mesh(self, vertices: Floats, faces: npt.NDArray[np.uint32]) -> int: ...
    def set_segments(self, mesh: int, channel: str, numbers: npt.NDArray[np.uint32], names: list[str]) -> None: ...
    def names(self, channel: str) -> list[str]: ...
    def add_object(self, mesh: int, pose: Rows | None, name: str) -> None: ...
    def objects(self) -> list[tuple[str, int, str]]: ...
    def origin(self, triangle: int) -> tuple[int, int, int]: ...
    def bounds(self) -> tuple[list[float], list[float]] | None: ...
    def overlaps(self, array: npt.NDArray[Any]) -> bool: ...
    def vertices(self, mesh: int) -> Floats: ...
    def faces(self, mesh: int) -> npt.NDArray[np.uint32]: ...

def read_scene(files: list[str], formats_program: str, threads: int, clouds: bool) -> tuple[Scene, list[str]]: ...

class Map:
    def __init__(self) -> None: ...
    width: int
    height: int
    camera: Camera | None
    texts: dict[str, str]
    object_names: list[str]
    tables: dict[str, list[str]]
    png_scale: float | None
    def texts_of_file(self) -> dict[str, str]: ...
    def take_channels(self) -> dict[str, npt.NDArray[Any]]: ...
    def with_channels(self, height: int, width: int, channels: list[tuple[str, npt.NDArray[Any]]]) -> Map: ...

def read_map(file: str) -> Map: ...
def require_map_name(file: str) -> None: ...
def write_map(
    map: Map, file: str, channel: str, compression: str, threads: int, names: list[tuple[str, str]],
    camera: Camera | None, normal_bits: int, normal_axes: str,
) -> None: ...
def convert_quantity(
    map: Map,
    source: str,
    to: str,
    camera: Camera,
    baseline: float | None,
    doffs: float,
    background: float | None,
) -> Map: ...
def with_storage(map: Map, channel: str, type: str, scale: float | None) -> Map: ...
def write_mask(map: Map, file: str, object: int | None) -> None: ...
def write_point_cloud(
    maps: list[Map], cameras: list[Camera], file: str, frame: str, binary64: bool, is_stack: bool
) -> None: ...
def points(map: Map, camera: Camera, frame: str) -> Floats: ...
def set_background(
    description: Map, height: int, width: int, channels: list[tuple[str, npt.NDArray[Any]]], value: float
) -> dict[str, str]: ...

class DifferenceSummary:
    max: float
    mean: float
    p50: float
    p90: float
    p99: float
    p99_9: float
    worst: tuple[int, int]

class DepthMetrics:
    pixels: int
    left_out: int
    abs_rel: float
    sq_rel: float
    rmse: float
    rmse_log: float
    mae: float
    delta_1: float
    delta_2: float
    delta_3: float

class DisparityMetrics:
    pixels: int
    left_out: int
    epe: float
    rmse: float
    bad_0_5: float
    bad_1: float
    bad_2: float

class ChannelComparison:
    truth_channel: str
    other_channel: str
    pixels: int
    both: int
    only_truth: int
    only_other: int
    neither: int
    compared: int
    bit_equal: int
    incommensurable: int
    different_identifiers: int
    beyond_tolerance: int
    absolute: DifferenceSummary
    relative: DifferenceSummary
    ulp: DifferenceSummary
    notes: list[str]
    depth_metrics: DepthMetrics | None
    disparity_metrics: DisparityMetrics | None
    within_tolerance: bool

class MapComparison:
    channels: list[ChannelComparison]
    only_in_truth: list[str]
    only_in_other: list[str]
    notes: list[str]
    within_tolerance: bool

class CompareOptions:
    def __init__(
        self,
        channel: str,
        other_channel: str,
        tolerances: tuple[float, float, float],
        backgrounds: tuple[float | None, float | None],
        metrics: str,
    ) -> None: ...

def compare_maps(truth: Map, other: Map, options: CompareOptions) -> MapComparison: ...
def draw_differences(truth: Map, other: Map, options: CompareOptions, by: str) -> npt.NDArray[np.uint8]: ...
def draw_preview(
    map: Map, channel: str, colours: str | None, scale: str, low: float | None, high: float | None, unit: str
) -> npt.NDArray[np.uint8]: ...
def write_png(picture: npt.NDArray[np.uint8], file: str) -> None: ...
def encode_png(picture: npt.NDArray[np.uint8]) -> bytes: ...

class RenderOptions:
    def __init__(
        self, channels: list[str], cull: str, type: str, scale: float, engine: str, threads: int,
        normals: str
    ) -> None: ...

def render_one(
    scene: Scene, camera: Camera, options: RenderOptions, arrays: list[npt.NDArray[Any]]
) -> tuple[Map, list[str]]: ...
def render_stack(
    scene: Scene, cameras: list[Camera], options: RenderOptions, arrays: list[npt.NDArray[Any]]
) -> tuple[list[Map], list[str]]: ...
def require_bytes(what: str, bytes: float) -> None: ...
def array_in_small_pages(shape: tuple[int, ...], dtype: np.dtype[Any]) -> npt.NDArray[Any]: ...
def channels() -> dict[str, tuple[str, str]]: ...
def unknown_contents(name: str) -> str: ...
def unknown_ray_channel(name: str) -> str: ...
def probe(scene: Scene, camera: Camera, x: int, y: int, cull: str) -> list[tuple[Any, ...]]: ...
def hits_of_pixels(
    scene: Scene, camera: Camera, cull: str, threads: int
) -> tuple[npt.NDArray[np.uint64], npt.NDArray[np.uint32], Floats]: ...
def visible(
    scene: Scene, camera: Camera, cull: str, threads: int
) -> tuple[tuple[Floats, Floats, Floats], tuple[Floats, Floats, Floats]]: ...
class AreaQuestion: ...

def area_question(scene: Scene, by: str) -> AreaQuestion: ...
def area_items(
    question: AreaQuestion
) -> tuple[list[str], npt.NDArray[np.uint64], npt.NDArray[np.uint32] | None, npt.NDArray[np.uint32] | None]: ...
def light_areas(
    question: AreaQuestion, lights: Floats, are_points: bool, centroid: str, alone: bool, cull: str, threads: int
) -> tuple[Any, ...]: ...
def camera_areas(question: AreaQuestion, cameras: list[Camera], alone: bool, cull: str, threads: int) -> tuple[Any, ...]: ...
def background_area(question: AreaQuestion, camera: Camera, cull: str, threads: int) -> float: ...
def exact_light_area(
    question: AreaQuestion, light: Floats, are_points: bool, item: int, alone: bool, cull: str, threads: int
) -> tuple[tuple[int, int, int, int] | None, tuple[int, int, int, int] | None]: ...
def exact_camera_area(
    question: AreaQuestion, camera: Camera, item: int, alone: bool, cull: str, threads: int
) -> tuple[tuple[int, int, int, int] | None, tuple[int, int, int, int] | None]: ...
def draw(
    scene: Scene, camera: Camera, edges: str, crease_angle: float, stroke: float, cull: str, threads: int, as_pdf: bool
) -> bytes: ...
class Rays: ...

def prepare_rays(scene: Scene, threads: int) -> Rays: ...
def cast_rays(
    rays: Rays, origins: Floats, directions: Floats, t_min: float, t_max: float, open: bool, cull: str, threads: int
) -> tuple[npt.NDArray[np.uint32], Floats]: ...
def all_hits(
    rays: Rays, origins: Floats, directions: Floats, t_min: float, t_max: float, open: bool, cull: str, threads: int
) -> tuple[npt.NDArray[np.uint64], npt.NDArray[np.uint32], Floats]: ...
def occluded(
    rays: Rays, origins: Floats, directions: Floats, t_min: float, t_max: float, open: bool, cull: str, threads: int
) -> npt.NDArray[np.uint8]: ...
def count_hits(
    rays: Rays, origins: Floats, directions: Floats, t_min: float, t_max: float, open: bool, cull: str, threads: int
) -> npt.NDArray[np.uint32]: ...
def winding_numbers(rays: Rays, points: Floats, threads: int) -> npt.NDArray[np.int64]: ...
def hit_values32(
    rays: Rays, origins: Floats, directions: Floats, triangles: npt.NDArray[np.uint32], threads: int
) -> tuple[npt.NDArray[Any], ...]: ...
def hit_values64(
    rays: Rays, origins: Floats, directions: Floats, triangles: npt.NDArray[np.uint32], threads: int
) -> tuple[npt.NDArray[Any], ...]: ...
def sees(
    rays: Rays, eye_triangles: npt.NDArray[np.uint32], eyes: Floats, point_triangles: npt.NDArray[np.uint32],
    points: Floats, pairs: bool, edges: str, threads: int
) -> npt.NDArray[np.uint8]: ...
def seen_by(
    rays: Rays, triangles: npt.NDArray[np.uint32], points: Floats, cameras: list[Camera], cull: str, threads: int
) -> npt.NDArray[np.uint8]: ...
def read_rays(file: str) -> Floats: ...
def lidar_rays(sensor: str, poses: str | None, start: float | None, threads: int) -> tuple[Floats, int]: ...
def shutter_rays(camera: Camera, poses: str, readout: float, start: float | None, threads: int) -> Floats: ...
def origins_of(rays: Rays, triangles: npt.NDArray[np.uint32]) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32]]: ...

def evaluate(
    reconstruction: Scene,
    truth: Scene,
    cameras: list[Camera],
    within: list[float],
    points: int,
    density: float | None,
    truth_density: float | None,
    max_distance: float | None,
    keep_points: bool,
    cull: str,
    threads: int,
) -> tuple[tuple[Any, ...] | None, tuple[Any, ...], tuple[Any, ...], tuple[float, ...], float | None, str]: ...
def deep(scene: Scene, camera: Camera, cull: str, threads: int) -> tuple[dict[str, npt.NDArray[Any]], Map]: ...
def read_deep(file: str) -> tuple[dict[str, npt.NDArray[Any]], Map]: ...
def write_deep(
    description: Map,
    Z: npt.NDArray[np.float32],
    ZBack: npt.NDArray[np.float32],
    area: npt.NDArray[np.float32],
    A: npt.NDArray[np.float32],
    id: npt.NDArray[np.uint32],
    counts: npt.NDArray[np.uint32],
    file: str,
    compression: str,
    threads: int,
) -> None: ...
def cryptomatte(scene: Scene, camera: Camera, cull: str, threads: int) -> Map: ...
def verify(
    map: Map, scene: Scene, camera: Camera, options: RenderOptions, count: int
) -> tuple[int, int, tuple[int, int, str, str, str] | None]: ...

class DepthFormat:
    greatest: int
    def __init__(self, mapping: str, storage: str, near: float, far: float, c: float) -> None: ...
    def encode(self, depths: Floats, clamp: bool) -> Codes: ...
    def decode(self, stored: Codes) -> Floats: ...
    def values(self, stored: Codes) -> Floats: ...
    def to_nearer(self, depths: Floats) -> Floats: ...
    def to_farther(self, depths: Floats) -> Floats: ...
    def separation_behind(self, depths: Floats) -> Floats: ...
    def bin_width(self, depths: Floats) -> Floats: ...
    def codes_between(self, nearest: float, farthest: float) -> int: ...

class Estimate:
    name: str
    value: float
    deviation: float
    unit: str

class Finding:
    kind: str
    text: str
    pixels: int
    estimates: list[Estimate]
    alternatives: list[str]
    evidence: list[str]

def validate(map: Map, channel: str, scene: Scene, camera: Camera, model: str) -> dict[str, Any]: ...
def clip(subject: list[list[Any]], window: list[list[Any]], operation: str, by_cgal: bool) -> list[Any]: ...
