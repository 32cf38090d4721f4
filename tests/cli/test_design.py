"""`zlg design`: what a designer's script reads, against computations made here."""

import json
from math import exp, hypot, sqrt, tanh
import re
import unittest

from support import CliTest, run

METHODS = ["corrected", "worst_case", "as_printed", "closed_form", "random_sign"]


def least(budget, run_s):
    """The minimum of a budget over a fine grid of intervals, refined once."""
    low, high = run_s / 1e5, run_s
    for _ in range(6):
        grid = [low * (high / low) ** (k / 400) for k in range(401)]
        best = min(range(401), key=lambda k: budget(grid[k]))
        low, high = grid[max(best - 1, 0)], grid[min(best + 1, 400)]
    return grid[best], budget(grid[best])


class Optimum(CliTest):
    def optimum(self, lengths, *settings):
        options = [word for setting in settings for word in ("--set", setting)]
        result = json.loads(self.succeed("design", "--json", "--run-lengths", lengths, *options).stdout)
        return {(line["run_s"], line["method"]): (line["interval_s"], line["drift_arcsec_s"]) for line in result["optimum"]}

    def check(self, a, om, tau, nm, dp, *settings):
        found = self.optimum("600,36000", *settings)
        self.assertEqual(sorted(found), sorted((t, m) for t in (600, 36000) for m in METHODS))
        for t in (600, 36000):
            budgets = {
                "corrected": lambda L: nm + a * tau / t * tanh(L / 2 / tau) * (1 - exp(-t / tau)) + L * om / t + dp / L,
                "worst_case": lambda L: nm + ((a + om) * L - a * tau * tanh(L / 2 / tau) * (1 + exp(-t / tau))) / t + dp / L,
                "as_printed": lambda L: nm + a * tau / 2 / L * (1 - exp(-L / tau)) ** 2 + L * om / t + dp / L,
                "closed_form": lambda L: nm + L * om / t + dp / L,
                # The worst end of worst_case beside independent errors.
                "random_sign": lambda L: nm + hypot(((a + om) * L - a * tau * tanh(L / 2 / tau) * (1 + exp(-t / tau))) / t,
                                                    dp / sqrt(t * L)),
            }
            for method, budget in budgets.items():
                interval, drift = least(budget, t)
                self.assertAlmostEqual(found[t, method][0] / interval, 1.0, delta=1e-3, msg=f"{method}, {t} s")
                self.assertAlmostEqual(found[t, method][1] / drift, 1.0, delta=1e-6, msg=f"{method}, {t} s")

    def test_the_papers_gyro(self):
        self.check(0.7, 0.7, 3000, 0.05, 10)

    def test_another_gyro(self):
        self.check(2.5, 1.2, 900, 0.01, 3, "drift.magnetic_thermal_arcsec_s=2.5", "drift.magnetic_arcsec_s=1.2",
                   "drift.thermal_time_s=900", "drift.nonmagnetic_arcsec_s=0.01", "design.switch_error_arcsec=3")


class Substitution(CliTest):
    def test_worst_errors_of_the_papers_hard_case(self):
        result = json.loads(self.succeed("design", "--json", "--set", "motion.frequency_hz=20").stdout)
        lines = {(line["order"], line["gap_ticks"]): line for line in result["substitution"]}
        # Direct integration of the ticks at the extremum, 12 000 arcsec/s, 20 Hz.
        for order, gap, worst in ((0, 1, 26.03), (1, 2, 77.57), (0, 3, 154.51), (2, 1, 1.44), (2, 2, 8.19), (2, 3, 26.85)):
            self.assertAlmostEqual(lines[order, gap]["worst_arcsec"], worst, delta=0.006)
            self.assertAlmostEqual(lines[order, gap]["rms_arcsec"], lines[order, gap]["worst_arcsec"] / sqrt(2), delta=1e-9)
            self.assertEqual(lines[order, gap]["frequency_hz"], 20)
        self.assertAlmostEqual(lines[0, 3]["noise_gain"], 1.5, delta=1e-12)
        self.assertAlmostEqual(lines[2, 3]["noise_gain"], 3.808, delta=5e-4)


class Refusals(CliTest):
    def test_what_is_no_gyro_and_no_run(self):
        for arguments in (["--run-lengths", "-5"], ["--run-lengths", "abc"], ["--run-lengths", ""], ["--run-lengths", "600] #"],
                          ["--set", "drift.thermal_time_s=0"], ["--set", "design.switch_error_arcsec=0"],
                          ["--set", "drift.magnetic_arcsec_s=0", "--set", "drift.magnetic_thermal_arcsec_s=0"],
                          ["--set", "compensation.points_before=1", "--set", "compensation.points_after=1"],
                          ["--set", "drift.magnetic_arcsec_s=nan"], ["--out", "design.pdf"]):
            result = run("design", *arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_a_page_is_written_once(self):
        page = self.folder / "design.html"
        self.succeed("design", "--out", page)
        self.assertIn("<svg", page.read_text())
        self.assertEqual(run("design", "--out", page).returncode, 3)


class OptimalInterval(CliTest):
    def test_a_run_takes_the_optimum_of_its_own_length(self):
        raw = self.folder / "raw.csv"
        options = ["--duration", "600", "--set", "switching.interval_s=optimal", "--set", "design.switch_error_arcsec=2"]
        result = self.succeed("simulate", *options, "--out", raw)
        # Independent errors beside a sawtooth of L Om/2 about what the start leaves, at an end anywhere.
        om = 0.7 + 0.7 * (1 - exp(-0.2))
        best = (2**2 * 600 / (2 * (0.7**2 + om**2 / 3) / 4)) ** (1 / 3)
        found = float(re.search(r"# switching.interval_s = (\S+)", raw.read_text()[:5000]).group(1))
        self.assertAlmostEqual(found / best, 1.0, delta=0.005)
        self.assertIn(f"{found:.4g} s here", result.stderr)

    def test_what_a_switch_leaves_is_tried_unless_it_is_given(self):
        def best(*settings):
            options = [word for setting in settings for word in ("--set", setting)]
            result = json.loads(self.succeed("design", "--json", "--run-lengths", "600", *options).stdout)
            return result["switch_error_arcsec"], result["switch_error_is_given"], result["runs"][0]["best"]["interval_s"]

        good = best("motion.kind=rest")
        bad = best("motion.frequency_hz=20.06", "compensation.bridge=constant")
        self.assertFalse(good[1])
        # A constant misses 12 000 arcsec/s at 20 Hz by 154.51 arcsec at the worst phase, 109 rms.
        self.assertAlmostEqual(bad[0] / 109, 1.0, delta=0.2)
        self.assertGreater(bad[2], 10 * good[2])
        self.assertEqual(best("design.switch_error_arcsec=10")[:2], (10, True))


if __name__ == "__main__":
    unittest.main()
