#!/usr/bin/python3
"""The page of `fathom view`: it holds every bit of its maps, and shows them as its controls say.

    tests/browser/view_page_test.py FATHOM-VIEW
"""
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
import zlib

import numpy
import OpenImageIO
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

from headless_chromium import headless_chromium
from page_case import PageCase

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"

# All values of a channel, level by level, as bytes.
VALUES = """
const [map, name, level, done] = arguments, channel = fathom.maps[map].channels.find((c) => c.name === name);
(async () => {
  const { columns, rows, across, down } = channel.grid(level);
  let all = null, mask = new Uint8Array(columns * rows);
  for (let number = 0; number < across * down; ++number) {
    const tile = await channel.tile(level, number);
    const left = number % across * 512, top = Math.floor(number / across) * 512;
    all ??= new tile.values.constructor(columns * rows);
    for (let y = 0; y < tile.rows; ++y) {
      all.set(tile.values.subarray(y * tile.columns, (y + 1) * tile.columns), (top + y) * columns + left);
      for (let x = 0; x < tile.columns; ++x) mask[(top + y) * columns + left + x] = tile.mask ? tile.mask[y * tile.columns + x] : 1;
    }
  }
  const text = (array) => {
    const bytes = new Uint8Array(array.buffer), parts = [];
    for (let k = 0; k < bytes.length; k += 32768) parts.push(String.fromCharCode(...bytes.subarray(k, k + 32768)));
    return btoa(parts.join(""));
  };
  done([text(all), text(mask), columns, rows]);
})();
"""
COLOUR_AT_CENTRE = """
const canvas = document.getElementById("picture");
return Array.from(canvas.getContext("2d").getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1).data).slice(0, 3);
"""
# The sizes of the picture and of its box, when both have changed and before the browser shows the frame: observers
# are called in the order in which they were made.
SIZES_IN_THE_FRAME_OF_A_CHANGE = """
const done = arguments[0], canvas = document.getElementById("picture");
let calls = 0;
new ResizeObserver(() => {
  if (++calls === 1) canvas.parentElement.style.height = "200px";
  else done([canvas.width, canvas.height, canvas.clientWidth, canvas.clientHeight]);
}).observe(canvas);
"""
READY = "return document.documentElement.dataset.ready"


def fathom(*arguments):
    subprocess.run([pathlib.Path(PROGRAM).parent / "fathom", "--quiet", *map(str, arguments)], check=True,
                   stdout=subprocess.DEVNULL)


def deep_samples(file, x, y):
    """Z, ZBack, area, A and id of the samples of a pixel, as OpenImageIO reads them."""
    image = OpenImageIO.ImageInput.open(str(file))
    names, deep = image.spec().channelnames, image.read_native_deep_image(0, 0)
    pixel = y * image.spec().width + x
    return [[numpy.float32(deep.deep_value(pixel, names.index(name), k)) for name in ("Z", "ZBack", "area", "A")] +
            [deep.deep_value_uint(pixel, names.index("id"), k)] for k in range(deep.samples(pixel))]


def with_odd_numbers(values):
    """The array with a few words of any bits, and with each kind of number that is no depth."""
    words = values.copy().view("u4").reshape(-1)
    random = numpy.random.default_rng(53)
    places = random.permutation(words.size)[:words.size // 500]
    words[places] = random.integers(0, 2 ** 32, places.size, dtype="u4")
    # Zeros, the least and the greatest subnormal number, the greatest number, infinities, NaNs.
    kinds = [0, 1 << 31, 1, 0x807fffff, 0x7fffff, 0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, 0x7f800001, 0xffffffff]
    for k, kind in enumerate(kinds):
        words[places[k::50]] = kind
    return words.view("f4").reshape(values.shape)


def prediction_of(text):
    """What the values of a tile are predicted from (apps/view/packing.h)."""
    bits = sum(((ord(letter) ^ 0x55) & 127) << 7 * k for k, letter in enumerate(text[:4096]))
    return zlib.decompressobj().decompress(bits.to_bytes(4096, "little"), 1)[0]


class ViewPage(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-view-")))
        scene = DATA / "scenes/pair.json"
        channels = ("--channels", "Z,A,id,object,N", "--size", "700x530")
        for name, view in (("pair", "215,15"), ("turned", "218,16")):
            fathom("render", scene, "--view", view, *channels, "-o", cls.folder / f"{name}.npz")
        fathom("render", scene, "--view", "215,15", *channels, "-o", cls.folder / "pair.exr")
        cls.pair, cls.turned = (numpy.load(cls.folder / f"{name}.npz") for name in ("pair", "turned"))
        cls.page = cls.viewed("pair.exr", "turned.npz")
        cls.driver = cls.enterClassContext(headless_chromium())
        cls.driver.set_script_timeout(60)

    @classmethod
    def viewed(cls, *maps):
        """The address of a page with these maps of the folder."""
        page = cls.folder / ("-".join(pathlib.Path(name).stem for name in maps) + ".html")
        subprocess.run([PROGRAM, *(cls.folder / name for name in maps), "-o", page], check=True)
        return page.as_uri()

    def open(self, fragment="", page=None):
        self.driver.get("about:blank")
        self.driver.get((page or self.page) + fragment)
        self.wait_until_ready()

    def wait_until_ready(self, after=0):
        self.wait_for(lambda: int(self.driver.execute_script(READY) or 0) > after, "the picture")

    def change(self, control, text):
        before = int(self.driver.execute_script(READY))
        Select(self.one("#" + control)).select_by_value(text)
        self.wait_until_ready(before)

    def values(self, number, name, dtype, level=0):
        text, mask, columns, rows = self.driver.execute_async_script(VALUES, number, name, level)
        shape = (rows, columns)
        return (numpy.frombuffer(base64.b64decode(text), dtype).reshape(shape),
                numpy.frombuffer(base64.b64decode(mask), numpy.uint8).reshape(shape))

    def expect_bits(self, number, name, array, level=0):
        found, _ = self.values(number, name, array.dtype, level)
        words = f"u{array.dtype.itemsize}"
        step = 2 ** level
        numpy.testing.assert_array_equal(found.view(words), numpy.ascontiguousarray(array[::step, ::step]).view(words))

    def reading(self):
        """The table of the selected pixel, when it is there."""
        self.wait_for(lambda: self.table("#values"), "the values")
        return dict(self.table("#values"))

    def test_every_bit_of_an_exr_and_of_an_npz_is_there(self):
        self.open()
        for number, maps in enumerate((self.pair, self.turned)):
            for name in ("Z", "A", "id", "object"):
                self.expect_bits(number, name, maps[name])
            for k, part in enumerate("XYZ"):
                self.expect_bits(number, f"N.{part}", maps["N"][:, :, k])
        _, mask = self.values(0, "N.X", "f4")
        numpy.testing.assert_array_equal(mask != 0, self.pair["object"] != 0xFFFFFFFF)

    def test_no_frame_stretches_the_picture(self):
        self.open()
        width, height, box_width, box_height = self.driver.execute_async_script(SIZES_IN_THE_FRAME_OF_A_CHANGE)
        self.assertEqual(box_height, 200)
        self.assertEqual((width, height), (box_width, box_height))

    def test_the_tools_are_in_one_row(self):
        self.resize(1280, 720)
        self.open(page=self.viewed("pair.exr"))
        places = self.driver.execute_script(
            "return [...document.querySelectorAll('header select, header button')].filter((e) => e.checkVisibility())"
            ".map((e) => e.getBoundingClientRect()).map((box) => (box.top + box.bottom) / 2)")
        self.assertGreater(len(places), 8)
        self.assertLess(max(places) - min(places), 8)

    def test_every_bit_of_other_types_is_there(self):
        random = numpy.random.default_rng(51)
        fathom("render", DATA / "meshes/spot.obj", "--size", "600x20", "--dtype", "float64", "-o", self.folder / "double.npy")
        words = random.integers(0, 2 ** 64, size=(7, 530), dtype="u8").view("f8")  # NaNs, infinities, everything
        numpy.save(self.folder / "words.npy", words)
        fathom("render", DATA / "meshes/spot.obj", "--size", "600x20", "--png-scale", "1000", "-o", self.folder / "codes.png")
        fathom("convert", self.folder / "codes.png", "-o", self.folder / "codes.npy")
        for name in ("double.npy", "words.npy"):
            self.open(page=self.viewed(name))
            self.expect_bits(0, "Z", numpy.load(self.folder / name))
        self.open(page=self.viewed("codes.png"))
        found, mask = self.values(0, "Z", "f8")
        codes = numpy.round(found * 1000)
        numpy.testing.assert_array_equal(found, codes / 1000)
        expected = numpy.load(self.folder / "codes.npy")
        numpy.testing.assert_array_equal(found[mask != 0].astype("f4"), expected[mask != 0].astype("f4"))

    def test_every_bit_of_directions_by_triangles_is_there(self):
        random = numpy.random.default_rng(53)
        triangles = random.integers(0, 2 ** 32, 3000, dtype="u4")
        drawn = random.integers(0, 3000, (530, 700))
        bits = random.integers(0, 2 ** 32, (3000, 3), dtype="u4")[drawn]
        bits[529, 699] += 1  # one tile has two directions of a triangle
        arrays = {**self.pair, "id": triangles[drawn], "N": bits.view("f4")}
        numpy.savez(self.folder / "triangles.npz", **arrays)
        self.open(page=self.viewed("triangles.npz"))
        self.expect_bits(0, "id", arrays["id"])
        for k, part in enumerate("XYZ"):
            self.expect_bits(0, f"N.{part}", arrays["N"][:, :, k])

    def expect_bits_by_planes(self, file, arrays, levels):
        """Every bit is there, and the planes of the normals predict the depths of most tiles."""
        self.open(page=self.viewed(file))
        for level in range(levels):
            self.expect_bits(0, "Z", arrays["Z"], level)
            for k, part in enumerate("XYZ"):
                self.expect_bits(0, f"N.{part}", arrays["N"][:, :, k], level)
            texts = self.driver.execute_script(
                "const number = fathom.maps[0].stored.findIndex((c) => c.name === 'Z');"
                "return [...document.querySelectorAll(`[id^='m0-c${number}-${arguments[0]}-']`)].map((e) => e.textContent)", level)
            by_planes = sum(prediction_of(text) == 3 for text in texts)
            self.assertGreater(by_planes, len(texts) / 2)

    def test_every_bit_of_depths_by_planes_is_there(self):
        fathom("camera", "look-at", "--eye", "0,0,-1", "--target", "0.3,-0.2,-4", "--fov", "60", "--size", "2400x1800",
               "-o", self.folder / "straight.json")
        camera = json.loads((self.folder / "straight.json").read_text())
        (self.folder / "skewed.json").write_text(json.dumps({**camera, "skew": 30, "fy": 1.1 * camera["fx"]}))
        for name, levels, view in (("skewed", 2, ("--camera", self.folder / "skewed.json")),
                                   ("parallel", 1, ("--view", "15,20", "--orthographic", "3", "--size", "700x530"))):
            fathom("render", DATA / "scenes/room.json", *view, "--channels", "Z,id,N", "-o", self.folder / f"{name}.npz")
            arrays = dict(numpy.load(self.folder / f"{name}.npz"))
            self.expect_bits_by_planes(f"{name}.npz", arrays, levels)
            odd = {**arrays, "Z": with_odd_numbers(arrays["Z"]), "N": with_odd_numbers(arrays["N"])}
            numpy.savez(self.folder / f"odd-{name}.npz", **odd)
            self.expect_bits_by_planes(f"odd-{name}.npz", odd, levels)

    def test_large_maps_have_coarser_levels(self):
        y, x = numpy.mgrid[0:2501, 0:3003]
        large = (1 + x * x * 1e-7 + numpy.sin(y / 50)).astype("f4")
        numpy.save(self.folder / "large.npy", large)
        self.open(page=self.viewed("large.npy"))
        self.assertEqual(self.driver.execute_script("return fathom.maps[0].levels"), 2)
        for level in (0, 1):
            self.expect_bits(0, "Z", large, level)
        self.assertIn("one of 2 × 2 pixels", self.text("#histogram-said"))
        self.open("#pixel=3002,2500", page=(self.folder / "large.html").as_uri())
        self.assertEqual(numpy.float32(self.reading()["Z"]), large[2500, 3002])

    def surface_pixels(self, count):
        rows, columns = numpy.nonzero(self.pair["object"] != 0xFFFFFFFF)
        chosen = numpy.random.default_rng(7).choice(len(rows), count, replace=False)
        return [(int(columns[k]), int(rows[k])) for k in chosen]

    def test_the_reading_of_a_pixel_is_the_file(self):
        for x, y in self.surface_pixels(4):
            self.open(f"#pixel={x},{y}")
            told = self.reading()
            self.assertEqual(self.text("#where"), f"Pixel {x}, {y}")
            for name in ("Z", "A"):
                self.assertEqual(numpy.float32(told[name]), self.pair[name][y, x])
            self.assertEqual(int(told["id"]), self.pair["id"][y, x])
            number = self.pair["object"][y, x]
            self.assertEqual(told["object"], f"{number}  {['spot', 'teapot'][number]}")
        self.open("#pixel=0,0")
        self.assertEqual(self.text("#where"), "Pixel 0, 0: no surface")
        self.assertEqual(self.reading()["Z"], "–")

    def test_the_point_in_the_world_is_that_of_convert(self):
        fathom("convert", self.folder / "pair.exr", "-o", self.folder / "pair.ply")
        data = (self.folder / "pair.ply").read_bytes()
        head, body = data.split(b"end_header\n", 1)
        kinds = {b"double": "f8", b"float": "f4", b"uint": "u4"}
        row = numpy.dtype([(line.split()[2].decode(), kinds[line.split()[1]]) for line in head.splitlines()
                           if line.startswith(b"property")])
        points = numpy.frombuffer(body, row)
        index = numpy.cumsum((self.pair["object"] != 0xFFFFFFFF).ravel()) - 1
        for x, y in self.surface_pixels(2):
            self.open(f"#pixel={x},{y}")
            told = [float(part) for part in self.reading()["world"].split(", ")]
            point = points[index[y * 700 + x]]
            numpy.testing.assert_allclose(told, [point["x"], point["y"], point["z"]], rtol=1e-8)

    def test_pointer_and_keys_select_pixels(self):
        self.open("#x=350.5&y=265.5&zoom=16")
        canvas = self.one("#picture")
        ActionChains(self.driver).move_to_element(canvas).perform()
        self.wait_for(lambda: self.text("#where").startswith("Pixel"), "the pixel below the pointer")
        ActionChains(self.driver).click(canvas).perform()
        self.wait_for(lambda: self.driver.execute_script("return fathom.state().pixel"), "a selected pixel")
        x, y = self.driver.execute_script("return fathom.state().pixel")
        self.assertLessEqual(abs(x - 350) + abs(y - 265), 1)
        canvas.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_UP)
        self.assertEqual(self.driver.execute_script("return fathom.state().pixel"), [x + 1, y - 1])
        self.wait_for(lambda: self.text("#where").startswith(f"Pixel {x + 1}, {y - 1}"), "its values")
        self.assertIn(f"pixel {x + 1}, {y - 1}: Z", self.one("#said").get_attribute("textContent"))

    def test_arrows_need_no_focus_and_shift_means_ten(self):
        (x, y), = self.surface_pixels(1)
        self.open(f"#pixel={x},{y}")
        for shift, step in ((False, 1), (True, 10)):
            keys = ActionChains(self.driver)
            if shift:
                keys.key_down(Keys.SHIFT)
            keys.send_keys(Keys.ARROW_RIGHT).key_up(Keys.SHIFT).perform()
            x += step
            self.assertEqual(self.driver.execute_script("return fathom.state().pixel"), [x, y])

    def test_the_link_follows_what_keys_move_into_sight(self):
        self.open("#x=100&y=100&zoom=32&pixel=100,100")
        ActionChains(self.driver).key_down(Keys.SHIFT).send_keys(*[Keys.ARROW_RIGHT] * 9).key_up(Keys.SHIFT).perform()
        self.wait_for(lambda: "pixel=190,100" in self.driver.current_url, "the link to the pixel")
        link = dict(urllib.parse.parse_qsl(urllib.parse.urlparse(self.driver.current_url).fragment))
        self.assertLess(abs(float(link["x"]) - 190), 20, link)

    def test_maps_that_cannot_be_compared_say_why(self):
        fathom("render", DATA / "scenes/pair.json", "--size", "20x10", "-o", self.folder / "small.npz")
        self.open(page=self.viewed("pair.exr", "small.npz"))
        self.assertFalse(self.one("#comparing").is_displayed())
        self.assertEqual(self.text("#incomparable"), "Compare: no other map has 700 × 530 pixels")
        self.open()
        self.assertFalse(self.one("#incomparable").is_displayed())
        self.assertTrue(self.one("#comparing").is_displayed())

    def test_without_a_display_there_is_one_line(self):
        bare = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")}
        done = subprocess.run([PROGRAM, self.folder / "pair.exr", "-o", self.folder / "open.html", "--open"], env=bare,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"^fathom[a-z-]*: warning: no display for a browser: open \S+open.html yourself, .*\n$")

    def colour_of(self, place, name="viridis"):
        table = self.driver.execute_script(
            "return JSON.parse(document.getElementById('view').textContent).colours[arguments[0]]", name)
        k = round(255 * place)
        return [int(table[6 * k + 2 * part:6 * k + 2 * part + 2], 16) for part in range(3)]

    def test_colours_follow_scale_range_and_colour_map(self):
        depth, seen = self.pair["Z"], numpy.isfinite(self.pair["Z"])
        low, high = depth[seen].min(), depth[seen].max()
        (x, y), = self.surface_pixels(1)
        z = float(depth[y, x])
        at = f"#x={x + 0.5}&y={y + 0.5}&zoom=16"
        places = {"linear": (z - low) / (high - low), "log": numpy.log(z / low) / numpy.log(high / low),
                  "inverse": (1 / low - 1 / z) / (1 / low - 1 / high),
                  "equalised": (depth[seen] < z).mean()}
        for scale, place in places.items():
            self.open(f"{at}&scale={scale}")
            wanted = self.colour_of(place)
            for got, part in zip(self.driver.execute_script(COLOUR_AT_CENTRE), wanted):
                self.assertLessEqual(abs(got - part), 4, scale)
        self.open(f"{at}&low={z - 1}&high={z + 3}&colours=magma")
        self.assertEqual(self.driver.execute_script(COLOUR_AT_CENTRE), self.colour_of(0.25, "magma"))

    def test_a_link_keeps_the_view(self):
        self.open()
        self.change("channel", "object")
        self.one("#closer").click()
        ActionChains(self.driver).click(self.one("#picture")).perform()
        self.wait_for(lambda: "pixel=" in self.driver.current_url, "the link")
        kept = self.driver.execute_script("return fathom.state()")
        self.open(page=self.driver.current_url)
        again = self.driver.execute_script("return fathom.state()")
        for key in ("channel", "pixel", "mode"):
            self.assertEqual(again[key], kept[key])
        for key in ("x", "y", "zoom"):
            self.assertAlmostEqual(again[key], kept[key], 4)
        self.assertEqual(kept["channel"], "object")

    def test_wrong_links_show_the_map(self):
        self.open("#map=7&channel=nothing&scale=jet&pixel=9999,2&low=5&high=1&zoom=-3&x=1e99&other=0&mode=flicker")
        self.assertEqual(Select(self.one("#channel")).first_selected_option.get_attribute("value"), "Z")

    def test_differences_are_those_of_the_files(self):
        a, b = self.pair["Z"], self.turned["Z"]
        rows, columns = numpy.nonzero(numpy.isfinite(a) & numpy.isfinite(b))
        x, y = int(columns[len(columns) // 3]), int(rows[len(rows) // 3])
        p, q = a[y, x], b[y, x]
        wanted = {"absolute": float(q) - float(p), "relative": (float(q) - float(p)) / max(float(p), float(q)),
                  "ulps": int(q.view("i4")) - int(p.view("i4"))}
        labels = {"absolute": "B − A", "relative": "(B − A) / larger", "ulps": "B − A in ulps"}
        for measure, difference in wanted.items():
            self.open(f"#mode=difference&measure={measure}&pixel={x},{y}")
            told = self.reading()
            self.assertEqual((numpy.float32(told["A: Z"]), numpy.float32(told["B: Z"])), (p, q))
            self.assertEqual(float(told[labels[measure]]), difference)
        legend = self.texts("#legend li")
        only_a = numpy.count_nonzero(numpy.isfinite(a) & ~numpy.isfinite(b))
        self.assertTrue(any(line.startswith(f"surface in A only ({100 * only_a / a.size:.1f}") for line in legend), legend)

    def test_slider_and_flicker_show_both(self):
        x, y = self.surface_pixels(1)[0]
        at = f"&channel=id&x={x + 0.5}&y={y + 0.5}&zoom=16"
        colours = {}
        for split in (0, 1):
            self.open(f"#mode=slider&split={split}{at}")
            colours[split] = self.driver.execute_script(COLOUR_AT_CENTRE)
        self.open("#mode=flicker" + at)
        seen = set()

        def both():
            seen.add(tuple(self.driver.execute_script(COLOUR_AT_CENTRE)))
            return seen == {tuple(colours[0]), tuple(colours[1])}
        self.assertNotEqual(colours[0], colours[1])
        self.wait_for(both, "A and B in turns")

    def test_a_profile_has_the_values_of_its_line(self):
        x, y = self.surface_pixels(1)[0]
        self.open(f"#line={x - 3},{y},{x + 3},{y}")
        plot = self.one("#profile")
        self.wait_for(lambda: self.text("#profile-said"), "the profile")
        ActionChains(self.driver).move_to_element(plot).perform()
        self.wait_for(lambda: self.text("#profile-value"), "a value")
        place, value = self.text("#profile-value").split(": ")
        column, row = map(int, place.split(", "))
        self.assertEqual(row, y)
        if numpy.isfinite(self.pair["Z"][y, column]):
            self.assertAlmostEqual(float(value), float(self.pair["Z"][y, column]), 7)

    def test_the_histogram_counts_values_and_takes_a_range(self):
        self.open()
        count = int(numpy.isfinite(self.pair["Z"]).sum())
        self.assertTrue(self.text("#histogram-said").startswith(f"{count:,} values"))
        chart = self.one("#histogram")
        ActionChains(self.driver).move_to_element_with_offset(chart, -60, 0).click_and_hold().move_by_offset(120, 0).release().perform()
        self.wait_for(lambda: self.one("#low").get_attribute("value"), "a range")
        low, high = (float(self.one(end).get_attribute("value")) for end in ("#low", "#high"))
        self.assertTrue(self.pair["Z"].min() < low < high)
        self.one("#reset").click()
        self.wait_for(lambda: not self.one("#low").get_attribute("value"), "all values")

    def test_the_heading_is_short(self):
        self.open()
        self.assertEqual(self.text("#title"), "pair.exr, turned.npz")
        self.open(page=self.viewed(*["pair.exr"] * 4))
        self.assertEqual(self.text("#title"), "pair.exr and 3 more maps")

    def test_a_report_shows_its_maps(self):
        depth = numpy.full((48, 64), numpy.inf, "f4")
        fathom("camera", "look-at", "--eye", "2,1,3", "--size", "64x48", "-o", self.folder / "camera.json")
        fathom("render", DATA / "meshes/spot.obj", "--camera", self.folder / "camera.json", "--channels", "Z,id",
               "-o", self.folder / "exact.npz")
        exact = numpy.load(self.folder / "exact.npz")
        depth[:, :-1] = exact["Z"][:, 1:]
        numpy.save(self.folder / "shifted.npy", depth)
        validate = pathlib.Path(PROGRAM).parent / "fathom-validate"
        subprocess.run([validate, DATA / "meshes/spot.obj", "--camera", self.folder / "camera.json", "--map",
                        self.folder / "shifted.npy", "--model", "float32-ray", "-o", self.folder / "report"],
                       check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        page = self.folder / "report-maps.html"
        subprocess.run([PROGRAM, self.folder / "report/report.html", "-o", page], check=True)
        self.open(page=page.as_uri())
        self.expect_bits(0, "Z", exact["Z"])
        self.expect_bits(0, "id", exact["id"])
        self.expect_bits(1, "Z", depth)
        x, y = (int(k[0]) for k in numpy.nonzero(numpy.isfinite(depth))[::-1])
        self.open(f"#map=1&channel=class&pixel={x},{y}", page=page.as_uri())
        self.assertRegex(self.reading()["class"], "^[0-7]  [a-z -]+$")

    def test_a_deep_map_lists_its_samples(self):
        fathom("render", DATA / "scenes/pair.json", "--size", "160x120", "--deep", "-o", self.folder / "deep.exr")
        self.open(page=self.viewed("deep.exr"))
        samples, seen = self.values(0, "samples", "f4")
        nearest, _ = self.values(0, "Z", "f4")
        numpy.testing.assert_array_equal(samples > 0, numpy.isfinite(nearest))
        rows, columns = numpy.nonzero(samples == samples.max())
        x, y = int(columns[0]), int(rows[0])
        self.open(f"#pixel={x},{y}", page=(self.folder / "deep.html").as_uri())
        self.wait_for(lambda: self.table("#samples"), "the samples")
        head, *lines = self.table("#samples")
        self.assertEqual(head, ["id", "Z", "ZBack", "area", "A"])
        read = deep_samples(self.folder / "deep.exr", x, y)
        self.assertEqual(len(lines), samples.max())
        self.assertEqual([[numpy.float32(cell) for cell in line[1:]] + [int(line[0])] for line in lines], read)

    def test_counts_of_samples_begin_logarithmic(self):
        fathom("render", DATA / "meshes/spot.obj", "--size", "160x120", "--deep", "-o", self.folder / "counted.exr")
        page = self.viewed("counted.exr")
        self.open("#channel=samples", page=page)
        counts, seen = self.values(0, "samples", "f4")
        self.assertEqual(counts[seen == 1].min(), 1)
        scale = lambda: Select(self.one("#scale")).first_selected_option.get_attribute("value")
        self.assertEqual(scale(), "log")
        self.open("#channel=Z", page=page)
        self.assertEqual(scale(), "linear")
        self.open("#channel=samples&scale=linear", page=page)
        self.assertEqual(scale(), "linear")

    def test_channels_of_a_depth_buffer_look_as_in_a_preview(self):
        fathom("render", DATA / "meshes/teapot.obj", "--view", "20,30", "--size", "960x720", "--near", "0.1", "--far", "1000",
               "--depth-format", "unorm16", "--against-exact", "-o", self.folder / "fights.npz")
        page, maps = self.viewed("fights.npz"), numpy.load(self.folder / "fights.npz")
        fights, errors, seen = maps["Zfight"], maps["Zerror"], numpy.isfinite(maps["Z"])
        right, wrong = [146, 154, 164], [215, 25, 28]

        def colour_at(channel, pixel, zoom):
            self.open(f"#channel={channel}&x={pixel[1] + 0.5}&y={pixel[0] + 0.5}&zoom={zoom}", page)
            return self.driver.execute_script(COLOUR_AT_CENTRE)

        places = numpy.argwhere(fights == 1)
        for zoom in (0.7, 1, 16):
            self.assertEqual(colour_at("Zfight", places[0], zoom), wrong, zoom)
        self.assertEqual(colour_at("Zfight", numpy.argwhere(seen & (fights == 0))[-1], 16), right)
        # A pixel away from the wrong one belongs to its square only where pixels are small.
        beside = places[0] + (1 if not fights[tuple(places[0] + (1, 0))] else -1, 0)
        self.assertEqual(colour_at("Zfight", beside, 1), wrong)
        self.assertNotEqual(colour_at("Zfight", beside, 16), wrong)
        self.assertRegex(self.text("#legend"), r"^0 right .*\n1 wrong .*\n")
        self.assertFalse(self.one("#colours").is_displayed())
        self.assertEqual(Select(self.one("#channel")).first_selected_option.text, "Zfight – where the wrong surface wins")

        end = numpy.abs(errors[seen]).max()
        for pixel in numpy.argwhere(seen)[::20011]:
            place = 0.5 + float(errors[tuple(pixel)]) / (2 * end)
            self.assertEqual(colour_at("Zerror", pixel, 16), self.colour_of(place, "diverging"), pixel)
        self.assertEqual(self.one("#colours").get_attribute("value"), "diverging")

    def test_directions_are_drawn_as_red_green_and_blue(self):
        normals, seen = self.pair["N"], numpy.isfinite(self.pair["Z"])
        for y, x in numpy.argwhere(seen)[::40009]:
            self.open(f"#channel=N&x={x + 0.5}&y={y + 0.5}&zoom=16")
            shown = numpy.array(self.driver.execute_script(COLOUR_AT_CENTRE))
            self.assertLessEqual(numpy.abs(shown - 127.5 * (normals[y, x] + 1)).max(), 0.51, (x, y))
        self.assertFalse(self.one("#scale").is_displayed())

    def test_cryptomatte_is_shown_by_names(self):
        fathom("render", DATA / "scenes/pair.json", "--size", "160x120", "--cryptomatte", "-o", self.folder / "matte.exr")
        self.open(page=self.viewed("matte.exr"))
        options = [option.get_attribute("value") for option in Select(self.one("#channel")).options]
        self.assertIn("CryptoObject", options)
        self.assertNotIn("CryptoObject00.R", options)
        shown, mask = self.values(0, "CryptoObject", "u4")
        shares, _ = self.values(0, "CryptoObject.coverage", "f4")
        numpy.testing.assert_array_equal(mask != 0, shares > 0)
        rows, columns = numpy.nonzero(shares == 1)
        self.open(f"#pixel={columns[0]},{rows[0]}", page=(self.folder / "matte.html").as_uri())
        number = shown[rows[0], columns[0]]
        self.assertEqual(self.reading()["CryptoObject"], f"{number}  {['spot', 'teapot'][number]}")

    def test_a_full_hd_map_is_small_and_needs_no_other_file(self):
        fathom("camera", "look-at", "--eye", "0,0,-1", "--target", "0.2,-0.1,-4", "--fov", "60", "--size", "1920x1080",
               "-o", self.folder / "inside.json")
        fathom("render", DATA / "scenes/room.json", "--camera", self.folder / "inside.json", "--channels", "Z,A,id,N",
               "-o", self.folder / "hd.exr")
        self.open(page=self.viewed("hd.exr"))
        self.assertLess((self.folder / "hd.html").stat().st_size, 5e5)
        self.assertEqual(self.driver.execute_script("return performance.getEntriesByType('resource').length"), 0)
        self.wait_for(lambda: self.driver.execute_script("return performance.getEntriesByType('mark').length === 2"),
                      "the times that scripts/dev/measure-view reads")

    def test_it_fits_narrow_windows(self):
        for width in (1280, 400):
            self.resize(width, 850)
            self.open("#mode=difference&pixel=300,200")
            self.assertLessEqual(self.how_far_it_scrolls_sideways("html"), 0)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
