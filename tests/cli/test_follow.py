"""`zlg follow`: the rows of `process` from a good line, and what it says of a bad one, from every kind of source."""

import json
import os
import pty
import random
import resource
import signal
import socket
import subprocess
import threading
import time
import tty

from line_of import Gyro
from support import AngleLog, CliTest, ZLG, folder_until, run, wait_until


def rows_of(path):
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


class Follow(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = folder_until(cls.addClassCleanup)
        made = run("simulate", "--duration", 25, "--set", "switching.interval_s=10", "--out", folder / "raw.csv",
                   "--wire", folder / "line.bin")
        assert made.returncode == 0, made.stderr
        assert run("process", folder / "raw.csv", "--out", folder / "angles.csv").returncode == 0
        cls.bytes = (folder / "line.bin").read_bytes()
        cls.rows = rows_of(folder / "angles.csv")

    def line(self, data=None):
        path = self.folder / "line.bin"
        path.write_bytes(self.bytes if data is None else data)
        return path

    def followed(self, source, *options, **more):
        out = self.folder / "angles.csv"
        result = run("follow", source, "--out", out, "--force", "--json", *options, **more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout), out

    def test_on_a_full_disk_the_whole_rows_stay(self):
        out = self.folder / "full.csv"
        limit = 100_000
        result = run("follow", self.line(), "--out", out, preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(f"recorded until then: {out}.part", result.stderr)
        self.assertFalse(out.exists())
        kept = (self.folder / "full.csv.part").read_text()
        self.assertTrue(kept.endswith("\n"))
        self.assertGreater(len(kept), limit - 200)
        rows = rows_of(self.folder / "full.csv.part")
        self.assertEqual(rows, self.rows[:len(rows)])

    def test_a_good_line_gives_the_rows_of_process(self):
        said, out = self.followed(self.line())
        self.assertEqual(rows_of(out), self.rows)
        self.assertEqual(said["ticks"], 5000)
        self.assertEqual(said["status_messages"], 25)
        for loss in ("lost_messages", "lost_ticks", "final_lost_ticks", "restarts", "damaged_frames", "refused_messages"):
            self.assertEqual(said[loss], 0, loss)

    def test_hdf5_holds_the_same(self):
        out = self.folder / "angles.h5"
        self.assertEqual(run("follow", self.line(), "--out", out).returncode, 0)
        back = self.folder / "back.csv"
        self.succeed("convert", out, "--out", back)
        self.assertEqual(rows_of(back), self.rows)

    def test_a_hole_loses_no_angle_and_is_told(self):
        said, out = self.followed(self.line(self.bytes[:200_000] + self.bytes[320_000:]))
        self.assertEqual(said["ticks"], 5000)
        self.assertGreater(said["lost_ticks"], 900)
        self.assertLess(said["lost_ticks"], 1000)
        self.assertGreater(said["lost_messages"], 950)
        log = AngleLog(out)
        self.assertIn("lost", log.bits)
        whole = [line.split(",") for line in self.rows[1:]]
        for column, name in ((2, "dtheta_arcsec"), (3, "dtheta_final_arcsec")):
            got = sum(float(line.split(",")[column]) for line in rows_of(out)[1:])
            self.assertAlmostEqual(got, sum(float(row[column]) for row in whole), delta=1e-5, msg=name)
        # The log is one that the other verbs read.
        self.succeed("inspect", out)

    def test_two_starts_are_one_log_that_says_so(self):
        second = b"".join(Gyro(session=2).ticks(500))
        said, out = self.followed(self.line(self.bytes[:300_000] + second))
        self.assertEqual(said["restarts"], 1)
        log = AngleLog(out)
        restarted = [row for row in rows_of(out)[1:] if int(row.split(",")[6]) & log.bits["restarted"]]
        self.assertEqual(len(restarted), 1)

    def test_an_outage_that_is_too_long_for_rows_is_reported(self):
        gyro = Gyro()
        frames = gyro.ticks(100)
        gyro.skip(200_000, 201_000)
        said, out = self.followed(self.line(b"".join(frames + gyro.ticks(100))))
        # The tick that is settled with the first message after it is the first row.
        self.assertEqual((said["ticks"], said["outages"], said["outage_ticks"]), (205, 1, 199_995))
        self.assertEqual(said["angle_arcsec"] + said["outage_arcsec"], 0.25 * 200_200)
        log = AngleLog(out)
        first = [k for k, row in enumerate(rows_of(out)[1:]) if int(row.split(",")[6]) & log.bits["outage"]]
        self.assertEqual(first, [100])

    def test_a_signal_is_heard_while_many_rows_are_written(self):
        gyro = Gyro()
        frames = gyro.ticks(20)
        for _ in range(2000):
            gyro.skip(60_000, 1)
            frames.append(gyro.next())
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            out = self.folder / f"{number}.csv"
            process = subprocess.Popen([ZLG, "follow", self.line(b"".join(frames)), "--out", out, "--json"],
                                       stdout=subprocess.PIPE, text=True)
            time.sleep(1.0)
            self.assertIsNone(process.poll())
            process.send_signal(number)
            said = json.loads(process.communicate(timeout=10)[0])
            self.assertEqual(process.returncode, 0)
            self.assertGreater(said["ticks"], 0)
            self.assertTrue(out.exists())

    def test_the_duration_ends_the_log(self):
        said, out = self.followed(self.line(), "--duration", 2.5)
        self.assertEqual(said["ticks"], 500)
        self.assertEqual(rows_of(out), self.rows[:501])

    def test_noise_is_no_log(self):
        noise = bytes(random.Random(2).randrange(256) for _ in range(10_000))
        out = self.folder / "none.csv"
        result = run("follow", self.line(noise), "--out", out)
        self.assertEqual(result.returncode, 3)
        self.assertIn("not one message", result.stderr)
        self.assertFalse(out.exists())

    def test_usage_and_files_that_are_not_there(self):
        out = self.folder / "a.csv"
        self.assertEqual(run("follow", self.line()).returncode, 2)
        self.assertEqual(run("follow", self.line(), "--out", self.folder / "a.txt").returncode, 2)
        self.assertEqual(run("follow", "tcp:nowhere", "--out", out).returncode, 2)
        self.assertEqual(run("follow", self.line(), "--baud", 12345, "--out", out).returncode, 2)
        self.assertEqual(run("follow", self.line(), "--duration", -1, "--out", out).returncode, 2)
        self.assertEqual(run("follow", self.folder / "absent", "--out", out).returncode, 3)
        self.assertEqual(run("follow", self.folder, "--out", out).returncode, 3)
        self.assertEqual(run("follow", f"unix:{self.folder}/absent", "--out", out).returncode, 3)
        out.write_text("mine")
        self.assertEqual(run("follow", self.line(), "--out", out).returncode, 3)
        self.assertEqual(out.read_text(), "mine")

    def test_of_a_port_that_is_none_nothing_is_asked(self):
        for port in ("99999", "65536", "0", "-1", "", "+80", " 80", "80x", "1e3", "http", "4294967377", "99999999999999999999"):
            for host in ("localhost", "::1", "[::1]"):
                with self.subTest(host=host, port=port):
                    self.refuse(2, "follow", f"tcp:{host}:{port}", "--out", self.folder / "a.csv", says=["PORT in 1..65535"])
        for address in ("tcp:", "tcp::", "tcp::80", "tcp:80", "tcp:[]:80", "tcp:[::1]", "tcp:[::1]80"):
            self.refuse(2, "follow", address, "--out", self.folder / "a.csv", says=["PORT in 1..65535"])

    def test_an_ipv6_address_with_and_without_brackets(self):
        for host in ("[::1]", "::1"):
            with socket.socket(socket.AF_INET6) as server:
                try:
                    server.bind(("::1", 0))
                except OSError:
                    self.skipTest("this machine has no IPv6")
                server.listen()
                self.served(server, f"tcp:{host}:{server.getsockname()[1]}")

    def test_standard_input(self):
        with self.line().open("rb") as source:
            _, out = self.followed("-", stdin=source)
        self.assertEqual(rows_of(out), self.rows)

    def served(self, server, name):
        """What `follow` makes of a socket that sends in pieces and then closes."""
        def serve():
            connection, _ = server.accept()
            with connection:
                for at in range(0, len(self.bytes), 7001):
                    connection.sendall(self.bytes[at:at + 7001])
        thread = threading.Thread(target=serve)
        thread.start()
        try:
            _, out = self.followed(name)
        finally:
            thread.join()
        self.assertEqual(rows_of(out), self.rows)

    def test_a_socket_of_the_network(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            self.served(server, f"tcp:127.0.0.1:{server.getsockname()[1]}")

    def test_a_socket_of_this_machine(self):
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(self.folder / "socket"))
            server.listen()
            self.served(server, f"unix:{self.folder}/socket")

    def test_a_serial_device_until_a_signal_comes(self):
        master, slave = pty.openpty()
        tty.setraw(slave)
        out = self.folder / "serial.csv"
        process = subprocess.Popen([ZLG, "follow", os.ttyname(slave), "--out", out, "--json"], stdout=subprocess.PIPE,
                                   text=True)
        try:
            part = self.folder / "serial.csv.part"
            data = self.bytes[:60_000]
            for at in range(0, len(data), 512):
                os.write(master, data[at:at + 512])
                time.sleep(0.001)
            wait_until(part.exists, process)
            time.sleep(1.0)
            process.send_signal(signal.SIGINT)
            said = json.loads(process.communicate(timeout=20)[0])
        finally:
            process.kill()
            os.close(master)
            os.close(slave)
        self.assertEqual(process.returncode, 0)
        # The last ticks had not been settled yet.
        settled = said["ticks"] - said["final_lost_ticks"]
        self.assertGreater(settled, 400)
        self.assertEqual(rows_of(out)[:settled + 1], self.rows[:settled + 1])
