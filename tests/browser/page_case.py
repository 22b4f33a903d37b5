"""A page in a browser, as a test case, and the data within a report page."""
import contextlib
import json
import re
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from headless_chromium import PATIENCE, errors_in_console

CUT_OFF = """
return [...arguments[0].querySelectorAll("th, td")].filter((c) => c.scrollWidth > c.clientWidth)
  .map((c) => c.textContent);
"""
# The visible texts whose contrast to what is behind them is less than 4.5 (WCAG 2.2, 1.4.3). Plots are inverted by a filter.
FAINT = """
const linear = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const light = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
const behind = (e) => {
  for (; e; e = e.parentElement) {
    const colour = numbers(getComputedStyle(e).backgroundColor);
    if (colour.length < 4 || colour[3] === 1) return colour;
  }
  return [255, 255, 255];
};
const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), faint = [];
while (texts.nextNode()) {
  const e = texts.currentNode.parentElement, text = texts.currentNode.textContent.trim();
  if (!text || !e.checkVisibility() || e.closest("svg, script, style, select, .hidden-visually")) continue;
  const [a, b] = [light(numbers(getComputedStyle(e).color)), light(behind(e))].sort((x, y) => y - x);
  if ((a + 0.05) / (b + 0.05) < 4.5) faint.push(text);
}
return faint;
"""
LAST_DRAWN = "return Number(document.documentElement.dataset.ready ?? 0)"
PAPER = "return getComputedStyle(document.body).backgroundColor"
SIDEWAYS = "return arguments[0].scrollWidth - arguments[0].clientWidth"


class PageCase(unittest.TestCase):
    """`driver` is the browser, with the page. A page that complains fails every test."""

    def tearDown(self):
        self.assertEqual(errors_in_console(self.driver), [])

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.one(selector).text

    def texts(self, selector):
        """Also of what is scrolled out of sight."""
        return [e.get_attribute("textContent") for e in self.all(selector)]

    def wait_for(self, condition, what):
        WebDriverWait(self.driver, PATIENCE, poll_frequency=0.05).until(lambda _: condition(), what)

    @contextlib.contextmanager
    def redrawn(self):
        """Waits until the page has drawn its pictures again because of what is done within."""
        before = self.driver.execute_script(LAST_DRAWN)
        yield
        self.wait_for(lambda: self.driver.execute_script(LAST_DRAWN) > before, "pictures drawn again")

    def table(self, selector):
        """The texts of a table's cells that are shown, row by row."""
        return self.driver.execute_script(
            "return [...document.querySelectorAll(arguments[0] + ' tr')].filter((r) => !r.hidden)"
            ".map((r) => [...r.cells].map((c) => c.textContent))", selector)

    def filter(self, words="", only_open=False):
        """Fills in the filter, and waits for nothing: the page answers at once."""
        box, tick = self.one("#filter-words"), self.one("#filter-open")
        box.send_keys(Keys.CONTROL + "a")
        box.send_keys(Keys.BACKSPACE + words)
        if tick.is_selected() != only_open:
            tick.click()

    def how_far_it_scrolls_sideways(self, selector):
        return self.driver.execute_script(SIDEWAYS, self.one(selector))

    def expect_nothing_cut_off(self, selector):
        self.assertEqual(self.driver.execute_script(CUT_OFF, self.one(selector)), [])

    def resize(self, width, height):
        """The viewport, also to widths that windows do not have."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})

    def expect_readable_in_the_dark(self):
        expect_readable_in_the_dark(self, self.driver)

    def expect_words_explained(self):
        """Every word that is marked as one leads to its meaning."""
        meanings = dict(zip(self.texts("#words dt"), self.texts("#words dd")))
        ids = {e.get_attribute("id"): e.get_attribute("textContent") for e in self.all("#words dt")}
        links = self.all("a.term")
        self.assertTrue(links)
        for link in links:
            word = ids[link.get_attribute("href").split("#")[1]]
            self.assertTrue(meanings[word])
            self.assertEqual(link.get_attribute("title"), meanings[word])


def prefer(driver, scheme):
    """As if the system's colours were "dark" or "light"; Chromium without a window is light."""
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})


def expect_readable_in_the_dark(case, driver, redrawn=contextlib.nullcontext):
    """The page follows the system's dark colours, and its texts stand out from them as from light ones. `redrawn` waits for
    a page that draws its pictures again."""
    papers = []
    for scheme in ("dark", "light"):
        with redrawn():
            prefer(driver, scheme)
        case.assertEqual(driver.execute_script(FAINT), [], scheme)
        papers.append(driver.execute_script(PAPER))
    case.assertEqual(papers, ["rgb(23, 27, 33)", "rgb(255, 255, 255)"])


def data_of(page, name):
    """The JSON of a script element."""
    return json.loads(_script(name).search(page)[2])


def with_data(page, name, data):
    text = json.dumps(data).replace("<", "\\u003c")
    return _script(name).sub(lambda found: found[1] + text + found[3], page)


def _script(name):
    return re.compile(f'(<script id="{name}" type="application/json">)(.*?)(</script>)', re.DOTALL)
