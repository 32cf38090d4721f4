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
        return json.loads(zlg("design", "--json", "--run-lengths", 3600, *options).stdout)

    def open(self, *settings):
        """The text of both cards. No switch has been measured yet."""
        self.browser.open_lab("&".join(settings))
        self.browser.wait_until(lambda: "This gyro" in self.browser.text("#design-text"))
        self.assertIn("(presumed)", self.browser.text("#design-text"))
        return self.browser.text("#design-text"), self.browser.text("#gap-text")

    def test_the_expected_drift_of_any_interval_is_that_of_the_formula(self):
        # Without warming: |nm| + sqrt((L Om/t)^2/3 + s^2/(t L)). A run is an hour, or as long as the interval.
        for interval_s in (3, 40, 90, 3000, 20000):
            with self.subTest(interval_s):
                text, _ = self.open(f"switching.interval_s={interval_s}", "drift.magnetic_thermal_arcsec_s=0", "drift.magnetic_arcsec_s=0.5", "drift.nonmagnetic_arcsec_s=0.02")
                run_s = max(3600, interval_s)
                expected = 0.02 + math.sqrt((interval_s * 0.5 / run_s) ** 2 / 3 + 10**2 / (run_s * interval_s))
                self.assertAlmostEqual(shown(text, rf"switches every {interval_s} s: ([\d.]+) deg/h")[0] / expected, 1.0, delta=0.006)

    def test_the_best_interval_is_that_of_the_program(self):
        for settings in (["design.switch_error_arcsec=7"], ["design.switch_error_arcsec=2", "switching.first_segment=half"],
                         ["drift.magnetic_arcsec_s=0.3", "drift.magnetic_thermal_arcsec_s=-0.2", "drift.thermal_time_s=900"]):
            with self.subTest(settings=settings):
                text, _ = self.open(*settings)
                given = settings if settings[0].startswith("design.") else [*settings, "design.switch_error_arcsec=10"]
                best = self.of_the_program(*given)["runs"][0]["best"]
                interval_s, drift = shown(text, r"best to switch every ([\d.]+) s: ([\d.]+) deg/h")
                self.assertAlmostEqual(interval_s / best["interval_s"], 1.0, delta=0.006)
                self.assertAlmostEqual(drift / best["drift_arcsec_s"], 1.0, delta=0.006)

    def test_without_a_magnetic_drift_no_switch_pays(self):
        text, _ = self.open("drift.magnetic_arcsec_s=0", "drift.magnetic_thermal_arcsec_s=0")
        self.assertIn("no switch pays", text)

    def test_what_a_gap_leaves_is_what_the_program_says(self):
        for settings in ([], ["switching.gap_ticks=5", "motion.frequency_hz=3.3", "motion.amplitude_arcsec_s=2500"],
                         ["compensation.points_before=4", "compensation.points_after=4", "gyro.scale_arcsec=2"]):
            with self.subTest(settings=settings):
                _, text = self.open(*settings)
                ticks = int(re.search(r"A gap of (\d+) ticks", text)[1])
                lines = {line["order"]: line for line in self.of_the_program(*settings)["substitution"] if line["gap_ticks"] == ticks}
                # Of points that lie alike on both sides the worst moment is the extremum.
                found = shown(text, r"a constant misses by ([\d.]+) arcsec, a parabola by ([\d.]+);.* 3 sigma of ([\d.]+) and ([\d.]+) arcsec")
                expected = [lines[0]["worst_arcsec"], lines[2]["worst_arcsec"], 3 * lines[0]["counter_arcsec"], 3 * lines[2]["counter_arcsec"]]
                for a, b in zip(found, expected):
                    self.assertAlmostEqual(a / b, 1.0, delta=0.006)

    def test_what_is_extrapolated_misses_by_the_difference_of_the_integrals(self):
        _, text = self.open()
        turn = 2 * math.pi * 7.03
        angle = lambda tick, place: 12000 / turn * place(turn * (tick - 2) * 0.005)  # up to the end of a tick; the gap has 1, 2, 3, its middle is in tick 2
        for phase, place in (("extremum", lambda x: math.sin(x + turn * 0.0025)), ("zero", lambda x: -math.cos(x + turn * 0.0025))):
            with self.subTest(phase):
                self.browser.fill("#gap-phase", phase)
                wanted = 3 * (angle(0, place) - angle(-4, place)) / 4 - (angle(3, place) - angle(0, place))
                self.browser.wait_until(lambda: abs(shown(self.browser.text("#gap-text"), r"taken back, by ([\d.]+)")[0] / abs(wanted) - 1) < 0.006)
        # Where the rate passes zero, what is interpolated from both sides is exact.
        self.assertIn("a constant misses by 0 arcsec, a parabola by 0;", self.browser.text("#gap-text"))

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
