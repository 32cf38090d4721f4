"""What one sees first: the help of the program, and what `zlg run` prints and keeps."""

import json
import os
import pty
import re
import subprocess

from support import ZLG, CliTest

VERBS = ["run", "simulate", "paper", "lab", "sweep", "process", "convert", "calibrate", "follow", "inspect", "design", "analyze"]
SHORT = ["--duration", 12, "--set", "switching.interval_s=5"]


class Help(CliTest):
    def test_a_bare_call_shows_the_help_and_is_wrong_usage(self):
        bare = self.refuse(2)
        self.assertEqual(bare.stdout, self.succeed("--help").stdout)
        self.assertEqual(bare.stdout, self.succeed("help").stdout)
        groups = re.findall(r"^(Simulate a gyro|Process records|Analyse|Design):$", bare.stdout, re.MULTILINE)
        self.assertEqual(len(groups), 4)

    def test_help_of_a_verb(self):
        for verb in VERBS:
            with self.subTest(verb):
                self.assertEqual(self.succeed("help", verb).stdout, self.succeed(verb, "--help").stdout)
        self.refuse(2, "help", "runn", says=["runn", "'run'"])

    def test_every_verb_has_examples_of_options_that_exist(self):
        keys = set(re.findall(r"^\| `(\w+)` \|", self.succeed("--keys").stdout, re.MULTILINE))
        for verb in VERBS:
            with self.subTest(verb):
                options, _, examples = self.succeed("help", verb).stdout.partition("Examples:\n")
                lines = examples.splitlines()
                self.assertTrue(lines)
                self.assertNotRegex(options, r"\b(TEXT|INT|FLOAT|UINT)\b")
                for line in lines:
                    self.assertTrue(line.startswith(f"  zlg {verb} ") or line == f"  zlg {verb}", line)
                    self.assertEqual(set(re.findall(r"--[\w-]+", line)) - set(re.findall(r"--[\w-]+", options)), set())
                    self.assertEqual(set(re.findall(r"--set \w+\.(\w+)=", line)) - keys, set())


class Quiet(CliTest):
    NOTED = [*SHORT[:2], "--set", "switching.interval_s=optimal", "--logs", "none"]

    def test_notes_are_dropped_and_warnings_are_not(self):
        self.assertIn("optimal", self.succeed("run", *self.NOTED, "--out", self.folder / "a").stderr)
        self.assertEqual(self.succeed("run", *self.NOTED, "--quiet", "--out", self.folder / "b").stderr, "")
        odd = ["simulate", "--duration", 1, "--set", "gyro.bias_chi=9", "--set", "gyro.fidelity=laser", "--quiet"]
        self.assertIn("warning: ", self.succeed(*odd, "--out", self.folder / "raw.csv").stderr)

    def test_the_reason_of_an_exit_stays(self):
        never = ["--duration", 12, "--set", "switching.interval_s=5", "--set", "perimeter.miss_lambda=0", "--set", "piezo.half_wave_error=-0.5"]
        self.refuse(1, "run", *never, "--quiet", "--logs", "none", "--out", self.folder / "run", says=["no switch"])


class Table(CliTest):
    def shown(self, *settings):
        return self.succeed("run", *settings, "--logs", "none", "--out", self.folder / "run").stdout.splitlines()

    def test_it_leads_with_the_error_of_a_switch_and_ends_with_the_page(self):
        lines = self.shown(*SHORT)
        self.assertTrue(lines[0].startswith("12 s, 2 switches"))
        summary = json.loads((self.folder / "run" / "summary.json").read_text())
        best = summary["variants"][2]
        (row,) = [line for line in lines if line.startswith("relock_frequency ")]
        numbers = re.findall(r"-?\d+\.\d+", row)
        self.assertEqual(numbers[:4], [f"{best['switch_error_rms_arcsec']:.2f}", f"{best['switch_error_mean_arcsec']:.2f}",
                                       f"{best['switch_error_max_arcsec']:.2f}", f"{best['drift_without_nonmagnetic_arcsec_s']:.4f}"])
        self.assertEqual(lines[-1], f"open {self.folder / 'run' / 'report.html'} in a browser")
        self.assertEqual(summary["magnetic_estimate"].keys(), best.keys())
        self.assertAlmostEqual(best["drift_arcsec_s"] - best["drift_without_nonmagnetic_arcsec_s"], 0.05, places=12)
        self.assertAlmostEqual(best["angle_error_arcsec"] - best["angle_error_without_nonmagnetic_arcsec"], 0.05 * 12, places=9)

    def test_equal_compensations_share_a_row(self):
        text = "\n".join(self.shown("--duration", 2))
        names = re.findall(r"[a-z]+_[a-z_]+|\bswitching\b|\bconfigured\b", text.partition("compensation ")[2].partition("\n\n")[0])
        self.assertEqual(len(set(names) & {"one_mode", "switching", "bridge_linear", "configured", "magnetic_estimate"}), 5)
        self.assertEqual(len(re.findall(r"^.* - +- +- .*\d$", text, re.MULTILINE)), 1, text)

    def test_a_fault_is_said(self):
        lines = self.shown("--duration", 6, "--set", "faults.kind=laser_off", "--set", "faults.at_s=3", "--set", "faults.duration_s=0.3",
                           "--set", "faults.size=0")
        self.assertRegex(lines[1], r"laser_off at 3 s for 0.3 s; the core raised light_lost.*; 60 of 1200 ticks")
        self.assertEqual(json.loads((self.folder / "run" / "summary.json").read_text())["ticks_invalid"], 60)


class Logs(CliTest):
    def kept(self, *options):
        self.succeed("run", "--duration", 2, *options, "--out", self.folder / "run", "--force")
        return {path.name for path in (self.folder / "run").iterdir()} - {"summary.json", "report.html", "health.csv", "switches.csv"}

    def test_what_is_kept_and_no_log_of_an_earlier_run(self):
        self.assertEqual(self.kept(), {"raw.h5", "angles.h5"})
        self.assertEqual(self.kept("--logs", "angles"), {"angles.h5"})
        self.assertEqual(self.kept("--logs", "all"), {"raw.h5", "angles.h5"})
        self.refuse(3, "run", "--duration", 1, "--logs", "none", "--out", self.folder / "run", says=["raw.h5", "--force"])
        self.assertEqual(self.kept("--logs", "none"), set())

    def test_what_is_refused(self):
        self.refuse(2, "run", "--logs", "some", "--out", self.folder / "run", says=["none, angles and all"])
        self.refuse(2, "run", "--logs", "angles", "--light", "--out", self.folder / "run", says=["--light"])


class Progress(CliTest):
    def test_the_bar_says_what_time_is_left(self):
        for quiet in ([], ["--quiet"]):
            master, slave = pty.openpty()
            call = ["run", "--duration", "10800", "--threads", "1", "--logs", "none", *quiet, "--out", str(self.folder / f"run{len(quiet)}")]
            subprocess.run([ZLG, *call], stdout=subprocess.DEVNULL, stderr=slave, check=True, timeout=300)
            os.close(slave)
            drawn = b""
            try:
                while block := os.read(master, 65536):
                    drawn += block
            except OSError:
                pass
            os.close(master)
            self.assertEqual(bool(re.search(rb"\] +\d+ %, .* s left", drawn)), not quiet, drawn[-200:])


class ForeignFiles(CliTest):
    def test_inspect_says_what_a_file_looks_like_and_what_to_do(self):
        for content, nature in ((b"\x93NUMPY\x01\x00" + bytes(60), "NumPy"), (b"MATLAB 5.0 MAT-file" + bytes(200), "MATLAB 5"),
                                (b"time;rate\n0,0;1,5\n0,1;1,6\n0,2;1,7\n", ""), (b"a letter to nobody\n", "")):
            with self.subTest(nature):
                self.refuse(3, "inspect", self.write("file", content), says=[nature, "zlg import"])
