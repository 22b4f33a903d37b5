"""The sources of the site, made of the repository's pages in a folder of their own.

    stage.py FOLDER                 FATHOM_PROGRAM: the program whose help becomes pages

Pages of docs/ lie at the top, all others (READMEs of rooms, CONTRIBUTING, …) below repository/. Links between pages are
led to where these lie now; other files of the repository that a page links to are copied and opened as text. What a
page marks with <!-- site: NAME --> is made here: help, the C header, the Python module, lists of pages.
"""

import os
import pathlib
import posixpath
import re
import shutil
import sys
import urllib.parse

import command_pages
import header_page
import python_page
from markdown import with_targets

root = pathlib.Path(__file__).resolve().parent.parent.parent
MARK = re.compile(r"<!-- site: ([\w-]+) -->\n")
# A file that a browser would download rather than show.
SHOWN = {".html", ".png", ".svg", ".json", ".txt", ".pdf"}


def pages_of_the_repository():
    """Path in the repository: name in the site, both with slashes and suffix."""
    built = {root / "build", root / "install"}
    found = sorted(page for pattern in ("docs/**/*.md", "*.md", "**/README.md") for page in root.glob(pattern)
                   if not built & set(page.parents))
    paths = [page.relative_to(root).as_posix() for page in found]
    return {path: path.removeprefix("docs/") if path.startswith("docs/") else f"repository/{path}" for path in paths}


class Stage:
    def __init__(self, folder):
        self.folder = folder
        self.pages = pages_of_the_repository()

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        # What has not changed stays as old as it is, and is not built again.
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")

    def staged_target(self, path, target):
        """Where a link of the page `path` leads in the site."""
        where, _, anchor = target.partition("#")
        if not where:
            return target
        end = posixpath.normpath(posixpath.join(posixpath.dirname(path), urllib.parse.unquote(where)))
        if (root / end).is_dir():
            end = posixpath.join(end, "README.md") if posixpath.join(end, "README.md") in self.pages else end
        here = posixpath.dirname(self.pages[path])
        if end in self.pages:
            return posixpath.relpath(self.pages[end], here or ".") + ("#" + anchor if anchor else "")
        return posixpath.relpath(self.copied(end), here or ".")

    def copied(self, path):
        """A file that is no page, or a list of the files of a folder: where it lies in the site's sources."""
        source = root / path
        if source.is_dir():
            name = f"files/{path}.txt"
            self.write(name, "\n".join(sorted(p.name for p in source.iterdir())) + "\n")
            return name
        name = f"files/{path}" if source.suffix in SHOWN else f"files/{path}.txt"
        place = self.folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, place)
        return name

    def page(self, path, made):
        """Writes a page of the repository; `made` gives what stands for a mark, by its name."""
        text = (root / path).read_text(encoding="utf-8")
        text = with_targets(text, lambda target: self.staged_target(path, target))
        text = MARK.sub(lambda mark: made[mark[1]](), text)
        self.write(self.pages[path], text)


def toctree(names, caption="", depth=1):
    head = f":caption: {caption}\n" if caption else ""
    return f"```{{toctree}}\n:hidden:\n:maxdepth: {depth}\n{head}\n" + "\n".join(names) + "\n```\n"


def contents_of(stage):
    """The menu: each heading of docs/index.md that has links to pages, with these, in their order."""
    trees, caption, names = [], "", []
    text = (root / "docs/index.md").read_text(encoding="utf-8")
    for line in [*text.splitlines(), "## "]:
        if line.startswith("## "):
            trees += [toctree(names, caption)] if names else []
            caption, names = line[3:], []
        elif link := re.match(r"- \[([^\]]*)\]\(([^)#]+\.md)\)", line):
            path = posixpath.normpath(posixpath.join("docs", link[2]))
            names.append(f"{link[1]} </{stage.pages[path].removesuffix('.md')}>")
    return "\n".join(trees)


def other_pages(stage):
    """The pages outside docs/, listed and in the menu."""
    paths = sorted(path for path in stage.pages if not path.startswith("docs/"))
    rows = [f"- [{path}]({stage.pages[path]})" for path in paths]
    return "\n".join(rows) + "\n\n" + toctree([f"{path} </{stage.pages[path].removesuffix('.md')}>" for path in paths])


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    stage = Stage(folder)
    commands = command_pages.read_commands(os.environ["FATHOM_PROGRAM"])
    for name, text in command_pages.pages(commands):
        stage.write(f"reference/commands/{name}.md", text)
    made = {
        "contents": lambda: contents_of(stage),
        "commands": lambda: command_pages.overview(commands),
        "python": python_page.text,
        "c": lambda: header_page.text(root / "lib/c/fathom.h"),
        "repository": lambda: other_pages(stage),
    }
    for path in stage.pages:
        stage.page(path, made)
    for page in set(folder.rglob("*.md")) - {folder / name for name in stage.pages.values()}:
        if page.parent != folder / "reference/commands" or page.stem not in {name for name, _ in command_pages.pages(commands)}:
            page.unlink()  # of an earlier build


if __name__ == "__main__":
    main()
