"""The image of the product, free-running in the emulator, as a host at its serial line finds it.

No gyro is there: every frame is missed, so that no switch is completed. What the line carries of a gyro that switches is tested
in lock step. The host's end is a decoder of its own, `gyro_line`.
"""

import json
import socket
import subprocess
import unittest

import gyro_line as line
from emulated_gyro import PATIENCE_S, ZLG, WireTest
from gyro_line import FORCE, REPLY, START, STATUS, STOP, TELEMETRY

HALF_TIMER = 25_000  # of 10 MHz
HELD, ASKED = 2, 4  # bits of the status


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
        host.ask(FORCE)
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
        first = host.repeat(10, STOP)
        again = host.repeat(10, START)
        self.assertEqual(again.code, first.code)
        self.assertEqual(again.sequence > first.sequence, True)
        self.assertEqual(host.status().bits & HELD, HELD)


class Unknown(WireTest):
    def test_it_is_refused(self):
        host = self.powered_host()
        for code in (0, 5, 6, 8, 255):
            self.assertEqual(host.ask(code).result, line.MALFORMED, code)


class Disturbed(WireTest):
    def test_noise_and_halves_of_frames_cost_nothing_but_themselves(self):
        host = self.powered_host()
        before = host.status().n_good
        whole = line.command(1, 1, STOP)
        broken = bytearray(whole)
        broken[9] ^= 0x10
        for noise in (bytes(range(1, 200)), whole[:10], bytes(broken), b"\0" * 50, b"\xff" * 600):
            host.send(noise)
            host.ticks(10)
        self.assert_done(host.ask(START))
        state = host.status()
        self.assertEqual(state.bits & HELD, 0)
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
