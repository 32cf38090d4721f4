"""`zlg calibrate`: constants of simulated gyros, what it refuses, and what its result is worth to `zlg process`."""

import json
import math
import os
import re
import subprocess

from support import AngleLog, CliTest, ROOT, ZLG, csv_text, quiet_log, run

GYRO = {"gyro.bias_hz": 63e3, "gyro.bias_chi": 4.5, "gyro.bias_temperature_coefficient_per_c": -1e-3,
        "piezo.half_wave_v": 43.0, "piezo.half_wave_temperature_coefficient_per_c": 1e-3,
        "drift.magnetic_arcsec_s": 6.0, "drift.magnetic_thermal_arcsec_s": -12.0, "drift.thermal_time_s": 50.0,
        "drift.nonmagnetic_arcsec_s": 3.0, "drift.random_walk_arcsec_sqrt_s": 1.5}
REST = {"motion.kind": "rest", "switching.interval_s": 2.0, "gyro.light_samples": 8}


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


class Simulated(CliTest):
    def simulate(self, name="log.csv", duration=250, seed=1, **overrides):
        path = self.folder / name
        values = {**GYRO, **REST, **{key.replace("__", "."): value for key, value in overrides.items()}}
        self.succeed("simulate", "--duration", duration, "--seed", seed, *settings(values), "--out", path, "--force")
        return path

    def found(self, *arguments):
        return json.loads(self.succeed("calibrate", *arguments, "--json").stdout)

    def assert_found(self, result, truth, sigmas=4.5):
        for key, value in truth.items():
            self.assertIn(key, result["constants"], result["not_determined"].get(key))
            constant = result["constants"][key]
            self.assertLess(abs(constant["value"] - value), sigmas * constant["sigma"], key)


class Calibrate(Simulated):
    def test_finds_the_constants_of_a_gyro_at_rest(self):
        result = self.found(self.simulate())
        self.assert_found(result, GYRO)
        self.assertLess(result["constants"]["gyro.bias_chi"]["sigma"], 0.05)
        self.assertLess(result["constants"]["gyro.bias_hz"]["sigma"], 30.0)
        self.assertEqual(result["constants"]["piezo.half_wave_v"]["unit"], "V")
        self.assertEqual(result["files"][0]["relocks"], 124)
        self.assertLess(result["goodness"]["chi_chi2_per_dof"]["value"], 2.0)

    def test_digital_loop_and_a_known_rate(self):
        log = self.simulate(perimeter__loop="digital", motion__kind="constant", motion__rate_arcsec_s=300.0)
        self.assert_found(self.found(log, "--rate-arcsec-s", 300), GYRO)

    def test_what_a_log_says_of_the_constants_is_not_believed(self):
        log = self.simulate(duration=100)
        lines = log.read_text().splitlines(True)
        keys = ("gyro.bias", "piezo.half", "drift.", "gyro.discriminator", "gyro.light_noise")
        lies = "# gyro.bias_hz = 1\n# gyro.bias_chi = 9\n# drift.thermal_time_s = 7\n"
        rest = "".join(line for line in lines if not line.startswith(tuple("# " + key for key in keys)))
        stated, silent = self.write("stated.csv", lies + rest), self.write("silent.csv", rest)
        self.assertNotEqual(stated.read_text(), log.read_text())
        results = [self.found(path) for path in (log, stated, silent)]
        for other in results[1:]:
            self.assertEqual(other["constants"], results[0]["constants"])
            self.assertEqual(other["not_determined"], results[0]["not_determined"])

    def test_logs_of_several_temperatures_make_one_law(self):
        logs = []
        for k, temperature in enumerate((0.0, 20.0, 40.0)):
            logs.append(self.simulate(f"{k}.csv", duration=60, seed=k + 1, gyro__temperature_rise_c=0.0,
                                      gyro__reference_temperature_c=temperature, drift__magnetic_thermal_arcsec_s=0.0,
                                      gyro__bias_hz=63e3 * (1.0 - 1e-3 * (temperature - 20.0)),
                                      piezo__half_wave_v=43.0 * (1.0 + 1e-3 * (temperature - 20.0))))
        self.refuse(2, "calibrate", *logs, says=("gyro.reference_temperature_c", "--set"))
        law = {key: GYRO[key] for key in GYRO if key.startswith(("gyro.", "piezo."))}
        self.assert_found(self.found(*logs, "--set", "gyro.reference_temperature_c=20"), law)
        one = self.found(logs[1])
        self.assertIn("span", one["not_determined"]["gyro.bias_temperature_coefficient_per_c"])
        self.assertIn("gyro.bias_hz", one["constants"])

    def test_a_bias_that_bends_and_a_known_field_leave_switches_as_good(self):
        surroundings = {"temperature.profile": "[[0, 0], [125, 40], [250, 20]]", "field.kind": '"steps"',
                        "gyro.bias_temperature_table": "[[0, -2e-3], [10, -4e-4], [20, 0], [30, -7e-4], [40, -3e-3]]",
                        "field.course": "[[0, 0.5], [80, -0.4], [160, 0.3]]", "field.sensitivity_arcsec_s_g": 25.0,
                        "field.sensitivity_per_c": -0.01}
        logs = [self.simulate(f"{seed}.csv", seed=seed, **surroundings) for seed in (1, 2)]
        toml = self.folder / "found.toml"
        result = self.found(logs[0], "--out", toml)
        self.assert_found(result, {key: surroundings[key] for key in surroundings if "sensitivity" in key})
        self.assertIn("the field is known", result["not_determined"]["drift.magnetic_arcsec_s"])
        self.assertGreaterEqual(len(result["bias_temperature_table"]["knots"]), 3)
        self.assertIn("\nbias_temperature_table = [[", toml.read_text())
        errors = []
        for config in ((), ("--config", toml)):
            angles = self.folder / "angles.csv"
            self.succeed("process", logs[1], *config, "--out", angles, "--force")
            final = AngleLog(angles).final
            errors.append(sum(sum(final[k - 10:k + 40]) ** 2 for k in range(800, len(final) - 40, 400)))
        self.assertLess(errors[1], 1.1 * errors[0])
        # As its own log does, so does a configuration say the field.
        lines = logs[0].read_text().splitlines(True)
        silent = self.write("silent.csv", "".join(line for line in lines if not line.startswith("# field.")))
        self.assertEqual(self.found(silent)["not_determined"]["field.sensitivity_per_c"],
                         "the field of a log is not known")
        said = self.found(silent, *settings({key: surroundings[key] for key in ("field.kind", "field.course")}))
        self.assertEqual(said["constants"], result["constants"])

    def test_missing_columns_leave_their_constants_open(self):
        lines = self.simulate(duration=100).read_text().splitlines()
        rows = [line.split(",") for line in lines if not line.startswith("#")]
        facts = [line + "\n" for line in lines if line.startswith(("# gyro.tick_s", "# gyro.scale_arcsec"))]
        kept = self.write("kept.csv", "".join(facts) + "\n".join(",".join(row[:6]) for row in rows) + "\n")
        result = self.found(kept)
        self.assertIn("gyro.bias_hz", result["constants"])
        for key, column in (("gyro.bias_chi", "detuning_sq_lambda2"), ("piezo.half_wave_v", "piezo_v"),
                            ("gyro.bias_temperature_coefficient_per_c", "temperature_c")):
            self.assertIn(column, result["not_determined"][key])

    def test_a_log_without_switches_and_one_that_was_moved(self):
        unswitched = self.found(self.simulate(duration=60, switching__interval_s=1000.0))
        self.assertIn("one mode", unswitched["not_determined"]["drift.magnetic_arcsec_s"])
        self.assertIn("no gap", unswitched["not_determined"]["gyro.bias_chi"])
        moved = self.found(self.simulate(duration=60, motion__kind="sine"))
        self.assertIn("moved", moved["not_determined"]["drift.magnetic_arcsec_s"])
        ratio = moved["goodness"]["rest_variance_ratio"]["value"]
        self.assertFalse(0.25 <= ratio <= 4.0, ratio)

    def test_text_names_every_constant_once(self):
        text = self.succeed("calibrate", self.simulate(duration=60)).stdout
        for key in GYRO:
            self.assertEqual(len(re.findall(rf"^{re.escape(key)}[ :]", text, re.MULTILINE)), 1, key)


LASER = {"gyro.fidelity": "laser", "drift.magnetic_arcsec_s": 0.0, "drift.magnetic_thermal_arcsec_s": 0.0,
         "drift.nonmagnetic_arcsec_s": 0.0, "drift.random_walk_arcsec_sqrt_s": 0.0, "laser.beam_power_w": 0.0}
# A slope that is given stays the whole law of the detector: of the laser its own, to four digits.
STRAIGHT = {"gyro.discriminator_per_lambda": 0.3315}


class Discriminator(CliTest):
    """The inverse curve, derived from the laser or found in logs, and what it does to a log read by the slope alone."""

    def simulate(self, name, duration, **values):
        path = self.folder / name
        values = {**LASER, **STRAIGHT, **{key.replace("__", "."): value for key, value in values.items()}}
        self.succeed("simulate", "--duration", duration, *settings(values), "--out", path, "--force")
        return path

    def over_a_switch(self, log, *options):
        """Angle in the 60 ticks about each switch, less rotation, with the sign of the mode, mean over the switches."""
        angles = self.folder / "angles.csv"
        self.succeed("process", log, "--set", "compensation.bridge=constant", *options, "--out", angles, "--force")
        angle = AngleLog(angles)
        starts = range(200, len(angle.final) - 60, 200)
        sums = [sum(angle.final[k - 10:k + 50]) - 60 * 0.005 * 1217.3 for k in starts]
        return sum(total * -angle.mode[k + 20] for total, k in zip(sums, starts)) / len(sums)

    def switching(self, name="switching.csv", miss=0.2, **values):
        return self.simulate(name, 120, motion__kind="constant", motion__rate_arcsec_s=1217.3,
                             switching__interval_s=1.0, perimeter__miss_lambda=miss, **values)

    def test_from_the_laser(self):
        toml = self.folder / "laser.toml"
        shown = json.loads(self.succeed("calibrate", "--from-laser", "--out", toml, "--json").stdout)
        self.assertAlmostEqual(shown["constants"]["gyro.discriminator_per_lambda"]["value"], 0.332, delta=0.003)
        self.assertLess(shown["discriminator"]["error_lambda"], 1e-4)
        at = dict(zip(shown["discriminator"]["detuning_lambda"], shown["discriminator"]["signal"]))
        for detuning, signal in at.items():
            if abs(detuning - 0.15) < 0.003:
                self.assertAlmostEqual(signal / (0.332 * detuning), 1.78, delta=0.08)
        log = self.switching()
        false_arcsec = self.over_a_switch(log, "--set", "compensation.relock=none")
        self.assertGreater(false_arcsec, 30.0)
        self.assertLess(self.over_a_switch(log), -5.0 * false_arcsec)
        for method in ("detuning", "mean_square"):
            left = self.over_a_switch(log, "--config", toml, "--set", f"compensation.relock={method}")
            self.assertLess(abs(left), 0.03 * false_arcsec, method)

    def test_a_laser_without_a_curve_is_given_its_own(self):
        log, angles = self.folder / "own.csv", self.folder / "own_angles.csv"
        values = {**LASER, "switching.interval_s": 1.0, "motion.kind": "rest"}
        result = self.succeed("simulate", "--duration", 20, *settings(values), "--out", log)
        self.assertIn("taken from [laser]", result.stderr)
        self.succeed("process", log, "--out", angles)
        worst = max(abs(row) for row in AngleLog(angles).final)
        self.assertLess(worst, 60.0)

    def test_a_log_read_through_a_curve_is_not_bent_twice(self):
        toml = self.folder / "laser.toml"
        self.succeed("calibrate", "--from-laser", "--out", toml)
        log = self.folder / "curved.csv"
        self.succeed("simulate", toml, "--duration", 20, *settings({**LASER, "switching.interval_s": 1.0}), "--out", log)
        one, other = self.folder / "one.csv", self.folder / "other.csv"
        self.succeed("process", log, "--out", one)
        self.succeed("process", log, "--config", toml, "--out", other)
        self.assertEqual(AngleLog(one).final, AngleLog(other).final)
        curve = settings({"perimeter.discriminator_signal": "[0.1]", "perimeter.discriminator_detuning_lambda": "[0.1]"})
        result = self.succeed("process", log, *curve, "--out", other, "--force")
        self.assertIn("curve of its own", result.stderr)
        self.assertEqual(AngleLog(one).final, AngleLog(other).final)
        self.assertIn("read by one slope", json.loads(self.succeed("calibrate", log, "--json").stdout)
                      ["not_determined"]["perimeter.discriminator_signal"])

    def test_refusals(self):
        log = self.write("log.csv", csv_text(quiet_log()))
        self.refuse(2, "calibrate", "--from-laser", log, says=("--from-laser", "--config"))
        self.refuse(2, "calibrate", "--from-laser", "--set", "laser.gain_loss_ratio=0.9", says=("[laser]",))
        self.refuse(2, "process", log, "--set", "perimeter.discriminator_signal=[0.2,0.1]", "--set",
                    "perimeter.discriminator_detuning_lambda=[0.1,0.2]", "--out", self.folder / "a.csv", says=("growing",))


class SignedLoss(Simulated):
    """A bias that hardly falls, does not, or rises with the detuning, in logs that say nothing of their gyro."""

    RATE = 50.0

    def log(self, name, seed, chi, higher):
        log = self.simulate(name, 200, seed, gyro__bias_chi=chi, gyro__bias_chi_higher=higher, motion__kind="constant",
                            motion__rate_arcsec_s=self.RATE, perimeter__miss_lambda=0.2, light__gain_b=1.0,
                            **{key.replace(".", "__"): 0.0 for key in GYRO if key.startswith("drift.") and "time" not in key},
                            gyro__bias_temperature_coefficient_per_c=0.0)
        kept = ("# gyro.tick_s", "# gyro.scale_arcsec")
        lines = log.read_text().splitlines(True)
        log.write_text("".join(line for line in lines if not line.startswith("#") or line.startswith(kept)))
        return log

    def left(self, log, *options):
        """Angle over the switches less the rotation, rms, and what was said."""
        angles = self.folder / "angles.csv"
        result = self.succeed("process", log, *options, "--out", angles, "--force")
        final = AngleLog(angles).final
        sums = [sum(final[k - 5:k + 45]) - 50 * 0.005 * self.RATE for k in range(400, len(final) - 60, 400)]
        return math.sqrt(sum(x * x for x in sums) / len(sums)), result.stderr

    def test_what_was_found_is_used_and_what_was_not_is_said(self):
        for chi, higher in ((3.6, []), (0.3, []), (0.0, []), (-0.4, []), (0.33057, [-21.0, -1386.67, 38095.2])):
            with self.subTest(chi=chi, higher=higher):
                lab, log, toml = self.log("lab.csv", 1, chi, higher), self.log("use.csv", 2, chi, higher), self.folder / "found.toml"
                said = self.succeed("calibrate", lab, f"--rate-arcsec-s={self.RATE}", "--out", toml, "--force").stderr
                self.assertIn("gyro.reference_temperature_c = ", said)
                self.assertRegex(toml.read_text(), r"(?m)^bias_chi = ")
                true = {**GYRO, "gyro.bias_chi": chi, "gyro.bias_chi_higher": higher}
                true = settings({key: true[key] for key in ("gyro.bias_hz", "gyro.bias_chi", "gyro.bias_chi_higher")})
                found, note = self.left(log, "--config", toml)
                self.assertLess(found, 1.2 * self.left(log, *true)[0])
                self.assertLess(found, 1.05 * self.left(log, "--set", "compensation.relock=none")[0])
                self.assertNotIn("gyro.bias_chi", note)
                self.assertIn("gyro.light_noise_lambda = 0.0033", note)
                self.assertIn("gyro.bias_hz = 60000, gyro.bias_chi = 3.6", self.left(log)[1])


class Output(Simulated):
    def test_toml_configures_process_and_run(self):
        log, toml = self.simulate(duration=100), self.folder / "found.toml"
        self.succeed("calibrate", log, "--out", toml)
        text = toml.read_text()
        self.assertRegex(text, r"(?m)^bias_hz = 6\d+\.\d+  # \+- [\d.]+ Hz$")
        self.assertIn("tick_s = 0.005\n", text)
        self.succeed("process", log, "--config", toml, "--out", self.folder / "angles.csv")
        self.succeed("simulate", toml, "--duration", 1, "--out", self.folder / "again.csv")

    def test_nothing_is_overwritten_without_force_and_only_toml_is_written(self):
        log, toml = self.simulate(duration=10), self.folder / "found.toml"
        toml.write_text("mine")
        self.refuse(3, "calibrate", log, "--out", toml, says=("found.toml",))
        self.assertEqual(toml.read_text(), "mine")
        self.succeed("calibrate", log, "--out", toml, "--force")
        self.refuse(2, "calibrate", log, "--out", self.folder / "found.csv", says=(".toml",))


class Refusals(Simulated):
    def test_bad_input_and_usage(self):
        self.refuse(3, "calibrate", self.folder / "none.csv", says=("none.csv",))
        self.refuse(3, "calibrate", self.write("half.csv", csv_text(quiet_log()[:1])), says=("whole tick",))
        self.refuse(3, "calibrate", self.write("hole.csv", csv_text(quiet_log()).replace("\n30,", "\n31,")))
        self.refuse(2, "calibrate")
        log = self.write("log.csv", csv_text(quiet_log()))
        for rate in ("nan", "inf", "1e300", "-1.1e9", "1e10"):
            self.refuse(2, "calibrate", log, f"--rate-arcsec-s={rate}", says=("--rate-arcsec-s", "-1e9..1e9"))

    def test_a_log_that_determines_nothing_says_no(self):
        result = run("calibrate", self.write("log.csv", csv_text(quiet_log())), "--json")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(json.loads(result.stdout)["constants"], {})


class Documentation(CliTest):
    def test_its_example_lowers_the_error_of_a_switch_as_it_says(self):
        text = (ROOT / "docs" / "calibration.md").read_text()
        example = text[text.index("## An example"):text.index("## In the laboratory")]
        script = "".join(re.findall(r"```sh\n(.*?)```", example, re.DOTALL))
        path = f"{ZLG.parent}{os.pathsep}{os.environ['PATH']}"
        shown = subprocess.run(["bash", "-euc", script], cwd=self.folder, env={**os.environ, "PATH": path},
                               capture_output=True, text=True, check=True).stdout
        lines = re.findall(r"^(?:    )?(defaults|calibrated|true): +([\d.]+) arcsec$", shown, re.MULTILINE)
        documented = re.findall(r"^(defaults|calibrated|true): +([\d.]+) arcsec$", text, re.MULTILINE)
        left = {name: float(value) for name, value in lines}
        self.assertEqual(sorted(left), ["calibrated", "defaults", "true"])
        for name, value in documented:
            self.assertAlmostEqual(left[name] / float(value), 1.0, delta=0.05, msg=name)
        self.assertEqual(len(documented), 3)
        self.assertLess(left["calibrated"], 0.15 * left["defaults"])
        self.assertLess(left["calibrated"], 1.05 * left["true"])
