"""`zlg process` against the oracle on random logs: any motion, gaps anywhere, every method."""

import itertools
import math

from oracle import Settings, compensate
from random_logs import drop_columns, random_gaps, random_log, random_settings
from support import AngleLog, CliTest, csv_text, quiet_log, set_options, warnings

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
    def test_every_method_of_relock_and_of_bridging(self):
        for relock, bridge, case in itertools.product(METHODS, BRIDGES, range(5)):
            settings = random_settings(self.random, relock, bridge)
            gaps = random_gaps(self.random, 90)
            rows = random_log(self.random, settings, gaps, 90)
            columns = drop_columns(self.random, rows, NEEDED[relock])
            with self.subTest(relock=relock, bridge=bridge, case=case):
                self.check(rows, settings, f"gaps at {sorted(gaps)}, {settings}", columns)

    def test_standard_points_and_ordinary_gaps(self):
        for relock in METHODS:
            rng = self.random
            settings = Settings(relock=relock, bias_hz=60e3 * rng.uniform(0.99, 1.01))
            gaps = {k + j for k in range(20, 300, 41) for j in range(3)}
            with self.subTest(relock=relock):
                self.check(random_log(rng, settings, gaps, 320), settings, f"defaults, {relock}")


class LongAndEdgeGaps(OracleTest):
    # Of 16 ticks and more, within a log, at its start and at its end; a log that is one gap.
    SPANS = [(20, 36), (20, 37), (20, 60), (0, 16), (0, 17), (0, 40), (64, 80), (63, 80), (40, 80), (0, 80)]

    def test_are_those_of_the_oracle(self):
        for (first, end), bridge, relock in itertools.product(self.SPANS, BRIDGES[1:], ("none", "frequency")):
            settings = Settings(bridge=bridge, relock=relock, bias_hz=60123.4)
            rows = random_log(self.random, settings, set(range(first, end)), 80)
            with self.subTest(first=first, end=end, bridge=bridge, relock=relock):
                self.check(rows, settings, f"gap {first}..{end - 1}")


class SettingsAndForms(OracleTest):
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
