"""Ctrl-C, SIGTERM and SIGHUP end every verb soon, and leave nothing but what is named."""

import os
import random
import re
import resource
import signal
import socket
import subprocess
import time

from line_of import Gyro
from support import CliTest, ZLG, folder_until, run, wait_until

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

# Of the processor; the clock may be slower, for the machine may be busy with other things.
MOST_CPU_S = 0.5
MOST_WALL_S = 5.0

# How often each call is ended; more of it finds more.
ROUNDS = int(os.environ.get("ZLG_SIGNAL_ROUNDS", "2"))


def cpu_s(pid):
    """What the process has used of the processor so far, its children left out; 0 where it has ended."""
    try:
        with open(f"/proc/{pid}/stat") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def catches(pid, number):
    """Whether the process takes the signal itself: it is blocked, and waited for."""
    try:
        with open(f"/proc/{pid}/status") as status:
            return bool(int(re.search(r"^SigBlk:\s*(\w+)$", status.read(), re.M).group(1), 16) >> (number - 1) & 1)
    except (FileNotFoundError, ProcessLookupError, AttributeError):
        return False


def with_default_signals():
    """A shell that ran the tests in the background has SIGINT ignored."""
    for number in ENDING:
        signal.signal(number, signal.SIG_DFL)


class Ended:
    """A call of the program that got `numbers` one after the other, `moment_s` of its own time after its start."""

    def __init__(self, arguments, moment_s, numbers, folder):
        self.errors = folder / "errors.txt"
        with self.errors.open("wb") as errors:
            child = subprocess.Popen([ZLG, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                     stderr=errors, cwd=folder, preexec_fn=with_default_signals)
        started = time.monotonic()
        while cpu_s(child.pid) < moment_s and time.monotonic() < started + 20 * moment_s and child.poll() is None:
            time.sleep(0.002)
        used_before_s, at = cpu_s(child.pid), time.monotonic()
        self.is_early = not catches(child.pid, numbers[0])
        for number in numbers:
            if child.poll() is None:
                child.send_signal(number)
            # Two of the same number that come at once are one.
            time.sleep(0.005 if len(numbers) > 1 else 0.0)
        limit = at + 30
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG) if child.returncode is None else (child.pid, None, None)
            if pid:
                break
            if time.monotonic() > limit:
                child.kill()
            time.sleep(0.002)
        self.wall_s = time.monotonic() - at
        self.code = child.returncode if status is None else os.waitstatus_to_exitcode(status)
        self.cpu_s = 0.0 if usage is None else usage.ru_utime + usage.ru_stime - used_before_s
        child.returncode = self.code
        self.complaints = [line for line in self.errors.read_text().splitlines() if "warning" not in line]
        self.errors.unlink()


class Signals(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        shared = folder_until(cls.addClassCleanup)
        cls.raw, cls.raw_csv, cls.angles = (shared / name for name in ("raw.h5", "raw.csv", "angles.csv"))
        assert run("simulate", "--duration", 1500, "--out", cls.raw).returncode == 0
        assert run("convert", cls.raw, "--out", cls.raw_csv).returncode == 0
        assert run("process", cls.raw, "--out", cls.angles).returncode == 0

    def setUp(self):
        super().setUp()
        self.chance = random.Random(self.id())

    def left(self):
        return {str(path.relative_to(self.folder)) for path in self.folder.rglob("*")}

    def check(self, arguments, max_s, may_stay=()):
        """What stays is named: the parts in `may_stay`, which hold rows, and a result that was complete before the signal."""
        before = self.left()
        n_ended = 0
        for _ in range(20 * ROUNDS):
            if n_ended == ROUNDS:
                break
            number = self.chance.choice(ENDING)
            moment_s = self.chance.uniform(min(0.01, 0.25 * max_s), max_s)
            ended = Ended(arguments, moment_s, [number], self.folder)
            said = (arguments[0], number, moment_s, ended.code, ended.complaints)
            left = self.left() - before
            if ended.code in (0, 1):
                self.clean(left)
                continue
            n_ended += 1
            self.assertLess(ended.cpu_s, MOST_CPU_S, said)
            self.assertLess(ended.wall_s, MOST_WALL_S, said)
            if ended.code == -number and ended.is_early:
                self.clean(left)
                continue
            self.assertEqual(ended.code, 3, said)
            self.assertEqual(len(ended.complaints), 1, said)
            self.assertIn("interrupted by a signal", ended.complaints[0])
            files = {name for name in left if (self.folder / name).is_file()}
            parts, complete = (self.named(after, ended.complaints[0]) for after in ("recorded until then: ", "complete: "))
            self.assertEqual(files, parts | complete, said)
            self.assertLessEqual(parts, set(may_stay), said)
            self.assertFalse([name for name in complete if name.endswith(".part")], said)
            for name in files:
                self.assertGreater((self.folder / name).stat().st_size, 0, said)
            self.assertEqual(left - files, {os.path.dirname(name) for name in files} - {""}, said)
            self.clean(left)
        # Of a quick work, the signal came too late each time.
        if n_ended == 0:
            self.assertGreater(max_s, 0.004, "the work was done before any signal came")
            self.check(arguments, max_s / 2, may_stay)

    def named(self, after, complaint):
        found = re.search(re.escape(after) + "([^;]*)", complaint)
        return {os.path.relpath(self.folder / name, self.folder) for name in found[1].split(", ")} if found else set()

    def clean(self, left):
        for name in sorted(left, reverse=True):
            path = self.folder / name
            path.rmdir() if path.is_dir() else path.unlink()

    def test_run(self):
        self.check(["run", "--duration", 40000, "--out", "d"], 1.0, ("d/raw.h5.part", "d/angles.h5.part"))
        self.check(["run", "--duration", 40000, "--out", "d", "--format", "csv"], 0.5)

    def test_run_whose_recording_is_done(self):
        # What is computed after the recording looks for no signal.
        self.check(["run", "--duration", 400, "--set", "switching.interval_s=1", "--out", "d"], 1.0,
                   ("d/raw.h5.part", "d/angles.h5.part"))

    def test_simulate(self):
        self.check(["simulate", "--duration", 40000, "--out", "r.h5", "--wire", "w.bin"], 0.7, ("r.h5.part",))
        self.check(["simulate", "--duration", 40000, "--out", "r.csv"], 0.5)

    def test_process(self):
        self.check(["process", self.raw_csv, "--out", "a.h5"], 0.08)
        self.check(["process", self.raw, "--out", "a.csv"], 0.06)

    def test_calibrate(self):
        self.check(["calibrate", self.raw_csv, "--out", "c.toml"], 0.08)

    def test_design(self):
        self.check(["design", "--set", "perimeter.limit_lambda=1e-5", "--out", "d.html"], 0.5)

    def test_paper(self):
        self.check(["paper", "--out", "p"], 0.8)

    def test_convert(self):
        self.check(["convert", self.raw_csv, "--out", "c.h5"], 0.08)
        self.check(["convert", self.raw, "--out", "c.csv"], 0.08)
        self.check(["convert", self.raw, "--out", "c.mat"], 0.08)

    def test_inspect(self):
        self.check(["inspect", self.raw_csv], 0.05)
        self.check(["inspect", "--repair", self.raw_csv, "--out", "i.h5"], 0.08)

    def test_analyze(self):
        self.check(["analyze", self.angles, "--out", "a.html"], 0.2)

    def test_follow_finishes_its_log(self):
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(self.folder / "line"))
            server.listen()
            for number in ENDING:
                child = subprocess.Popen([ZLG, "follow", f"unix:{self.folder}/line", "--out", self.folder / "f.csv", "--force"],
                                         stdout=subprocess.DEVNULL)
                connection, _ = server.accept()
                with connection:
                    connection.sendall(b"".join(Gyro().ticks(200)))
                    wait_until((self.folder / "f.csv.part").exists, child)
                    at = time.monotonic()
                    child.send_signal(number)
                    self.assertEqual(child.wait(20), 0)
                    self.assertLess(time.monotonic() - at, MOST_WALL_S)
                self.assertEqual(self.left(), {"line", "f.csv"})

    def test_what_waits_for_somebody_else_ends_too(self):
        os.mkfifo(self.folder / "pipe")
        self.check(["process", "pipe", "--out", "a.csv"], 0.02)
        self.check(["run", "pipe", "--out", "d"], 0.02)

    def test_a_second_signal_ends_at_once(self):
        for numbers in ([signal.SIGINT] * 2, [signal.SIGTERM, signal.SIGHUP]):
            ended = Ended(["paper", "--out", "p"], 0.3, numbers, self.folder)
            self.assertEqual(ended.code, 3)
            self.assertLess(ended.cpu_s, 0.5)
            self.assertEqual(self.left(), set())

    def test_without_a_thread_the_signals_end_it_in_their_own_way(self):
        def no_thread():
            with_default_signals()
            # A stack for it that does not fit.
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 40, resource.getrlimit(resource.RLIMIT_STACK)[1]))
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

        for number in ENDING:
            # What the last one left would hide when this one has begun.
            (self.folder / "r.csv.part").unlink(missing_ok=True)
            child = subprocess.Popen([ZLG, "simulate", "--duration", "40000", "--out", self.folder / "r.csv", "--force"],
                                     preexec_fn=no_thread, stderr=subprocess.PIPE)
            with child.stderr:
                wait_until((self.folder / "r.csv.part").exists, child)
                child.send_signal(number)
                self.assertEqual(child.wait(20), -number)

    def test_who_is_to_outlive_the_terminal_does(self):
        started = subprocess.Popen(["nohup", ZLG, "simulate", "--duration", "4000", "--out", "r.h5"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until((self.folder / "r.h5.part").exists, started)
        started.send_signal(signal.SIGHUP)
        self.assertEqual(started.wait(60), 0)
