"""Every option, command and named value, with a letter missing, doubled or exchanged with the next at random: the error,
one line, asks whether the right one was meant, wherever it is the only one that lies so near."""

import random
import re
from concurrent.futures import ThreadPoolExecutor

from fathom_help import all_commands, answer, run


def distance(a: str, b: str) -> int:
    """Letters to insert, remove, replace or exchange with their neighbour, at least; each is touched once."""
    if not a or not b:
        return len(a) + len(b)
    ways = [distance_of(a[1:], b) + 1, distance_of(a, b[1:]) + 1, distance_of(a[1:], b[1:]) + (a[0] != b[0])]
    if len(a) > 1 and len(b) > 1 and (a[0], a[1]) == (b[1], b[0]):
        ways.append(distance_of(a[2:], b[2:]) + 1)
    return min(ways)


known: dict[tuple[str, str], int] = {}


def distance_of(a: str, b: str) -> int:
    if (a, b) not in known:
        known[a, b] = distance(a, b)
    return known[a, b]


def mistakes(word: str, others: list[str], chance: random.Random) -> list[str]:
    """One of any kind that is nearer to the word than to any other; none if there is no such one."""
    kinds = ["missing", "doubled", "exchanged"]
    chance.shuffle(kinds)
    for kind in kinds:
        at = chance.randrange(len(word) - (kind == "exchanged"))
        wrong = {"missing": word[:at] + word[at + 1:],
                 "doubled": word[:at] + word[at] + word[at:],
                 "exchanged": word[:at] + word[at:at + 2][::-1] + word[at + 2:]}[kind]
        if wrong != word and all(distance_of(wrong, other) > 1 for other in others if other != word):
            return [wrong]
    return []


def expect_questions(cases: list[tuple[list[str], str]], least: int) -> None:
    assert len(cases) >= least
    with ThreadPoolExecutor() as pool:
        outcomes = list(pool.map(lambda case: run(*case[0]), cases))
    for (arguments, right), outcome in zip(cases, outcomes):
        assert outcome.returncode == 2 and outcome.stdout == "", arguments
        assert outcome.stderr.startswith("fathom: error: ") and outcome.stderr.count("\n") == 1, arguments
        assert f"did you mean '{right}'?" in outcome.stderr, (arguments, outcome.stderr)


def test_of_options():
    chance, cases = random.Random(1), []
    for command in all_commands():
        options = [name[2:] for name in command.long_options()]
        for option in options:
            if len(option) > 1:
                cases += [([*command.path, "--" + wrong], "--" + option) for wrong in mistakes(option, options, chance)]
    expect_questions(cases, 600)


def test_of_options_with_a_value_or_one_dash():
    expect_questions([(["render", "a.obj", "--chanels=Z", "-o", "a.exr"], "--channels"),
                      (["render", "a.obj", "--chanels", "Z", "-o", "a.exr"], "--channels"),
                      (["render", "a.obj", "-output", "a.exr"], "--output"),
                      (["render", "a.obj", "-O", "a.exr"], "-o"),
                      (["render", "a.obj", "--Output", "a.exr"], "--output"),
                      (["--quite", "render", "a.obj", "-o", "a.exr"], "--quiet")], 6)


def test_of_commands():
    chance, cases = random.Random(2), []
    for command in all_commands():
        names = list(command.commands)
        for name in names:
            for wrong in mistakes(name, names, chance):
                cases += [([*command.path, wrong], name), (["help", *command.path, wrong], name)]
    expect_questions(cases, 100)


def test_of_commands_with_the_options_of_the_right_one():
    expect_questions([(["camera", "lookat", "--eye", "1,2,3"], "look-at"),
                      (["camera", "import", "colmp", "x", "-o", "y"], "colmap"),
                      (["depth", "resolutoin", "--near", "0.1", "--far", "1000", "1"], "resolution"),
                      (["dataset", "mpas", "cameras.json", "--mesh", "a.obj", "--out", "a"], "maps")], 4)


def enumerated() -> list[tuple[tuple[str, ...], str, list[str]]]:
    """The words that options take, as the program tells completion: command, option, words."""
    found = []
    for command in all_commands():
        if not command.path:
            continue
        for line in answer(*command.path, "--help=completion").split("\n"):
            fields = line.split("\t")
            if fields[0] == "command":
                here = tuple(fields[1].split()[1:])
            elif fields[0] == "option" and here == command.path and fields[4]:
                found.append((command.path, fields[1].split()[-1], fields[4].split()))
    return found


# Something valid for what a command cannot do without, by the name of its value.
values = {"FILE": "a.exr", "D": "1", "N": "1", "X,Y": "0,0", "X,Y,Z": "1,2,3", "SCENE...": "a.obj", "SCENE": "a.obj", "MAP": "a.exr",
          "INPUT": "a.json", "TRUTH": "a.exr", "OTHER": "b.exr", "SHELL": "bash", "PNG": "a.png", "DIR": "a", "FILE...": "a.obj",
          "LENS": "ros", "WxH": "4x4", "fx,fy,cx,cy": "1,1,1,1", "world-to-camera|camera-to-world": "world-to-camera",
          "opencv|opengl": "opencv", "0|0.5": "0", "STAGE": "clipping"}
of_commands = {("clip", "--algorithm"): "plane", ("scan", "--algorithm"): "dda", ("preview", "--output"): "a.png"}


def needed_by(path: tuple[str, ...], but: str) -> list[str]:
    command = next(each for each in all_commands() if each.path == path)
    arguments = [name.removesuffix("...") for name in command.arguments]
    words = [] if but in arguments else [values[name] for name in arguments if name in values]
    for names, (value, meaning) in command.options.items():
        if "; required" in meaning and but not in names:
            words += [names[-1], of_commands.get((path[0], names[-1])) or values[value]]
    return words


def test_of_values():
    chance, cases = random.Random(3), []
    options = enumerated()
    assert {"--channels", "--engine", "--mapping", "--algorithm", "--up", "--colormap", "NAME"} <= {
        name for _, name, _ in options}
    for path, option, words in options:
        if option == "--texture":
            continue  # any other text is the name of a file
        for word in words:
            if len(word) < 2 or word.isdigit() or ":" in word or word.startswith("-"):
                continue
            for wrong in mistakes(word, words, chance):
                # A letter that is left over of a short word is another text, and what begins with a dash an option.
                if len(wrong) < 2 or wrong.startswith("-") or wrong in (name + ":" for name in words):
                    continue
                if re.fullmatch(r"sphere-\d+[km]", wrong):
                    continue  # a sphere of another size
                given = [wrong] if not option.startswith("-") else [option, wrong]
                cases.append(([*path, *given, *needed_by(path, option)], word))
    expect_questions(cases, 300)


def test_of_values_that_are_left_out():
    for arguments, option, next_option in (
            (("render", "a.obj", "--size", "-o", "a.exr"), "--size", "-o"),
            (("render", "a.obj", "--png-scale", "--size", "9x9", "-o", "a.exr"), "--png-scale", "--size"),
            (("compare", "a.exr", "b.exr", "--channel", "--json", "-"), "--channel", "--json")):
        outcome = run(*arguments)
        assert outcome.returncode == 2
        assert outcome.stderr == f"fathom: error: {option} needs a value, found the option {next_option}\n"
    # Negative numbers are values, and a name in one argument is one, too.
    assert "needs a value" not in run("render", "none.obj", "--view", "-30,20", "-o", "a.exr").stderr
    assert "needs a value" not in run("render", "none.obj", "--up", "-z", "-o", "a.exr").stderr


def test_a_mask_of_a_data_set_needs_a_run_of_its_own():
    outcome = run("dataset", "maps", "none.json", "--mesh", "none.obj", "--channels", "Z,mask", "-o", "none")
    assert outcome.returncode == 2
    assert outcome.stderr == ("fathom: error: --channels: 'mask' needs separate files: make them by another run with "
                              "--channels mask, and leave it out of the list\n")
