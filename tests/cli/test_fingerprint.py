"""The fingerprint of a run in everything that `zlg run` writes, and in what `zlg inspect` says of a log."""

import json
import re
import shutil
import unittest

import h5py

from support import CliTest, csv_text, folder_until, quiet_log, run

SHORT = ["--duration", 15, "--set", "switching.interval_s=4", "--quiet"]
SHARED = {}


def setUpModule():
    """One run in each format serves every test here."""
    folder = folder_until(unittest.addModuleCleanup)
    CliTest.setUpClass()
    for form in ("csv", "h5"):
        result = run("run", *SHORT, "--out", folder / form, "--format", form)
        if result.returncode != 0:
            raise AssertionError(f"zlg run fails: exit {result.returncode}, {result.stderr}")
        SHARED[form] = folder / form
        SHARED[f"text of {form}"] = result.stdout
    SHARED["digits"] = fingerprint_of(folder / "h5")


def fingerprint_of(folder):
    return json.loads((folder / "summary.json").read_text())["fingerprint"]


class FingerprintTest(CliTest):
    def run_again(self, *arguments):
        out = self.folder / "again"
        self.succeed("run", *SHORT, "--out", out, "--force", *arguments)
        return fingerprint_of(out)

    def inspected(self, log, code=0):
        """The fingerprint by `inspect --json`, after a look whether its text says the same."""
        found = run("inspect", log, "--json")
        self.assertEqual(found.returncode, code, found.stderr)
        digits = json.loads(found.stdout)["fingerprint"]
        lines = [line for line in run("inspect", log).stdout.splitlines() if line.startswith("fingerprint")]
        self.assertEqual(lines, [] if digits is None else [f"{'fingerprint':<18} {digits}"])
        return digits


class Faces(FingerprintTest):
    def test_is_16_digits_in_every_file_and_in_the_text(self):
        digits = SHARED["digits"]
        self.assertRegex(digits, "^[0-9a-f]{16}$")
        for form in ("csv", "h5"):
            out = SHARED[form]
            self.assertEqual(fingerprint_of(out), digits)
            self.assertEqual(SHARED[f"text of {form}"].splitlines()[-3], f"fingerprint of the run: {digits}")
            last_section = (out / "report.html").read_text().split("How this page was made")[-1]
            self.assertEqual(re.findall(r"Fingerprint of the run: (\w+)\.", last_section), [digits])
            self.assertEqual(self.inspected(out / f"raw.{form}"), digits)
            self.assertEqual(self.inspected(out / f"angles.{form}"), digits)

    def test_is_where_the_document_says(self):
        digits = SHARED["digits"]
        for name in ("raw", "angles"):
            with h5py.File(SHARED["h5"] / f"{name}.h5") as log:
                self.assertEqual(log["fingerprint"][()].decode(), digits)
                self.assertEqual(log["fingerprint"].dtype.itemsize, 16)
            with open(SHARED["csv"] / f"{name}.csv") as log:
                self.assertEqual(log.readline(), f"# fingerprint = {digits}\n")

    def test_is_no_setting(self):
        for form in ("csv", "h5"):
            out = self.folder / f"angles.{form}"
            self.succeed("process", SHARED[form] / f"raw.{form}", "--out", out)
            self.assertNotIn(b"fingerprint", out.read_bytes())
        with_line = json.loads(self.succeed("inspect", SHARED["csv"] / "raw.csv", "--json").stdout)["settings"]
        lines = re.findall(r"(?m)^# .* = ", (SHARED["csv"] / "raw.csv").read_text())
        self.assertEqual(with_line, len(lines) - 2)  # that of the version is none either


class Equal(FingerprintTest):
    def test_threads_and_kept_logs_do_not_matter(self):
        for arguments in (["--threads", 1], ["--threads", 2], ["--logs", "none"], ["--logs", "angles"],
                          ["--logs", "angles", "--format", "csv"], ["--logs", "none", "--format", "csv"], ["--light"]):
            self.assertEqual(self.run_again(*arguments), SHARED["digits"], arguments)

    def test_another_seed_another_motion_and_another_compensation_are_other_runs(self):
        others = [self.run_again(*arguments, "--logs", "none")
                  for arguments in (["--seed", 2], ["--set", "motion.kind=rest"], ["--set", "compensation.bridge=linear"])]
        self.assertEqual(len({SHARED["digits"], *others}), 4)


class OtherLogs(FingerprintTest):
    def test_a_copy_has_it_in_either_format(self):
        for form, other in (("csv", "h5"), ("h5", "csv")):
            for name in ("raw", "angles"):
                copy, back = self.folder / f"{name}.{other}", self.folder / f"back_{name}.{form}"
                self.succeed("convert", SHARED[form] / f"{name}.{form}", "--out", copy, "--force")
                self.assertEqual(self.inspected(copy), SHARED["digits"])
                self.succeed("convert", copy, "--out", back, "--force")
                self.assertEqual(self.inspected(back), SHARED["digits"])
        self.assertEqual((self.folder / "back_raw.csv").read_bytes(), (SHARED["csv"] / "raw.csv").read_bytes())

    def test_what_is_no_run_has_none(self):
        for form in ("csv", "h5"):
            simulated = self.folder / f"simulated.{form}"
            self.succeed("simulate", "--duration", 5, "--out", simulated)
            self.assertIsNone(self.inspected(simulated))
            processed = self.folder / f"processed.{form}"
            self.succeed("process", SHARED[form] / f"raw.{form}", "--out", processed)
            self.assertIsNone(self.inspected(processed))
            repaired = self.folder / f"repaired.{form}"
            self.succeed("inspect", SHARED[form] / f"raw.{form}", "--repair", "--out", repaired)
            self.assertIsNone(self.inspected(repaired))
            copy = self.folder / f"copy.{form}"
            self.succeed("convert", simulated, "--out", copy)
            self.assertIsNone(self.inspected(copy))


class Versions(FingerprintTest):
    def version_of(self, log):
        found = json.loads(self.succeed("inspect", log, "--json").stdout)["format_version"]
        lines = [line for line in self.succeed("inspect", log).stdout.splitlines() if line.startswith("format_version")]
        self.assertEqual(lines, [] if found is None else [f"{'format_version':<18} {found}"])
        return found

    def test_a_log_of_a_run_says_3_and_one_without_the_line_says_none(self):
        for form in ("csv", "h5"):
            for name in ("raw", "angles"):
                self.assertEqual(self.version_of(SHARED[form] / f"{name}.{form}"), 3)
        self.assertIsNone(self.version_of(self.write("raw.csv", csv_text(quiet_log()))))

    def test_a_copy_and_a_repaired_log_have_that_of_their_source(self):
        for version in (1, 2, 3):
            log = self.copy_of_version(version)
            for form, back_to in (("csv", "h5"), ("h5", "csv")):
                copy, back = self.folder / f"copy.{form}", self.folder / f"back.{back_to}"
                self.succeed("convert", log, "--out", copy, "--force")
                self.succeed("convert", copy, "--out", back, "--force")
                repaired = self.folder / f"repaired.{form}"
                self.succeed("inspect", copy, "--repair", "--out", repaired, "--force")
                self.assertEqual([self.version_of(each) for each in (log, copy, back, repaired)], [version] * 4)
        unknown = self.write("unknown.csv", csv_text(quiet_log()))
        self.succeed("convert", unknown, "--out", self.folder / "unknown.h5")
        self.assertIsNone(self.version_of(self.folder / "unknown.h5"))

    def copy_of_version(self, version):
        log = self.folder / "raw.h5"
        shutil.copy(SHARED["h5"] / "raw.h5", log)
        with h5py.File(log, "r+") as file:
            self.assertEqual(file.attrs["format_version"], 3)
            file.attrs["format_version"] = version
        return log

    def test_logs_of_versions_before_are_read_and_those_of_4_refused(self):
        for version in (1, 2):
            self.inspected(self.copy_of_version(version))
        for version in (0, 4):
            refused = run("inspect", self.copy_of_version(version))
            self.assertEqual(refused.returncode, 3)
            self.assertIn(f"format_version is {version}; allowed is 1 to 3", refused.stderr)
