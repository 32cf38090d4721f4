"""What a stranger sees who opens the page: a gyro that lives, and what there is to do with it."""

import json
import re
import tempfile
import time
from pathlib import Path

from lab_browser import PageCase
from test_lab import zlg

PLACE = "(() => {{ const r = document.getElementById('card-{}').getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; }})()"


class FirstSeconds(PageCase):
    def place(self, card):
        return self.browser.value(PLACE.format(card))

    def test_the_first_switch_is_seen_within_six_seconds_and_no_card_is_empty(self):
        for width, height, dark in ((1200, 900, False), (1200, 900, True), (390, 844, False), (390, 844, True)):
            with self.subTest(width=width, dark=dark):
                begin = time.monotonic()
                self.browser.open_lab(width=width, height=height, dark=dark)
                self.browser.wait_until(lambda: self.browser.text("#switch-text").startswith("At "))
                self.assertLess(time.monotonic() - begin, 6)
                self.browser.wait_until(lambda: re.match(r"\d+ switch", self.browser.text("#histogram-text")))
                self.browser.wait_for_state("running")
                shown = self.browser.value("document.body.innerText")
                self.assertNotIn("No switch yet", shown)
                # No setting is called by the name that it has in a configuration.
                keys = re.findall(r"^\| `(\w+_\w+)` \|", zlg("--keys").stdout, re.MULTILINE)
                self.assertEqual([word for word in re.findall(r"[a-z]+\.[a-z_]+[a-z]\b", shown) if word.split(".")[1] in keys], [])
                self.assertEqual(self.browser.complaints(), [])

    def test_ring_error_and_faults_are_seen_together_on_a_screen_of_1200(self):
        self.browser.open_lab(width=1200, height=900)
        self.browser.wait_for_state("running")
        ring, error, faults = (self.place(card) for card in ("ring", "error", "faults"))
        for _, top, _, bottom in (ring, error, faults):
            self.assertGreaterEqual(top, 0)
            self.assertLessEqual(bottom, 900)
        self.assertEqual({error[0], faults[0]}, {error[0]})
        self.assertGreater(error[0], ring[2])
        self.assertEqual(len(self.browser.value("[...new Set([...document.querySelectorAll('main .card')].map(e => e.parentElement.closest('.column').getBoundingClientRect().left))]")), 2)

    def test_on_a_telephone_the_ring_is_seen_and_the_faults_follow_it(self):
        self.browser.open_lab(width=390, height=844)
        self.browser.wait_for_state("running")
        _, top, _, bottom = self.browser.value("(() => { const r = document.querySelector('#ring svg').getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; })()")
        self.assertGreaterEqual(top, 0)
        self.assertLessEqual(bottom, 844)
        self.assertAlmostEqual(self.place("faults")[1] - self.place("ring")[3], 14, delta=1)

    def test_the_ring_turns(self):
        self.browser.open_lab()
        self.browser.wait_for_state("running")
        dot = "document.querySelector('#ring circle').getAttribute('cx') + document.querySelector('#ring circle').getAttribute('cy')"
        before = self.browser.value(dot)
        self.browser.wait_until(lambda: self.browser.value(dot) != before, 2)

    def test_the_page_writes_its_gyro_into_its_address_and_obeys_one_that_has_a_gyro(self):
        self.browser.open_lab()
        self.browser.wait_for_state("running")
        self.assertEqual(self.browser.value("location.hash"), "#switching.interval_s=4")
        self.browser.wait_until(lambda: self.time_s() > 8.5)  # where it is at once
        self.browser.press("#run")
        self.browser.wait_for_state("paused")
        with tempfile.TemporaryDirectory() as out:
            paused_s = self.time_s()
            if round(paused_s / 0.0025) % 2 == 1:  # of a tick that has begun a run holds nothing
                self.browser.press("#step-half")
                self.browser.wait_until(lambda: self.time_s() != paused_s)
            duration = self.browser.marked("time")
            ran = zlg("run", "--duration", duration, "--set", "switching.interval_s=4", "--logs", "none", "--json", "--out", Path(out) / "run")
        self.assertEqual(json.loads(ran.stdout)["fingerprint"], self.browser.marked("fingerprint"))
        self.browser.open_lab("motion.kind=rest&until=2")
        self.browser.wait_for_state("done")
        self.assertEqual((self.browser.value("location.hash"), self.time_s()), ("#motion.kind=rest&until=2", 2.0))


class AnyOrder(PageCase):
    ORDERS = ((0, 1, 2), (2, 1, 0), (1, 0, 2), (1, 2, 0))
    SETTINGS = (("motion.kind", "sum"), ("motion.amplitude_arcsec_s", "[100, 200]"), ("motion.frequency_hz", "[1, 2]"))

    def test_settings_that_are_good_together_only_are_taken_in_any_order(self):
        for order in self.ORDERS:
            with self.subTest(order=order):
                self.browser.open_lab("switching.interval_s=1")
                self.browser.wait_for_state("running")
                for key, value in (self.SETTINGS[k] for k in order):
                    self.browser.fill(f'[data-key="{key}"] :is(input, select)', value)
                    time.sleep(0.3)
                self.browser.wait_until(lambda: not self.browser.marked("message"))
                link = self.browser.value("(document.getElementById('share').click(), decodeURIComponent(document.getElementById('share-link').value))")
                for key, value in self.SETTINGS:
                    self.assertIn(f"{key}={value}".replace(" ", ""), link.replace(" ", "").replace('"', ""))
                self.assertEqual(self.browser.value("[...document.querySelectorAll('.wrong')].map(e => e.textContent).join('')"), "")
