"""No module of the package imports another in a circle: not when it is loaded, not within a
function, and not for type checkers."""

import ast
import os
import pathlib

import pytest

source = pathlib.Path(os.environ["FATHOM_SOURCE"])


def names_imported_by(text):
    """Modules of the package that a module names, wherever the statement stands."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            for each in node.names:
                if each.name.startswith("fathom."):
                    yield each.name.split(".")[1]
        elif isinstance(node, ast.ImportFrom):
            package, _, module = (node.module or "").partition(".")
            if node.level == 1 and node.module:
                yield package
            elif node.level == 1 or node.module == "fathom":
                yield from (each.name for each in node.names)
            elif package == "fathom":
                yield module.partition(".")[0]


def arrows(texts):
    """Each module, with the others that it imports."""
    return {name: sorted({each for each in names_imported_by(text) if each in texts} - {name})
            for name, text in texts.items()}


def find_circle(graph):
    """The names along a circle, or none."""
    done = set()

    def visit(name, path):
        if name in path:
            return [*path[path.index(name):], name]
        if name in done:
            return []
        for other in graph[name]:
            circle = visit(other, [*path, name])
            if circle:
                return circle
        done.add(name)
        return []

    return next(filter(None, (visit(name, []) for name in graph)), [])


def test_no_module_imports_another_in_a_circle():
    package = source / "lib/python/fathom"
    texts = {file.stem: file.read_text("utf-8") for file in package.glob("*.py")}
    del texts["__init__"]  # which imports them all
    graph = arrows(texts)
    assert sum(map(len, graph.values())) > 50
    assert find_circle(graph) == []


@pytest.mark.parametrize("statement", [
    "from .b import Thing", "from . import b", "import fathom.b", "from fathom.b import Thing",
    "from fathom import b", "def function():\n    from .b import Thing",
    "if TYPE_CHECKING:\n    from .b import Thing",
])
def test_a_circle_is_found(statement):
    texts = {"a": statement, "b": "from ._c import x\nimport numpy", "_c": "from . import d, _core",
             "d": "import fathom.a"}
    assert find_circle(arrows(texts)) == ["a", "b", "_c", "d", "a"]
    assert find_circle(arrows({**texts, "d": "import fathom"})) == []
