"""`zlg design`: what a designer's script reads, against computations made here."""

import json
from math import exp, tanh

from support import CliTest, run

METHODS = ["corrected", "worst_case", "as_printed", "closed_form"]


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
        result = json.loads(self.succeed("design", "--json", "--set", f"design.run_lengths_s=[{lengths}]", *options).stdout)
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
            }
            for method, budget in budgets.items():
                interval, drift = least(budget, t)
                self.assertAlmostEqual(found[t, method][0] / interval, 1.0, delta=1e-3, msg=f"{method}, {t} s")
                self.assertAlmostEqual(found[t, method][1] / drift, 1.0, delta=1e-6, msg=f"{method}, {t} s")

    def test_the_papers_gyro(self):
        self.check(0.7, 0.7, 3000, 0.05, 10)


class Refusals(CliTest):
    def test_what_is_no_gyro_and_no_run(self):
        for arguments in (["--set", "design.run_lengths_s=-5"], ["--set", "design.run_lengths_s=abc"],
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
