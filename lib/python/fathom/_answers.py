"""Answers of the textbook commands, as Python types."""

from __future__ import annotations

import json
import numbers
import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from . import _core
from ._core import InputError, UsageError


class Answer(dict[str, Any]):
    """The answer of a command, with a picture of its steps, which a notebook shows below the cell.

    svg  the picture as SVG; empty without `draw=True`
    """

    svg: str = ""

    def _repr_svg_(self) -> str | None:
        return self.svg or None

    def save(self, path: str) -> None:
        """Writes the picture to a file.

        Raises ValueError without a picture."""
        if not self.svg:
            raise ValueError("save: this answer has no picture; ask for it with draw=True")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.svg)


# Patterns are compiled when they are used first: importing stays quick.
_fraction = r"-?\d+(/\d+)?"


def answer_of(text: str, svg: str = "") -> Answer:
    """Parses an answer. Numbers written as "p/q" become Fractions; names remain strings."""
    with _core.standard_arithmetic():  # Python reads decimals by binary64 arithmetic, and writes them
        answer = Answer(_exact(json.loads(text)))
    answer.svg = svg
    return answer


def _exact(value: Any, key: str = "") -> Any:
    if isinstance(value, str) and key != "name" and re.fullmatch(_fraction, value):
        return Fraction(value)
    if isinstance(value, list):
        return [_exact(each) for each in value]
    if isinstance(value, dict):
        return {name: _exact(each, name) for name, each in value.items()}
    return value


def case_of(case: Mapping[str, Any]) -> str:
    """A case as a line of JSON. Numbers are exact and must be representable in binary64.

    Raises ValueError, which names the key, for any other number; TypeError for other types."""
    with _core.standard_arithmetic():
        return json.dumps({name: _plain(name, value) for name, value in case.items()}, allow_nan=False)


def _plain(name: str, value: Any) -> Any:
    if value is None or isinstance(value, (bool, str)):
        return value
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        return _plain(name, value.tolist())
    if isinstance(value, Mapping):
        return {key: _plain(name, each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(name, each) for each in value]
    if isinstance(value, numbers.Real):
        return _binary64(name, value)
    raise TypeError(f"{name}: expected numbers, texts and lists of them, found {value!r}")


def _binary64(name: str, value: Any) -> int | float:
    if isinstance(value, numbers.Integral):
        whole = int(value)
        if abs(whole) <= 2**53 or int(float(whole)) == whole:
            return whole
    else:
        number = float(value)
        if number - number == 0 and Fraction(number) == Fraction(value):
            return number
    raise ValueError(f"{name}: {value} is not a number of binary64; round it with float()")


_option = r"--([a-z][a-z-]*)"


def as_arguments(error: Exception) -> Exception:
    """The same error with the options of the command as arguments of Python."""
    text = re.sub(r"; see '[^']*--help'$", "", str(error))
    text = re.sub(_option, lambda match: match.group(1).replace("-", "_"), text)
    return (UsageError if isinstance(error, UsageError) else InputError)(text)
