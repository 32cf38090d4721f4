"""Reads files of MATLAB 5 by the published layout of the format alone (MathWorks, MAT-File Format, chapter 1)."""

import struct

import numpy

NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
CHAR, DOUBLE = 4, 6


def element(data, at):
    """Type and bytes of the data element there, and where the next one is."""
    kind, size = struct.unpack_from("<II", data, at)
    assert kind < 1 << 16, "a small element"
    return kind, data[at + 8:at + 8 + size], at + 8 + (size + 7) // 8 * 8


def matrix(data):
    kind, flags, at = element(data, 0)
    assert kind == 6 and len(flags) == 8
    array_class, is_complex = flags[0], flags[1] & 8
    kind, sizes, at = element(data, at)
    assert kind == 5 and not is_complex
    sizes = struct.unpack(f"<{len(sizes) // 4}i", sizes)
    kind, name, at = element(data, at)
    assert kind == 1
    kind, numbers, at = element(data, at)
    assert at == len(data)
    values = numpy.frombuffer(numbers, "<" + NUMBERS[kind])
    assert len(values) == numpy.prod(sizes)
    if array_class == CHAR:
        assert sizes[0] <= 1
        return name.decode(), values.astype("<u2").tobytes().decode("utf-16-le")
    assert array_class == DOUBLE
    return name.decode(), values.astype(float).reshape(sizes, order="F")


def read_mat(path):
    """Variable by name: matrices as MATLAB would show them, texts as such."""
    data = path.read_bytes()
    assert data.startswith(b"MATLAB 5.0 MAT-file")
    assert data[124:128] == b"\x00\x01IM"  # version 1, little-endian
    variables, at = {}, 128
    while at < len(data):
        kind, content, at = element(data, at)
        assert kind == 14
        name, value = matrix(content)
        assert name not in variables
        variables[name] = value
    return variables
