"""Docstrings, which are plain text, as reStructuredText.

In a docstring, lines such as

    vertices      N×3, float64
    faces         M×3 triangles;
                  integers

are what arguments are; >>> begins an example; whatever else stands there is a paragraph, with `code`.
"""

import re

# A name, or several, and at least two spaces before the text.
ENTRY = re.compile(r"^([\w\"*.]+(?:, [\w\"*.]+)*) {2,}(\S.*)$")

ALIAS = re.compile(r"Alias for field number \d+")


def escaped(text):
    """Words of a paragraph, with `code` as code."""
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(f"`{part}`" if part.startswith("`") and len(part) > 1 else re.sub(r"([\\*|_])", r"\\\1", part)
                   for part in parts)


def entries(lines):
    """A list of arguments, as definitions."""
    column, found = 0, []
    for line in lines:
        entry = ENTRY.match(line)
        if entry:
            column = entry.start(2)
            found += [f"``{entry[1]}``", "    " + escaped(entry[2])]
        else:
            found.append("    " + escaped(line[min(column, len(line) - len(line.lstrip())):].lstrip()))
    return found


def blocks(lines):
    block = []
    for line in [*lines, ""]:
        if line.strip():
            block.append(line)
        elif block:
            yield block
            block = []


def is_list(block):
    """Whether all lines are entries or go on below the text of one."""
    return ENTRY.match(block[0]) and all(ENTRY.match(line) or line.startswith("  ") for line in block)


def lines_of(block):
    if block[0].lstrip().startswith(">>>"):
        return block
    if is_list(block):
        return entries(block)
    if block[0].startswith("    "):
        return ["::", "", *block]
    return [escaped(line.strip()) for line in block]


def to_restructured_text(app, what, name, owner, options, lines):
    """For autodoc-process-docstring: changes the lines in place."""
    changed = []
    if what == "data" or lines and ALIAS.fullmatch(lines[0]):
        lines.clear()  # what Python says of int and str, and of a field that has no comment
    for block in blocks(lines):
        changed += [*lines_of(block), ""]
    lines[:] = changed
