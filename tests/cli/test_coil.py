"""The current of the coil in the raw log: live and processed angles are the same, an asymmetry of it is subtracted, logs without it are as ever."""

import csv
import unittest

import h5py

from support import CliTest, body_of

RECORD = ["--set", "gyro.coil_current=record"]
RUN = ["--duration", 60, "--set", "switching.interval_s=15", "--set", "motion.kind=rest"]
FAULT = ["--set", "faults.kind=bias_asymmetric", "--set", "faults.at_s=35", "--set", "faults.duration_s=5", "--set", "faults.size=0.001"]


def angle_arcsec(path):
    return sum(float(row["dtheta_final_arcsec"]) for row in csv.DictReader(body_of(path).decode().splitlines()))


class CoilCurrent(CliTest):
    def live(self, name, *settings):
        out = self.folder / name
        self.succeed("run", *RUN, *settings, "--out", out, "--format", "csv")
        return out

    def test_a_log_has_whole_microamperes_where_it_is_asked_for(self):
        without = body_of(self.live("without") / "raw.csv").decode().splitlines()[0]
        self.assertEqual(without, "half,bias_sign,mode,counts,loop_closed,valid,detuning_lambda,detuning_sq_lambda2,piezo_v,temperature_c,span,lit")
        rows = list(csv.DictReader(body_of(self.live("with", *RECORD) / "raw.csv").decode().splitlines()))
        self.assertEqual(",".join(rows[0]), without + ",coil_ua")
        for row in rows:
            self.assertAlmostEqual(int(row["coil_ua"]), int(row["bias_sign"]) * 1_000_000, delta=10_000)  # 1 A, 1 mA of noise

    def test_without_an_asymmetry_the_angles_are_the_same(self):
        self.assertEqual(body_of(self.live("without") / "angles.csv"), body_of(self.live("with", *RECORD) / "angles.csv"))

    def test_live_and_processed_are_the_same_in_both_formats(self):
        out = self.live("live", *RECORD, *FAULT)
        for kind in ("csv", "h5"):
            raw, angles = self.folder / f"again.{kind}", self.folder / f"angles-{kind}.csv"
            self.succeed("convert", out / "raw.csv", "--out", raw)
            self.succeed("process", raw, "--out", angles)
            self.assertEqual(body_of(angles), body_of(out / "angles.csv"))
        with h5py.File(self.folder / "again.h5") as log:
            self.assertEqual(log["raw/coil_ua"].attrs["unit"], "uA")
            self.assertEqual(log["raw/coil_ua"].dtype.kind, "i")

    def test_of_a_tenth_of_a_per_cent_little_is_left(self):
        sound = angle_arcsec(self.live("sound") / "angles.csv")
        without = angle_arcsec(self.live("without", *FAULT) / "angles.csv")
        with_it = angle_arcsec(self.live("with", *RECORD, *FAULT) / "angles.csv")
        self.assertAlmostEqual(abs(without - sound), 979, delta=20)  # 0.001 * 60 kHz * 3.263 arcsec * 5 s
        self.assertLess(abs(with_it - sound), 120)

    def test_a_reading_that_drifts_alone_turns_nothing(self):
        raw = self.live("sound", *RECORD) / "raw.csv"
        lines = raw.read_text().splitlines()
        head = next(k for k, line in enumerate(lines) if not line.startswith("#"))
        column = lines[head].split(",").index("coil_ua")
        true = angle_arcsec(raw.parent / "angles.csv")
        for name, error_ua in (("step", lambda t: 1000 * (t > 35)), ("drift", lambda t: 100 * max(t - 30, 0)),
                               ("gain", lambda t: 0), ("stuck", None)):
            changed = lines[:head + 1]
            for line in lines[head + 1:]:
                fields = line.split(",")
                t = int(fields[0]) * 0.0025
                value = int(fields[column])
                if error_ua is None:
                    value = value if t < 35 else 1_000_976
                elif name == "gain" and t > 35:
                    value = round(1.03 * value)
                else:
                    value += round(error_ua(t))
                fields[column] = str(value)
                changed.append(",".join(fields))
            log = self.write(f"{name}.csv", "\n".join(changed) + "\n")
            angles = self.folder / f"{name}-angles.csv"
            self.succeed("process", log, "--out", angles)
            with self.subTest(name=name):
                self.assertLess(abs(angle_arcsec(angles) - true), 60)

    def test_what_the_log_does_not_have_is_noted(self):
        plain, recorded = self.live("plain") / "raw.csv", self.live("recorded", *RECORD) / "raw.csv"
        for raw, asked, noted in ((recorded, "monitor", "has"), (recorded, "record", ""), (plain, "record", "lacks"), (plain, "monitor", "")):
            with self.subTest(raw=raw, asked=asked):
                result = self.succeed("process", raw, "--out", self.folder / "a.csv", "--force", "--set", f"gyro.coil_current={asked}")
                lines = [line for line in result.stderr.splitlines() if "gyro.coil_current" in line]
                self.assertEqual(len(lines), 1 if noted else 0, result.stderr)
                if noted:
                    self.assertIn(f"this log {noted} the column coil_ua", lines[0])


if __name__ == "__main__":
    unittest.main()
