#!/usr/bin/python3
"""Runs the snippets of pages, and compares what they print with what the page shows.

    pages.py [--draw] PAGE…             FATHOM_PROGRAM: for pages with commands

Blocks of a page are run in order in a new folder where `data` is this repository's:

- Python, as one program; a block that follows "prints" is what the last one prints;
- JSON becomes the file that the text before it names last, as in `camera.json`;
- in a block without a language, what follows "$ " is run by bash, and the lines below are what it prints. Where lines
  are broken does not matter there, and a line "…" stands for any lines.

Pictures of the page in docs/images that have the name of a file which its commands write have to be that file, byte for
byte; --draw replaces them by it.
"""

import contextlib
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^(prints\n\n)?```([^\n]*)\n(.*?)^```$", re.S | re.M)
COMMAND = re.compile(r"^\$ (.*(?:(?<=\\)\n.*)*)\n((?:(?!\$ ).*\n)*)", re.M)
PICTURE = re.compile(r"\]\(((?:\.\./)?images/([\w-]+\.png))\)")
NAMED_JSON = re.compile(r"`([\w-]+\.json)`")


def run_page(page, draws=False):
    """(what the page shows, what was printed or drawn) for each block that shows something, and for each picture."""
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
            pairs += pictures_of((root / page).parent, text, draws)
        finally:
            os.chdir(back)
    return pairs


def pictures_of(folder, text, draws):
    """(the picture of the page, the picture that was drawn), as hashes, for each file of this name."""
    drawn = [(folder / link, pathlib.Path(name)) for link, name in PICTURE.findall(text) if pathlib.Path(name).exists()]
    for shown, made in drawn:
        if draws:
            shutil.copyfile(made, shown)
    return [tuple(f"{made} {hashlib.sha256(file.read_bytes()).hexdigest()}" for file in (shown, made)) for shown, made in drawn]


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
    draws = "--draw" in sys.argv[1:]
    for page in sys.argv[1 + draws:]:
        for shown, told in run_page(page, draws):
            if shown != told:
                sys.exit(f"{page}: shows\n{shown}\nbut there is printed or drawn\n{told}")
        print(f"{page}: prints what it shows")


if __name__ == "__main__":
    main()
