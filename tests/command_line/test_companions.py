"""The companions that fathom starts are listed in apps/companions.h: each is built, scripts/fathom builds it for its command, and
help and tests list it."""

import os
import pathlib
import re

import pytest
from fathom_help import answer

source = pathlib.Path(os.environ["FATHOM_SOURCE"])


def read(path: str) -> str:
    return (source / path).read_text(encoding="utf-8")


companions = re.findall(r'\{"([a-z]+)",\s*"(fathom-[a-z]+)",', read("apps/companions.h"))


def test_all_companions_are_found():
    assert len(companions) == len(dict(companions)) >= 7


@pytest.mark.parametrize("command, program", companions)
def test_program_is_built(command, program):
    assert re.search(rf"fathom_add_program\(fathom_\w+ {program}\b", read("apps/CMakeLists.txt"))


@pytest.mark.parametrize("command, program", companions)
def test_script_builds_the_program_for_the_command(command, program):
    branch = re.search(rf"^  [a-z| ]*\b{command}\b[a-z| ]*\)\n(.*?)^    ;;", read("scripts/fathom"), re.M | re.S)
    assert branch and f"programs+=(bin/{program})" in branch[1]


@pytest.mark.parametrize("command, program", companions)
def test_help_lists_the_command(command, program):
    assert re.search(rf"^  {command} ", answer("--help"), re.M)


def test_the_script_and_the_tests_know_no_other_companion():
    script = set(re.findall(r"programs\+=\(bin/(fathom-[a-z]+)\)", read("scripts/fathom")))
    assert script == {program for _, program in companions}
    tested = read("tests/apps/companion_test.cpp").partition("companion_commands{")[2].partition("}")[0]
    assert set(re.findall(r'"([a-z]+)"', tested)) == {command for command, _ in companions}
