"""The lab page as `zlg lab --follow` serves it: the live picture, loaded again, and after a lost connection."""

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from lab_browser import ROOT, PageCase
from test_lab import ZLG, zlg

sys.path.insert(0, str(ROOT / "tests" / "cli"))
from lab_server import LabServer, Line  # noqa: E402


class Live(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.files = Path(folder.name)
        made = zlg("simulate", "--duration", 60, "--set", "switching.interval_s=5", "--out", cls.files / "raw.h5", "--wire", cls.files / "line.bin")
        assert made.returncode == 0, made.stderr
        cls.bytes = (cls.files / "line.bin").read_bytes()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def serve(self, source, *options):
        server = LabServer(source, *options)
        self.addCleanup(server.close)
        return server

    def line(self, lasts_s, **options):
        line = Line(self.folder / "line", self.bytes, lasts_s, **options)
        self.addCleanup(line.close)
        return line

    def wait_for_the_last(self):
        """Of the records that a line has given, when no more come."""
        shown_s = [-1.0, 0.0]
        while shown_s[-1] < 59.9 or shown_s[-1] != shown_s[-2]:
            time.sleep(0.5)
            shown_s.append(self.time_s())
            self.assertLess(len(shown_s), 120)

    def shown(self, name):
        return self.browser.value(f"[...document.querySelectorAll('.values dt')].find(e => e.textContent === {name!r})?.nextElementSibling.textContent ?? null")

    def requests_of(self, server):
        asked = [e["params"]["request"]["url"] for e in self.browser.events if e.get("method") == "Network.requestWillBeSent"]
        return [url for url in asked if url not in (server.address, f"{server.address}records") and not url.startswith(("data:,", "blob:"))]

    def test_the_picture_lives_and_is_that_of_the_log_at_the_end(self):
        server = self.serve(self.line(4.0, then_ends=True).source)
        self.browser.visit(server.address)
        self.browser.wait_for_state("live")
        before_s = self.time_s()
        self.browser.wait_until(lambda: self.time_s() > before_s + 5.0)
        self.browser.wait_for_state("the source has ended")
        self.browser.wait_until(lambda: self.browser.marked("time") == "60.0000")
        angles = self.files / "angles.csv"
        self.assertEqual(zlg("process", self.files / "raw.h5", "--out", angles, "--force").returncode, 0)
        rows = [line.split(",") for line in angles.read_text().splitlines() if line[0].isdigit()]
        angle = sum(float(row[3]) for row in rows)
        self.assertAlmostEqual(float(self.shown("Angle").split()[0].replace("−", "-")) / angle, 1.0, delta=1e-5)
        self.assertAlmostEqual(float(self.shown("Rate").split()[0].replace("−", "-")) / (float(rows[-1][3]) / 0.005), 1.0, delta=1e-5)
        self.assertRegex(self.browser.text("main"), r"At 55 s nothing was measured for 3 ticks \(15 ms\); mode [+−]1 after it")
        self.assertIn("warming up", self.browser.value("[...document.querySelectorAll('ul.health')].map(e => e.textContent).join()"))
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.requests_of(server), [])

    def test_loaded_again_it_shows_all_that_was(self):
        server = self.serve(self.line(1.0).source)
        self.browser.visit(server.address)
        self.wait_for_the_last()
        before = self.shown("Angle"), self.browser.marked("time"), self.browser.text("main")
        self.browser.visit(server.address)
        self.wait_for_the_last()
        self.assertEqual((self.shown("Angle"), self.browser.marked("time"), self.browser.text("main")), before)
        # The chart of the angle begins at the start, though most of the rows are no longer kept one by one.
        self.assertEqual(self.browser.value("document.querySelectorAll('main .u-over').length"), 7)

    def test_after_a_lost_connection_it_shows_what_there_is_then(self):
        server = self.serve(self.line(20.0).source)
        self.browser.visit(server.address)
        self.browser.wait_for_state("live")
        # The program is killed, and another one has its port later.
        port = server.port
        server.end(signal.SIGKILL)
        self.browser.wait_for_state("connection lost, trying again")
        angles = self.files / "other.h5"
        self.assertEqual(zlg("process", self.files / "raw.h5", "--out", angles, "--force").returncode, 0)
        other = subprocess.Popen([ZLG, "lab", "--follow", angles, "--port", str(port)], stdout=subprocess.PIPE)
        self.addCleanup(other.communicate)
        self.addCleanup(other.kill)
        self.browser.wait_for_state("the source has ended")
        self.browser.wait_until(lambda: self.browser.marked("time") == "60.0000")
        self.assertIsNone(self.shown("Piezo"))
        self.assertIn("other.h5", self.browser.text(".what"))

    def test_a_gyro_that_falls_silent_is_not_called_live(self):
        server = self.serve(self.line(1.0).source)
        self.browser.visit(server.address)
        self.wait_for_the_last()
        self.browser.wait_until(lambda: re.fullmatch(r"no record for \d+ s", self.browser.marked("state")))

    def test_a_program_that_was_stopped_for_a_while_is_followed_on(self):
        server = self.serve(self.line(8.0).source)
        self.browser.visit(server.address)
        self.browser.wait_for_state("live")
        server.process.send_signal(signal.SIGSTOP)
        time.sleep(2.0)
        server.process.send_signal(signal.SIGCONT)
        self.browser.wait_until(lambda: self.time_s() > 59.9)
        self.assertEqual(self.browser.marked("state"), "live")

    def test_a_page_that_sleeps_gets_the_right_picture_when_it_wakes(self):
        server = self.serve(self.line(3.0).source)
        self.browser.visit(server.address)
        self.browser.wait_for_state("live")
        renderers = self.renderers()
        self.assertTrue(renderers)
        for pid in renderers:
            os.kill(pid, signal.SIGSTOP)
        time.sleep(4.0)
        for pid in renderers:
            os.kill(pid, signal.SIGCONT)
        self.browser.wait_until(lambda: self.time_s() > 59.9)
        angle = self.shown("Angle")
        self.browser.visit(server.address)
        self.browser.wait_until(lambda: self.time_s() > 59.9)
        self.assertEqual(self.shown("Angle"), angle)

    def renderers(self):
        """Processes of the browser that run pages."""
        parents, renderers = {}, []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                parents[int(folder.name)] = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
                if b"--type=renderer" in (folder / "cmdline").read_bytes().replace(b" ", b"\0").split(b"\0"):
                    renderers.append(int(folder.name))
            except OSError:
                continue  # it has ended meanwhile
        return [pid for pid in renderers if self.is_below(pid, self.browser.process.pid, parents)]

    def is_below(self, pid, ancestor, parents):
        while pid and pid != ancestor:
            pid = parents.get(pid, 0)
        return pid == ancestor

    def test_nothing_is_wider_than_the_screen(self):
        server = self.serve(self.files / "line.bin")
        for width in (390, 760, 1200):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark):
                    self.browser.visit(server.address, width=width, dark=dark)
                    self.browser.wait_until(lambda: self.time_s() > 59.9)
                    self.assertEqual(self.browser.value("document.documentElement.scrollWidth"), width)
        self.assertEqual(self.browser.complaints(), [])
