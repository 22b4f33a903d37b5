#!/usr/bin/python3
"""The table of scenes and renderers in a report, with forty columns and with one: groups, sums, filter, keys.

    tests/browser/overview_page_test.py FATHOM-VALIDATE
"""
import copy
import pathlib
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.keys import Keys

from headless_chromium import headless_chromium
from page_case import PageCase, data_of, with_data

SCENES, VARIANTS = ["sphere", "vertices"], ["default", "robust"]
RENDERERS = [f"renderer-{k:02}" for k in range(20)]
UNEXPLAINED, FOUND, NOT_DRAWN = ("sphere", "renderer-03", "robust"), ("vertices", "renderer-03", "default"), (
    "sphere", "renderer-11", "default")
ABSENT = ("vertices", "renderer-12", "robust")  # so that maps are not scenes times columns
PLACE = "const b = arguments[0].getBoundingClientRect(); return [b.left, b.top]"


def validate(folder, *arguments):
    subprocess.run([PROGRAM, "--against", "embree", "--size", "64x48", "--out", folder, *arguments],
                   check=True, stdout=subprocess.DEVNULL)
    return (folder / "report.html").read_text()


# Of the report that of_many_renderers() makes.
VERDICT = "failed: 2 of 78 maps; 1 not drawn; the first is made up"


def name_of(result):
    return result["scene"], result["renderer"], result["variant"]


def of_many_renderers(page):
    """The report of a renderer as that of twenty, one of which has unexplained pixels and a finding, one of which
    did not draw once, and one of which was not asked to."""
    results, maps = [], []
    report, stored = data_of(page, "report"), data_of(page, "maps")
    for renderer in RENDERERS:
        for result, drawn in zip(report["results"], stored["maps"]):
            result = copy.deepcopy(result) | {"renderer": renderer}
            if name_of(result) == ABSENT:
                continue
            if name_of(result) == UNEXPLAINED:
                result["pixels"] |= {"unexplained": 7, "equal": result["pixels"]["equal"] - 7}
            if name_of(result) == FOUND:
                result["findings"] = [{"kind": "missing-triangle", "text": "triangle 3 is missing", "pixels": 1}]
            if name_of(result) == NOT_DRAWN:
                names = {key: result[key] for key in ("scene", "renderer", "variant", "version")}
                result, drawn = names | {"failure": "it crashed"}, None
            results.append(result)
            maps.append(drawn)
    return with_data(with_data(page, "report", report | {"results": results, "verdict": VERDICT}), "maps", stored | {"maps": maps}), results


def sums_of(results):
    drawn = [r for r in results if "failure" not in r]
    return [sum(r["pixels"]["unexplained"] for r in drawn), sum(len(r["findings"]) for r in drawn),
            len(results) - len(drawn)]


class FortyColumns(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-overview-")))
        page, cls.results = of_many_renderers(validate(cls.folder, "--scene", ",".join(SCENES)))
        (cls.folder / "wide.html").write_text(page)
        cls.driver = cls.enterClassContext(headless_chromium())

    def setUp(self):
        self.driver.get((self.folder / "wide.html").as_uri())

    def cell(self, name):
        number = [name_of(r) for r in self.results].index(name)
        return self.one(f'#matrix button[data-case="{number}"]')

    def cells(self, such_as):
        """What they are called."""
        return [b.get_attribute("aria-label").split(":")[0] for b in self.all("#matrix button" + such_as)]

    def test_maps_are_counted_and_numbers_agree(self):
        self.assertEqual(len(self.results), 79)
        self.assertEqual(self.text("#verdict").split(". Fathom")[0],
                         "Failed: 2 of 78 maps; 1 not drawn; the first is made up. "
                         "78 maps of 2 scenes: 7 pixels unexplained, 1 finding, 1 not drawn")

    def test_variants_stand_below_their_renderer(self):
        groups = self.all("#matrix th[scope=colgroup]")
        self.assertEqual([(g.get_attribute("textContent"), g.get_attribute("colspan")) for g in groups],
                         [(renderer, "2") for renderer in RENDERERS] + [("all", "3")])
        self.assertEqual(self.texts("#matrix thead tr:nth-child(2) th"),
                         VARIANTS * 20 + ["unexplained", "findings", "not drawn"])
        # What is above a cell is what it is called.
        for result in self.results[::7]:
            left, _ = self.driver.execute_script(PLACE, self.cell(name_of(result)))
            group = next(g for g in groups if g.get_attribute("textContent") == result["renderer"])
            start, _ = self.driver.execute_script(PLACE, group)
            self.assertTrue(start <= left < start + group.size["width"], result["renderer"])

    def test_the_table_scrolls_and_the_page_does_not(self):
        for width in (1920, 1280, 390):
            self.resize(width, 900)
            with self.subTest(width=width):
                self.assertLessEqual(self.how_far_it_scrolls_sideways("html"), 0)
                self.assertGreater(self.how_far_it_scrolls_sideways(".overview"), 0)
                self.expect_nothing_cut_off("#matrix")

    def test_scenes_and_renderers_stay_in_sight(self):
        table, scenes = self.one(".overview"), self.all("#matrix tbody th")
        kept = [*scenes, self.one("#matrix .corner")]
        before = [self.driver.execute_script(PLACE, e)[0] for e in kept]
        self.driver.execute_script("arguments[0].scrollLeft = 700", table)
        self.assertEqual([self.driver.execute_script(PLACE, e)[0] for e in kept], before)
        self.resize(1280, 120)
        self.driver.execute_script("arguments[0].scrollTop = 60; arguments[0].scrollIntoView()", table)
        self.assertEqual(self.driver.execute_script("return arguments[0].scrollTop", table), 60)
        top = self.driver.execute_script(PLACE, table)[1]
        head = self.driver.execute_script(PLACE, self.one("#matrix thead"))[1]
        self.assertAlmostEqual(head, top, delta=2)  # the border
        # The renderer's name stays while one of its columns does.
        name = self.all("#matrix th[scope=colgroup]")[4].find_element("tag name", "span")
        group = self.all("#matrix th[scope=colgroup]")[4]
        self.driver.execute_script(
            "arguments[0].scrollLeft = arguments[1].offsetLeft + 30 - arguments[2].offsetWidth", table, group, kept[0])
        self.assertGreater(self.driver.execute_script(PLACE, name)[0],
                           before[-1] + kept[-1].size["width"])

    def expect_sums_of(self, shown):
        columns = sorted({(r["renderer"], r["variant"]) for r in shown})
        scenes = sorted({r["scene"] for r in shown})
        for scene, cells in zip(scenes, self.table("#matrix tbody")):
            self.assertEqual(cells[0], scene)
            self.assertEqual([int(c) for c in cells[-3:]], sums_of([r for r in shown if r["scene"] == scene]), scene)
        foot = self.table("#matrix tfoot")
        self.assertEqual([cells[0] for cells in foot], ["unexplained", "findings", "not drawn", "by renderer"])
        for k, column in enumerate(columns):
            self.assertEqual([int(cells[k + 1]) for cells in foot[:3]],
                             sums_of([r for r in shown if (r["renderer"], r["variant"]) == column]), column)
        whole = sums_of(shown)
        for k, cells in enumerate(foot[:3]):
            self.assertEqual(cells[-3:], [str(whole[k]) if j == k else "" for j in range(3)])
        for renderer in {r["renderer"] for r in shown}:
            unexplained, findings, failures = sums_of([r for r in shown if r["renderer"] == renderer])
            parts = ([f"{unexplained} unexplained"] * bool(unexplained)
                     + ["1 finding" if findings == 1 else f"{findings} findings"] * bool(findings)
                     + [f"{failures} not drawn"] * bool(failures))
            self.assertEqual(self.texts(f'#matrix [data-renderer="{renderer}"]'),
                             [", ".join(parts or ["0 unexplained"])])

    def expect_shown(self, shown):
        """In both tables, and counted."""
        self.assertEqual(self.text("#filter-said"), f"{len(shown)} of 79 results")
        numbers = [int(b.get_attribute("data-case")) for b in self.all("#matrix tbody button")]
        self.assertEqual(sorted(map(name_of, (self.results[n] for n in numbers))), sorted(map(name_of, shown)))
        self.assertEqual([(cells[0], cells[1]) for cells in self.table("#all tbody")],
                         [(r["scene"], r["renderer"] + " " + r["variant"]) for r in shown])

    def test_sums_of_columns_rows_and_renderers(self):
        self.expect_shown(self.results)
        self.expect_sums_of(self.results)
        self.assertEqual(sums_of(self.results), [7, 1, 1])

    def test_the_filter_takes_words_in_any_order(self):
        for words, is_meant in (("renderer-03", lambda s, r, v: r == "renderer-03"),
                                ("ROBUST  renderer-1", lambda s, r, v: r.startswith("renderer-1") and v == "robust"),
                                ("sphere", lambda s, r, v: s == "sphere"),
                                ("", lambda s, r, v: True)):
            with self.subTest(words=words):
                self.filter(words)
                shown = [r for r in self.results if is_meant(*name_of(r))]
                self.expect_shown(shown)
                self.expect_sums_of(shown)

    def test_the_filter_shows_what_is_not_explained(self):
        self.filter(only_open=True)
        shown = [r for r in self.results if name_of(r) in (UNEXPLAINED, FOUND, NOT_DRAWN)]
        self.assertEqual(len(shown), 3)
        self.expect_shown(shown)
        self.expect_sums_of(shown)
        self.filter("renderer-11", only_open=True)
        self.expect_shown([r for r in shown if name_of(r) == NOT_DRAWN])
        self.filter("no such thing", only_open=True)
        self.assertEqual(self.table("#matrix"), [["Nothing matches the filter."]])
        self.filter()
        self.expect_shown(self.results)

    def test_cells_say_what_is_wrong(self):
        good = "sphere", "renderer-00", "default"
        for name, text, style in ((UNEXPLAINED, "7", "fault"), (FOUND, "missing-triangle", "fault"),
                                  (NOT_DRAWN, "not drawn", "none"), (good, "0", "good")):
            cell = self.cell(name)
            self.assertEqual(cell.get_attribute("textContent"), text)
            self.assertIn(style, cell.find_element("xpath", "..").get_attribute("class").split())
            self.assertTrue(cell.get_attribute("aria-label").startswith(f"{name[0]}, {name[1]} {name[2]}: "))
        self.assertIn("1 finding", self.text("#verdict"))
        self.driver.execute_script("arguments[0].click()", self.cell(FOUND))
        self.wait_for(lambda: "renderer-03 default" in self.text("#title"), "the result")
        self.assertEqual(self.texts("#findings .finding"), ["triangle 3 is missing (1 pixel)"])

    def test_a_result_has_a_link(self):
        self.assertEqual(self.text("#title"), "sphere, renderer-03 robust")  # the first that is not explained
        self.driver.execute_script("arguments[0].click()", self.cell(("vertices", "renderer-07", "robust")))
        link = self.driver.current_url
        self.driver.get("about:blank")
        self.driver.get(link)
        self.assertEqual(self.text("#title"), "vertices, renderer-07 robust")
        self.assertEqual(self.cells("[aria-pressed=true]"), ["vertices, renderer-07 robust"])

    def focused(self):
        return name_of(self.results[int(self.driver.switch_to.active_element.get_attribute("data-case"))])

    def test_keys_lead_from_cell_to_cell(self):
        self.assertEqual(len(self.cells("[tabindex='0']")), 1)
        self.cell(("sphere", "renderer-12", "default")).send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.focused(), ("sphere", "renderer-12", "robust"))
        self.driver.switch_to.active_element.send_keys(Keys.ARROW_DOWN)  # there is no map below
        self.assertEqual(self.focused(), ("sphere", "renderer-12", "robust"))
        self.driver.switch_to.active_element.send_keys(Keys.ARROW_LEFT + Keys.ARROW_DOWN + Keys.ARROW_RIGHT)
        self.assertEqual(self.focused(), ("vertices", "renderer-13", "default"))
        self.driver.switch_to.active_element.send_keys(Keys.ENTER)
        self.wait_for(lambda: self.text("#title") == "vertices, renderer-13 default", "the result")
        self.assertEqual(self.cells("[tabindex='0']"), ["vertices, renderer-13 default"])
        # What has the focus is not below what stays in sight.
        corner = self.one("#matrix .corner")
        left, _ = self.driver.execute_script(PLACE, self.driver.switch_to.active_element)
        self.assertGreaterEqual(left + 1, self.driver.execute_script(PLACE, corner)[0] + corner.size["width"])

    def test_words_are_explained(self):
        self.assertEqual(self.texts("#all thead a.term"),
                         ["equal", "within quantization", "within arithmetic", "edge", "z-fight", "missed surface",
                          "convention", "unexplained", "bound", "may"])
        self.assertTrue({"must", "finding", "not drawn"} <= set(self.texts("#words dt")))
        self.expect_words_explained()


class OneColumn(PageCase):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-overview-")))
        validate(folder, "--scene", "sphere", "--variants", "robust")
        cls.driver = cls.enterClassContext(headless_chromium())
        cls.driver.get((folder / "report.html").as_uri())

    def test_one_map_needs_no_sums_and_no_filter(self):
        self.assertIn("1 map of 1 scene: every pixel is explained", self.text("#verdict"))
        self.assertEqual(self.table("#matrix"), [["scene", "embree"], ["robust"], ["sphere", "0"]])
        self.assertFalse(self.one("#filter").is_displayed())
        for width in (1280, 390):
            self.resize(width, 900)
            self.assertLessEqual(self.how_far_it_scrolls_sideways("html"), 0)
            self.assertLessEqual(self.how_far_it_scrolls_sideways(".overview"), 0)
            self.expect_nothing_cut_off("#matrix")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
