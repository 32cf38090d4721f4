"""A gyro's line from Python: the rows of the program, batch by batch, from every kind of source."""

import _thread
import json
import os
import signal
import socket
import subprocess
import threading
import time

import numpy as np
import pytest
from conftest import PACKAGE_DIR, hears_signals

import zlg

PROGRAM = PACKAGE_DIR.parent / "bin" / "zlg"
COLUMNS = ("dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec", "mode", "flags")

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason="the program was not built")


@pytest.fixture(scope="module")
def line(tmp_path_factory):
    """25 s of a gyro, in the middle of which some bytes are missing."""
    folder = tmp_path_factory.mktemp("line")
    command = [PROGRAM, "simulate", "--duration", "25", "--set", "switching.interval_s=10"]
    subprocess.run([*command, "--out", folder / "raw.csv", "--wire", folder / "whole.bin"], check=True, capture_output=True)
    whole = (folder / "whole.bin").read_bytes()
    # 81 ticks: those lost are the ones whose increment did not come again with the settled tick, 53 ticks later, either.
    (folder / "line.bin").write_bytes(whole[:100_000] + whole[110_000:])
    return folder / "line.bin"


def followed_by_program(line, folder, *options):
    command = [PROGRAM, "follow", line, "--out", folder / "angles.h5", "--json", *options]
    said = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return said, zlg.logs.read_angles(folder / "angles.h5")


def assert_equal(ours, theirs):
    for name in COLUMNS:
        assert np.array_equal(getattr(ours, name), getattr(theirs, name)), name


@pytest.mark.parametrize("duration_s", [None, 7.0])
def test_the_same_rows_and_losses_as_the_program(line, duration_s, tmp_path):
    options = [] if duration_s is None else ["--duration", str(duration_s)]
    said, theirs = followed_by_program(line, tmp_path, *options)
    following = zlg.follow(line, duration_s=duration_s)
    ours = following.read()
    assert len(ours) == (5000 if duration_s is None else 1400)
    assert_equal(ours, theirs)
    assert ours.tick_s == theirs.tick_s == 0.005
    assert dict(ours.settings)["flags"] == dict(theirs.settings)["flags"]
    del said["source"], said["angles"]
    assert vars(following.summary()) == said
    if duration_s is None:
        assert said["lost_ticks"] > 0
        assert np.count_nonzero(ours.flags & zlg.line.line_flags["lost"]) == said["lost_ticks"]
    zlg.logs.write_angles(tmp_path / "copy.h5", ours)
    assert_equal(zlg.logs.read_angles(tmp_path / "copy.h5"), theirs)


def test_batches_go_on_from_one_another(line, tmp_path):
    _, theirs = followed_by_program(line, tmp_path)
    batches = list(zlg.follow(line, batch_ticks=700))
    assert [len(batch) for batch in batches] == [700] * 7 + [100]
    assert np.array_equal(np.concatenate([batch.tick for batch in batches]), np.arange(5000))
    assert_equal(zlg.follow(line, batch_ticks=1).read(), theirs)
    assert batches[1].t_s[0] == 701 * 0.005
    assert len(repr(batches[0])) < 1200
    assert list(batches[0].to_pandas().index[:2]) == [0.005, 0.01]
    done = zlg.follow(line)
    assert sum(len(batch) for batch in done) == 5000
    assert list(done) == []


def test_a_socket_gives_batches_while_it_is_open(line, tmp_path):
    data = line.read_bytes()
    with socket.create_server(("127.0.0.1", 0)) as server:
        source = f"tcp:127.0.0.1:{server.getsockname()[1]}"
        with zlg.follow(source, batch_s=0.0) as following:
            connection, _ = server.accept()
            with connection:
                connection.sendall(data[:50_000])
                first = next(following)
                assert len(first) > 0 and first.tick[0] == 0
                following.stop()
                rest = list(following)
        got = sum(len(batch) for batch in (first, *rest))
    assert 0 < got < 5000
    assert [first, *rest][-1].tick[-1] == got - 1


@hears_signals
def test_ctrl_c_ends_the_waiting_and_loses_nothing(line, tmp_path):
    _, theirs = followed_by_program(line, tmp_path)
    data = line.read_bytes()
    ends_s = []
    for k in range(3):
        pipe = tmp_path / f"pipe{k}"
        os.mkfifo(pipe)
        following = zlg.follow(pipe, batch_s=1e6)
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        with open(pipe, "wb", buffering=0) as gyro:
            gyro.write(data[:30_000])
            threading.Timer(0.3, _thread.interrupt_main).start()
            start = time.monotonic()
            with pytest.raises(KeyboardInterrupt):
                next(following)
            ends_s.append(time.monotonic() - start - 0.3)
            signal.signal(signal.SIGINT, before)
            writer = threading.Thread(target=lambda: (gyro.write(data[30_000:]), gyro.close()))
            writer.start()
            ours = following.read()
            writer.join()
        assert_equal(ours, theirs)
    assert min(ends_s) < 0.5  # the least of three: other programs may want the processor


def test_one_thread_at_a_time(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    following = zlg.follow(tmp_path / "pipe", duration_s=1.0)
    with open(tmp_path / "pipe", "wb"):
        waiting = threading.Thread(target=lambda: list(following))
        waiting.start()
        time.sleep(0.3)
        with pytest.raises(RuntimeError, match="this line is in use by another thread"):
            following.summary()
        waiting.join()
    assert following.summary().ticks == 0


def test_refusals_say_what_is_allowed(line, tmp_path):
    for arguments, says in (({"baud": 12345}, "baud 12345: allowed are 9600"), ({"duration_s": -1.0}, "duration -1 s: allowed is up to 1e9 s"),
                            ({"duration_s": float("nan")}, "duration nan s"), ({"batch_ticks": 0}, "batch_ticks = 0: allowed is 1 or more"),
                            ({"batch_s": float("nan")}, "batch_s = nan")):  # fmt: skip
        with pytest.raises(ValueError, match=says):
            zlg.follow(line, **arguments)
    with pytest.raises(ValueError, match="tcp:nowhere: allowed is tcp:HOST:PORT"):
        zlg.follow("tcp:nowhere")
    with pytest.raises(zlg.IoError, match="absent"):
        zlg.follow(tmp_path / "absent")
    (tmp_path / "noise").write_bytes(bytes(range(256)) * 40)
    with pytest.raises(zlg.IoError, match="noise: not one message of a gyro in it"):
        zlg.follow(tmp_path / "noise").read()
