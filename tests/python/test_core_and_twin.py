"""Twin and control stepped by hand, and the closed loop."""

import numpy as np
import pytest

import zlg
from zlg import core, rig, twin

SHORT = zlg.Config.of("run.duration_s=30", "switching.interval_s=10")


def test_the_loop_by_hand_is_the_loop_of_the_rig():
    halves = 6000
    loop = rig.ClosedLoop(SHORT).advance(halves)
    gyro, control = twin.Twin(SHORT), core.Control(SHORT)
    actuator = control.initial_actuator()
    counts, turned = [], []
    for _ in range(halves):
        frame, truth = gyro.advance(actuator)
        out = control.step(frame)
        actuator = out.actuator
        counts.append(out.record.counts)
        turned.append(truth.dtheta_arcsec)
    assert np.array_equal(loop.raw.counts, counts)
    assert np.array_equal(loop.truth_dtheta_arcsec, turned)
    assert not loop.raw.loop_closed.all()


def test_pieces_of_a_loop_are_the_whole():
    whole = rig.simulate(SHORT)
    assert len(whole.raw) == 12000
    loop = rig.ClosedLoop(SHORT)
    pieces = [loop.advance(n).raw.counts for n in (1, 4999, 7000)]
    assert np.array_equal(np.concatenate(pieces), whole.raw.counts)


def test_light_is_kept_where_asked():
    light = rig.ClosedLoop(SHORT).advance(10, light=True).raw.light_a
    assert light.shape == (10, SHORT.gyro.light_samples)
    assert rig.ClosedLoop(SHORT).advance(10).raw.light_a is None


def test_motion_of_ones_own():
    config = SHORT.with_(drift={"magnetic_arcsec_s": 0.0, "nonmagnetic_arcsec_s": 0.0})
    run = rig.simulate(config, twin.Motion.sines(100.0, [(50.0, 0.5, 0.0)]))
    # 30 s of 100 arcsec/s; the sine of 0.5 Hz ends after whole periods.
    assert run.truth_dtheta_arcsec.sum() == pytest.approx(3000.0, abs=1e-6)
    angles = core.compensate(run.raw)
    angles.truth_dtheta_arcsec = run.true_tick_arcsec
    assert abs(angles.error_arcsec[-1]) < 40.0  # a few counts of 3.263 arcsec and two switches


def test_motion_is_a_function_of_time():
    motion = twin.Motion.sines(2.0, [])
    assert np.allclose(motion.increment_arcsec([0.0, 1.0], [1.0, 4.0]), [2.0, 6.0])
    assert twin.Motion.from_increments(np.ones(50), 10.0).duration_s == pytest.approx(5.0)
    one = motion.increment_arcsec(0.0, 2.0)
    assert isinstance(one, np.ndarray) and one.shape == () and one == 4.0
    with pytest.raises(ValueError):
        twin.Motion.from_increments([], 10.0)


def test_a_frame_that_cannot_be_obeyed_is_refused():
    gyro = twin.Twin(SHORT)
    actuator = core.Control(SHORT).initial_actuator()
    actuator.polarity = 0
    with pytest.raises(ValueError, match="polarity"):
        gyro.advance(actuator)
    with pytest.raises(ValueError, match="1..16"):
        actuator.set_point_v = np.zeros(17)


def test_flags_have_names():
    assert core.flag_names(core.angle_flags["switching"] | core.angle_flags["invalid"]) == ["switching", "invalid"]
    assert len(core.health_bits) == 32


def test_a_method_needs_its_columns():
    raw = rig.simulate(SHORT).raw
    raw.detuning_sq_lambda2 = None
    assert len(core.compensate(raw, SHORT)) == 6000
    with pytest.raises(zlg.ConfigError, match="detuning_sq_lambda2"):
        core.compensate(raw, SHORT.with_(compensation={"relock": "mean_square"}))


def test_constants_of_the_laser():
    config = rig.calibrated_by_laser(SHORT)
    assert config.perimeter.discriminator_signal and config.gyro.bias_hz != SHORT.gyro.bias_hz


def test_a_log_says_with_what_it_was_recorded():
    raw = rig.simulate(SHORT.with_("gyro.scale_arcsec=1.5")).raw
    assert len(core.compensate(raw)) == 6000
    with pytest.raises(zlg.ConfigError, match=r"gyro.scale_arcsec = 3.263: .* recorded with 1.5"):
        core.compensate(raw, zlg.Config())
    raw.settings = [("scale_arcsec", "1.5"), ("tick_s", "0.005")]
    with pytest.raises(zlg.ConfigError, match="recorded with 1.5"):
        core.compensate(raw, zlg.Config())
    raw.settings.append(("gyro.scale_arcsec", "1.6"))
    with pytest.raises(zlg.ConfigError, match="gyro.scale_arcsec stands twice, as 1.5 and as 1.6"):
        core.compensate(raw)
    raw.settings = [("gyros.tick_s", "0.005")]
    with pytest.raises(zlg.ConfigError, match=r"did you mean \[gyro\]"):
        core.compensate(raw)


def test_a_log_without_facts_is_refused():
    raw = rig.simulate(SHORT.with_("gyro.scale_arcsec=1.5")).raw
    whole = core.compensate(raw)
    raw.settings = [pair for pair in raw.settings if pair[0] not in ("gyro.tick_s", "gyro.scale_arcsec")]
    assert np.isnan(raw.tick_s)
    with pytest.raises(zlg.ConfigError, match="the log: does not say tick_s and scale_arcsec, for which there is no default"):
        core.compensate(raw)
    with pytest.raises(zlg.ConfigError, match="the log: does not say tick_s"):
        core.compensate(raw, zlg.Config())
    with pytest.raises(zlg.ConfigError, match="the log: does not say tick_s, "):
        core.compensate(raw, raw.config.with_(gyro={"scale_arcsec": 1.5}))
    said = raw.config.with_("gyro.tick_s=0.005", "gyro.scale_arcsec=1.5")
    assert np.array_equal(core.compensate(raw, said).dtheta_final_arcsec, whole.dtheta_final_arcsec)
    raw.settings += [("tick_s", "0.005"), ("scale_arcsec", "1.5")]
    assert np.array_equal(core.compensate(raw).dtheta_final_arcsec, whole.dtheta_final_arcsec)


@pytest.mark.parametrize("timer_hz", [0.0, 0.5, np.nan, np.inf])
def test_shifted_edges_need_their_timer(timer_hz):
    raw = rig.simulate(SHORT).raw
    raw.timer_hz = timer_hz
    with pytest.raises(zlg.ConfigError, match="timer_hz"):
        core.compensate(raw)
    raw.edge_offset_ticks = None
    assert len(core.compensate(raw)) == 6000


def test_detunings_are_presumed_to_be_read_with_the_slope_that_is_given():
    config = SHORT.with_(compensation={"relock": "detuning"}, gyro={"discriminator_per_lambda": 2.0})
    straight = {"discriminator_detuning_lambda": [0.1, 0.25], "discriminator_signal": [0.2, 0.5]}
    raw = rig.simulate(config).raw
    linear = core.compensate(raw, config)
    raw.settings = [("tick_s", "0.005"), ("scale_arcsec", "3.263")]
    # The curve of the same slope is no correction: signal = 2 times detuning.
    curved = core.compensate(raw, config.with_(perimeter=straight))
    assert np.allclose(curved.dtheta_final_arcsec, linear.dtheta_final_arcsec, rtol=0, atol=1e-9)
    steeper = core.compensate(raw, config.with_(perimeter=straight, gyro={"discriminator_per_lambda": 1.0}))
    assert not np.allclose(steeper.dtheta_final_arcsec, linear.dtheta_final_arcsec, rtol=0, atol=1e-3)


def test_a_second_curve_is_told_to_be_of_no_use():
    config = SHORT.with_(compensation={"relock": "detuning"})
    curve = {"discriminator_detuning_lambda": [0.1, 0.25], "discriminator_signal": [0.2, 0.5]}
    raw = rig.simulate(config.with_(perimeter=curve)).raw
    other = config.with_(perimeter={**curve, "discriminator_signal": [0.2, 0.4]})
    with pytest.warns(UserWarning, match="a discriminator curve of its own"):
        core.compensate(raw, other)


def test_what_is_left_out_is_told():
    raw = rig.ClosedLoop(SHORT).advance(5).raw
    with pytest.warns(UserWarning, match=r"the last half-period \(4\)") as caught:
        assert len(core.compensate(raw)) == 2
    assert caught[0].filename == __file__
    with pytest.raises(zlg.FormatError, match="no whole tick"):
        core.compensate(rig.ClosedLoop(SHORT).advance(1).raw)
    with pytest.warns(UserWarning, match="no light samples"):
        core.compensate(rig.ClosedLoop(SHORT).advance(4).raw, SHORT.with_(compensation={"relock": "joint"}))


def test_a_loop_is_not_advanced_twice_at_once():
    loop = rig.ClosedLoop(SHORT)
    with pytest.raises(RuntimeError, match="in use by another thread"):
        loop.advance(100, progress=lambda fraction: loop.advance(1))
    assert len(loop.advance(10).raw) == 10


def test_a_twin_that_cannot_be_is_told():
    with pytest.raises(zlg.ConfigError, match="laser"):
        twin.Twin(SHORT.with_("gyro.fidelity=laser", "laser.gain_loss_ratio=1.0001"))
    gyro = twin.Twin(SHORT, twin.Motion.sines(1e25, []))
    with pytest.raises(zlg.ConfigError, match="beyond any counter"):
        gyro.advance(core.Control(SHORT).initial_actuator())
