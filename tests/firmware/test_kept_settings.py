"""Settings that the image keeps over a reset and a loss of power, and those of `zlg settings` that are loaded into it."""

import os
import struct
import subprocess
import time
import unittest

import gyro_line as line
from emulated_gyro import INTERVAL, PATIENCE_S, SETTLE, ZLG, Emulator, WireTest
from gyro_line import READ, SET, TELEMETRY

STORED, STORED_BYTES = 0x3C000, 0x4000


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
