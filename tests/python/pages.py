#!/usr/bin/python3
"""Runs the snippets of pages, and compares what they print with what the page shows.

    pages.py PAGE…

Blocks of a page are run in order, as one program, in a new folder where `data` is this repository's; a block that
follows "prints" is what the last one prints.
"""

import contextlib
import io
import os
import pathlib
import re
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent


def run_page(page):
    """(what the page shows, what was printed) for each block that shows something."""
    blocks = re.findall(r"(prints\n\n)?```(\w*)\n(.*?)```", (root / page).read_text(), re.S)
    names = {"__name__": "page"}
    told, pairs = "", []
    back = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.symlink(root / "data", "data")
        try:
            for prints, language, text in blocks:
                if language == "python":
                    with contextlib.redirect_stdout(io.StringIO()) as output:
                        exec(compile(text, str(page), "exec"), names)
                    told = output.getvalue()
                elif prints:
                    pairs.append((text, told))
        finally:
            os.chdir(back)
    return pairs


def main():
    for page in sys.argv[1:]:
        for shown, told in run_page(page):
            if shown != told:
                sys.exit(f"{page}: shows\n{shown}but the snippet prints\n{told}")
        print(f"{page}: prints what it shows")


if __name__ == "__main__":
    main()
