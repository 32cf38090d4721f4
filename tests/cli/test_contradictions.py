"""Columns of a log that contradict its counts; a log that was cut out of another; light without a number; an interval too short."""

import json
import random
import tempfile
from pathlib import Path

from support import CliTest, csv_text, quiet_log, run

QUIET = 80


class Contradictions(CliTest):
    def warnings(self, rows, name):
        raw = self.write(f"{name}.csv", csv_text(rows))
        said = self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force").stderr
        return [line for line in said.splitlines() if "columns mode and bias_sign contradict" in line]

    def test_an_inverted_mode_is_answered_with_its_first_row(self):
        rows = quiet_log(QUIET)
        self.assertEqual(self.warnings(rows, "right"), [])
        for row in rows[50:]:
            row["mode"] = -1
        lines = self.warnings(rows, "inverted")
        self.assertEqual(len(lines), 1)
        self.assertIn("first in half-period 50: bias_sign * mode is -1 and then +1, and the counts are 250 and then -50", lines[0])

    def test_a_closing_without_detuning_is_answered_unless_that_is_asked_for(self):
        rows = quiet_log(QUIET)

        def lines(name, *options):
            raw = self.write(f"{name}.csv", csv_text(rows))
            said = self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force", *options).stderr
            return [line for line in said.splitlines() if "compensation.relock is not set" in line]

        self.assertEqual(lines("closed"), [], "no loop was opened")
        for row in rows[40:46]:
            row["loop_closed"] = 0
        self.assertEqual(len(lines("opened")), 1)
        for relock in ("none", "frequency"):
            self.assertEqual(lines("opened", "--set", f"compensation.relock={relock}"), [])

    def test_a_reversed_flag_of_the_loop_and_a_lost_direction_are_answered(self):
        for column, value, says in (("loop_closed", lambda row: 1 - row["loop_closed"], "the loop is open in 160 of 160 half-periods"),
                                    ("counts", lambda row: abs(row["counts"]), "the direction of the counter may be missing")):
            rows = quiet_log(QUIET, counts=0)
            raw = self.write(f"{column}.csv", csv_text(rows))
            self.assertNotIn(says, self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force").stderr)
            for row in rows:
                row[column] = value(row)
            raw.write_text(csv_text(rows))
            self.assertIn(says, self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force").stderr)

    def test_a_log_that_was_cut_out_is_refused_with_what_to_do(self):
        raw = self.write("cut.csv", csv_text(quiet_log(QUIET)[20:]))
        self.refuse((2, 3), "process", raw, "--out", self.folder / "angles.csv",
                    says=("column 'half'", "'20' leaves a hole; expected 0, where the numbers of every log begin"))


class Calibrations(CliTest):
    """A log whose columns contradict its counts gives a warning, and no constant that follows from both."""

    BY_MODE = ("bias_hz", "bias_temperature_coefficient_per_c", "bias_chi", "magnetic_arcsec_s", "magnetic_thermal_arcsec_s",
               "nonmagnetic_arcsec_s", "random_walk_arcsec_sqrt_s")

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            good = Path(folder) / "good.csv"
            run("simulate", "--duration", 120, "--set", "motion.kind=rest", "--set", "switching.interval_s=3", "--out", good)
            lines = good.read_text().splitlines()
        cls.head = [line for line in lines if line.startswith("#")]
        names, *rows = [line.split(",") for line in lines if not line.startswith("#")]
        cls.names, cls.rows = names, [dict(zip(names, row)) for row in rows]

    def calibrated(self, name, change=None, **options):
        """What is said, what JSON, TOML and text hold of a log in which change(row number, row) was made."""
        rows = [dict(row) for row in self.rows]
        for k, row in enumerate(rows if change else ()):
            row.update({key: str(value) for key, value in change(k, row).items()})
        log, toml = self.write(f"{name}.csv", "\n".join([*self.head, ",".join(self.names), *(",".join(row.values()) for row in rows)]) + "\n"), \
            self.folder / f"{name}.toml"
        result = run("calibrate", log, "--json", "--out", toml, "--force")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        found, text = json.loads(result.stdout), run("calibrate", log).stdout
        for key, reason in found["not_determined"].items():
            self.assertIn(f"# {key.split('.')[-1]}: not determined: {reason}\n", toml.read_text())
            self.assertIn(f"{key}: not determined: {reason}\n", text)
        self.succeed("simulate", toml, "--duration", 1, "--out", self.folder / "a.csv", "--force")
        return result.stderr, found["constants"], found["not_determined"]

    def refuse_what_follows_the_mode(self, name, change, warned="columns mode and bias_sign contradict the counts"):
        said, constants, refused = self.calibrated(name, change)
        self.assertEqual(warned in said if warned else not said, True, said)
        for key in constants:
            self.assertNotIn(key.split(".")[-1], self.BY_MODE, constants[key])
        self.assertTrue(refused["gyro.bias_hz"])

    def test_a_good_log_is_silent(self):
        said, constants, _ = self.calibrated("good")
        self.assertEqual(said, "")
        self.assertAlmostEqual(constants["gyro.bias_hz"]["value"], 60e3, delta=30.0)

    def test_of_one_sign_throughout_or_from_somewhere_on(self):
        n = len(self.rows)
        for column in ("mode", "bias_sign"):
            self.refuse_what_follows_the_mode(column, lambda k, row: {column: -int(row[column])})
        for part in (0.3, 0.5, 0.9):
            self.refuse_what_follows_the_mode("part", lambda k, row: {"mode": int(row["mode"]) * (-1 if k > part * n else 1)})
        self.refuse_what_follows_the_mode("constant", lambda k, row: {"mode": 1})
        self.refuse_what_follows_the_mode("late", lambda k, row: {"mode": self.rows[max(k - 400, 0)]["mode"]})
        self.refuse_what_follows_the_mode("lag", lambda k, row: {"counts": self.rows[max(k - 1, 0)]["counts"]})

    def test_of_counts_that_are_none(self):
        generator = random.Random(5)
        self.refuse_what_follows_the_mode("abs", lambda k, row: {"counts": abs(int(row["counts"]))}, "the direction of the counter")
        self.refuse_what_follows_the_mode("random", lambda k, row: {"counts": generator.randint(-300, 300)}, None)
        self.refuse_what_follows_the_mode("zero", lambda k, row: {"counts": 0}, "the counter stands still")

    def test_of_voltages_that_do_not_go_with_the_switches(self):
        generator = random.Random(6)
        _, constants, refused = self.calibrated("piezo", lambda k, row: {"piezo_v": generator.uniform(0.0, 200.0)})
        self.assertIn("gyro.bias_hz", constants)
        self.assertNotIn("piezo.half_wave_v", constants)
        self.assertIn("switches", refused["piezo.half_wave_v"])

    def test_a_smaller_bias_than_presumed_on_a_turning_gyro_is_no_lost_direction(self):
        path = self.folder / "small.csv"
        self.succeed("simulate", "--duration", 60, "--set", "gyro.bias_hz=10000", "--set", "motion.kind=constant", "--set",
                     "motion.rate_arcsec_s=360000", "--set", "switching.interval_s=3", "--out", path)
        lines = [line for line in path.read_text().splitlines() if not line.startswith("# gyro.bias_hz")]
        result = run("calibrate", self.write("unsaid.csv", "\n".join(lines) + "\n"), "--rate-arcsec-s=360000", "--json")
        self.assertEqual(result.stderr, "")
        self.assertAlmostEqual(json.loads(result.stdout)["constants"]["gyro.bias_hz"]["value"], 10e3, delta=30.0)


class Runs(CliTest):
    def test_light_without_a_number_is_logged_and_processed_like_the_run(self):
        fault = ["kind=light_nan", "at_s=2.0", "duration_s=0.1", "size=0"]
        for relock in ("mean_square", "joint"):
            out = self.folder / relock
            self.succeed("run", "--duration", 5, "--light", "--set", f"compensation.relock={relock}", "--set",
                         "switching.interval_s=1", *[word for key in fault for word in ("--set", f"faults.{key}")], "--out", out)
            self.succeed("process", out / "raw.h5", "--out", self.folder / f"{relock}.csv")
            self.succeed("convert", out / "angles.h5", "--out", self.folder / f"{relock}-run.csv")
            rows = [[line for line in (self.folder / name).read_text().splitlines() if line[0].isdigit()]
                    for name in (f"{relock}.csv", f"{relock}-run.csv")]
            self.assertEqual(rows[0], rows[1])

    def test_an_interval_shorter_than_a_switch_is_answered_with_what_is_reached(self):
        for interval, warned in ((0.1, True), (1.0, False)):
            verb = self.lack_switches if warned else self.succeed
            said = verb("run", "--duration", 8, "--set", f"switching.interval_s={interval}", "--out",
                        self.folder / str(interval)).stderr
            self.assertEqual("the gyro switched every" in said, warned, said)
