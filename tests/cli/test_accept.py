"""zlg accept: plans carried out on logs, verdicts, reports that can be verified."""

import json
import math
import unittest

import numpy as np

from support import ROOT, CliTest, complaints, run

IMU = ROOT.parent / "shared" / "data" / "lasergyro.imu"
MAPPED = 'time = "none"\ncolumn = 1\nholds = "rate"\nunit = "deg/h"\nrate_hz = 10\n'


def white(n, deviation, mean=0.0, seed=1):
    return np.random.default_rng(seed).normal(mean, deviation, n)


def means_of(values, length):
    return values[: len(values) // length * length].reshape(-1, length).mean(axis=1)


# The variance of a record's mean over white noise, walks and flicker, each with its restricted likelihood: zlg/noise/mean_error.hpp;
# its degrees of freedom, and the error of the mean of white noise.
def error_of_mean(rates):
    means = means_of(rates, max(1, len(rates) // 64))
    n, k = len(means), np.arange(1, len(means))
    squares = 2.0 / n * (np.cos(np.pi / n * np.outer(k, np.arange(n) + 0.5)) @ (means - means[0])) ** 2
    slow = 2.0 ** np.arange(-6, 23)[:, None]
    priors, shapes, ratios = [np.ones(1)], [np.ones((1, n - 1))], [np.zeros(1)]
    for kind in (3.0 / n**2 * (0.25 / np.sin(np.pi * k / 2 / n) ** 2 - 1 / 6), 1.0 / (2.0 * np.log(2.0) * k)):
        prior = (slow * kind / (1.0 + slow * kind)).std(axis=1)
        priors.append(prior / prior.sum())
        shapes.append(1.0 + slow * kind)
        ratios.append(slow[:, 0])
    shapes = np.concatenate(shapes)
    sums = (squares / shapes).sum(axis=1)
    logs = np.log(np.concatenate(priors)) - 0.5 * np.log(shapes).sum(axis=1) - 0.5 * (n - 1) * np.log(sums)
    weights = np.exp(logs - logs.max()) / np.exp(logs - logs.max()).sum()
    variances = (1.0 + np.concatenate(ratios)) * sums / n
    variance = (weights * variances).sum() / (n - 3)
    spread = (weights * variances**2).sum() / ((n - 3) * (n - 5)) / variance**2
    return math.sqrt(variance), (4.0 * spread - 2.0) / (spread - 1.0), math.sqrt(variances[0] / (n - 3))


def student_95(degrees):
    x = np.linspace(0.0, 1000.0, 2_000_001)
    above = np.cumsum((1.0 + x**2 / degrees) ** (-0.5 * (degrees + 1.0)))
    return x[np.searchsorted(above, 0.9 * above[-1])]


class Accept(CliTest):
    def at(self, name):
        return self.folder / name

    def rates(self, name, values):
        return self.write(name, "".join(f"{float(value)!r}\n" for value in values))

    def plan(self, runs, limits="", unit='serial = "A1"\n', name="plan.toml", accept=""):
        text = f"[unit]\n{unit}" + "".join(f"[[run]]\n{each}\n" for each in runs)
        return self.write(name, f"{text}[accept]\n{accept}[limits]\n{limits}")

    def static(self, *files, mapped=MAPPED):
        return f"files = {json.dumps([file.name for file in files])}\nkind = \"static\"\n{mapped}"

    def judged(self, plan, code, *arguments):
        result = run("accept", plan, "--json", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        found = json.loads(result.stdout)
        return found, {quantity["name"]: quantity for quantity in found["quantities"]}

    def refusal(self, code, *arguments):
        result = run("accept", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(complaints(result)), 1, result.stderr)
        return result.stderr

    def test_white_noise_has_its_mean_and_its_angle_random_walk(self):
        # 3 deg/h a sample at 10 Hz: N = 3/sqrt(10) arcsec/sqrt(s), and the mean of 20000 is known to 3/sqrt(20000) if there is no slow noise.
        rates = white(20000, 3.0, mean=0.5)
        plan = self.plan([self.static(self.rates("a.csv", rates))],
                         '"bias.deg_h" = { min = -1, max = 1 }\n"angle_random_walk.deg_sqrt_h" = { max = 0.02 }\n')
        found, quantities = self.judged(plan, 0)
        self.assertTrue(found["passed"])
        bias = quantities["bias.deg_h"]
        self.assertAlmostEqual(bias["value"], rates.mean(), places=12)
        uncertainty, degrees, _ = error_of_mean(rates)
        self.assertGreater(uncertainty, 3.0 / math.sqrt(20000))
        self.assertAlmostEqual(bias["uncertainty"], uncertainty, delta=1e-9)
        self.assertAlmostEqual(bias["degrees_of_freedom"], degrees, delta=1e-6)
        self.assertEqual(bias["verdict"], "pass")
        walk = quantities["angle_random_walk.deg_sqrt_h"]
        self.assertAlmostEqual(walk["value"], 3.0 / math.sqrt(10.0) / 60.0, delta=4.0 * walk["uncertainty"])
        self.assertEqual(quantities["half_wave.v"]["verdict"], "not determined")
        self.assertIn("needs a raw log with piezo_v", quantities["half_wave.v"]["reason"])
        self.assertIsNone(quantities["half_wave.v"]["value"])

    def test_a_bias_at_its_limit_is_undecided_and_the_time_of_an_even_chance_is_right(self):
        # Half a quantile of Student's law from the limit; in a record L times as long the mean is known to u/sqrt(L), and moves by s sqrt(1 - 1/L),
        # s that of white noise.
        rates = white(20000, 3.0)
        rates += 0.5 - rates.mean()
        uncertainty, degrees, white_error = error_of_mean(rates)
        limit = 0.5 + 0.5 * student_95(degrees) * uncertainty
        plan = self.plan([self.static(self.rates("a.csv", rates))], f'"bias.deg_h" = {{ max = {limit} }}\n')
        found, quantities = self.judged(plan, 1)
        self.assertFalse(found["passed"])
        self.assertEqual(quantities["bias.deg_h"]["verdict"], "undecided")
        longer = 1.0 + quantities["bias.deg_h"]["more_hours"] * 3600.0 / 2000.0
        guard, moves = student_95(degrees) / math.sqrt(longer), white_error / uncertainty * math.sqrt(1.0 - 1.0 / longer)
        beyond = [(guard - side * 0.5 * student_95(degrees)) / moves for side in (-1.0, 1.0)]
        self.assertAlmostEqual(sum(0.5 * math.erfc(x / math.sqrt(2.0)) for x in beyond), 0.5, delta=0.02)

    def test_a_bias_beyond_its_limit_fails(self):
        plan = self.plan([self.static(self.rates("a.csv", white(5000, 1.0, mean=2.0)))], '"bias.deg_h" = { max = 1 }\n')
        self.assertEqual(self.judged(plan, 1)[1]["bias.deg_h"]["verdict"], "fail")

    def test_without_limits_there_is_no_verdict(self):
        plan = self.plan([self.static(self.rates("a.csv", white(5000, 1.0)))])
        found, quantities = self.judged(plan, 1)
        self.assertFalse(found["passed"])
        self.assertIsNone(quantities["bias.deg_h"]["verdict"])

    def test_runs_that_differ_tell_the_repeatability_and_the_error_of_the_bias(self):
        means = [0.0, 1.0, 2.0, 5.0]
        runs = []
        for k, mean in enumerate(means):
            rates = white(5000, 1.0, seed=k)
            runs.append(self.static(self.rates(f"{k}.csv", rates - rates.mean() + mean)))
        quantities = self.judged(self.plan(runs), 1)[1]
        self.assertAlmostEqual(quantities["bias.deg_h"]["value"], 2.0, places=9)
        spread = np.std(means, ddof=1)
        self.assertAlmostEqual(quantities["bias_repeatability.deg_h"]["value"], spread, places=9)
        self.assertAlmostEqual(quantities["bias.deg_h"]["uncertainty"], spread / 2.0, places=9)
        self.assertEqual(quantities["bias.deg_h"]["degrees_of_freedom"], 3.0)

    def test_the_earth_is_taken_out_and_its_wrong_sign_is_found(self):
        earth = 15.041067 * math.sin(math.radians(50.0))
        rates = white(5000, 1.0)
        good = self.rates("a.csv", rates + earth)
        unit = 'serial = "A1"\nlatitude_deg = 50\n'
        limit = '"bias.deg_h" = { min = -1, max = 1 }\n'
        up = MAPPED + 'axis = "up"\n'
        quantities = self.judged(self.plan([self.static(good, mapped=up)], limit, unit), 0)[1]
        self.assertAlmostEqual(quantities["bias.deg_h"]["value"], rates.mean(), places=5)
        down = MAPPED + 'axis = "down"\n'
        bias = self.judged(self.plan([self.static(good, mapped=down)], limit, unit), 1)[1]["bias.deg_h"]
        self.assertEqual(bias["verdict"], "not determined")
        self.assertIn("axis or sign is the wrong one", bias["reason"])

    def test_what_is_no_measurement_has_no_verdict(self):
        limit = '"bias.deg_h" = { min = -1, max = 1 }\n'
        held = white(5000, 1.0)
        held[2000:3000] = held[2000]
        clipped = np.clip(white(5000, 1.0), -0.5, 0.5)
        hours = {"dead": np.full(5000, 0.25), "held": held, "clipped": clipped, "doubled": np.repeat(white(2500, 1.0), 2)}
        for name, rates in hours.items():
            with self.subTest(name):
                result = run("accept", self.plan([self.static(self.rates(f"{name}.csv", rates))], limit), "--json")
                self.assertEqual(result.returncode, 1, result.stderr)
                found = json.loads(result.stdout)
                self.assertEqual(found["quantities"][0]["verdict"], "not determined")
                self.assertIn("run 1 is no measurement", found["quantities"][0]["reason"])
                self.assertTrue(found["runs"][0]["stopped"])

    def test_a_switched_gyro_shows_what_only_it_has(self):
        raw = self.at("raw.h5")
        self.assertEqual(run("simulate", "--duration", 1200, "--set", "motion.kind=rest", "--set", "drift.magnetic_thermal_arcsec_s=0",
                             "--out", raw).returncode, 0)
        plan = self.plan([f'files = ["{raw.name}"]\nkind = "static"\n'], '"half_wave.v" = { min = 39, max = 41 }\n"gap.ticks" = { max = 3 }\n')
        quantities = self.judged(plan, 0)[1]
        for name, truth, slack in [("magnetic_drift.deg_h", 0.7, 0.0), ("bias_frequency.hz", 60e3, 0.0), ("chi.per_lambda2", 3.6, 0.0),
                                   ("half_wave.v", 40.0, 0.0), ("bias.deg_h", 0.05, 0.01)]:
            quantity = quantities[name]
            self.assertLess(abs(quantity["value"] - truth), 4.0 * quantity["uncertainty"] + slack, name)
        self.assertEqual(quantities["gap.ticks"]["value"], 3.0)
        self.assertEqual(quantities["switches_withheld.count"]["value"], 0.0)
        self.assertEqual(quantities["alarms.per_h"]["value"], 0.0)
        self.assertAlmostEqual(quantities["miss.lambda"]["value"], 0.22, delta=0.02)
        # exp(-t/6.5 ms) brings 0.22 to 0.02 in 15.6 ms, and the piezo lags by 1 ms; halves of 2.5 ms are told apart.
        self.assertAlmostEqual(quantities["relock.s"]["value"], 0.0166, delta=0.0025)
        # The same numbers as calibrate finds.
        constants = json.loads(run("calibrate", raw, "--json").stdout)["constants"]
        self.assertEqual(quantities["half_wave.v"]["value"], constants["piezo.half_wave_v"]["value"])
        self.assertEqual(quantities["half_wave.v"]["uncertainty"], constants["piezo.half_wave_v"]["sigma"])

    def test_the_error_of_a_switch_is_that_of_a_gyro_at_rest(self):
        raw = self.at("raw.h5")
        for motion, hz, determined in [("rest", 7, True), ("constant", 7, True), ("sine", 0.1, False), ("sine", 7, False), ("sine", 70, False)]:
            with self.subTest(motion, hz=hz):
                sets = ["--set", f"motion.kind={motion}", "--set", f"motion.frequency_hz={hz}", "--set", "motion.rate_arcsec_s=500"]
                self.assertEqual(run("simulate", "--duration", 200, *sets, "--out", raw, "--force").returncode, 0)
                plan = self.plan([f'files = ["{raw.name}"]\nkind = "static"\n'])
                error = self.judged(plan, 1)[1]["switch_error.arcsec"]
                self.assertEqual(error["verdict"] != "not determined", determined, error)

    def test_a_lock_that_does_not_settle_and_a_dead_detuning_give_no_time_of_relock(self):
        raw = self.at("raw.csv")
        self.assertEqual(run("simulate", "--duration", 200, "--set", "motion.kind=rest", "--out", raw).returncode, 0)
        whole = raw.read_text().splitlines()
        names = next(line for line in whole if line.startswith("half,")).split(",")
        at, first = names.index("detuning_lambda"), whole.index(",".join(names)) + 1
        # A value of the noise that calibrate refuses of so short a record is that of the record at rest.
        constants = json.loads(run("calibrate", raw, "--json").stdout)["constants"]
        self.assertNotIn("drift.random_walk_arcsec_sqrt_s", constants)
        plan = self.plan([f'files = ["{raw.name}"]\nkind = "static"\n'])
        self.assertEqual(self.judged(plan, 1)[1]["angle_random_walk.deg_sqrt_h"]["verdict"], None)
        # Three seconds of two hundred without a measurement.
        rows = [line.split(",") for line in whole[first:]]
        for row in rows[20000:21200]:
            row[names.index("valid")] = "0"
        raw.write_text("\n".join(whole[:first] + [",".join(row) for row in rows]) + "\n")
        self.assertIn("samples are missing", self.judged(plan, 1)[1]["bias.deg_h"]["reason"])
        for column, why in [(lambda value: value + 0.1, "switches detuning_lambda does not settle"), (lambda value: 0.001, "absent or one value throughout")]:
            rows = [line.split(",") for line in whole[first:]]
            for row in rows[len(rows) // 2 if "settle" in why else 0:]:
                row[at] = repr(column(float(row[at])))
            raw.write_text("\n".join(whole[:first] + [",".join(row) for row in rows]) + "\n")
            relock = self.judged(self.plan([f'files = ["{raw.name}"]\nkind = "switching"\n']), 1)[1]["relock.s"]
            self.assertEqual(relock["verdict"], "not determined")
            self.assertIn(why, relock["reason"])

    def report(self, name, seed=1, limit='"bias.deg_h" = { min = -1, max = 1 }\n', unit='serial = "A1"\ntype = "Z"\ndate = 2026-01-02\n'):
        log = self.rates("a.csv", white(5000, 1.0, seed=seed))
        plan = self.plan([self.static(log)], limit, unit)
        result = run("accept", plan, "--out", self.at(name), "--force")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.at(name), log

    def test_the_same_inputs_give_the_same_bytes(self):
        first, _ = self.report("first.html")
        second, _ = self.report("second.html")
        self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_a_report_is_verified_and_damage_is_found(self):
        page, log = self.report("report.html")
        result = run("accept", "--verify", page, log)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("not forgery", result.stdout)
        log.write_text(log.read_text() + "0.5\n")
        result = run("accept", "--verify", page, log)
        self.assertEqual(result.returncode, 1)
        self.assertIn("none of the record's files", result.stdout)
        whole = page.read_text()
        for damaged in (whole.replace("passes", "PASSES", 1), whole[:-40], whole + " "):
            page.write_text(damaged)
            self.assertIn("edited, cut off or damaged", self.refusal(3, "--verify", page))
        page.write_text("<html></html>")
        self.assertIn("holds no record", self.refusal(3, "--verify", page))

    def test_earlier_reports_are_a_trend(self):
        self.at("old").mkdir()
        self.report("old/1.html", seed=2, unit='serial = "A0"\ntype = "Z"\ndate = 2026-01-01\n')
        self.report("old/2.html", seed=3, unit='serial = "B0"\ntype = "other"\ndate = 2026-01-01\n')
        self.at("old/note.html").write_text("<html></html>")
        log = self.rates("a.csv", white(5000, 1.0))
        plan = self.plan([self.static(log)], '"bias.deg_h" = { max = 1 }\n', 'serial = "A1"\ntype = "Z"\ndate = 2026-01-02\n')
        result = run("accept", plan, "--history", self.at("old"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = result.stdout[result.stdout.index("Earlier tests"):]
        # The same reports once more, and one of this test, made without the others.
        self.at("old/copy.html").write_bytes(self.at("old/1.html").read_bytes())
        self.assertEqual(run("accept", plan, "--out", self.at("old/own.html")).returncode, 0)
        again = run("accept", plan, "--history", self.at("old")).stdout
        self.assertEqual(again[again.index("Earlier tests"):], rows)
        self.assertLess(rows.index("A0"), rows.index("A1"))
        self.assertNotIn("B0", rows)
        page = self.at("old/1.html")
        page.write_text(page.read_text().replace("A0", "A9", 1))
        self.assertIn("edited, cut off or damaged", self.refusal(3, plan, "--history", self.at("old")))

    def test_a_plan_is_written_and_carried_out(self):
        log = self.write("a.csv", "t [s],rate [deg/h]\n" + "".join(f"{k / 10},{v!r}\n" for k, v in enumerate(white(2000, 1.0).tolist())))
        plan = self.at("plan.toml")
        self.assertEqual(run("accept", "--plan", log, "--out", plan).returncode, 0)
        plan.write_text(plan.read_text() + '"bias.deg_h" = { min = -1, max = 1 }\n')
        self.assertEqual(run("accept", plan).returncode, 0, run("accept", plan).stderr)

    def test_bad_input_is_one_line(self):
        log = self.rates("a.csv", white(2000, 1.0))
        again = self.rates("b.csv", white(2000, 1.0))
        self.assertIn("once more", self.refusal(3, self.plan([self.static(log, again)])))
        self.assertIn("once more", self.refusal(3, self.plan([self.static(log), self.static(again)])))
        self.assertIn("once more", self.refusal(3, self.plan([self.static(log, log)])))
        switching = self.static(log).replace("static", "switching")
        self.assertIn("once more", self.refusal(3, self.plan([self.static(log), switching])))
        self.assertIn("no run of the plan gives it", self.refusal(2, self.plan([self.static(log)], '"scale_factor.ppm" = { max = 1 }\n')))
        self.assertIn("given in deg/h", self.refusal(2, self.plan([self.static(log)], '"bias.rad_s" = { max = 1 }\n')))
        self.assertIn("cannot", self.refusal(3, self.plan([self.static(self.at("none.csv"))])))
        self.refusal(2, self.plan([self.static(log, mapped="")]))
        self.refusal(2, self.write("big.toml", "#" * 10_000_000))
        self.refusal(2, log, again)
        self.refusal(2, "--plan", "--verify", log)

    def test_a_scale_that_the_plan_contradicts_is_named(self):
        unit = 'serial = "A1"\nscale_arcsec = 2.0\n'
        counts = "".join(f"{round(v)}\n" for v in white(2000, 20.0).tolist())
        mapped = 'holds = "increment"\nunit = "counts"\nrate_hz = 10\n'
        log = self.write("a.csv", f"Scale factor: 3,263 arcsec/count\npulses\n{counts}")
        self.assertIn("a count is 3.263 arcsec there, and 2 by scale_arcsec of [unit]",
                      self.refusal(2, self.plan([self.static(log, mapped=mapped)], unit=unit)))
        agrees = unit.replace("2.0", "3.27")
        self.judged(self.plan([self.static(log, mapped=mapped)], unit=agrees), 1)
        self.assertIn("and 3.27 by", self.refusal(2, self.plan([self.static(log, mapped=mapped + "scale_arcsec = 5\n")], unit=agrees)))
        raw = self.at("raw.csv")
        self.assertEqual(run("simulate", "--duration", 20, "--out", raw).returncode, 0)
        self.assertIn("and 2 by", self.refusal(2, self.plan([self.static(raw, mapped="")], unit=unit)))
        # What the rate table shows of the nominal scale stops the static run too.
        rates = [-20.0, -10.0, 0.0, 10.0, 20.0]
        turned = "".join(f"{round(360.0 * rate / 3.0 + v)}\n" for rate in rates for v in white(600, 3.0).tolist())
        table = self.write("table.csv", "pulses\n" + turned)
        still = self.write("still.csv", "pulses\n" + counts)
        stages = ", ".join(f"{{ from_s = {60 * k}, to_s = {60 * k + 60}, rate_deg_s = {rate} }}" for k, rate in enumerate(rates))
        plan = self.plan([self.static(still, mapped=mapped), f'files = ["{table.name}"]\nkind = "rate_table"\nstages = [{stages}]\n{mapped}'], unit=unit)
        self.assertIn("the rate table of run 2 shows 0.6667 of the nominal scale", self.judged(plan, 1)[1]["bias.deg_h"]["reason"])

    def test_two_logs_of_one_run_may_not_overlap(self):
        rates = white(400, 1.0).tolist()
        row = "2026-01-02T10:{:02d}:{:02d}.{:d},{!r}\n"
        for name, first in (("a.csv", 0), ("b.csv", 100)):
            rows = "".join(row.format(k // 600, k // 10 % 60, k % 10, rates[k]) for k in range(first, first + 200))
            self.write(name, "time,rate [deg/h]\n" + rows)
        files = self.static(self.at("a.csv"), self.at("b.csv"), mapped="")
        self.assertIn("begins before the file before it has ended", self.refusal(2, self.plan([files])))

    def test_a_log_of_another_serial_number_is_refused(self):
        rates = "".join(f"{v!r}\n" for v in white(2000, 1.0).tolist())
        log = self.write("a.csv", f"Serial number: B7\nrate [deg/h]\n{rates}")
        mapped = 'holds = "rate"\nrate_hz = 10\n'
        self.assertIn("serial 'B7', the plan is of 'A1'", self.refusal(2, self.plan([self.static(log, mapped=mapped)])))
        raw = self.at("raw.csv")
        self.assertEqual(run("simulate", "--duration", 5, "--out", raw).returncode, 0)
        raw.write_text("# serial = \"B7\"\n" + raw.read_text())
        self.assertIn("serial", self.refusal(2, self.plan([self.static(raw, mapped="")])))
        self.assertIn("serial", self.refusal(2, self.plan([self.static(log, mapped=mapped) + 'serial = "C"\n'])))

    @unittest.skipUnless(IMU.exists(), "no record of a real gyro beside the project")
    def test_a_real_gyro_against_an_independent_computation(self):
        rows = [line.split() for line in IMU.read_text(errors="replace").splitlines() if line.strip() and not line.startswith("%")]
        increments = 0.1 * np.array(rows[3:], dtype=float)[:, 2]
        mapped = 'comment = "%"\nskip_lines = 3\ncolumn = 3\nholds = "increment"\nunit = "arcsec"\nscale = 0.1\nrate_hz = 100\naxis = "up"\n'
        unit = 'serial = "PSINS"\nlatitude_deg = 34.246048\n'
        plan = self.plan([f"files = [{json.dumps(str(IMU))}]\nkind = \"static\"\n{mapped}"], '"bias.deg_h" = { min = -1, max = 1 }\n', unit)
        quantities = self.judged(plan, 0)[1]
        earth = 15.041067 * math.sin(math.radians(34.246048))
        self.assertAlmostEqual(quantities["bias.deg_h"]["value"], increments.mean() * 100.0 - earth, places=6)
        # Angle random walk and quantisation against overlapped Allan deviations from 5 to 41 s: the base sways, and no two numbers
        # describe it to better than some per cent.
        walk = 60.0 * quantities["angle_random_walk.deg_sqrt_h"]["value"]
        rounding = quantities["quantisation.arcsec"]["value"]
        angle = np.concatenate([[0.0], np.cumsum(increments)])
        for m in 512, 1024, 2048, 4096:
            second = angle[2 * m:] - 2.0 * angle[m:-m] + angle[:-2 * m]
            tau = m / 100.0
            self.assertAlmostEqual(math.sqrt(walk**2 / tau + 3.0 * rounding**2 / tau**2) / math.sqrt(np.mean(second**2) / 2.0 / tau**2), 1.0, delta=0.06)
        uncertainty = error_of_mean(100.0 * increments)[0]
        self.assertAlmostEqual(quantities["bias.deg_h"]["uncertainty"], uncertainty, delta=1e-6 * uncertainty)


if __name__ == "__main__":
    unittest.main()
