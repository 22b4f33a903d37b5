#!/usr/bin/python3
"""The report that `fathom validate` writes, as a reader meets it: opened from a file, clicked, pointed at.

    tests/browser/report_page_test.py FATHOM-VALIDATE
"""
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.action_chains import ActionChains

from headless_chromium import headless_chromium
from page_case import PageCase, expect_readable_in_the_dark, prefer

WIDTH, HEIGHT = 64, 48
PIXELS = 5  # of each result that are looked at
READING = re.compile(r"pixel \((\d+), (\d+)\): ([a-z -]+?)(?:, triangle \d+)?\n"
                     r"truth (\S+)   other (\S+)\ndifference [^\n]+\n([a-z -]+): (.+)$")

COLOUR_OF_PIXEL = """
const [canvas, x, y] = arguments;
return Array.from(canvas.getContext("2d").getImageData(x, y, 1, 1).data).slice(0, 3);
"""
COLOUR_OF_CLASS = """
const row = [...document.querySelectorAll("#classes tr")].find((r) => r.cells[0].textContent == arguments[0]);
return getComputedStyle(row.querySelector(".key")).backgroundColor.match(/\\d+/g).map(Number);
"""
SIZE = "return [arguments[0].width, arguments[0].height]"
DOTS = "return [...document.querySelectorAll('#scatter circle')].map((c) => [c.cx.baseVal.value, c.cy.baseVal.value])"
STYLES = """
return [...document.querySelectorAll("#formats polyline.sample")].map((line) => {
  const marker = line.nextSibling, label = marker.nextSibling, box = label.getBoundingClientRect();
  return {dashes: line.getAttribute("stroke-dasharray"), marker: marker.getAttribute("d"),
          hollow: marker.getAttribute("fill") == "#fff", name: label.textContent, top: box.top, bottom: box.bottom};
});
"""
# The page's own plot, of as many lines as renderers and variants there can be, all at one place.
CROWD = """
const plot = axes(1, 2, 1e-8, 1e-5, {W: 680, H: 440, right: 225});
labelLines(plot, Array.from({length: 36}, (_, j) => (
  {style: styleOf(j), name: "line " + j, points: [[60, 100], [400, 100]], end: 100, width: 1})));
document.querySelector("#formats").replaceChildren(plot.svg);
"""
LINES = "return [...document.querySelectorAll('#formats polyline.format')].map((line) => line.getAttribute('points'))"
WHITE = [255, 255, 255]  # background, in pictures of depth


def as_binary32(depth):
    """A number of report.json, null for background, as maps store it."""
    return float("inf") if depth is None else struct.unpack("f", struct.pack("f", depth))[0]


def as_shown(text):
    return float("inf") if text == "background" else float(text)


class ReportPage(PageCase):
    @classmethod
    def setUpClass(cls):
        # Rays exactly through corners, some of which slip through, beside a scene without faults.
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-report-")))
        subprocess.run([PROGRAM, "--against", "embree", "--scene", "sphere,vertices",
                        "--size", f"{WIDTH}x{HEIGHT}", "--out", folder],
                       check=True, stdout=subprocess.DEVNULL)
        cls.results = json.loads((folder / "report.json").read_text())["results"]
        cls.driver = cls.enterClassContext(headless_chromium())
        cls.driver.get((folder / "report.html").as_uri())

    def show(self, number):
        """Clicks the cell of a result and waits for its pictures and plots."""
        result = self.results[number]
        with self.redrawn():
            self.one(f'#matrix button[data-case="{number}"]').click()
        self.assertEqual(self.text("#title"), f"{result['scene']}, {result['renderer']} {result['variant']}")
        return result

    def point_at(self, canvas, x, y):
        """Moves the mouse to the middle of a pixel; what the page then says of it."""
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        size = canvas.size  # with a border of one pixel
        ActionChains(self.driver, duration=0).move_to_element_with_offset(
            canvas, round((x + 0.5) / WIDTH * (size["width"] - 2) + 1 - size["width"] / 2),
            round((y + 0.5) / HEIGHT * (size["height"] - 2) + 1 - size["height"] / 2)).perform()
        return READING.match(self.text("#reading"))

    def meaning(self, word):
        """As the list of words has it."""
        return self.texts("#words dd")[self.texts("#words dt").index(word)]

    def colour(self, canvas, x, y):
        return self.driver.execute_script(COLOUR_OF_PIXEL, canvas, x, y)

    def test_the_table_has_a_cell_for_each_result(self):
        self.assertEqual(len(self.results), 4)
        self.assertIn("4 maps of 2 scenes: every pixel is explained", self.text("#verdict"))
        self.assertEqual([cell.text for cell in self.all("#matrix button")], ["0"] * 4)

    def test_it_is_readable_in_the_dark(self):
        self.show(0)
        expect_readable_in_the_dark(self, self.driver, self.redrawn)

    def test_plots_and_pictures_are_dark_in_the_dark(self):
        self.show(0)
        paper = []
        for scheme in ("dark", "light"):
            with self.redrawn():
                prefer(self.driver, scheme)
            paper.append(self.colour(self.one("#maps-shown canvas"), 0, 0))
            plots = self.driver.execute_script("return getComputedStyle(document.querySelector('#formats svg')).filter")
            self.assertEqual("invert" in plots, scheme == "dark")
        self.assertEqual(paper, [[23, 27, 33], WHITE])

    def test_shares_stay_in_one_line(self):
        self.resize(1280, 900)
        self.show(0)
        shares = self.all("#classes td:nth-child(3)")
        self.assertEqual({share.value_of_css_property("white-space") for share in shares}, {"nowrap"})

    def test_tables_fade_where_they_go_on(self):
        self.resize(400, 900)
        place = self.one(".wide:has(> #all)")
        is_faded = lambda: "more" in place.get_attribute("class").split()
        self.wait_for(is_faded, "a table that goes on")
        self.driver.execute_script("arguments[0].scrollLeft = arguments[0].scrollWidth", place)
        self.wait_for(lambda: not is_faded(), "its end")

    # Maps that are judged as if somebody had brought them have depths alone.
    def test_z_fighting_is_unknown_without_triangle_numbers(self):
        self.show(next(k for k, r in enumerate(self.results) if r["scene"] == "sphere"))
        self.assertIn(["z-fight", "0", "0.000 %"], [cells[:3] for cells in self.table("#classes")])
        with tempfile.TemporaryDirectory(prefix="fathom-report-") as folder:
            subprocess.run([PROGRAM, "--against", "embree", "--scene", "sphere", "--size", f"{WIDTH}x{HEIGHT}",
                            "--model", "matching", "--out", folder], check=True, stdout=subprocess.DEVNULL)
            page = self.driver.current_url
            self.addCleanup(self.driver.get, page)
            self.driver.get((pathlib.Path(folder) / "report.html").as_uri())
            self.wait_for(lambda: self.all("#classes tr"), "the classes")
            self.assertIn(["z-fight", "unknown", "–"], [cells[:3] for cells in self.table("#classes")])
            self.assertIn("No triangle numbers were read", self.text("#bounds"))
            names = self.table("#all")[0]
            for cells in self.table("#all")[1:]:
                self.assertEqual(cells[names.index("z-fight")], "unknown")

    # The values come from compressed maps, those of report.json do not.
    def test_a_click_shows_pictures_that_can_be_read(self):
        for number, _ in enumerate(self.results):
            result = self.show(number)
            canvases = self.all("#maps-shown canvas")
            self.assertEqual(len(canvases), 4)
            for canvas in canvases:
                self.assertTrue(canvas.is_displayed())
                self.assertEqual(self.driver.execute_script(SIZE, canvas), [WIDTH, HEIGHT])
            truth, other, _, classes = canvases
            self.assertTrue(result["worst"])
            for pixel in result["worst"][:PIXELS]:
                x, y = pixel["pixel"]
                with self.subTest(scene=result["scene"], variant=result["variant"], pixel=(x, y)):
                    said = self.point_at(truth, x, y)
                    self.assertEqual((int(said[1]), int(said[2]), said[3]), (x, y, pixel["class"]))
                    self.assertEqual((said[6], said[7]), (pixel["class"], self.meaning(pixel["class"])))
                    depths = as_binary32(pixel["truth"]), as_binary32(pixel["other"])
                    self.assertEqual((as_shown(said[4]), as_shown(said[5])), depths)
                    for canvas, depth in zip((truth, other), depths):
                        self.assertEqual(self.colour(canvas, x, y) == WHITE, depth == float("inf"))
                    self.assertEqual(self.colour(classes, x, y),
                                     self.driver.execute_script(COLOUR_OF_CLASS, pixel["class"]))

    def test_background_is_white(self):
        self.show(next(k for k, r in enumerate(self.results) if r["scene"] == "sphere"))
        truth, other = self.all("#maps-shown canvas")[:2]
        said = self.point_at(other, 0, 0)
        self.assertEqual(said.groups()[:5], ("0", "0", "equal", "background", "background"))
        self.assertEqual([self.colour(truth, 0, 0), self.colour(other, 0, 0)], [WHITE, WHITE])

    # As previews have them: viridis, violet at the nearest depth and yellow at the farthest.
    def test_near_is_violet_and_far_is_yellow(self):
        number = next(k for k, r in enumerate(self.results) if r["scene"] == "sphere")
        self.show(number)
        truth = self.all("#maps-shown canvas")[0]
        readings = [self.point_at(truth, x, HEIGHT // 2) for x in range(0, WIDTH, 4)]
        seen = sorted((as_shown(r[4]), int(r[1])) for r in readings if r[4] != "background")
        (near, near_x), (far, far_x) = seen[0], seen[-1]
        self.assertLess(near, far)
        nearest, farthest = self.colour(truth, near_x, HEIGHT // 2), self.colour(truth, far_x, HEIGHT // 2)
        self.assertLess(nearest[1], farthest[1])  # green grows from violet to yellow
        self.assertEqual(self.driver.execute_script("return [depthColourAt(0), depthColourAt(1)]"),
                         [[71, 1, 85], [252, 231, 33]])

    def test_plots_show_every_renderer_and_pixels_at_many_places(self):
        for number, _ in enumerate(self.results):
            result = self.show(number)
            with self.subTest(scene=result["scene"], variant=result["variant"]):
                dots = {tuple(dot) for dot in self.driver.execute_script(DOTS)}
                self.assertGreater(len(dots), 50)
                lines = self.driver.execute_script(LINES)
                self.assertEqual(len(lines), 2)
                for line in lines:
                    self.assertGreater(len(line.split()), 1)

    def expect_lines_told_apart(self, names):
        """By dashes and markers, without colours, and by labels that do not lie upon each other."""
        styles = self.driver.execute_script(STYLES)
        self.assertEqual(sorted(style["name"].removesuffix(": no error") for style in styles), sorted(names))
        self.assertEqual(len({(s["dashes"], s["marker"], s["hollow"]) for s in styles}), len(names))
        rows = sorted((style["top"], style["bottom"]) for style in styles)
        for (above, _), (below, _) in zip(rows, rows[1:]):
            self.assertGreater(below - above, 8)
        return styles

    def test_lines_of_formats_need_no_colour(self):
        result = self.show(0)
        names = [f"{r['renderer']} {r['variant']}" for r in self.results if r["scene"] == result["scene"]]
        self.expect_lines_told_apart(names)
        self.driver.execute_script(CROWD)
        self.expect_lines_told_apart([f"line {j}" for j in range(36)])

    def test_the_button_of_a_pixel_reads_it(self):
        result = self.show(next(k for k, r in enumerate(self.results) if r["pixels"]["missed surface"]))
        button = self.all("#worst button")[0]
        button.click()
        said = READING.match(self.text("#reading"))
        self.assertEqual([int(said[1]), int(said[2])], result["worst"][0]["pixel"])
        self.assertEqual((said[3], said[5]), ("missed surface", "background"))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
