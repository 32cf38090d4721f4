"""What nobody sends in good faith: deep, endless and huge inputs, outputs that are inputs, control characters."""

import os
import random
import resource
import subprocess
import threading

from support import REQUIRED, CliTest, ZLG, csv_text, quiet_log, run, wait_until


DEEP = "x." * 30000 + "y"
FACTS = ["gyro.tick_s = 0.005", "gyro.scale_arcsec = 3.263"]


def processor_seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Hostile(CliTest):
    def refuse_quickly(self, codes, *arguments, says=(), **options):
        """One line, soon, and without a gigabyte."""
        before_s = processor_seconds_of_children()
        self.refuse(codes, *arguments, says=says, **options)
        self.assertLess(processor_seconds_of_children() - before_s, 10)

    def limited(self):
        """For a child: an address space of 1 GB."""
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))

    def log(self, name="log.csv", lines=FACTS):
        return self.write(name, csv_text(quiet_log(), lines=lines))


class Deep(Hostile):
    def test_a_configuration(self):
        for text in (f"{DEEP} = 1\n", f"[{DEEP}]\na = 1\n", f"[[{DEEP}]]\na = 1\n", "a = " + "[" * 30000,
                     "a = " + "{b = " * 30000, "a = {b = 1, " + DEEP + " = 1}\n"):
            path = self.write("deep.toml", text)
            for verb in (["design", path], ["run", path, "--out", self.folder / "run"],
                         ["process", self.log(), "--config", path, "--out", self.folder / "a.csv"]):
                self.refuse_quickly(2, *verb, says=["deep.toml", "64"], preexec_fn=self.limited)

    def test_an_option(self):
        for setting in (f"{DEEP}=1", f"gyro.{DEEP}=1", "gyro.tick_s=" + "[" * 30000, "gyro.tick_s={" + DEEP + "=1}"):
            result = run("design", "--set", setting, preexec_fn=self.limited)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr.count("\n"), 1)
            self.assertLess(len(result.stderr), 3000)

    def test_a_setting_of_a_csv_log(self):
        log = self.log(lines=[*FACTS, f"{DEEP} = 1"])
        for verb in (["convert", log, "--out", self.folder / "a.h5"], ["process", log, "--out", self.folder / "a.csv"],
                     ["inspect", log]):
            self.refuse_quickly(3, *verb, says=["log.csv", "64"], preexec_fn=self.limited)
        self.assertEqual(sorted(os.listdir(self.folder)), ["log.csv"])

    def test_the_configuration_of_an_hdf5_log(self):
        # As long as the one that is written first, so that it can be put in its place.
        flat = f"x.y = [{'1, ' * 20000}1]"
        self.succeed("convert", self.log(lines=[*FACTS, flat]), "--out", self.folder / "a.h5")
        bytes_before = (self.folder / "a.h5").read_bytes()
        self.assertEqual(bytes_before.count(flat.encode()), 1)
        deep = ("x." * 30000 + "y=1#").encode()
        deep += b"#" * (len(flat) - len(deep))
        self.write("b.h5", bytes_before.replace(flat.encode(), deep))
        for verb in (["inspect"], ["process", "--out", self.folder / "c.csv"], ["convert", "--out", self.folder / "c.h5"]):
            self.refuse_quickly(3, verb[0], self.folder / "b.h5", *verb[1:], says=["b.h5", "64"], preexec_fn=self.limited)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.h5", "b.h5", "log.csv"])


class Endless(Hostile):
    def test_a_configuration(self):
        self.refuse_quickly(3, "run", "/dev/zero", "--out", self.folder / "run", says=["/dev/zero"],
                            preexec_fn=self.limited)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_motion_file(self):
        self.refuse_quickly(3, "simulate", "--duration", 1, "--set", "motion.kind=file", "--set",
                            "motion.path=/dev/zero", "--out", self.folder / "a.csv", says=["/dev/zero"],
                            preexec_fn=self.limited)
        self.assertEqual(os.listdir(self.folder), [])

    def feed(self, path, text):
        def write():
            try:
                with open(path, "w") as pipe:
                    while True:
                        pipe.write(text)
            except BrokenPipeError:
                pass
        os.mkfifo(path)
        threading.Thread(target=write, daemon=True).start()
        return path

    def test_a_pipe(self):
        self.refuse_quickly(3, "design", self.feed(self.folder / "pipe", "# no end\n" * 1000), says=["pipe"],
                            preexec_fn=self.limited)
        motion = self.feed(self.folder / "motion", "1\n" * 100000)
        self.refuse_quickly(3, "simulate", "--duration", 1, "--set", "motion.kind=file", "--set", f"motion.path={motion}",
                            "--out", self.folder / "a.csv", says=["motion", "no regular file"], preexec_fn=self.limited)

    def test_a_pipe_that_ends_is_a_configuration_like_any_other(self):
        path = self.folder / "pipe"
        os.mkfifo(path)
        threading.Thread(target=lambda: path.write_text("[run]\nduration_s = 2\n"), daemon=True).start()
        self.succeed("simulate", path, "--out", self.folder / "a.csv")
        self.assertEqual(len((self.folder / "a.csv").read_text().split("\n800,")), 1)

    def test_many_settings_of_a_log_cost_no_minutes(self):
        for line in ("# a b", "# lab.note = 1", "# gyro.tick_s = 0.005"):
            log = self.write("many.csv", f"{line}\n" * 500_000 + csv_text(quiet_log(), lines=FACTS))
            before_s = processor_seconds_of_children()
            self.succeed("inspect", log)
            self.assertLess(processor_seconds_of_children() - before_s, 15, line)


class OwnInput(Hostile):
    MOTION = "".join(f"{k % 7}\n" for k in range(500))

    def other_names(self, path):
        """The file itself, a symbolic link to it, a hard link."""
        symbolic, hard = path.with_name(f"symbolic{path.suffix}"), path.with_name(f"hard{path.suffix}")
        symbolic.symlink_to(path)
        os.link(path, hard)
        return [path, symbolic, hard]

    def refuse_output(self, path, text, *arguments):
        self.refuse(2, *arguments, "--force", says=["input"])
        self.assertEqual(path.read_text(), text)

    def test_the_motion_file(self):
        path = self.write("motion.csv", self.MOTION)
        motion = ["--set", "motion.kind=file", "--set", f"motion.path={path}"]
        for name in self.other_names(path):
            self.refuse_output(path, self.MOTION, "simulate", *motion, "--out", name)
            self.refuse_output(path, self.MOTION, "simulate", *motion, "--out", self.folder / "raw.csv", "--wire", name)
        folder = self.folder / "run"
        folder.mkdir()
        for name in ("health.csv", "raw.csv", "switches.csv", "raw.csv.part"):
            path = self.write(f"run/{name}", self.MOTION)
            self.refuse_output(path, self.MOTION, "run", "--format", "csv", "--set", "motion.kind=file", "--set",
                               f"motion.path={path}", "--out", folder)
            self.assertEqual(os.listdir(folder), [name])
            path.unlink()

    def test_the_configuration(self):
        text = "[run]\nduration_s = 1\n"
        path = self.write("c.toml", text)
        for name in self.other_names(path):
            self.refuse_output(path, text, "calibrate", "--from-laser", "--config", path, "--out", name)
        for verb, name in (("simulate", "c.csv"), ("design", "c.html")):
            path = self.write(name, text)
            self.refuse_output(path, text, verb, path, "--out", path)
        folder = self.folder / "run"
        folder.mkdir()
        path = self.write("run/summary.json", text)
        self.refuse_output(path, text, "run", path, "--out", folder)

    def test_the_configuration_beside_a_log(self):
        log = self.log()
        text = "[compensation]\nrelock = \"none\"\n"
        path = self.write("c.csv", text)
        self.refuse_output(path, text, "process", log, "--config", path, "--out", path)

    def test_another_output_is_written(self):
        path = self.write("motion.csv", self.MOTION)
        self.write("raw.csv", "old\n")
        self.succeed("simulate", "--set", "motion.kind=file", "--set", f"motion.path={path}", "--out",
                     self.folder / "raw.csv", "--force")
        self.assertEqual(path.read_text(), self.MOTION)


class ControlCharacters(Hostile):
    """A terminal gets none of the sender's."""

    BAD = "a\x1b[31mb\x7f\x85"

    def refuse_shown(self, *arguments):
        result = subprocess.run([str(ZLG), *map(str, arguments)], capture_output=True, stdin=subprocess.DEVNULL, timeout=60)
        self.assertIn(result.returncode, (1, 2, 3), result.stderr)
        self.shown(result.stderr)
        self.shown(result.stdout)
        self.assertEqual(result.stderr.count(b"\n"), 1, result.stderr)

    def shown(self, text):
        for letter in text.decode("utf-8"):
            self.assertFalse(ord(letter) < 32 and letter != "\n" or 127 <= ord(letter) < 160, repr(text))

    def test_in_keys_and_values(self):
        head = csv_text(quiet_log(), lines=FACTS)
        self.refuse_shown("process", self.write("key.csv", f"# gyro.{self.BAD} = 1\n{head}"), "--out", self.folder / "a.csv")
        self.refuse_shown("process", self.write("column.csv", head.replace("counts", f"cou{self.BAD}nts")), "--out",
                          self.folder / "a.csv")
        self.refuse_shown("process", self.write("cell.csv", head.replace("\n3,", f"\n{self.BAD},")), "--out",
                          self.folder / "a.csv")
        self.refuse_shown("design", self.write("a.toml", f"[gyro]\n'{self.BAD}' = 1\n"))
        self.refuse_shown("design", "--set", f"gyro.{self.BAD}=1")
        self.refuse_shown("design", "--set", f"gyro.fidelity={self.BAD}")
        motion = self.write("motion", f"1\n{self.BAD}\n")
        self.refuse_shown("simulate", "--set", "motion.kind=file", "--set", f"motion.path={motion}", "--duration", 1,
                          "--out", self.folder / "a.csv")
        result = subprocess.run([str(ZLG), "inspect", self.write("b.csv", f"# gyro.tick_s = {self.BAD}\n{head}")],
                                capture_output=True)
        self.assertEqual(result.returncode, 1)
        self.shown(result.stdout)

    def test_in_names_of_files(self):
        for name in ("a\nb", "a\x1b[31mb", "a\rb", b"a\xffb"):
            name = os.path.join(os.fsencode(self.folder), os.fsencode(name))
            result = subprocess.run([str(ZLG), "run", name], capture_output=True)
            self.shown(result.stderr)
            self.assertEqual(result.stderr.count(b"\n"), 1, result.stderr)
            out = name + b".csv"
            result = subprocess.run([str(ZLG), "simulate", "--duration", "1", "--out", out], capture_output=True, check=True)
            self.shown(result.stdout)
            self.assertEqual(result.stdout.count(b"\n"), 1, result.stdout)


class Messages(Hostile):
    def test_a_note_is_no_second_line_of_an_error(self):
        self.refuse(2, "simulate", "--duration", 1, "--set", "gyro.fidelity=laser", "--set", "gyro.bias_hz=38000", "--set",
                    "laser.gain_loss_ratio=50", "--out", self.folder / "a.csv", says=["laser.gain_loss_ratio"])
        self.refuse(3, "run", "--duration", 1, "--set", "switching.interval_s=optimal", "--out", self.folder / "no" / "a")
        result = self.succeed("simulate", "--duration", 1, "--set", "switching.interval_s=optimal", "--out",
                              self.folder / "a.csv")
        self.assertIn("optimal", result.stderr)

    def test_who_lost_a_race_names_no_recording_of_the_winner(self):
        out = self.folder / "a.h5"
        arguments = [str(ZLG), "simulate", "--out", str(out), "--force", "--duration"]
        first = subprocess.Popen([*arguments, "20000"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        part = self.folder / "a.h5.part"
        wait_until(part.exists, first)
        second = subprocess.run([*arguments, "100"], capture_output=True, text=True)
        lost = first.communicate()[1]
        self.assertEqual((first.returncode, second.returncode), (3, 0), lost + second.stderr)
        self.assertIn("another program", lost)
        self.assertNotIn("recorded until then", lost)

    def test_no_empty_folder_stays(self):
        for most in range(3, 12):
            out = self.folder / f"run{most}"
            result = run("run", "--duration", 1, "--out", out, preexec_fn=lambda: self.files(most))
            if result.returncode == 0:
                break
            if result.returncode == 127:  # not even its libraries
                continue
            self.assertEqual((result.returncode, out.exists()), (3, False), f"{most} files: {result.stderr}")
        self.assertGreater(most, 5)

    def files(self, most):
        import resource
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))

    def test_the_repair_of_an_angle_log_sends_nobody_to_a_raw_log_that_is_not_there(self):
        self.succeed("process", self.log(), "--out", self.folder / "a.h5")
        self.refuse(2, "inspect", self.folder / "a.h5", "--repair", says=["zlg convert", "a.h5"])

    def test_what_was_not_measured_is_an_empty_field(self):
        out = self.folder / "run"
        self.succeed("run", "--duration", 1, "--set", "switching.interval_s=0.3", "--out", out)
        lines = (out / "switches.csv").read_text().splitlines()
        self.assertGreater(len(lines), 2)
        self.assertNotIn("nan", "\n".join(lines))
        self.assertTrue(any(",," in line or line.endswith(",") for line in lines[1:]), lines)
        for line in lines[1:]:
            self.assertEqual(line.count(","), lines[0].count(","))


class OneLine(Hostile):
    def test_an_error_after_a_warning_is_alone(self):
        lines = csv_text(quiet_log(), lines=FACTS).splitlines()
        head = next(k for k, line in enumerate(lines) if not line.startswith("#"))
        lines = [*lines[:head], lines[head] + ",colour", *(line + ",1" for line in lines[head + 1:])]
        good = self.write("good.csv", "\n".join(lines) + "\n")
        bad = self.write("bad.csv", "\n".join(lines[:-1]) + "\nnonsense\n")
        for verb in (["process"], ["convert"]):
            self.assertIn("colour", self.succeed(*verb, good, "--out", self.folder / "good.h5", "--force").stderr)
            result = run(*verb, bad, "--out", self.folder / "bad.h5")
            self.assertEqual(result.returncode, 3)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn("bad.csv:83", result.stderr)


class Cost(Hostile):
    def test_a_run_that_no_disk_holds(self):
        for arguments in (["run", "--duration", 1e9, "--out", self.folder / "run"],
                          ["run", "--duration", 1e9, "--format", "csv", "--out", self.folder / "run"],
                          ["run", "--duration", 1e6, "--set", "gyro.tick_s=1e-6", "--set", "gyro.bias_edge_s=1e-8", "--out",
                           self.folder / "run"],
                          ["simulate", "--duration", 1e9, "--out", self.folder / "a.h5"],
                          ["simulate", "--duration", 1e9, "--out", self.folder / "a.csv", "--wire", self.folder / "a"]):
            self.refuse_quickly(3, *arguments, says=["disk", "run.duration_s", "B"])
        self.assertEqual(os.listdir(self.folder), [])

    def test_short_work_says_nothing(self):
        result = self.succeed("simulate", "--duration", 1000, "--out", self.folder / "a.h5")
        self.assertEqual(result.stderr, "")

    def test_a_design_with_a_tiny_limit(self):
        for more in ([], ["--set", "piezo.rc_s=1e-5", "--set", "perimeter.tau_s=1e-5"],
                     ["--set", "perimeter.loop=digital", "--set", "switching.schedule=measured", "--set",
                      "switching.interval_min_s=1e6", "--set", "switching.interval_max_s=1e7"]):
            before = processor_seconds_of_children()
            self.succeed("design", "--json", "--set", "perimeter.limit_lambda=1e-5", *more)
            self.assertLess(processor_seconds_of_children() - before, 10, more)


class Sizes(Hostile):
    """Numbers that nobody measures: each is refused with its file, its row and the reason, or shown whole."""

    TEXT = ["--map", "axis=1", "--map", "time=none", "--map", "rate_hz=10"]

    def test_of_samples(self):
        for holds in ("rate", "increment", "angle"):
            said = [*self.TEXT, "--map", f"holds={holds}", "--map", "unit=arcsec/s" if holds == "rate" else "unit=arcsec"]
            for value in ("1e308", "1e200"):
                path = self.write("large.txt", "".join(f"{k % 7}\n" for k in range(300)) + f"{value}\n" + "1\n2\n")
                self.refuse_quickly(3, "analyze", path, *said, says=["large.txt", "row 301", "1e90"])
            path = self.write("small.txt", "".join(f"{k * k % 7}e-200\n" for k in range(300)))
            self.refuse_quickly(3, "analyze", path, *said, says=["small.txt", "differ by", "too small"])

    def test_of_a_rate_of_rows(self):
        path = self.write("rows.txt", "".join(f"{k * k % 7}\n" for k in range(300)))
        for rate in ("1e300", "1e-300", "1e100", "1e-100", "1e13", "1e-13"):
            self.refuse_quickly(3, "analyze", path, "--map", "axis=1", "--map", "time=none", "--map", "holds=rate", "--map", "unit=deg/s",
                                "--map", f"rate_hz={rate}", says=["rows.txt", "samples a second", "1e-12..1e+12"])

    def test_whose_fourth_powers_a_number_holds(self):
        generator = random.Random(3)
        for scale, rate in ((1e28, 1e-12), (1e-28, 1e12), (1e17, 1e12), (1e-17, 1e-12)):
            path = self.write("rows.txt", "".join(f"{scale * generator.gauss(0.0, 1.0):.9g}\n" for k in range(300)))
            for holds in ("rate", "increment", "angle"):
                result = run("analyze", path, *self.TEXT, "--map", f"holds={holds}", "--map", f"rate_hz={rate}", "--map",
                             "unit=arcsec/s" if holds == "rate" else "unit=arcsec")
                self.assertIn(result.returncode, (0, 3), result.stderr)
                self.assertNotIn("boost", result.stderr)
        path = self.write("rows.txt", "".join(f"{1e-60 * generator.gauss(0.0, 1.0):.9g}\n" for k in range(300)))
        self.refuse_quickly(3, "analyze", path, *self.TEXT, "--map", "holds=rate", "--map", "unit=arcsec/s", says=["differ by", "1e-30"])

    def test_of_faults(self):
        def faults(n, at_s, duration_s):
            lists = {"kind": ['"light_noisy"'] * n, "at_s": map(repr, at_s), "duration_s": [repr(duration_s)] * n, "size": ["0"] * n}
            return self.write("faults.toml", "[faults]\n" + "".join(f"{k} = [{', '.join(v)}]\n" for k, v in lists.items()))

        log = ["--duration", 2, "--out", self.folder / "a.csv", "--force"]
        for n in (101, 1000, 10_000):
            config = faults(n, [1.0 + 1e-5 * k for k in range(n)], 3.0)
            self.refuse_quickly(2, "simulate", config, *log, says=["more than 100 act at once at 1.00"])
        self.refuse_quickly(2, "simulate", "--set", "faults.random_per_hour=1e6", *log, says=["more than 100 act at once"])
        for n, apart in ((100, 1e-5), (20_000, -1e-4)):
            config = faults(n, [2.0 + apart * k for k in range(n)] if apart < 0 else [0.1 + apart * k for k in range(n)],
                            1e-5 if apart < 0 else 3.0)
            before_s = processor_seconds_of_children()
            self.succeed("simulate", config, *log)
            self.assertLess(processor_seconds_of_children() - before_s, 5)

    def test_of_names(self):
        long = self.folder / ("a" * 300)
        loop = self.folder / "loop"
        loop.symlink_to(loop)
        raw = self.log()
        for path in (long, loop / "a"):
            self.refuse_quickly(3, "process", raw, "--out", self.folder / "a.csv", "--switches", f"{path}.csv", says=["cannot look up"])
            self.refuse_quickly((2, 3), "simulate", "--duration", 1, "--set", "motion.kind=file", "--set", f"motion.path={path}", "--out",
                                self.folder / "a.csv", says=[str(path.name)[:20]])

    def test_of_the_angle_leave_a_blank_between_columns(self):
        result = run("run", "--duration", "20", "--set", "motion.kind=rest", "--out", self.folder / "run",
                     "--set", "drift.random_walk_arcsec_sqrt_s=1e5", "--set", "switching.interval_s=3")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = [row.split() for row in result.stdout.splitlines() if row.startswith(("switching", "relock_", "bridge_", "configured"))
                and not row.endswith(",")]
        self.assertGreater(len(rows), 2, result.stdout)
        for row in rows:
            self.assertEqual(len(row), 8, row)
