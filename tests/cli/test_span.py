"""Frames that never came, and readings that may be wrong: the counter has the angle, and every path of a log keeps it."""

import csv
import json

from support import CliTest, body_of

QUIET = ["--set", "drift.magnetic_arcsec_s=0", "--set", "drift.magnetic_thermal_arcsec_s=0",
         "--set", "drift.nonmagnetic_arcsec_s=0", "--set", "drift.random_walk_arcsec_sqrt_s=0"]


def fault(kind, duration_s, size=0, at_s=10):
    return ["--set", f"faults.kind={kind}", "--set", f"faults.at_s={at_s}", "--set", f"faults.duration_s={duration_s}",
            "--set", f"faults.size={size}"]


def rows(path):
    return list(csv.DictReader(body_of(path).decode().splitlines()))


class Angles(CliTest):
    def final_error_arcsec(self, *options):
        out = self.folder / "run"
        self.succeed("run", "--duration", 16, "--seed", 1, *QUIET, *options, "--out", out, "--force")
        variants = json.loads((out / "summary.json").read_text())["variants"]
        return next(v["angle_error_arcsec"] for v in variants if v["name"] == "configured")

    def test_nothing_is_lost_while_no_frame_comes_in_time(self):
        for kind in ("frame_missed", "frame_repeated", "frame_late"):
            for duration_s in (0.0025, 0.02, 0.3, 3.0):
                with self.subTest(kind=kind, duration_s=duration_s):
                    self.assertLess(abs(self.final_error_arcsec(*fault(kind, duration_s))), 6.0)

    def test_a_short_turn_is_no_glitch_of_the_counter(self):
        for size in (1e5, 3e5, -1e6, 1.4e6):
            for duration_s in (0.001, 0.003, 0.01, 0.1):
                with self.subTest(size=size, duration_s=duration_s):
                    error = self.final_error_arcsec(*fault("overspeed", duration_s, size), "--set", "motion.kind=rest")
                    self.assertLess(abs(error), 6.0)


class Columns(CliTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "run"
        self.succeed("run", "--duration", 12, "--seed", 1, *fault("frame_missed", 0.1, at_s=6), "--out", self.out,
                     "--format", "csv")
        self.raw = self.out / "raw.csv"

    def test_the_row_after_missed_ones_tells_how_many(self):
        spans = [int(row["span"]) for row in rows(self.raw)]
        self.assertEqual(max(spans), 41)
        self.assertEqual(sorted(set(spans)), [1, 41])
        end = spans.index(41)
        for row in rows(self.raw)[end - 40:end]:
            self.assertEqual((row["valid"], row["counts"], row["span"]), ("0", "0", "1"))

    def test_a_log_without_the_column_is_bridged_as_ever(self):
        kept = [line for line in self.raw.read_text().splitlines() if line.startswith("#")]
        names = [name for name in rows(self.raw)[0] if name != "span"]
        lines = [",".join(names)]
        for row in rows(self.raw):
            if row["span"] != "1":
                row["valid"], row["counts"] = "0", "0"
            lines.append(",".join(row[name] for name in names))
        old = self.folder / "old.csv"
        old.write_text("\n".join(kept + lines) + "\n")
        angles = self.folder / "angles.csv"
        self.succeed("process", old, "--out", angles)
        self.assertTrue(any(row["sigma_arcsec"] == "inf" for row in rows(angles)))

    def test_a_span_over_more_than_was_missed_is_refused(self):
        text = self.raw.read_text()
        end = [int(row["span"]) for row in rows(self.raw)].index(41)
        head = sum(line.startswith("#") for line in text.splitlines()) + 1
        for span, allowed in ((42, "1..41"), (0, "1..41"), (-1, "1..41")):
            lines = text.splitlines()
            fields = lines[head + end].split(",")
            fields[list(rows(self.raw)[0]).index("span")] = str(span)
            lines[head + end] = ",".join(fields)
            bad = self.folder / "bad.csv"
            bad.write_text("\n".join(lines) + "\n")
            says = (f"row {end + 1}", "'span'", f"'{span}'", f"allowed is {allowed}")
            self.refuse(3, "process", bad, "--out", self.folder / "x.csv", "--force", says=says)
