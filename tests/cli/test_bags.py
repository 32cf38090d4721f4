"""Bags of ROS: MCAP and ROS 1, from writers that are not ours and by hand; and the one that `process` writes."""

import csv
import math
import random
import struct
import unittest

from bag_file import (Mcap, imu_cdr, imu_ros1, mcap, mcap_channel, mcap_chunk, mcap_message, record, rosbag, rosbag_chunk, rosbag_connection, rosbag_message,
                      text)
from support import ROOT, AngleLog, run
from test_import_hostile import Hostile

START = 1_700_000_000 * 10**9
STEP = 5_000_000
ARCSEC = 180 * 3600 / math.pi
# Of @mcap/core 2.2.2 with @foxglove/rosmsg2-serialization, @foxglove/wasm-zstd and lz4js, and of Debian's rosbag 1.15.15: 60 messages on
# /imu/data, 5 ms apart, of the rates below, received 0.3 ms later.
FOREIGN = sorted((ROOT / "tests" / "cli" / "bags").iterdir())


def rate(k, axis):
    return ((k * 37 + axis * 11) % 101 - 50) / 1024


def rates(k):
    return [rate(k, axis) for axis in range(3)]


class Bags(Hostile):
    def bag(self, data, name="a.mcap"):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def turns(self, path, *said, axis="z"):
        return list(self.angles(path, "--map", f"axis=angular_velocity.{axis}", *said).dtheta)

    def assert_rates(self, turns, axis=2, n=60, step=STEP):
        self.assertEqual(len(turns), n)
        for k, turn in enumerate(turns):
            self.assertAlmostEqual(turn, rate(k, axis) * ARCSEC * step * 1e-9, delta=1e-9)

    def refused(self, path, *said, code):
        return self.cheap("import", path, "--map", "axis=angular_velocity.z", "--out", self.folder / "no.csv", *said, code=code).stderr

    def mcap_of(self, *sensors, n=60, **said):
        """Messages of each (topic, frame) by turns."""
        channels = b"".join(mcap_channel(c + 1, topic) for c, (topic, _) in enumerate(sensors))
        messages = b"".join(mcap_message(c + 1, START + k * STEP, imu_cdr(START + k * STEP, frame, rates(k + 5 * c)))
                            for k in range(n) for c, (_, frame) in enumerate(sensors))
        return mcap(channels + messages, **said)


class Read(Bags):
    def test_bags_of_one_record_keep_the_time_between_them(self):
        def part(name, from_s):
            at = [START + from_s * 10**9 + k * STEP for k in range(60)]
            return self.bag(mcap(mcap_channel(1, "/imu") + b"".join(mcap_message(1, ns, imu_cdr(ns, "imu", rates(k))) for k, ns in enumerate(at))), name)

        out = self.folder / "angles.csv"
        said = ("--map", "axis=angular_velocity.z", "--out", out, "--force")
        self.succeed("import", part("a.mcap", 0), part("b.mcap", 100), *said)
        log = AngleLog(out)
        self.assertEqual(len(log.dtheta), 100 * 200 + 60)
        self.assertEqual(self.cheap("import", self.folder / "b.mcap", self.folder / "a.mcap", *said, code=2).stderr.count("begins before"), 1)

    def test_writers_that_are_not_ours(self):
        for path in FOREIGN:
            for axis, name in enumerate("xyz"):
                with self.subTest(path.name, axis=name):
                    self.assert_rates(self.turns(path, axis=name), axis)
            answer = self.succeed("import", path).stdout
            self.assertIn("60 rows", answer)
            self.assertIn("stamp counts from 1700000000.000000000 s on, received from 1700000000.000300000 s on", answer)

    def test_both_orders_of_bytes_and_both_formats(self):
        for order in "<>":
            messages = b"".join(mcap_message(1, k, imu_cdr(START + k * STEP, "a frame", rates(k), order=order)) for k in range(60))
            self.assert_rates(self.turns(self.bag(mcap(mcap_channel(1, "/imu"), mcap_chunk(messages))), "--map", "time=stamp"))
        for frame in ("", "a", "ab", "longer than eight"):
            records = rosbag_connection(3, "/imu") + b"".join(rosbag_message(3, START + k * STEP, imu_ros1(START + k * STEP, frame, rates(k)))
                                                             for k in range(60))
            self.assert_rates(self.turns(self.bag(rosbag(rosbag_chunk(records)), "a.bag")))
            ros1_in_mcap = b"".join(mcap_message(1, START + k * STEP, imu_ros1(START + k * STEP, frame, rates(k))) for k in range(60))
            self.assert_rates(self.turns(self.bag(mcap(mcap_channel(1, "/imu", "sensor_msgs/Imu", "ros1"), ros1_in_mcap))))

    def test_of_several_sensors_one_is_asked_for(self):
        path = self.bag(self.mcap_of(("/a", "a"), ("/b", "b"), ("/c", "c")))
        self.assertIn("holds 3 sensors; --map topic=... says which: '/a' (60 messages), '/b' (60 messages), '/c' (60 messages)", self.refused(path, code=2))
        self.assertIn("has no sensor '/d'", self.refused(path, "--map", "topic=/d", code=2))
        for c, topic in enumerate(("/a", "/b", "/c")):
            turns = self.turns(path, "--map", f"topic={topic}")
            self.assertAlmostEqual(turns[0], rate(5 * c, 2) * ARCSEC * STEP * 1e-9, delta=1e-9)
            self.assertEqual(len(turns), 60)

    def test_two_on_one_topic(self):
        path = self.bag(self.mcap_of(("/imu", "left"), ("/imu", "right")))
        self.assertIn("'/imu@left' (60 messages), '/imu@right' (60 messages)", self.refused(path, code=2))
        self.assert_rates(self.turns(path, "--map", "topic=/imu@left"))
        path = self.bag(self.mcap_of(("/imu", "one"), ("/imu", "one")))
        self.assertIn("'/imu' has messages of several publishers by turns", self.refused(path, code=2))

    def test_a_publisher_that_was_started_anew_goes_on(self):
        data = b"".join(mcap_message(1 + k // 30, START + k * STEP, imu_cdr(START + k * STEP, "imu", rates(k))) for k in range(60))
        self.assert_rates(self.turns(self.bag(mcap(mcap_channel(1, "/imu"), mcap_channel(2, "/imu"), data))))

    def test_stamps_of_the_header_or_of_the_reception(self):
        def made(stamp, received):
            return self.bag(mcap(mcap_channel(1, "/imu"), b"".join(mcap_message(1, START + k * received, imu_cdr(START + k * stamp, "imu", rates(k)))
                                                                   for k in range(60))))
        path = made(0, STEP)
        self.assertIn("stand still; --map time=received", self.refused(path, code=2))
        self.assert_rates(self.turns(path, "--map", "time=received"))
        path = made(STEP, 2 * STEP)
        self.assertIn("come at 200 Hz by their stamps, and were recorded at 100 Hz; --map time=stamp or time=received", self.refused(path, code=2))
        self.assert_rates(self.turns(path, "--map", "time=stamp"))
        self.assert_rates(self.turns(path, "--map", "time=received"), step=2 * STEP)

    def test_messages_that_come_in_bursts(self):
        received = [START + (k // 10 + 1) * 10 * STEP + k % 10 * 1000 for k in range(60)]
        data = b"".join(mcap_message(1, received[k], imu_cdr(START + k * STEP, "imu", rates(k))) for k in range(60))
        self.assert_rates(self.turns(self.bag(mcap(mcap_channel(1, "/imu"), data))))

    def test_missing_messages_are_missing_samples(self):
        there = [k for k in range(60) if k not in (20, 21)]
        data = b"".join(mcap_message(1, START + k * STEP, imu_cdr(START + k * STEP, "imu", rates(k))) for k in there)
        log = self.angles(self.bag(mcap(mcap_channel(1, "/imu"), data)), "--map", "axis=angular_velocity.x")
        self.assertEqual([k for k, flags in enumerate(log.flags) if flags], [20, 21])

    def test_a_rate_that_the_message_says_it_has_not(self):
        none = [-1.0] + [0.0] * 8
        data = b"".join(mcap_message(1, START + k * STEP, imu_cdr(START + k * STEP, "imu", rates(k), none if k == 7 else [0.0] * 9)) for k in range(60))
        log = self.angles(self.bag(mcap(mcap_channel(1, "/imu"), data)), "--map", "axis=angular_velocity.x")
        self.assertEqual([k for k, flags in enumerate(log.flags) if flags], [7])

    def test_no_imu(self):
        path = self.bag(mcap(mcap_channel(1, "/odom", "nav_msgs/msg/Odometry"), mcap_message(1, START, bytes(700))))
        self.assertIn("holds no message of sensor_msgs/Imu; its topics are '/odom' (nav_msgs/Odometry, 1 messages)", self.refused(path, code=3))


class Damaged(Bags):
    def test_cut_anywhere(self):
        """What stands before the cut, with a note that says so, or a refusal."""
        for path in FOREIGN:
            data = path.read_bytes()
            n_read = 0
            for n in range(0, len(data), max(100, len(data) // 80)):
                cut = self.bag(data[:n], "cut" + path.suffix)
                result = run("import", cut, "--map", "axis=angular_velocity.z", "--out", self.folder / "cut.csv", "--force")
                self.assertIn(result.returncode, (0, 2, 3), result.stderr)
                if result.returncode != 0:
                    self.assertEqual(result.stderr.count("\n"), 1)
                    continue
                self.assertRegex(result.stderr, "is cut off|was not closed")
                turns = AngleLog(self.folder / "cut.csv").dtheta
                self.assertGreaterEqual(len(turns), n_read)
                n_read = len(turns)
                self.assert_rates(turns, n=n_read)
            self.assertGreater(n_read, 50)

    def test_one_bit_flipped(self):
        """These have checksums: right, or refused, or cut where a length now leads behind the end."""
        chance = random.Random(11)
        for path in FOREIGN:
            data = path.read_bytes()
            for _ in range(60):
                flipped = bytearray(data)
                at = chance.randrange(len(data))
                flipped[at] ^= 1 << chance.randrange(8)
                result = run("import", self.bag(flipped, "f" + path.suffix), "--map", "axis=angular_velocity.z", "--out", self.folder / "f.csv",
                                          "--force")
                if result.returncode == 0:
                    self.assert_rates(AngleLog(self.folder / "f.csv").dtheta)
                else:
                    self.assertIn(result.returncode, (2, 3))
                    self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_a_bag_that_was_never_closed(self):
        self.assert_rates(self.turns(self.bag(self.mcap_of(("/imu", "imu"), closed=False))))
        records = rosbag_connection(0, "/imu") + b"".join(rosbag_message(0, START + k * STEP, imu_ros1(START + k * STEP, "imu", rates(k))) for k in range(60))
        path = self.bag(rosbag(rosbag_chunk(records), index_at=0), "a.bag")
        self.assert_rates(self.turns(path))
        self.assertIn("was not closed by its recorder", self.succeed("import", path).stdout)

    def test_what_contradicts_itself(self):
        channel, good = mcap_channel(1, "/imu"), imu_cdr(START, "imu", rates(0))
        message = mcap_message(1, START, good)
        for data, why in ((mcap(message), "channel 1, which was not declared before"),
                          (mcap(channel, mcap_channel(1, "/other"), message), "makes channel 1 '/other', which was '/imu'"),
                          (mcap(channel, mcap_message(1, START, good[:-8])), "a field in it goes on behind its end"),
                          (mcap(channel, mcap_message(1, START, good + bytes(8))), "8 bytes behind those of sensor_msgs/Imu"),
                          (mcap(channel, mcap_message(1, START, b"\0\7" + good[2:])), "in form 7 of CDR"),
                          (mcap(channel, mcap_message(1, START, good[:8] + b"\xff" * 4 + good[12:])), "a stamp of 4294967295 ns"),
                          (mcap(channel, mcap_chunk(message, crc=1)), "by its head expected is 00000001"),
                          (mcap(channel, mcap_chunk(message, size=1)), "by its head expected are 1"),
                          (mcap(channel, mcap_chunk(message[:-1])), "goes on behind its end"),
                          (mcap(channel, mcap_chunk(mcap_chunk(message))), "a record of kind 0x06; allowed are 0x03..0x05"),
                          (mcap(channel, mcap_chunk(message, "bz2")), "compressed by 'bz2'; allowed are none, lz4 and zstd"),
                          (mcap(channel, mcap_chunk(message, "zstd")), "damaged data of Zstandard"),
                          (mcap(channel, mcap_chunk(message, "lz4")), "damaged data of LZ4"),
                          (mcap(channel, record(5, bytes(21))), "a message of 21 bytes"),
                          (mcap(channel, message, record(15, bytes(4)), message), "messages behind the end of the data"),
                          (mcap(channel, message + bytes(20)), "a record of kind 0x00"),
                          (mcap(channel, struct.pack("<BQ", 5, 2**63) + message[9:]), "a piece of 9223372036854775786 bytes; allowed are 1048576"),
                          (mcap(channel, message, struct.pack("<BQ", 9, 2**64 - 1)), "goes on behind the end of the file, which is there")):
            with self.subTest(why):
                self.assertIn(why, self.refused(self.bag(data), code=3))

    def test_ros_1_that_contradicts_itself(self):
        connection, message = rosbag_connection(0, "/imu"), rosbag_message(0, START, imu_ros1(START, "imu", rates(0)))
        index = b"".join([text(b"".join(text(f) for f in (b"op=\4", b"conn=" + bytes(4), b"ver=\1\0\0\0", b"count=\2\0\0\0"))), text(bytes(24))])
        for data, why in ((rosbag(message), "channel 0, which was not declared before"),
                          (rosbag(connection, rosbag_chunk(message), index), "has 1 messages; by the index of the bag expected are 2"),
                          (rosbag(connection, rosbag_chunk(message, b"bz2")), "compressed by 'bz2'"),
                          (rosbag(connection, message, index_at=200), "by the head of the bag its index begins at 200"),
                          (rosbag(connection, text(text(b"op"))), "without '='"),
                          (b"#ROSBAG V1.2\n" + bytes(20), "no ROS bag of version 2.0")):
            with self.subTest(why):
                self.assertIn(why, self.refused(self.bag(data, "a.bag"), code=3))

    def test_little_that_unpacks_to_much(self):
        # Blocks that repeat a byte 131072 times.
        block = (131072 << 3 | 1 << 1).to_bytes(3, "little")
        zeros = b"\x28\xb5\x2f\xfd" + b"\x00\x38" + (block + b"\0") * 40_000
        path = self.bag(mcap(mcap_channel(1, "/imu"), mcap_chunk(b"", "zstd", zeros, size=40_000 * 131072)))
        self.assertRegex(self.refused(path, code=3), "kind 0x00")
        skipped = record(3, struct.pack("<H", 9) + text("x") + text("") + text(b""))
        endless = b"\x28\xb5\x2f\xfd" + b"\x00\x38" + (9 << 3).to_bytes(3, "little") + struct.pack("<BQ", 3, 2**50) + (block + b"\0") * 40_000
        path = self.bag(mcap(mcap_channel(1, "/imu"), skipped, mcap_chunk(b"", "zstd", endless, size=2**50)))
        self.assertIn("unpacks to more than a bag of its size may hold", self.refused(path, code=3))

    def test_many_sensors(self):
        data = b"".join(mcap_message(1, START + k, imu_cdr(START + k, f"{k}", rates(k))) for k in range(300))
        self.assertIn("one sensor too many", self.refused(self.bag(mcap(mcap_channel(1, "/imu"), data)), code=3))


class Written(Bags):
    def test_angles_as_messages(self):
        raw, log, bag = self.folder / "raw.h5", self.folder / "a.csv", self.folder / "a.mcap"
        self.succeed("simulate", "--duration", 20, "--set", "switching.interval_s=5", "--out", raw)
        self.succeed("process", raw, "--out", log)
        self.succeed("process", raw, "--out", bag)
        with open(log, encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        made = Mcap(bag.read_bytes())
        self.assertEqual((made.schemas[1][:2], made.channels), (["sensor_msgs/msg/Imu", "ros2msg"], {1: (1, "/imu", "cdr")}))
        self.assertEqual((made.statistics[0], made.statistics[5]), (len(rows), len(made.chunks)))
        self.assertEqual(made.chunk_indexes, sorted(made.chunks))
        self.assertEqual(len(made.messages), len(rows))
        for (_, received, data), row in zip(made.messages, rows):
            self.assertEqual(data[:4], b"\0\1\0\0")
            sec, nanosec, n = struct.unpack_from("<iII", data, 4)
            self.assertEqual(data[16:16 + n], b"zlg\0")
            number = struct.unpack_from("<37d", data, 4 + 16)
            self.assertEqual((number[:4], number[4], number[28]), ((0.0, 0.0, 0.0, 1.0), -1.0, -1.0))  # nothing of orientation and acceleration
            self.assertEqual(sec * 10**9 + nanosec, received)
            self.assertAlmostEqual(received * 1e-9, float(row["t_s"]) - 0.0025, delta=1e-9)
            self.assertTrue(math.isnan(number[13]) and math.isnan(number[14]))
            self.assertEqual(number[16:24], (math.inf, 0.0, 0.0, 0.0, math.inf, 0.0, 0.0, 0.0))
            per_s = 1 / ARCSEC / 0.005
            self.assertAlmostEqual(number[15], float(row["dtheta_final_arcsec"]) * per_s, delta=1e-15)
            self.assertAlmostEqual(number[24] / (float(row["sigma_arcsec"]) * per_s) ** 2, 1.0, delta=1e-12)
        # The axis without rates is not offered, so that nothing is left to ask.
        back = self.angles(bag)
        for turn, row in zip(back.dtheta, rows):
            self.assertAlmostEqual(turn, float(row["dtheta_final_arcsec"]), delta=1e-9)

    def test_what_was_not_measured_is_no_number(self):
        raw = self.write("raw.csv", b"# gyro.tick_s = 0.005\n# gyro.scale_arcsec = 3.263\nhalf,bias_sign,mode,counts,loop_closed,valid\n" +
                         b"".join(b"%d,%d,1,%d,1,%d\n" % (k, 1 - k % 2 * 2, 150 * (1 - k % 2 * 2), k not in (0, 1)) for k in range(80)))
        bag, log = self.folder / "a.mcap", self.folder / "a.csv"
        self.succeed("process", raw, "--out", bag)
        self.succeed("process", raw, "--out", log)
        unrepaired = [flags & 128 != 0 for flags in AngleLog(log).flags]
        values = [struct.unpack_from("<37d", data, 20) for _, _, data in Mcap(bag.read_bytes()).messages]
        self.assertEqual([math.isnan(v[15]) for v in values], unrepaired)
        sigma = AngleLog(log).sigma
        self.assertEqual([math.isinf(v[24]) for v in values], [math.isinf(s) for s in sigma])

    def test_nothing_appears_where_nothing_is_whole(self):
        bag = self.bag(b"mine")
        self.assertNotEqual(run("process", self.write("raw.csv", b"half\n"), "--out", bag, "--force").returncode, 0)
        self.assertEqual(bag.read_bytes(), b"mine")


if __name__ == "__main__":
    unittest.main()
