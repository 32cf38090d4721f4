"""Logs that the program of format_version 2 wrote (format_2/): each is read, with a line that names what is gone of it."""

import csv
import json
import lzma
from math import cos, isfinite, pi
from pathlib import Path

from support import CliTest, body_of, run, warnings

USAGE = 2
FIXTURES = Path(__file__).parent / "format_2"
# In every log of that version, for it wrote all keys.
GONE = ["gyro.coil_current", "switching.after_step", "compensation.prior", "compensation.prior_band_hz", "compensation.prior_rate_arcsec_s",
        "compensation.prior_line_hz", "compensation.prior_line_arcsec_s", "laser.scatter_phase_deg", "laser.comparator_threshold",
        "perimeter.sample_gain", "perimeter.settled_tau_s", "perimeter.set_points", "piezo.mirror_damping", "piezo.dac_bits",
        "piezo.adc_bits", "piezo.adc_noise_v", "photodiodes.skew_s", "photodiodes.jitter_s", "switching.last_segment",
        "switching.switch_error_arcsec", "switching.magnetic_arcsec_s", "faults.vibration_hz", "analysis.taus_per_decade",
        "analysis.least_known_ratio", "analysis.total_bias", "analysis.angles", "analysis.table_same_rate_ratio",
        "analysis.scale_arcsec", "analysis.comment", "analysis.skip_lines", "analysis.separator", "analysis.decimal",
        "analysis.table_scale_arcsec_s"]
# Of the logs whose gyro had what is gone: coil_current = "record", after_step = "switch", prior = "lines", and these.
VALUES = ['switching.schedule = "growing"', 'compensation.bridge = "optimal"']


def swing_arcsec(t_s):
    """The motion of the default gyro, 12 000 arcsec/s at 7.03 Hz."""
    w = 2 * pi * 7.03
    return 12000 / w * (1 - cos(w * t_s))


class FormerVersions(CliTest):
    def log(self, name):
        path = self.folder / name
        path.write_bytes(lzma.decompress((FIXTURES / f"{name}.xz").read_bytes()))
        return path

    def logs(self):
        for packed in sorted(FIXTURES.glob("*.xz")):
            yield packed.stem, self.log(packed.stem)

    def expect_named(self, result, name, verb):
        lines = [line for line in result.stderr.splitlines() if "stepped over" in line]
        self.assertEqual(len(lines), 1, (name, verb, result.stderr))
        named = lines[0].split("stepped over: ")[1].split(", ")
        self.assertEqual(sorted(named), sorted(GONE + (VALUES if name.startswith("old_keys") else [])))

    def test_each_kind_is_here(self):
        self.assertEqual([name for name, _ in self.logs()],
                         ["killed.h5.part", "killed_light.h5.part", "old_keys.csv", "old_keys_light.h5", "raw.csv", "raw.h5", "raw_light.h5"])
        for name, log in self.logs():
            found = json.loads(run("inspect", log, "--json").stdout)
            self.assertEqual((found["format_version"], found["light_beams"]), (2, 2 if "light" in name else 0), name)

    def test_each_gives_finite_angles_that_are_conserved(self):
        for name, log in self.logs():
            with self.subTest(name=name):
                for relock in ("mean_square", "joint"):
                    out = self.folder / "angles.csv"
                    result = self.succeed("process", log, "--set", f"compensation.relock={relock}", "--out", out, "--force")
                    self.expect_named(result, name, "process")
                    rows = list(csv.DictReader(body_of(out).decode().splitlines()))
                    self.assertEqual(len(rows), 8192 if name.startswith("killed") else 600)
                    self.assertTrue(all(isfinite(float(row[key])) for row in rows
                                        for key in ("dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec")))
                    delivered, final = (sum(float(row[key]) for row in rows) for key in ("dtheta_arcsec", "dtheta_final_arcsec"))
                    self.assertAlmostEqual(delivered, final, delta=1e-6)
                    t_s = 0.005 * len(rows)
                    # The killed one turned evenly; the drifts are 0.75 arcsec/s at most, and a switch errs by some arcsec.
                    true = 15 * t_s if name.startswith("killed") else swing_arcsec(t_s)
                    self.assertAlmostEqual(final, true, delta=20, msg=relock)

    def test_a_column_that_is_gone_is_named_once_and_makes_no_angle(self):
        for name, log in self.logs():
            result = self.succeed("process", log, "--out", self.folder / "angles.csv", "--force")
            lines = [line for line in warnings(result) if "column" in line]
            self.assertEqual(len(lines), 1 if name.startswith("old_keys") else 0, result.stderr)
            self.assertTrue(all("column of a former version 'coil_ua' is ignored" in line for line in lines), lines)

    def test_both_formats_of_a_log_give_the_same(self):
        bodies = set()
        for name in ("raw.csv", "raw.h5", "raw_light.h5"):
            self.succeed("process", self.log(name), "--out", self.folder / "angles.csv", "--force")
            bodies.add(body_of(self.folder / "angles.csv"))
        self.assertEqual(len(bodies), 1)

    def test_every_verb_that_reads_settings_names_them(self):
        for name in ("raw.csv", "old_keys_light.h5", "killed_light.h5.part"):
            log = self.log(name)
            for verb in ("inspect", "analyze"):
                result = run(verb, log)
                self.assertEqual(result.returncode, 1 if name.startswith("killed") and verb == "inspect" else 0)
                self.expect_named(result, name, verb)

    def test_angles_of_that_version_are_analysed(self):
        angles = self.write("angles.csv", "\n".join(
            ["# gyro.tick_s = 0.005", '# gyro.coil_current = "record"', '# switching.schedule = "growing"', '# analysis.deviations = ["oadev", "htotdev"]',
             "tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags"]
            + [f"{k},{0.005 * k},{k % 3},{k % 3},1,1,0" for k in range(100)]) + "\n")
        for verb in ("inspect", "analyze"):
            result = self.succeed(verb, angles)
            self.assertIn('stepped over: gyro.coil_current, switching.schedule = "growing", analysis.deviations = "htotdev"', result.stderr)

    def test_a_copy_is_one_of_that_version_still(self):
        for name in ("old_keys.csv", "raw_light.h5"):
            copy, again = self.folder / "copy.h5", self.folder / "angles.csv"
            self.succeed("convert", self.log(name), "--out", copy, "--force")
            self.assertEqual(json.loads(self.succeed("inspect", copy, "--json").stdout)["format_version"], 2)
            self.expect_named(self.succeed("process", copy, "--out", again, "--force"), name, "process")

    def test_elsewhere_they_are_refused_with_what_takes_their_place(self):
        log = self.log("raw.csv")
        for key, value, takes in (("gyro.coil_current", "record", "leave it out"), ("switching.after_step", "wait", "leave it out"),
                                  ("switching.schedule", "growing", 'switching.schedule = "measured"'),
                                  ("analysis.deviations", "mtotdev", "totdev"),
                                  ("compensation.bridge", "optimal", 'compensation.bridge = "auto"'),
                                  ("compensation.prior", "learnt", "leave it out"), ("compensation.prior_line_hz", "20", "leave it out")):
            section, name = key.split(".")
            file = self.write("old.toml", f'[{section}]\n{name} = "{value}"\n')
            for verb in (("run",), ("process", log)):
                for options in (("--set", f"{key}={value}"), ("--config", file)):
                    with self.subTest(key=key, verb=verb[0], options=options[0]):
                        refused = self.refuse(USAGE, *verb, *options, "--out", self.folder / "out.csv")
                        self.assertIn(key, refused.stderr)
                        self.assertIn(takes, refused.stderr)
