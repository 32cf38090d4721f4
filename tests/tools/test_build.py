"""Claims about the build and its scripts: on a machine that lacks packages, and on others than the one they were written on."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def files_of_cmake():
    """Not asked of git, which a bare machine lacks."""
    return [path for pattern in ("CMakeLists.txt", "*.cmake") for path in sorted(ROOT.rglob(pattern))
            if path.relative_to(ROOT).parts[0] != "build"]


class Configuration(unittest.TestCase):
    def test_no_absence_of_a_header_is_remembered(self):
        # CMake's check_* commands keep their first answer for ever; find_* look again until they find.
        self.assertTrue(files_of_cmake())
        for path in files_of_cmake():
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertIsNone(re.search(r"^\s*check_\w+\(", path.read_text(encoding="utf-8"), re.M))


class Version(unittest.TestCase):
    def test_every_place_names_the_version_that_is_built(self):
        read = lambda name: (ROOT / name).read_text(encoding="utf-8")
        built = re.search(r"project\(zlg VERSION ([0-9.]+)", read("CMakeLists.txt"))[1]
        cited = re.search(r"^version: (\S+)\ndate-released: (\S+)$", read("CITATION.cff"), re.M)
        # A section of what is not released yet may stand above.
        released = re.search(r"^## ([0-9.]+) \((\d{4}-\d\d-\d\d)\)$", read("CHANGELOG.md"), re.M)
        self.assertEqual(cited.groups(), released.groups())
        self.assertEqual(cited[1], built)
        asked = re.findall(r"find_package\(zlg (\S+)", "".join(read(name) for name in (
            "docs/installing.md", "examples/embed_core/CMakeLists.txt", "examples/own_gyro/CMakeLists.txt")))
        self.assertEqual(asked, 3 * [built.rpartition(".")[0]])


class Workflows(unittest.TestCase):
    def test_they_call_scripts_that_are_there(self):
        called = [re.findall(r"^ *- run: (scripts/\w+(?: \w+)?)", text, re.M) for text in self.texts()]
        self.assertEqual(called, [["scripts/test deep"], ["scripts/lab", "scripts/site"], ["scripts/run", "scripts/test"]])

    def texts(self, left_out=""):
        return [path.read_text(encoding="utf-8") for path in sorted((ROOT / ".github" / "workflows").iterdir()) if path.name != left_out]

    def test_they_may_only_read_and_end_in_time(self):
        for text in self.texts():
            self.assertIn("\npermissions:\n  contents: read\n", text)
            self.assertEqual(len(re.findall(r"^    runs-on:", text, re.M)), len(re.findall(r"^    timeout-minutes: \d+$", text, re.M)))

    def test_they_run_on_every_system_that_the_readme_names(self):
        texts = self.texts(left_out="site.yml")
        systems = [set(re.findall(r'"(\w+):[0-9.]+"', text)) for text in texts]
        self.assertEqual(systems, [{"debian"}, {"debian", "ubuntu"}])
        for text in texts:
            self.assertLessEqual({"debian:12", "debian:13"}, set(re.findall(r'"(\w+:[0-9.]+)"', text)))


class Warnings(unittest.TestCase):
    def test_they_are_errors_in_the_preset_dev_alone(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        given = {preset["name"]: preset.get("cacheVariables", {}).get("ZLG_WERROR") for preset in presets}
        self.assertEqual({name: value for name, value in given.items() if value}, {"base": "$env{ZLG_WERROR}", "dev": "ON"})


class Tools(unittest.TestCase):
    """One name serves on every system: that of the package without a version."""

    def test_none_is_named_with_its_version(self):
        versioned = re.compile(r"\b(?:clang(?:\+\+)?|clang-format|(?:run-)?clang-tidy|lld|wasm-ld|llvm(?:-ar|-ranlib)?|libc\+\+(?:abi)?|libclang-rt|"
                               r"g\+\+|gcc|python3)[-.](?:\d\d?)\b")
        files = [ROOT / "CMakePresets.json", *files_of_cmake()]
        files += [path for folder in ("scripts", "bench", "tools", "tests/targets", "tests/lab", "tests/browser") for path in sorted((ROOT / folder).iterdir())
                  if path.is_file()]
        self.assertGreater(len(files), 60)
        for path in files:
            with self.subTest(str(path.relative_to(ROOT))):
                named = set(versioned.findall(path.read_text(encoding="utf-8", errors="replace")))
                # One version decides on the format.
                self.assertLessEqual(named, {"clang-format-14"} if path.name == "test" else set())


def packages():
    """Every package that scripts/install may ask for, whatever the system, by the sets' names."""
    text = (ROOT / "scripts" / "install").read_text(encoding="utf-8")
    return {name: [word for word in words.split() if not word.startswith("$")]
            for name, words in re.findall(r'^(\w+)_packages="([^"]*)"$', text, re.M)}


class Packages(unittest.TestCase):
    def policy(self, *names):
        command = ["apt-cache", "policy", *names]
        return subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout

    @unittest.skipUnless(shutil.which("apt-cache"), "the index of packages is not on this machine")
    def test_the_system_has_them_all(self):
        self.assertLessEqual({"build", "test", "deep", "wasm", "tidy"}, set(packages()))
        wanted = sorted({name for names in packages().values() for name in names})
        if "Packages" not in self.policy():
            self.skipTest("the index of packages is not on this machine")
        said = self.policy(*wanted)
        known = set(re.findall(r"^(\S+):\n  Installed: .*\n  Candidate: (?!\(none\))", said, re.M))
        self.assertEqual(set(wanted) - known, set())


class OldBash(unittest.TestCase):
    """macOS has bash 3.2: there scripts/install and scripts/run say at least what is needed."""

    # What it does not know, or ends a script for: `set -u` takes an empty array for a variable that was never set.
    UNKNOWN = [r"\b(?:declare|local|typeset) -\w*[nAg]", r"\b(?:mapfile|readarray|coproc)\b", r"\bEPOCH\w+", r"\$\{\w+(?:\^|,|@)", r"\[[@*]\]",
               r"\bwait -n", r"&>>", r"\|&", r";;?&", r"\[\[? -v ", r"\+=\(", r"=\(", r"\bprintf '%\(", r"\bglobstar\b", r"\bnproc\)"]

    def test_they_need_nothing_newer(self):
        for name in ("install", "run", "compiler_cache"):
            text = (ROOT / "scripts" / name).read_text(encoding="utf-8")
            for unknown in self.UNKNOWN:
                self.assertIsNone(re.search(unknown, text), f"scripts/{name}: {unknown}")

    def test_the_constructs_are_found_where_they_are(self):
        text = "declare -n a=b\nmapfile -t lines\n$EPOCHREALTIME ${a^^} ${a[@]}\nwait -n\nx &>>y |& z\na+=(b)\nb=()\n-j $(nproc)\n"
        found = [unknown for unknown in self.UNKNOWN if re.search(unknown, text)]
        self.assertEqual(len(found), 11)


class WithoutApt(unittest.TestCase):
    """The list in plain words, and exit 1 where a tool is missing."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        for tool in ("bash", "env", "dirname", "sed", "paste", "grep", "id"):
            (self.path / tool).symlink_to(shutil.which(tool))

    def said(self, script, *arguments):
        done = subprocess.run([ROOT / "scripts" / script, *arguments], capture_output=True, text=True, check=False, env={"PATH": str(self.path)})
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        needed, absent = done.stderr.splitlines()
        self.assertRegex(needed, r"^scripts/install: there is no apt here; needed are, with their headers: [a-z0-9+ .-]+$")
        return needed.split(": ")[-1].split(), absent

    def test_what_a_build_needs(self):
        needed, absent = self.said("install", "build")
        self.assertEqual(needed, "g++ cmake ninja make fmt cli11 tomlplusplus nlohmann-json3 fast-float boost hdf5 eigen3 zlib1g lz4 zstd xxhash".split())
        self.assertEqual(absent, "scripts/install: not found: g++ cmake ninja make")
        self.assertEqual(self.said("run"), (needed, absent))

    def test_every_set_is_said(self):
        for name in ("python", "test", "deep", "tidy", "wasm", "arm64", "lab", "package", "bench"):
            with self.subTest(name):
                needed, _ = self.said("install", name)
                self.assertLessEqual({"g++", "fmt"}, set(needed))
        self.assertEqual(self.said("install", "site"), (["mkdocs"], "scripts/install: not found: mkdocs"))


class LeftOut(unittest.TestCase):
    """In continuous integration no test is left out for want of what scripts/install brings."""

    def called(self, function, arguments, log, folder, mode="usual", **environment):
        (folder / "log").write_text(log, encoding="utf-8")
        functions = (ROOT / "scripts" / "test").read_text(encoding="utf-8").partition('mkdir -p "$logs"')[0].partition("set -euo pipefail")[2]
        functions = functions.replace('cd "$(dirname "${BASH_SOURCE[0]}")/.."\n', "", 1)
        done = subprocess.run(["bash", "-c", f'{functions}\n{function} {arguments} "$wanted_log"', "scripts/test", mode], cwd=ROOT,
                              capture_output=True, text=True, check=False, env={**os.environ, "wanted_log": str(folder / "log"), **environment})
        self.assertEqual(done.stderr, "")
        return done

    def wanting(self, log, folder, mode="usual"):
        return self.called("left_out_for_want", "", log, folder, mode).stdout.splitlines()

    def test_a_tool_or_an_image_is_wanting_and_data_are_not(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            tool, page = "SKIPPED [2] tests/x.py:3: there is no node", "SKIPPED [1] tests/y.py:4: this build holds no lab page"
            self.assertEqual(self.wanting(f"{tool}\n{page}\n1 passed, 3 skipped\n", folder), [tool])
            self.assertEqual(self.wanting(f"{page}\n1 passed, 1 skipped\n", folder), [])
            # It brings the page itself.
            self.assertEqual(self.wanting(f"{page}\n1 passed, 1 skipped\n", folder, "deep"), [page])
            self.assertEqual(self.wanting("4 passed\n", folder), [])
            image = "SKIPPED no image of the processor, or no emulator"
            self.assertEqual(self.wanting(f"{image}\nSKIPPED the recorded log a is not on this machine\n", folder), [image])

    def test_where_all_was_left_out_nothing_was_run(self):
        with tempfile.TemporaryDirectory() as name:
            for log, fails in (("3 skipped\n", 1), ("1 passed, 3 skipped\n", 0), ("0 passed, 0 failed, 2 skipped\n", 1)):
                for runner in ("pytest", "gtest"):
                    self.assertEqual(self.called("add_totals", runner, log, Path(name), CI="true").returncode, fails, log)
                    self.assertEqual(self.called("add_totals", runner, log, Path(name), CI="").returncode, 0, log)


class Scripts(unittest.TestCase):
    def refused(self, *command):
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        return done.stderr

    def test_an_unknown_set_of_packages_is_refused(self):
        self.assertIn("'everything', allowed: build, bench, python, site, package, test, deep, tidy",
                      self.refused("scripts/install", "everything"))

    def test_an_unknown_kind_of_test_is_refused(self):
        self.assertIn("'all', allowed: deep, quick, tidy", self.refused("scripts/test", "all"))

    def test_every_set_that_a_script_installs_is_known(self):
        install = (ROOT / "scripts" / "install").read_text(encoding="utf-8")
        known = set(re.search(r"usage: scripts/install \[([^\]]+)\]", install).group(1).split("|"))
        for path in sorted((ROOT / "scripts").iterdir()):
            used = re.findall(r"scripts/install\"? (\w+)", path.read_text(encoding="utf-8"))
            self.assertLessEqual(set(used), known, path.name)
