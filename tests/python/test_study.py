"""The main experiment from Python: the same bits as the program, progress, interruption, threads."""

import _thread
import json
import signal
import subprocess
import threading
import time

import numpy as np
import pytest
from conftest import PACKAGE_DIR, hears_signals

import zlg

SHORT = zlg.Config.of("run.duration_s=120", "switching.interval_s=15")
PROGRAM = PACKAGE_DIR.parent / "bin" / "zlg"


@pytest.mark.skipif(not PROGRAM.exists(), reason="the program was not built")
def test_the_same_bits_as_the_program(tmp_path):
    sets = ["--set", "run.duration_s=120", "--set", "switching.interval_s=15"]
    command = [PROGRAM, "run", *sets, "--json", "--out", tmp_path / "run"]
    program = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    result = zlg.run(SHORT, raw=True)
    assert [v["name"] for v in program["variants"]] == [v.name for v in result.variants]
    assert [v["drift_arcsec_s"] for v in program["variants"]] == [v.drift_arcsec_s for v in result.variants]
    raw = zlg.logs.read_raw(tmp_path / "run" / "raw.h5")
    angles = zlg.logs.read_angles(tmp_path / "run" / "angles.h5")
    assert np.array_equal(raw.counts, result.raw.counts) and np.array_equal(raw.piezo_v, result.raw.piezo_v)
    for name in ("tick", "mode", "miss_lambda", "gap_ticks", "dp_arcsec", "relock_arcsec", "sigma_arcsec"):
        ours = getattr(zlg.compensate(raw).switches, name)
        assert len(ours) == 7 and np.array_equal(ours, getattr(result.switches, name))
    for log in (result.angles, zlg.compensate(raw)):
        assert np.array_equal(angles.dtheta_final_arcsec, log.dtheta_final_arcsec)
        assert np.array_equal(angles.flags, log.flags)
        assert log.settings == [pair for pair in angles.settings if "." in pair[0]]
    assert np.array_equal(zlg.simulate(SHORT).raw.counts, raw.counts)
    assert result.raw.settings == [pair for pair in raw.settings if "." in pair[0]]


POINTS = ("perimeter.discriminator_detuning_lambda=[0.1,0.2,0.3]", "perimeter.discriminator_signal=[0.033,0.07,0.12]")


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.skipif(not PROGRAM.exists(), reason="the program was not built")
@pytest.mark.parametrize("recorded", [(), POINTS], ids=["by the slope", "by a curve"])
@pytest.mark.parametrize("asked", [(), POINTS, (*POINTS[:1], "perimeter.discriminator_signal=[0.033,0.08,0.15]")])
@pytest.mark.parametrize("relock", ["detuning", "mean_square", "joint"])
def test_the_same_angles_of_a_log_as_the_program_whatever_curve_it_has(recorded, asked, relock, tmp_path):
    config = zlg.Config.of("run.duration_s=20", "switching.interval_s=5", *recorded)
    zlg.logs.write_raw(tmp_path / "raw.h5", zlg.simulate(config, light=True).raw)
    asked = (*asked, f"compensation.relock={relock}")
    sets = [word for setting in asked for word in ("--set", setting)]
    command = [PROGRAM, "process", tmp_path / "raw.h5", *sets, "--out", tmp_path / "angles.h5"]
    subprocess.run(command, check=True, capture_output=True)
    theirs = zlg.logs.read_angles(tmp_path / "angles.h5")
    raw = zlg.logs.read_raw(tmp_path / "raw.h5")
    ours = zlg.compensate(raw, raw.config.with_(*asked))
    assert np.array_equal(theirs.dtheta_final_arcsec, ours.dtheta_final_arcsec)
    assert np.array_equal(theirs.sigma_arcsec, ours.sigma_arcsec)
    assert ours.settings == [pair for pair in theirs.settings if "." in pair[0]]


LASER = ("gyro.fidelity=laser", "laser.perimeter_m=0.12")


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.skipif(not PROGRAM.exists(), reason="the program was not built")
@pytest.mark.parametrize(
    "settings",
    [
        (),
        LASER,
        (*LASER, "perimeter.loop=digital", "perimeter.relock_halves=4", "laser.quadrature=x4"),
        (*LASER, "gyro.bias_hz=79766.7", "motion.kind=rest"),
        (*LASER, "gyro.bias_chi=3.6"),
        (*LASER, "switching.interval_s=optimal", "drift.magnetic_arcsec_s=3"),
        ("switching.interval_s=optimal", "compensation.relock=detuning", "compensation.bridge=constant"),
        ("compensation.magnetic=estimate", "drift.magnetic_arcsec_s=14", "motion.kind=rest"),
    ],
)
def test_the_same_numbers_as_the_program_whatever_is_configured(settings, tmp_path):
    settings = ("run.duration_s=40", "switching.interval_s=8", *settings)
    sets = [word for setting in settings for word in ("--set", setting)]
    command = [PROGRAM, "run", *sets, "--json", "--out", tmp_path / "run"]
    # 1 where more than one switch in ten failed, as of the short laser with a fast re-lock.
    done = subprocess.run(command, check=False, capture_output=True)
    assert done.returncode in (0, 1), done.stderr
    program = json.loads(done.stdout)
    result = zlg.run(zlg.Config.of(*settings))
    members = {
        "drift_arcsec_s": "drift_arcsec_s",
        "drift_without_nonmagnetic_arcsec_s": "drift_without_nonmagnetic_arcsec_s",
        "angle_error_arcsec": "angle_error_arcsec",
        "angle_error_without_nonmagnetic_arcsec": "angle_error_without_nonmagnetic_arcsec",
        "switch_error_mean_arcsec": "switch_mean_arcsec",
        "switch_error_rms_arcsec": "switch_rms_arcsec",
        "switch_error_max_arcsec": "switch_max_arcsec",
    }
    for theirs, ours in zip([*program["variants"], program["magnetic_estimate"]], [*result.variants, result["magnetic_estimate"]]):
        assert theirs["name"] == ours.name
        assert {key: theirs[key] for key in members} == {key: getattr(ours, name) for key, name in members.items()}
    assert program["switches"] == len(result.switches.tick) and program["switches"] > 0
    assert program["switches_failed"] == result.switches_failed
    assert program["warnings"] == result.warnings
    assert program["what_happened"] == result.what_happened
    assert program["ticks_invalid"] == result.ticks_invalid
    assert program["relock_false_drift_deg_h"] == list(result.relock_false_drift_deg_h)


def test_a_contradiction_of_the_laser_is_a_warning():
    config = zlg.Config.of("run.duration_s=10", "switching.interval_s=4", *LASER, "gyro.bias_chi=3.6")
    with pytest.warns(UserWarning, match=r"gyro.bias_chi = 3.6 is presumed, \[laser\] makes 6.37"):
        assert any("6.37" in line for line in zlg.run(config).warnings)
    with pytest.warns(UserWarning, match="6.37"):
        zlg.simulate(zlg.Config.of("run.duration_s=10", *LASER).with_(gyro={"bias_chi": 3.6}))


def test_a_run_in_which_no_switch_succeeds_says_so():
    # Half a wavelength takes twice what is presumed.
    config = zlg.Config.of("run.duration_s=20", "switching.interval_s=5", "perimeter.miss_lambda=0", "piezo.half_wave_error=-0.5")
    result = zlg.run(config)
    assert result.none_succeeded and result.switches_failed > 0
    assert not zlg.run(SHORT).none_succeeded


def test_what_comes_back_fits_together():
    result = zlg.run(SHORT, page=True)
    configured = result["configured"]
    assert configured.error_arcsec[-1] == pytest.approx(configured.angle_error_arcsec, abs=5.0)
    assert result.angles.error_arcsec[-1] == pytest.approx(configured.angle_error_arcsec, abs=1e-6)
    assert not configured.t_s.flags.owndata  # the memory is that of C++
    assert len(result.switches.tick) == 7 and len(result.angles) == result.ticks == 24000
    assert result["one_mode"].switch_rms_arcsec is None
    assert abs(configured.switch_rms_arcsec) < abs(result["switching"].switch_rms_arcsec)
    assert result.raw is None and "<html" in result.page
    with pytest.raises(KeyError, match="configured"):
        result["best"]


def test_progress_rises_to_the_end():
    program = []
    zlg.run(SHORT, progress=program.append)
    assert len(program) > 2 and program == sorted(program) and 0 <= program[0] and program[-1] <= 1


def test_an_exception_of_progress_ends_the_run():
    def refuse(fraction):
        raise LookupError("enough")

    for call in (zlg.run, zlg.simulate):
        with pytest.raises(LookupError, match="enough"):
            call(SHORT, progress=refuse)
    with pytest.raises(LookupError):
        zlg.compensate(zlg.simulate(SHORT).raw, progress=refuse)
    with pytest.raises(LookupError):
        zlg.study.analyze([zlg.study.Axis("x", 1.0, np.arange(100.0))], progress=refuse)


@hears_signals
def test_ctrl_c_ends_a_long_call():
    # A script in the background ignores it, and so does what it starts.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.1, _thread.interrupt_main).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        zlg.simulate(zlg.Config.of("run.duration_s=36000"))
    signal.signal(signal.SIGINT, before)
    assert time.monotonic() - start < 5.0  # the whole run takes longer


def test_other_threads_run_meanwhile():
    task = threading.Thread(target=zlg.run, args=(zlg.Config.of("run.duration_s=1200"),))
    turns = 0
    task.start()
    while task.is_alive():
        time.sleep(0.001)
        turns += 1
    assert turns > 50


def test_a_run_that_cannot_be_is_told():
    with pytest.raises(zlg.ConfigError, match="duration_s"):
        zlg.run(zlg.Config(run=zlg.config.Run(duration_s=1e-9)))
    with pytest.raises(zlg.Error, match="none.txt"):
        zlg.run(zlg.Config.of("motion.kind=file", "motion.path=none.txt"))


def test_an_axis_is_analyzed():
    angles = zlg.run(SHORT.with_("motion.kind=rest")).angles
    axis = zlg.study.axis_of_log(angles)
    result = zlg.study.analyze([axis], zlg.Config.of("analysis.deviations=[\"oadev\", \"mdev\"]"))
    (program,) = result.axes
    assert program.n_samples == len(angles) and program.n_known == angles.measured.sum() and program.n_gaps == 7
    assert [d.kind for d in program.deviations] == ["oadev", "mdev"]
    by_hand = zlg.analysis.deviations_of_log(angles, taus=[0.005])
    assert program.deviations[0].deviation[0] == pytest.approx(by_hand.deviation[0], rel=1e-9)
    assert program.fit is not None and "<html" in result.page
    assert {d.kind for d in program.mode_curves} == {"oadev"} and len(program.mode_curves) == 3
    assert len(program.modes.switch_time_s) == 7 and program.modes.magnetic[0] == pytest.approx(0.7, abs=0.3)
    assert program.readouts[0].tau_s == pytest.approx(1.0) and result.earth == []
    axis.rates_arcsec_s = np.full(100, np.nan)
    axis.mode = axis.bridged_arcsec_s = None
    with pytest.raises(zlg.SeriesError, match="gyro"):
        zlg.study.analyze([axis])


def test_three_axes_see_the_earth():
    random = np.random.default_rng(9)
    means = [2.0, -10.0, 11.0]  # their norm is 15 arcsec/s
    axes = [zlg.study.Axis(f"{k}", 10.0, mean + random.normal(0.0, 1.0, 10_000), group="box") for k, mean in enumerate(means)]
    (earth,) = zlg.study.analyze(axes).earth
    assert (earth.group, earth.n_axes) == ("box", 3)
    assert abs(earth.norm_arcsec_s - 15.0) < 5 * earth.sigma_arcsec_s < 0.5
    axes[0].rates_arcsec_s = np.ma.masked_array(axes[0].rates_arcsec_s, np.arange(10_000) < 100)
    assert zlg.study.analyze(axes).axes[0].n_known == 9900
