"""The lab page: its runs are those of the program, and it says what the program says."""

import base64
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from urllib.parse import quote

from lab_browser import PAGE, PROGRAM, ROOT, LabBrowser, PageCase

sys.path.insert(0, str(ROOT / "bench"))
from random_gyros import random_gyros  # noqa: E402

ZLG = ROOT / "build" / "release" / "bin" / "zlg"


def zlg(*arguments):
    return subprocess.run([ZLG, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def fragment_of(settings, until_s):
    pairs = [f"{key}={quote(value, safe='')}" for key, value in (each.split("=", 1) for each in settings)]
    return "&".join([*pairs, f"until={until_s}"])


class Runs(PageCase):
    def fingerprint(self, fragment):
        """Of the page, which stops by itself."""
        self.browser.open_lab(fragment)
        self.browser.wait_for_state("done", "refused", timeout_s=300)
        self.assertEqual(self.browser.marked("message"), "")
        self.assertEqual(self.browser.marked("state"), "done")
        return self.browser.marked("fingerprint")

    def fragment_of_the_page(self):
        """Of the link that the page makes for the run on the screen."""
        self.browser.press("#share")
        self.browser.press("#share-until")
        link = self.browser.value("document.getElementById('share-link').value")
        self.browser.value("document.getElementById('share-dialog').close()")
        return link.split("#", 1)[1]

    def summary_of_the_program(self, settings):
        with tempfile.TemporaryDirectory() as out:
            ran = zlg("run", *[word for each in settings for word in ("--set", each)], "--logs", "none", "--json", "--out", Path(out) / "run")
        self.assertNotEqual(ran.stdout, "", ran.stderr)
        return json.loads(ran.stdout)

    def of_the_program(self, settings):
        return self.summary_of_the_program(settings)["fingerprint"]

    def test_random_gyros_of_both_fidelities_give_the_fingerprints_of_the_program(self):
        """Every second is a laser. ZLG_LAB_GYROS="20 600" runs so many of so many seconds, with 240 000 half-periods each at the default tick."""
        n, duration_s = map(int, os.environ.get("ZLG_LAB_GYROS", "6 60").split())
        for gyro in random_gyros(n, duration_s, seed=3):
            with self.subTest(gyro=gyro):
                expected = self.of_the_program(gyro)
                self.assertEqual(self.fingerprint(fragment_of(gyro[1:], duration_s)), expected)
                self.assertAlmostEqual(float(self.browser.marked("time")), duration_s, delta=0.006)
                self.assertEqual(self.fingerprint(self.fragment_of_the_page()), expected)
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])

    def test_the_errors_of_the_switches_are_those_of_the_program(self):
        for settings in (["switching.interval_s=2"], ["switching.interval_s=1", "compensation.magnetic=estimate", "motion.frequency_hz=3.1"],
                         ["switching.interval_s=2", "gyro.readout=phase", "compensation.relock=joint"]):
            with self.subTest(settings=settings):
                self.fingerprint(fragment_of(settings, 40.6))
                text = self.browser.text("#histogram-text")
                summary = self.summary_of_the_program([*settings, "run.duration_s=40.6"])
                variants = {variant["name"]: variant for variant in summary["variants"]}
                self.assertEqual([variants[name]["switches_unrepaired"] for name in ("switching", "bridge_quadratic", "configured")], [0, 0, 0])
                self.assertTrue(text.startswith(f"{summary['switches']} switches;"), text)
                shown = re.search(r"as read ([\d.]+), as in the paper ([\d.]+), as configured ([\d.]+) arcsec", text).groups()
                for value, name in zip(shown, ("switching", "bridge_quadratic", "configured")):
                    expected = variants[name]["switch_error_rms_arcsec"]
                    self.assertAlmostEqual(float(value) / expected, 1.0, delta=0.006)  # three digits are shown

    def test_a_gyro_that_runs_in_steps_has_the_fingerprint_of_a_run_to_that_time(self):
        self.browser.open_lab("switching.interval_s=1")
        self.browser.wait_for_state("running")
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        before_s = float(self.browser.marked("time"))
        for _ in range(3):
            self.browser.press("#step-tick")
        self.browser.wait_until(lambda: abs(float(self.browser.marked("time")) - before_s - 0.015) < 1e-9)
        time_s = self.browser.marked("time")
        # After an odd half, the tick that has begun is not in a run.
        self.assertEqual(round(float(time_s) / 0.0025) % 2, round(before_s / 0.0025) % 2)
        if round(float(time_s) / 0.0025) % 2 == 1:
            self.browser.press("#step-half")
            self.browser.wait_until(lambda: self.browser.marked("time") != time_s)
        duration = self.browser.marked("time")
        self.assertEqual(self.browser.marked("fingerprint"), self.of_the_program(["switching.interval_s=1", f"run.duration_s={duration}"]))

    def test_what_the_program_refuses_the_page_refuses_with_the_same_words(self):
        for setting in ("run.duraton_s=10", "gyro.tick_s=abc", "switching.interval_s=-1", "gyro.tick_s", "perimeter.loop=none"):
            with self.subTest(setting):
                self.browser.open_lab(quote(setting, safe="=."))
                self.browser.wait_for_state("refused")
                said = zlg("run", "--set", setting, "--out", "/nowhere/run").stderr.strip()
                self.assertEqual(f"zlg: {self.browser.marked('message')}", said)
                self.assertEqual(self.browser.marked("fingerprint"), "")

    def test_a_motion_file_is_refused_for_the_page_reads_none(self):
        self.browser.open_lab("motion.kind=file&motion.path=x.csv")
        self.browser.wait_for_state("refused")
        self.assertIn("no files are read here", self.browser.marked("message"))

    def test_a_link_of_more_than_64_kb_is_refused(self):
        self.browser.open_lab("run.seed=1&" * 6000)
        self.browser.wait_for_state("refused")
        self.assertIn("66000 bytes; allowed are 65536", self.browser.marked("message"))

    def test_a_refused_link_leaves_no_old_gyro_on_the_page_and_a_good_one_is_taken(self):
        self.browser.open_lab()
        self.browser.wait_for_state("running")
        self.browser.value("location.hash = '#no.such=1'")
        self.browser.wait_for_state("refused")
        self.browser.value("location.hash = '#until=5'")
        self.browser.wait_for_state("done")
        self.assertEqual(self.browser.marked("fingerprint"), self.of_the_program(["run.duration_s=5"]))


@unittest.skipUnless(PAGE.exists(), "this build holds no lab page")
class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_lab_writes_the_page_once(self):
        out = self.folder / "lab.html"
        self.assertEqual(zlg("lab", "--out", out).returncode, 0)
        self.assertEqual(out.read_bytes(), PAGE.read_bytes())
        self.assertEqual(zlg("lab", "--out", out).returncode, 3)
        self.assertEqual(zlg("lab", "--out", out, "--force").returncode, 0)

    def test_wrong_usage(self):
        self.assertEqual(zlg("lab").returncode, 2)
        self.assertEqual(zlg("lab", "--out", self.folder / "lab.txt").returncode, 2)

    def test_the_page_is_small_and_forbids_requests(self):
        page = PAGE.read_text()
        self.assertLessEqual(len(page), 1_000_000)
        module = base64.b64decode(re.search(r'id="module">([^<]*)<', page)[1])
        self.assertEqual(gzip.decompress(module)[:4], b"\0asm")
        # A quarter of it reads text of other programs. wasm-opt and zopfli take a tenth off; the build does without them.
        self.assertLessEqual(len(module), 320_000 if shutil.which("wasm-opt") and shutil.which("zopfli") else 350_000)
        scripts = [part.split(">", 1)[1] for part in page.split("</script>")[:-1] for part in [part[part.rindex("<script"):]]]
        self.assertEqual(len(scripts), 3)
        self.assertLessEqual(sum(len(gzip.compress(script.encode())) for script in scripts[1:]), 90_000)
        self.assertIn("default-src 'none'", page)
        self.assertNotIn("connect-src", page)

    @unittest.skipUnless(PROGRAM, "there is no chromium")
    def test_the_report_of_a_run_leads_to_the_same_run_in_the_page(self):
        out = self.folder / "run"
        ran = zlg("run", "--duration", 8, "--set", "switching.interval_s=2", "--set", "motion.kind=rest", "--lab", "--logs", "none", "--json", "--out", out)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        browser = LabBrowser()
        self.addCleanup(browser.close)
        browser.open(out / "report.html")
        address = browser.value("document.querySelector('a[href^=\"lab.html\"]').getAttribute('href')")
        browser.open_lab(address.split("#")[1], path=out / "lab.html")
        browser.wait_for_state("done")
        self.assertEqual(browser.marked("fingerprint"), json.loads(ran.stdout)["fingerprint"])

    def test_a_run_on_a_motion_file_has_no_page(self):
        refused = zlg("run", "--set", "motion.kind=file", "--set", "motion.path=x.csv", "--lab", "--out", self.folder / "run")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--lab: the page reads no motion file", refused.stderr)


class WithoutPage(unittest.TestCase):
    def test_a_program_without_its_page_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            alone = Path(folder) / "bin" / "zlg"
            alone.parent.mkdir()
            alone.write_bytes(ZLG.read_bytes())
            alone.chmod(0o755)
            refused = subprocess.run([alone, "lab", "--out", Path(folder) / "lab.html"], capture_output=True, text=True)
            self.assertEqual(refused.returncode, 3)
            self.assertIn("holds no lab page", refused.stderr)
            self.assertFalse((Path(folder) / "lab.html").exists())
