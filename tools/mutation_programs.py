"""The core and its tests as programs, with a mutant in it: compiled, linked, run, judged. For tools/mutate."""

import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "mutants"
ROOMS = ("common", "control", "compensation")

# Modules whose tests have another name than their own: the composed ones.
TESTED_BY = {"gyro_observation": "gyro_control", "gap_interpolation": "gap_bridge"}

COMPILER = [os.environ.get("CXX", "g++"), "-std=c++20", "-O1", "-ffp-contract=off", "-fPIC", "-w"]
# Programs name the library without its folder, so that LD_LIBRARY_PATH chooses.
SHARED = [COMPILER[0], "-shared", "-Wl,-soname,libcore.so"]
# Undefined behaviour ends the test, as it does in the build with sanitizers.
CORE_OPTIONS = ["-fno-exceptions", "-fno-rtti", "-fno-math-errno", "-D_GLIBCXX_ASSERTIONS", "-fsanitize=undefined",
                "-fno-sanitize=vptr", "-fsanitize-undefined-trap-on-error"]
# Eigen, with which some tests compare, lies where Debian puts it.
INCLUDES = ["-Isrc/core/include", "-Isrc/core", "-Itests/core", "-Itests", "-isystem", "/usr/include/eigen3"]
# Read before every test, as CMake has it read.
TEST_OPTIONS = ["-include", "tests/test.hpp"]
TEST_LIBRARIES = ["-lgtest_main", "-lgtest", "-lrapidcheck", "-lpthread"]
MEMORY_BYTES = 4 << 30


def run(command, **options):
    return subprocess.run([str(part) for part in command], cwd=ROOT, capture_output=True, text=True, check=False, **options)


def must(command):
    answer = run(command)
    if answer.returncode != 0:
        sys.exit(f"mutate: {' '.join(map(str, command))}\n{answer.stderr}")
    return answer.stdout


def room_of(path):
    """The folder of tests that see a file: control and compensation do not know each other, and all know `common`."""
    return next((room for room in ROOMS[1:] if room in Path(path).parts), "all")


def tests_of(module):
    """The module's own tests, in the order in which they are asked: what takes long at last."""
    found = (ROOT / "tests" / "core").rglob(f"{TESTED_BY.get(module, module)}*_test.cpp")
    return sorted(found, key=lambda path: (bool(re.search("law|noise|batch|properties", path.stem)), path.stem))


class Prebuilt:
    """The core and its tests as they are: objects of each file, a program of each module's own tests and one of each room's."""

    def __init__(self, chosen, jobs):
        BUILD.mkdir(parents=True, exist_ok=True)
        self.sources = sorted((ROOT / "src" / "core").rglob("*.cpp"))
        wanted = {room_of(mutant.path): sorted((ROOT / "tests" / "core").rglob("*_test.cpp")) for _, mutant in chosen}
        for room in wanted.keys() - {"all"}:
            wanted[room] = [test for test in wanted[room] if room in test.parts] or wanted[room]
        wanted |= {module: tests_of(module) for module, _ in chosen}
        tests = sorted({test for tests in wanted.values() for test in tests})
        cache = ["ccache"] if shutil.which("ccache") else []
        with ThreadPoolExecutor(jobs) as pool:
            work = [(source, CORE_OPTIONS) for source in self.sources] + [(test, TEST_OPTIONS) for test in tests]
            list(pool.map(lambda w: must([*cache, *COMPILER, *w[1], *INCLUDES, "-c", w[0], "-o", self.object(w[0])]), work))
            self.headers = dict(zip(self.sources, pool.map(lambda s: must([*COMPILER, *INCLUDES, "-MM", s]), self.sources)))
        self.library = BUILD / "libcore.so"
        must([*SHARED, *map(self.object, self.sources), "-o", self.library])
        self.programs = {name: self.link(tests, BUILD / name) for name, tests in wanted.items() if tests}
        self.limit_s = {name: self.time_limit(name) for name in self.programs}

    @staticmethod
    def object(source):
        return BUILD / f"{source.stem}.o"

    def link(self, tests, program):
        must([COMPILER[0], *map(self.object, tests), self.library, *TEST_LIBRARIES, "-o", program])
        return program

    def time_limit(self, name):
        """Five times what a program of tests takes, and a little: in seconds of the processor, whatever else it does."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        answer = run_tests(self.programs[name], BUILD, 600)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if answer != 0:
            sys.exit(f"mutate: the tests {name} fail on the core as it is; see {self.programs[name]}")
        return 3 + int(5.0 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))

    def users(self, header):
        """Sources of the core that include a header."""
        return [source for source, rule in self.headers.items() if header in rule]


def run_tests(program, library_folder, limit_s):
    """Exit status of a program of tests with the core that lies in a folder; None when it takes too long."""
    environment = {**os.environ, "LD_LIBRARY_PATH": str(library_folder), "RC_PARAMS": "seed=1"}

    def set_limits():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s))

    # Nothing in these tests waits, but a mutant might.
    longest_wait_s = 60 * limit_s
    try:
        status = run([program, "--gtest_fail_fast", "--gtest_brief=1"], env=environment, timeout=longest_wait_s,
                     preexec_fn=set_limits).returncode
    except subprocess.TimeoutExpired:
        return None
    return None if status in (-signal.SIGXCPU, -signal.SIGKILL) else status


def verdict_of(mutant, module, prebuilt, own_tests_alone=False):
    """`not compiled`, `killed`, `timeout` or `survived`."""
    with tempfile.TemporaryDirectory(dir=BUILD) as folder:
        folder = Path(folder)
        mutated = folder / mutant.path
        mutated.parent.mkdir(parents=True)
        mutated.write_text(mutant.text, encoding="utf-8")
        sources = [mutated]
        asked = (module,) if own_tests_alone else (module, room_of(mutant.path))
        programs = {name: prebuilt.programs[name] for name in asked if name in prebuilt.programs}
        if mutated.suffix == ".hpp":
            sources = [copied(source, folder) for source in prebuilt.users(mutant.path)]
        if mutated.suffix == ".hpp" and tests_of(module):
            # A header is compiled into its tests too: with them alone most is decided.
            programs[module] = folder / module
            if not build_tests(folder, tests_of(module), programs[module], prebuilt):
                return "not compiled"
            verdict = verdict_by({module: programs[module]}, BUILD, prebuilt)
            if verdict != "survived":
                return verdict
        if not build_library(folder, sources, prebuilt):
            return "not compiled"
        return verdict_by(programs, folder, prebuilt)


def verdict_by(programs, library_folder, prebuilt):
    """What the tests say of the core that lies in a folder; the first program is of the module's own tests, if it has any."""
    for name, program in programs.items():
        status = run_tests(program, library_folder, prebuilt.limit_s[name])
        if status != 0:
            return "timeout" if status is None else "killed"
    return "survived"


def copied(source, folder):
    """A private header is found beside the file that includes it."""
    copy = folder / source.relative_to(ROOT)
    copy.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(source, copy)
    return copy


def compiled(folder, source, options):
    """Compile with the headers in `folder` before the original ones, among them those beside the originals of source and header."""
    original = source.relative_to(folder) if source.is_relative_to(folder) else source.relative_to(ROOT)
    beside = [path.relative_to(folder).parent for path in folder.rglob("*.hpp")]
    includes = [f"-I{folder}/src/core/include", f"-I{folder}/src/core", *INCLUDES, *(f"-I{path}" for path in (original.parent, *beside))]
    return run([*COMPILER, *options, *includes, "-c", source, "-o", folder / f"{source.stem}.o"]).returncode == 0


def build_library(folder, sources, prebuilt):
    """The core with the files in `folder` in place of the original ones."""
    if not all(compiled(folder, source, CORE_OPTIONS) for source in sources):
        return False
    changed = {source.stem for source in sources}
    objects = [folder / f"{s.stem}.o" if s.stem in changed else prebuilt.object(s) for s in prebuilt.sources]
    must([*SHARED, *objects, "-o", folder / prebuilt.library.name])
    return True


def build_tests(folder, tests, program, prebuilt):
    """The program of a module's tests with the headers in `folder`."""
    if not all(compiled(folder, test, TEST_OPTIONS) for test in tests):
        return False
    must([COMPILER[0], *(folder / f"{t.stem}.o" for t in tests), prebuilt.library, *TEST_LIBRARIES, "-o", program])
    return True
