"""Settings that the image keeps over a reset and a loss of power, and those of `zlg settings` that are loaded into it."""

import json
import os
import struct
import subprocess
import time
import unittest

import gyro_line as line
from emulated_gyro import PATIENCE_S, ZLG, Emulator, WireTest
from gyro_line import TELEMETRY

STORED, STORED_BYTES = 0x3C000, 0x4000


@unittest.skipUnless(ZLG.is_file(), f"no {ZLG}")
class SettingsTest(WireTest):
    def settings(self, *sets):
        """What the program writes for a gyro whose tick, loop and readout are not the image's own."""
        path = self.folder / "settings.bin"
        words = [word for item in ("gyro.tick_s=0.004", "perimeter.loop=digital", "switching.interval_s=30", *sets)
                 for word in ("--set", item)]
        said = subprocess.run([ZLG, "settings", *words, "--out", path, "--force", "--json"], capture_output=True, check=True)
        self.crc = int(json.loads(said.stdout)["settings_crc"], 16)
        return path.read_bytes()

    def sound(self, data):
        """The same with the right checksum."""
        return data[:-4] + struct.pack("<I", line.crc32c(data[:-4]))

    def flash(self, size=STORED_BYTES):
        path = self.folder / "flash.bin"
        self.emulator.do("pmemsave", val=STORED, size=size, filename=str(path))
        return path.read_bytes()

    def loaded_host(self, data):
        """A host at a gyro that has begun anew with these settings."""
        host = self.powered_host()
        self.own_crc = host.status().settings_crc
        self.assert_done(host.load(data))
        host.listen_until(lambda m: m.session == 2 and m.kind == TELEMETRY)
        return host


class Stored(SettingsTest):
    def power_with(self, flash):
        path = self.folder / "given.bin"
        path.write_bytes(flash)
        self.emulator.end()
        for left in self.folder.glob("line.*"):
            left.unlink()
        return self.powered_host("-device", f"loader,file={path},addr={STORED:#x},force-raw=on")

    def test_settings_outlive_a_reset(self):
        host = self.loaded_host(self.settings())
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 3)
        self.assertEqual(host.status().settings_crc, self.crc)

    def test_settings_outlive_a_loss_of_power(self):
        self.loaded_host(self.settings())
        host = self.power_with(self.flash())
        self.assertEqual(host.status().settings_crc, self.crc)
        self.assertEqual({m.session for m in host.messages}, {1})

    def test_settings_that_are_not_whole_are_not_taken(self):
        self.loaded_host(self.settings())
        kept = bytearray(self.flash())
        kept[kept.index(struct.pack("<q", 7500))] ^= 1
        self.assertEqual(self.power_with(kept).status().settings_crc, self.own_crc)
        self.assertNotEqual(self.own_crc, self.crc)

    def test_keeping_pieces_costs_no_tick(self):
        host = self.powered_host()
        for _ in range(10):
            self.assert_done(host.load(self.settings(), ends=False))
        state = host.status()
        self.assertEqual(state.n_overruns, 0)
        messages = host.of(TELEMETRY)
        self.assertEqual([m.tick for m in messages], list(range(len(messages))))


class Loaded(SettingsTest):
    def test_settings_are_loaded_stored_and_in_force_after_a_start_by_itself(self):
        data = self.settings()
        host = self.loaded_host(data)
        self.assertEqual({m.tick_s for m in host.of(TELEMETRY, session=2)}, {0.004})
        self.assertEqual(host.status().settings_crc, self.crc)
        self.assertEqual(self.flash(len(data)), data)

    def refused(self, data, result):
        host = self.loaded_host(self.settings("switching.interval_s=20"))
        before = self.flash(len(self.settings()))
        crc = host.status().settings_crc
        reply = host.load(data)
        self.assertEqual(reply.result, result)
        host.ticks(20)
        self.assertEqual({m.session for m in host.messages}, {1, 2}, "it did not start anew")
        self.assertEqual(self.flash(len(before)), before)
        self.emulator.do("system_reset")
        host.listen_until(lambda m: m.session == 3)
        self.assertEqual(host.status().settings_crc, crc)
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
