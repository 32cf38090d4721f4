#!/usr/bin/env python3
"""What is left of the false angle of a re-lock where the discriminator is corrected by its slope alone, by the curve of the laser, and by a
curve from logs, as a share of it.

usage: bench/relock_curve.py [--zlg PROGRAM] [--switches N]

A gyro with fidelity laser and an analog loop turns evenly and is read by phase, so that no count is rounded. The angle of the 60 ticks about
each switch, less the rotation, with the sign of the mode, is averaged over the switches, which follow each other by 2 s.
"""

import argparse
import csv
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TICK_S = 0.005
INTERVAL_TICKS = 400
RATE_ARCSEC_S = 1217.3
MISSES_LAMBDA = (0.05, 0.10, 0.20)
GYRO = {
    "gyro.fidelity": "laser",
    "gyro.discriminator_per_lambda": 0.3315,  # one that is given stays the whole law of the detector
    "perimeter.loop": "analog",
    "drift.magnetic_arcsec_s": 0,
    "drift.magnetic_thermal_arcsec_s": 0,
    "drift.nonmagnetic_arcsec_s": 0,
    "switching.interval_s": TICK_S * INTERVAL_TICKS,
    "motion.kind": "constant",
}


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def zlg(self, *words):
        subprocess.run([str(word) for word in (self.program, *words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def simulate(self, duration_s, **values):
        log = self.folder / "raw.h5"
        self.zlg("simulate", "--duration", duration_s, *settings(GYRO | values), "--out", log, "--force")
        return log

    def curve_of_the_laser(self):
        curve = self.folder / "laser.toml"
        self.zlg("calibrate", "--from-laser", "--out", curve)
        return curve

    def curve_of_logs(self):
        curve = self.folder / "logs.toml"
        log = self.simulate(1200, **{"motion.rate_arcsec_s": 50, "perimeter.miss_lambda": 0.2})
        self.zlg("calibrate", log, "--rate-arcsec-s", 50, "--out", curve)
        return curve

    def over_a_switch_arcsec(self, log, *said):
        angles = self.folder / "angles.csv"
        self.zlg("process", log, "--set", "compensation.bridge=constant", *said, "--out", angles, "--force")
        with open(angles) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        final_arcsec = [float(row["dtheta_final_arcsec"]) for row in rows]
        sums = []
        for k in range(INTERVAL_TICKS, len(rows) - 60, INTERVAL_TICKS):
            turned = sum(final_arcsec[k - 10:k + 50]) - 60 * TICK_S * RATE_ARCSEC_S
            sums.append(-turned * int(rows[k + 20]["mode"]))
        return sum(sums) / len(sums)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zlg", type=Path, default=ROOT / "build" / "release" / "bin" / "zlg")
    parser.add_argument("--switches", type=int, default=40)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.zlg, Path(folder))
        ways = {"by the slope alone": [],
                "curve of the laser": ["--config", bench.curve_of_the_laser()],
                "curve from 20 minutes of logs": ["--config", bench.curve_of_logs()]}
        left = {(way, method): [] for way in ways for method in ("detuning", "mean_square")}
        for miss_lambda in MISSES_LAMBDA:
            log = bench.simulate((options.switches + 1) * TICK_S * INTERVAL_TICKS,
                                 **{"motion.rate_arcsec_s": RATE_ARCSEC_S, "perimeter.miss_lambda": miss_lambda, "gyro.readout": "phase"})
            false_arcsec = bench.over_a_switch_arcsec(log, "--set", "compensation.relock=none")
            for way, method in left:
                rest_arcsec = bench.over_a_switch_arcsec(log, *ways[way], "--set", f"compensation.relock={method}")
                left[way, method].append(rest_arcsec / false_arcsec)
    print("| what is left of the false angle, of it | " + " | ".join(f"miss {miss:.2f}" for miss in MISSES_LAMBDA) + " |")
    print("|---|---|---|---|")
    for (way, method), shares in left.items():
        print(f"| {way}, `{method}` | " + " | ".join(f"{share:.3f}" for share in shares) + " |")


if __name__ == "__main__":
    main()
