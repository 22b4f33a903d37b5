#!/usr/bin/python3
"""The page that `fathom study course` writes: all its pictures are there, and it shows all that were drawn.

    tests/browser/course_page_test.py FATHOM-STUDY
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from headless_chromium import errors_in_console, headless_chromium
from page_case import expect_readable_in_the_dark

# The page has loaded when all its pictures have, or cannot be.
WIDTHS_OF_PICTURES = """
return Object.fromEntries([...document.images].map((i) => [i.getAttribute("src"), i.naturalWidth]));
"""


class CoursePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-course-")))
        subprocess.run([PROGRAM, "course", "--out", cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.driver = cls.enterClassContext(headless_chromium())
        cls.driver.get((cls.folder / "index.html").as_uri())

    def tearDown(self):
        self.assertEqual(errors_in_console(self.driver), [])

    def test_every_picture_that_was_drawn_is_shown(self):
        widths = self.driver.execute_script(WIDTHS_OF_PICTURES)
        self.assertEqual(sorted(widths), sorted(file.name for file in self.folder.glob("*.png")))
        self.assertTrue(widths)
        for name, width in widths.items():
            self.assertGreater(width, 0, name)

    def test_it_is_readable_in_the_dark(self):
        expect_readable_in_the_dark(self, self.driver)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
