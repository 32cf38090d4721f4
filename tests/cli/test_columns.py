"""Optional columns of a raw log: the same bits live and processed, in both formats; what they are without; what is refused."""

import csv

from support import body_of, CliTest, csv_text, quiet_log, Text

COLUMNS = ["half", "bias_sign", "mode", "counts", "loop_closed"]
LASER = ["gyro.fidelity=laser"]
JOINT = ["compensation.relock=joint"]
MISSED = ["faults.kind=frame_missed", "faults.at_s=6", "faults.duration_s=0.1", "faults.size=0"]
# Column, settings. The joint estimate needs the light, which a CSV log cannot hold.
RUNS = [("edge_offset_ticks", [*LASER, "gyro.dither=auto"]), ("edge_offset_ticks", [*LASER, "gyro.dither=paired"]),
        ("edge_offset_ticks", [*LASER, "gyro.dither=random"]), ("fringe", ["gyro.readout=phase"]), ("fringe", ["gyro.readout=phase", *LASER]),
        ("fringe", ["gyro.readout=phase", *JOINT]), ("fringe", ["gyro.readout=phase", *LASER, *JOINT]),
        ("lit", []), ("lit", LASER), ("lit", JOINT), ("lit", [*LASER, *JOINT]), ("span", MISSED)]


class Columns(CliTest):
    def converted(self, log, name):
        out = self.folder / name
        self.succeed("convert", log, "--out", out, "--force")
        return out

    def processed(self, raw):
        out = self.folder / "angles.csv"
        self.succeed("process", raw, "--out", out, "--force")
        return body_of(out)

    def test_live_processed_and_converted_give_the_same_bytes(self):
        for k, (column, settings) in enumerate(RUNS):
            with self.subTest(column=column, settings=settings):
                kind, light = ("h5", ["--light"]) if JOINT[0] in settings else ("csv", [])
                out = self.folder / str(k)
                self.succeed("run", "--duration", 20, "--set", "switching.interval_s=4", *(word for key in settings for word in ("--set", key)),
                             *light, "--out", out, "--format", kind)
                raw, live = out / f"raw.{kind}", out / f"angles.{kind}"
                packed = self.converted(raw, "raw.h5")
                self.assertIn(column, self.succeed("inspect", packed).stdout)
                live = body_of(live if kind == "csv" else self.converted(live, "live.csv"))
                self.assertEqual(self.processed(raw), live)
                self.assertEqual(self.processed(packed), live)
                if kind == "csv":
                    self.assertEqual(self.converted(packed, "back.csv").read_bytes(), raw.read_bytes())

    def test_lit_halves_of_a_gap_are_those_after_its_middle(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", "--duration", 30, "--set", "switching.interval_s=4", "--out", raw)
        rows = csv.DictReader(body_of(raw).decode().splitlines())
        gaps = "".join(row["lit"] if row["loop_closed"] == "0" else " " for row in rows).split()
        self.assertGreater(len(gaps), 4)
        self.assertEqual(set(gaps), {"000111"})

    def test_what_was_not_asked_for_has_no_column(self):
        raw = self.folder / "raw.csv"
        self.succeed("simulate", "--duration", 2, "--set", LASER[0], "--out", raw)
        for name in ("edge_offset", "timer_hz", "fringe"):
            self.assertNotIn(name, raw.read_text())

    def rows(self, column, value):
        return [dict(row, **{column: value}) for row in quiet_log(100, gap=range(50, 53))]

    # Without a detuning nothing is known of the false rotation, so lit halves are not used.
    def test_a_column_that_says_nothing_changes_nothing(self):
        for column, value in (("lit", 0), ("lit", 1), ("fringe", Text("nan"))):
            rows = self.rows(column, value)
            angles = [self.processed(self.write("raw.csv", csv_text(rows, columns))) for columns in ([*COLUMNS, column], COLUMNS)]
            self.assertEqual(angles[0], angles[1], column)

    def test_other_values_are_refused_with_row_and_value(self):
        for column, values, allowed in (("lit", ("2", "-1", "yes", "", "0.5", "nan"), ""),
                                        ("fringe", ("-1", "65536", "0.5", "inf", "", "x"), "allowed is 0..65535, or nan where it is not known")):
            for value in values:
                with self.subTest(column=column, value=value):
                    rows = self.rows(column, 1)
                    rows[4][column] = Text(value)
                    raw = self.write("raw.csv", csv_text(rows, [*COLUMNS, column]))
                    self.refuse(3, "process", raw, "--out", self.folder / "x.csv", says=(f"row 5, column '{column}'", f"'{value}'", allowed))
