"""Calibration from Python: what the program finds in the same logs, and what is refused."""

import json
import subprocess

import pytest
from conftest import PACKAGE_DIR

import zlg

PROGRAM = PACKAGE_DIR.parent / "bin" / "zlg"
TRUTH = {"gyro.bias_hz": 63e3, "gyro.bias_chi": 4.5, "piezo.half_wave_v": 43.0}
GYRO = [f"{key}={value}" for key, value in TRUTH.items()]
GYRO += ["motion.kind=rest", "switching.interval_s=2", "gyro.light_samples=8"]

# The gyro shifts the edges of its bias, of which every call warns.
pytestmark = pytest.mark.filterwarnings("ignore:.*shifts of the bias edges")


def simulated(seed, *settings):
    return zlg.simulate(zlg.Config.of("run.duration_s=300", f"run.seed={seed}", *GYRO, *settings)).raw


@pytest.fixture(scope="module")
def logs():
    return [simulated(1), simulated(2)]


@pytest.fixture(scope="module")
def files(logs, tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    paths = [folder / "a.h5", folder / "b.csv"]
    for path, log in zip(paths, logs):
        zlg.logs.write_raw(path, log)
    return paths


def said_by_program(*arguments):
    done = subprocess.run([PROGRAM, "calibrate", *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(not PROGRAM.exists(), reason="the program was not built")
@pytest.mark.parametrize("rate", [0.0, 3.0])
def test_the_same_constants_as_the_program(logs, files, rate, tmp_path):
    options = ["--set", "gyro.reference_temperature_c=25", "--out", tmp_path / "theirs.toml"]
    options += ["--rate-arcsec-s", str(rate)] if rate else []
    theirs = json.loads(said_by_program(*files, *options, "--json"))
    config = zlg.Config.of("gyro.reference_temperature_c=25")
    ours = zlg.calibrate(files, config, rate_arcsec_s=rate)
    assert {c.key: {"value": c.value, "sigma": c.sigma, "unit": c.unit} for c in ours.constants} == theirs["constants"]
    assert ours.not_determined == theirs["not_determined"]
    assert {g.name: {"value": g.value, "meaning": g.meaning} for g in ours.goodness} == theirs["goodness"]
    curve = {} if ours.discriminator is None else {name: list(values) for name, values in vars(ours.discriminator).items()}
    assert curve == theirs["discriminator"]
    assert [(log.path, log.duration_s, log.relocks, list(log.temperature_c)) for log in ours.logs] == [
        (log["file"], log["duration_s"], log["relocks"], log["temperature_c"]) for log in theirs["files"]]  # fmt: skip
    assert ours.reference_temperature_c == theirs["reference_temperature_c"] == 25.0
    ours.write(tmp_path / "ours.toml")
    assert (tmp_path / "ours.toml").read_text() == (tmp_path / "theirs.toml").read_text() == ours.to_toml()
    in_memory = zlg.calibrate(logs, config, rate_arcsec_s=rate)
    assert in_memory.to_toml() == ours.to_toml()


def test_finds_the_truth_and_gives_it_to_a_compensation(logs):
    found = zlg.calibrate(logs)
    for key, value in TRUTH.items():
        assert abs(found[key].value - value) < 5.0 * found[key].sigma, key
    given = logs[0].config.with_(*found.settings())
    assert given.gyro.bias_hz == pytest.approx(found["gyro.bias_hz"].value, rel=1e-9)
    assert given.gyro.tick_s == found.tick_s == logs[0].tick_s
    assert len(zlg.compensate(logs[0], given)) == len(logs[0]) // 2
    with pytest.raises(KeyError, match="is no constant"):
        found["gyro.bias"]
    with pytest.raises(KeyError, match="span"):
        zlg.calibrate(simulated(1, "gyro.temperature_rise_c=0"))["gyro.bias_temperature_coefficient_per_c"]
    assert len(repr(found)) < 1200


def test_a_reference_from_afar_is_a_warning(logs):
    cold = simulated(1, "gyro.temperature_rise_c=0")
    with pytest.warns(UserWarning, match="neither determined nor given"):
        found = zlg.calibrate(cold, zlg.Config.of("gyro.reference_temperature_c=60"))
    assert "# warning: gyro.bias_hz" in found.to_toml()
    said = zlg.Config.of("gyro.reference_temperature_c=60", "gyro.bias_temperature_coefficient_per_c=-1e-3")
    carried = zlg.calibrate(cold, said)
    assert carried["gyro.bias_hz"].value == pytest.approx(found["gyro.bias_hz"].value * 0.96, rel=2e-3)


def test_refusals_say_what_where_and_what_is_allowed(logs, files, tmp_path):
    with pytest.raises(zlg.ConfigError, match="rate_arcsec_s nan: allowed is -1e9..1e9"):
        zlg.calibrate(logs, rate_arcsec_s=float("nan"))
    with pytest.raises(zlg.ConfigError, match="a.h5: is named twice"):
        zlg.calibrate([files[0], str(files[0])])
    with pytest.raises(ValueError, match="log 1 is named twice"):
        zlg.calibrate([logs[0], logs[0]])
    with pytest.raises(ValueError, match="is empty"):
        zlg.calibrate([])
    with pytest.raises(zlg.IoError, match="absent"):
        zlg.calibrate(tmp_path / "absent.h5")
    with pytest.raises(zlg.FormatError, match="gyro.tick_s = 0.005 in log 0, 0.01 in log 1"):
        zlg.calibrate([logs[0], simulated(3, "gyro.tick_s=0.01")])
    with pytest.raises(zlg.ConfigError, match="gyro.tick_s"):
        zlg.calibrate(logs, zlg.Config.of("gyro.tick_s=0.01"))
    bare = zlg.logs.RawLog(logs[0].counts, logs[0].bias_sign, logs[0].mode, logs[0].loop_closed)
    with pytest.raises(zlg.ConfigError, match="tick_s"):
        zlg.calibrate(bare)
    with pytest.raises(zlg.IoError, match="exists"):
        found = zlg.calibrate(logs)
        found.write(tmp_path / "c.toml")
        found.write(tmp_path / "c.toml")
    found.write(tmp_path / "c.toml", force=True)


def test_progress_goes_over_all_logs_and_may_end_the_call(files):
    told = []
    zlg.calibrate(files, progress=told.append)
    assert told == sorted(told)
    assert 0.0 < told[0] <= 0.5 < told[-1] <= 1.0

    def refuse(fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        zlg.calibrate(files, progress=refuse)
