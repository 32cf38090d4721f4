"""`zlg process` against the oracle on random logs: any motion, gaps anywhere, every method."""

import math
import unittest

from oracle import Settings, compensate
from random_logs import drop_columns, random_gaps, random_log, random_settings
from support import AngleLog, CliTest, body_of, csv_text, quiet_log, set_options, warnings

TOLERANCE_ARCSEC = 1e-9
METHODS = ["none", "frequency", "detuning", "mean_square"]
BRIDGES = ["none", "constant", "linear", "quadratic"]
NEEDED = {"none": [], "frequency": [], "detuning": ["detuning_lambda"],
          "mean_square": ["detuning_lambda", "detuning_sq_lambda2"]}


class OracleTest(CliTest):
    """Claims about one angle log, given the oracle's ticks."""

    def assert_angles(self, log, ticks, what):
        self.assertEqual(len(log.rows), len(ticks), f"{what}: one row per tick")
        for k, tick in enumerate(ticks):
            self.assertLessEqual(abs(log.dtheta[k] - float(tick.dtheta)), TOLERANCE_ARCSEC,
                                 f"{what}: dtheta of tick {k} is {log.dtheta[k]}, expected {float(tick.dtheta)}")
            self.assertLessEqual(abs(log.final[k] - float(tick.final)), TOLERANCE_ARCSEC,
                                 f"{what}: dtheta_final of tick {k} is {log.final[k]}, expected {float(tick.final)}")

    def assert_flag(self, log, k, name, expected, what):
        if expected is not None:
            self.assertEqual(log.has(k, name), expected, f"{what}: flag {name} of tick {k}")

    def assert_flags(self, log, ticks, rows, what):
        for k, tick in enumerate(ticks):
            halves = rows[2 * k : 2 * k + 2]
            self.assert_flag(log, k, "loop_unlocked", any(row["loop_closed"] == 0 for row in halves), what)
            self.assert_flag(log, k, "invalid", any(row.get("valid", 1) == 0 for row in halves), what)
            for name in ("extrapolated", "interpolated", "lower_order", "unrepaired", "relock_corrected", "relock_uncorrected"):
                self.assert_flag(log, k, name, getattr(tick, name), what)
            # A correction tick that has nothing to correct may or may not say so.
            expected = None if tick.correction and tick.lump == 0 else tick.correction
            self.assert_flag(log, k, "correction", expected, what)

    def assert_rows(self, log, ticks, rows, settings, what):
        for k, tick in enumerate(ticks):
            self.assertEqual(log.rows[k]["tick"], str(k), f"{what}: tick")
            self.assertLessEqual(abs(log.t_s[k] - (k + 1) * settings.tick_s), 1e-12 * (k + 1), f"{what}: t_s of tick {k}")
            self.assertIn(log.mode[k], {row["mode"] for row in rows[2 * k : 2 * k + 2]}, f"{what}: mode of tick {k}")
            if tick.unrepaired:
                self.assertEqual(log.sigma[k], math.inf, f"{what}: sigma of the unrepaired tick {k}")
            elif not (tick.gap and settings.bridge == "none"):
                self.assertTrue(0.0 < log.sigma[k] < math.inf, f"{what}: sigma of tick {k} is {log.sigma[k]}")

    def assert_law(self, log, ticks, what):
        """Both columns have the same sum from the start of the log wherever nothing is outstanding."""
        for k, tick in enumerate(ticks):
            if tick.correction and tick.settled:
                difference = math.fsum(log.dtheta[: k + 1]) - math.fsum(log.final[: k + 1])
                self.assertLessEqual(abs(difference), TOLERANCE_ARCSEC, f"{what}: the sums differ after tick {k}")

    def check(self, rows, settings, what, columns=None):
        log = self.process(rows, settings, columns)
        ticks = compensate(rows, settings)
        self.assert_angles(log, ticks, what)
        self.assert_rows(log, ticks, rows, settings, what)
        self.assert_flags(log, ticks, rows, what)
        self.assert_law(log, ticks, what)


class RandomLogs(OracleTest):
    def random_cases(self, relock, repeats=5, n_ticks=90):
        for bridge in BRIDGES:
            for case in range(repeats):
                settings = random_settings(self.random, relock, bridge)
                gaps = random_gaps(self.random, n_ticks)
                rows = random_log(self.random, settings, gaps, n_ticks)
                columns = drop_columns(self.random, rows, NEEDED[relock])
                what = f"case {case}, gaps at {sorted(gaps)}, {settings}"
                with self.subTest(relock=relock, bridge=bridge, case=case):
                    self.check(rows, settings, what, columns)

    def test_without_relock_correction(self):
        self.random_cases("none")

    def test_relock_by_frequency(self):
        self.random_cases("frequency")

    def test_relock_by_detuning(self):
        self.random_cases("detuning")

    def test_relock_by_mean_square(self):
        self.random_cases("mean_square")

    def test_standard_points_and_ordinary_gaps(self):
        for relock in METHODS:
            rng = self.random
            settings = Settings(relock=relock, bias_hz=60e3 * rng.uniform(0.99, 1.01))
            gaps = {k + j for k in range(20, 300, 41) for j in range(3)}
            with self.subTest(relock=relock):
                self.check(random_log(rng, settings, gaps, 320), settings, f"defaults, {relock}")


class LongAndEdgeGaps(OracleTest):
    def gap_cases(self, spans, n_ticks=80):
        for gap in spans:
            for bridge in BRIDGES[1:]:
                for relock in ("none", "frequency"):
                    settings = Settings(bridge=bridge, relock=relock, bias_hz=60123.4)
                    rows = random_log(self.random, settings, set(gap), n_ticks)
                    with self.subTest(gap=gap, bridge=bridge, relock=relock):
                        self.check(rows, settings, f"gap {gap}")

    def test_sixteen_ticks_are_bridged_and_seventeen_are_not(self):
        self.gap_cases([range(20, 36), range(20, 37), range(20, 60)])

    def test_long_gap_at_the_start_has_no_angle(self):
        self.gap_cases([range(0, 16), range(0, 17), range(0, 40)])

    def test_long_gap_at_the_end_keeps_the_mean(self):
        self.gap_cases([range(64, 80), range(63, 80), range(40, 80)])

    def test_log_without_a_measured_tick(self):
        self.gap_cases([range(0, 80), range(0, 5)], n_ticks=80)
        self.gap_cases([range(0, 5)], n_ticks=5)

    def test_log_of_a_few_ticks(self):
        for n_ticks in range(1, 9):
            for first in range(n_ticks):
                settings = Settings(relock="frequency", bias_hz=60123.4)
                rows = random_log(self.random, settings, {first}, n_ticks)
                with self.subTest(ticks=n_ticks, gap=first):
                    self.check(rows, settings, f"{n_ticks} ticks, gap at {first}")

    def test_every_distance_of_two_gaps(self):
        for distance in range(1, 9):
            for relock in METHODS:
                settings = Settings(relock=relock, bias_hz=60123.4)
                gaps = set(range(20, 23)) | set(range(23 + distance, 25 + distance))
                rows = random_log(self.random, settings, gaps, 50)
                with self.subTest(distance=distance, relock=relock):
                    self.check(rows, settings, f"gaps {sorted(gaps)}, {relock}")

    def test_a_gap_in_every_second_or_third_tick(self):
        for step in (2, 3):
            for first in (0, 5):
                for relock in ("none", "frequency"):
                    settings = Settings(relock=relock, bias_hz=60123.4, points_before=8, points_after=8, extrapolation_points=8)
                    rows = random_log(self.random, settings, set(range(first, 60, step)), 100)
                    with self.subTest(step=step, first=first, relock=relock):
                        self.check(rows, settings, f"a gap every {step} ticks from {first}")


class Polynomials(OracleTest):
    """Motion of the bridge's own order loses nothing, whatever the counter says inside the gap."""

    COEFFICIENTS = {"constant": (71234, 0, 0), "linear": (-51234, 1713, 0), "quadratic": (40321, -2111, 137)}

    def exact(self, bridge, n, settings):
        a, b, c = self.COEFFICIENTS[bridge]
        values = [a + b * k + c * k * (k - 1) // 2 for k in range(60)]
        rows = quiet_log(60, counts=0, gap=range(30, 30 + n))
        for k, value in enumerate(values):
            rows[2 * k]["counts"] += value if not 30 <= k < 30 + n else self.random.randint(-(10**6), 10**6)
        log = self.process(rows, settings)
        for k, value in enumerate(values):
            expected = value * settings.scale_arcsec
            self.assertAlmostEqual(log.dtheta[k], expected, delta=TOLERANCE_ARCSEC, msg=f"dtheta of tick {k}, n = {n}, {settings}")
            self.assertAlmostEqual(log.final[k], expected, delta=TOLERANCE_ARCSEC, msg=f"final of tick {k}, n = {n}, {settings}")

    def test_bridges_are_exact_on_their_own_order(self):
        for bridge in self.COEFFICIENTS:
            for n in range(1, 11):
                settings = Settings(scale_arcsec=1e-4, bridge=bridge, extrapolation_points=self.random.randint(3, 8),
                                    points_before=self.random.randint(2, 4), points_after=self.random.randint(2, 4))
                with self.subTest(bridge=bridge, n=n):
                    self.exact(bridge, n, settings)


class SettingsAndForms(OracleTest):
    def test_delivered_angles_never_look_ahead(self):
        settings = random_settings(self.random, "frequency", "quadratic")
        rows = random_log(self.random, settings, random_gaps(self.random, 80), 80)
        whole = self.process(rows, settings, name="whole")
        for n in range(1, 80, 7):
            part = self.process(rows[: 2 * n], settings, name="part")
            self.assertEqual(part.dtheta, whole.dtheta[:n], f"dtheta changes when the log is cut after tick {n}")

    def test_relock_defaults_to_what_the_log_allows(self):
        settings = Settings(bias_hz=60123.4)
        rows = random_log(self.random, settings, {20, 21, 22}, 60)
        for method in ("mean_square", "none"):
            raw, out = self.write("log.csv", csv_text(rows)), self.folder / f"{method}.csv"
            self.succeed("process", raw, "--out", out, "--set", "gyro.bias_hz=60123.4", "--set", "compensation.bridge=quadratic")
            ticks = compensate(rows, Settings(bias_hz=60123.4, relock=method))
            self.assert_angles(AngleLog(out), ticks, f"default of relock, expected {method}")
            for row in rows:
                row.pop("detuning_lambda", None)
                row.pop("detuning_sq_lambda2", None)

    def test_precedence_is_log_then_file_then_set(self):
        rows = random_log(self.random, Settings(), {20, 21, 22}, 60)
        lines = ["gyro.tick_s = 0.01", "gyro.scale_arcsec = 0.5", "compensation.bridge = \"constant\"", "compensation.relock = \"none\""]
        raw = self.write("log.csv", csv_text(rows, lines=lines))
        file = self.write("some.toml", "[compensation]\nbridge = \"linear\"\n")
        for bridge, options in (("constant", []), ("linear", ["--config", file]),
                                ("quadratic", ["--config", file, "--set", "compensation.bridge=quadratic"])):
            out = self.folder / f"{bridge}.csv"
            self.succeed("process", raw, "--out", out, *options)
            settings = Settings(tick_s=0.01, scale_arcsec=0.5, bridge=bridge)
            log = AngleLog(out)
            self.assert_angles(log, compensate(rows, settings), f"bridge {bridge} of the next higher source")
            self.assertAlmostEqual(log.t_s[0], 0.01, delta=1e-15, msg="tick_s of the log")

    def test_odd_last_half_is_dropped_with_a_warning(self):
        rows = quiet_log(20)
        whole = self.process(rows, Settings(), name="whole")
        raw, out = self.write("odd.csv", csv_text(rows + [dict(rows[0], half=40)])), self.folder / "odd-angles.csv"
        result = self.succeed("process", raw, "--out", out, *set_options(Settings()))
        self.assertTrue(warnings(result) or result.stderr.strip(), "no warning")
        self.assertEqual(AngleLog(out).dtheta, whole.dtheta)

    def test_unknown_column_is_ignored_with_a_warning(self):
        rows = [dict(row, operator_note=7) for row in quiet_log(20)]
        raw, out = self.write("note.csv", csv_text(rows, list(rows[0]))), self.folder / "a.csv"
        result = self.succeed("process", raw, "--out", out, *set_options(Settings()))
        self.assertIn("operator_note", result.stderr)

    def test_line_endings_of_the_log_do_not_matter(self):
        rows = random_log(self.random, Settings(), {20, 21}, 40)
        outs = []
        for name, text in (("lf", csv_text(rows)), ("crlf", csv_text(rows).replace("\n", "\r\n")), ("bare", csv_text(rows).rstrip("\n"))):
            outs.append(self.folder / f"{name}-angles.csv")
            self.succeed("process", self.write(f"{name}.csv", text.encode()), "--out", outs[-1], *set_options(Settings()))
        self.assertEqual(body_of(outs[0]), body_of(outs[1]), "CRLF")
        self.assertEqual(body_of(outs[0]), body_of(outs[2]), "no newline at the end")


if __name__ == "__main__":
    unittest.main()
