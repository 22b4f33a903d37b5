"""The names that arguments take, as types: editors complete them, and type checkers refuse all others.

The C++ library has the tables of the same names; a test compares them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Union

Channel = Literal["Z", "A", "Zlow", "distance", "id", "face", "object", "material", "group", "part", "label", "N", "P",
                  "bary", "Nc", "Ns", "valid", "depth", "normal", "camera-normal", "segmentation", "mask"]
#: Names, or a single string of names with commas between them.
Channels = Union[Sequence[Channel], str]
#: Of rays.
RayChannel = Literal["t", "id", "distance", "P", "bary", "N", "object", "face"]
RayChannels = Union[Sequence[RayChannel], str]
RayMode = Literal["nearest", "all"]
#: Of sight: whether all points of edges hide what is behind them.
EdgeRule = Literal["closed", "generic"]
#: What areas() measures, and what weighs centroids.
AreaItem = Literal["object", "face", "triangle", "material", "group", "part", "label"]
AreaCentroid = Literal["across", "lit"]
Cull = Literal["none", "back", "front"]
EdgeSelection = Literal["silhouettes", "creases", "all"]
Engine = Literal["fast", "reference"]
Normals = Literal["file", "vertex", "place"]
Background = Union[float, Literal["inf", "nan"]]
Compression = Literal["none", "rle", "zips", "zip", "piz"]
#: The compressions of deep maps.
DeepCompression = Literal["none", "rle", "zips"]
Frame = Literal["world", "camera"]
#: Of normals in the camera's frame, in a PNG.
NormalAxes = Literal["opencv", "opengl"]
Mapping = Literal["standard", "reversed", "infinite", "reversed-infinite", "opengl", "linear", "w", "log", "log-ulrich"]
Storage = Literal["unorm16", "unorm24", "unorm32", "float16", "float32", "float64"]
#: The arithmetic of renderers, as docs/validation.md describes it; "auto": the model that fits best.
Model = Literal["auto", "gl-unorm16", "gl-unorm24", "gl-unorm32", "gl-float32", "gl-float32-reversed", "vtk-unorm16",
                "vtk-unorm24", "vtk-unorm32", "vtk-float32", "vtk-float32-reversed", "float32-ray", "cycles"]
