#!/usr/bin/env python3
"""What `zlg lab --follow` costs at real time: the share of a processor core, with so many pages that read all.

usage: bench/lab_follow.py [SECONDS [PAGES]]

A gyro's line of the default configuration (200 ticks a second) comes over a socket at its pace; the log is recorded meanwhile.
"""

import sys
import tempfile
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

from lab_server import Events, LabServer, Line  # noqa: E402
from support import run  # noqa: E402


def read_all(events, read):
    try:
        while piece := events.socket.recv(1 << 16):
            read[0] += len(piece)
    except OSError:
        pass


def main(seconds=60.0, pages=10):
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        made = run("simulate", "--duration", seconds + 2, "--out", folder / "raw.h5", "--wire", folder / "line.bin")
        if made.returncode != 0:
            sys.exit(made.stderr)
        line = Line(folder / "line", (folder / "line.bin").read_bytes(), seconds + 2, then_ends=True)
        server = LabServer(line.source, "--out", folder / "angles.h5")
        streams = [Events(server.port) for _ in range(pages)]
        read = [0]
        readers = [threading.Thread(target=read_all, args=(events, read)) for events in streams]
        for reader in readers:
            reader.start()
        before_s = server.cpu_s()
        line.closed.wait(seconds)
        used_s = server.cpu_s() - before_s
        server.end()
        for reader in readers:
            reader.join()
        line.close()
    print(f"{pages} pages, {seconds:g} s: {100 * used_s / seconds:.2f} % of a core, {read[0] / seconds / max(pages, 1) / 1024:.1f} kB/s a page")


if __name__ == "__main__":
    main(*(kind(word) for kind, word in zip((float, int), sys.argv[1:])))
