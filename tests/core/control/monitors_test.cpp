#include "control/monitors.hpp"

#include "support.hpp"

namespace zlg::core::monitors_test {

struct Half {
    GyroControlConfig config{};
    GyroControlState state{};
    Observation seen{};
};

// One in which nothing is reported: received, lit, of a gyro that follows its set-point.
Half quiet() {
    Half h;
    h.config.commutator.dither.method = DitherMethod::none;
    h.seen.received = true;
    h.seen.order.fresh = true;
    h.seen.lit = true;
    h.seen.light.readable = true;
    h.seen.light.two_way = true;
    h.seen.piezo = Volts{150.0};
    h.seen.temperature_c = 20.0;
    return h;
}

void expect(std::uint32_t bits, Loses lost, const std::function<void(Half&)>& change, const char* what) {
    Half h = quiet();
    change(h);
    EXPECT_EQ(health_word(h.config, h.state, h.seen), bits) << what;
    EXPECT_EQ(loses<Loses::light>(h.config, h.state, h.seen), lost == Loses::light) << what;
    EXPECT_EQ(loses<Loses::counts>(h.config, h.state, h.seen), lost == Loses::counts) << what;
}

// As a macro, so that a failure shows the change.
#define EXPECT_SEEN(bits, lost, ...)              \
    expect(                                       \
        bits, Loses::lost,                        \
        [](Half& h) {                             \
            [[maybe_unused]] auto& [c, s, o] = h; \
            __VA_ARGS__;                          \
        },                                        \
        #__VA_ARGS__)

TEST(Monitors, NothingIsReportedOfAQuietHalf) { EXPECT_SEEN(0u, nothing, ); }

TEST(Monitors, FramesAndEchoes) {
    EXPECT_SEEN(health_frame_missed, nothing, o.received = false);
    EXPECT_SEEN(health_sequence_error, nothing, o.order.error = true);
    EXPECT_SEEN(health_sign_error, counts, o.commuted.sign_error = true);
    EXPECT_SEEN(health_timer_error, nothing, o.commuted.timer_error = true);
    EXPECT_SEEN(health_echo_error, nothing, o.echo_error = true);
    EXPECT_SEEN(0u, counts, o.commuted.latch_error = true);
    EXPECT_SEEN(0u, counts, o.polarity_error = true);
}

// Of a frame that is not fresh no measurement is reported.
TEST(Monitors, Measurements) {
    EXPECT_SEEN(health_piezo_not_finite, nothing, o.piezo = Volts{not_a_number});
    EXPECT_SEEN(health_temperature_not_finite, nothing, o.temperature_c = not_a_number);
    EXPECT_SEEN(health_light_lost, nothing, o.light.two_way = false);
    EXPECT_SEEN(health_light_unusable, nothing, o.light.readable = false);
    EXPECT_SEEN(health_light_unusable, nothing, o.light.readable = o.light.two_way = false);
    EXPECT_SEEN(0u, nothing, o.order.fresh = false);
    EXPECT_SEEN(0u, nothing, o.order.fresh = false; o.piezo = Volts{not_a_number}; o.temperature_c = not_a_number);
    EXPECT_SEEN(0u, nothing, o.order.fresh = o.light.two_way = false);
    EXPECT_SEEN(0u, nothing, o.order.fresh = o.light.readable = false);
}

TEST(Monitors, Light) {
    EXPECT_SEEN(0u, counts, o.lit = false);
    EXPECT_SEEN(0u, counts, o.monitored.returns = true);
    EXPECT_SEEN(health_light_stuck, light, o.monitored.stuck = true);
    EXPECT_SEEN(health_light_noisy, light, o.monitored.noisy = true);
    EXPECT_SEEN(health_light_noisy, nothing, o.monitored.withheld = true);
    EXPECT_SEEN(health_light_unbalanced, light, o.monitored.unbalanced = true);
    EXPECT_SEEN(0u, light, o.monitored.unbalanced = true; s.light_balance.n_ticks = 1.0);  // it is learnt yet
    EXPECT_SEEN(health_light_unbalanced, nothing, s.light_balance.changes = true; s.light_balance.n_ticks = 1.0);
    EXPECT_SEEN(health_light_contradicted, light, o.monitored.contradicted = true);
}

TEST(Monitors, DetuningAndCounter) {
    EXPECT_SEEN(health_detuning_unsteady, counts, o.unsteady = true);
    EXPECT_SEEN(health_detuning_over_limit, nothing, o.over_limit = true);
    EXPECT_SEEN(health_counter_jump, counts, o.beyond = true);
    EXPECT_SEEN(health_counter_jump | health_rate_over_range, counts, o.beyond = s.was_beyond = true);
    EXPECT_SEEN(0u, nothing, s.was_beyond = true);
    EXPECT_SEEN(health_counter_bit_stuck, counts, o.bit_stuck = true);
}

// What is said of the bias rests on a beat: on a lit half in a closed loop.
TEST(Monitors, BiasAndCoil) {
    EXPECT_SEEN(health_bias_lost, counts, o.bias_wrong = true);
    EXPECT_SEEN(0u, nothing, o.lased = true);
    EXPECT_SEEN(0u, nothing, o.bias.reversed = o.bias.near_rate = true);
    EXPECT_SEEN(health_helicity_reversed, nothing, o.lased = o.bias.reversed = true);
    EXPECT_SEEN(health_rate_near_bias, nothing, o.lased = o.bias.near_rate = true);
    EXPECT_SEEN(health_coil_current, nothing, o.coil.off = true);
    EXPECT_SEEN(0u, counts, o.coil.unbalanced = true);
}

TEST(Monitors, Fringe) {
    EXPECT_SEEN(health_fringe_lost, nothing, c.fringe.reads = true);
    EXPECT_SEEN(0u, nothing, c.fringe.reads = true; o.fringe.fringe = 0.0f);
    EXPECT_SEEN(0u, nothing, c.fringe.reads = true; o.order.fresh = false);
    EXPECT_SEEN(0u, counts, c.fringe.reads = true; o.lit = false);
    EXPECT_SEEN(health_fringe_skewed, nothing, o.fringe.skewed = true);
}

TEST(Monitors, StateOfTheGyro) {
    EXPECT_SEEN(health_switching, nothing, o.phase = SwitchPhase::open);
    EXPECT_SEEN(health_switching, nothing, o.phase = SwitchPhase::settling);
    EXPECT_SEEN(health_relock_failed, nothing, o.phase = SwitchPhase::returning);
    EXPECT_SEEN(health_relock_failed | health_searching, nothing, o.phase = SwitchPhase::searching);
    EXPECT_SEEN(health_half_wave_rejected, nothing, o.half_wave_rejected = true);
    EXPECT_SEEN(health_piezo_near_range_end, nothing, o.near_range_end = true);
    EXPECT_SEEN(health_recentring, nothing, s.recentring = true);
    EXPECT_SEEN(health_warming_up, nothing, o.warms_up = true);
    EXPECT_SEEN(health_edges_shifted, nothing, c.commutator.dither.method = DitherMethod::paired);
}

TEST(Monitors, OneReportHidesNoOther) {
    EXPECT_SEEN(health_sign_error | health_counter_jump, counts, o.commuted.sign_error = o.beyond = true);
    EXPECT_SEEN(health_coil_current | health_frame_missed, nothing, o.coil.off = true; o.received = false);
}

}  // namespace zlg::core::monitors_test
