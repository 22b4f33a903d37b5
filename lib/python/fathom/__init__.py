"""Fathom renders depth maps of triangle meshes in which every pixel is the exact depth, rounded once.

>>> import numpy as np, fathom
>>> vertices = np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 5)], float)
>>> K = np.array([[400, 0, 320], [0, 400, 240], [0, 0, 1]], float)
>>> maps = fathom.render(vertices, [(0, 1, 2)], K, np.eye(4), (640, 480), pixel_centre=0.5, channels=("Z", "id"))
>>> maps["Z"].shape, maps["Z"].dtype.name, int((maps["id"] != fathom.NO_SURFACE).sum())
((480, 640), 'float32', 18000)
"""

from . import compat, pipeline
from ._core import Error, InputError, OutputError, UsageError
from ._core import version as __version__
from ._warnings import ViewWarning
from .camera import Camera, read_cameras, write_cameras
from .clipping import clip
from .comparison import MapComparison, compare
from .deep import DeepMap, render_deep
from .depth_formats import DepthFormat
from .diagnosis import Diagnosis, doctor
from .evaluation import evaluate
from .lens import Lens
from .lit_areas import Areas, areas
from .maps import NO_SEGMENT, NO_SURFACE, Map, read_map
from .questions import draw, probe, verify, visible
from .rays import Rays
from .rendering import render
from .scanning import scan
from .scene import Scene
from .sight import SurfacePoints
from .validation import Validation, validate

__all__ = [
    "NO_SEGMENT",
    "NO_SURFACE",
    "Areas",
    "Camera",
    "DeepMap",
    "DepthFormat",
    "Diagnosis",
    "Error",
    "InputError",
    "Lens",
    "Map",
    "MapComparison",
    "OutputError",
    "Rays",
    "Scene",
    "SurfacePoints",
    "UsageError",
    "Validation",
    "ViewWarning",
    "__version__",
    "areas",
    "clip",
    "compare",
    "compat",
    "doctor",
    "draw",
    "evaluate",
    "pipeline",
    "probe",
    "read_cameras",
    "read_map",
    "render",
    "render_deep",
    "scan",
    "validate",
    "verify",
    "visible",
    "write_cameras",
]
