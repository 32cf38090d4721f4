"""What must not happen is provoked in the emulator: after the restart the processor says what it was, and where.

The image is the product's, object by object, with another main. ZLG_BUILD names the folder of the build, which is
build/release otherwise.
"""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("ZLG_BUILD", ROOT / "build" / "release")).resolve()
IMAGE = BUILD / "firmware" / "zlg_gyro_faults.elf"

# In the order of the image's table.
CASES = ["nothing", "undefined_instruction", "no_coprocessor", "unaligned", "divide_by_zero", "bad_branch", "run_in_memory",
         "bus_error", "write_to_code", "write_beyond_memory", "stack_overflow", "stack_leap", "unexpected_interrupt", "assertion",
         "abort", "hang", "stopped_timer", "hang_in_half", "divide_by_zero_in_half", "stack_overflow_in_half", "overrun_once",
         "overrun_always", "reset"]
QUIET_HALVES = 40
DEADLINE_HALVES = 100  # of the watchdog, 0.25 s


def symbols():
    """{name: (begin, end)} of the image's functions."""
    listing = subprocess.run(["arm-none-eabi-nm", "-S", str(IMAGE)], capture_output=True, text=True, check=True).stdout
    rows = re.findall(r"^([0-9a-f]+) ([0-9a-f]+) [tTwW] (\S+)$", listing, re.MULTILINE)
    return {name: (int(begin, 16) & ~1, (int(begin, 16) & ~1) + int(size, 16)) for begin, size, name in rows}


# In idle time the emulator leaps to its next timer, and over the watchdog's interrupt when that is the only one.
IDLE = {"stopped_timer"}


def said_on_the_bench(case):
    """The lines of the bench's serial line, from power to the end."""
    sleep = "on" if case in IDLE else "off"
    with tempfile.TemporaryDirectory() as folder:
        bench = Path(folder) / "bench.txt"
        # Time is counted in instructions: the load of this machine changes nothing.
        subprocess.run(["qemu-system-arm", "-M", "mps2-an500", "-display", "none", "-monitor", "none", "-serial", "null",
                        "-serial", f"file:{bench}", "-semihosting-config", "enable=on,target=native",
                        "-icount", f"shift=6,sleep={sleep}", "-kernel", str(IMAGE),
                        "-device", f"loader,addr=0x60800000,data={CASES.index(case)},data-len=4"],
                       timeout=60, check=False, stdin=subprocess.DEVNULL)
        return bench.read_text(encoding="ascii").splitlines()


class Report:
    def __init__(self, lines):
        self.lines = lines
        self.first = lines[0]
        self.numbers = {key: int(value) for line in lines for key, value in re.findall(r"^(\w+)=(\d+)$", line)}
        self.reason, *fields = lines[1].split() if len(lines) > 1 and "=" not in lines[1].split()[0] else ("", )
        self.fields = {key: int(value, 0) for key, _, value in (field.partition("=") for field in fields)}


@unittest.skipUnless(IMAGE.is_file(), f"no {IMAGE}")
class FaultTest(unittest.TestCase):
    def provoke(self, case):
        report = Report(said_on_the_bench(case))
        self.assertEqual(report.first, "none", "power is no fault")
        return report

    def expect(self, case, reason, within=None, **fields):
        """The reason after exactly one restart, and that it happened in the function `within`."""
        report = self.provoke(case)
        self.assertEqual(report.reason, reason, report.lines)
        self.assertEqual(report.numbers["starts"], 2)
        if within:
            begin, end = symbols()[within]
            self.assertTrue(begin <= report.fields["pc"] < end, f"{report.lines[1]}: not in {within}, {begin:#x}..{end:#x}")
        for key, value in fields.items():
            self.assertEqual(report.fields[key], value, report.lines[1])
        return report

    def expect_in_its_place(self, case, reason=None, **fields):
        report = self.expect(case, reason or case, within=f"provoke_{case}", **fields)
        self.assertEqual(report.fields["halves"], QUIET_HALVES)
        return report


# Case, the reason where its name is another, and what the record says; in the function that provokes it.
IN_ITS_PLACE = [("undefined_instruction", None, {"cfsr": 1 << 16, "hfsr": 1 << 30}), ("no_coprocessor", None, {"cfsr": 1 << 19}),
                ("unaligned", None, {"cfsr": 1 << 24}), ("divide_by_zero", None, {"cfsr": 1 << 25}), ("bus_error", None, {"address": 0x50000000}),
                ("write_to_code", "forbidden_address", {"address": 0x8000}), ("write_beyond_memory", "forbidden_address", {"address": 0x20020000}),
                ("unexpected_interrupt", None, {"detail": 16 + 20}), ("assertion", None, {"detail": 77})]
# Somewhere else, or where it cannot be told.
ELSEWHERE = [("run_in_memory", "bad_branch", {"pc": 0x20008000, "cfsr": 1 << 0}), ("stack_leap", "stack_overflow", {}),
             ("divide_by_zero_in_half", "divide_by_zero", {"within": "provoke_divide_by_zero", "halves": QUIET_HALVES}),
             ("abort", "assertion", {"detail": 0}), ("stopped_timer", "half_period_hung", {"halves": QUIET_HALVES}),
             ("hang_in_half", "half_period_hung", {"within": "provoke_hang", "halves": QUIET_HALVES})]


class Faults(FaultTest):
    def test_each_is_told_with_its_place(self):
        for case, reason, said in IN_ITS_PLACE:
            with self.subTest(case):
                self.expect_in_its_place(case, reason, **said)
        for case, reason, said in ELSEWHERE:
            with self.subTest(case):
                self.expect(case, reason, **said)

    def test_branch_to_what_is_no_code(self):
        report = self.expect("bad_branch", "bad_branch", cfsr=1 << 17, pc=0x100)
        begin, end = symbols()["provoke_bad_branch"]
        self.assertTrue(begin <= report.fields["lr"] & ~1 < end)

    def test_recursion_without_end(self):
        for case in ("stack_overflow", "stack_overflow_in_half"):
            with self.subTest(case):
                report = self.expect(case, "stack_overflow", halves=QUIET_HALVES)
                self.assertLess(report.fields["sp"], 0x20000000 + 32, "of an address below the stack")

    def test_background_that_hangs(self):
        report = self.expect("hang", "background_hung", within="provoke_hang", overruns=0)
        self.assertAlmostEqual(report.fields["halves"], QUIET_HALVES + DEADLINE_HALVES, delta=2)

    def test_half_periods_that_leave_no_time(self):
        report = self.expect("overrun_always", "background_hung")
        self.assertGreater(report.fields["overruns"], 10)


class Life(FaultTest):
    def test_reset_without_a_reason(self):
        self.assertEqual(self.expect("reset", "reset").fields["pc"], 0)

    def test_without_a_fault_there_is_no_restart(self):
        report = self.provoke("nothing")
        self.assertEqual(report.numbers["memory_errors"], 0, "copies or fills that the image makes of a few bytes are wrong")
        self.assertEqual(report.numbers, report.numbers | {"starts": 1, "halves": 8 * QUIET_HALVES, "overruns": 0})
        # Frames are missed on this board, so that little of the core works: more than nothing, less than there is.
        self.assertTrue(300 < report.numbers["stack_used_bytes"] < 14 * 1024, report.numbers)

    def test_one_half_that_takes_too_long_is_counted(self):
        report = self.provoke("overrun_once")
        self.assertEqual((report.numbers["starts"], report.numbers["overruns"]), (1, 1), report.lines)
