"""`zlg lab --follow`: the stream holds the records of the source, a slow page costs nobody else anything, and what is asked wrongly is refused."""

import math
import shutil
import signal
import socket
import subprocess
import time
import unittest
from pathlib import Path

import h5py
import numpy
from lab_server import Events, LabServer, Line
from support import ROOT, ZLG, AngleLog, CliTest, folder_until, is_larger, run, wait_until

PAGE = ROOT / "build" / "release" / "share" / "zlg" / "lab.html"


@unittest.skipUnless(PAGE.exists(), "this build holds no lab page")
class LabFollow(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = folder_until(cls.addClassCleanup)
        made = run("simulate", "--duration", 12, "--set", "switching.interval_s=5", "--out", folder / "raw.h5", "--wire", folder / "line.bin")
        assert made.returncode == 0, made.stderr
        for out in ("angles.csv", "angles.h5"):
            assert run("process", folder / "raw.h5", "--out", folder / out).returncode == 0
        cls.log = AngleLog(folder / "angles.csv")
        cls.files = folder
        cls.bytes = (folder / "line.bin").read_bytes()

    def serve(self, source, *options):
        server = LabServer(source, *options)
        self.addCleanup(server.close)
        return server

    n_lines = 0

    def line(self, lasts_s, data=None, **options):
        self.n_lines += 1
        line = Line(self.folder / f"line{self.n_lines}", self.bytes if data is None else data, lasts_s, **options)
        self.addCleanup(line.close)
        return line

    def events(self, server, **options):
        events = Events(server.port, **options)
        self.addCleanup(events.close)
        return events

    def rows_until_the_end(self, events):
        """All rows by their numbers, and the names of the events."""
        rows, names = {}, []
        while True:
            name, news = events.next()
            names.append(name)
            rows.update({news["first"] + k: row for k, row in enumerate(news["rows"])})
            if news["ended"]:
                return rows, names

    def assert_rows_of_the_log(self, rows):
        self.assertEqual(sorted(rows), list(range(len(self.log.rows))))
        angle = 0.0
        for k in range(len(self.log.rows)):
            sigma = self.log.sigma[k] if math.isfinite(self.log.sigma[k]) else None
            self.assertEqual(rows[k][:5], [self.log.dtheta[k], self.log.final[k], sigma, self.log.mode[k], self.log.flags[k]], k)
            angle += self.log.final[k]
            self.assertAlmostEqual(rows[k][5], angle, delta=1e-8)

    def test_the_stream_of_a_line_holds_every_record(self):
        server = self.serve(self.line(2.0, then_ends=True).source)
        rows, names = self.rows_until_the_end(self.events(server))
        self.assert_rows_of_the_log(rows)
        self.assertEqual(names[0], "snapshot")
        self.assertEqual(set(names[1:]), {"rows"})
        self.assertGreater(len(names), 10)

    def test_logs_that_grow_hold_the_same_records(self):
        for log in ("raw.h5", "angles.h5"):
            with self.subTest(log):
                rows, _ = self.rows_until_the_end(self.events(self.serve(self.files / log)))
                self.assert_rows_of_the_log(rows)
                self.assertEqual({row[6] is None for row in rows.values()}, {log == "angles.h5"})

    def test_what_process_warns_of_is_said(self):
        wrong = self.folder / "wrong.h5"
        shutil.copy(self.files / "raw.h5", wrong)
        with h5py.File(wrong, "r+") as file:
            file["/raw/mode"][...] = -file["/raw/mode"][...]
        said = []
        for log in (wrong, self.files / "raw.h5"):
            server = self.serve(log)
            self.rows_until_the_end(self.events(server))
            said.append(server.end()[2])
        in_process = run("process", wrong, "--out", self.folder / "angles.h5").stderr
        warning = [line for line in in_process.splitlines() if "contradict the counts" in line]
        self.assertEqual(len(warning), 1)
        self.assertIn(warning[0], said[0].splitlines())
        self.assertNotIn("warning", said[1])

    def test_a_log_is_followed_while_it_is_written(self):
        # An angle log that a second program of ours records from a line.
        out = self.folder / "growing.h5"
        line = self.line(4.0)
        recorder = self.serve(line.source, "--out", out)
        part = Path(f"{out}.part")
        wait_until(part.exists)
        time.sleep(1.2)  # until it was flushed
        events = self.events(self.serve(part))
        _, first = events.next()
        n = first["first"] + len(first["rows"])
        while n <= 1800:
            _, news = events.next()
            self.assertEqual(news["first"], n)
            n += len(news["rows"])
        self.assertFalse(news["ended"])
        recorder.end()
        while not news["ended"]:
            _, news = events.next()
            n += len(news["rows"])
        # Those that were not settled when the line fell silent come with the end of the log.
        self.assertEqual(n, len(AngleLog(self.converted(out)).rows))

    def test_angles_of_a_raw_log_that_grows_are_those_of_the_complete_one(self):
        raw, part, live, after = (self.folder / name for name in ("raw.h5", "raw.h5.part", "live.h5", "after.h5"))
        writer = subprocess.Popen([ZLG, "simulate", "--duration", "1500", "--out", raw], stdout=subprocess.DEVNULL)
        wait_until(lambda: is_larger(part, 1_000_000), writer)
        # It stands still until the follower has come, or the log might be complete by then.
        writer.send_signal(signal.SIGSTOP)
        server = self.serve(part, "--out", live)
        self.assertTrue(part.exists())
        writer.send_signal(signal.SIGCONT)
        self.assertEqual(writer.wait(), 0)
        wait_until(live.exists)
        self.assertEqual(server.end()[0], 0)
        self.succeed("process", raw, "--out", after)
        with h5py.File(live) as ours, h5py.File(after) as theirs:
            for name in theirs["angles"]:
                self.assertTrue(numpy.array_equal(ours["angles"][name], theirs["angles"][name], equal_nan=True), name)

    def converted(self, log):
        back = self.folder / "back.csv"
        self.succeed("convert", log, "--out", back, "--force")
        return back

    def test_a_late_page_gets_a_snapshot_of_all_and_of_the_last_gap(self):
        server = self.serve(self.files / "angles.h5")
        name, snapshot = self.events(server).next()
        self.assertEqual(name, "snapshot")
        times, angles = snapshot["history"]
        final = self.log.final
        for time_s, angle in zip(times, angles):
            ticks = round(time_s / 0.005)
            self.assertAlmostEqual(angle, math.fsum(final[:ticks]), delta=1e-8)
        self.assertGreater(len(times), 500)
        gap = snapshot["gap"]
        unlocked = [k for k in range(len(final)) if self.log.has(k, "loop_unlocked")]
        first = max(k for k in unlocked if k - 1 not in unlocked)
        self.assertEqual((gap["first"], gap["ticks"]), (first, unlocked[-1] - first + 1))
        self.assertEqual(gap["final"], final[gap["shown"]:gap["shown"] + len(gap["final"])])
        taus, deviations = snapshot["allan"]
        # Overlapping, by its definition.
        for m in (1, 8, 64):
            angle = [0.0]
            for increment in final:
                angle.append(angle[-1] + increment)
            differences = [angle[k + 2 * m] - 2 * angle[k + m] + angle[k] for k in range(len(angle) - 2 * m)]
            expected = math.sqrt(math.fsum(d * d for d in differences) / len(differences) / 2) / (m * 0.005)
            self.assertAlmostEqual(deviations[taus.index(m * 0.005)] / expected, 1.0, delta=1e-9)

    def test_slow_pages_cost_the_reader_and_other_pages_nothing(self):
        waits_s, ends_s = [], []
        for k in range(3):
            line = self.line(3.0, then_ends=True)
            out = self.folder / f"angles{k}.csv"
            server = self.serve(line.source, "--out", out)
            for _ in range(10):
                self.events(server, receive_buffer=2048)  # of which nothing is read
            rows, names = self.rows_until_the_end(self.events(server))
            self.assert_rows_of_the_log(rows)
            waits_s.append(line.longest_wait_s)
            status, _, err, took_s = server.end()
            self.assertEqual((status, err), (0, ""))
            ends_s.append(took_s)
            self.assertEqual(AngleLog(out).rows, self.log.rows)
        # The least of three: other programs may want the processor.
        self.assertLess(min(waits_s), 0.5)
        self.assertLess(min(ends_s), 0.5)

    def test_a_page_that_slept_gets_the_newer_picture(self):
        # Ten times the length of the ring: more than the system keeps for a reader who sleeps.
        gyro_bytes = self.folder / "long.bin"
        self.succeed("simulate", "--duration", 600, "--set", "switching.interval_s=5", "--out", self.folder / "long.h5", "--wire", gyro_bytes)
        server = self.serve(self.line(3.0, gyro_bytes.read_bytes(), then_ends=True).source)
        sleeper = self.events(server, receive_buffer=2048)
        self.assertEqual(sleeper.next()[0], "snapshot")
        time.sleep(5)
        rows, names = self.rows_until_the_end(sleeper)
        self.assertIn("snapshot", names)
        self.assertLess(len(rows), 120_000)
        self.assertEqual(max(rows), 119_999)

    def test_only_the_page_and_its_records_are_given_and_to_this_machine_alone(self):
        server = self.serve(self.files / "line.bin")
        port = server.port
        page = server.get()
        self.assertTrue(page.startswith(b"HTTP/1.1 200 OK\r\n"))
        self.assertIn(b"default-src 'none'; connect-src 'self'; script-src", page)
        self.assertIn(b"frame-ancestors 'none'", page)
        self.assertTrue(server.get(host=f"localhost:{port}").startswith(b"HTTP/1.1 200 "))
        own = f"127.0.0.1:{port}"
        for status, request in (
                (404, f"GET /records/../etc/passwd HTTP/1.1\r\nHost: {own}\r\n\r\n"),
                (405, f"HEAD / HTTP/1.1\r\nHost: {own}\r\n\r\n"),
                (405, f"NONSENSE / HTTP/1.1\r\nHost: {own}\r\n\r\n"),
                (400, f"POST / HTTP/1.1\r\nHost: {own}\r\nContent-Length: 3\r\n\r\nabc"),
                (400, f"GET / HTTP/1.1\r\nHost: {own}\r\nContent-Length: 99999999999999999999\r\n\r\n"),
                (400, f"GET / HTTP/1.1\r\nHost: gyro.example:{port}\r\n\r\n"),
                (400, f"GET /records HTTP/1.1\r\nHost: {own}\r\nOrigin: http://gyro.example\r\n\r\n"),
                (400, f"GET /records HTTP/1.1\r\nHost: {own}\r\nSec-Fetch-Site: cross-site\r\n\r\n"),
                (400, f"GET / HTTP/1.1\r\nHost: {own}\r\nX: {'x' * 20_000}\r\n\r\n"),
                (400, "\0\1\2\3\r\n\r\n")):
            with self.subTest(request[:60]):
                answer = server.ask(request.encode("latin-1"))
                self.assertTrue(answer.startswith(f"HTTP/1.1 {status} ".encode()), answer[:100])
                self.assertNotIn(b"xxxx", answer)
        self.assertIn(b"\r\nAllow: GET\r\n", server.ask(f"PUT / HTTP/1.1\r\nHost: {own}\r\n\r\n".encode()))
        self.assertTrue(server.get().startswith(b"HTTP/1.1 200 OK"))
        # Nobody else's address is listened at.
        with self.assertRaises(OSError):
            socket.create_connection(("127.0.0.2", port), timeout=2).close()

    def test_a_request_that_never_ends_is_ended(self):
        server = self.serve(self.files / "line.bin")
        begun = time.monotonic()
        with socket.create_connection(("127.0.0.1", server.port)) as slow:
            slow.settimeout(0.5)
            ended = False
            while not ended and time.monotonic() < begun + 15:
                try:
                    slow.sendall(b"A")
                    ended = slow.recv(1) == b""
                except TimeoutError:
                    pass
                except ConnectionError:
                    ended = True
        self.assertTrue(ended)
        self.assertLess(time.monotonic() - begun, 8)

    def test_pages_are_many_but_not_without_number(self):
        server = self.serve(self.files / "line.bin")
        pages = [self.events(server) for _ in range(32)]
        for page in pages:
            self.assertEqual(page.next()[0], "snapshot")
        self.assertTrue(self.events(server).head()[0].startswith("HTTP/1.1 503 "))
        # The page itself is still given; and a place that is left is free.
        self.assertTrue(server.get().startswith(b"HTTP/1.1 200 "))
        pages[0].close()
        wait_until(lambda: self.events(server).head()[0].startswith("HTTP/1.1 200 "), most_s=10)
        for _ in range(200):
            socket.create_connection(("127.0.0.1", server.port)).close()
        self.assertTrue(server.get().startswith(b"HTTP/1.1 200 "))

    def test_a_signal_ends_it_within_half_a_second_with_pages_open(self):
        for what, source in ((signal.SIGINT, self.files / "line.bin"), (signal.SIGTERM, self.files / "angles.h5"), (signal.SIGINT, lambda: self.line(5.0).source)):
            ends_s = []
            for _ in range(3):
                server = self.serve(source() if callable(source) else source)
                pages = [self.events(server) for _ in range(5)]
                self.assertEqual(pages[0].next()[0], "snapshot")
                status, _, err, took_s = server.end(what)
                self.assertEqual((status, err), (0, ""))
                ends_s.append(took_s)
            # The least of three: other programs may want the processor.
            self.assertLess(min(ends_s), 0.5)

    def test_a_port_in_use_is_one_line(self):
        server = self.serve(self.files / "line.bin")
        self.refuse(3, "lab", "--follow", self.files / "line.bin", "--port", server.port, says=[str(server.port), "in use", "--port"])

    def test_killed_while_it_records_what_was_flushed_is_there(self):
        for out in ("angles.csv", "angles.h5"):
            with self.subTest(out):
                # A flush is due every half second: in one of three, for other programs may want the processor.
                self.assertTrue(any(self.is_flushed_when_killed(f"{k}-{out}") for k in range(3)))

    def is_flushed_when_killed(self, out):
        """What was recorded is right; does it hold all that a page had 0.7 s before?"""
        line = Line(self.folder / f"line-{out}", self.bytes, 2.0)
        self.addCleanup(line.close)
        server = self.serve(line.source, "--out", self.folder / out)
        events = self.events(server)
        n = 0
        while n < 1500:
            _, news = events.next()
            n = news["first"] + len(news["rows"])
        time.sleep(0.7)
        server.end(signal.SIGKILL)
        part = self.folder / f"{out}.part"
        self.assertFalse((self.folder / out).exists())
        if out.endswith("h5"):
            part = self.converted(part)
        rows = AngleLog(part).rows
        self.assertEqual(rows, self.log.rows[:len(rows)])
        return len(rows) > n

    def test_wrong_usage(self):
        log = self.write("raw.csv", "half,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n")
        self.refuse(2, "lab", "--follow", log, says=["CSV", "HDF5"])
        self.refuse(2, "lab", "--port", 0, "--out", self.folder / "lab.html", says=["--follow"])
        self.refuse(2, "lab", "--follow", self.files / "line.bin", "--port", 70_000, says=["--port"])
        self.refuse(2, "lab", "--follow", self.files / "line.bin", "--json", says=["--json"])
        self.refuse((2, 3), "lab", "--follow", self.files / "line.bin", "--out", self.folder / "x.txt")
        self.refuse(2, "lab", "--follow", self.files / "angles.h5", "--out", self.files / "angles.h5", "--force")
        self.refuse(3, "lab", "--follow", self.folder / "nothing", says=["nothing"])
        self.refuse(2, "lab", "--follow", "", "--out", self.folder / "lab.html", says=["--follow"])
        self.refuse(2, "lab", "--follow", self.files / "line.bin", "--set", "gyro.tick_s=0.01", says=["--set", "line"])
        self.refuse(2, "lab", "--follow", self.files / "angles.h5", "--set", "gyro.tick_s=0.01", says=["--set", "angle log"])
        self.refuse(2, "lab", "--follow", self.files / "angles.h5", "--out", self.folder / "copy.h5", says=["--out", "convert"])
        self.refuse(3, "lab", "--follow", self.write("notes.txt", "no gyro\n"), "--port", 0, says=["notes.txt", "without a tick"])
        timeless = self.folder / "timeless.h5"
        shutil.copy(self.files / "angles.h5", timeless)
        with h5py.File(timeless, "r+") as file:
            del file.attrs["tick_s"]
        self.refuse(3, "lab", "--follow", timeless, says=["timeless.h5", "tick_s"])
        self.refuse(3, "lab", "--follow", self.files / "line.bin", "--out", self.files / "angles.csv", says=["--force"])
