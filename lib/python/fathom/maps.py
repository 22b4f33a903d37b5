"""Depth maps: their channels as arrays, their files, comparisons, conversions and point clouds."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from ._core import OutputError
from ._arguments import (
    as_array,
    as_count,
    as_number,
    as_text,
    as_threads,
    camera_handle,
    culls,
    in_pixels,
    one_of,
    point_frames,
    scene_handle,
)
from ._files import Path, make_folder_of, path_of
from ._shown import ColorMap, ColorScale, color_maps, color_scales, html_of, png_of, saved, share_of
from ._render import rendered
from .camera import Camera, cameras_from_json

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._arguments import HasScene as Scene
    from ._arguments import Numbers
    from ._shown import Picture
    from .names import Compression, Cull, Frame, NormalAxes

#: The value of id, face, object, material, group, part and label without a surface.
NO_SURFACE = _core.no_surface
#: The value of material, group, part and label if the visible triangle has no such name or label.
NO_SEGMENT = _core.no_segment
#: The channels that can have this value.
segment_channels = tuple(_core.segment_channels)

#: The channels with several parts, which are one array with a last axis: N is N.X, N.Y, N.Z in
#: files.
parts_of = {name: parts for name, (parts, _) in rendered.items() if parts}

quantities = tuple(_core.quantities)
normal_axes_names = tuple(_core.normal_axes)

#: Larger maps are described without ranges, which would take a second.
most_numbers_to_describe = 2**27


class Map(dict[str, "npt.NDArray[Any]"]):
    """The channels of a depth map: H×W arrays by name (H×W×3 for N, P, Nc and Ns, H×W×2 for bary),
    with the camera and the sources. In a stack, rendered with several cameras, the first axis of
    each array is the number of the camera; view(i) is the map of camera i.

    camera      the map's Camera; None if it is unknown, or for a stack
    cameras     all cameras of a stack; otherwise a list of the map's camera, if it is known
    metadata    the texts of its file: fathom.camera, fathom.sources with their SHA-256, …
    objects     the names of the objects that channel `object` numbers
    tables      the names behind numbers, by channel:
                {"object": {0: "spot"}, "material": {0: "steel", 1: "oak"}}
    scale       codes per scene unit, for uint16 codes
    background  value of depth channels without a surface

    Map({"Z": depths}, camera, background=0) makes a map from your own arrays, of the camera's size;
    add scale=1000 for uint16 codes. copy() and pickle keep everything. Channels are attributes, too: maps.Z is
    maps["Z"]. The names of contents are found as well: maps["depth"] and maps.depth are maps["Z"],
    and maps["mask"] is mask().

    >>> Map({"Z": np.array([[2, 2.5, np.inf]], np.float32)})
    Map(3×1 pixels; Z: float32, 2 to 2.5; surface in 66.67 %)
    """

    def __init__(
        self,
        channels: dict[str, npt.NDArray[Any]] | None = None,
        camera: Camera | None = None,
        _description: _core.Map | None = None,
        _views: list[tuple[Camera, _core.Map]] | None = None,
        *,
        scale: float | None = None,
        background: float | None = None,
    ) -> None:
        if channels is not None and not isinstance(channels, Mapping):
            raise TypeError(f"channels: expected a dict such as {{'Z': array}}, found {type(channels).__name__}")
        super().__init__(channels or {})
        if _description is None and _views is None:
            self._require_shapes(camera)
        self.camera = camera
        self._views = _views
        self._description = _core.Map() if _description is None else _description
        if scale is not None:
            self._description.png_scale = _positive("scale", scale)
        if background is not None:
            value = as_number("background", background)
            if value == -np.inf:
                raise ValueError("background: expected inf, nan or a number, found -inf")
            self._description.texts = {**self._description.texts, _core.background_text: repr(value)}

    def _require_shapes(self, camera: Camera | None) -> None:
        """Raises ValueError for a channel that is no image, or not of the camera's size."""
        if camera is not None:
            camera_handle(camera)
        for name, plane in _planes(self):
            _require_image(name, plane)
            if camera is not None and plane.shape != camera.size[::-1]:
                found = in_pixels(plane.shape[::-1])
                raise ValueError(f"channels: {name} has {found} pixels, but the camera has {in_pixels(camera.size)}; "
                                 "camera.scaled(size=…) is the same view in another size")

    def copy(self) -> Map:
        """A map with the same arrays, not copies of them."""
        views = None if self._views is None else [(camera, _same(each)) for camera, each in self._views]
        return Map(dict(self), self.camera, _same(self._description), views)

    __copy__ = copy

    def __missing__(self, name: str) -> npt.NDArray[Any]:
        """Under the names that channels= takes besides the channels' own."""
        if name == "mask":
            return self.mask()
        own = self._own_name(name)
        if own not in self:
            raise KeyError(self._without(name))
        return self[own]

    def _without(self, name: str) -> str:
        """What is said of a channel that is missing."""
        near = next((each for each in self if each.lower() == str(name).lower()), None)
        return f"the map has no channel {name!r}, only {', '.join(self)}" + (f"; did you mean {near!r}?" if near else "")

    def _own_name(self, name: str) -> str:
        """The map's own name of a channel: "Z" for "depth"."""
        return name if name in self or name == "mask" else str(_core.contents.get(name, name))

    def __reduce__(self) -> tuple[Any, ...]:
        views = None if self._views is None else [(camera, _state_of(each)) for camera, each in self._views]
        return _map_of_state, (dict(self), self.camera, _state_of(self._description), views)

    @classmethod
    def read(cls, file: Path) -> Map:
        """Reads EXR (also by other programs), NPZ, NPY, PFM, 16-bit PNG or a dense map of COLMAP
        (.bin). The format is detected from the content."""
        return cls._of(_core.read_map(path_of("file", file)))

    @classmethod
    def _of(cls, description: _core.Map) -> Map:
        planes = description.take_channels()
        return cls(_grouped(planes), camera_of(description), description)

    def write(
        self,
        file: Path,
        *,
        channel: str | None = None,
        scale: float | None = None,
        names: Mapping[str, str] | None = None,
        compression: Compression = "zip",
        threads: int = 0,
        normal_bits: int = 8,
        normal_axes: NormalAxes = "opencv",
    ) -> None:
        """Writes the map; the suffix of the file selects the format. Creates missing folders.

        .exr, .npz        all channels, with camera and metadata
        .npy, .pfm, .png  one channel: `channel`, or else Z or the only channel. .npy: also channels
                          with several parts; .png: depths as codes of uint16, identifiers, and
                          normals (N, Nc, Ns) as RGB
        .bin              a dense map of COLMAP: Z, or Nc if `channel` is Nc; 0 without a surface
        .tif              a GeoTIFF for other programs, a band per channel. The camera must be
                          orthographic and look straight along the world's z axis

        scale  codes of uint16 per scene unit for a .png of depths (default 1000), as by
               stored_as("uint16", scale=…)
        normal_bits, normal_axes  of a .png of normals: 8 or 16 bits a colour, each (n + 1)/2·(2^bits
               − 1), rounded once, ties to even; 0, 0, 0 without a surface. "opengl" negates y and z
               of Nc, which has OpenCV's axes (x right, y down, z forward)
        compression  of an EXR, lossless: none, rle, zips, zip or piz
        names  names of channels in an EXR: {"Z": "Y"} is for cv2.imread(), which only reads R, G, B
               and Y
        """
        if names is not None and not isinstance(names, Mapping):
            raise TypeError(f"names: expected a dict of names by the names of channels, found {names!r}")
        others = [(as_text("names", own), as_text("names", other)) for own, other in (names or {}).items()]
        asked = "" if channel is None else self._own_name(as_text("channel", channel))
        parts = [name for name, _ in _planes(self)] if asked else []
        if asked and asked not in self and asked not in parts:
            raise ValueError(f"channel: the map has no channel '{asked}', only {', '.join(self)}")
        compressed = as_text("compression", compression)
        handle = self._handle()
        name = os.fsdecode(path_of("file", file))
        suffix = os.path.splitext(name)[1].lower()
        if suffix in (".npy", ".pfm", ".png"):
            asked = asked or ("Z" if "Z" in self else "")
        if suffix == ".png" and scale is None and self._needs_codes(asked):
            scale = _core.png_scale
        if suffix == ".exr":
            self._require_narrow()
        if scale is not None:
            if suffix != ".png":
                raise ValueError("scale: only .png holds codes; stored_as('uint16', scale=…) makes them for other formats")
            handle = self._codes(name, asked, scale)._handle()
            asked = ""
        _core.require_map_name(path_of("file", file))
        make_folder_of(file)
        _core.write_map(handle, path_of("file", file), asked, compressed,
                        as_threads(threads), others, None if self.camera is None else camera_handle(self.camera),
                        as_count("normal_bits", normal_bits, 8, 16), one_of("normal_axes", normal_axes, normal_axes_names))

    def _codes(self, file: str, channel: str, scale: float) -> Map:
        """stored_as("uint16"), for a file that an error names."""
        try:
            return self.stored_as("uint16", channel=channel, scale=scale)
        except OutputError as error:
            raise OutputError(f"{file}: {error}") from None

    def _require_narrow(self) -> None:
        """Raises ValueError for numbers that an EXR does not hold."""
        wide = next((name for name, array in self.items() if np.asarray(array).dtype == np.float64), None)
        if wide is not None:
            raise ValueError(f"map: channel {wide}: an EXR does not hold float64 numbers; stored_as('float32', "
                             f"channel='{wide}') rounds them, and .npz keeps them")

    def _needs_codes(self, channel: str) -> bool:
        """Whether the channel, "" for the only one, holds depths that are no codes."""
        name = channel or next(iter(self))
        return name in (*quantities, "Zlow") and self._channel(name).dtype.kind == "f"

    def write_mask(self, file: Path, *, object: int | None = None) -> None:
        """Writes mask() as an 8-bit PNG, 255 where the map has a surface and else 0, with the camera
        and metadata. Creates missing folders.

        object  only where channel `object` has this number, as in `objects`
        """
        path = path_of("file", file)
        if not os.fsdecode(path).lower().endswith(".png"):
            raise ValueError("file: a mask is a PNG: expected a name that ends in .png")
        number = None if object is None else as_count("object", object, 0, NO_SURFACE - 1)
        handle = self._handle()
        make_folder_of(file)
        _core.write_mask(handle, path, number)

    @property
    def cameras(self) -> list[Camera]:
        if self._views is not None:
            return [camera for camera, _ in self._views]
        return [] if self.camera is None else [self.camera]

    def view(self, i: int) -> Map:
        """Map i of a stack, with its camera and metadata. Its arrays are views of the stack's
        arrays, not copies."""
        if self._views is None:
            raise ValueError("view: the map is no stack")
        camera, description = self._views[as_count("i", i, 0, len(self._views) - 1)]
        return Map({name: array[i] for name, array in self.items()}, camera, description)

    @property
    def metadata(self) -> dict[str, str]:
        return self._description.texts_of_file()

    @property
    def objects(self) -> list[str]:
        return list(self._description.object_names)

    @property
    def tables(self) -> dict[str, dict[int, str]]:
        """The names behind the numbers of a channel: tables["material"][n] is the name of material
        n. A visible triangle without a name is NO_SEGMENT in the channel. Labels are numbers
        without names."""
        named = {"object": self._description.object_names, **self._description.tables}
        return {channel: dict(enumerate(names)) for channel, names in named.items() if names}

    @property
    def background(self) -> float:
        """Value of depth channels without a surface; 0 for codes."""
        if self.scale is not None:
            return 0.0
        with _core.standard_arithmetic():  # Python reads decimals by binary64 arithmetic
            return float(self._description.texts.get(_core.background_text, "inf"))

    def _set_background(self, value: float) -> None:
        """Sets the background of a newly rendered map or stack, and records it in the metadata."""
        if self._views is not None:
            for i in range(len(self._views)):
                self.view(i)._set_background(value)
            self._description.texts = self._views[0][1].texts_of_file()
            return
        # Channels with several parts have no depths, and do not show where surfaces are.
        planes = [(name, array) for name, array in self.items() if array.ndim == 2]
        if planes:
            height, width = planes[0][1].shape
            self._description.texts = _core.set_background(self._description, height, width, planes, value)

    @property
    def scale(self) -> float | None:
        return self._description.png_scale

    def mask(self) -> npt.NDArray[np.bool_]:
        """H×W, True where the map has a surface: by id, face or object if the map has such a
        channel; otherwise where Z, distance or disparity is not the background; otherwise by
        material, group, part or label. ValueError without any of these channels."""
        for name in ("id", "face", "object"):
            if name in self:
                return np.asarray(self._channel(name) != NO_SURFACE)
        for name in quantities:
            if name in self:
                return self._shown(self._channel(name))
        for name in segment_channels:
            if name in self:
                return np.asarray(self._channel(name) != NO_SURFACE)
        raise ValueError("mask: the map has none of id, face, object, Z, distance and disparity")

    def _shown(self, depths: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
        if depths.dtype == np.uint16:
            return np.asarray(depths != 0)
        value = self.background
        if np.isinf(value):
            return np.asarray(np.isfinite(depths))
        with _core.standard_arithmetic():
            return np.asarray(~np.isnan(depths) if np.isnan(value) else depths != depths.dtype.type(value))

    def _channel(self, name: str) -> npt.NDArray[Any]:
        array = as_array(f"map: channel {name}", self[name])
        if array.dtype.kind not in "fiu":
            raise TypeError(f"map: channel {name}: expected numbers, found {array.dtype}")
        return array

    def _handle(self) -> _core.Map:
        if self._views is not None:
            raise ValueError(f"map: it is a stack of {len(self._views)} maps: take one by view(i)")
        planes = _planes(self)
        if not planes:
            raise ValueError("map: it has no channels")
        shape = planes[0][1].shape
        for name, plane in planes:
            _require_image(name, plane)
            if plane.shape != shape:
                raise ValueError(f"map: channels {planes[0][0]} and {name} differ in shape: {shape}, {plane.shape}")
        return self._description.with_channels(shape[0], shape[1], planes)

    def _camera(self, camera: Camera | None) -> Camera:
        chosen = camera or self.camera
        if chosen is None:
            raise ValueError("camera: the map carries none: give one")
        return chosen

    def to_distance(self, camera: Camera | None = None) -> Map:
        """Converts planar depths to ray distances, from the stored values in binary64, so they are
        rounded twice. Render channel `distance` for values that are rounded once."""
        return self._converted("distance", camera, None, 0)

    def to_depth(self, camera: Camera | None = None) -> Map:
        """Converts ray distances to planar depths, from the stored values in binary64."""
        return self._converted("Z", camera, None, 0)

    def to_disparity(
        self, baseline: float, *, doffs: float = 0, camera: Camera | None = None, background: float = 0
    ) -> Map:
        """Converts depths to disparities of a rectified stereo pair in pixels, |fx|·baseline/Z −
        doffs. The baseline is in scene units. `background` is the disparity without a surface: 0,
        or inf for Middlebury's "unknown"."""
        return self._converted("disparity", camera, as_number("baseline", baseline), as_number("doffs", doffs),
                               as_number("background", background))

    def _converted(self, to: str, camera: Camera | None, baseline: float | None, doffs: float,
                   background: float | None = None) -> Map:
        source = next((name for name in quantities if name in self), None)
        if source is None:
            raise ValueError("map: it has none of Z, distance and disparity")
        handle = camera_handle(self._camera(camera))
        return Map._of(_core.convert_quantity(self._handle(), source, to, handle, baseline, doffs, background))

    def stored_as(self, dtype: npt.DTypeLike, *, channel: str = "", scale: float | None = None) -> Map:
        """A map with only one depth channel, stored as float32, float64 or uint16 codes of
        round(scale · depth)."""
        try:
            name = one_of("dtype", np.dtype(dtype).name, _core.stored_types)
        except TypeError:
            raise TypeError(f"dtype: expected float32, float64 or uint16, found {dtype!r}") from None
        factor = None if scale is None else as_number("scale", scale)
        if factor is None and name == "uint16":
            raise ValueError("scale: uint16 needs codes per scene unit, for example scale=1000")
        return Map._of(_core.with_storage(self._handle(), as_text("channel", channel), name, factor))

    def points(self, camera: Camera | None = None, *, frame: Frame = "world") -> Numbers:
        """N×3 float64 points in scene units, row by row, one for each pixel with a surface at a
        finite depth. They are computed from Z (or distance) and the camera; in the world from
        channel P, if the map has it, whose values are exact, rounded once."""
        one_of("frame", frame, point_frames)
        # Positions in the world need no camera.
        needs_camera = frame == "camera" or "P" not in self
        view = self._camera(camera) if needs_camera else Camera(1, 1, 1, 1, 0, 0, pixel_centre=0.5)
        return _core.points(self._handle(), camera_handle(view), frame)

    def write_points(self, file: Path, camera: Camera | None = None, *, frame: Frame = "world",
                     dtype: npt.DTypeLike = "float64") -> None:
        """Writes the points as PLY, with normals and identifiers if the map has them.

        Of a stack, it writes one cloud of all views in the world, with the number of each point's view
        as `view`. A point that several views show is there several times."""
        path = path_of("file", file)
        if not os.fsdecode(path).lower().endswith(".ply"):
            raise ValueError(f"file: a point cloud is a PLY: expected a name that ends in .ply, found {path!r}")
        name = one_of("dtype", np.dtype(dtype).name, ("float32", "float64"))
        one_of("frame", frame, point_frames)
        if self._views is None:
            maps, cameras = [self], [self._camera(camera)]
        elif camera is not None or frame == "camera":
            raise ValueError("map: the views of a stack have their own cameras: write a cloud in the world, or view(i)'s")
        else:
            maps, cameras = [self.view(i) for i in range(len(self._views))], self.cameras
        handles = [each._handle() for each in maps]
        make_folder_of(file)
        _core.write_point_cloud(handles, [camera_handle(each) for each in cameras], path, frame, name == "float64",
                                self._views is not None)

    def add_cryptomatte(self, scene: Scene, camera: Camera | None = None, *, cull: Cull = "none", threads: int = 0) -> None:
        """Adds Cryptomatte's channels by object, CryptoObject00.R and so on, with exact coverage,
        each rounded once to float32, and the manifest to the metadata. Write the map as EXR for
        compositing programs."""
        if self._views is not None:
            raise ValueError("map: it is a stack: add Cryptomatte's channels to maps by view(i)")
        view = self._camera(camera)
        matte = _core.cryptomatte(scene_handle(scene), camera_handle(view), one_of("cull", cull, culls),
                                  as_threads(threads))
        self.update(matte.take_channels())
        self._description.texts = {**self._description.texts, **matte.texts}

    # Shown

    def preview(
        self,
        path: Path | None = None,
        *,
        channel: str = "",
        colormap: ColorMap | None = None,
        scale: ColorScale = "linear",
        range: tuple[float, float] | None = None,
        unit: str = "",
    ) -> Picture:
        """Draws a channel with a colour bar, like `fathom preview`: a uint8 array of H×W×3 (sRGB) for people to look at.
        Writes it as PNG if a path is given.

        channel   default: Z, or else the first channel; N, Nc and Ns are drawn as RGB
        colormap  "viridis" (default), "magma", "turbo", "grey" or "diverging" (default for Zerror)
        scale     how the colours spread over the range: "linear", "log", "inverse" or "equalised"
        range     (low, high), the ends of the colour bar (default: the least and greatest value)
        unit      written after the channel's name, such as "m"
        """
        low, high = (None, None) if range is None else _ends_of(range)
        colours = None if colormap is None else one_of("colormap", colormap, color_maps)
        return saved(_core.draw_preview(self._handle(), as_text("channel", channel), colours,
                                        one_of("scale", scale, color_scales), low, high, as_text("unit", unit)), path)

    def _repr_png_(self) -> bytes | None:
        first = self if self._views is None else self.view(0)
        return png_of(first.preview)

    def _repr_html_(self) -> str:
        rows = [("channel", "type", "values"), *((name, *self._in_words(name)) for name in self)]
        return html_of("; ".join(filter(None, (self._size_in_words(), self._share_in_words()))), rows, self._repr_png_())

    def __repr__(self) -> str:
        channels = [f"{name}: {', '.join(filter(None, self._in_words(name)))}" for name in self]
        return f"Map({'; '.join(filter(None, (self._size_in_words(), *channels, self._share_in_words())))})"

    def _size_in_words(self) -> str:
        shapes = [np.shape(array) for array in self.values()]
        if not shapes:
            return "without channels"
        stacked = self._views is not None
        rows = shapes[0][1 if stacked else 0:]
        if len(rows) < 2:
            return f"shape {shapes[0]}"
        size = f"{in_pixels((rows[1], rows[0]))} pixels"
        return f"{shapes[0][0]} views of {size}" if stacked else size

    def _in_words(self, name: str) -> tuple[str, str]:
        """The type of a channel, and the range of its values where the map has a surface."""
        array = np.asarray(self[name])
        kind = f"{array.dtype}" + (f"×{array.shape[-1]}" if name in parts_of and array.ndim > 2 else "")
        if array.dtype.kind not in "fiu" or array.size > most_numbers_to_describe:
            return kind, ""
        with _core.standard_arithmetic():  # NumPy compares, and Python writes decimals, by binary64 arithmetic
            if array.dtype == np.uint32:
                values = array[array < (NO_SEGMENT if name in segment_channels else NO_SURFACE)]
            elif name in quantities:
                values = array[self._shown(array) & np.isfinite(array)]
            else:
                values = array[np.isfinite(array)]
            if not values.size:
                return kind, "no surface"
            return kind, f"{values.min():.6g} to {values.max():.6g}"

    def _share_in_words(self) -> str:
        if sum(np.size(each) for each in self.values()) > most_numbers_to_describe:
            return ""
        try:
            mask = self.mask()
        except (TypeError, ValueError):
            return ""
        return f"surface in {share_of(int(mask.sum()), mask.size)}"

    # Channels as attributes

    if TYPE_CHECKING:
        Z: npt.NDArray[Any]
        Zlow: npt.NDArray[np.float32]
        A: npt.NDArray[np.float32]
        distance: npt.NDArray[Any]
        disparity: npt.NDArray[Any]
        id: npt.NDArray[np.uint32]
        face: npt.NDArray[np.uint32]
        object: npt.NDArray[np.uint32]
        material: npt.NDArray[np.uint32]
        group: npt.NDArray[np.uint32]
        part: npt.NDArray[np.uint32]
        label: npt.NDArray[np.uint32]
        N: npt.NDArray[np.float32]
        Nc: npt.NDArray[np.float32]
        Ns: npt.NDArray[np.float32]
        P: npt.NDArray[np.float32]
        bary: npt.NDArray[np.float32]
        valid: npt.NDArray[np.uint32]
        depth: npt.NDArray[Any]
        normal: npt.NDArray[np.float32]
        segmentation: npt.NDArray[np.uint32]
    else:

        def __getattr__(self, name):
            if name.startswith("_") and name not in self:
                raise AttributeError(name)
            own = self._own_name(name)
            if own not in self:
                raise AttributeError(self._without(name))
            return self[own]

        def __setattr__(self, name, value):
            if name in rendered or name == "disparity":
                raise AttributeError(f"{name}: set a channel by map[{name!r}] = …")
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self if name.isidentifier())]


_State = tuple[dict[str, str], list[str], dict[str, list[str]], Union[float, None]]


def _state_of(description: _core.Map) -> _State:
    """The contents of a description, as Python objects."""
    return description.texts_of_file(), description.object_names, description.tables, description.png_scale


def _description_of(state: _State) -> _core.Map:
    description = _core.Map()
    description.texts, description.object_names, description.tables, description.png_scale = state
    return description


def _same(description: _core.Map) -> _core.Map:
    return _description_of(_state_of(description))


def _map_of_state(
    channels: dict[str, npt.NDArray[Any]],
    camera: Camera | None,
    state: _State,
    views: list[tuple[Camera, _State]] | None,
) -> Map:
    """Called by pickle."""
    of_views = None if views is None else [(each, _description_of(of_view)) for each, of_view in views]
    return Map(channels, camera, _description_of(state), of_views)


def _ends_of(range: Any) -> tuple[float, float]:
    try:
        low, high = range
    except (TypeError, ValueError):
        raise TypeError(f"range: expected (low, high), found {range!r}") from None
    return as_number("range", low), as_number("range", high)


def _positive(name: str, value: object) -> float:
    number = as_number(name, value)
    if not 0 < number < np.inf:
        raise ValueError(f"{name}: expected a number above 0, found {number:g}")
    return number


def camera_of(description: _core.Map) -> Camera | None:
    """The camera that a map carries."""
    if description.camera is not None:
        return Camera._of(description.camera)
    text = description.texts.get(_core.camera_text)
    if text is None:
        return None
    cameras = cameras_from_json(text, _core.camera_text)
    return cameras[0] if len(cameras) == 1 else None


def _grouped(planes: dict[str, npt.NDArray[Any]]) -> dict[str, npt.NDArray[Any]]:
    """N.X, N.Y and N.Z become N, and so on; all others stay."""
    channels: dict[str, npt.NDArray[Any]] = {}
    for name, plane in planes.items():
        stem, _, _ = name.rpartition(".")
        names = [f"{stem}.{part}" for part in parts_of.get(stem, "")]
        if names and all(each in planes for each in names):
            if stem not in channels:
                channels[stem] = np.stack([planes[each] for each in names], axis=-1)
        else:
            channels[name] = plane
    return channels


def _native(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """In this machine's byte order; float16 as float32, which can represent all its numbers."""
    if array.dtype == np.float16:
        return array.astype(np.float32)
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _planes(channels: dict[str, npt.NDArray[Any]]) -> list[tuple[str, npt.NDArray[Any]]]:
    """The channels as in files: parts separately."""
    planes: list[tuple[str, npt.NDArray[Any]]] = []
    for name, value in channels.items():
        array = _native(as_array(f"map: channel {as_text('map: channels', name)}", value))
        parts = parts_of.get(name)
        if parts and array.ndim == 3 and array.shape[2] == len(parts):
            planes += [(f"{name}.{part}", np.ascontiguousarray(array[..., i])) for i, part in enumerate(parts)]
        else:
            planes.append((name, np.ascontiguousarray(array)))
    return planes


def _require_image(name: str, plane: npt.NDArray[Any]) -> None:
    if plane.ndim != 2 or plane.size == 0:
        raise ValueError(f"map: channel {name}: expected shape H×W, found {plane.shape}")


def read_map(file: Path) -> Map:
    """Reads a map: the same as Map.read()."""
    return Map.read(file)


def as_map(name: str, value: object) -> Map:
    """A Map from a Map, the name of its file, a dict of arrays, or a single array, which is taken as Z."""
    if isinstance(value, Map):
        return value
    if isinstance(value, (str, os.PathLike)):
        return read_map(path_of(name, value))
    if isinstance(value, dict):
        return Map(value)
    array = as_array(name, value)
    if array.ndim != 2:
        raise ValueError(f"{name}: expected an H×W array, a Map or the name of its file, found shape {array.shape}")
    return Map({"Z": array})
