"""The place within the fringe: the same bits live and processed, in both formats, the angle that the log's own columns give, what is refused."""

import csv
import math
import random

from support import AngleLog, body_of, CliTest, csv_text, quiet_log, Text

SCALE = 3.263
PHASE = ["--set", "gyro.readout=phase"]
# The issue's own photodiodes: 10 %, 5 degrees, 1 % of noise, 12 bits.
IMPERFECT = ["--set", "photodiodes.offset_cosine=0.1", "--set", "photodiodes.offset_sine=-0.1", "--set", "photodiodes.amplitude_error=0.1",
             "--set", "photodiodes.angle_error_deg=5", "--set", "photodiodes.noise=0.01", "--set", "photodiodes.adc_bits=12"]
COLUMNS = ["half", "bias_sign", "mode", "counts", "loop_closed", "fringe"]


def rows_of(path):
    return list(csv.DictReader(body_of(path).decode().splitlines()))


def places_of(rows):
    """Places at the ends of halves, counts: whole counts and the part, 1/2 where it is not known."""
    whole, places = 0, []
    for row in rows:
        whole += int(row["counts"])
        part = float(row["fringe"]) / 65536
        places.append(whole + (0.5 if math.isnan(part) else part))
    return places


class ClosedLoop(CliTest):
    """Against the log's own columns, and against the truth."""

    def test_ticks_are_differences_of_places(self):
        raw, angles = self.folder / "raw.csv", self.folder / "angles.csv"
        self.succeed("simulate", "--duration", 20, *PHASE, *IMPERFECT, "--set", "switching.interval_s=100", "--out", raw)
        self.succeed("process", raw, "--out", angles)
        rows = rows_of(raw)
        places = places_of(rows)
        log = AngleLog(angles)
        for tick in range(1, len(places) // 2):
            self.assertAlmostEqual(log.final[tick], SCALE * (places[2 * tick + 1] - places[2 * tick - 1]), places=8)
        # The ellipse is learnt within half a second of 12 000 arcsec/s.
        known = [not math.isnan(float(row["fringe"])) for row in rows]
        self.assertTrue(all(known[400:]))

    def test_a_switch_costs_a_tenth_of_an_arcsecond(self):
        out = self.folder / "run"
        self.succeed("run", "--duration", 600, *PHASE, *IMPERFECT, "--set", "switching.interval_s=5", "--set", "motion.frequency_hz=20.06",
                     "--set", "compensation.relock=joint", "--out", out, "--format", "h5")
        errors = [float(row["true_error_arcsec"]) for row in csv.DictReader((out / "switches.csv").read_text().splitlines())][10:]
        rms = math.sqrt(sum(x * x for x in errors) / len(errors))
        self.assertGreater(len(errors), 100)
        # The random walk of a gap and its neighbours adds 0.07 in quadrature.
        self.assertLess(math.sqrt(max(rms * rms - 0.07**2, 0.0)), 0.15)


class Wrong(CliTest):
    """Places that are not those of the counts: angles that sigma does not cover are never silent."""

    def warnings(self, rows, name):
        raw = self.write(f"{name}.csv", csv_text(rows, COLUMNS))
        said = [self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force").stderr,
                self.succeed("analyze", raw, "--out", self.folder / "analysis.html", "--force").stderr]
        return [[line for line in text.splitlines() if "column fringe" in line] for text in said]

    def simulated(self, name, *settings):
        raw = self.folder / f"{name}.csv"
        self.succeed("simulate", "--duration", 12, *PHASE, "--set", "switching.interval_s=2", *settings, "--out", raw)
        rows = [{key: Text(row[key]) for key in COLUMNS} for row in rows_of(raw)]
        return rows, [Text(row["fringe"]) for row in rows]

    def test_is_said_in_one_line(self):
        other = self.simulated("other", "--set", "motion.frequency_hz=3")[1]
        for fidelity in ("averaged", "laser"):
            rows, right = self.simulated(fidelity, "--set", f"gyro.fidelity={fidelity}")
            draw = random.Random(5)
            noise = [Text(draw.randrange(65536)) for _ in right]
            forms = {"right": right, "stuck": [Text(20000)] * len(right), "noise": noise, "of another log": other,
                     "shifted": right[1:] + right[:1], "in 8 bits": [x if x == "nan" else Text(int(x) // 256) for x in right],
                     "backwards": [x if x == "nan" else Text(65535 - int(x)) for x in right]}
            for form, places in forms.items():
                with self.subTest(fidelity=fidelity, form=form):
                    for row, place in zip(rows, places):
                        row["fringe"] = place
                    for lines in self.warnings(rows, f"{fidelity}-{form.replace(' ', '-')}"):
                        self.assertEqual(len(lines), 0 if form == "right" else 1, lines)
                        if lines:
                            self.assertIn("warning:", lines[0])
                            self.assertRegex(lines[0], r"contradicts the counts in (\d) of \1 stretches")


class Read(CliTest):
    def rows(self, fringes):
        rows = quiet_log(len(fringes) // 2, counts=0)
        for row, fringe in zip(rows, fringes):
            row["fringe"] = fringe
        return rows

    def test_integers_and_what_is_not_known(self):
        fringes = [round(65535 * abs(math.sin(h))) for h in range(200)]
        fringes[100] = fringes[133] = Text("nan")
        raw = self.write("raw.csv", csv_text(self.rows(fringes), COLUMNS))
        out = self.folder / "angles.csv"
        self.succeed("process", raw, "--out", out)
        places = places_of(rows_of(raw))
        log = AngleLog(out)
        for tick in range(1, 100):
            self.assertAlmostEqual(log.final[tick], SCALE * (places[2 * tick + 1] - places[2 * tick - 1]), places=9)

    def test_a_readout_that_the_log_does_not_have_is_noted(self):
        fringes = [7] * 200
        with_column = self.write("with.csv", csv_text(self.rows(fringes), COLUMNS))
        without = self.write("without.csv", csv_text(self.rows(fringes), COLUMNS[:-1]))
        for raw, asked, noted in ((with_column, "count", "has"), (with_column, "phase", ""), (without, "phase", "lacks"), (without, "count", "")):
            with self.subTest(raw=raw.name, asked=asked):
                result = self.succeed("process", raw, "--out", self.folder / "angles.csv", "--force", "--set", f"gyro.readout={asked}")
                lines = [line for line in result.stderr.splitlines() if "gyro.readout" in line]
                self.assertEqual(len(lines), 1 if noted else 0, result.stderr)
                if noted:
                    self.assertIn(f"this log {noted} the column fringe", lines[0])
