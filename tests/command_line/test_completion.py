"""Completion in bash, zsh and fish: every command and option of every program, values, files; in the shells themselves."""

import os
import subprocess

import pytest
from fathom_help import all_commands, answer, path_with_program
from shells import terminal

FILES = ("mesh.obj", "my file.obj")
FOLDER = "meshes"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("completion")
    (made / FOLDER).mkdir()
    for name in FILES:
        (made / name).write_text("")
    for shell in ("bash", "zsh", "fish"):
        (made / f"script.{shell}").write_text(answer("completion", shell))
    return made


def in_bash(lines: list[list[str]], folder) -> list[list[str]]:
    """What bash offers for the last word of each line; the words are as bash takes them apart."""
    script = ["source script.bash", "compopt() { :; }"]  # which works in a terminal alone
    for words in lines:
        quoted = " ".join("'" + word + "'" for word in words)
        script.append(f"COMP_WORDS=({quoted}) COMP_CWORD={len(words) - 1}; _fathom; printf '%s\\t' \"${{COMPREPLY[@]}}\"; echo")
    outcome = subprocess.run(["bash", "--norc"], input="\n".join(script), capture_output=True, text=True, cwd=folder,
                             env=os.environ | {"PATH": path_with_program()})
    assert outcome.stderr == ""
    return [[word for word in line.split("\t") if word] for line in outcome.stdout.split("\n")[:-1]]


def in_fish(lines: list[str], folder) -> list[list[str]]:
    script = ["source script.fish"]
    for line in lines:
        script += [f"complete -C '{line}'", "echo END"]
    environment = os.environ | {"PATH": path_with_program(), "HOME": str(folder),
                                "XDG_CONFIG_HOME": str(folder / "config"), "LC_ALL": "C.UTF-8"}
    outcome = subprocess.run(["fish", "--no-config"], input="\n".join(script), capture_output=True, text=True, cwd=folder,
                             env=environment)
    assert outcome.stderr == ""
    return [[offer.partition("\t")[0] for offer in part.split("\n") if offer]
            for part in outcome.stdout.split("END\n")[:-1]]


def test_bash_offers_every_command_and_option(folder):
    cases = []
    for command in all_commands():
        cases.append((["fathom", *command.path, "--"], set(command.long_options())))
        if command.commands:
            cases += [([*before, *command.path, ""], set(command.commands)) for before in (["fathom"], ["fathom", "help"])]
    assert sum(len(names) for _, names in cases) > 400
    for (words, names), offered in zip(cases, in_bash([words for words, _ in cases], folder)):
        assert names <= set(offered), words


def test_fish_offers_every_command_and_option(folder):
    cases = []
    for command in all_commands():
        above = " ".join(("fathom", *command.path))
        cases += [(f"{above} ", set(command.commands)), (f"{above} --", set(command.long_options()))]
    assert sum(len(names) for _, names in cases) > 400
    for (line, names), offered in zip(cases, in_fish([line for line, _ in cases], folder)):
        assert names <= set(offered), line


LAST_WORDS = [
    # what stands on the line, and what is offered: all of these and no others
    ("fathom render --engine ", ["fast", "reference", "pipeline"]),
    ("fathom render --engine=p", ["pipeline"]),
    ("fathom render --channels Z,i", ["Z,id"]),
    ("fathom render --channels Z,id,N,P,bary,object,face,A,Zlow,material,group,part,label,Nc,Ns,va",
     ["Z,id,N,P,bary,object,face,A,Zlow,material,group,part,label,Nc,Ns,valid"]),
    ("fathom render --channels Z,di", ["Z,distance"]),
    ("fathom render --cull ", ["back", "front", "none"]),
    ("fathom preview --colormap v", ["viridis"]),
    ("fathom depth encode --mapping re", ["reversed", "reversed-infinite"]),
    ("fathom clip --algorithm c", ["cohen-sutherland", "cgal"]),
    ("fathom study z", ["z-fighting"]),
    ("fathom camera look-at --up ", ["x", "y", "z", "-x", "-y", "-z"]),
    ("fathom convert --to di", ["distance", "disparity"]),
    ("fathom completion ", ["bash", "zsh", "fish"]),
    ("fathom help camera ", ["look-at", "orbit", "directions", "shutter", "import"]),
    ("fathom --quiet camera import ", ["colmap", "nerf", "bop", "sfmdata", "gltf", "blender", "opengl", "opencv", "ros",
                                       "kalibr", "aria", "kitti360", "matrices", "tum",
                                       "7scenes", "scannet", "scannetpp", "replica", "kitti"]),
    ("fathom render --texture chec", ["checker"]),
]


def taken_apart(line: str) -> list[str]:
    """As bash does it: = is a word of its own."""
    return line.replace("=", " = ").split(" ")


def test_bash_offers_values(folder):
    offered = in_bash([taken_apart(line) for line, _ in LAST_WORDS], folder)
    assert offered == [expected for _, expected in LAST_WORDS]
    assert in_bash([["fathom", "render", "--engine=p"], ["fathom", "render", "--samples", "jittered", ":", "1"]],
                   folder) == [["--engine=pipeline"], ["16"]]


def test_fish_offers_values(folder):
    offered = in_fish([line for line, _ in LAST_WORDS], folder)
    for (line, expected), each in zip(LAST_WORDS, offered):
        option = line.split()[-1].partition("=")[0] + "=" if "=" in line else ""
        assert sorted(each) == sorted(option + word for word in expected), line


def test_options_are_offered_where_nothing_else_can_follow(folder):
    words = ["fathom", "camera", "look-at", ""]
    assert {"--eye", "-o", "--output"} <= set(in_bash([words], folder)[0])
    assert {"--eye", "--output"} <= set(in_fish([" ".join(words)], folder)[0])


def test_files_are_offered_where_files_are_taken(folder):
    lines = ["fathom render me", "fathom render mesh.obj --camera me", "fathom render --confine me",
             "fathom render --near me", "fathom render --engine me"]
    everything = [*sorted([FOLDER, "mesh.obj"])]
    expected = [everything, everything, [FOLDER], [], []]
    assert [sorted(each) for each in in_bash([line.split(" ") for line in lines], folder)] == expected
    assert [sorted(word.rstrip("/") for word in each) for each in in_fish(lines, folder)] == expected


TYPED = [
    # keys before Tab, and what the line is then
    ("fathom rend", "fathom render "),
    ("fathom camera loo", "fathom camera look-at "),
    ("fathom camera import colm", "fathom camera import colmap "),
    ("fathom render --engi", "fathom render --engine "),
    ("fathom render --engine ref", "fathom render --engine reference "),
    ("fathom render --engine=ref", "fathom render --engine=reference "),
    ("fathom render --confine mesh", "fathom render --confine meshes/"),
    ("fathom render my", "fathom render my\\ file.obj "),
    ("fathom help pipeline tr", "fathom help pipeline trace "),
    ("fathom study indist", "fathom study indistinguishable "),
    ("fathom scan --algorithm bres", "fathom scan --algorithm bresenham "),
    ("fathom completion fi", "fathom completion fish "),
]


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_tab_completes(shell, folder):
    opened = terminal(shell, str(folder))
    try:
        for keys, line in TYPED:
            assert opened.line_after(keys + "\t") == line
        in_list = opened.line_after("fathom render --channels Z,dist\t")
        assert in_list.rstrip(",") == "fathom render --channels Z,distance"
    finally:
        opened.close()


def test_zsh_takes_the_script_as_an_installed_function(folder):
    site = folder / "site-functions"
    site.mkdir()
    (site / "_fathom").write_text(answer("completion", "zsh"))
    script = ("fpath=($PWD/site-functions $fpath); autoload -Uz compinit; compinit -u -D; "
              "print $_comps[fathom]; autoload +X _fathom && print loaded")
    outcome = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, cwd=folder)
    assert outcome.stdout == "_fathom\nloaded\n", outcome.stderr
