"""The image of the product, free-running in the emulator, as a host at its serial line finds it.

No gyro is there: every frame is missed, so that no switch is completed. What the line carries of a gyro that switches is tested
in lock step. The host's end is a decoder of its own, `gyro_line`. ZLG_BUILD names the folder of the build.
"""

import fcntl
import json
import os
import select
import socket
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import gyro_line as line
from gyro_line import READ, READ_STATE, SET, START, STOP, FORCE, REPLY, STATUS, TELEMETRY

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("ZLG_BUILD", ROOT / "build" / "release")).resolve()
IMAGE = BUILD / "firmware" / "zlg_gyro.elf"
ZLG = BUILD / "bin" / "zlg"

STORED, STORED_BYTES = 0x3C000, 0x4000
HALF_WAVE, INTERVAL, MIN_TICKS, SETTLE = 0x0205, 0x0402, 0x0403, 0x0503
HALF_TIMER = 25_000  # of 10 MHz
PATIENCE_S = 20.0  # of this machine under load; in the emulator all is done within some ticks
F_SETPIPE_SZ = 1031  # of Linux; older modules do not name it
HELD, ASKED = 2, 4  # bits of the status


class Emulator:
    """The image under power. Its serial line are two pipes; folder/line.out holds what nobody has read yet."""

    # Time is counted in instructions, and leaps while the processor waits: a slow machine slows the gyro as well.
    CLOCK = ("-icount", "shift=6,sleep=off")

    def __init__(self, folder, *options, line=None):
        self.socket = Path(folder) / "machine"
        self.process = subprocess.Popen(
            ["qemu-system-arm", "-M", "mps2-an500", "-display", "none", "-monitor", "none", *self.CLOCK,
             "-chardev", line or f"pipe,id=line,path={folder}/line", "-serial", "chardev:line", "-serial", "null",
             "-qmp", f"unix:{self.socket},server=on,wait=off", "-kernel", IMAGE, *options],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def do(self, what, **arguments):
        """A command to the emulator itself."""
        with socket.socket(socket.AF_UNIX) as plug:
            plug.settimeout(PATIENCE_S)
            plug.connect(str(self.socket))
            with plug.makefile("rw", encoding="utf-8") as machine:
                machine.readline()
                for name, given in (("qmp_capabilities", {}), (what, arguments)):
                    machine.write(json.dumps({"execute": name, "arguments": given}) + "\n")
                    machine.flush()
                    said = {}
                    while "return" not in said:
                        said = json.loads(machine.readline())
                        if "error" in said:
                            raise RuntimeError(said["error"])

    def end(self):
        self.process.kill()
        self.process.wait()


class Host:
    """At the line: it keeps all messages, and asks as the document of the wire tells."""

    def __init__(self, folder, session=77):
        for end in ("in", "out"):
            if not (folder / f"line.{end}").exists():
                os.mkfifo(folder / f"line.{end}")
        self.hears = os.open(folder / "line.out", os.O_RDONLY | os.O_NONBLOCK)
        self.tells = os.open(folder / "line.in", os.O_RDWR)
        fcntl.fcntl(self.hears, F_SETPIPE_SZ, 1 << 20)  # as good as always read
        self.decoder = line.Decoder()
        self.bytes = b""
        self.messages = []
        self.session = session
        self.sequence = 0

    def close(self):
        os.close(self.hears)
        os.close(self.tells)

    def send(self, data):
        os.write(self.tells, data)

    def hear(self):
        """What has come since the last time, at least a byte."""
        if not select.select([self.hears], [], [], PATIENCE_S)[0]:
            raise TimeoutError(f"silence after {len(self.messages)} messages")
        data = os.read(self.hears, 65536)
        if not data:
            raise EOFError("the emulator has ended")
        self.bytes += data
        return data

    def listen_until(self, good):
        """The first message from now on of which `good` is true."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            new = list(self.decoder.messages(self.hear()))
            self.messages += new
            found = next((message for message in new if good(message)), None)
            if found:
                return found
        raise TimeoutError(f"{len(self.messages)} messages, none was it")

    def repeat(self, sequence, code, *parameters):
        self.send(line.command(self.session, sequence, code, *parameters))
        return self.listen_until(lambda m: m.kind == REPLY and (m.to_session, m.to_sequence) == (self.session, sequence))

    def load(self, data):
        """The reply to the piece that ends it."""
        for at in [*range(0, len(data), line.PIECE_BYTES), len(data)]:
            self.sequence += 1
            self.send(line.piece(self.session, self.sequence, at, data[at:at + line.PIECE_BYTES]))
            reply = self.listen_until(lambda m: m.kind == REPLY and m.to_sequence == self.sequence)
            if reply.result:
                break
        return reply

    def ask(self, code, *parameters):
        self.sequence += 1
        return self.repeat(self.sequence, code, *parameters)

    def status(self):
        """Asked for: the first one after the reply."""
        reply = self.ask(READ_STATE)
        later = [m for m in self.messages[self.messages.index(reply):] if m.kind == STATUS]
        return later[0] if later else self.listen_until(lambda m: m.kind == STATUS)

    def ticks(self, n):
        """n more messages of telemetry."""
        have = self.of(TELEMETRY)
        self.listen_until(lambda _: len(self.of(TELEMETRY)) >= len(have) + n)
        return self.of(TELEMETRY)[len(have):]

    def of(self, kind, session=None):
        return [m for m in self.messages if m.kind == kind and session in (None, m.session)]


@unittest.skipUnless(IMAGE.is_file(), f"no {IMAGE}")
class WireTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def powered_host(self, *options):
        """A host at the line of an image that is switched on."""
        host = Host(self.folder)
        self.addCleanup(host.close)
        self.emulator = Emulator(self.folder, *options)
        self.addCleanup(self.emulator.end)
        return host

    def assert_done(self, reply):
        self.assertEqual((reply.result, reply.key, reply.part, reply.fault), (line.DONE, 0, 0, 0))


class Telemetry(WireTest):
    def test_every_tick_is_told_and_every_message_is_whole(self):
        host = self.powered_host()
        host.listen_until(lambda m: m.kind == TELEMETRY and m.tick >= 450)
        messages = host.of(TELEMETRY)
        self.assertEqual([m.tick for m in messages], list(range(len(messages))))
        self.assertEqual([m.sequence for m in host.messages], list(range(len(host.messages))))
        self.assertEqual({m.session for m in host.messages}, {1})
        self.assertEqual(host.decoder.n_damaged, 0)
        self.assertEqual({m.tick_s for m in messages}, {0.005})
        # Every 200 ticks, as soon as the background comes to it: on a busy machine it comes late.
        first, second = (m.tick for m in host.of(STATUS))
        self.assertGreaterEqual(first, 199)
        self.assertGreaterEqual(second - first, 200)

    def test_stamps_are_those_of_the_ends_of_halves(self):
        host = self.powered_host()
        host.ask(SET, (INTERVAL, 3000.0))
        host.listen_until(lambda m: m.kind == TELEMETRY and m.tick >= 500)
        # Without a latch of its own each half is as long as it should be, whatever the work in it takes.
        messages = host.of(TELEMETRY)
        self.assertEqual([m.timer for m in messages], [2 * HALF_TIMER * (m.tick + 1) for m in messages])

    def test_what_is_settled_follows_by_its_age(self):
        host = self.powered_host()
        host.listen_until(lambda m: m.kind == TELEMETRY and m.tick >= 100)
        for m in host.of(TELEMETRY):
            self.assertEqual(bool(m.bits & 2), m.tick >= m.age > 0, f"tick {m.tick}")

    @unittest.skipUnless(ZLG.is_file(), f"no {ZLG}")
    def test_zlg_follow_makes_a_log_of_it(self):
        host = self.powered_host()
        host.listen_until(lambda m: m.kind == TELEMETRY and m.tick >= 400)
        out = self.folder / "angles.csv"
        with socket.create_server(str(self.folder / "relay"), family=socket.AF_UNIX) as relay:
            follow = subprocess.Popen([ZLG, "follow", f"unix:{self.folder}/relay", "--out", out, "--json"],
                                      stdout=subprocess.PIPE, text=True)
            relay.settimeout(PATIENCE_S)
            with relay.accept()[0] as plug:
                plug.sendall(host.bytes[:host.bytes.rindex(b"\0") + 1])
        said = json.loads(follow.communicate(timeout=60)[0])
        self.assertEqual(follow.returncode, 0)
        for loss in ("lost_messages", "lost_ticks", "restarts", "damaged_frames", "refused_messages"):
            self.assertEqual(said[loss], 0, loss)
        messages = host.of(TELEMETRY)
        self.assertEqual(said["telemetry_messages"], len(messages))
        rows = [row.split(",") for row in out.read_text(encoding="ascii").splitlines() if not row.startswith("#")][1:]
        self.assertEqual([int(row[0]) for row in rows], [m.tick for m in messages])

class Parameters(WireTest):
    def test_a_value_is_read_set_and_read_back(self):
        host = self.powered_host()
        before = host.ask(READ, INTERVAL, HALF_WAVE)
        self.assert_done(before)
        self.assertEqual(before.values, {INTERVAL: 18000.0, HALF_WAVE: 40.0})
        changed = host.ask(SET, (INTERVAL, 3000.0))
        self.assert_done(changed)
        self.assertEqual(changed.values, {INTERVAL: 3000.0})
        self.assertEqual(host.ask(READ, INTERVAL).values, {INTERVAL: 3000.0})

    def refused(self, result, key, *wanted):
        host = self.powered_host()
        crc = host.status().settings_crc
        keys = [item[0] for item in wanted]
        before = host.ask(READ, *keys)
        reply = host.ask(SET, *wanted)
        self.assertEqual((reply.result, reply.key), (result, key))
        self.assertEqual(host.ask(READ, *keys).values, before.values)
        self.assertEqual(host.status().settings_crc, crc)
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 2)
        self.assertEqual(host.status().settings_crc, crc, "nothing was stored")
        return reply

    def test_what_the_core_does_not_allow_changes_nothing_and_is_named(self):
        reply = self.refused(line.NOT_ALLOWED, SETTLE, (INTERVAL, 3000.0), (SETTLE, -1.0))
        self.assertEqual(reply.part, 1)

    def test_sixteen_at_once(self):
        keys = list(range(0x0101, 0x0105)) + list(range(0x0201, 0x020D))
        reply = self.powered_host().ask(READ, *keys)
        self.assert_done(reply)
        self.assertEqual(list(reply.values), keys)


class Switching(WireTest):
    def test_it_is_stopped_and_started(self):
        host = self.powered_host()
        self.assertEqual(host.status().bits & HELD, 0)
        self.assert_done(host.ask(STOP))
        self.assertEqual(host.status().bits & HELD, HELD)
        self.assert_done(host.ask(START))
        self.assertEqual(host.status().bits & HELD, 0)

    def test_a_forced_switch_waits_for_a_gyro_that_is_ready(self):
        host = self.powered_host()
        self.assertEqual(host.status().bits & ASKED, 0)
        self.assert_done(host.ask(FORCE))
        host.ticks(20)
        self.assertEqual(host.status().bits & ASKED, ASKED)

    def test_the_state_is_told_at_once(self):
        host = self.powered_host()
        host.ticks(10)
        state = host.status()
        self.assertEqual(state.sequence, host.of(REPLY)[0].sequence + 1)
        self.assertEqual((state.tick_s, state.timer_hz, state.n_good, state.n_damaged, state.last_fault), (0.005, 1e7, 1, 0, 0))
        # The telemetry before it, whatever has come since.
        before = [m for m in host.messages[:host.messages.index(state)] if m.kind == TELEMETRY][-1]
        self.assertAlmostEqual(state.tick, before.tick, delta=2)
        self.assertTrue(300 < state.stack_bytes < 16384, state.stack_bytes)


class Repeated(WireTest):
    def test_a_command_that_comes_again_is_answered_again_and_not_obeyed(self):
        host = self.powered_host()
        first = host.repeat(10, SET, (INTERVAL, 3000.0))
        again = host.repeat(10, SET, (INTERVAL, 4000.0))
        self.assertEqual(again.values, first.values)
        self.assertEqual(again.sequence > first.sequence, True)
        self.assertEqual(host.repeat(11, READ, INTERVAL).values, {INTERVAL: 3000.0})


class Disturbed(WireTest):
    def test_noise_and_halves_of_frames_cost_nothing_but_themselves(self):
        host = self.powered_host()
        before = host.status().n_good
        whole = line.command(1, 1, SET, (INTERVAL, 3000.0))
        broken = bytearray(whole)
        broken[15] ^= 0x10
        for noise in (bytes(range(1, 200)), whole[:20], bytes(broken), b"\0" * 50, b"\xff" * 600):
            host.send(noise)
            host.ticks(10)
        self.assertEqual(host.ask(READ, INTERVAL).values, {INTERVAL: 18000.0})
        state = host.status()
        self.assertEqual(state.n_good, before + 2)
        self.assertGreaterEqual(state.n_damaged, 4)
        messages = host.of(TELEMETRY)
        self.assertEqual([m.tick for m in messages], list(range(len(messages))))
        self.assertEqual(host.decoder.n_damaged, 0)

    def test_after_a_reset_the_session_is_the_next_one_and_all_begins_anew(self):
        host = self.powered_host()
        host.ask(STOP)
        self.emulator.do("system_reset")
        first = host.listen_until(lambda m: m.session == 2)
        self.assertEqual((first.sequence, first.tick), (0, 0))
        state = host.status()
        self.assertEqual(state.bits & HELD, 0)
        self.assertEqual(state.last_fault, 14)  # a reset from outside
        self.assertEqual([m.session for m in host.messages], sorted(m.session for m in host.messages))
        messages = host.of(TELEMETRY, session=2)
        self.assertEqual([m.tick for m in messages], list(range(len(messages))))

    def test_a_command_from_before_the_reset_is_obeyed_after_it(self):
        host = self.powered_host()
        host.repeat(10, STOP)
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 2)
        host.repeat(10, STOP)
        self.assertEqual(host.status().bits & HELD, HELD)

    def test_a_host_that_comes_in_the_middle_of_a_frame_joins(self):
        host = self.powered_host()
        host.listen_until(lambda m: m.kind == TELEMETRY and m.tick >= 20)
        host.hear()
        host.decoder, host.messages = line.Decoder(), []
        middle = host.bytes[-3000:]
        messages = [m for m in host.decoder.messages(middle) if m.kind == TELEMETRY]
        self.assertLessEqual(host.decoder.n_damaged, 1)
        self.assertGreater(len(messages), 20)
        self.assertEqual([m.tick - messages[0].tick for m in messages], list(range(len(messages))))


class Stored(WireTest):
    def flash(self):
        """What the flash holds, as a file that outlives the power."""
        path = self.folder / "flash.bin"
        self.emulator.do("pmemsave", val=STORED, size=STORED_BYTES, filename=str(path))
        return path

    def power_with(self, flash):
        self.emulator.end()
        for left in self.folder.glob("line.*"):
            left.unlink()
        return self.powered_host("-device", f"loader,file={flash},addr={STORED:#x},force-raw=on")

    def test_settings_outlive_a_reset(self):
        host = self.powered_host()
        host.ask(SET, (INTERVAL, 3000.0), (SETTLE, 12.0))
        crc = host.status().settings_crc
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 2)
        self.assertEqual(host.ask(READ, INTERVAL, SETTLE).values, {INTERVAL: 3000.0, SETTLE: 12.0})
        self.assertEqual(host.status().settings_crc, crc)

    def test_settings_outlive_a_loss_of_power(self):
        self.powered_host().ask(SET, (INTERVAL, 3000.0))
        host = self.power_with(self.flash())
        self.assertEqual(host.ask(READ, INTERVAL).values, {INTERVAL: 3000.0})
        self.assertEqual({m.session for m in host.messages}, {1})

    def test_settings_that_are_not_whole_are_not_taken(self):
        host = self.powered_host()
        host.ask(SET, (INTERVAL, 3000.0))
        flash = self.flash()
        kept = bytearray(flash.read_bytes())
        at = kept.index(struct.pack("<q", 3000))
        kept[at] ^= 1
        flash.write_bytes(kept)
        self.assertEqual(self.power_with(flash).ask(READ, INTERVAL).values, {INTERVAL: 18000.0})

    def test_storing_costs_no_tick(self):
        host = self.powered_host()
        for k in range(10):
            self.assert_done(host.ask(SET, (INTERVAL, 3000.0 + k)))
        state = host.status()
        self.assertEqual(state.n_overruns, 0)
        messages = host.of(TELEMETRY)
        self.assertEqual([m.tick for m in messages], list(range(len(messages))))


@unittest.skipUnless(ZLG.is_file(), f"no {ZLG}")
class Loaded(WireTest):
    OLD = {INTERVAL: 3000.0}

    def settings(self, *sets):
        """What the program writes for a gyro whose tick, loop and readout the line alone cannot set."""
        path = self.folder / "settings.bin"
        words = [word for item in ("gyro.tick_s=0.004", "perimeter.loop=digital", "switching.interval_s=30", *sets)
                 for word in ("--set", item)]
        subprocess.run([ZLG, "settings", *words, "--out", path, "--force"], stdout=subprocess.DEVNULL, check=True)
        return path.read_bytes()

    def sound(self, data):
        """The same with the right checksum."""
        return data[:-4] + struct.pack("<I", line.crc32c(data[:-4]))

    def flash(self, size):
        path = self.folder / "flash.bin"
        self.emulator.do("pmemsave", val=STORED, size=size, filename=str(path))
        return path.read_bytes()

    def test_settings_are_loaded_stored_and_in_force_after_a_start_by_itself(self):
        host = self.powered_host()
        data = self.settings()
        self.assert_done(host.load(data))
        host.listen_until(lambda m: m.session == 2 and m.kind == TELEMETRY)
        self.assertEqual({m.tick_s for m in host.of(TELEMETRY, session=2)}, {0.004})
        half_ticks, loop, reads = 0x0601, 0x0201, 0x0801
        self.assertEqual(host.ask(READ, half_ticks, loop, reads, INTERVAL).values,
                         {half_ticks: 20_000.0, loop: 1.0, reads: 0.0, INTERVAL: 7500.0})
        self.assertEqual(self.flash(len(data)), data)

    def refused(self, data, result):
        host = self.powered_host()
        self.assert_done(host.ask(SET, *self.OLD.items()))
        before = self.flash(len(self.settings()))
        reply = host.load(data)
        self.assertEqual(reply.result, result)
        host.ticks(20)
        self.assertEqual({m.session for m in host.messages}, {1}, "it did not start anew")
        self.assertEqual(self.flash(len(before)), before)
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 2)
        self.assertEqual(host.ask(READ, *self.OLD).values, self.OLD)
        return reply

    def test_a_bit_that_is_another_one(self):
        data = bytearray(self.settings())
        data[3000] ^= 4
        self.refused(bytes(data), line.DAMAGED)

    def test_an_end_that_is_cut_off(self):
        self.refused(self.settings()[:-300], line.DAMAGED)

    def test_another_version(self):
        data = bytearray(self.settings())
        data[8] ^= 1
        self.refused(self.sound(bytes(data)), line.OTHER_PROGRAM)

    def test_what_the_core_refuses(self):
        data = self.settings("switching.interval_s=27")
        at = data.index(struct.pack("<q", 6750))
        reply = self.refused(self.sound(data[:at] + struct.pack("<q", -1) + data[at + 8:]), line.NOT_ALLOWED)
        self.assertEqual(reply.part, 1)

    def test_more_than_there_is_room_for(self):
        self.refused(self.settings() * 2, line.MALFORMED)

    def test_the_program_loads_them(self):
        self.settings()
        for end in ("in", "out"):
            os.mkfifo(self.folder / f"line.{end}")
        emulator = Emulator(self.folder, line=f"socket,id=line,path={self.folder}/plug,server=on,wait=off")
        self.addCleanup(emulator.end)
        load = [ZLG, "settings", self.folder / "settings.bin", "--to", f"unix:{self.folder}/plug"]
        end = time.monotonic() + PATIENCE_S
        while not (self.folder / "plug").exists() and time.monotonic() < end:
            time.sleep(0.01)
        said = subprocess.run(load, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        self.assertIn("loaded and stored", said.stdout)
        self.emulator = emulator
        self.assertEqual(self.flash(stored := (self.folder / "settings.bin").stat().st_size), self.settings())
        self.assertGreater(stored, 6000)
