"""Warnings, which name the line of a user's program that calls this package."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable
from types import FrameType


class ViewWarning(UserWarning):
    """A suspicious view: the camera probably does not see the scene as intended.

    `warnings.simplefilter("error", fathom.ViewWarning)` makes it an exception; "ignore" silences
    it.
    """


def warn(notes: Iterable[str], category: type[Warning] = ViewWarning) -> None:
    """Gives a warning for each note, at the innermost line outside this package."""
    level = 1
    frame: FrameType | None = sys._getframe()
    while frame is not None and _is_ours(frame):
        frame, level = frame.f_back, level + 1
    for note in notes:
        warnings.warn(note, category, stacklevel=level)


def _is_ours(frame: FrameType) -> bool:
    return str(frame.f_globals.get("__name__")).partition(".")[0] == __package__
