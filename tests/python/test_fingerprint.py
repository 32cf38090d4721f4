"""The fingerprint of a run, computed anew from what docs/logs.md says of it."""

import math
import pathlib
import re
import struct

import xxhash

import zlg
from zlg import core, study, twin

DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "logs.md"
SHORT = zlg.Config.of("run.duration_s=12", "switching.interval_s=3")
NUMBER = r"`(\w+)`(?: \((f32|f64)[^)]*\))?"
#: a quiet NaN without a sign and without a payload
NAN = {"f32": bytes.fromhex("0000c07f"), "f64": bytes.fromhex("000000000000f87f")}


def documented_numbers():
    """For each record of the table its numbers in their order, as name and kind; of the first table that begins so."""
    text = DOCUMENT.read_text(encoding="utf-8").split("| record | its numbers, in their order |\n|---|---|\n")[1]
    rows = text.split("\n\n")[0].splitlines()
    table = {record.strip(): re.findall(NUMBER, numbers) for _, record, numbers, _ in (row.split("|") for row in rows)}
    assert list(table) == ["sensor frame", "actuator frame", "half record", "truth", "row of the angle log"]
    return table


NUMBERS = documented_numbers()


def as_bytes(value, kind):
    if not kind:
        return (int(value) % 2**64).to_bytes(8, "little")
    return NAN[kind] if math.isnan(value) else struct.pack("<f" if kind == "f32" else "<d", value)


def bytes_of(record, look_up):
    """What stands for a record; a list gives its elements in turn."""
    made = b""
    for name, kind in NUMBERS[record]:
        value = look_up(name)
        made += b"".join(as_bytes(v, kind) for v in (value if hasattr(value, "__len__") else [value]))
    return made


def frame_number(frame, name):
    lengths = {"n_light": len(frame.light_a), "has_light_b": len(frame.light_b) > 0} if hasattr(frame, "light_a") else {
        "n_set_points": len(frame.set_point_v)}
    return lengths[name] if name in lengths else getattr(frame, name)


def chained(pieces):
    digest = 0
    for piece in pieces:
        digest = xxhash.xxh64_intdigest(piece, seed=digest)
    return digest


def halves_by_hand(config, n_halves):
    gyro, control = twin.Twin(config), core.Control(config)
    actuator = control.initial_actuator()
    for _ in range(n_halves):
        sensor, truth = gyro.advance(actuator)
        out = control.step(sensor)
        actuator = out.actuator
        yield (bytes_of("sensor frame", lambda name: frame_number(sensor, name))
               + bytes_of("actuator frame", lambda name: frame_number(actuator, name))
               + bytes_of("half record", lambda name: 0 if name == "0" else getattr(out.record, name))
               + bytes_of("truth", lambda name: getattr(truth, name)))


def fingerprint_by_hand(config, angles):
    halves = chained(halves_by_hand(config, 2 * len(angles)))
    rows = chained(
        bytes_of("row of the angle log", lambda name: k if name == "tick" else getattr(angles, name)[k])
        for k in range(len(angles)))
    return f"{xxhash.xxh64_intdigest(halves.to_bytes(8, 'little') + rows.to_bytes(8, 'little')):016x}"


def test_the_fingerprint_is_what_the_document_says():
    result = study.run(SHORT)
    assert len(result.switches.tick) >= 2
    assert result.fingerprint == fingerprint_by_hand(SHORT, result.angles)


def test_the_same_of_a_gyro_that_is_read_by_phase():
    config = SHORT.with_("gyro.readout=phase", "run.duration_s=4")
    result = study.run(config)
    assert result.fingerprint == fingerprint_by_hand(config, result.angles)


def test_threads_and_what_is_kept_do_not_matter_and_the_seed_does():
    result = study.run(SHORT)
    assert re.fullmatch("[0-9a-f]{16}", result.fingerprint)
    assert study.run(SHORT, threads=2, raw=True, angles=False, page=True).fingerprint == result.fingerprint
    assert study.run(SHORT.with_("run.seed=2")).fingerprint != result.fingerprint
