"""fathom.scan(): the answers of `fathom scan`, as Python's numbers."""

import json
import os
import subprocess
from fractions import Fraction

import numpy as np
import pytest

import fathom
from fathom.scanning import algorithms

cases = {
    "explicit": {"line": (0, 0, 8, 3)},
    "dda": {"line": (3, 7, -2, 1)},
    "bresenham": {"line": (0, 0, 8, 3)},
    "midpoint": {"line": (0, 0, -8, 3)},
    "diamond-exit": {"line": (0.25, 0.5, 6.5, 3)},
    "line-forms": {"line": (0, 0, 8, 3), "points": [(4, 1)], "parameters": [0.5]},
    "even-odd": {"polygon": [[(1, 1), (8, 2), (9, 9), (5, 4), (2, 8)]], "attributes": [[0], [1], [2], [3], [4]]},
    "non-zero": {"polygon": [[(0, 0), (4, 4), (4, 0), (0, 4)]], "width": 9, "height": 9},
    "flood": {"grid": ["..#", "##."], "seed": (0, 0), "connectivity": 8},
    "edge-function": {"triangle": [(1, 1), (8, 2), (4, 7)], "attributes": [[0], [1], [2]], "w": [1, 2, 3]},
    "scan-line": {"triangle": [(1, 1), (8, 2), (4, 7)], "attributes": [[0], [1], [2]]},
    "edge-values": {"triangle": [(1, 1), (8, 2), (4, 7)], "width": 5, "height": 4},
    "inside": {"polygon": [[(0, 0), (4, 0), (4, 4), (0, 4)]], "points": [(1, 1), (5, 1)]},
    "convexity": {"polygon": [[(0, 0), (4, 0), (4, 4), (0, 4)]]},
    "tessellate": {"polygon": [[(0, 0), (4, 0), (4, 4), (3, 1)]]},
    "convex-hull": {"points": [(0, 0), (4, 0), (0, 4), (1, 1)], "weights": [1, 1, 2, 0]},
}
with_steps = {"explicit", "dda", "bresenham", "midpoint", "diamond-exit", "even-odd", "non-zero", "edge-function", "scan-line"}


def by_the_command(algorithm, case, *options):
    program = os.environ["FATHOM_PROGRAM"]
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    ran = subprocess.run([program, "scan", "--algorithm", algorithm, *options], input=json.dumps(case), text=True,
                         capture_output=True, env=environment, check=True)
    return json.loads(ran.stdout)


def plain(value, exact, key=""):
    """As the command prints it."""
    if isinstance(value, np.ndarray):
        return plain(value.tolist(), exact)
    if isinstance(value, dict):
        return {name: plain(each, exact, name) for name, each in value.items()}
    if isinstance(value, list):
        return [plain(each, exact) for each in value]
    return str(value) if isinstance(value, Fraction) else value


def test_every_algorithm_has_a_case():
    assert set(algorithms()) == set(cases)


@pytest.mark.parametrize("algorithm", cases)
@pytest.mark.parametrize("arithmetic", ["exact", "float64", "float32"])
def test_the_answer_is_that_of_the_command(algorithm, arithmetic):
    steps = algorithm in with_steps
    options = ["--arithmetic", arithmetic, *(["--exact"] if arithmetic == "exact" else []), *(["--trace"] if steps else [])]
    answer = fathom.scan(algorithm, **cases[algorithm], arithmetic=arithmetic, trace=steps)
    assert plain(answer, arithmetic == "exact") == by_the_command(algorithm, cases[algorithm], *options)


def test_numbers_are_exact_and_pixels_are_arrays():
    answer = fathom.scan("edge-function", triangle=np.array([(0, 0), (4, 0), (0, 4)]), attributes=[[0], [1], [0]])
    assert answer["pixels"].dtype == np.int64 and answer["pixels"].shape == (6, 2)
    assert answer["values"][0] == [Fraction(1, 8)]
    empty = fathom.scan("edge-function", triangle=[(0, 0), (1, 1), (2, 2)])
    assert empty["pixels"].shape == (0, 2)
    runs = fathom.scan("even-odd", polygon=[[(0, 0), (4, 0), (4, 2), (0, 2)]], runs=True)["runs"]
    assert runs.tolist() == [[0, 0, 4], [1, 0, 4]]
    values = fathom.scan("edge-values", triangle=[(0, 0), (4, 0), (0, 4)], width=5, height=4, arithmetic="float64")["values"]
    assert values.shape == (4, 5, 3) and values.dtype == np.float64
    assert fathom.scan("dda", line=(0, 0, 1, 1), name="12")["name"] == "12"


def test_the_rules_of_the_textbooks():
    def at_tie(rule):
        return fathom.scan("bresenham", line=(0, 0, 8, 3), ties=rule)["pixels"][4].tolist()

    assert at_tie(None) == at_tie("greater") == [4, 2] and at_tie("stay") == [4, 1]
    triangle = [(0, 0), (4.5, 0.5), (0.5, 4.5)]
    open_, closed = (fathom.scan("edge-function", triangle=triangle, edges=rule)["pixels"] for rule in (None, "closed"))
    assert len(closed) > len(open_)
    corner = {"triangle": [(0.7, 0), (4, 0), (0, 4)]}
    snapped = fathom.scan("edge-function", **corner, subpixel_bits=0)["pixels"].tolist()
    assert snapped == by_the_command("edge-function", corner, "--subpixel-bits", "0")["pixels"]
    assert snapped != fathom.scan("edge-function", **corner)["pixels"].tolist()


def test_pictures_are_those_of_the_command(tmp_path):
    answer = fathom.scan("midpoint", line=(0, 0, 8, 3), draw=True)
    assert "trace" not in answer and answer._repr_svg_() == answer.svg
    answer.save(str(tmp_path / "python.svg"))
    by_the_command("midpoint", cases["bresenham"], "--exact", "--draw", str(tmp_path / "command.svg"))

    def drawn(name):  # without the title, which names the caller
        return (tmp_path / name).read_text().split("</style>")[1]

    assert drawn("python.svg") == drawn("command.svg")
    with pytest.raises(ValueError, match="draw=True"):
        fathom.scan("midpoint", line=(0, 0, 8, 3)).save("nowhere.svg")
    assert fathom.scan("midpoint", line=(0, 0, 8, 3))._repr_svg_() is None


@pytest.mark.parametrize("arguments, error, words", [
    ({"algorithm": "midpont", "line": (0, 0, 1, 1)}, ValueError, "algorithm: expected"),
    ({"algorithm": "dda", "line": (0, 0, 1.5, 3)}, fathom.InputError, "1.5 is not a whole number"),
    ({"algorithm": "dda"}, fathom.InputError, '"line" is missing'),
    ({"algorithm": "dda", "triangle": [(0, 0), (1, 0), (0, 1)]}, fathom.InputError, "is not a key"),
    ({"algorithm": "edge-function", "triangle": [(0, 0), (Fraction(1, 3), 0), (0, 1)]}, ValueError,
     "triangle: 1/3 is not a number of binary64"),
    ({"algorithm": "dda", "line": (0, 0, 2**53 + 1, 1)}, ValueError, "is not a number of binary64"),
    ({"algorithm": "dda", "line": (0, 0, float("nan"), 1)}, ValueError, "nan is not a number of binary64"),
    ({"algorithm": "dda", "line": (0, 0, object(), 1)}, TypeError, "line: expected numbers"),
    ({"algorithm": "flood", "grid": ["a"], "seed": (0, 0), "trace": True}, fathom.UsageError, "trace: flood shows no steps"),
    ({"algorithm": "dda", "line": (0, 0, 1, 1), "edges": "closed"}, fathom.UsageError, "edges is for edge-function"),
    ({"algorithm": "dda", "line": (0, 0, 1, 1), "ties": "odd"}, ValueError, "ties: expected"),
    ({"algorithm": "dda", "line": (0, 0, 1, 1), "arithmetic": "float16"}, ValueError, "arithmetic: expected"),
    ({"algorithm": "edge-function", "triangle": [(0, 0), (1, 0), (0, 1)], "subpixel_bits": 17}, ValueError, "expected 0 to 16"),
])
def test_what_is_refused(arguments, error, words):
    with pytest.raises(error, match=words):
        fathom.scan(**arguments)
