"""Whole frames of a gyro that there is not: a line as it may be, written from docs/wire.md alone."""

import struct
import sys

from support import ROOT

sys.path.insert(0, str(ROOT / "tests" / "firmware"))
from gyro_line import TELEMETRY, frame  # noqa: E402


class Gyro:
    """Turns by `turn` arcsec a tick, a multiple of 2^-28; a tick is settled `age` ticks later."""

    def __init__(self, session=1, turn=0.25, tick_s=0.005, age=5):
        self.session, self.turn, self.tick_s, self.age = session, turn, tick_s, age
        self.sequence = 0
        self.tick = 0

    def skip(self, ticks, messages):
        self.tick += ticks
        self.sequence += messages

    def angle(self, ticks):
        return round(ticks * self.turn * 2 ** 28) % 2 ** 64

    def next(self, **other):
        """The frame of the next tick, with some of its fields as said."""
        settled = self.tick >= self.age
        fields = dict(tick=self.tick % 2 ** 32, age=self.age, bits=3 if settled else 1, byte_7=0, angle=self.angle(self.tick + 1),
                    turn=self.turn, flags=0, health=0, mode=1, settled_mode=1, bytes_34=0, temperature=20.0,
                    settled_turn=self.turn if settled else 0.0, final_turn=self.turn if settled else 0.0,
                    sigma=0.01 if settled else 0.0, settled_angle=self.angle(self.tick + 1 - self.age) if settled else 0,
                    final_angle=self.angle(self.tick + 1 - self.age) if settled else 0, settled_flags=0, pulses=0,
                    since_pulse=0, stamp=50_000 * self.tick, tick_s=self.tick_s)
        fields.update(other)
        message = frame(TELEMETRY, self.session, self.sequence, struct.pack("<IHBBQdIIbbHfdddQQIIIQd", *fields.values()))
        self.tick += 1
        self.sequence += 1
        return message

    def ticks(self, n):
        return [self.next() for _ in range(n)]
