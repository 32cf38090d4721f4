"""HDF5 logs as a user meets them: other programs read them, they hold the same bits as CSV, they survive what happens."""

import json
import os
import resource
import signal
import subprocess
import time

import h5py
import numpy

from support import ZLG, CliTest, body_of, csv_text, quiet_log, run, wait_until

INPUT, USAGE = 3, 2
UNITS = {"half": "1", "bias_sign": "1", "mode": "1", "counts": "count", "loop_closed": "1", "valid": "1", "span": "1", "lit": "1",
         "detuning_lambda": "wavelength", "detuning_sq_lambda2": "wavelength^2", "piezo_v": "V", "temperature_c": "degC"}
ANGLE_UNITS = {"tick": "1", "t_s": "s", "dtheta_arcsec": "arcsec", "dtheta_final_arcsec": "arcsec", "sigma_arcsec": "arcsec",
               "mode": "1", "flags": "1"}
SHORT = ["--duration", 20, "--set", "switching.interval_s=4"]


def columns(path, group):
    with h5py.File(path) as file:
        return {name: data[()] for name, data in file[group].items()}


def csv_columns(path):
    table = numpy.genfromtxt(body_of(path).decode().splitlines(), delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


class OtherPrograms(CliTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "run"
        self.succeed("run", *SHORT, "--out", self.out, "--light")

    def test_h5py_reads_columns_units_and_configuration(self):
        import tomllib
        with h5py.File(self.out / "raw.h5") as raw:
            self.assertEqual({name: data.attrs["unit"] for name, data in raw["raw"].items() if not name.startswith("light")}, UNITS)
            self.assertEqual((raw.attrs["tick_s"], raw.attrs["scale_arcsec"], raw.attrs["format_version"]), (0.005, 3.263, 3))
            self.assertEqual(raw["raw/light"].shape, (8000, 16))
            self.assertEqual(raw["raw/light_b"].shape, (8000, 16))
            text = raw["config"][()].decode()
        self.assertEqual(tomllib.loads(text)["switching"]["interval_s"], 4)
        with h5py.File(self.out / "angles.h5") as angles:
            self.assertEqual({name: data.attrs["unit"] for name, data in angles["angles"].items()}, ANGLE_UNITS)
            self.assertEqual(angles["truth/dtheta_arcsec"].shape, (4000,))

    def test_h5dump_reads_them(self):
        for name, group in (("raw.h5", "/raw"), ("angles.h5", "/angles")):
            dump = subprocess.run(["h5dump", "-g", group, self.out / name], capture_output=True, text=True)
            self.assertEqual(dump.returncode, 0, dump.stderr)
            self.assertIn('"unit"', dump.stdout)


class SameBits(CliTest):
    def setUp(self):
        super().setUp()
        self.csv, self.h5 = self.folder / "raw.csv", self.folder / "raw.h5"
        self.succeed("simulate", *SHORT, "--out", self.csv)
        self.succeed("simulate", *SHORT, "--out", self.h5)

    def test_raw_logs(self):
        ours, theirs = columns(self.h5, "raw"), csv_columns(self.csv)
        self.assertEqual(set(ours), set(theirs))
        for name in ours:
            self.assertTrue((ours[name] == theirs[name]).all(), name)

    def test_processed_from_either_to_either(self):
        outs = []
        for raw in (self.csv, self.h5):
            for suffix in ("csv", "h5", "hdf5"):
                out = self.folder / f"{raw.suffix[1:]}-to.{suffix}"
                self.succeed("process", raw, "--out", out)
                outs.append(csv_columns(out) if suffix == "csv" else columns(out, "angles"))
        for other in outs[1:]:
            for name in outs[0]:
                self.assertTrue((outs[0][name] == other[name]).all(), name)

    def test_same_seed_gives_the_same_bytes(self):
        again = self.folder / "again.h5"
        time.sleep(1.1)  # a file that kept its time, in seconds, would differ
        self.succeed("simulate", *SHORT, "--out", again)
        self.assertEqual(again.read_bytes(), self.h5.read_bytes())


class Interrupted(CliTest):
    def kill_at_random(self, out):
        """The recording, killed after a random time; its rows so far."""
        writer = subprocess.Popen([ZLG, "simulate", "--duration", "30000", "--set", "switching.interval_s=4", "--out", out],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(self.random.uniform(0.0, 0.4))
        writer.send_signal(signal.SIGKILL)
        writer.wait()

    def rows_seen_by_a_reader(self, part):
        try:
            with h5py.File(part, "r", libver="latest", swmr=True) as file:
                return min(data.shape[0] for data in file["raw"].values())
        except (OSError, KeyError):
            return 0

    def test_killed_fifty_times(self):
        whole = self.folder / "whole.h5"
        self.succeed("simulate", "--duration", "600", "--set", "switching.interval_s=4", "--out", whole)
        expected = columns(whole, "raw")
        with_rows = 0
        for k in range(50):
            out = self.folder / f"killed-{k}.h5"
            part = self.folder / f"killed-{k}.h5.part"
            self.kill_at_random(out)
            self.assertFalse(out.exists())
            if not part.exists():
                continue
            before, seen = part.read_bytes(), self.rows_seen_by_a_reader(part)
            if seen > 0:
                with_rows += 1
                self.check_repair(part, seen, expected)
            else:
                self.assertIn(run("inspect", part, "--repair").returncode, (0, INPUT))
            self.assertEqual(part.read_bytes(), before, "the repair touched its input")
            for path in self.folder.glob("killed-*"):
                path.unlink()
            self.assertEqual([path.name for path in self.folder.iterdir()], ["whole.h5"], "something else was touched")
        self.assertGreater(with_rows, 10)

    def check_repair(self, part, seen, expected):
        clean = self.folder / "killed-clean.h5"
        found = json.loads(self.succeed("inspect", part, "--repair", "--out", clean, "--json").stdout)
        self.assertGreaterEqual(found["halves"], seen)
        self.assertIn("not closed", found["damage"])
        rows = columns(clean, "raw")
        n = min(len(expected["half"]), found["halves"])
        for name in expected:
            self.assertEqual(len(rows[name]), found["halves"], name)
            self.assertTrue((rows[name][:n] == expected[name][:n]).all(), name)
        self.assertEqual(run("inspect", clean).returncode, 0)
        self.succeed("process", clean, "--out", self.folder / "killed-angles.h5", "--force")

    def test_repair_finds_a_name_of_its_own(self):
        out = self.folder / "killed.h5"
        while not (self.folder / "killed.h5.part").exists() or not self.rows_seen_by_a_reader(self.folder / "killed.h5.part"):
            (self.folder / "killed.h5.part").unlink(missing_ok=True)
            self.kill_at_random(out)
        self.succeed("inspect", self.folder / "killed.h5.part", "--repair")
        self.assertEqual(run("inspect", self.folder / "killed.repaired.h5").returncode, 0)
        self.refuse(USAGE, "inspect", self.folder / "killed.h5.part", "--repair", "--out", out, "--force", says=["killed.h5"])
        self.assertTrue((self.folder / "killed.h5.part").exists())


class Failing(CliTest):
    @staticmethod
    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1_500_000, 1_500_000))

    def test_a_recording_that_cannot_go_on_is_left_and_named(self):
        for verb, out, part in (("simulate", "raw.h5", "raw.h5.part"), ("run", "folder", "folder/raw.h5.part")):
            result = self.refuse(INPUT, verb, "--duration", "600", "--out", self.folder / out, says=["raw.h5.part"],
                                 preexec_fn=self.small_files)
            self.assertIn("recorded until then", result.stderr)
            found = json.loads(run("inspect", self.folder / part, "--json").stdout)
            self.assertGreater(found["halves"], 1000)

    def test_a_disk_that_fills_up_at_the_very_end_loses_no_log(self):
        (self.folder / "run").mkdir()
        writer = subprocess.Popen([ZLG, "run", "--duration", "900", "--out", self.folder / "run"], stderr=subprocess.PIPE, text=True)
        part = self.folder / "run" / "raw.h5.part"
        wait_until((self.folder / "run" / "report.html.part").exists, writer)
        (self.folder / "run" / "summary.json").write_text("foreign")
        message = writer.communicate()[1]
        self.assertEqual(writer.returncode, INPUT, message)
        self.assertEqual((self.folder / "run" / "summary.json").read_text(), "foreign")
        self.assertEqual(sorted(os.listdir(self.folder / "run")), ["angles.h5.part", "raw.h5.part", "summary.json"])
        self.assertIn("raw.h5.part", message)
        self.assertEqual(json.loads(run("inspect", part, "--json").stdout)["halves"], 360_000)

    def test_a_refused_run_leaves_nothing_behind(self):
        for present in ("angles.h5", "report.html"):
            folder = self.folder / present.split(".")[0]
            folder.mkdir()
            (folder / present).write_text("precious")
            self.refuse(INPUT, "run", "--duration", "1", "--out", folder, says=[present, "--force"])
            self.assertEqual(os.listdir(folder), [present])

    def test_light_has_no_room_in_csv(self):
        self.refuse(USAGE, "simulate", "--light", "--out", self.folder / "raw.csv", says=["light"])

    def test_repair_of_nothing_is_an_error(self):
        bad = self.write("bad.csv", csv_text(quiet_log()).replace("\n0,", "\n7,", 1))
        self.refuse(INPUT, "inspect", bad, "--repair", says=["bad.csv", "half"])
        self.assertEqual(os.listdir(self.folder), ["bad.csv"])

    def test_an_unknown_key_is_damage_that_repair_leaves_out(self):
        strange = self.write("strange.csv", csv_text(quiet_log(), lines=["gyro.scale_arcsec = 2", "gyro.colour = 3"]))
        self.assertEqual(run("inspect", strange).returncode, 1)
        self.refuse(INPUT, "process", strange, "--out", self.folder / "a.h5", says=["colour"])
        self.succeed("inspect", strange, "--repair")
        found = json.loads(self.succeed("inspect", self.folder / "strange.repaired.csv", "--json").stdout)
        self.assertEqual((found["scale_arcsec"], found["halves"]), (2.0, 80))
