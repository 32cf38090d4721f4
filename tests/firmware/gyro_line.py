"""The gyro's end of the serial line, as a host sees it: written from docs/wire.md alone, nothing of the product in it."""

import struct

TELEMETRY, STATUS, COMMAND, REPLY = 1, 2, 3, 4
READ_STATE, STOP, START, FORCE = range(1, 5)
LOAD = 7
DONE, MALFORMED = 0, 1
NOT_ALLOWED, DAMAGED, OTHER_PROGRAM, SWITCHING = range(5, 9)
PIECE_BYTES = 224
BODY_BYTES = {TELEMETRY: 108, STATUS: 96}


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)  # 0x1EDC6F41 with its bits reversed
    return crc ^ 0xFFFFFFFF


def stuffed(data):
    """COBS: each zero becomes the distance to the next one."""
    out = bytearray()
    for run in data.split(b"\0"):
        while len(run) >= 254:
            out += b"\xff" + run[:254]
            run = run[254:]
        out += bytes([len(run) + 1]) + run
    return bytes(out)


def unstuffed(data):
    """What `stuffed` was given; None for what it never returns."""
    out, at = bytearray(), 0
    while at < len(data):
        code = data[at]
        run = data[at + 1:at + code]
        if code == 0 or len(run) != code - 1 or 0 in run:
            return None
        at += code
        out += run + (b"\0" if code < 255 and at < len(data) else b"")
    return bytes(out)


def frame(kind, session, sequence, body):
    message = struct.pack("<BBHI", 1, kind, session, sequence) + body
    return b"\0" + stuffed(message + struct.pack("<I", crc32c(message))) + b"\0"


def command(session, sequence, code):
    return frame(COMMAND, session, sequence, struct.pack("<BB", code, 0))


def piece(session, sequence, offset, data=b""):
    """Of settings that are loaded; the last one is empty."""
    return frame(COMMAND, session, sequence, struct.pack("<BBH", LOAD, len(data), offset) + data)


class Message:
    """kind, session, sequence, and the fields of the body by name."""

    def __init__(self, data):
        version, self.kind, self.session, self.sequence = struct.unpack_from("<BBHI", data)
        body = data[8:-4]
        if version != 1 or self.kind not in (TELEMETRY, STATUS, REPLY) or len(body) != BODY_BYTES.get(self.kind, len(body)):
            raise ValueError(f"no message of a gyro: {data.hex()}")
        {TELEMETRY: self.telemetry, STATUS: self.status, REPLY: self.reply}[self.kind](body)

    def telemetry(self, body):
        (self.tick, self.age, self.bits, _, self.angle, self.dtheta, self.flags, self.health, self.mode, _, _, _, _,
         self.dtheta_final, self.sigma, self.angle_settled, self.angle_final, _, _, _, self.timer,
         self.tick_s) = struct.unpack("<IHBBQdIIbbHfdddQQIIIQd", body)

    def status(self, body):
        (self.tick, self.phase, self.helicity, self.bits, _, self.tick_s, self.count_arcsec, self.timer_hz, self.health,
         self.n_switches, self.n_failed) = struct.unpack_from("<IBbBBdddIII", body)
        self.settings_crc, self.n_good, self.n_damaged, self.n_overruns, self.stack_bytes, self.last_fault = \
            struct.unpack_from("<IIIIII", body, 72)

    def reply(self, body):
        (self.to_session, self.to_sequence, self.code, self.result, zero, self.part, self.fault, end) = \
            struct.unpack("<HIBBHBBB", body)
        if zero or end:
            raise ValueError(f"{zero} and {end} where zeros must be")


class Decoder:
    """Bytes in, messages out; what is none is counted."""

    def __init__(self):
        self.rest = b""
        self.n_damaged = 0

    def messages(self, data):
        *pieces, self.rest = (self.rest + data).split(b"\0")
        for piece in filter(None, pieces):
            plain = unstuffed(piece)
            if plain is None or len(plain) < 12 or struct.pack("<I", crc32c(plain[:-4])) != plain[-4:]:
                self.n_damaged += 1
            else:
                yield Message(plain)
