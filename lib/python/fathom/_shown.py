"""How results are shown: pictures, tables for notebooks, reprs without long arrays."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Callable, Literal, NamedTuple, Union

from . import _core
from ._core import Error
from ._files import Path, make_folder_of, path_of

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    #: height×width×3, sRGB
    Picture = npt.NDArray[np.uint8]

# A wheel brings the font of pictures along.
_font = os.path.join(os.path.dirname(__file__), "DejaVuSans.ttf")
if os.path.exists(_font):
    os.environ.setdefault("FATHOM_FONT", _font)

ColorMap = Literal["viridis", "magma", "turbo", "grey", "diverging"]
color_maps = tuple(_core.color_maps)
ColorScale = Literal["linear", "log", "inverse", "equalised"]
color_scales = tuple(_core.color_scales)


def saved(picture: Picture, path: Path | None) -> Picture:
    """The same picture, after it was written to `path` as PNG, if a path is given."""
    if path is not None:
        name = path_of("path", path)
        if not os.fsdecode(name).lower().endswith(".png"):
            raise ValueError(f"path: expected a name that ends in .png, found {os.fsdecode(name)!r}")
        make_folder_of(path)
        _core.write_png(picture, name)
    return picture


def png_of(draw: Callable[[], Picture]) -> bytes | None:
    """The PNG of a picture, for a notebook; None if there is nothing to draw, so that the notebook shows the text."""
    try:
        return _core.encode_png(draw())
    except (Error, ValueError):
        return None


def share_of(part: int, whole: int) -> str:
    """A fraction in percent. A part that is neither nothing nor all is shown neither as 0 nor as 100."""
    with _core.standard_arithmetic():  # Python writes decimals by binary64 arithmetic
        if part in (0, whole) or whole == 0:
            return "100 %" if part and part == whole else "0 %"
        return f"{min(max(100 * part / whole, 0.01), 99.99):.4g} %"


def repr_without_arrays(result: NamedTuple) -> str:
    """The fields as in a call; of arrays only type and shape."""
    with _core.standard_arithmetic():
        fields = ((name, f"<{value.dtype} {value.shape}>" if hasattr(value, "dtype") and value.shape else repr(value))
                  for name, value in result._asdict().items())
        return f"{type(result).__name__}({', '.join(f'{name}={text}' for name, text in fields)})"


Cell = Union[str, float, int]


def html_of(title: str, rows: Iterable[Sequence[Cell]], png: bytes | None = None, extra: str = "") -> str:
    """A title, a table whose first row is its head, and a picture."""
    import base64
    import html

    with _core.standard_arithmetic():
        cells = [[html.escape(each if isinstance(each, str) else f"{each:.6g}") for each in row] for row in rows]
    lines = [f"<div><strong>{html.escape(title)}</strong>"]
    if cells:
        head, *body = ("".join(f"<{tag}>{each}</{tag}>" for each in row)
                       for tag, row in zip(["th"] + ["td"] * len(cells), cells))
        lines.append(f"<table><thead><tr>{head}</tr></thead><tbody>")
        lines += [f"<tr>{row}</tr>" for row in body]
        lines.append("</tbody></table>")
    if png is not None:
        data = base64.b64encode(png).decode("ascii")
        lines.append(f'<img alt="{html.escape(title)}" src="data:image/png;base64,{data}">')
    return "\n".join([*lines, *([extra] if extra else []), "</div>"])
