"""What Debian's furo (2022.12.07) lacks, put right in the built site; a furo without these faults stays as it is.

Debian builds the theme with other tools than its authors: its script imports another file, which a browser refuses in a
page that is opened from a folder; its style sheet takes a file from the root of a web server; and the colours of dark
systems got lost, those of the switch alone are there.
"""

import pathlib
import re

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
IMPORTED_SCRIPT = re.compile(r'^import Gumshoe from "\./(gumshoe-patched\.js)";\n', re.M)
IMPORTED_STYLE = re.compile(r"^@import url\(/javascript/normalize\.css/normalize\.css\);\n")
DARK = re.compile(r'@media not print \{\s*body\[data-theme="dark"\] \{(.*?)\}', re.S)


def changed(file, change):
    if file.exists():
        file.write_text(change(file.read_text(encoding="utf-8")), encoding="utf-8")


def script(folder):
    def with_gumshoe(text):
        return IMPORTED_SCRIPT.sub(lambda found: (folder / found[1]).read_text(encoding="utf-8") + "\n", text)

    return with_gumshoe


def style(text):
    text = IMPORTED_STYLE.sub(lambda _: NORMALIZE.read_text(encoding="utf-8"), text)
    dark = DARK.search(text)
    if dark and "prefers-color-scheme" not in text:
        text += f'\n@media (prefers-color-scheme: dark) {{ body[data-theme="auto"] {{{dark[1]}}} }}\n'
    return text


def repair(app, exception):
    """For build-finished."""
    if exception is None and app.builder.format == "html":
        static = pathlib.Path(app.outdir, "_static")
        changed(static / "scripts/furo.js", script(static / "scripts"))
        changed(static / "styles/furo.css", style)
