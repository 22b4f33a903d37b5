#!/usr/bin/python3
"""The comparison that `fathom validate --baseline` writes: every change is there, and is what it is called.

    tests/browser/comparison_page_test.py FATHOM-VALIDATE
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from headless_chromium import headless_chromium
from page_case import PageCase

CHANGES = {  # what the baseline is made to be
    ("sphere", "default"): "better", ("sphere", "robust"): "worse",
    ("vertices", "default"): "changed", ("vertices", "robust"): "new",
    ("grid", "default"): "same", ("grid", "robust"): "not comparable"}
ORDER = ["worse", "better", "changed", "same", "new", "gone", "not comparable"]


def made_so(result, change):
    """A result of the baseline with which that of this run is `change`; None where it is new."""
    pixels = result["pixels"]
    if change == "better":
        pixels |= {"unexplained": 5, "equal": pixels["equal"] - 5}
        result["findings"] = [{"kind": "shift", "text": "the image is shifted", "pixels": 1}]
    if change == "worse":
        pixels |= {"equal": pixels["equal"] + 1, "within arithmetic": pixels["within arithmetic"] - 1}
    if change == "changed":
        result["errors"]["median_relative"] *= 2
        result["version"] = "an older one"
    if change == "not comparable":
        result["width"] *= 2
    return None if change == "new" else result


class ComparisonPage(PageCase):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-comparison-")))
        command = [PROGRAM, "--against", "embree", "--scene", "sphere,vertices,grid", "--size", "64x48"]
        subprocess.run([*command, "--out", folder / "before"], check=True, stdout=subprocess.DEVNULL)
        baseline = json.loads((folder / "before/report.json").read_text())
        cls.now = {(r["scene"], r["variant"]): r["pixels"] for r in json.loads(json.dumps(baseline))["results"]}
        gone = json.loads(json.dumps(baseline["results"][0])) | {"renderer": "another"}
        made = [made_so(r, CHANGES[r["scene"], r["variant"]]) for r in baseline["results"]]
        baseline["results"] = [r for r in made if r] + [gone]
        (folder / "baseline.json").write_text(json.dumps(baseline))
        status = subprocess.run([*command, "--baseline", folder / "baseline.json", "--out", folder / "now"],
                                check=False, stdout=subprocess.DEVNULL).returncode
        if status != 1:  # something is worse
            raise RuntimeError(f"fathom-validate ended with {status}")
        subprocess.run([*command, "--baseline", folder / "before/report.json", "--out", folder / "again"], check=True,
                       stdout=subprocess.DEVNULL)
        cls.unchanged = (folder / "again/comparison.html").as_uri()
        cls.driver = cls.enterClassContext(headless_chromium())
        cls.page = (folder / "now/comparison.html").as_uri()

    def setUp(self):
        self.driver.get(self.page)

    def test_every_change_is_counted_and_named(self):
        self.assertIn("1 result is worse than in the baseline", self.text("#verdict"))
        self.assertEqual(self.texts("#counts .chip"), ["1 " + verdict for verdict in ORDER])
        self.assertEqual(self.text("#unchanged"), "1 of 7 results has the same counts and errors as before.")
        self.assertIn("1 not.", self.text("#kept"))

    def test_a_run_without_changes_leaves_no_empty_table(self):
        self.driver.get(self.unchanged)
        self.assertEqual(self.text("#unchanged"), "6 of 6 results have the same counts and errors as before.")
        self.assertFalse(self.one(".wide:has(> #changed)").is_displayed())
        self.assertFalse(self.all(".wide #others, .wide:has(> p)"))

    def test_the_overview_shows_which_way_each_went(self):
        self.assertEqual([(g.get_attribute("textContent"), g.get_attribute("colspan"))
                          for g in self.all("#matrix th[scope=colgroup]")],
                         [("embree", "2"), ("another", "1"), ("all", "6")])
        shown = {"better": "5 → 0", "worse": "worse", "changed": "changed", "same": "=", "new": "new: 0",
                 "gone": "gone", "not comparable": "?"}
        rows = {cells[0]: cells[1:4] for cells in self.table("#matrix tbody")}
        for (scene, variant), change in CHANGES.items():
            self.assertEqual(rows[scene][["default", "robust"].index(variant)], shown[change])
        self.assertEqual([rows[scene][2] for scene in ("sphere", "vertices", "grid")], ["gone", "", ""])
        for change in ORDER:
            cells = self.all("#matrix tbody td.is-" + change.replace(" ", "-") + ":not(.sum)")
            self.assertEqual([c.get_attribute("textContent") for c in cells], [shown[change]])

    def test_sums_count_changes_of_columns_and_renderers(self):
        foot = {cells[0]: cells[1:] for cells in self.table("#matrix tfoot")}
        columns = [("embree", "default"), ("embree", "robust"), ("another", "default")]
        counted = [change for change in ORDER if change != "same"]
        for k, change in enumerate(counted):
            in_columns = [sum(c == change and ("embree", name[1]) == column for name, c in CHANGES.items())
                          for column in columns]
            if change == "gone":
                in_columns = [0, 0, 1]
            whole = ["1" if j == k else "" for j in range(len(counted))]
            self.assertEqual(foot[change], [str(n) for n in in_columns] + whole)
        self.assertEqual(self.texts('#matrix [data-renderer="another"]'),
                         ["1 gone"])
        self.assertEqual(self.texts('#matrix [data-renderer="embree"]'),
                         ["1 worse, 1 better, 1 changed, 1 new, 1 not comparable"])

    def test_a_cell_leads_to_its_figures(self):
        for button in self.all("#matrix button"):
            button.click()
            pointed = self.all("tr.pointed")
            self.assertEqual(len(pointed), 1)
            name = button.get_attribute("aria-label").split(": ")
            cells = [c.text for c in pointed[0].find_elements("css selector", "th, td")][:3]
            self.assertEqual([f"{cells[0]}, {cells[1]}", cells[2]], name)
        self.assertEqual(len(self.all("#matrix button")), 6)  # what is the same leads nowhere

    def test_figures_stand_before_and_after(self):
        head, *rows = self.table("#changed")
        self.assertEqual([cells[2] for cells in rows], ["worse", "better", "changed", "not comparable"])
        worse, better = rows[0], rows[1]
        equal = self.now["sphere", "robust"]["equal"]
        self.assertEqual(worse[head.index("equal")], f"{equal + 1} → {equal}")
        self.assertEqual(better[head.index("unexplained")], "5 → 0")
        coloured = [[(c.text, c.get_attribute("class")) for c in r.find_elements("css selector", "td.good, td.fault")]
                    for r in self.all("#changed tbody tr")[:2]]
        self.assertEqual(coloured, [[(f"{equal + 1} → {equal}", "fault")],
                                    [(better[head.index("equal")], "good"), ("5 → 0", "good")]])
        self.assertIn("gone: the image is shifted", better[-1])
        self.assertIn("128x48 pixels in the baseline, 64x48 now", rows[3][-1])
        self.assertEqual(self.texts("#findings div"), ["Gone – sphere, embree default: the image is shifted (1 pixel)"])
        self.assertEqual([cells[:3] for cells in self.table("#others")[1:]],
                         [["vertices", "embree robust", "new"], ["sphere", "another default", "gone"]])

    def test_the_filter_is_for_every_table(self):
        self.filter("sphere embree")
        self.assertEqual(self.text("#filter-said"), "2 of 7 results")
        self.assertEqual([cells[0] for cells in self.table("#matrix tbody")], ["sphere"])
        self.assertEqual([cells[2] for cells in self.table("#changed tbody")], ["worse", "better"])
        self.assertEqual(self.table("#others tbody"), [])
        self.filter(only_open=True)
        self.assertEqual(self.text("#filter-said"), "6 of 7 results")
        self.assertEqual(self.all("#matrix .is-same"), [])

    def test_words_are_explained_and_nothing_is_cut_off(self):
        self.assertTrue(set(ORDER) <= set(self.texts("#words dt")))
        self.expect_words_explained()
        for width in (1280, 390):
            self.resize(width, 900)
            self.assertLessEqual(self.how_far_it_scrolls_sideways("html"), 0)
            for table in ("#matrix", "#changed", "#others"):
                self.expect_nothing_cut_off(table)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
