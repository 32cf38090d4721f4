"""`zlg sweep`: the same bytes by any way, rows that `zlg run` repeats, one line for what is wrong."""

import json
import os
import random
import resource
import shlex
import signal
import socket
import subprocess
import time

import h5py
import numpy

from support import ZLG, CliTest, complaints, is_larger, run, wait_until

SWEEP = """sweep = {gyros = 12, seed = 7, duration_s = 6}
base.switching.interval_s = 2
parameter = [
    {keys = ["piezo.half_wave_v"], draw = "normal", mean = 40, sd = 1},
    {keys = ["compensation.relock"], draw = "list", values = ["mean_square", "detuning"]},
    {keys = ["gyro.bias_chi"], draw = "sobol", min = 3.4, max = 3.8},
]
metric = [
    {name = "configured.switch_error_rms_arcsec", max = 3},
    {name = "bridge_quadratic.angle_error_arcsec"},
    {name = "switches", min = 1},
]
"""

# Half of these gyros are refused: their light noise is negative.
FAILING = """sweep = {gyros = 8, duration_s = 6}
base.switching.interval_s = 2
parameter = [
    {keys = ["gyro.light_noise_lambda"], draw = "list", values = [0.003, 0.002]},
    {keys = ["drift.random_walk_arcsec_sqrt_s"], draw = "normal", mean = 0, sd = 1},
]
metric = [{name = "configured.switch_error_rms_arcsec"}]
"""


class SweepTest(CliTest):
    def description(self, text=SWEEP, name="sweep.toml"):
        path = self.folder / name
        path.write_text(text)
        return path

    def swept(self, name, *arguments, text=SWEEP):
        """The results as bytes."""
        out = self.folder / name
        self.succeed("sweep", self.description(text), "--out", out, *arguments)
        self.assertEqual([p.name for p in self.folder.glob(f"{name}.*")], [], "nothing is left beside the results")
        return out.read_bytes()


class SameBytes(SweepTest):
    def test_after_any_number_of_kills_with_another_number_of_threads_each(self):
        longer = SWEEP.replace("duration_s = 6", "duration_s = 60").replace("gyros = 12", "gyros = 24")
        whole = self.swept("whole.h5", text=longer)
        description = self.description(longer)
        chance = random.Random(11)
        for trial in range(4):
            out = self.folder / f"killed_{trial}.h5"
            kills = 0
            for k in range(60):
                call = subprocess.Popen([ZLG, "sweep", description, "--out", out, "--threads", str(1 + k % 3)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(chance.uniform(0.0, 0.15))
                kills += call.poll() is None
                call.kill()
                call.wait()
                if out.exists():
                    break
            self.assertGreater(kills, 0)
            self.assertEqual(self.swept(out.name, text=longer), whole, f"after {kills} kills")

    def test_from_a_checkpoint_that_was_merged(self):
        longer = SWEEP.replace("duration_s = 6", "duration_s = 60")
        whole = self.swept("whole.h5", text=longer)
        description, out = self.description(longer), self.folder / "cut.h5"
        part = self.folder / "cut.h5.part"
        call = subprocess.Popen([ZLG, "sweep", description, "--out", out, "--threads", "1"], stdout=subprocess.DEVNULL)
        wait_until(lambda: part.exists() and b"\n0\t" in part.read_bytes(), call)
        call.kill()
        call.wait()
        merged = self.folder / "merged.h5"
        result = run("sweep", "--merge", part, "--out", merged)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.swept("merged.h5", text=longer), whole)


class Interrupted(SweepTest):
    def test_ends_with_what_is_recorded_and_goes_on(self):
        text = SWEEP.replace("duration_s = 6", "duration_s = 600")
        out = self.folder / "r.h5"
        part = self.folder / "r.h5.part"
        call = subprocess.Popen([ZLG, "sweep", self.description(text), "--out", out], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)
        wait_until(lambda: part.exists() and b"rows\t" in part.read_bytes(), call)
        call.send_signal(signal.SIGINT)
        stdout, stderr = call.communicate(timeout=60)
        self.assertEqual((call.returncode, stdout), (3, ""))
        self.assertRegex(stderr, r"^zlg: interrupted by a signal; \d+ of 12 gyros are in .*r\.h5\.part, and the same line goes on\n$")
        self.assertFalse(out.exists())


class Rows(SweepTest):
    def test_are_what_zlg_run_gives_alone_bit_for_bit(self):
        self.swept("r.h5")
        result = json.loads(run("sweep", self.description(), "--out", self.folder / "r.h5", "--json").stdout)
        with h5py.File(self.folder / "r.h5") as file:
            gyros = {name: column[()] for name, column in file["gyros"].items()}
        for shown in result["worst"]:
            words = shlex.split(shown["command"])
            self.assertEqual(words[:2], ["zlg", "run"])
            alone = self.succeed(*words[1:], "--logs", "none", "--json", "--quiet", "--out", self.folder / f"run_{shown['gyro']}")
            summary = json.loads(alone.stdout)
            k = shown["gyro"]
            variants = {variant["name"]: variant for variant in summary["variants"]}
            self.assertEqual(summary["fingerprint"], gyros["fingerprint"][k].decode())
            self.assertEqual(variants["configured"]["switch_error_rms_arcsec"], gyros["configured.switch_error_rms_arcsec"][k])
            self.assertEqual(variants["bridge_quadratic"]["angle_error_arcsec"], gyros["bridge_quadratic.angle_error_arcsec"][k])
            self.assertEqual(summary["switches"], gyros["switches"][k])
            self.assertEqual(summary["config"]["run.seed"], gyros["seed"][k])
            self.assertEqual(summary["config"]["piezo.half_wave_v"], gyros["piezo.half_wave_v"][k])


class FromEventToEvent(SweepTest):
    def test_a_row_is_what_its_command_gives_alone(self):
        text = SWEEP.replace("gyros = 12", "gyros = 3").replace("duration_s = 6", "duration_s = 60")
        text = text.replace("base.switching.interval_s = 2", 'base.switching.interval_s = 15\nbase.gyro.fidelity = "events"')
        result = json.loads(self.succeed("sweep", self.description(text), "--threads", 2, "--out", self.folder / "r.h5", "--json").stdout)
        with h5py.File(self.folder / "r.h5") as file:
            fingerprints = [text.decode() for text in file["gyros/fingerprint"][()]]
        for shown in result["worst"]:
            words = shlex.split(shown["command"])
            alone = self.succeed(*words[1:], "--json", "--quiet", "--out", self.folder / f"run_{shown['gyro']}")
            self.assertEqual(json.loads(alone.stdout)["fingerprint"], fingerprints[shown["gyro"]])


class Page(SweepTest):
    def test_is_written_beside_the_results_and_over_nothing(self):
        page = self.folder / "page.html"
        said = self.succeed("sweep", self.description(), "--out", self.folder / "r.h5", "--page", page).stdout
        text = page.read_text()
        for shown in ("What came out", "Gyros to look at", "zlg run ", "written to"):
            self.assertIn(shown, said)
        self.assertNotIn("What the numbers depend on", said)
        none = self.succeed("sweep", self.description(), "--out", self.folder / "none.h5", "--part", "13/13")
        self.assertTrue(none.stdout.startswith("no gyros\nwritten to "), none.stdout)
        for heading in ("What came out", "What the numbers depend on", "Gyros to look at"):
            self.assertIn(heading, text)
        self.assertIn("<svg", text)
        again = run("sweep", self.description(), "--out", self.folder / "other.h5", "--page", page)
        self.assertEqual(again.returncode, 3)
        self.assertIn("page.html exists", again.stderr)
        self.assertFalse((self.folder / "other.h5").exists())


class FailedGyros(SweepTest):
    def test_are_rows_with_a_reason_and_exit_1(self):
        out = self.folder / "r.h5"
        result = run("sweep", self.description(FAILING), "--out", out, "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        found = json.loads(result.stdout)
        with h5py.File(out) as file:
            status = file["gyros/status"][()]
            values = file["gyros/configured.switch_error_rms_arcsec"][()]
            reasons = [reason.decode() for reason in file["gyros/reason"]]
        self.assertTrue(0 < found["failed"] < 8)
        self.assertEqual(found["failed"], numpy.count_nonzero(status))
        self.assertTrue(numpy.all(numpy.isnan(values) == (status != 0)))
        self.assertAlmostEqual(found["metrics"]["configured.switch_error_rms_arcsec"]["mean"], values[status == 0].mean(), places=12)
        for k in range(8):
            self.assertEqual(bool(reasons[k]), status[k] != 0)
            if status[k]:
                self.assertIn("drift.random_walk_arcsec_sqrt_s", reasons[k])
        self.assertIn(f"{found['failed']} of 8 gyros failed", result.stderr)
        refused = next(shown for shown in found["worst"] if shown["status"] == "refused")
        alone = run(*shlex.split(refused["command"])[1:], "--out", self.folder / "alone")
        self.assertEqual(alone.returncode, 2, "refused alone, too")


class BadInput(SweepTest):
    def refused(self, code, *arguments, says):
        result = run("sweep", *arguments)
        self.assertEqual((result.returncode, result.stdout), (code, ""), result.stderr)
        self.assertEqual(len(complaints(result)), 1, result.stderr)
        self.assertIn(says, complaints(result)[0])

    def test_what_is_merged_are_regular_files(self):
        os.mkfifo(self.folder / "pipe")
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(self.folder / "socket"))
            for path in (self.folder / "pipe", self.folder / "socket", "/dev/zero", "/dev/full", "/dev/null"):
                self.refused(3, "--merge", path, "--out", self.folder / "m.h5", says=f"cannot read {path}: it is no regular file")
        self.refused(3, "--merge", self.folder, "--out", self.folder / "m.h5", says="it is a folder")

    def test_a_checkpoint_of_holes_costs_no_memory(self):
        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (600 << 20, 600 << 20))

        self.swept("r.h5", "--part", "1/2")
        for begin in (b"", b"zlg sweep checkpoint 1\n", b"zlg sweep checkpoint 1\n| x"):
            with open(self.folder / "holes.part", "wb") as file:
                file.write(begin)
                file.truncate(1 << 40)
            result = run("sweep", "--merge", self.folder / "holes.part", "--out", self.folder / "m.h5", preexec_fn=limited, timeout=20)
            self.assertEqual(result.returncode, 3)
            self.assertRegex(result.stderr, "holes.part.*(is damaged|cannot be read as HDF5)")

    def test_any_bit_of_a_description_is_damage(self):
        whole = self.swept("r.h5", "--part", "1/6")
        begin = whole.index(b"# zlg ")
        end = whole.index(b"min = 1", begin)
        generator = random.Random(4)
        for place in range(begin, end, 3):
            flipped = bytearray(whole)
            flipped[place] ^= 1 << generator.randrange(8)
            (self.folder / "flipped.h5").write_bytes(flipped)
            self.refused(3, "--merge", self.folder / "flipped.h5", "--out", self.folder / "m.h5", says="flipped.h5")

    def test_where_no_more_files_can_be_opened_nothing_empty_stays(self):
        description, out = self.description(), self.folder / "u.h5"
        for most in range(4, 10):
            result = run("sweep", description, "--out", out, "--force", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (most, most)))
            left = [p.name for p in self.folder.glob("u.h5*") if p.stat().st_size == 0]
            self.assertEqual(left, [], f"{most} files: {result.stderr}")

    def test_of_the_command_line(self):
        description, out = self.description(), self.folder / "r.h5"
        self.refused(2, description, says="--out is missing")
        self.refused(2, description, "--out", self.folder / "r.csv", says="allowed are .h5 and .hdf5")
        self.refused(2, "--out", out, says="either SWEEP.toml is wanted, or --merge")
        for part in ("0/3", "4/3", "2", "1/", "a/b", "1/3x"):
            self.refused(2, description, "--part", part, "--out", out, says=f"--part {part}: allowed is k/n")
        self.refused(2, self.folder / "none.toml", "--out", out, says="none.toml")
        self.refused(2, "--merge", out, "--part", "1/2", "--out", self.folder / "m.h5", says="not for --merge")
        self.refused(2, description, "--out", self.folder / "r.h5", "--threads", 0, says="--threads")
        # Before any gyro runs.
        self.refused(3, description, "--out", out, "--page", self.folder / "none" / "p.html", says="there is no folder")
        page = self.folder / "p.html"
        page.write_text(SWEEP)
        self.refused(2, page, "--out", out, "--page", page, "--force", says="--page")
        self.assertFalse(out.exists())

    def test_a_link_stays_one(self):
        (self.folder / "elsewhere").mkdir()
        (self.folder / "r.h5").symlink_to(self.folder / "elsewhere" / "real.h5")
        (self.folder / "elsewhere" / "real.h5").write_bytes(self.swept("first.h5"))
        more = self.description(SWEEP.replace("gyros = 12", "gyros = 13"), "more.toml")
        self.assertEqual(run("sweep", more, "--out", self.folder / "r.h5").returncode, 0)
        self.assertTrue((self.folder / "r.h5").is_symlink())
        whole = self.swept("whole.h5", text=more.read_text())
        self.assertEqual((self.folder / "elsewhere" / "real.h5").read_bytes(), whole)
        (self.folder / "new.h5").symlink_to("elsewhere/new.h5")
        self.assertEqual(run("sweep", more, "--out", self.folder / "new.h5").returncode, 0)
        self.assertEqual((self.folder / "elsewhere" / "new.h5").read_bytes(), whole, "not there before")
        for a, b in (("x.h5", "y.h5"), ("y.h5", "x.h5")):
            (self.folder / a).symlink_to(b)
        self.refused(3, more, "--out", self.folder / "x.h5", says="too many links")

    def test_a_motion_file_that_changes_meanwhile_ends_the_sweep_and_leaves_good_rows(self):
        motion, out, part = (self.folder / name for name in ("motion.csv", "r.h5", "r.h5.part"))
        bytes_before = "".join(f"{k % 7}\n" for k in range(1000)).encode()
        motion.write_bytes(bytes_before)
        text = SWEEP.replace("base.", f"base.motion = {{kind = 'file', path = '{motion}'}}\nbase.")
        text = text.replace("gyros = 12", "gyros = 600")
        description = self.description(text)
        sweep = subprocess.Popen([ZLG, "sweep", description, "--out", out], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        wait_until(lambda: is_larger(part, 5000), sweep)
        motion.write_bytes(b"3\n" * 1000)
        _, said = sweep.communicate(timeout=60)
        self.assertEqual((sweep.returncode, said), (3, f"zlg: the motion file {motion} has changed while the sweep ran\n"))
        motion.write_bytes(bytes_before)
        self.succeed("sweep", description, "--out", out)
        self.assertEqual(out.read_bytes(), self.swept("whole.h5", text=text))

    def test_a_full_disk_loses_nothing(self):
        whole = self.swept("whole.h5")
        out = self.folder / "full.h5"
        limited = ["bash", "-c", 'ulimit -f 1; exec "$@"', "limited", ZLG, "sweep", self.description(), "--out", out]
        result = subprocess.run(list(map(str, limited)), capture_output=True, text=True)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stderr, r"^zlg: cannot write .*full\.h5\.part: File too large\n$")
        self.assertTrue((self.folder / "full.h5.part").exists())
        self.assertEqual(self.swept("full.h5"), whole)

    def test_the_description_is_never_overwritten(self):
        path = self.description(name="sweep.h5")
        self.refused(2, path, "--out", path, "--force", says="sweep.h5")
        self.assertEqual(path.read_text(), SWEEP)
