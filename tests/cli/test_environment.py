"""[temperature] and [field]: a gyro in a chamber and in a field, and courses that are none."""

import json
import unittest

from support import folder_until, run


class Environment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_until(cls.addClassCleanup)
        cls.n_runs = 0

    def run_with(self, *keys, duration=20):
        type(self).n_runs += 1
        sets = [word for key in keys for word in ("--set", key)]
        return run("run", "--duration", duration, "--logs", "none", "--json", "--set", "switching.interval_s=5", *sets,
                   "--out", self.folder / f"run{self.n_runs}")

    def refused(self, words, *keys, exit_code=2, **more):
        found = self.run_with(*keys, **more)
        self.assertEqual((found.returncode, found.stdout, found.stderr.count("\n")), (exit_code, "", 1), found.stderr)
        for word in words if isinstance(words, list) else [words]:
            self.assertIn(word, found.stderr)
        self.assertFalse((self.folder / f"run{self.n_runs}").exists())

    def test_points_and_a_file_of_them_are_the_same_run(self):
        path = self.folder / "chamber.txt"
        path.write_text("0 20\n10 25\n20 15\n")
        by_points = json.loads(self.run_with("temperature.profile=[[0, 20], [10, 25], [20, 15.0]]").stdout)
        by_file = json.loads(self.run_with(f"temperature.profile={path}").stdout)
        self.assertEqual(by_points["fingerprint"], by_file["fingerprint"])
        without = json.loads(self.run_with().stdout)
        self.assertNotEqual(by_points["fingerprint"], without["fingerprint"])
        again = json.loads(self.run_with("temperature.profile=[]", "field.kind=none", "field.field_g=3").stdout)
        self.assertEqual(again["fingerprint"], without["fingerprint"])

    def test_the_field_is_the_magnetic_drift(self):
        """Of a gyro that is never switched: 2 arcsec/(s G) times 3 G for 20 s, within the walk and two counts."""
        keys = ("field.kind=constant", "field.field_g=3", "field.sensitivity_arcsec_s_g=2", "gyro.readout=phase")
        said = json.loads(self.run_with(*keys, "motion.kind=rest").stdout)
        one_mode = next(v for v in said["variants"] if v["name"] == "one_mode")
        self.assertAlmostEqual(abs(one_mode["angle_error_without_nonmagnetic_arcsec"]), 120, delta=8)

    def test_a_profile_that_is_none(self):
        for points, words in (("[[0, 20]]", "1 points"), ("[[0, 20], [5, 21], [5, 22]]", "rising times"),
                              ("[[0, 20], [5, 21], [4, 22]]", "point 3"), ("[[0, 20], [1, nan]]", "point 2"),
                              ("[[0, 20], [inf, 2]]", "point 2"), ("[0, 20]", "a pair"), ("[[0, 1, 2], [1, 2, 3]]", "a pair"),
                              ("[[0, 20], [1, 1e9]]", "point 2"), ("true", "a path")):
            self.refused(["temperature.profile", words, "allowed"], f"temperature.profile={points}")
        self.refused("temperature_rise_c", "temperature.profile=[[0, 20], [1, 21]]", "gyro.temperature_rise_c=0")

    def test_a_table_that_is_none(self):
        for points, words in (("[[0, 0]]", "1 points"), ("[[0, 0], [0, 1e-3]]", "rising temperatures"), ("[[0, nan], [1, 0]]", "point 1"),
                              ("[0, 0]", "a pair")):
            self.refused(["gyro.bias_temperature_table", words, "allowed"], f"gyro.bias_temperature_table={points}")
        self.refused("gyro.bias_temperature_table", "gyro.bias_temperature_table=[[0, 0], [20, -1]]")

    def test_files_that_hold_no_course(self):
        self.refused("nothing.txt", f"temperature.profile={self.folder}/nothing.txt", exit_code=3)
        path = self.folder / "bad.txt"
        for text, exit_code in (("0 20\n", 2), ("0 20\n9 21\n8 22\n", 2), ("0\n1\n", 3), ("0 x\n1 y\n", 3), ("", 3)):
            path.write_text(text)
            self.refused("bad.txt", f"temperature.profile={path}", exit_code=exit_code)
            self.refused("bad.txt", "field.kind=file", f"field.course={path}", exit_code=exit_code)

    def test_a_field_that_is_none(self):
        path = self.folder / "field.txt"
        path.write_text("0 0.5\n10 0.4\n")
        self.refused(["run.duration_s = 20", "10 s of the field"], "field.kind=file", f"field.course={path}")
        self.assertEqual(self.run_with("field.kind=file", f"field.course={path}", duration=10).returncode, 0)
        self.refused("field.course", "field.kind=steps")
        self.refused("field.course", "field.kind=file")
        self.refused("field.course", "field.kind=steps", f"field.course={path}")
        self.refused("field.kind", "field.kind=wave")
        self.refused("field.sensitivity_per_c", "field.sensitivity_per_c=2")


if __name__ == "__main__":
    unittest.main()
