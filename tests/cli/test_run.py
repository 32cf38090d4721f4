"""`zlg run`, `simulate` and `inspect`: what they write, and that the same seed gives the same bytes."""

import csv
import json
import math
import re
import unittest
from pathlib import Path

from oracle import Settings, compensate, find_gaps
from support import AngleLog, CliTest, body_of, folder_until, run

FILES = ["raw.csv", "angles.csv", "health.csv", "switches.csv", "summary.json", "report.html"]
VARIANTS = ["one_mode", "switching", "relock_frequency", "relock_detuning", "relock_mean_square", "bridge_constant",
            "bridge_linear", "bridge_quadratic", "configured"]
NUMBERS = ["drift_arcsec_s", "angle_error_arcsec", "switch_error_mean_arcsec", "switch_error_rms_arcsec", "switch_error_max_arcsec"]
DURATION_S, INTERVAL_S, TICK_S = 60, 5, 0.005
SHORT = ["--duration", DURATION_S, "--set", f"switching.interval_s={INTERVAL_S}"]
N_TICKS = round(DURATION_S / TICK_S)


def raw_rows(path):
    """Rows of a raw log with the types of the contract."""
    body = body_of(path).decode().splitlines()
    real = ("detuning_lambda", "detuning_sq_lambda2", "piezo_v", "temperature_c")
    return [{name: float(text) if name in real else int(text) for name, text in row.items()} for row in csv.DictReader(body)]


def values_of(path):
    """The `# section.key = value` lines of a log."""
    text = Path(path).read_text()
    return dict(re.findall(r"^#\s*(\w+\.\w+)\s*=\s*(.*?)\s*$", text, re.MULTILINE))


def settings_of(path):
    """The oracle's settings as a log's own lines give them, defaults elsewhere."""
    found = {}
    for key, text in values_of(path).items():
        name = key.split(".")[1]
        default = getattr(Settings, name, None)
        if key.split(".")[0] in ("gyro", "compensation") and default is not None:
            found[name] = text.strip("\"'") if isinstance(default, str) else type(default)(float(text))
    found.setdefault("relock", "mean_square")
    return Settings(**found)


SHARED = {}


def setUpModule():
    """One run serves every test here."""
    CliTest.setUpClass()
    folder = SHARED["folder"] = folder_until(unittest.addModuleCleanup)
    SHARED["result"] = run("run", *SHORT, "--out", folder / "first", "--format", "csv", "--json")
    if SHARED["result"].returncode != 0:
        raise AssertionError(f"zlg run fails: exit {SHARED['result'].returncode}, {SHARED['result'].stderr}")


class RunTest(CliTest):
    """Has the shared run at hand."""

    def setUp(self):
        super().setUp()
        self.out, self.result = SHARED["folder"] / "first", SHARED["result"]


class Outputs(RunTest):
    def test_files(self):
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), sorted(FILES))

    def test_json_is_one_object_and_names_the_variants_in_order(self):
        result = json.loads(self.result.stdout)
        summary = json.loads((self.out / "summary.json").read_text())
        for name, table in (("--json", result), ("summary.json", summary)):
            self.assertIsInstance(table, dict, name)
            self.assertEqual([variant["name"] for variant in table["variants"]], VARIANTS, name)
        self.assertEqual(result["variants"], summary["variants"], "--json and summary.json differ")

    def test_variants_have_every_number(self):
        for variant in json.loads(self.result.stdout)["variants"]:
            for name in NUMBERS:
                with self.subTest(variant=variant["name"], number=name):
                    value = variant[name]
                    if variant["name"] == "one_mode" and name.startswith("switch") and value is None:
                        continue
                    self.assertIsInstance(value, (int, float))
                    self.assertTrue(math.isfinite(value), value)

    def test_compensation_makes_the_switch_error_smaller(self):
        rms = {v["name"]: v["switch_error_rms_arcsec"] for v in json.loads(self.result.stdout)["variants"]}
        self.assertLess(rms["relock_mean_square"], rms["switching"] / 3.0, "mean_square hardly helps")
        self.assertLess(rms["configured"], rms["switching"] / 3.0, "the configured compensation hardly helps")

    def test_raw_log_is_whole_and_switches_as_configured(self):
        rows = raw_rows(self.out / "raw.csv")
        self.assertEqual([row["half"] for row in rows], list(range(2 * N_TICKS)))
        signs = {row["bias_sign"] * (-1) ** (row["half"] % 2) for row in rows}
        self.assertEqual(len(signs), 1, "the bias does not alternate")
        gaps = find_gaps(compensate(rows, Settings(bridge="none")))
        expected = DURATION_S // INTERVAL_S - 1
        self.assertIn(len(gaps), (expected, expected + 1), f"gaps at {gaps}")
        self.assertEqual({last - first + 1 for first, last in gaps}, {3}, "switching.gap_ticks is 3")
        for first, last in gaps:
            self.assertEqual(rows[2 * first - 1]["mode"], -rows[2 * last + 2]["mode"], f"helicity at the gap {first}..{last}")

    def test_switches_has_one_row_per_gap(self):
        rows = raw_rows(self.out / "raw.csv")
        gaps = find_gaps(compensate(rows, Settings(bridge="none")))
        switches = list(csv.DictReader(body_of(self.out / "switches.csv").decode().splitlines()))
        self.assertEqual([int(row["tick"]) for row in switches], [first for first, _ in gaps])

    def test_angles_agree_with_the_oracle(self):
        out = self.folder / "polynomial"  # the oracle knows no other bridge
        self.succeed("run", *SHORT, "--set", "compensation.bridge=quadratic", "--out", out, "--format", "csv")
        settings = settings_of(out / "raw.csv")
        ticks = compensate(raw_rows(out / "raw.csv"), settings)
        log = AngleLog(out / "angles.csv")
        self.assertEqual(len(log.rows), len(ticks))
        worst = max(max(abs(log.dtheta[k] - float(t.dtheta)), abs(log.final[k] - float(t.final))) for k, t in enumerate(ticks))
        self.assertLess(worst, 1e-9, f"worst difference in arcsec, {settings}")


class Replay(RunTest):
    def test_simulate_writes_the_raw_log_of_run(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", *SHORT, "--out", raw)
        self.assertEqual(body_of(raw), body_of(self.out / "raw.csv"))
        angles = self.folder / "angles.csv"
        self.succeed("process", raw, "--out", angles)
        self.assertEqual(body_of(angles), body_of(self.out / "angles.csv"), "the angles of the simulated log differ")

    def test_same_seed_gives_the_same_bytes(self):
        again = self.folder / "first"
        self.succeed("run", *SHORT, "--out", again, "--format", "csv")
        for name in FILES:
            with self.subTest(file=name):
                self.assertEqual((again / name).read_bytes(), (self.out / name).read_bytes())

    def test_threads_change_nothing(self):
        for threads in (1, 2):
            out = self.folder / f"threads-{threads}"
            self.succeed("run", *SHORT, "--out", out, "--format", "csv", "--threads", threads)
            for name in FILES[:4]:
                with self.subTest(file=name, threads=threads):
                    self.assertEqual((out / name).read_bytes(), (self.out / name).read_bytes())

    def test_other_seed_gives_another_run(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", *SHORT, "--seed", 2, "--out", raw)
        self.assertNotEqual(body_of(raw), body_of(self.out / "raw.csv"))

    def test_default_seed_is_one(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", *SHORT, "--seed", 1, "--out", raw)
        self.assertEqual(body_of(raw), body_of(self.out / "raw.csv"))


class Folders(RunTest):
    def test_existing_folder_needs_force(self):
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        self.refuse((2, 3), "run", "--duration", "1", "--out", self.out, says=["--force"])
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir()}, before)

    def test_force_replaces_the_files_of_a_run(self):
        out = self.folder / "again"
        self.succeed("run", "--duration", "2", "--out", out, "--format", "csv")
        self.succeed("run", "--duration", "1", "--out", out, "--format", "csv", "--force")
        self.assertEqual(len(raw_rows(out / "raw.csv")), 400)

    def test_default_folder_is_new_each_time(self):
        for _ in range(2):
            self.succeed("run", "--duration", "1", cwd=self.folder)
        names = sorted(path.name for path in self.folder.iterdir())
        self.assertEqual(len(names), 2)
        for name in names:
            self.assertRegex(name, r"^zlg-run-\d{3}$")


# Half a wavelength takes twice the voltage that the processor presumes.
NEVER = ["--duration", 20, "--set", "switching.interval_s=5", "--set", "perimeter.miss_lambda=0", "--set", "piezo.half_wave_error=-0.5"]


class Switches(CliTest):
    def test_a_run_in_which_no_switch_succeeds_says_so_and_exits_1(self):
        result = run("run", *NEVER, "--json", "--out", self.folder / "run", "--format", "csv")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no switch of modes succeeded", result.stderr)
        self.assertGreater(json.loads(result.stdout)["switches_failed"], 0)
        self.assertEqual(sorted(path.name for path in (self.folder / "run").iterdir()), sorted(FILES))
        self.assertIn("no switch of modes succeeded", (self.folder / "run" / "report.html").read_text())
        result = run("run", *NEVER, "--out", self.folder / "text")
        self.assertIn("no switch of modes succeeded", result.stdout)

    def test_so_does_simulate(self):
        result = run("simulate", *NEVER, "--out", self.folder / "raw.csv")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no switch of modes succeeded", result.stderr)
        self.assertTrue((self.folder / "raw.csv").exists())

    def test_a_run_without_a_switch_that_is_due_is_good(self):
        self.succeed("run", *NEVER[:2], "--set", "switching.interval_s=90", "--out", self.folder / "run")

    def test_a_laser_that_is_dark_at_its_miss_switches_at_the_second_attempt(self):
        short = [word for setting in ("gyro.fidelity=laser", "laser.perimeter_m=0.12", "perimeter.loop=digital", "switching.interval_s=5")
                 for word in ("--set", setting)]
        result = json.loads(self.lack_switches("run", *short, "--duration", 32, "--json", "--out", self.folder / "run").stdout)
        self.assertGreaterEqual(result["switches"], 3)
        self.assertLess(abs(result["variants"][-1]["angle_error_arcsec"]), 60.0)

    def test_one_constant_of_a_laser_is_not_told_alone(self):
        short = [word for setting in ("gyro.fidelity=laser", "laser.perimeter_m=0.12", "switching.interval_s=5") for word in ("--set", setting)]
        agreeing = self.succeed("run", *short, "--set", "gyro.bias_hz=79766.7", "--duration", 32, "--json", "--out", self.folder / "agrees")
        self.assertIn("gyro.bias_chi = 6.37", agreeing.stderr)
        self.assertLess(json.loads(agreeing.stdout)["variants"][-1]["switch_error_rms_arcsec"], 6.0)
        off = self.succeed("run", *short, "--set", "gyro.bias_chi=3.6", "--duration", 12, "--json", "--out", self.folder / "off")
        line = "gyro.bias_chi = 3.6 is presumed, [laser] makes 6.37"
        self.assertIn(f"warning: {line}", off.stderr)
        self.assertIn(line, " ".join(json.loads(off.stdout)["warnings"]))
        self.assertIn(line, (self.folder / "off" / "report.html").read_text())


class FromEventToEvent(CliTest):
    """gyro.fidelity = "events": figures without a log of every half."""

    EVENTS = ["--set", "gyro.fidelity=events", "--set", "switching.interval_s=20", "--duration", 100]

    def test_a_log_of_every_half_is_refused_and_nothing_written(self):
        for logs in ("all", "angles"):
            self.refuse(2, "run", *self.EVENTS, "--logs", logs, "--out", self.folder / "run", says=("gyro.fidelity", f"--logs {logs}"))
        self.refuse(2, "simulate", *self.EVENTS, "--out", self.folder / "raw.csv", says=("gyro.fidelity", "raw log"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_switches_have_their_true_errors_and_the_page_its_curves(self):
        result = json.loads(self.succeed("run", *self.EVENTS, "--logs", "none", "--json", "--out", self.folder / "run").stdout)
        rows = list(csv.DictReader(body_of(self.folder / "run" / "switches.csv").decode().splitlines()))
        self.assertEqual([int(row["tick"]) for row in rows], [4000 * k for k in range(1, 5)])
        for row in rows:
            self.assertLess(abs(float(row["true_error_arcsec"])), 6 * float(row["sigma_arcsec"]))
        self.assertEqual(result["ticks"], 20_000)
        self.assertEqual(result["ticks_invalid"], 0)
        self.assertTrue((self.folder / "run" / "report.html").exists())

    def test_it_says_why_every_half_is_lived(self):
        result = json.loads(self.succeed("run", *self.EVENTS, "--set", "piezo.hysteresis=0.1", "--logs", "none", "--json", "--out",
                                         self.folder / "run").stdout)
        self.assertIn("the whole run is simulated half by half, for piezo.hysteresis = 0.1", " ".join(result["warnings"]))


class WhatIsCounted(CliTest):
    """`switches_unrepaired` and `ticks_as_whole_counts` of the summary, against the columns of the logs."""

    def result(self, *settings):
        out = self.folder / "run"
        shown = run("run", *settings, "--out", out, "--format", "csv", "--force").stdout
        rows = list(csv.DictReader(body_of(out / "raw.csv").decode().splitlines()))
        ticks = list(zip(rows[0::2], rows[1::2]))
        measured = [all(half[name] == "1" for half in tick for name in ("loop_closed", "valid", "span")) for tick in ticks]
        return json.loads((out / "summary.json").read_text()), shown, ticks, measured, out

    def test_switches_that_no_bridge_repairs_are_counted_and_left_out(self):
        """Without light from 5 ms before the switch at 20 s for 90 ms: more than the 16 ticks that a bridge repairs. A gap of 30 ms is repaired."""
        summary, shown, ticks, measured, out = self.result(
            "--duration", 40, "--set", "switching.interval_s=5", "--set", 'faults.kind=["beam_fades","laser_off"]', "--set", "faults.at_s=[10.0,19.995]",
            "--set", "faults.duration_s=[0.03,0.09]", "--set", "faults.size=[1.0,0]")
        begins = [k for k in range(1, len(measured)) if measured[k - 1] and not measured[k]]
        ends = [next(k for k in range(begin, len(measured)) if measured[k]) for begin in begins]
        switched = [(b, e) for b, e in zip(begins, ends) if ticks[b - 1][1]["mode"] != ticks[e][0]["mode"]]
        too_long = [b for b, e in switched if e - b > 16]
        self.assertEqual(len(too_long), 1)
        self.assertEqual(summary["switches"], len(switched))
        counted = {variant["name"]: variant["switches_unrepaired"] for variant in summary["variants"]}
        self.assertEqual(counted, {name: 0 if name in ("one_mode", "switching") else 1 for name in VARIANTS})
        self.assertIn(f"1 of {len(switched)} switches have a gap that no bridge repairs", shown)
        lines = list(csv.DictReader((out / "switches.csv").read_text().splitlines()))
        errors = {int(line["tick"]): abs(float(line["true_error_arcsec"])) for line in lines}
        self.assertGreater(errors[too_long[0]], 100.0)
        others = [error for tick, error in errors.items() if tick not in too_long]
        self.assertAlmostEqual(summary["variants"][-1]["switch_error_max_arcsec"], max(others), places=9)
        self.assertAlmostEqual(summary["variants"][-1]["switch_error_rms_arcsec"], math.sqrt(sum(e * e for e in others) / len(others)), places=9)

    def test_ticks_that_are_read_as_whole_counts(self):
        phase = ["--duration", 10, "--set", "switching.interval_s=2", "--set", "gyro.readout=phase"]
        for settings, least, most in (([], 50, 200), (["--set", "photodiodes.adc_bits=1"], 1950, 2000)):
            summary, shown, ticks, measured, _ = self.result(*phase, *settings)
            whole = sum(is_measured and second["fringe"] == "nan" for is_measured, (_, second) in zip(measured, ticks))
            self.assertTrue(least < whole <= most, whole)
            self.assertEqual(summary["ticks_as_whole_counts"], whole)
            self.assertIn(f"{whole} of 2000 ticks were read as whole counts", shown)
        summary, shown, *_ = self.result("--duration", 10, "--set", "switching.interval_s=2")
        self.assertEqual(summary["ticks_as_whole_counts"], 0)
        self.assertNotIn("whole counts", shown)
