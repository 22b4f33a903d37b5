#!/usr/bin/python3
"""Runs notebooks, and compares what cells print and return with the outputs that they keep.

    notebooks.py NOTEBOOK…              checks the texts of their outputs, and that pictures are there
    notebooks.py --write NOTEBOOK…      writes the outputs

Cells run in order, in a new folder where `data` is this repository's. A cell's result is the value of its last line, as in
Jupyter, which this needs not.
"""

import ast
import base64
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent


def outputs_of(source, names):
    """Runs a cell. Its outputs, in the form of nbformat 4."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(tree, "cell", "exec"), names)
        result = None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    outputs = []
    if printed.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": printed.getvalue().splitlines(keepends=True)})
    if result is not None:
        outputs.append({"data": representations_of(result), "execution_count": None, "metadata": {},
                        "output_type": "execute_result"})
    return outputs


def representations_of(result):
    found = {"text/plain": repr(result).splitlines(keepends=True)}
    png = getattr(result, "_repr_png_", lambda: None)()
    if png is not None:
        found["image/png"] = base64.b64encode(png).decode("ascii") + "\n"
    elif hasattr(result, "_repr_html_"):
        found["text/html"] = result._repr_html_().splitlines(keepends=True)
    return found


def run_notebook(file):
    """The notebook with new outputs."""
    notebook = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
    names, back = {"__name__": "notebook"}, os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.symlink(root / "data", "data")
        try:
            for cell in notebook["cells"]:
                if cell["cell_type"] == "code":
                    cell["outputs"] = outputs_of("".join(cell["source"]), names)
        finally:
            os.chdir(back)
    return notebook


def without_pictures(notebook):
    """Pictures depend on the version of the library that draws letters."""
    for cell in notebook["cells"]:
        for output in cell.get("outputs", []):
            for kind in output.get("data", {}):
                if kind == "image/png":
                    output["data"][kind] = "a picture"
    return notebook


def text_of(notebook):
    return json.dumps(notebook, ensure_ascii=False, indent=1, sort_keys=True) + "\n"


def main():
    files = [each for each in sys.argv[1:] if each != "--write"]
    for file in map(pathlib.Path, files):
        found, kept = run_notebook(file), json.loads(file.read_text(encoding="utf-8"))
        if "--write" in sys.argv:
            file.write_text(text_of(found), encoding="utf-8")
        elif without_pictures(found) != without_pictures(kept):
            sys.exit(f"{file}: keeps other outputs than its cells have now: notebooks.py --write {file}")
        print(f"{file}: its outputs are those of its cells")


if __name__ == "__main__":
    main()
