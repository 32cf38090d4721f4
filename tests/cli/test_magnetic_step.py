"""By phase a switch is known well enough for the step of the magnetic drift to matter, long before the drift is known."""

from support import CliTest

SETTINGS = ("gyro.readout=phase", "switching.interval_s=5", "motion.kind=rest", "drift.magnetic_arcsec_s=3", "compensation.relock=joint")


class MagneticStep(CliTest):
    def test_sigma_of_a_switch_holds_the_drift_that_is_not_known_yet(self):
        squares = []
        for seed in (1, 2):
            out = self.folder / f"{seed}"
            self.succeed("run", "--out", out, "--duration", 120, "--seed", seed, *(part for key in SETTINGS for part in ("--set", key)))
            lines = [line.split(",") for line in (out / "switches.csv").read_text().splitlines() if not line.startswith("#")]
            for row in lines[1:]:
                switch = dict(zip(lines[0], row))
                squares.append((float(switch["true_error_arcsec"]) / float(switch["sigma_arcsec"])) ** 2)
        self.assertEqual(len(squares), 46)
        # A mean of 46 squares of standard normal numbers: within these with a chance of 0.9999.
        self.assertLess(sum(squares) / 46, 1.95)
        self.assertGreater(sum(squares) / 46, 0.39)
