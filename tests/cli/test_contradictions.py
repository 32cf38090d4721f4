"""Columns of a log that contradict its counts; a log that was cut out of another; light without a number; an interval too short."""

import unittest

from support import CliTest, csv_text, quiet_log

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

    def test_a_bias_sign_of_a_reversed_coil_is_answered(self):
        rows = quiet_log(QUIET)
        for row in rows:
            row["bias_sign"] = -row["bias_sign"]
        self.assertEqual(len(self.warnings(rows, "coil")), 1)

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
            said = self.succeed("run", "--duration", 8, "--set", f"switching.interval_s={interval}", "--out",
                                self.folder / str(interval)).stderr
            self.assertEqual("the gyro switched every" in said, warned, said)


if __name__ == "__main__":
    unittest.main()
