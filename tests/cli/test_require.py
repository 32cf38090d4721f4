"""`zlg design --require`: exits, JSON, what `zlg run` takes of it."""

import json
import signal
import subprocess
import time

from support import ZLG, CliTest, run

GYRO = """[motion]
kind = "constant"
rate_arcsec_s = 37.3
[compensation]
magnetic = "none"
[switching]
schedule = "fixed"
"""


class Require(CliTest):
    def required(self, demands, gyro=GYRO):
        path = self.folder / "require.toml"
        path.write_text(f"[require]\nrun_s = 40\ngyros = 20\n{demands}\n{gyro}")
        return path

    def test_what_is_met(self):
        path = self.required("angle_error_arcsec = 30\nconfidence = 0.8")
        answer = json.loads(self.succeed("design", "--require", path, "--json").stdout)
        self.assertTrue(answer["met"])
        self.assertGreaterEqual(answer["probability"], 0.8)
        self.assertGreater(answer["probability_sigma"], 0)
        self.assertTrue({"choice", "reasons", "budget", "binding", "would_need"} <= set(answer))
        self.assertEqual(answer["would_need"], [])
        chosen = self.folder / "chosen.toml"
        self.succeed("design", "--require", path, "--out", chosen)
        result = json.loads(self.succeed("run", chosen, "--logs", "none", "--out", self.folder / "run", "--json").stdout)
        self.assertLessEqual(abs(result["variants"][-1]["angle_error_without_nonmagnetic_arcsec"]), 60)
        printed = self.succeed("run", chosen, "--duration", "1", "--logs", "none", "--out", self.folder / "one", "--json")
        self.assertEqual(printed.returncode, 0)

    def test_what_cannot_be_met_is_exit_1_with_what_would_have_to_change(self):
        page = self.folder / "page.html"
        done = run("design", "--require", self.required("angle_error_arcsec = 0.1"), "--json", "--out", page)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cannot be met", done.stderr)
        answer = json.loads(done.stdout)
        self.assertFalse(answer["met"])
        self.assertGreater(answer["least_arcsec"], 0.1)
        self.assertEqual(len(answer["would_need"]), 7)
        self.assertIn("error-interval", page.read_text())

    def test_bad_usage_is_one_line(self):
        path = self.required("angle_error_arcsec = 30")
        for arguments in (["--require", path, "--run-lengths", "600"], ["--require", path, "--config", path],
                          ["--require", path, "--out", "a.pdf"],
                          ["--require", self.folder / "none.toml"], ["--require", path, "--set", "gyro.tick_s=-1"],
                          ["--require", path, "--out", path]):
            done = run("design", *arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_no_interval_is_computed_for_a_drift_that_the_closed_forms_do_not_know(self):
        field = ["field.kind=constant", "field.field_g=0.5", "field.sensitivity_arcsec_s_g=14"]
        profile = ["temperature.profile=[[0, 20], [600, 40]]"]
        path = self.required("angle_error_arcsec = 30")
        for sets, key in ((field, "field.kind"), (profile, "temperature.profile")):
            setting = [word for one in sets for word in ("--set", one)]
            for arguments in (["design"], ["design", "--require", path],
                              ["run", "--duration", "60", "--set", "switching.interval_s=optimal"]):
                done = run(*arguments, *setting)
                self.assertEqual(done.returncode, 2, (arguments, done.stdout, done.stderr))
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(key, done.stderr)

    def test_nothing_is_overwritten(self):
        page = self.folder / "page.html"
        page.write_text("mine")
        done = run("design", "--require", self.required("angle_error_arcsec = 30"), "--out", page)
        self.assertEqual((done.returncode, page.read_text()), (3, "mine"))

    def test_ctrl_c_gives_what_is_known_marked(self):
        path = self.required("angle_error_arcsec = 4\n", GYRO).read_text().replace("run_s = 40", "run_s = 20000")
        long = self.folder / "long.toml"
        long.write_text(path)
        child = subprocess.Popen([ZLG, "design", "--require", long], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=60)
        self.assertEqual(child.returncode, 3, err)
        self.assertIn("Interrupted", out)
        self.assertIn("interrupted by a signal", err)
