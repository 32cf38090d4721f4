"""The lab page in Debian's Chromium."""

import sys
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "build" / "release" / "share" / "zlg" / "lab.html"
sys.path.insert(0, str(ROOT / "tests" / "browser"))

from chromium import PROGRAM, Browser  # noqa: E402,F401


class LabBrowser(Browser):
    """Opens the page, and asks for the elements that it marks for readers by machine."""

    def __init__(self):
        super().__init__()
        self.send("Network.enable")
        self.n_opened = 0

    def open_lab(self, fragment="", path=PAGE, **options):
        # Another query each time: a change of the fragment alone loads nothing.
        self.n_opened += 1
        self.open(f"{path}?{self.n_opened}{'#' if fragment else ''}{fragment}", **options)

    def marked(self, name):
        return self.value(f"document.querySelector('[data-zlg=\"{name}\"]').textContent")

    def text(self, selector):
        return self.value(f"document.querySelector({selector!r}).textContent")

    def wait_until(self, condition, timeout_s=60):
        """Ask until the condition holds; its value."""
        end = time.monotonic() + timeout_s
        while not (found := condition()):
            if time.monotonic() > end:
                raise AssertionError(f"not within {timeout_s} s; state {self.marked('state')}, time {self.marked('time')}, message {self.marked('message')!r}")
            time.sleep(0.05)
        return found

    def wait_for_state(self, *states, timeout_s=60):
        return self.wait_until(lambda: self.marked("state") in states and self.marked("state"), timeout_s)

    def press(self, selector):
        """Click the middle of an element."""
        x, y = self.value(f"""(() => {{ const e = document.querySelector({selector!r}); e.scrollIntoView({{block: 'center', behavior: 'instant'}});
            const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()""")
        self.click(x, y)

    def fill(self, selector, text):
        """Put a text into a field, or choose it, as a reader does."""
        self.value(f"""(() => {{ const e = document.querySelector({selector!r}); e.value = {text!r};
            e.dispatchEvent(new Event('input', {{bubbles: true}})); e.dispatchEvent(new Event('change', {{bubbles: true}})); }})()""")

    def requests(self):
        """Addresses that were asked for, but for the page itself and what it made."""
        asked = [e["params"]["request"]["url"] for e in self.events if e.get("method") == "Network.requestWillBeSent"]
        return [url for url in asked if not url.startswith(("file:///", "data:,", "blob:"))]

    def give(self, selector, path):
        """Choose a file for an input, as a reader does in the browser's dialogue."""
        root = self.send("DOM.getDocument")["root"]["nodeId"]
        node = self.send("DOM.querySelector", nodeId=root, selector=selector)["nodeId"]
        self.send("DOM.setFileInputFiles", files=[str(path)], nodeId=node)


@unittest.skipUnless(PROGRAM, "there is no chromium")
@unittest.skipUnless(PAGE.exists(), "this build holds no lab page")
class PageCase(unittest.TestCase):
    """Claims of the page in one browser."""

    @classmethod
    def setUpClass(cls):
        cls.browser = LabBrowser()
        cls.addClassCleanup(cls.browser.close)

    def time_s(self):
        return float(self.browser.marked("time"))


class LivingPageCase(PageCase):
    """Claims of a gyro that is switched every second; none may leave a complaint or a request behind."""

    def setUp(self):
        self.browser.open_lab("switching.interval_s=1")
        self.browser.wait_for_state("running")

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])
