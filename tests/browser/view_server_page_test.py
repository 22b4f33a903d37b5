#!/usr/bin/python3
"""The server of `fathom view --serve`: a click is answered as by `fathom probe`, and nobody else is answered at all.

    tests/browser/view_server_page_test.py FATHOM-VIEW
"""
import http.client
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.action_chains import ActionChains

from headless_chromium import headless_chromium
from page_case import PageCase

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
SPOT = DATA / "meshes/spot.obj"
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)(/[0-9a-f]{32}/)\n")


def fathom(*arguments):
    return subprocess.run([pathlib.Path(PROGRAM).parent / "fathom", "--quiet", *map(str, arguments)], check=True,
                          stdout=subprocess.PIPE, text=True).stdout


class Server(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fathom-server-")))
        cls.driver = cls.enterClassContext(headless_chromium())  # ends last: it expects that no other child is left
        cls.map = cls.folder / "map.exr"
        fathom("render", SPOT, "--size", "320x240", "--save-camera", cls.folder / "camera.json", "-o", cls.map)
        cls.process = subprocess.Popen([PROGRAM, cls.map, "--scene", SPOT, "--serve"], stdout=subprocess.PIPE, text=True)
        cls.addClassCleanup(cls.process.stdout.close)
        cls.addClassCleanup(cls.process.wait)
        cls.addClassCleanup(cls.process.kill)
        cls.address = cls.process.stdout.readline()
        found = ADDRESS.fullmatch(cls.address)
        cls.port, cls.place = int(found[1]), found[2]

    def answer(self, target, method="GET", host=None, body=None):
        """Status, headers and body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.putrequest(method, target, skip_host=True)
            if host != "":
                connection.putheader("Host", host or f"127.0.0.1:{self.port}")
            if body:
                connection.putheader("Content-Length", str(len(body)))
            connection.endheaders(body)
            reply = connection.getresponse()
            return reply.status, dict(reply.getheaders()), reply.read()
        finally:
            connection.close()

    def expect_nothing(self, *arguments, **named):
        status, _, body = self.answer(*arguments, **named)
        self.assertEqual((status, body), (404, b""), (arguments, named))

    def test_the_page_and_a_probe_are_answered(self):
        status, headers, page = self.answer(self.place)
        self.assertEqual(status, 200)
        self.assertIn(b'"probes":true', page)
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertNotIn("Access-Control-Allow-Origin", headers)
        told = fathom("probe", SPOT, "--camera", self.folder / "camera.json", "--pixel", "160,120")
        status, headers, answer = self.answer(self.place + "probe?map=0&x=160&y=120")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/plain; charset=utf-8"))
        self.assertEqual(answer.decode(), told)
        self.assertEqual(self.answer(self.place, host=f"localhost:{self.port}")[0], 200)

    def test_a_click_shows_what_probe_says(self):
        self.driver.get(self.address.strip() + "#x=160.5&y=120.5&zoom=32")
        self.wait_for(lambda: self.driver.execute_script("return document.documentElement.dataset.ready"), "the page")
        ActionChains(self.driver).click(self.one("#picture")).perform()
        self.wait_for(lambda: self.text("#probe").startswith("pixel ("), "the answer")
        x, y = self.driver.execute_script("return fathom.state().pixel")
        told = fathom("probe", SPOT, "--camera", self.folder / "camera.json", "--pixel", f"{x},{y}")
        self.assertEqual(self.one("#probe").get_attribute("textContent"), told)

    def test_wrong_tokens_are_not_answered(self):
        wrong = "/" + "0" * 32 + "/"
        for target in ("/", wrong, wrong + "probe?map=0&x=1&y=1", self.place[:-1], self.place[:-2] + "/", self.place.upper(),
                       "//", "", "*", "/favicon.ico", self.place[:-1] + "x/"):
            self.expect_nothing(target or "/index.html")

    def test_other_paths_are_not_answered(self):
        for below in ("index.html", "probe/", "../", "../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..%2f..%2fetc%2fpasswd",
                      "./", "probe%00", "map.exr", "camera.json"):
            self.expect_nothing(self.place + below)

    def test_other_hosts_are_not_answered(self):
        for host in ("example.com", f"example.com:{self.port}", "127.0.0.1", "localhost", f"127.0.0.1:{self.port}.example.com",
                     f"127.0.0.1:{self.port + 1}", ""):
            self.expect_nothing(self.place, host=host)

    def test_other_methods_are_not_answered(self):
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertNotEqual(self.answer(self.place, method=method)[0], 200)
            self.assertEqual(self.answer(self.place, method=method)[2], b"")

    def test_questions_that_make_no_sense_are_not_answered(self):
        for question in ("", "?", "?map=0&x=1", "?map=0&x=1&y=-1", "?map=0&x=320&y=0", "?map=0&x=0&y=240", "?map=1&x=0&y=0",
                         "?map=0&x=1&y=1&y=2", "?map=0&x=1e3&y=1", "?map=0&x=99999999999&y=1", "?map=0&x=%201&y=1", "?map=&x=&y="):
            self.expect_nothing(self.place + "probe" + question)

    def test_it_listens_at_the_loopback_alone(self):
        addresses = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
        for address in addresses - {"127.0.0.1"} | {"127.0.0.2"}:
            with self.assertRaises(OSError, msg=address):
                socket.create_connection((address, self.port), timeout=5).close()

    def test_an_interruption_ends_it(self):
        process = subprocess.Popen([PROGRAM, self.map, "--scene", SPOT, "--serve"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.assertRegex(process.stdout.readline(), ADDRESS)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)

    def test_options_that_do_not_fit_are_refused(self):
        for arguments, said in ((["--serve"], "--serve needs --scene"), (["--scene", SPOT], "--scene needs --serve")):
            outcome = subprocess.run([PROGRAM, self.map, *arguments], capture_output=True, text=True)
            self.assertEqual(outcome.returncode, 2)
            self.assertIn(said, outcome.stderr)

    def served(self, *arguments):
        """The answer about pixel (160, 120) of the first map, and what the server wrote to standard error."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments), "--serve"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        try:
            address = ADDRESS.fullmatch(process.stdout.readline())
            connection = http.client.HTTPConnection("127.0.0.1", int(address[1]), timeout=30)
            connection.request("GET", address[2] + "probe?map=0&x=160&y=120")
            answer = connection.getresponse().read().decode()
            connection.close()
        finally:
            process.send_signal(signal.SIGINT)
            _, said = process.communicate(timeout=30)
        return answer, said

    def test_a_map_without_camera_is_probed_by_a_camera_file(self):
        bare, camera = self.folder / "bare.npy", self.folder / "camera.json"
        fathom("convert", self.map, "-o", bare)
        refused = subprocess.run([PROGRAM, bare, "--scene", SPOT, "--serve"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("carries no camera, so that no pixel of it can be probed; give it with --camera", refused.stderr)
        answer, said = self.served(bare, "--camera", camera, "--scene", SPOT)
        self.assertEqual(answer, fathom("probe", SPOT, "--camera", camera, "--pixel", "160,120"))
        self.assertEqual(said, "")

    def test_another_scene_is_reported(self):
        answer, said = self.served(self.map, "--scene", DATA / "meshes/cube.obj")
        note = f"map.exr was rendered from {SPOT}, which this scene does not contain: another scene?"
        self.assertIn(note, answer.splitlines()[0])
        self.assertIn(note, said)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(failfast=True)
