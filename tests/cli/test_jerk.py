"""A jerk before a switch: what was measured stays as it was measured."""

from support import AngleLog, CliTest

SUBSTITUTED = ("extrapolated", "interpolated", "invalid", "correction")


class Jerk(CliTest):
    def test_a_measured_tick_beside_it_keeps_its_counts(self):
        for readout in ("count", "phase"):
            for at_s in (11.9, 11.92, 11.935):
                with self.subTest(readout=readout, at_s=at_s):
                    out = self.folder / f"{readout}{at_s}"
                    self.succeed("run", "--out", out, "--format", "csv", "--duration", 13, "--set", f"gyro.readout={readout}",
                                 "--set", "switching.interval_s=2", "--set", "faults.kind=overspeed", "--set", f"faults.at_s={at_s}",
                                 "--set", "faults.duration_s=0.05", "--set", "faults.size=1e6")
                    log = AngleLog(out / "angles.csv")
                    measured = [k for k in range(len(log.rows)) if not any(log.has(k, name) for name in SUBSTITUTED)]
                    self.assertGreater(len(measured), 2500)
                    # Corrections of the re-lock that are amended are far below one count.
                    off = [abs(log.final[k] - log.dtheta[k]) for k in measured]
                    self.assertLess(max(off), 3.263)
