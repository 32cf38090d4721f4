"""MCAP files and ROS 1 bags by hand, from https://mcap.dev/spec and http://wiki.ros.org/Bags/Format/2.0; and what stands in an MCAP file."""

import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
NO_COVARIANCE = [0.0] * 9


def text(value):
    data = value.encode() if isinstance(value, str) else value
    return struct.pack("<I", len(data)) + data


def imu_ros1(ns, frame, rates, covariance=NO_COVARIANCE):
    return struct.pack("<III", 7, *divmod(ns, 10**9)) + text(frame) + struct.pack("<37d", 0, 0, 0, 1, *[0.0] * 9, *rates, *covariance, 0, 0, 9.81, *[0.0] * 9)


def imu_cdr(ns, frame, rates, covariance=NO_COVARIANCE, order="<"):
    head = struct.pack(order + "iII", *divmod(ns, 10**9), len(frame) + 1) + frame.encode() + b"\0"
    numbers = struct.pack(order + "37d", 0, 0, 0, 1, *[0.0] * 9, *rates, *covariance, 0, 0, 9.81, *[0.0] * 9)
    return bytes([0, order == "<", 0, 0]) + head + bytes(-len(head) % 8) + numbers


def record(kind, content):
    return struct.pack("<BQ", kind, len(content)) + content


def mcap_channel(number, topic, name="sensor_msgs/msg/Imu", encoding="cdr"):
    schema = struct.pack("<H", number) + text(name) + text("ros2msg") + text("float64 x")
    return record(3, schema) + record(4, struct.pack("<HH", number, number) + text(topic) + text(encoding) + text(b""))


def mcap_message(channel, received_ns, data):
    return record(5, struct.pack("<HIQQ", channel, 0, received_ns, received_ns) + data)


def mcap_chunk(records, compression="", packed=None, size=None, crc=None):
    packed = records if packed is None else packed
    return record(6, struct.pack("<QQQI", 0, 0, len(records) if size is None else size, zlib.crc32(records) if crc is None else crc) + text(compression) +
                  struct.pack("<Q", len(packed)) + packed)


def mcap(*data, closed=True):
    """Records as a file: with neither checksum nor index behind them."""
    head = MAGIC + record(1, text("ros2") + text("by hand")) + b"".join(data)
    return head + (record(15, bytes(4)) + record(2, bytes(20)) + MAGIC if closed else b"")


def fields(**values):
    return b"".join(text(name.encode() + b"=" + value) for name, value in values.items())


def rosbag_record(header, data):
    return text(header) + text(data)


def rosbag_connection(number, topic, name="sensor_msgs/Imu"):
    return rosbag_record(fields(op=b"\7", conn=struct.pack("<I", number), topic=topic.encode()), fields(topic=topic.encode(), type=name.encode()))


def rosbag_message(number, received_ns, data):
    return rosbag_record(fields(op=b"\2", conn=struct.pack("<I", number), time=struct.pack("<II", *divmod(received_ns, 10**9))), data)


def rosbag_chunk(records, compression=b"none", packed=None):
    return rosbag_record(fields(op=b"\5", compression=compression, size=struct.pack("<I", len(records))), records if packed is None else packed)


def rosbag(*data, index=b"", index_at=None):
    """Records as a bag; `index_at` 0 as of one that was not closed."""
    body = b"".join(data)
    magic = b"#ROSBAG V2.0\n"
    counts = {"conn_count": bytes(4), "chunk_count": bytes(4)}
    at = len(magic) + len(rosbag_record(fields(op=b"\3", index_pos=bytes(8), **counts), b"")) + len(body)
    return magic + rosbag_record(fields(op=b"\3", index_pos=struct.pack("<Q", at if index_at is None else index_at), **counts), b"") + body + index


class Mcap:
    """Every record of a file, with its checksums, offsets and counts held against one another."""

    def __init__(self, data):
        assert data.startswith(MAGIC) and data.endswith(MAGIC)
        self.messages = []  # (channel, time, bytes)
        self.schemas, self.channels = {}, {}
        self.chunks, self.chunk_indexes = {}, []
        self.statistics = None
        self.data = data
        self.walk(data, len(MAGIC), len(data) - len(MAGIC))

    def walk(self, data, at, end, chunk=None):
        while at < end:
            kind, size = struct.unpack_from("<BQ", data, at)
            content = data[at + 9:at + 9 + size]
            assert len(content) == size
            self.take(kind, content, at, chunk)
            at += 9 + size
        assert at == end

    def texts(self, content, n):
        found = []
        for _ in range(n):
            size, = struct.unpack_from("<I", content)
            found.append(content[4:4 + size])
            content = content[4 + size:]
        return found

    def take(self, kind, content, at, chunk):
        if kind == 3:
            self.schemas[struct.unpack_from("<H", content)[0]] = [part.decode() for part in self.texts(content[2:], 3)]
        elif kind == 4:
            number, schema = struct.unpack_from("<HH", content)
            self.channels[number] = (schema, *(part.decode() for part in self.texts(content[4:], 2)))
        elif kind == 5:
            channel, _, received, sent = struct.unpack_from("<HIQQ", content)
            assert received == sent
            self.messages.append((channel, received, content[22:]))
            self.chunks[chunk].append((received, at))
        elif kind == 6:
            first, last, size, crc = struct.unpack_from("<QQQI", content)
            assert content[28:32] == bytes(4)  # not compressed
            records = content[40:]
            assert struct.unpack_from("<Q", content, 32)[0] == size == len(records) and zlib.crc32(records) == crc
            self.chunks[at] = []
            self.walk(records, 0, len(records), at)
            assert (first, last) == (self.chunks[at][0][0], self.chunks[at][-1][0])
        elif kind == 7:
            chunk = max(self.chunks)
            channel, size = struct.unpack_from("<HI", content)
            assert channel == 1 and size == len(content) - 6
            assert list(struct.iter_unpack("<QQ", content[6:])) == self.chunks[chunk]
            self.message_index = (at, len(content) + 9)
        elif kind == 8:
            first, last, start, size, n, _, index, index_size = struct.unpack_from("<QQQQIHQQ", content)
            assert n == 10 and (first, last) == (self.chunks[start][0][0], self.chunks[start][-1][0])
            assert self.data[start] == 6 and struct.unpack_from("<Q", self.data, start + 1)[0] + 9 == size
            assert self.data[index] == 7 and struct.unpack_from("<Q", self.data, index + 1)[0] + 9 == index_size
            self.chunk_indexes.append(start)
        elif kind == 11:
            self.statistics = struct.unpack_from("<QHIIIIQQI", content)
            assert content[-10:] == struct.pack("<HQ", 1, self.statistics[0])
        elif kind == 15:
            assert struct.unpack("<I", content)[0] == zlib.crc32(self.data[:at])
            self.index_at = at + 13
        elif kind == 2:
            summary, offsets, crc = struct.unpack("<QQI", content)
            assert (summary, offsets) == (self.index_at, 0) and crc == zlib.crc32(self.data[summary:at + 9 + 16])
