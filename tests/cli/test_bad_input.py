"""Every bad input is refused with the right exit code and one line, and leaves nothing behind."""

import os
import resource
import shutil
import signal

from support import SAID, ZLG, CliTest, complaints, csv_text, quiet_log, run, warnings

USAGE, INPUT = 2, 3


class BadInputTest(CliTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "angles.csv"

    def assert_nothing_left(self, before):
        after = {path.name for path in self.folder.iterdir()}
        self.assertEqual(after - before, set(), "files were left behind")

    def refuse_log(self, text, *says, options=(), codes=INPUT):
        raw = self.write("raw.csv", text)
        before = {path.name for path in self.folder.iterdir()}
        result = self.refuse(codes, "process", raw, "--out", self.out, *SAID, *options, says=says)
        self.assert_nothing_left(before)
        return result

    def refuse_call(self, codes, *arguments, says=(), **options):
        before = {path.name for path in self.folder.iterdir()}
        self.refuse(codes, *arguments, says=says, cwd=self.folder, **options)
        self.assert_nothing_left(before)

    def spoil(self, half, **changes):
        """A good log with other values in one row; a value may be any text."""
        lines = csv_text(quiet_log(20), facts=False).splitlines()
        names = lines[0].split(",")
        fields = lines[1 + half].split(",")
        for name, value in changes.items():
            fields[names.index(name)] = str(value)
        lines[1 + half] = ",".join(fields)
        return "\n".join(lines) + "\n"


class BadLogs(BadInputTest):
    """One of each kind: what a column allows is held by the tests of the readers."""

    def bad_logs(self):
        lines = csv_text(quiet_log(20), facts=False).splitlines(True)
        head, noise = lines[0], self.random.randbytes(5000)
        for column, value in (("counts", "12.5"), ("counts", "99999999999999999999"), ("bias_sign", "-1"), ("mode", "0"), ("loop_closed", "yes")):
            yield f"{column} is {value}", self.spoil(12, **{column: value}), (column, value, "14")
        yield "empty field", self.spoil(12, counts=""), ("counts",)
        yield "hole", "".join(lines[:9] + lines[10:]), ("half", "9")
        yield "row twice", "".join(lines[:10] + lines[9:]), ("half", "8")
        yield "does not begin at 0", "".join(lines[:1] + lines[3:]), ("half",)
        yield "too few fields", "".join([*lines[:12], "11,-1,1\n", *lines[13:]]), ()
        yield "too many fields", "".join([*lines[:12], lines[12].rstrip("\n") + ",7\n", *lines[13:]]), ()
        yield "cut in its last row", "".join(lines)[:-4], ()
        for column in head.strip().split(","):
            yield f"without {column}", csv_text(quiet_log(20), [name for name in head.strip().split(",") if name != column]), (column,)
        for wrong, meant in (("counst", "counts"), ("Mode", "mode")):
            yield wrong, "".join([head.replace(meant, wrong), *lines[1:]]), (wrong, meant)
        yield "misspelt optional column", csv_text([dict(row, valld=1) for row in quiet_log(20)], [*head.strip().split(","), "valld"]), ("valld", "valid")
        yield "column twice", csv_text(quiet_log(20), [*head.strip().split(","), "counts"]), ("counts",)
        for name, data in (("empty", ""), ("header only", head), ("noise", noise), ("false HDF5", b"\x89HDF\r\n\x1a\n" + noise),
                           ("UTF-16", "".join(lines).encode("utf-16"))):
            yield name, data, ()

    def test_is_refused_in_one_line(self):
        for name, text, says in self.bad_logs():
            with self.subTest(name):
                self.refuse_log(text, "raw.csv", *says)

    def test_motion_file_that_was_cut_in_its_last_number(self):
        for end, n in (("\n", 0), ("", 1)):
            path = self.write("motion.csv", "1.25\n" * 200 + "1.2" + end)
            result = self.succeed("simulate", "--set", "motion.kind=file", "--set", f"motion.path={path}", "--force",
                                  "--out", self.folder / "raw.csv")
            says = f"zlg: warning: {path}: the last line has no end; the file may have been cut off"
            self.assertEqual(warnings(result), [says] * n)


class BadFiles(BadInputTest):
    def test_file_that_cannot_be_read(self):
        self.refuse_call(INPUT, "process", "absent.csv", "--out", self.out, says=["absent.csv"])
        self.refuse_call(INPUT, "inspect", "absent.csv", says=["absent.csv"])
        (self.folder / "folder.csv").mkdir()
        self.refuse_call(INPUT, "process", "folder.csv", "--out", self.out, says=["folder.csv"])
        # A link to itself: even root cannot open it.
        (self.folder / "loop.csv").symlink_to("loop.csv")
        self.refuse_call(INPUT, "process", "loop.csv", "--out", self.out, says=["loop.csv"])

    def test_file_without_permission(self):
        self.write("locked.csv", csv_text(quiet_log(20))).chmod(0)
        somebody = {}
        if os.geteuid() == 0:
            # Root can read everything: the program is run as nobody, who can reach this copy of it.
            somebody = {"user": 65534, "group": 65534, "extra_groups": [], "executable": shutil.copy(ZLG, self.folder)}
            self.folder.chmod(0o777)
        self.refuse_call(INPUT, "process", "locked.csv", "--out", self.out, says=["locked.csv", "Permission denied"], **somebody)


class BadUsage(BadInputTest):
    def setUp(self):
        super().setUp()
        self.raw = self.write("raw.csv", csv_text(quiet_log(40, gap=range(10, 13))))
        self.process_call = ["process", self.raw, "--out", self.out]

    def test_verb_and_options(self):
        self.refuse_call(USAGE, "proces", self.raw, says=["proces"])
        self.assertEqual(run().returncode, USAGE, "a call without a verb")
        self.refuse_call(USAGE, *self.process_call, "--fast", says=["--fast"])
        self.refuse_call(USAGE, "process", "--out", self.out)
        self.refuse_call(USAGE, "process", self.raw)
        self.refuse_call(USAGE, *self.process_call, "--set")

    def test_unknown_suffix(self):
        for name in ("angles.txt", "angles", "angles.csv.gz"):
            with self.subTest(suffix=name):
                self.refuse_call(USAGE, "process", self.raw, "--out", self.folder / name)

    def test_unknown_key_names_the_nearest(self):
        cases = [("compensation", "bridg", "bridge"), ("gyro", "tick", "tick_s"), ("gyro", "scale_arcsecs", "scale_arcsec")]
        for section, name, nearest in cases:
            with self.subTest(key=name):
                self.refuse_call(USAGE, *self.process_call, "--set", f"{section}.{name}=1", says=[name, nearest])
        self.refuse_call(USAGE, *self.process_call, "--set", "compensaton.relock=none", says=["compensaton", "compensation"])
        file = self.write("bad.toml", "[compensation]\nbrigde = \"linear\"\n")
        self.refuse_call(USAGE, *self.process_call, "--config", file, says=["brigde", "bridge"])

    def test_value_out_of_range(self):
        cases = ["gyro.tick_s=nan", "gyro.tick_s=inf", "gyro.tick_s=0", "gyro.tick_s=-0.005", "gyro.scale_arcsec=nan",
                 "gyro.bias_hz=nan", "gyro.scale_arcsec=0", "gyro.bias_chi=nan", "compensation.bridge=cubicle", "compensation.relock=1",
                 "compensation.relock_ticks=-1", "compensation.extrapolation_points=2.5", "compensation.points_after=many",
                 "gyro.tick_s=true", "gyro.tick_s=[1]"]
        for case in cases:
            with self.subTest(setting=case):
                self.refuse_call(USAGE, *self.process_call, "--set", case, says=[case.split("=")[0].split(".")[1]])

    def test_set_without_a_value(self):
        for case in ("gyro.tick_s", "=5", "tick_s=0.005"):
            with self.subTest(setting=case):
                self.refuse_call(USAGE, *self.process_call, "--set", case)

    def test_configuration_file(self):
        self.refuse_call((USAGE, INPUT), *self.process_call, "--config", "absent.toml", says=["absent.toml"])
        file = self.write("broken.toml", "[gyro\ntick_s = \n")
        self.refuse_call(USAGE, *self.process_call, "--config", file, says=["broken.toml"])

    def test_bare_word_is_a_string_and_an_integer_is_a_real(self):
        self.succeed(*self.process_call, "--set", "compensation.relock=none", "--set", "gyro.bias_chi=4")

    def test_conflict_of_log_and_setting(self):
        for key, held, wanted in (("tick_s", "0.005", "0.01"), ("scale_arcsec", "3.263", "3.0")):
            log = csv_text(quiet_log(20), lines=[f"gyro.{key} = {held}"])
            with self.subTest(key=key):
                self.refuse_log(log, key, options=["--set", f"gyro.{key}={wanted}"], codes=USAGE)
                self.succeed(*self.process_call, "--set", f"gyro.{key}={held}", "--force")
                self.out.unlink()

    def test_relock_that_the_log_does_not_allow(self):
        for method in ("detuning", "mean_square"):
            with self.subTest(relock=method):
                self.refuse_call((USAGE, INPUT), *self.process_call, "--set", f"compensation.relock={method}", says=["detuning"])

    def test_integer_of_more_than_64_bits(self):
        for seed in ("9223372036854775808", "-9223372036854775809"):
            self.refuse_call(USAGE, "run", "--seed", seed, "--out", self.folder / "run",
                             says=["run.seed", seed, "an integer of more than 64 bits", "0..9223372036854775807"])
        for seed in ("12x", "010", "-1", "1.5", ""):
            self.refuse_call(USAGE, "run", f"--seed={seed}", "--out", self.folder / "run")

    def test_run_durations(self):
        for value in ("-1", "nan", "0", "long"):
            with self.subTest(duration=value):
                self.refuse_call(USAGE, "run", "--duration", value, "--out", self.folder / "run")


class BadOutput(BadInputTest):
    def setUp(self):
        super().setUp()
        self.raw = self.write("raw.csv", csv_text(quiet_log(4000)))

    def test_existing_output_needs_force(self):
        self.out.write_text("precious")
        self.refuse_call((USAGE, INPUT), "process", self.raw, "--out", self.out, says=["angles.csv", "--force"])
        self.assertEqual(self.out.read_text(), "precious")
        self.succeed("process", self.raw, "--out", self.out, "--force")
        self.assertNotEqual(self.out.read_text(), "precious")

    def test_error_with_force_keeps_the_old_output(self):
        self.out.write_text("precious")
        bad = self.write("bad.csv", self.spoil(39, counts="x"))
        self.refuse_call(INPUT, "process", bad, "--out", self.out, "--force", *SAID)
        self.assertEqual(self.out.read_text(), "precious")

    def test_input_is_never_the_output(self):
        before = self.raw.read_bytes()
        self.refuse_call((USAGE, INPUT), "process", self.raw, "--out", self.raw)
        self.refuse_call(USAGE, "process", self.raw, "--out", self.raw, "--force")
        self.assertEqual(self.raw.read_bytes(), before)

    def test_missing_parent_folder(self):
        self.refuse_call(INPUT, "process", self.raw, "--out", self.folder / "absent" / "a.csv", says=["absent"])
        self.refuse_call(INPUT, "simulate", "--duration", "1", "--out", self.folder / "absent" / "raw.csv", says=["absent"])
        self.refuse_call(INPUT, "run", "--duration", "1", "--out", self.folder / "absent" / "run", says=["absent"])

    def test_output_without_a_name(self):
        for call in (["run", "--duration", 1], ["simulate", "--duration", 1], ["process", self.raw, *SAID],
                     ["convert", self.raw], ["follow", self.raw]):
            self.refuse_call(USAGE, *call, "--out", "", says=["--out", "empty"])

    def test_output_that_is_a_folder(self):
        self.out.mkdir()
        self.refuse_call(INPUT, "process", self.raw, "--out", self.out, "--force", says=["angles.csv"])

    def full_disk(self):
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

    def test_full_disk(self):
        self.refuse_call(INPUT, "process", self.raw, "--out", self.out, says=["angles.csv"], preexec_fn=self.full_disk)
        self.refuse_call(INPUT, "run", "--duration", 20, "--format", "csv", "--out", self.folder / "run", preexec_fn=self.full_disk)

    def test_full_disk_keeps_the_old_output(self):
        self.out.write_text("precious")
        self.refuse_call(INPUT, "process", self.raw, "--out", self.out, "--force", preexec_fn=self.full_disk)
        self.assertEqual(self.out.read_text(), "precious")

    def test_full_standard_output(self):
        with open("/dev/full", "w") as full:
            result = run("inspect", self.raw, "--json", stdout=full)
        self.assertEqual(result.returncode, INPUT, "a result that cannot be written is an error")
        self.assertEqual(len(complaints(result)), 1, result.stderr)
