"""relock = "joint": the light samples on their way through files, and what becomes of them live and replayed."""

import h5py
import numpy

from support import CliTest

USAGE = 2
JOINT = ["--set", "compensation.relock=joint"]
SHORT = ["--duration", 24, "--set", "switching.interval_s=4"]


def columns(path, group):
    with h5py.File(path) as file:
        return {name: data[()] for name, data in file[group].items()}


class Joint(CliTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "run"
        self.raw = self.out / "raw.h5"
        self.succeed("run", *SHORT, *JOINT, "--out", self.out, "--light")
        self.live = columns(self.out / "angles.h5", "angles")

    def replayed(self, raw, *options):
        out = self.folder / "replayed.h5"
        result = self.succeed("process", raw, "--out", out, "--force", *options)
        return columns(out, "angles"), result.stderr

    def expect_live(self, angles):
        for name, live in self.live.items():
            self.assertTrue(numpy.array_equal(live, angles[name], equal_nan=True), name)

    def without(self, *names):
        path = self.folder / "less.h5"
        path.write_bytes(self.raw.read_bytes())
        with h5py.File(path, "r+") as file:
            for name in names:
                del file["raw"][name]
        return path

    def test_copies_keep_both_beams(self):
        there, clean = self.folder / "there.h5", self.folder / "clean.h5"
        self.succeed("convert", self.raw, "--out", there)
        self.succeed("inspect", there, "--repair", "--out", clean)
        before, after = columns(self.raw, "raw"), columns(clean, "raw")
        self.assertEqual(set(before), set(after))
        for name in before:
            self.assertTrue((before[name] == after[name]).all(), name)
        self.expect_live(self.replayed(clean)[0])

    def test_from_its_part(self):
        part = self.folder / "raw.h5.part"
        part.write_bytes(self.raw.read_bytes())
        self.expect_live(self.replayed(part)[0])

    def test_one_beam_is_near_what_both_say(self):
        angles, said = self.replayed(self.without("light_b"))
        self.assertEqual(said, "")
        self.assertFalse(numpy.array_equal(angles["dtheta_final_arcsec"], self.live["dtheta_final_arcsec"]))
        self.assertLess(abs(angles["dtheta_final_arcsec"].sum() - self.live["dtheta_final_arcsec"].sum()), 10.0)

    def test_without_light_the_mean_squares_serve_and_it_says_so(self):
        angles, said = self.replayed(self.without("light", "light_b"))
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn("no light samples", said)
        self.assertLess(abs(angles["dtheta_final_arcsec"].sum() - self.live["dtheta_final_arcsec"].sum()), 10.0)

    def test_without_detuning_it_is_refused(self):
        self.refuse(USAGE, "process", self.without("detuning_sq_lambda2"), "--out", self.folder / "a.h5",
                    says=["joint", "detuning_sq_lambda2"])

    def test_beam_b_needs_as_many_samples_as_beam_a(self):
        path = self.without("light")
        self.refuse(3, "process", path, "--out", self.folder / "a.h5", says=["light_b", "16", "0"])
