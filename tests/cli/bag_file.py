"""MCAP files and ROS 1 bags by hand, from https://mcap.dev/spec and http://wiki.ros.org/Bags/Format/2.0."""

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
