"""The charts of the theory on the lab page: they follow the gyro, and say what `zlg design` says."""

import json
import math
import re

from lab_browser import PageCase
from test_lab import zlg


def shown(text, pattern):
    return [float(number.replace("\u2212", "-")) for number in re.search(pattern, text).groups()]


class DesignCharts(PageCase):
    def of_the_program(self, *settings):
        options = [word for setting in settings for word in ("--set", setting)]
        return json.loads(zlg("design", "--json", "--set", "design.run_lengths_s=3600", *options).stdout)

    def open(self, *settings):
        """The text of the card. No switch has been measured yet."""
        self.browser.open_lab("&".join(settings))
        self.browser.wait_until(lambda: "This gyro" in self.browser.text("#design-text"))
        self.assertIn("(presumed)", self.browser.text("#design-text"))
        return self.browser.text("#design-text")

    def test_the_expected_drift_of_any_interval_is_that_of_the_formula(self):
        # Without warming: |nm| + sqrt((L Om/t)^2/3 + s^2/(t L)). A run is an hour, or as long as the interval.
        for interval_s in (3, 40, 90, 3000, 20000):
            with self.subTest(interval_s):
                text = self.open(f"switching.interval_s={interval_s}", "drift.magnetic_thermal_arcsec_s=0", "drift.magnetic_arcsec_s=0.5", "drift.nonmagnetic_arcsec_s=0.02")
                run_s = max(3600, interval_s)
                expected = 0.02 + math.sqrt((interval_s * 0.5 / run_s) ** 2 / 3 + 10**2 / (run_s * interval_s))
                self.assertAlmostEqual(shown(text, rf"switches every {interval_s} s: ([\d.]+) deg/h")[0] / expected, 1.0, delta=0.006)

    def test_the_best_interval_is_that_of_the_program(self):
        for settings in (["design.switch_error_arcsec=7"], ["design.switch_error_arcsec=2", "switching.first_segment=half"],
                         ["drift.magnetic_arcsec_s=0.3", "drift.magnetic_thermal_arcsec_s=-0.2", "drift.thermal_time_s=900"]):
            with self.subTest(settings=settings):
                text = self.open(*settings)
                given = settings if settings[0].startswith("design.") else [*settings, "design.switch_error_arcsec=10"]
                best = self.of_the_program(*given)["runs"][0]["best"]
                interval_s, drift = shown(text, r"best to switch every ([\d.]+) s: ([\d.]+) deg/h")
                self.assertAlmostEqual(interval_s / best["interval_s"], 1.0, delta=0.006)
                self.assertAlmostEqual(drift / best["drift_arcsec_s"], 1.0, delta=0.006)

    def test_without_a_magnetic_drift_no_switch_pays(self):
        text = self.open("drift.magnetic_arcsec_s=0", "drift.magnetic_thermal_arcsec_s=0")
        self.assertIn("no switch pays", text)

    def test_once_there_have_been_switches_what_they_leave_is_taken(self):
        self.browser.open_lab("switching.interval_s=1")
        self.browser.fill("#speed", "2")
        self.browser.wait_until(lambda: re.match(r"A switch leaves [\d.]+ arcsec\.", self.browser.text("#design-text")))

    def test_a_gyro_that_stands_has_one_error_of_its_switches(self):
        for until_s in (400, 430):
            self.browser.open_lab(f"switching.interval_s=30&until={until_s}")
            self.browser.wait_for_state("done")
            in_histogram = r"rms error .*, as configured ([\d.]+) arcsec"
            self.browser.wait_until(lambda: re.match(r"A switch leaves ([\d.]+) arcsec\.", self.browser.text("#design-text")))
            self.browser.wait_until(lambda: shown(self.browser.text("#design-text"), r"A switch leaves ([\d.]+)") == shown(self.browser.text("#histogram-text"), in_histogram), timeout_s=5)
