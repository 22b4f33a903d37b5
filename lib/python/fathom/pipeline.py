"""The graphics pipeline of the textbooks: render pictures, follow a primitive through all stages, run single stages.
Its results are rounded, not exact; docs/pipeline.md describes each stage."""

from __future__ import annotations

import json
import numbers
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

from . import _core
from ._answers import Answer, answer_of, as_arguments, case_of
from ._arguments import as_count, as_number, camera_handle, one_of, scene_handle
from ._core import InputError, UsageError
from ._shown import png_of, repr_without_arrays
from ._warnings import warn
from .camera import Camera
from .maps import Map

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from .scene import Scene

    #: The value of an option: a word of the command line, a number, a list of numbers, or True for a flag.
    Option = Union[str, float, bool, Sequence[float]]

Precision = Literal["binary32", "binary64"]


class Picture(NamedTuple):
    """The result of render().

    map         channels Z (float32, planar depth in scene units) and id (uint32), as the pipeline computed them; its
                camera has the near and far of the clipping, so that an exact map can be rendered with it
    picture     uint8, height×width×3, sRGB as in a PNG
    statistics  the figures of `fathom render --engine pipeline --stats`: counts of triangles, fragments, …
    """

    map: Map
    picture: npt.NDArray[np.uint8]
    statistics: dict[str, Any]

    def _repr_png_(self) -> bytes | None:
        return png_of(lambda: self.picture)

    def __repr__(self) -> str:
        return repr_without_arrays(self)


def render(scene: Scene, camera: Camera, **options: Option) -> Picture:
    """Renders a picture like a graphics pipeline.

    scene    lines and points of its files are also drawn
    camera   without near and far, the pipeline clips with values that contain the scene
    options  the options of `fathom render --engine pipeline`, with _ instead of -: shading="phong", antialias="msaa:4",
             light=(1, 1, 2), viewport=(0, 0, 320, 240), scan="scan-line", hidden_surface="painter", blend=True,
             depth_format="unorm24", mapping="opengl", precision="binary64", cull="back", background=(1, 1, 1), …

    Rounded  every value, in the precision of the options; nothing is exact.
    Raises   UsageError for unknown options or options that exclude each other, InputError for a scene, a camera or a
             texture that cannot be used. Warns (ViewWarning) if the viewport stretches the picture.

    >>> import numpy as np, fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh(np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float), [(0, 1, 2)])
    >>> camera = Camera.from_opencv([[8, 0, 4], [0, 8, 4], [0, 0, 1]], np.eye(4), (8, 8), pixel_centre=0.5)
    >>> shaded = render(scene, camera, shading="none", antialias="msaa:4")
    >>> shaded.picture.shape, int((shaded.map["id"] == 0).sum())
    ((8, 8, 3), 8)
    """
    from . import _textbook

    try:
        z, identifiers, picture, used, statistics, stretched = _textbook.render(
            scene_handle(scene), camera_handle(camera), _words(options)
        )
    except (InputError, UsageError) as error:
        raise as_arguments(error) from None
    _warn(stretched)
    with _core.standard_arithmetic():  # Python reads decimals by binary64 arithmetic
        counts = json.loads(statistics)
    counts.pop("map", None)
    return Picture(Map({"Z": z, "id": identifiers}, Camera._of(used)), picture, counts)


def trace(
    scene: Scene,
    camera: Camera,
    number: int = 0,
    *,
    pixel: Sequence[int] | None = None,
    fragments: bool = False,
    draw: bool = False,
    **options: Option,
) -> Answer:
    """Follows a triangle, a line or a point through the stages, with the input and output of each.

    number     number in the scene, as in channel id: triangles first, then the lines and points of each object
    pixel      (x, y): adds the sample at the pixel's centre ("sample") and the output merger's steps there, for every
               fragment of the whole scene ("output_merger": the pixel's previous contents, the tests, the result)
    fragments  list all fragments ("fragment_list")
    draw       draw the steps: answer.svg, which a notebook shows
    options    as for render(); with hidden_surface="painter" also the order and its splits ("painter")

    Returns  a dict, as printed by `fathom pipeline trace --json`; numbers are floats.
    Raises   UsageError for a primitive that does not exist; otherwise as render().

    >>> import numpy as np, fathom
    >>> scene = fathom.Scene()
    >>> _ = scene.add_mesh(np.array([(-1, -1, 4), (1, -1, 4), (0, 1, 4)], float), [(0, 1, 2)])
    >>> camera = Camera.from_opencv([[8, 0, 4], [0, 8, 4], [0, 0, 1]], np.eye(4), (8, 8), pixel_centre=0.5)
    >>> followed = trace(scene, camera, pixel=(4, 4))
    >>> followed["clipping"][0]["window"][:2], [step["tests"]["outcome"] for step in followed["output_merger"]]
    ([2.0, 2.0], ['passed'])
    """
    from . import _textbook

    handle = camera_handle(camera)
    place = None
    if pixel is not None:
        x, y = pixel
        place = as_count("pixel: x", x, 0, camera.width - 1), as_count("pixel: y", y, 0, camera.height - 1)
    try:
        answer, svg, stretched = _textbook.trace(
            scene_handle(scene), handle, as_count("number", number, 0, 2**32 - 2), place, bool(fragments),
            _words(options), bool(draw)
        )  # fmt: skip
    except (InputError, UsageError) as error:
        raise as_arguments(error) from None
    _warn(stretched)
    return answer_of(answer, svg)


def stages() -> dict[str, tuple[str, str]]:
    """The stages of run(), in the order of the data: the keys that each stage takes, and the keys that it adds.

    >>> list(stages())[:4]
    ['primitive-assembly', 'vertex-transform', 'clipping', 'perspective-division']
    """
    from . import _textbook

    return {name: (takes, adds) for name, takes, adds in _textbook.stages()}


def run(stage: str, record: Mapping[str, Any], *, precision: Precision = "binary32") -> Answer:
    """Runs a single stage, like `fathom pipeline run STAGE`.

    stage      one of stages()
    record     a dict with the stage's inputs; docs/pipeline.md lists every key
    precision  precision to which the stage rounds: binary32 or binary64

    Returns  the record with the stage's results added, as input for the next stage.
    Raises   InputError for a record that lacks a key or cannot be used.

    >>> record = run("perspective-division", {"clip": [(3, 1, 2, 8)]})
    >>> record["ndc"]
    [[0.375, 0.125, 0.25]]
    >>> run("viewport", {**record, "width": 16, "height": 16})["window"]
    [[11.0, 7.0, 0.25]]
    """
    from . import _textbook

    one_of("stage", stage, stages())
    one_of("precision", precision, ("binary32", "binary64"))
    try:
        return answer_of(_textbook.run_stage(stage, case_of(record), precision == "binary64"))
    except (InputError, UsageError) as error:
        raise as_arguments(error) from None


def _words(options: Mapping[str, Option]) -> list[str]:
    """Options as words of a command line."""
    words: list[str] = []
    for name, value in options.items():
        if name in ("help", "quiet", "version", "max_memory") or not name.isidentifier():
            raise TypeError(f"{name}: there is no such option")
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not False:
            words.append(f"{option}={_word(name, value)}")
    return words


def _word(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if hasattr(value, "__len__"):
        return ",".join(_word(name, each) for each in value)
    with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
        return repr(as_number(name, value))


def _warn(stretched: bool) -> None:
    if stretched:
        warn(["viewport: its width : height is not the camera's: the picture is stretched"])
