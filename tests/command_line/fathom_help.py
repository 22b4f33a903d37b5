"""What the built program says about itself, read from the text of its help alone."""

import functools
import os
import re
import subprocess
from dataclasses import dataclass, field

PROGRAM = os.environ["FATHOM_PROGRAM"]


def path_with_program() -> str:
    """PATH such that a shell finds the program."""
    return os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"]


def run(*arguments: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, **options)


def answer(*arguments: str) -> str:
    outcome = run(*arguments)
    assert outcome.returncode == 0 and outcome.stderr == "", (arguments, outcome.stderr)
    return outcome.stdout


@dataclass
class Help:
    """The sections of a help text: for each entry its names, the name of its value, and its meaning."""

    path: tuple[str, ...]  # ("camera", "orbit")
    text: str
    arguments: dict[str, str] = field(default_factory=dict)
    options: dict[tuple[str, ...], tuple[str, str]] = field(default_factory=dict)
    commands: dict[str, str] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return "-".join(("fathom", *self.path))

    def long_options(self) -> list[str]:
        return [name for names in self.options for name in names if name.startswith("--")]


def read_help(path: tuple[str, ...]) -> Help:
    text = answer(*path, "--help")
    found = Help(path, text)
    heading, entries = None, []
    for line in text.split("\n"):
        if line == "Examples:":
            break
        if line and not line.startswith(" ") and line.endswith(":"):
            heading = line[:-1]
        elif heading and re.match(r"  \S", line):
            name, *meaning = re.split(r"  +", line.strip(), maxsplit=1)
            entries.append([heading, name, meaning])
        elif heading and line.startswith("   "):
            entries[-1][2].append(line.strip())
    for heading, name, meaning in entries:
        meaning = " ".join(meaning)
        if heading == "Arguments":
            found.arguments[name] = meaning
        elif name.startswith("-"):
            names, _, value = name.partition(" ")
            found.options[tuple(names.split(","))] = (value, meaning)
        else:
            found.commands[name] = meaning
    return found


@functools.cache
def all_commands() -> list[Help]:
    """The program, its commands, those of its companions that are built, and those below them."""
    found = [read_help(())]
    for each in found:  # which grows
        for name in each.commands:
            path = (*each.path, name)
            if len(path) > 1 or run(*path, "--help").returncode == 0:
                found.append(read_help(path))
    return found
