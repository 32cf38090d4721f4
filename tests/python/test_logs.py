"""Logs in and out."""

import numpy as np
import pytest

import zlg
from zlg.logs import RawLog, kind, read_angles, read_raw, write_angles, write_raw

# The three ticks of the README: 2, 0 and 1 counts of 3.263 arcsec.
COUNTS = np.array([151, -149, 150, -150, 151, -150])


def three_ticks():
    n = len(COUNTS)
    return RawLog(
        counts=COUNTS,
        bias_sign=np.tile([1, -1], n // 2),
        mode=np.ones(n),
        loop_closed=np.ones(n, dtype=bool),
        settings=[("gyro.tick_s", "0.005"), ("gyro.scale_arcsec", "3.263")],
    )


@pytest.mark.parametrize("suffix", ["csv", "h5"])
def test_a_raw_log_comes_back(tmp_path, suffix):
    path = tmp_path / f"raw.{suffix}"
    write_raw(path, three_ticks())
    assert kind(path) == "raw"
    log = read_raw(path)
    assert np.array_equal(log.counts, COUNTS)
    assert log.counts.dtype == np.int64 and log.loop_closed.dtype == np.bool_
    assert log.detuning_lambda is None and log.light_a is None
    assert log.tick_s == 0.005 and log.config.gyro.scale_arcsec == 3.263
    with pytest.raises(zlg.IoError):
        write_raw(path, three_ticks())
    write_raw(path, three_ticks(), force=True)


@pytest.mark.parametrize("suffix", ["csv", "h5"])
def test_an_angle_log_comes_back(tmp_path, suffix):
    angles = zlg.compensate(three_ticks())
    assert np.allclose(angles.dtheta_arcsec, [6.526, 0.0, 3.263], rtol=0, atol=1e-12)
    write_angles(tmp_path / f"angles.{suffix}", angles)
    back = read_angles(tmp_path / f"angles.{suffix}")
    assert np.array_equal(back.dtheta_final_arcsec, angles.dtheta_final_arcsec)
    assert np.array_equal(back.flags, angles.flags)
    assert back.tick_s == 0.005 and back.truth_dtheta_arcsec is None
    assert np.allclose(back.t_s, [0.005, 0.010, 0.015])
    with pytest.raises(ValueError, match="no true angle"):
        back.error_arcsec


def test_light_samples_come_back(tmp_path):
    log = three_ticks()
    log.light_a = np.arange(12, dtype=np.float32).reshape(6, 2)
    log.light_b = log.light_a + 100
    write_raw(tmp_path / "raw.h5", log)
    back = read_raw(tmp_path / "raw.h5")
    assert np.array_equal(back.light_a, log.light_a) and np.array_equal(back.light_b, log.light_b)
    assert read_raw(tmp_path / "raw.h5", light=False).light_a is None


def test_errors_carry_the_place(tmp_path):
    (tmp_path / "raw.csv").write_text("half,bias_sign,mode,counts,loop_closed\n0,1,1,151,1\n1,1,1,-149,1\n")
    with pytest.raises(zlg.FormatError, match=r"raw.csv.*bias_sign") as caught:
        read_raw(tmp_path / "raw.csv")
    assert isinstance(caught.value, ValueError)
    with pytest.raises(FileNotFoundError.__base__, match="none.csv"):
        read_raw(tmp_path / "none.csv")


def test_columns_of_different_lengths_are_refused(tmp_path):
    log = three_ticks()
    log.mode = log.mode[:-1]
    with pytest.raises(ValueError, match="mode"):
        zlg.compensate(log)
    log = three_ticks()
    log.piezo_v = np.zeros((6, 1))
    with pytest.raises(ValueError, match="piezo_v: has 2 dimensions"):
        write_raw(tmp_path / "raw.csv", log)


@pytest.mark.parametrize("version", [1, 2, 3, None])
def test_a_copy_has_the_version_of_its_source(version, tmp_path):
    raw = three_ticks()
    assert raw.format_version == 3
    raw.format_version = version
    angles = zlg.compensate(raw)
    assert angles.format_version == 3
    angles.format_version = version
    write_raw(tmp_path / "raw.h5", raw)
    write_angles(tmp_path / "angles.h5", angles)
    for name, read, write in (("raw", read_raw, write_raw), ("angles", read_angles, write_angles)):
        write(tmp_path / f"{name}.csv", read(tmp_path / f"{name}.h5"))
        write(tmp_path / f"{name}_back.h5", read(tmp_path / f"{name}.csv"))
        for file in (f"{name}.h5", f"{name}.csv", f"{name}_back.h5"):
            assert read(tmp_path / file).format_version == version


BAD_COLUMNS = {
    "a byte's overflow": ("mode", [1, 1, 257, 1, 1, 1], "mode: row 2 holds 257"),
    "no mode": ("mode", [1, 1, 0, 1, 1, 1], r"mode: row 2 holds 0; allowed is \+1 or -1"),
    "a broken count": ("counts", COUNTS + 0.7, "counts: row 0 holds 151.7"),
    "a missing count": ("counts", [1.0, np.nan, 1.0, 1.0, 1.0, 1.0], "counts: row 1 holds nan"),
    "a masked count": ("counts", np.ma.masked_equal(COUNTS, 150), "counts: is a masked array"),
    "too large a count": ("counts", [2**52 + 1, 0, 0, 0, 0, 0], "counts: row 0 holds"),
    "one sign": ("bias_sign", np.ones(6), "bias_sign: row 1: '1' as in the row before; expected -1"),
    "no sign": ("bias_sign", np.zeros(6), "bias_sign: row 0 holds 0"),
    "neither closed nor open": ("loop_closed", [1, 1, 1, 2, 1, 1], "loop_closed: row 3 holds 2"),
    "neither valid nor not": ("valid", [1, 1, 1, 1, 1, 0.5], "valid: row 5 holds 0.5"),
    "half a timer tick": ("edge_offset_ticks", [0, 0.5, 0, 0, 0, 0], "edge_offset_ticks: row 1 holds 0.5"),
    "a span over a half that was not missed": ("span", [1, 1, 2, 1, 1, 1], "span: row 2: '2' is out of range; allowed is 1"),
    "no half": ("span", [1, 0, 1, 1, 1, 1], "span: row 1: '0' is out of range"),
}


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
@pytest.mark.parametrize("name", BAD_COLUMNS)
def test_rows_that_no_reader_would_accept_are_refused(name, tmp_path):
    column, values, reason = BAD_COLUMNS[name]
    log = three_ticks()
    log.timer_hz = 1e7
    setattr(log, column, values)
    for call in (zlg.compensate, lambda raw: write_raw(tmp_path / "raw.csv", raw)):
        with pytest.raises(ValueError, match=reason):
            call(log)


def test_counts_over_missed_halves_are_the_angle(tmp_path):
    log = three_ticks()
    log.counts = np.array([COUNTS[0], COUNTS[1], 0, 0, COUNTS[2:5].sum(), COUNTS[5]])
    log.valid = np.array([True, True, False, False, True, True])
    log.span = np.array([1, 1, 1, 1, 3, 1])
    angles = zlg.compensate(log)
    assert np.isclose(angles.dtheta_final_arcsec.sum(), 3.263 * COUNTS.sum(), rtol=0, atol=1e-9)
    for suffix in ("csv", "h5"):
        write_raw(tmp_path / f"raw.{suffix}", log)
        assert np.array_equal(read_raw(tmp_path / f"raw.{suffix}").span, log.span)


def test_whole_numbers_of_any_type_are_taken():
    log = three_ticks()
    log.counts, log.mode, log.loop_closed = COUNTS.astype(float), [1] * 6, np.ones(6, dtype=np.int64)
    assert np.allclose(zlg.compensate(log).dtheta_arcsec, [6.526, 0.0, 3.263], rtol=0, atol=1e-12)


def test_an_angle_log_of_no_mode_is_refused(tmp_path):
    angles = zlg.compensate(three_ticks())
    angles.mode = np.array([1, 257, 1])
    with pytest.raises(ValueError, match="mode: row 1 holds 257"):
        write_angles(tmp_path / "angles.csv", angles)


def test_what_a_reader_wonders_at_is_told(tmp_path):
    path = tmp_path / "raw.csv"
    path.write_text("half,bias_sign,mode,counts,loop_closed,colour\n0,1,1,151,1,3\n1,-1,1,-149,1,3")
    with pytest.warns(UserWarning) as caught:
        assert len(read_raw(path)) == 2
    assert [str(each.message) for each in caught] == [
        f"{path}:1: the unknown column 'colour' is ignored",
        f"{path}: the last line has no end; the file may have been cut off",
    ]
    assert caught[0].filename == __file__
    angles = tmp_path / "angles.csv"
    write_angles(angles, zlg.compensate(three_ticks()))
    lines = [line + ("" if line.startswith("#") else ",colour" if line.startswith("tick") else ",3")
             for line in angles.read_text().splitlines()]  # fmt: skip
    angles.write_text("\n".join(lines) + "\n")
    with pytest.warns(UserWarning, match="colour"):
        read_angles(angles)


def test_writing_can_be_ended(tmp_path):
    def refuse(fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError):
        write_raw(tmp_path / "raw.h5", three_ticks(), progress=refuse)
    with pytest.raises(LookupError):
        write_angles(tmp_path / "angles.csv", zlg.compensate(three_ticks()), progress=refuse)
    assert list(tmp_path.iterdir()) == []
