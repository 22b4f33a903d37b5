"""Names of files, and the folders that they are written to."""

from __future__ import annotations

import os
from typing import Union

from ._core import OutputError

Path = Union[str, "os.PathLike[str]"]


def path_of(name: str, path: Path) -> str:
    """The path as the library takes it; `name` is the argument. ValueError where no file can have this name: of the
    lone surrogates, only those that stand for bytes (os.fsdecode) can be in one."""
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
