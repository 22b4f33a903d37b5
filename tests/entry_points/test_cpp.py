"""Hypothesis H1 of docs/error-analysis.md in C++: every function that the installed headers declare, every function that
they define, and every public member function of their classes computes in StandardArithmetic. It begins with one, or its
comment says what it needs, or unguarded.txt names it."""

import fnmatch
import os
import pathlib
import re

folder = pathlib.Path(__file__).parent
library = pathlib.Path(os.environ["FATHOM_SOURCE"]) / "lib/fathom"
# Arithmetic itself, and bytes: each operation of the first is right in every mode (tests/numeric), or Needs the standard
# one; the others have no floating-point numbers.
basic_modules = {"failures", "numeric", "geometry", "text", "files", "memory", "threads"}
public_namespaces = {"fathom", "fathom::attribution", "fathom::clipping", "fathom::pipeline", "fathom::vtk"}
guard = "const StandardArithmetic standard;"
needs = re.compile(r"///\s+Needs\s.*StandardArithmetic")


def installed_headers():
    """What CMake installs: the lists after HEADERS, and what goes into the include folder by itself."""
    for listing in library.rglob("CMakeLists.txt"):
        text = re.sub(r"#.*", "", listing.read_text(encoding="utf-8"))
        lists = re.findall(r"HEADERS((?:\s+[\w./-]+\.h)+)", text)
        lists += re.findall(r'install\(FILES((?:\s+[\w./-]+\.h)+)\s+DESTINATION\s+"\$\{CMAKE_INSTALL_INCLUDEDIR\}', text)
        for names in lists:
            yield from (listing.parent / name for name in names.split())


def without_comments(text):
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"(?<!/)//(?!/).*", "", text)
    text = re.sub(r"///.*", lambda comment: re.sub("[;{}]", ",", comment[0]), text)
    return re.sub(r"^\s*#.*(?:\\\n.*)*", "", text, flags=re.M)


def statements(text):
    """(namespace, statement, body) of all that stands in namespaces; "{" stays in the place of a body."""
    open_blocks, statement, body = [], "", ""
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
            if outside:
                statement, body = statement + "{", ""
                continue
        elif character == "}":
            open_blocks.pop()
            # An initializer of a default argument ends here, as "{}" does; what has a body of its own ends as well.
            if all(kind == "namespace" for kind, _ in open_blocks):
                if statement.count("(") <= statement.count(")"):
                    if not re.sub(r"///.*", "", statement).rstrip("{ \n").endswith("="):
                        yield "::".join(name for _, name in open_blocks), statement, body
                    statement = ""
                continue
        elif character == ";" and outside:
            yield "::".join(name for _, name in open_blocks), statement + ";", ""
            statement = ""
        elif outside:
            statement += character
        if not outside:
            body += character


class Declared:
    """A function that a header declares, with its body if it stands there too."""

    def __init__(self, header, statement, body, owner=""):
        self.header, self.owner = header, owner
        self.needs_the_mode = bool(needs.search(statement))
        code = " ".join(re.sub(r"///.*", "", statement).split())
        code = re.sub(r"^(?:(?:public|private|protected): ?)+", "", code)
        code = re.sub(r"^template <(?:[^<>]|<[^<>]*>)*> ", "", code)
        self.code = re.sub(r"^(?:(?:inline|constexpr|static|explicit|virtual|\[\[nodiscard\]\]|\[\[noreturn\]\]) )*", "", code)
        found = re.match(r"[^(]*?([A-Za-z_]\w*)\s*\(", self.code)
        self.name = found[1] if found else ""
        self.body = body.strip() if self.code.endswith("{") else None

    def full_name(self):
        return f"{self.owner}::{self.name}" if self.owner else self.name

    def is_function(self):
        other = r"(?:class|struct|enum|using|union|extern|static_assert|template|typedef|friend|std::function)\b"
        return bool(self.name) and self.code[-1] in ";{" and not re.match(other, self.code) and (
            "operator" not in self.code and not re.search(r"= (?:delete|default)|^~", self.code) and "=" not in self.code.split("(")[0])


def class_of(statement):
    """The name of a class that a statement defines; or ""."""
    code = " ".join(re.sub(r"///.*", "", statement).split())
    found = re.match(r"(?:template <(?:[^<>]|<[^<>]*>)*> )?(class|struct) (\w+)[^(]*\{$", code)
    return (found[2], found[1]) if found else ("", "")


def public_members(header, name, kind, body):
    access = "public" if kind == "struct" else "private"
    for _, statement, own_body in statements(body):
        labels = re.findall(r"\b(public|private|protected):(?!:)", re.sub(r"///.*", "", statement))
        access = labels[-1] if labels else access
        declared = Declared(header, statement, own_body, name)
        if access == "public" and declared.is_function():
            yield declared


def declared_functions():
    for header in sorted(installed_headers()):
        if header.relative_to(library).parts[0] in basic_modules:
            continue
        for namespace, statement, body in statements(header.read_text(encoding="utf-8")):
            if namespace not in public_namespaces:
                continue
            name, kind = class_of(statement)
            declared = Declared(header, statement, body)
            if name:
                yield from public_members(header, name, kind, body)
            elif declared.is_function():
                yield declared


def definitions(name, text):
    """The bodies of functions of this name that begin at the start of a line, outside unnamed namespaces."""
    text = re.sub(r"namespace \{\n.*?\n\}  // namespace\n", "", text, flags=re.S)
    result_type = r"[A-Za-z_][\w:<>,&*\[\] ]*[\s&*>]"
    # A constructor has no type, and initializes members before its body.
    is_member = "::" in name
    begin = rf"^(?:{result_type})?{name}\(" if is_member else rf"^{result_type}{name}\("
    until_body = r"[^;{]*\{" if is_member else r"\s*\{"
    for found in re.finditer(begin, text, re.M):
        depth, end = 1, found.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        body = re.match(until_body + r"(.*?)^\}", text[end:], re.M | re.S)
        if body:
            yield body[1].strip()


def exempt():
    lines = (folder / "unguarded.txt").read_text(encoding="utf-8").splitlines()
    return [tuple(line.split(None, 1)) for line in lines if line and not line.startswith("#")]


def module_of(place):
    """The folder of a file of the library; nothing of the front doors, which stand above all modules."""
    return place.parts[0] if len(place.parts) > 1 else ""


def test_functions_compute_in_the_standard_mode():
    sources = {}
    for path in library.rglob("*.cpp"):
        sources.setdefault(module_of(path.relative_to(library)), []).append(path.read_text(encoding="utf-8"))
    unguarded, found, used = set(), 0, set()
    for declared in declared_functions():
        place = declared.header.relative_to(library)
        bodies = [declared.body] if declared.body is not None else [
            body for text in sources.get(module_of(place), []) for body in definitions(declared.full_name(), text)]
        found += len(bodies)
        if declared.needs_the_mode or (bodies and all(body.startswith(guard) for body in bodies)):
            continue
        patterns = [each for each in exempt()
                    if fnmatch.fnmatch(str(place), each[0]) and fnmatch.fnmatchcase(declared.full_name(), each[1])]
        used.update(patterns)
        if not patterns:
            unguarded.add(f"{place}: {declared.full_name()}")
    assert found > 500
    assert not unguarded, f"begin with `{guard}`, or say so in unguarded.txt: " + "; ".join(sorted(unguarded))
    idle = sorted(set(exempt()) - used)
    assert not idle, f"unguarded.txt has lines for nothing: {idle}"
