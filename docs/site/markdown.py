"""What links and headings of a Markdown page are, by GitHub's rules."""

import re

LINK = re.compile(r"\]\(\s*<?([^()<>\s]*(?:\([^()\s]*\)[^()<>\s]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
FENCE = re.compile(r"^ *(```|~~~)")
CODE_SPAN = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)")
SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:")


def prose(text):
    """The lines of a page with their numbers, without code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced:
            yield number, line


def slug(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def anchors(text):
    """What a link to the page can have behind its #."""
    found, seen = set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text)), {}
    for _, line in prose(text):
        if heading := re.match(r" {0,3}#{1,6} +(.*?)(?: +#+)? *$", line):
            name = slug(heading[1])
            count = seen[name] = seen.get(name, -1) + 1
            found.add(f"{name}-{count}" if count else name)
    return found


def with_targets(text, changed):
    """The page with each target of a link or picture replaced by changed(target); code and addresses with a scheme
    stay."""
    fenced, lines = False, []
    for line in text.splitlines(keepends=True):
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced:
            line = _with_targets_in_line(line, changed)
        lines.append(line)
    return "".join(lines)


def _with_targets_in_line(line, changed):
    code = [span.span() for span in CODE_SPAN.finditer(line)]

    def replaced(link):
        target = link[1]
        if SCHEME.match(target) or any(begin < link.start() < end for begin, end in code):
            return link[0]
        return link[0].replace(target, changed(target), 1) if target else link[0]

    return LINK.sub(replaced, line)
