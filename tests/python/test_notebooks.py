"""Notebooks keep the outputs that their cells have."""

import json
import os
import pathlib

import pytest

from notebooks import outputs_of, run_notebook, text_of, without_pictures

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
notebooks = sorted((source / "docs/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("file", notebooks, ids=lambda file: file.name)
def test_outputs_are_those_of_the_cells(file):
    kept = file.read_text(encoding="utf-8")
    notebook = json.loads(kept)
    assert kept == text_of(notebook)
    assert notebook["nbformat"] == 4 and any(cell["cell_type"] == "code" for cell in notebook["cells"])
    assert without_pictures(run_notebook(file)) == without_pictures(notebook)


def test_there_is_a_notebook():
    assert notebooks


def test_a_cell_that_has_other_outputs_is_noticed():
    names = {}
    assert outputs_of("x = 2\nprint(x)", names) == [{"name": "stdout", "output_type": "stream", "text": ["2\n"]}]
    (result,) = outputs_of("x + 1", names)
    assert result["data"] == {"text/plain": ["3"]}
    kept = {"cells": [{"outputs": [{"data": {"text/plain": ["4"]}}]}]}
    assert without_pictures(kept) != without_pictures({"cells": [{"outputs": [result]}]})
