"""Hypothesis H1 of docs/error-analysis.md in C++: every function that the installed headers declare computes in
StandardArithmetic. It begins with one, or its comment says what it needs, or unguarded.txt names it."""

import fnmatch
import os
import pathlib
import re

folder = pathlib.Path(__file__).parent
library = pathlib.Path(os.environ["FATHOM_SOURCE"]) / "lib/fathom"
# Arithmetic itself, and bytes: each operation of the first is right in every mode (tests/numeric), or Needs the standard
# one; the others have no floating-point numbers.
basic_modules = {"numeric", "geometry", "text", "memory", "threads"}
public_namespaces = {"fathom", "fathom::attribution", "fathom::clipping", "fathom::pipeline"}
guard = "const StandardArithmetic standard;"
needs = re.compile(r"///\s+Needs\s.*StandardArithmetic")


def installed_headers():
    """What CMake installs: the lists after HEADERS."""
    for listing in library.rglob("CMakeLists.txt"):
        text = re.sub(r"#.*", "", listing.read_text(encoding="utf-8"))
        for names in re.findall(r"HEADERS((?:\s+[\w./-]+\.h)+)", text):
            yield from (listing.parent / name for name in names.split())


def without_comments(text):
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"(?<!/)//(?!/).*", "", text)
    return re.sub(r"^\s*#.*(?:\\\n.*)*", "", text, flags=re.M)


def statements(text):
    """(namespace, statement) of all that stands in namespaces; a body is left out, and "{" stays in its place."""
    open_blocks, statement = [], ""
    for character in without_comments(text):
        outside = all(kind == "namespace" for kind, _ in open_blocks)
        if character == "{":
            code = re.sub(r"///.*", "", statement).strip()
            found = re.fullmatch(r"(?:inline\s+)?namespace\s*([\w:]*)", code)
            if outside and found:
                open_blocks.append(("namespace", found[1]))
                statement = ""
                continue
            open_blocks.append(("body", ""))
            statement += "{" if outside else ""
        elif character == "}":
            open_blocks.pop()
            # An initializer of a default argument ends here, as "{}" does; what has a body of its own ends as well.
            if all(kind == "namespace" for kind, _ in open_blocks) and statement.count("(") <= statement.count(")"):
                if not re.sub(r"///.*", "", statement).rstrip("{ \n").endswith("="):
                    yield "::".join(name for _, name in open_blocks), statement
                statement = ""
        elif character == ";" and outside:
            yield "::".join(name for _, name in open_blocks), statement + ";"
            statement = ""
        elif outside:
            statement += character


class Declared:
    """A function that a header declares, and that a source defines."""

    def __init__(self, header, statement):
        self.header = header
        self.needs_the_mode = bool(needs.search(statement))
        code = re.sub(r"///.*", "", statement)
        self.code = re.sub(r"^template <[^>]*> ", "", " ".join(code.split()))
        found = re.match(r"[^(]*?([A-Za-z_]\w*)\s*\(", self.code)
        self.name = found[1] if found else ""

    def is_function(self):
        other = r"(?:class|struct|enum|using|union|extern|static_assert|template|inline|requires|constexpr|static|typedef|friend)\b"
        return bool(self.name) and self.code.endswith(";") and not re.match(other, self.code) and (
            "operator" not in self.code and "= delete" not in self.code and "=" not in self.code.split("(")[0])


def declared_functions():
    for header in sorted(installed_headers()):
        if header.relative_to(library).parts[0] in basic_modules:
            continue
        for namespace, statement in statements(header.read_text(encoding="utf-8")):
            declared = Declared(header, statement)
            if namespace in public_namespaces and declared.is_function():
                yield declared


def definitions(name, text):
    """The bodies of functions of this name that begin at the start of a line, outside unnamed namespaces."""
    text = re.sub(r"namespace \{\n.*?\n\}  // namespace\n", "", text, flags=re.S)
    for found in re.finditer(rf"^[A-Za-z_][\w:<>,&*\[\] ]*[\s&*>]{name}\(", text, re.M):
        depth, end = 1, found.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        body = re.match(r"\s*\{(.*?)^\}", text[end:], re.M | re.S)
        if body:
            yield body[1].strip()


def exempt():
    lines = (folder / "unguarded.txt").read_text(encoding="utf-8").splitlines()
    return [tuple(line.split(None, 1)) for line in lines if line and not line.startswith("#")]


def test_functions_compute_in_the_standard_mode():
    sources = {}
    for path in library.rglob("*.cpp"):
        sources.setdefault(path.relative_to(library).parts[0], []).append(path.read_text(encoding="utf-8"))
    unguarded, found, used = set(), 0, set()
    for declared in declared_functions():
        place = declared.header.relative_to(library)
        module = place.parts[0] if len(place.parts) > 1 else place.stem + ".cpp"
        bodies = [body for text in sources.get(module, []) for body in definitions(declared.name, text)]
        found += len(bodies)
        if declared.needs_the_mode or all(body.startswith(guard) for body in bodies):
            continue
        patterns = [each for each in exempt() if fnmatch.fnmatch(str(place), each[0]) and fnmatch.fnmatch(declared.name, each[1])]
        used.update(patterns)
        if not patterns:
            unguarded.add(f"{place}: {declared.name}")
    assert found > 150
    assert not unguarded, f"begin with `{guard}`, or say so in unguarded.txt: " + "; ".join(sorted(unguarded))
    idle = sorted(set(exempt()) - used)
    assert not idle, f"unguarded.txt has lines for nothing: {idle}"
