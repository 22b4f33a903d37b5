"""`--help`, `fathom help` and manual pages say the same, to the letter, of every command of every program."""

import re
import subprocess

import pytest
from fathom_help import Help, all_commands, answer, run

names = [each.name for each in all_commands()]


def by_name(name: str) -> Help:
    return all_commands()[names.index(name)]


def test_companions_are_looked_at_too():
    assert {"fathom-render", "fathom-camera-import-bop", "fathom-pipeline-trace", "fathom-study"} <= set(names)


@pytest.mark.parametrize("name", names)
def test_help_of_a_command_is_its_help_option(name):
    command = by_name(name)
    assert answer("help", *command.path) == command.text
    assert "--help" in command.long_options() and "--quiet" in command.long_options()


# Patterns, long lists, which another option or the end of the help contains, and lists of another command.
WORDS_ELSEWHERE = {("fathom-render", "--samples"), ("fathom-dataset-maps", "--channels"), ("fathom-study", "NAME"),
                   ("fathom-validate", "--scene"), ("fathom-validate", "--render"), ("fathom-validate", "--model"),
                   ("fathom-bench", "--scene"), ("fathom-bench", "--channels"), ("fathom-clip", "--against")}


def words_of(command: Help) -> dict[str, list[str]]:
    """The words that each option or argument of a command takes, as the shells complete them."""
    lines = answer(*command.path, "--help=completion").split("\n")[1:]
    own = lines[:next((i for i, line in enumerate(lines) if not line.startswith("option\t")), None)]
    return {fields[1].split()[-1]: fields[4].split() for fields in (line.split("\t") for line in own)}


@pytest.mark.parametrize("name", names)
def test_help_contains_every_word_that_an_option_takes(name):
    command = by_name(name)
    told = {option[-1]: " ".join(text) for option, text in command.options.items()} | command.arguments
    for option, words in words_of(command).items():
        if (name, option) in WORDS_ELSEWHERE:
            continue
        explained = set(re.split(r"[^\w.-]+", told.get(option, "")))
        explained |= {word.rstrip(".") for word in explained}
        assert set(words) <= explained, (name, option)


@pytest.mark.parametrize("name", names)
def test_lines_fit_a_terminal(name):
    assert [line for line in by_name(name).text.split("\n") if len(line) > 80] == []


@pytest.mark.parametrize("name", names)
def test_short_option_shows_one_screen(name):
    command = by_name(name)
    shown = answer(*command.path, "-h")
    if command.commands or command.text.count("\n") <= 40:
        assert shown == command.text
        return
    assert shown.count("\n") <= 40 and all(len(line) <= 80 for line in shown.split("\n"))
    listed = set(re.findall(r"[\w.-]+", shown))
    assert {option[-1] for option in command.options} <= listed
    example = shown.partition("\nExample:\n")[2].partition("\n\n")[0]
    assert example and example in command.text and not example.endswith(("\\", "|"))
    assert f"'{' '.join(('fathom', *command.path))} --help' explains all options" in shown


# First words of the commands' descriptions. A new one is added here if it is a verb in the imperative.
VERBS = {"Check", "Clip", "Compare", "Compute", "Convert", "Count", "Decide", "Draw", "Encode", "Explain", "Find", "Follow",
         "Import", "Make", "Measure", "Print", "Rasterize", "Render", "Run", "Show", "Trace", "Write"}


@pytest.mark.parametrize("name", names)
def test_help_begins_with_a_verb(name):
    command = by_name(name)
    for description in (command.text, *command.commands.values()):
        assert re.match(r"\w+", description)[0] in VERBS


@pytest.mark.parametrize("name", names)
def test_help_has_no_empty_ends(name):
    text = by_name(name).text
    assert text == text.strip() + "\n" and "\n\n\n" not in text


@pytest.mark.parametrize("name", names)
def test_manual_page_is_without_fault(name, tmp_path):
    page = tmp_path / f"{name}.1"
    page.write_text(answer("help", "--man", *by_name(name).path))
    for judge in (["mandoc", "-T", "lint"], ["man", "--warnings", "-E", "UTF-8", "-l"],
                  ["groff", "-ww", "-K", "utf8", "-man", "-T", "utf8"]):
        outcome = subprocess.run([*judge, page], capture_output=True, text=True)
        complaints = outcome.stderr + (outcome.stdout if judge[0] == "mandoc" else "")
        assert complaints == "" and outcome.returncode == 0


def rendered(page: str) -> str:
    """As a reader sees it, in lines that are never broken."""
    shown = subprocess.run(["mandoc", "-T", "utf8", "-O", "width=1000"], input=page, capture_output=True, text=True,
                           check=True).stdout
    return re.sub(".\b", "", shown)


@pytest.mark.parametrize("name", names)
def test_manual_page_has_what_help_has_and_no_more(name):
    command = by_name(name)
    page = rendered(answer("help", "--man", *command.path))
    sections = dict(re.findall(r"^([A-Z][^\n]*)\n((?:(?: [^\n]*)?\n)+)", page, re.MULTILINE))
    assert sections["NAME"].strip() == f"{command.name} - {' '.join(command.text.partition(chr(10) + 'Usage')[0].split())}"

    expected = command.arguments | command.commands
    for option, (value, meaning) in command.options.items():
        expected[", ".join(option) + (f" {value}" if value else "")] = meaning
    entries = {}
    for heading, body in sections.items():
        if heading in ("NAME", "SYNOPSIS", "EXAMPLES", "NOTES", "SEE ALSO"):
            continue
        lines = [line for line in body.split("\n") if line]
        least = min((len(line) - len(line.lstrip()) for line in lines), default=0)
        for line in lines:
            if line[least] == " ":
                entries[tag] = " ".join((entries[tag] + " " + line).split())  # two spaces end a sentence there
                continue
            # A short name has its meaning beside it; what is no name of the help is an entry that is not expected.
            tag = next((name for name in expected if (line.strip() + " ").startswith(name + " ")), line.strip())
            entries[tag] = " ".join(line.strip().removeprefix(tag).split())
    assert entries == expected

    examples = command.text.partition("\nExamples:\n")[2].partition("\n\n")[0].rstrip("\n")
    assert [line.strip() for line in sections["EXAMPLES"].strip().split("\n")] == [
        line.strip() for line in examples.split("\n")]


def test_every_output_has_one_name():
    """It is -o and --output, of every command that has either, and --out is taken too, without being shown."""
    writing = [each for each in all_commands() if {"-o", "--output", "--out"} & {name for names in each.options for name in names}]
    assert {"render", "study", "validate", "help"} <= {each.path[0] for each in writing}
    assert len(writing) >= 25
    for command in writing:
        assert ("-o", "--output") in command.options, command.name
        assert "--out " not in command.text, command.name
        for spelling in ("-o", "--output", "--out"):
            told = run(*command.path, spelling).stderr
            assert "there is no option" not in told and "--output: 1 required" in told, (command.name, spelling, told)


def test_all_pages_are_written_to_a_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    answer("help", "--man", "--out", str(tmp_path / "new" / "man1"))
    written = {file.stem: file.read_text() for file in (tmp_path / "new" / "man1").iterdir()}
    assert sorted(written) == sorted(names)
    for each in all_commands():
        assert written[each.name] == answer("help", "--man", *each.path)
    assert '1970-01-02 "Fathom' in written["fathom"]


@pytest.mark.parametrize("arguments, said", [
    (["help", "rendre"], "did you mean 'render'?"),
    (["help", "camera", "orbti"], "did you mean 'orbit'?"),
    (["help", "render", "map"], "'render' has no command 'map' below it"),
    (["help", "--mna"], "did you mean '--man'?"),
    (["help", "--out", "pages"], "--output goes with --man"),
    (["render", "--help=mna"], "did you mean 'man'?"),
    (["completion", "bsh"], "did you mean 'bash' or 'zsh'?"),
    (["completion"], "SHELL is required"),
])
def test_wrong_questions_are_answered_in_one_line(arguments, said, tmp_path):
    outcome = run(*arguments, cwd=tmp_path)
    assert outcome.returncode == 2 and outcome.stdout == ""
    assert outcome.stderr.startswith("fathom: error: ") and outcome.stderr.count("\n") == 1
    assert said in outcome.stderr
    assert list(tmp_path.iterdir()) == []
