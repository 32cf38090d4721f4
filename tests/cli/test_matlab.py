"""`zlg convert LOG --out FILE.mat`: every value of the log, by a reader of the format alone and by `zlg import`."""

import json
import os
import resource

import h5py
import numpy
from mat_file import read_mat
from support import CliTest, folder_until, run


class Matlab(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = folder_until(cls.addClassCleanup)
        settings = ["--set", "switching.interval_s=5", "--set", "gyro.light_samples=8", "--set", "gyro.readout=phase"]
        assert run("run", "--duration", 20, *settings, "--light", "--out", cls.made / "run").returncode == 0

    def converted(self, log):
        out = self.folder / "log.mat"
        said = json.loads(self.succeed("convert", log, "--out", out, "--force", "--json").stdout)
        return read_mat(out), said["rows"]

    def assert_columns(self, variables, group, rows):
        for name, column in group.items():
            if name.startswith("light"):
                continue
            self.assertEqual(variables[name].shape, (rows, 1), name)
            numpy.testing.assert_array_equal(variables[name][:, 0], numpy.asarray(column, float), name)

    def test_a_raw_log_with_its_light(self):
        variables, rows = self.converted(self.made / "run" / "raw.h5")
        with h5py.File(self.made / "run" / "raw.h5") as file:
            raw = file["raw"]
            self.assertEqual(rows, len(raw["half"]))
            self.assert_columns(variables, raw, rows)
            for name in ("light", "light_b"):
                numpy.testing.assert_array_equal(variables[name], numpy.asarray(raw[name], float).T)
            others = set(variables) - set(raw)
            self.assertEqual(variables["settings"], file["config"][()].decode())
            timer = {"timer_hz"} if "edge_offset_ticks" in raw else set()
        self.assertEqual(others, {"tick_s", "scale_arcsec", "settings"} | timer)
        self.assertEqual(variables["tick_s"].tolist(), [[0.005]])
        self.assertEqual(variables["scale_arcsec"].tolist(), [[3.263]])

    def test_an_angle_log_with_the_truth(self):
        variables, rows = self.converted(self.made / "run" / "angles.h5")
        self.assertEqual(rows, 4000)
        with h5py.File(self.made / "run" / "angles.h5") as file:
            self.assert_columns(variables, file["angles"], rows)
            numpy.testing.assert_array_equal(variables["truth_dtheta_arcsec"][:, 0], file["truth/dtheta_arcsec"])
        self.assertIn("flags", variables["settings"])
        self.assertEqual(variables["tick_s"].tolist(), [[0.005]])

    def test_a_log_of_text_gives_the_same_and_its_letters(self):
        csv = self.folder / "raw.csv"
        self.succeed("convert", self.made / "run" / "raw.h5", "--out", csv)
        csv.write_text("# operator = Łukasz Müller \U0001d6fa\n" + csv.read_text())
        variables, _ = self.converted(csv)
        from_h5, _ = self.converted(self.made / "run" / "raw.h5")
        for name in set(from_h5) - {"settings", "light", "light_b"}:
            numpy.testing.assert_array_equal(variables[name], from_h5[name], name)
        self.assertIn("Łukasz Müller \U0001d6fa", variables["settings"])
        self.assertNotIn("light", variables)

    def test_there_and_back_by_another_reader(self):
        """`zlg import` reads the file."""
        self.converted(self.made / "run" / "raw.h5")
        columns = ("counts", "bias_sign", "mode", "loop_closed", "valid", "detuning_lambda", "detuning_sq_lambda2", "piezo_v")
        maps = [word for name in columns for word in ("--map", f"{name}={name}")]
        back = self.folder / "back.h5"
        self.succeed("import", self.folder / "log.mat", *maps, "--map", "tick_s=0.005", "--map", "scale_arcsec=3.263", "--out", back)
        with h5py.File(self.made / "run" / "raw.h5") as was, h5py.File(back) as now:
            for name in columns:
                numpy.testing.assert_array_equal(now["raw"][name], was["raw"][name], name)

    def test_refusals_and_what_they_leave(self):
        raw = self.made / "run" / "raw.h5"
        self.refuse(2, "convert", raw, says=(".mat",))
        self.refuse(2, "convert", raw, "--out", self.folder / "a.txt", says=(".txt",))
        out = self.folder / "a.mat"
        out.write_text("mine")
        self.refuse(3, "convert", raw, "--out", out, says=("exists", "--force"))
        self.assertEqual(out.read_text(), "mine")
        out.unlink()
        result = run("convert", raw, "--out", out, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000)))
        self.assertEqual(result.returncode, 3)
        self.assertIn("cannot write", result.stderr)
        bad = self.folder / "bad.csv"
        lines = (self.folder / "good.csv")
        self.succeed("convert", raw, "--out", lines)
        bad.write_text(lines.read_text() + "no row\n")
        self.refuse(3, "convert", bad, "--out", out)
        self.assertEqual([name for name in os.listdir(self.folder) if ".mat" in name], [])
        # A log is no foreign file, but its copy for MATLAB is.
        self.succeed("convert", raw, "--out", out)
        self.refuse(3, "convert", out, "--out", self.folder / "b.csv", says=("MATLAB 5",))
