#!/usr/bin/python3
"""Runs the snippets of pages, and compares what they print with what the page shows.

    pages.py PAGE…                      FATHOM_PROGRAM: for pages with commands

Blocks of a page are run in order in a new folder where `data` is this repository's:

- Python, as one program; a block that follows "prints" is what the last one prints;
- JSON becomes the file that the text before it names last, as in `camera.json`;
- in a block without a language, what follows "$ " is run by bash, and the lines below are what it prints. Where lines
  are broken does not matter there, and a line "…" stands for any lines.
"""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^(prints\n\n)?```([^\n]*)\n(.*?)^```$", re.S | re.M)
COMMAND = re.compile(r"^\$ (.*(?:(?<=\\)\n.*)*)\n((?:(?!\$ ).*\n)*)", re.M)
NAMED_JSON = re.compile(r"`([\w-]+\.json)`")


def run_page(page):
    """(what the page shows, what was printed) for each block that shows something."""
    text = (root / page).read_text(encoding="utf-8")
    names = {"__name__": "page"}
    told, pairs = "", []
    back = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.symlink(root / "data", "data")
        try:
            for block in BLOCK.finditer(text):
                prints, language, body = block.groups()
                if language == "python":
                    told = run_python(body, page, names)
                elif language == "json":
                    pathlib.Path(NAMED_JSON.findall(text[:block.start()])[-1]).write_text(body, encoding="utf-8")
                elif prints:
                    pairs.append((body, told))
                elif not language:
                    pairs += [run_command(*command) for command in COMMAND.findall(body)]
        finally:
            os.chdir(back)
    return pairs


def run_python(text, page, names):
    with contextlib.redirect_stdout(io.StringIO()) as output:
        exec(compile(text, str(page), "exec"), names)
    return output.getvalue()


def run_command(command, shown):
    """What the page shows and what was printed, both without blanks."""
    programs = os.path.dirname(os.path.abspath(os.environ["FATHOM_PROGRAM"]))
    # It has a sanitizer of its own, if this process was given one.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    environment["PATH"] = f"{programs}:{environment['PATH']}"
    ran = subprocess.run(["/bin/bash", "-c", command], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         text=True)
    if ran.returncode:
        raise AssertionError(f"$ {command}\nended with exit status {ran.returncode}:\n{ran.stdout}")
    return as_shown(shown, ran.stdout)


def as_shown(shown, told):
    """Both without blanks; what a line "…" stands for is left out of what was told."""
    parts = ["".join(part.split()) for part in re.split(r"^\s*…\n", shown, flags=re.M)]
    told = "".join(told.split())
    pattern = ".*?".join(map(re.escape, parts))
    return "…".join(parts), "…".join(parts) if re.fullmatch(pattern, told, re.S) else told


def main():
    for page in sys.argv[1:]:
        for shown, told in run_page(page):
            if shown != told:
                sys.exit(f"{page}: shows\n{shown}\nbut there is printed\n{told}")
        print(f"{page}: prints what it shows")


if __name__ == "__main__":
    main()
