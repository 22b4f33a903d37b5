"""The reference of the C interface: each declaration of fathom.h with the comment above it."""

import re
import textwrap

from docstrings import blocks, lines_of

SECTION = re.compile(r"-{20,} (\w[\w ]*)")


def plain(comment):
    """A comment without its stars."""
    lines = [re.sub(r"^ \* ?", "", line) for line in comment.removeprefix("/*").removesuffix("*/").splitlines()]
    return textwrap.dedent("\n".join([lines[0].strip(), *lines[1:]])).strip()


def documentation(comment):
    """A comment as reStructuredText; indented lists of arguments as definitions."""
    parts = []
    for block in blocks(plain(comment).splitlines()):
        parts += [*lines_of(textwrap.dedent("\n".join(block)).splitlines()), ""]
    return "\n".join(parts)


def statements(text):
    """(comment above, declaration) of each declaration; (comment, "") of a comment that a blank line follows."""
    comment, rest = "", text
    while rest := rest.lstrip("\n"):
        if rest.startswith("/*"):
            end = rest.index("*/") + 2
            comment, rest = rest[:end], rest[end:]
            if rest.startswith("\n\n"):
                yield comment, ""
                comment = ""
        else:
            end = re.search(r";$" if not re.match(r"typedef (struct|enum) \{", rest) else r"^[^\n]*\} \w+;$", rest, re.M).end()
            yield comment, rest[:end]
            comment, rest = "", rest[end:]


def declarations(header):
    """What lies between the lines that are for compilers."""
    text = header[header.index("NOLINTBEGIN"):header.index("NOLINTEND")]
    text = text[text.index("*/") + 2:text.rindex("/*")]
    return re.sub(r"^#define (\w+) .*$", r"macro \1;", text, flags=re.M).replace("FATHOM_API ", "")


def directive(comment, code):
    """The entry of a declaration, in reStructuredText."""
    body = documentation(comment) if comment else ""
    if made := re.fullmatch(r"typedef (struct|enum) \{\n?(.*)\} (\w+);", code, re.S):
        fields = textwrap.indent(textwrap.dedent(made[2]).strip("\n"), "   ")
        if "\n" not in made[2].strip():
            fields = "   " + made[2].strip()
        head, body = f".. c:{made[1]}:: {made[3]}", f"{body}\n.. code-block:: c\n\n{fields}\n"
    elif made := re.fullmatch(r"typedef struct \w+ (\w+);", code):
        head, body = f".. c:type:: {made[1]}", body or "A handle.\n"
    elif made := re.fullmatch(r"macro (\w+);", code):
        head = f".. c:macro:: {made[1]}"
    else:
        head = ".. c:function:: " + " ".join(code.rstrip(";").split())
    return f"{head}\n\n{textwrap.indent(body, '   ')}\n"


def text(header):
    parts, group = [], []
    introduction = documentation(re.match(r"/\*.*?\*/", header.read_text(encoding="utf-8"), re.S)[0])

    def close():
        if group:
            parts.append("```{eval-rst}\n" + "\n".join(group) + "```\n")
            group.clear()

    for comment, code in statements(declarations(header.read_text(encoding="utf-8"))):
        if not code and (title := SECTION.search(comment)):
            close()
            parts.append(f"## {title[1].capitalize()}\n")
        elif code:
            group.append(directive(comment, code))
    close()
    return f"```{{eval-rst}}\n{introduction}```\n\n" + "\n".join(["## Status\n", *parts])
