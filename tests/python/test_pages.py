"""Snippets of pages print what the page shows, in Python and on the command line."""

import os
import pathlib

import pytest

from pages import as_shown, run_page

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
pages = ["README.md", "lib/python/README.md",
         *(f"docs/{name}.md" for name in ("areas-satellite", "areas-window", "coverage", "data-sets", "depth-formats", "doctor",
                                          "evaluation", "farms", "index", "lenses", "python", "rays",
                                          "reference/exit-statuses")),
         *(f"docs/guides/{page.name}" for page in sorted((source / "docs/guides").glob("*.md")))]


@pytest.mark.parametrize("page", pages)
def test_snippets_of_pages_print_what_the_page_shows(page):
    pairs = run_page(page)
    assert pairs
    for shown, told in pairs:
        assert shown == told


def test_a_page_that_shows_something_else_is_noticed():
    assert as_shown("a b\n  c\n", "a\nb c\n") == ("abc", "abc")
    assert as_shown("a\n…\nd\n", "a\nb\nc\nd\n") == ("a…d", "a…d")
    shown, told = as_shown("a\n…\nd\n", "a\nb\ne\n")
    assert shown != told
    shown, told = as_shown("a\n", "a\nb\n")
    assert shown != told
