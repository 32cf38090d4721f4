"""`zlg inspect`: what it finds, and that --repair loses nothing that was whole."""

import json

from support import CliTest, csv_text, quiet_log, run, warnings


class Inspect(CliTest):
    def findings(self, path, code=0):
        result = run("inspect", path, "--json")
        self.assertEqual(result.returncode, code, result.stderr)
        return json.loads(result.stdout)

    def test_counts_ticks_gaps_and_halves(self):
        rows = quiet_log(n_ticks=40, gap=range(10, 13))
        found = self.findings(self.write("raw.csv", csv_text(rows)))
        self.assertEqual((found["kind"], found["ticks"], found["gaps"], found["open_halves"]), ("raw", 40, 1, 6))
        self.assertIsNone(found["damage"])

    def test_gaps_at_both_ends_count_in_process_too(self):
        rows = quiet_log(n_ticks=40, gap=[0, 1, 20, 38, 39])
        raw = self.write("raw.csv", csv_text(rows))
        processed = json.loads(self.succeed("process", raw, "--out", self.folder / "a.csv", "--json").stdout)
        self.assertEqual(processed["gaps"], 3)
        self.assertEqual(self.findings(raw)["gaps"], 3)

    def test_damage_is_named_and_the_result_says_no(self):
        text = csv_text(quiet_log(n_ticks=20)).replace("\n30,", "\n31,")
        found = self.findings(self.write("raw.csv", text), code=1)
        self.assertEqual(found["halves"], 30)
        self.assertIn("hole", found["damage"])

    def test_fewer_rows_than_the_settings_say_are_warned_of(self):
        self.succeed("run", "--duration", 2, "--format", "csv", "--quiet", "--out", self.folder / "run")
        duration = "# run.duration_s = 2\n"
        for name, rows_a_tick in (("raw", 2), ("angles", 1)):
            unsaid = (self.folder / "run" / f"{name}.csv").read_text().replace(duration, "")
            at = unsaid.index("# gyro.")
            whole = (unsaid[:at] + duration + unsaid[at:]).splitlines(True)
            self.assertEqual(warnings(self.succeed("inspect", self.write("log.csv", "".join(whole)))), [])
            log = self.write("log.csv", "".join(whole[:-10 * rows_a_tick]))
            self.assertEqual(warnings(self.succeed("inspect", log)),
                             [f"zlg: warning: {log}: holds 390 ticks, its settings (run.duration_s = 2) say 400; "
                              "the file may have been cut off"])
            log = self.write("log.csv", "".join(unsaid.splitlines(True)[:-10 * rows_a_tick]))
            self.assertEqual(warnings(self.succeed("inspect", log)), [])

    def test_the_delay_of_a_final_value_is_that_of_the_documents(self):
        # max(16, gap_ticks) + max(8, relock_ticks where re-lock is corrected) + 80 ms in ticks + 1; by a polynomial 16 and its points.
        asked = {53: [], 41: ["--set", "compensation.relock=none"], 117: ["--set", "gyro.tick_s=0.001", "--set", "switching.interval_s=1"],
                 74: ["--set", "switching.gap_ticks=37"], 20: ["--set", "compensation.bridge=quadratic"]}
        for suffix in ("csv", "h5"):
            for delay, settings in asked.items():
                self.succeed("run", "--duration", 1, *settings, "--format", suffix, "--quiet", "--out", self.folder / f"{suffix}{delay}")
                self.assertEqual(self.findings(self.folder / f"{suffix}{delay}" / f"angles.{suffix}")["final_delay_ticks"], delay)
        self.assertIn("final_delay_ticks", self.succeed("inspect", self.folder / "csv53" / "angles.csv").stdout)

    def test_a_raw_log_of_a_run_says_how_long_it_is(self):
        self.succeed("simulate", "--duration", 2, "--out", self.folder / "raw.csv")
        rows = (self.folder / "raw.csv").read_text().splitlines(True)
        self.assertEqual(len(warnings(self.succeed("inspect", self.write("cut.csv", "".join(rows[:-2]))))), 1)

    def test_repair_keeps_every_whole_row_and_no_other_column(self):
        for columns in (None, ["half", "bias_sign", "mode", "counts", "loop_closed", "valid", "temperature_c"]):
            rows = quiet_log(n_ticks=20)
            for row in rows:
                row.update(valid=1, temperature_c=20.5)
            names = columns or ["half", "bias_sign", "mode", "counts", "loop_closed"]
            whole = csv_text(rows, names)
            raw = self.write("raw.csv", whole + "40,1,1,2")
            out = self.folder / "clean.csv"
            self.succeed("inspect", raw, "--repair", "--out", out, "--force")
            self.assertEqual(out.read_text(), whole)

    def test_repair_never_writes_over_its_input(self):
        raw = self.write("raw.csv", csv_text(quiet_log()) + "80,1")
        before = raw.read_bytes()
        self.assertEqual(run("inspect", raw, "--repair", "--out", raw, "--force").returncode, 2)
        self.assertEqual(raw.read_bytes(), before)

    def test_a_log_that_is_one_half_is_refused(self):
        raw = self.write("raw.csv", csv_text(quiet_log()[:1]))
        self.assertEqual(run("process", raw, "--out", self.folder / "a.csv").returncode, 3)
        self.assertFalse((self.folder / "a.csv").exists())


class UnclearSettings(CliTest):
    def refused(self, *lines):
        raw = self.write("raw.csv", csv_text(quiet_log(), lines=lines))
        result = run("process", raw, "--out", self.folder / "a.csv", "--force")
        return result.returncode == 3

    def test_nearly_known_sections_and_contradictions(self):
        self.assertTrue(self.refused("gyr.scale_arcsec = 1.5"))
        self.assertTrue(self.refused("GYRO.scale_arcsec = 1.5"))
        self.assertTrue(self.refused("scale_arcsec = 1.5", "gyro.scale_arcsec = 2"))
        self.assertFalse(self.refused("laboratory = 12", "operator.name = x", "gyro.scale_arcsec = 1.5"))

    def test_a_contradiction_is_damage(self):
        lines = ["laboratory = 12", "gyro.bias_hz = 50000", "gyro.bias_chi = 3", "gyro.bias_hz = 60000", "gyro.bias_chi = 3.0"]
        raw = self.write("raw.csv", csv_text(quiet_log(), lines=lines))
        result = run("inspect", raw, "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(json.loads(result.stdout)["halves"], 80)
        self.assertIn("gyro.bias_hz stands twice, as 50000 and as 60000", json.loads(result.stdout)["damage"])
        self.succeed("inspect", raw, "--repair", "--out", self.folder / "good.csv")
        self.succeed("inspect", self.folder / "good.csv")
        self.succeed("process", self.folder / "good.csv", "--out", self.folder / "a.csv")
