"""A Chromium without a window, for pages that lie in files."""
import contextlib
import ctypes
import os
import pathlib
import signal
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

PATIENCE = 30  # seconds that a page, or the end of a process, may take on a machine that is busy


@contextlib.contextmanager
def headless_chromium():
    """A driver of a browser whose files lie in a folder of its own, which is its home too. Browser, driver and
    folder are gone afterwards, also where the test is interrupted; a process that is not gone is an error."""
    for number in (signal.SIGINT, signal.SIGTERM):
        # unittest cleans up after any exception but KeyboardInterrupt.
        signal.signal(number, lambda *_: sys.exit("interrupted"))
    _adopt_orphans()
    with tempfile.TemporaryDirectory(prefix="fathom-chromium-") as home:
        # The wrapper of Debian's package reads HOME, and fontconfig, NSS and others write there.
        service = Service("/usr/bin/chromedriver", env={**os.environ, "HOME": home, "TMPDIR": home})
        try:
            with webdriver.Chrome(service=service, options=_options(home)) as driver:
                yield driver
        finally:
            _expect_no_child()


def _options(home):
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--window-size=1400,1200", f"--user-data-dir={home}/profile",
                     "--no-sandbox",             # which root cannot have; the pages are our own
                     "--disable-gpu", "--disable-dev-shm-usage",  # /dev/shm is small in containers
                     "--no-first-run", "--disable-background-networking", "--disable-component-update"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return options


def _adopt_orphans():
    """What Chromium's processes leave when they end becomes ours to wait for, not init's."""
    set_child_subreaper = 36  # linux/prctl.h
    if ctypes.CDLL(None, use_errno=True).prctl(set_child_subreaper, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def _expect_no_child():
    end = time.monotonic() + PATIENCE
    survivors = []
    with contextlib.suppress(ChildProcessError):  # there is none, or none any more
        while True:
            if os.waitpid(-1, os.WNOHANG) != (0, 0):
                continue
            if time.monotonic() > end:
                survivors += _end_children()
            time.sleep(0.05)
    if survivors:
        raise RuntimeError(f"processes {survivors} of Chromium outlived it")


def _end_children():
    children = pathlib.Path(f"/proc/self/task/{os.getpid()}/children").read_text().split()
    for child in children:
        os.kill(int(child), signal.SIGKILL)
    return children


def errors_in_console(driver):
    """What the page complained about since the last call: errors of scripts, files that it did not get."""
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
