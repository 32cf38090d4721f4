"""The closed loop compiled for other machines, arm64 and WebAssembly: what it measures, and what it says when it refuses."""

import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
NODE = ["node", "--no-warnings"]
PROGRAM = "bin/zlg_loop_fingerprint"

# Both fidelities, and what makes each part of the loop work: switches, learning, light, faults, motion, a schedule that measures.
GYROS = [
    ["run.duration_s=20", "switching.interval_s=2"],
    ["run.duration_s=10", "compensation.relock=joint", "switching.interval_s=1", "run.seed=2"],
    ["run.duration_s=20", "faults.random_per_hour=3600", "faults.random_seed=4", "switching.interval_s=3"],
    ["run.duration_s=10", "motion.kind=sum", "motion.amplitude_arcsec_s=[100, 30]", "motion.frequency_hz=[0.3, 7]", "switching.interval_s=2"],
    ["run.duration_s=20", "switching.schedule=measured", "switching.interval_s=2", "drift.magnetic_arcsec_s=3"],
    ["run.duration_s=5", "gyro.fidelity=laser", "switching.interval_s=1"],
    ["run.duration_s=5", "gyro.fidelity=laser", "laser.quadrature=x4", "motion.kind=sine", "switching.interval_s=1"],
]

# A refusal from each place where one error is turned into another with more words.
REFUSED = [
    ["run.duraton_s=10"],
    ["gyro.tick_s=abc"],
    ["run.seed=[0.1, 1e-320, {a = 1.0}, 2024-02-03T04:05:06-01:30]"],
    ["run.seed=0.30000000000000004"],
    ["run=1"],
    ["motion.kind=file", "motion.path=x"],
    ["switching.interval_s=optimal"],
    ["faults.random_per_hour=1e6", "run.duration_s=1e6"],
    ["perimeter.loop=exponential", "piezo.hysteresis=0.1"],
    ["gyro.fidelity=laser", "laser.gain_loss_ratio=1.0001"],
    ["gyro.fidelity=laser", "laser.isotope_shift_hz=3e9"],
    ["motion.kind=constant", "motion.rate_arcsec_s=1e300"],
]


def build(preset, *targets):
    """Configure and build a preset; its folder."""
    wanted = [word for target in targets for word in ("--target", target)]
    for command in (["cmake", "--preset", preset], ["cmake", "--build", f"build/{preset}", "-j", str(os.cpu_count()), *wanted]):
        made = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if made.returncode != 0:
            raise AssertionError(f"{' '.join(command)}:\n{made.stdout[-4000:]}")
    return ROOT / "build" / preset


def said(program, arguments, given=None):
    """Exit status, standard output and standard error."""
    ran = subprocess.run([*program, *arguments], input=given, capture_output=True, text=True, timeout=300)
    return ran.returncode, ran.stdout, ran.stderr


class Target:
    """Tests of one machine; `program` runs the loop there."""

    def test_each_gyro_gives_the_bits_of_this_machine(self):
        for gyro in GYROS:
            with self.subTest(gyro=gyro):
                here = said(self.native, gyro)
                self.assertEqual((here[0], here[2]), (0, ""))
                there = said(self.program, gyro)
                self.assertEqual((there[0], there[2]), (0, ""))
                self.assertEqual(there[1], here[1])

    def test_another_seed_gives_other_bits(self):
        lines = {said(self.program, ["run.duration_s=1", f"run.seed={seed}"])[1] for seed in (1, 2)}
        self.assertEqual(len(lines), 2)

    def test_refusals_are_those_of_this_machine(self):
        for settings in REFUSED:
            with self.subTest(settings=settings):
                here = said(self.native, settings)
                self.assertEqual((here[0], here[1]), (1, ""))
                self.assertEqual(said(self.program, settings), here)


@unittest.skipUnless(shutil.which("aarch64-linux-gnu-g++"), "there is no aarch64-linux-gnu-g++")
@unittest.skipUnless(shutil.which("qemu-aarch64"), "there is no qemu-aarch64")
class Arm64(Target, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.native = [build("release", "zlg_loop_fingerprint") / PROGRAM]
        cls.program = ["qemu-aarch64", build("arm64") / PROGRAM]


@unittest.skipUnless(shutil.which("clang++") and shutil.which("wasm-ld"), "there is no clang++ or no wasm-ld")
@unittest.skipUnless(Path("/usr/lib/wasm32-wasi/libc++abi.a").exists(), "there is no libc++ for wasm32")
@unittest.skipUnless(shutil.which("node"), "there is no node")
class WebAssembly(Target, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.native = [build("release", "zlg_loop_fingerprint") / PROGRAM]
        cls.folder = build("wasm")
        cls.program = [*NODE, HERE / "run_wasi.mjs", f"{cls.folder / PROGRAM}.wasm"]

    def calls(self, *calls):
        """What the module gives when a page makes these calls."""
        status, out, error = said([*NODE, HERE / "call_module.mjs", self.folder / "bin" / "zlg_loop.wasm"], [], json.dumps(calls))
        self.assertEqual((status, error), (0, ""))
        return json.loads(out)

    def test_a_page_advances_a_gyro_and_begins_another(self):
        self.assertEqual(self.calls(["configure", "run.duration_s=1\n\ngyro.tick_s=0.01\n"], ["advance", 100], ["advance", 1], ["configure", ""],
                                    ["advance", 400]),
                         [0, 0.5, 0.505, 0, 1])

    def test_the_later_of_two_lines_is_in_force(self):
        self.assertEqual(self.calls(["configure", "gyro.tick_s=0.01\ngyro.tick_s=0.02"], ["advance", 100]), [0, 1])

    def test_a_refused_configuration_leaves_the_gyro_as_it_was(self):
        refusal = "--set: unknown key [run] duraton_s; did you mean duration_s?"
        self.assertEqual(self.calls(["configure", ""], ["advance", 200], ["configure", "run.duraton_s=1"], ["advance", 200]), [0, 0.5, refusal, 1])

    def test_a_gyro_beyond_any_counter_is_refused_in_its_run(self):
        configured, refusal = self.calls(["configure", "motion.kind=constant\nmotion.rate_arcsec_s=1e300"], ["advance", 1])
        self.assertEqual(configured, 0)
        self.assertIn("motion.rate_arcsec_s = 1e+300, a rate beyond any counter", refusal)

    def test_text_that_is_no_utf_8_is_refused(self):
        (refusal,) = self.calls(["configure", [*b"motion.path=", 0xFF]])
        self.assertIn("a value cannot be read as text", refusal)

    def test_a_page_without_a_gyro_is_told_so(self):
        self.assertEqual(self.calls(["advance", 1]), ["no gyro is configured"])

    def test_many_refusals_cost_no_memory(self):
        refused = [["configure", "run.duraton_s=1"]]
        found = self.calls(*refused * 100, ["memory_bytes"], *refused * 5000, ["memory_bytes"])
        self.assertEqual(len(set(found[:100] + found[101:-1])), 1)
        self.assertEqual(found[100], found[-1])
