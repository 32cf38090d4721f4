"""`zlg lab --follow` as a test sees it: the program, what a page gets from it, and a line that comes at a gyro's pace."""

import json
import re
import signal
import socket
import subprocess
import threading
import time

from support import ZLG


class Line:
    """A gyro's line at a socket of its own: the bytes in so many seconds, then silence until `close`, or the end."""

    def __init__(self, path, data, lasts_s, then_ends=False):
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(str(path))
        self.listener.listen(1)
        self.source = f"unix:{path}"
        self.data, self.lasts_s, self.then_ends = data, lasts_s, then_ends
        self.closed = threading.Event()
        self.longest_wait_s = 0.0  # of a send
        self.thread = threading.Thread(target=self.feed)
        self.thread.start()

    def feed(self):
        self.listener.settimeout(20)
        try:
            peer, _ = self.listener.accept()
        except OSError:
            return
        with peer:
            begun = time.monotonic()
            sent = 0
            while sent < len(self.data) and not self.closed.is_set():
                due = min(len(self.data), int(len(self.data) * (time.monotonic() - begun) / self.lasts_s) if self.lasts_s else len(self.data))
                before = time.monotonic()
                try:
                    peer.sendall(self.data[sent:due])
                except OSError:
                    return
                self.longest_wait_s = max(self.longest_wait_s, time.monotonic() - before)
                sent = due
                time.sleep(0.02)
            if not self.then_ends:
                self.closed.wait(60)

    def close(self):
        self.closed.set()
        self.listener.close()
        self.thread.join()


class Events:
    """A stream of records: its events, one after the other."""

    def __init__(self, port, receive_buffer=None):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(10)
        self.socket.connect(("127.0.0.1", port))
        self.socket.sendall(f"GET /records HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        self.file = self.socket.makefile("rb")

    def head(self):
        lines = []
        while line := self.file.readline().strip():
            lines.append(line.decode())
        return lines

    def next(self):
        """Name and content of the next event; None at the end."""
        name = None
        while line := self.file.readline():
            if line.startswith(b"event: "):
                name = line[7:].strip().decode()
            elif line.startswith(b"data: "):
                return name, json.loads(line[6:])
        return None

    def close(self):
        self.file.close()
        self.socket.close()


class LabServer:
    def __init__(self, source, *options):
        self.process = subprocess.Popen([str(ZLG), "lab", "--follow", str(source), "--port", "0", *map(str, options)], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.match(r"open (http://127\.0\.0\.1:(\d+)/) in a browser", line)
        if not found:
            self.process.kill()
            raise AssertionError(f"no address: {line!r}; {self.process.communicate()[1]!r}")
        self.address, self.port = found[1], int(found[2])

    def ask(self, request, timeout_s=8):
        """What comes back for these bytes until the connection ends."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout_s) as asking:
            got = b""
            try:
                asking.sendall(request)
                while piece := asking.recv(1 << 16):
                    got += piece
            except ConnectionError:
                pass
            return got

    def get(self, target="/", *fields, host=None):
        host = f"127.0.0.1:{self.port}" if host is None else host
        return self.ask("\r\n".join([f"GET {target} HTTP/1.1", f"Host: {host}", *fields, "", ""]).encode())

    def cpu_s(self):
        """Of the program since its start."""
        fields = open(f"/proc/{self.process.pid}/stat").read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / 100

    def end(self, with_signal=signal.SIGINT):
        """Exit code, standard output and error, and how long it took."""
        begun = time.monotonic()
        self.process.send_signal(with_signal)
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err, time.monotonic() - begun

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
