"""Names of files, and the folders that they are written to."""

from __future__ import annotations

import os
from typing import Union

from ._core import OutputError

Path = Union[str, "os.PathLike[str]"]


def make_folder(folder: Path) -> None:
    """Makes a folder, and those above it, where they are missing."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{os.fspath(folder)}: the folder cannot be made: {error.strerror}") from None


def make_folder_of(file: Path) -> None:
    """Makes the folder in which a file is about to be written, as the program does."""
    folder = os.path.dirname(os.fspath(file))
    if folder:
        make_folder(folder)
