"""Names of files, and missing folders of output files."""

from __future__ import annotations

import os
from typing import Union

from ._core import OutputError

Path = Union[str, "os.PathLike[str]"]


def path_of(name: str, path: Path) -> str:
    """The path in the form that the library takes; `name` is the argument. ValueError if no file can have this name: only
    lone surrogates that stand for bytes (os.fsdecode) are allowed."""
    try:
        given = os.fspath(path)
    except TypeError:
        raise TypeError(f"{name}: expected the name of a file or folder, found {path!r}") from None
    try:
        if b"\0" not in os.fsencode(given):
            return given
    except UnicodeEncodeError:
        pass
    raise ValueError(f"{name}: expected a name that a file can have, without NUL and surrogates, found {given!r}")


def make_folder(folder: Path) -> None:
    """Creates a folder and its parents if they are missing."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{os.fspath(folder)}: the folder cannot be made: {error.strerror}") from None


def make_folder_of(file: Path) -> None:
    """Creates the folder of an output file, as the program does."""
    folder = os.path.dirname(os.fspath(file))
    if folder:
        make_folder(folder)
