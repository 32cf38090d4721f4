"""The image of the product under power in the emulator, and a host at its serial line. ZLG_BUILD names the folder of the build."""

import fcntl
import json
import os
import select
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import gyro_line as line
from gyro_line import READ_STATE, REPLY, STATUS, TELEMETRY

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("ZLG_BUILD", ROOT / "build" / "release")).resolve()
IMAGE = BUILD / "firmware" / "zlg_gyro.elf"
ZLG = BUILD / "bin" / "zlg"
PATIENCE_S = 20.0  # of this machine under load; in the emulator all is done within some ticks
F_SETPIPE_SZ = 1031  # of Linux; older modules do not name it


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

    def repeat(self, sequence, code):
        self.send(line.command(self.session, sequence, code))
        return self.listen_until(lambda m: m.kind == REPLY and (m.to_session, m.to_sequence) == (self.session, sequence))

    def load(self, data, ends=True):
        """The reply to the piece that ends it, or without it to the last one."""
        for at in [*range(0, len(data), line.PIECE_BYTES), *[len(data)] * ends]:
            self.sequence += 1
            self.send(line.piece(self.session, self.sequence, at, data[at:at + line.PIECE_BYTES]))
            reply = self.listen_until(lambda m: m.kind == REPLY and m.to_sequence == self.sequence)
            if reply.result:
                break
        return reply

    def ask(self, code):
        self.sequence += 1
        return self.repeat(self.sequence, code)

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
        self.assertEqual((reply.result, reply.part, reply.fault), (line.DONE, 0, 0))
