"""Lit halves: the same bits live and processed, in both formats, which halves they are, what is refused."""

import csv
import unittest

from support import CliTest, body_of, csv_text, quiet_log

INPUT = 3
COLUMNS = ["half", "bias_sign", "mode", "counts", "loop_closed", "lit"]
RUN = ["--duration", 30, "--set", "switching.interval_s=4", "--set", "compensation.relock=joint"]


class Text(str):
    """A field as it is."""

    def __repr__(self):
        return str(self)


class Lit(CliTest):
    def test_live_and_processed_angles_are_the_same_bytes(self):
        for fidelity in ("averaged", "laser"):
            for relock in ("mean_square", "joint"):
                with self.subTest(fidelity=fidelity, relock=relock):
                    kind, light = ("h5", ["--light"]) if relock == "joint" else ("csv", [])
                    out = self.folder / f"{fidelity}-{relock}"
                    self.succeed("run", *RUN, "--set", f"gyro.fidelity={fidelity}", "--set", f"compensation.relock={relock}", *light,
                                 "--out", out, "--format", kind)
                    again = self.folder / f"{out.name}.{kind}"
                    self.succeed("process", out / f"raw.{kind}", "--out", again)
                    bodies = []
                    for name, path in (("live", out / f"angles.{kind}"), ("again", again)):
                        if kind == "h5":
                            text = self.folder / f"{out.name}-{name}.csv"
                            self.succeed("convert", path, "--out", text)
                            path = text
                        bodies.append(body_of(path))
                    self.assertEqual(bodies[0], bodies[1])

    def test_both_formats_give_the_same_angles_and_keep_the_column(self):
        raw, packed, back = (self.folder / name for name in ("raw.csv", "raw.h5", "back.csv"))
        self.succeed("simulate", *RUN, "--out", raw)
        self.succeed("convert", raw, "--out", packed)
        self.succeed("convert", packed, "--out", back)
        self.assertEqual(body_of(raw), body_of(back))
        angles = []
        for path in (raw, packed):
            out = self.folder / f"angles-of-{path.name}.csv"
            self.succeed("process", path, "--out", out)
            angles.append(body_of(out))
        self.assertEqual(angles[0], angles[1])
        rows = csv.DictReader(body_of(raw).decode().splitlines())
        gaps = "".join(row["lit"] if row["loop_closed"] == "0" else " " for row in rows).split()
        self.assertGreater(len(gaps), 4)
        self.assertEqual(set(gaps), {"000111"})

    def rows(self, lit):
        rows = quiet_log(100, gap=range(50, 53))
        for row in rows:
            row["lit"] = lit
        return rows

    def test_a_log_without_the_column_is_one_without_lit_halves(self):
        bodies = []
        for name, columns in (("with", COLUMNS), ("without", COLUMNS[:-1])):
            raw = self.write(f"{name}.csv", csv_text(self.rows(0), columns))
            out = self.folder / f"angles-{name}.csv"
            self.succeed("process", raw, "--out", out)
            bodies.append(body_of(out))
        self.assertEqual(bodies[0], bodies[1])

    # Without a detuning nothing is known of the false rotation, so the halves are not used.
    def test_lit_halves_without_a_detuning_change_nothing(self):
        bodies = []
        for lit in (0, 1):
            raw = self.write(f"lit{lit}.csv", csv_text(self.rows(lit), COLUMNS))
            out = self.folder / f"angles-lit{lit}.csv"
            self.succeed("process", raw, "--out", out)
            bodies.append(body_of(out))
        self.assertEqual(bodies[0], bodies[1])

    def test_anything_but_0_and_1_is_refused_with_row_and_value(self):
        for value in ("2", "-1", "yes", "", "0.5", "nan"):
            with self.subTest(value=value):
                rows = self.rows(1)
                rows[4]["lit"] = Text(value)
                raw = self.write("raw.csv", csv_text(rows, COLUMNS))
                refused = self.refuse(INPUT, "process", raw, "--out", self.folder / "angles.csv")
                self.assertIn("row 5, column 'lit'", refused.stderr)


if __name__ == "__main__":
    unittest.main()
