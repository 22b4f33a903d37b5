"""Comparing two maps of one view, channel by channel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Union

from . import _core
from ._arguments import as_number, as_text, one_of
from ._shown import html_of, png_of, saved, share_of
from .maps import Map, as_map

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._files import Path
    from ._shown import Picture

Measure = Literal["absolute", "relative", "ulp"]
Metrics = Union[bool, Literal["none", "channel", "disparity"]]


class MapComparison:
    """The result of compare(). A notebook shows its figures and its picture.

    channels          a ChannelComparison for each channel that both maps have
    only_in_truth, only_in_other  names of channels that only one map has
    within_tolerance  whether all channels agree
    notes             remarks, a line each: a guessed background, …
    """

    def __init__(self, found: _core.MapComparison, truth: Map, other: Map, options: _core.CompareOptions) -> None:
        self.channels: list[_core.ChannelComparison] = found.channels
        self.only_in_truth: list[str] = found.only_in_truth
        self.only_in_other: list[str] = found.only_in_other
        self.notes: list[str] = found.notes
        self.within_tolerance: bool = found.within_tolerance
        self._maps = truth, other
        self._options = options

    def preview(self, path: Path | None = None, *, by: Measure = "absolute") -> Picture:
        """Draws the differences of a channel, with a legend: Z, or else the first channel; the channel that compare() was
        called with, if any. Equal pixels are dark, others are coloured by the logarithm of their difference. Returns a
        uint8 array of H×W×3 (sRGB), and writes it as PNG if a path is given.

        by  the difference: "absolute", in the unit of the channel, "relative" or "ulp"
        """
        one_of("by", by, ("absolute", "relative", "ulp"))
        truth, other = self._maps
        return saved(_core.draw_differences(truth._handle(), other._handle(), self._options, by), path)

    def _repr_png_(self) -> bytes | None:
        return png_of(self.preview)

    def _repr_html_(self) -> str:
        rows: list[tuple[str | float, ...]] = [
            ("channel", "bit-equal", "beyond tolerance", "only in truth", "only in other", "max |Δ|", "mean |Δ|",
             "max relative", "max ulp")]
        rows += [(each.truth_channel, share_of(each.bit_equal, each.both), each.beyond_tolerance, each.only_truth,
                  each.only_other, each.absolute.max, each.absolute.mean, each.relative.max, each.ulp.max)
                 for each in self.channels]
        return html_of(self._verdict(), rows, self._repr_png_())

    def _verdict(self) -> str:
        return f"the maps {'agree' if self.within_tolerance else 'differ'}"

    def __repr__(self) -> str:
        return f"MapComparison({self._verdict()}, {self.channels!r})"


def compare(
    truth: Map | npt.ArrayLike | Path,
    other: Map | npt.ArrayLike | Path,
    *,
    channel: str = "",
    other_channel: str = "",
    tolerance_ulp: float = 0,
    tolerance_absolute: float = 0,
    tolerance_relative: float = 0,
    metrics: Metrics = False,
    truth_background: float | None = None,
    other_background: float | None = None,
) -> MapComparison:
    """Compares two maps of the same view, channel by channel: pixels that show a surface in only
    one map, and the absolute, relative and ulp differences of the other pixels. An array is taken
    as Z; a map may be the name of its file.

    tolerance_ulp, tolerance_absolute, tolerance_relative  two numbers agree if one of the three
             tolerances allows it
    metrics  True: depth channels get depth_metrics (abs_rel, sq_rel, rmse, rmse_log, mae, delta_1
             to delta_3), disparity channels disparity_metrics (epe, rmse, bad_0_5, bad_1, bad_2);
             "disparity": all channels are disparities
    truth_background, other_background  value of "no surface" (default: the value that the map
             records; otherwise it is detected, with a note)

    >>> import numpy as np
    >>> truth = np.array([[1, 2], [3, np.inf]], np.float32)
    >>> found = compare(truth, np.array([[1, 2], [3.5, np.inf]], np.float32))
    >>> found.within_tolerance, found.channels[0].bit_equal, found.channels[0].absolute.max
    (False, 2, 0.5)
    """

    def value(name: str, background: float | None) -> float | None:
        return None if background is None else as_number(name, background)

    if isinstance(metrics, bool):
        metrics = "channel" if metrics else "none"
    maps = as_map("truth", truth), as_map("other", other)
    options = _core.CompareOptions(
        as_text("channel", channel),
        as_text("other_channel", other_channel),
        (
            as_number("tolerance_ulp", tolerance_ulp),
            as_number("tolerance_absolute", tolerance_absolute),
            as_number("tolerance_relative", tolerance_relative),
        ),
        (value("truth_background", truth_background), value("other_background", other_background)),
        one_of("metrics", metrics, ("none", "channel", "disparity")),
    )
    return MapComparison(_core.compare_maps(maps[0]._handle(), maps[1]._handle(), options), *maps, options)
