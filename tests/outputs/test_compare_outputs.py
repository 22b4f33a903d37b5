"""scripts/dev/compare-outputs itself, with a stand-in for fathom: changes and features without a case are found."""

import importlib.machinery
import importlib.util
import os
import pathlib
import sys

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]

FATHOM = """#!/bin/sh
case "$*" in
  --help) printf 'x\\n\\nCommands:\\n  draw  Draw\\n\\nExamples:\\n  fathom draw\\n' ;;
  'draw --help=completion')
    printf 'command\\tfathom draw\\tDraw\\n'
    printf 'option\\t-o --output\\tfalse\\ttrue\\t\\tfalse\\tall\\tA .png or .svg\\n'
    printf 'option\\t--colour\\tfalse\\ttrue\\tred blue\\tfalse\\tnone\\tThe colour\\n' ;;
  *) echo "$FATHOM_VERSION_IN_OUTPUTS $TZ" > a.png; echo '{"seconds": {"all": 1.25}} VALUE' ;;
esac
"""
NEW_OPTION = "--new\\tfalse\\tfalse\\t\\tfalse\\tnone\\tNew"
CASES = """
[draw]
BLUE = --colour {blue}
draw -o {a.png|a.svg} --colour red
"""


@pytest.fixture
def script(tmp_path, monkeypatch):
    """The script as a module, with cases of its own and a program in tmp_path/bin."""
    loader = importlib.machinery.SourceFileLoader("compare_outputs", str(SOURCE / "scripts/dev/compare-outputs"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("compare_outputs", loader))
    monkeypatch.setitem(sys.modules, "compare_outputs", module)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    loader.exec_module(module)
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    monkeypatch.setattr(module, "EXPECTED", tmp_path / "expected")
    (tmp_path / "words").write_text("")
    (tmp_path / "draw.cases").write_text(CASES)
    write_program(tmp_path, FATHOM)
    return module


def write_program(folder, text, name="bin"):
    (folder / name).mkdir(exist_ok=True)
    (folder / name / "fathom").write_text(text)
    os.chmod(folder / name / "fathom", 0o755)


def answer(script, monkeypatch, capsys, *arguments):
    monkeypatch.setattr(sys, "argv", ["compare-outputs", *map(str, arguments)])
    status = script.main()
    return status, capsys.readouterr().out


def test_a_changed_output_is_found(script, tmp_path, monkeypatch, capsys):
    here = ("--programs", tmp_path / "bin")
    answer(script, monkeypatch, capsys, "--update", *here)
    status, out = answer(script, monkeypatch, capsys, "--check", *here)
    assert "CHANGED" not in out and "DOUBTFUL" not in out
    write_program(tmp_path, FATHOM.replace("1.25", "99"))  # a time
    assert answer(script, monkeypatch, capsys, "--check", *here) == (status, out)
    write_program(tmp_path, FATHOM.replace("VALUE", "other"))
    assert "CHANGED draw/01: fathom draw -o a.png" in answer(script, monkeypatch, capsys, "--check", *here)[1]
    write_program(tmp_path, FATHOM.replace("> a.png", "> b.png"))
    out = answer(script, monkeypatch, capsys, "--check", *here)[1]
    assert "MISSING draw/a.png" in out and "NEW draw/b.png" in out
    write_program(tmp_path, FATHOM.replace("*) echo", "*) exit 139; echo"))
    assert "DOUBTFUL draw/01" in answer(script, monkeypatch, capsys, "--check", *here)[1]


def test_a_feature_without_a_case_is_found(script, tmp_path, monkeypatch, capsys):
    here = ("--programs", tmp_path / "bin")
    answer(script, monkeypatch, capsys, "--update", *here)
    status, out = answer(script, monkeypatch, capsys, "--check", *here)
    assert status == 1 and "uses --colour blue" in out and out.count("NO CASE") == 1
    (tmp_path / "draw.cases").write_text(CASES.replace("--colour red", "--colour {red|blue}"))
    answer(script, monkeypatch, capsys, "--update", *here)
    assert answer(script, monkeypatch, capsys, "--check", *here)[0] == 0
    more = FATHOM.replace("A .png or", "A .png, .tif or").replace("The colour", "The colour\\noption\\t" + NEW_OPTION)
    write_program(tmp_path, more)
    out = answer(script, monkeypatch, capsys, "--check", *here)[1]
    assert "uses draw -o NAME.tif" in out and "uses draw --new" in out


def test_two_builds_are_compared(script, tmp_path, monkeypatch, capsys):
    write_program(tmp_path, FATHOM.replace("VALUE", "other"), "new")
    same = ("--old", tmp_path / "bin", "--new", tmp_path / "bin")
    assert "DIFFERENT" not in answer(script, monkeypatch, capsys, *same)[1]
    status, out = answer(script, monkeypatch, capsys, "--old", tmp_path / "bin", "--new", tmp_path / "new")
    assert status == 1 and "DIFFERENT draw/01.stdout: fathom draw -o a.png --colour red" in out


def test_choices_words_and_numbers(script):
    cases = script.parse_cases("A1 = x\n[c]\nBB = {A1|y}\nf {|BB} -o #.png\n", {})
    assert cases[0].steps == ["f -o 01.png", "f x -o 02.png", "f y -o 03.png"]
