"""Commands of pages in blocks of `sh`, which need files of the reader, hours or other machines: the program has each command
and each option, and the repository each script. Blocks with "$ " and blocks of Python run (tests/python/test_pages.py)."""

import os
import pathlib
import re
import shlex
import subprocess

import pytest
from fathom_help import PROGRAM, all_commands

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
SHELL_BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.S | re.M)
pages = [page for page in (source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").rglob("*.md")))
         if SHELL_BLOCK.search(page.read_text(encoding="utf-8"))]
options = {each.path: {name for names in each.options for name in names} for each in all_commands()}
parallel = pathlib.Path(PROGRAM).with_name("fathom-mpi")
if parallel.exists():
    told = subprocess.run([parallel, "render", "--help"], check=True, capture_output=True, text=True).stdout
    options["fathom-mpi", "render"] = set(re.findall(r"(?<=[ ,])--?[a-z][\w-]*", told))


def commands_in(text: str) -> list[list[str]]:
    """The words of each command of each block; a pipe and a "<(" begin another command."""
    found = []
    for block in SHELL_BLOCK.findall(text):
        for line in block.replace("\\\n", " ").replace("|\n", "| ").splitlines():
            for command in re.split(r" \| | && |<\(", line):
                found.append(shlex.split(command.rstrip(")"), comments=True))
    return [words for words in found if words]


def fault_of(words: list[str]) -> str:
    """Why a command cannot work, or nothing."""
    for script in (word for word in words if re.match(r"(scripts|\.ci|tests|validation)/", word)):
        if not (source / script).exists():
            return f"there is no {script}"
    program = next((i for i, word in enumerate(words) if pathlib.PurePath(word).name in ("fathom", "fathom-mpi")), None)
    if program is None or words[program].startswith("bin/") or words[0].startswith("scripts/dev/"):
        return ""  # a target of a build, or a program that is measured
    path = ("fathom-mpi",) if words[program].endswith("fathom-mpi") else ()
    if path and not parallel.exists():
        return ""
    for word in words[program + 1:]:
        if (*path, word) not in options:
            break
        path = (*path, word)
    if path not in options or not path:
        return f"{' '.join(words)}: there is no such command"
    unknown = [word for word in words[program + 1:] if re.match(r"--?[a-z]", word) and word.partition("=")[0] not in options[path]]
    return f"{' '.join(path)} has no option {' '.join(unknown)}" if unknown else ""


@pytest.mark.parametrize("page", pages, ids=lambda page: str(page.relative_to(source)))
def test_commands_of_pages_exist(page):
    found = commands_in(page.read_text(encoding="utf-8"))
    assert found
    assert [fault for fault in map(fault_of, found) if fault] == []


@pytest.mark.parametrize("line", ["fathom rendre a.obj", "scripts/fathom render a.obj --nera 1", "mpirun -n 2 fathom-mpi render --fov2 3",
                                  "scripts/fathoms render a.obj", "echo x | fathom scan --algorithmus dda"])
def test_a_command_that_does_not_exist_is_noticed(line):
    assert any(map(fault_of, commands_in(f"```sh\n{line}\n```\n")))
