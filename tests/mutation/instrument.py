"""Writes mutants into C++ sources: every comparison, sign and number becomes a call of mutant.h.

    room = Room(folder, arguments)
    mutants = room.change()

The sources under `folder` are parsed by libclang and changed in place. Operators and numbers are found in the syntax
tree, so that neither template brackets nor pointers are taken for them. What stands in macros is left alone.
"""
import dataclasses
import pathlib
import re

import clang.cindex
from clang.cindex import CursorKind

COMPARISONS = {"<": ("less", "<=", ">="), "<=": ("less_equal", "<", ">"),
               ">": ("greater", ">=", "<="), ">=": ("greater_equal", ">", "<")}
OPERATORS = {"==": ("equal", "!="), "!=": ("unequal", "=="), "+": ("plus", "-"), "-": ("minus", "+"),
             "+=": ("plus_assign", "-="), "-=": ("minus_assign", "+=")}
LOGICAL = {"&&": "||", "||": "&&"}
BINARY = {**COMPARISONS, **OPERATORS}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)
INTEGER = re.compile(r"(0[xX][0-9a-fA-F']+|[0-9][0-9']*)([uUlLzZ]*)")
FLOAT = re.compile(r"(0[xX][0-9a-fA-F.']+[pP][+-]?\d+|[0-9.']+(?:[eE][+-]?\d+)?)([fFlL]?)")
KINDS = {CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR, CursorKind.CALL_EXPR,
         CursorKind.UNARY_OPERATOR, CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL}

DECLARATIONS = {CursorKind.VAR_DECL, CursorKind.FIELD_DECL, CursorKind.PARM_DECL}


@dataclasses.dataclass
class Mutant:
    number: int
    file: str    # relative to the folder
    line: int
    column: int
    text: str    # of the line
    change: str  # "a < b → a <= b"

    @property
    def where(self):
        return f"{self.file}:{self.line}:{self.column}"


@dataclasses.dataclass
class Site:
    """A place in a source: what stands there and what may stand there instead. Offsets are in bytes."""
    start: int
    end: int
    kind: str        # "binary", "logical", "not", "negative", "number"
    word: str        # the operator or the number
    others: tuple    # what may stand there instead
    operands: tuple = ()  # (start, end) of each
    first: int = -1  # the number of its first mutant


def between(source, start, end):
    return COMMENT.sub("", source[start:end].decode()).strip()


def operands_of(cursor):
    parts = list(cursor.get_arguments()) if cursor.kind == CursorKind.CALL_EXPR else list(cursor.get_children())
    return [(part.extent.start.offset, part.extent.end.offset) for part in parts if part]


def site_of_operator(cursor, source, start, end):
    operands = operands_of(cursor)
    if len(operands) == 2:
        (a, b), (c, d) = operands
        if not start == a < b <= c < d == end:
            return None
        word = between(source, b, c)
        if word in BINARY:
            return Site(start, end, "binary", word, BINARY[word][1:], ((a, b), (c, d)))
        if word in LOGICAL:
            return Site(start, end, "logical", word, (LOGICAL[word],), ((a, b), (c, d)))
    if len(operands) == 1:
        (a, b), = operands
        word = between(source, start, a)
        if b == end and word == "-":
            return Site(start, end, "negative", word, ("",), ((a, b),))
        if b == end and word == "!":
            return Site(start, end, "not", word, ("",), ((a, b),))
    return None


def site_of_number(source, start, end):
    word = source[start:end].decode(errors="replace")
    if m := INTEGER.fullmatch(word):
        digits, suffix = m[1].replace("'", ""), m[2]
        value = int(digits, 0) if digits.lower().startswith("0x") else int(digits)
        others = tuple(f"{other}{suffix}" for other in (value + 1, value - 1) if other >= 0)
        return Site(start, end, "number", word, others)
    if m := FLOAT.fullmatch(word):
        # exact for what people write: the compiler adds
        return Site(start, end, "number", word, (f"{word} + 1",))
    return None


def is_part_of_a_type(parent, source, start, end):
    """Template arguments and bounds of arrays: no code, and changing them would compile every user of a header anew."""
    if parent.kind == CursorKind.BINARY_OPERATOR:
        return False
    before, after = source[:start].rstrip()[-1:], source[end:end + 80].lstrip()[:1]
    return before == b"<" or after == b">" or (before == b"[" and parent.kind in DECLARATIONS)


def spelt_with_strings(cursor):
    return any("basic_string" in (part.type.get_canonical().spelling or "") or part.kind == CursorKind.STRING_LITERAL
               for part in [cursor, *cursor.get_children()])


def site_at(cursor, parent, source):
    start, end = cursor.extent.start.offset, cursor.extent.end.offset
    if cursor.kind in (CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL):
        if is_part_of_a_type(parent, source, start, end):
            return None
        return site_of_number(source, start, end)
    if spelt_with_strings(cursor):
        return None
    return site_of_operator(cursor, source, start, end)


def collect(cursor, sources, found):
    """The sites below a cursor, by file; each place once, however many sources include its file."""
    for child in cursor.get_children():
        place = child.location.file
        if cursor.kind == CursorKind.TRANSLATION_UNIT and (place is None or place.name not in sources):
            continue
        if child.kind in KINDS and child.extent.start.file and child.extent.start.file.name in sources:
            name = child.extent.start.file.name
            site = site_at(child, cursor, sources[name])
            if site:
                found[name].setdefault((site.start, site.end), site)
        collect(child, sources, found)


def rendered(sites, source, start, end):
    """The text from start to end, sites in it replaced. Sites are nested or apart, the outer ones first."""
    out, at = [], start
    inside = [s for s in sites if start <= s.start and s.end <= end]
    while inside:
        site = inside.pop(0)
        inner = [s for s in inside if s.end <= site.end]
        inside = [s for s in inside if s.start >= site.end]
        out += [source[at:site.start], call(site, inner, source)]
        at = site.end
    return b"".join([*out, source[at:end]])


def call(site, inner, source):
    operands = [rendered(inner, source, a, b) for a, b in site.operands]
    n = site.first
    # Lines keep their numbers, by which the compiler complains.
    ends = [site.start, *(end for operand in site.operands for end in operand)]
    breaks = [b"\n" * source.count(b"\n", a, b) for a, b in zip(ends[::2], ends[1::2])]
    operands = [lines + text for lines, text in zip(breaks, operands)]
    if site.kind == "binary":
        return f"::fathom_mutant::{BINARY[site.word][0]}<{n}>(".encode() + operands[0] + b", " + operands[1] + b")"
    turned = f"::fathom_mutant::turned<{n}>(".encode()
    if site.kind == "logical":
        return (turned + turned + operands[0] + b") " + site.word.encode() + b" " + turned + operands[1] + b"))")
    if site.kind == "not":
        return turned + b"!" + operands[0] + b")"
    if site.kind == "negative":
        return f"::fathom_mutant::negative<{n}>(".encode() + operands[0] + b")"
    return f"::fathom_mutant::number<{n}>({site.word}, {', '.join(site.others)})".encode()


def changes(site, source):
    """What each mutant of a site does, for people."""
    def text(a, b):
        return " ".join(source[a:b].decode().split())
    was = text(site.start, site.end)
    for other in site.others:
        if site.kind in ("binary", "logical"):
            (a, b), (c, d) = site.operands
            yield f"{was} → {text(a, b)} {other} {text(c, d)}"
        elif site.operands:
            yield f"{was} → {text(*site.operands[0])}"
        else:
            yield f"{was} → {other}"


def drop_crossing(sites):
    """Outer sites first. One that crosses another, which only macros could make, is left out."""
    kept = []
    for site in sorted(sites, key=lambda s: (s.start, -s.end)):
        if all(site.start >= k.end or site.end <= k.end for k in kept):
            kept.append(site)
    return kept


class Room:
    """The sources under a folder as they are, and the places where they can change."""

    def __init__(self, folder, arguments):
        self.folder = pathlib.Path(folder)
        paths = sorted([*self.folder.rglob("*.cpp"), *self.folder.rglob("*.h")])
        self.sources = {str(path): path.read_bytes() for path in paths}
        found = {name: {} for name in self.sources}
        index = clang.cindex.Index.create()
        for name in self.sources:
            if name.endswith(".cpp"):  # headers come with the sources that include them
                unit = index.parse(name, args=arguments)
                errors = [d.spelling for d in unit.diagnostics if d.severity >= clang.cindex.Diagnostic.Error]
                if errors:
                    raise RuntimeError(f"{name} cannot be read: {errors[0]}")
                collect(unit.cursor, self.sources, found)
        self.sites = {name: drop_crossing(sites.values()) for name, sites in found.items()}

    def change(self, skipped=frozenset()):
        """Writes the changed sources and gives their mutants, numbered from 0. `skipped`: places, "file:line", that
        stay as they are."""
        mutants = []
        for name, source in self.sources.items():
            relative = str(pathlib.Path(name).relative_to(self.folder))
            lines = source.decode().splitlines()
            kept = []
            for site in self.sites[name]:
                line = source.count(b"\n", 0, site.start) + 1
                last = source.count(b"\n", 0, site.end) + 1
                if any(f"{relative}:{k}" in skipped for k in range(line, last + 1)):
                    continue
                kept.append(site)
                site.first = len(mutants)
                column = site.start - (source.rfind(b"\n", 0, site.start) + 1) + 1
                for change in changes(site, source):
                    mutants.append(Mutant(len(mutants), relative, line, column, lines[line - 1].strip(), change))
            body = rendered(kept, source, 0, len(source))
            if kept:
                body = b'#include "tests/mutation/mutant.h"\n#line 1\n' + body
            pathlib.Path(name).write_bytes(body)
        return mutants
