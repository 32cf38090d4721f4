#include "perimeter/analog_loop.hpp"

#include "quiet_gyro.hpp"

namespace zlg::twin::analog_loop_test {

// A loop that holds the mode of helicity +1 at length 0, and the state that it begins a half with.
struct Half {
    TwinConfig config = quiet_gyro();
    std::size_t n_steps = 32;
    double detuning_lambda = 0.01;
    double lag_lambda = 0.0;  // command less voltage
    double drift_start_lambda = 0.0;
    double drift_end_lambda = 0.0;
    int polarity = 1;

    [[nodiscard]] double step_s() const { return 0.5 * config.gyro.tick_s / static_cast<double>(n_steps); }
    [[nodiscard]] AnalogLoop loop() const {
        return {config, HighVoltage{config, step_s()}, step_s(), static_cast<int>(n_steps), nullptr};
    }
    [[nodiscard]] AnalogLoop::State start() const {
        const double v = detuning_lambda - drift_start_lambda;
        return {v + lag_lambda, v};
    }
    [[nodiscard]] double drift(std::size_t k) const {
        return drift_start_lambda +
               (drift_end_lambda - drift_start_lambda) * (static_cast<double>(k) / static_cast<double>(n_steps));
    }
};

bool is_taken_at_once(const Half& half, AnalogLoop::State& state, std::span<double> length) {
    return half.loop().live_through(state, lasing_mode(half.detuning_lambda), half.polarity, half.drift_start_lambda,
                                    half.drift_end_lambda, length);
}

bool is_taken_at_once(const Half& half) {
    AnalogLoop::State state = half.start();
    std::vector<double> length(half.n_steps + 1);
    return is_taken_at_once(half, state, length);
}

// The largest difference of any length, or of the state at the end, between both ways.
double apart(const Half& half) {
    AnalogLoop::State at_once = half.start();
    std::vector<double> length(half.n_steps + 1);
    EXPECT_TRUE(is_taken_at_once(half, at_once, length));
    const AnalogLoop loop = half.loop();
    AnalogLoop::State state = half.start();
    double most = std::abs(length[0] - half.detuning_lambda);
    for (std::size_t k = 0; k < half.n_steps; ++k) {
        state = loop.step(state, lasing_mode(state.v_lambda + half.drift(k)), half.polarity, half.drift(k),
                          half.drift(k + 1));
        most = std::max(most, std::abs(length[k + 1] - (state.v_lambda + half.drift(k + 1))));
    }
    most = std::max(most, std::abs(at_once.command_lambda - state.command_lambda));
    return std::max(most, std::abs(at_once.v_lambda - state.v_lambda));
}

TEST(AnalogLoop, AHalfAtOnceIsThatOfItsSteps) {
    for (const double tau_s : {0.002, 0.0065, 0.05}) {
        for (const double rc_s : {1e-4, 1e-3, 1.6e-3, 5e-3}) {
            for (const double detuning : {-0.03, -1e-6, 0.0, 0.02}) {
                for (const double drift : {-2e-4, 0.0, 1e-5}) {
                    Half half;
                    half.config.perimeter.tau_s = tau_s;
                    half.config.piezo.rc_s = rc_s;
                    half.config.piezo.slew_v_s = 1e5;
                    half.detuning_lambda = detuning;
                    half.lag_lambda = 0.003;
                    half.drift_start_lambda = 0.4;
                    half.drift_end_lambda = 0.4 + drift;
                    EXPECT_LT(apart(half), 1e-14) << tau_s << ' ' << rc_s << ' ' << detuning << ' ' << drift;
                }
            }
        }
    }
}

// One limit after the other: well inside it is taken, just outside it is not.
TEST(AnalogLoop, AHalfIsNotTakenAtOnceWhereALimitMayBeReached) {
    EXPECT_TRUE(is_taken_at_once(Half{}));
    EXPECT_FALSE(is_taken_at_once(Half{.polarity = -1}));

    Half quick;  // whose current limit never acts
    quick.config.piezo.slew_v_s = 1e5;
    quick.detuning_lambda = 0.4 * quick.config.perimeter.limit_lambda;
    EXPECT_TRUE(is_taken_at_once(quick));
    quick.detuning_lambda = 1.01 * quick.config.perimeter.limit_lambda;
    EXPECT_FALSE(is_taken_at_once(quick));

    Half wide;  // whose limiter never acts: the mode ends at 0.24
    wide.config.perimeter.limit_lambda = 0.5;
    wide.config.piezo.slew_v_s = 1e5;
    wide.detuning_lambda = 0.1;
    EXPECT_TRUE(is_taken_at_once(wide));
    wide.detuning_lambda = 0.245;
    EXPECT_FALSE(is_taken_at_once(wide));

    // The current limit begins at a lag of slew rc = 4000 V/s 1 ms/(80 V a wavelength).
    EXPECT_TRUE(is_taken_at_once(Half{.lag_lambda = 0.02}));
    EXPECT_FALSE(is_taken_at_once(Half{.lag_lambda = 0.051}));

    // The range ends at 150 V from its middle, 1.875 wavelengths.
    EXPECT_TRUE(is_taken_at_once(Half{.drift_start_lambda = -1.8, .drift_end_lambda = -1.8}));
    EXPECT_FALSE(is_taken_at_once(Half{.drift_start_lambda = -1.88, .drift_end_lambda = -1.88}));

    Half coarse;  // steps of an eighth of the time constant
    coarse.config.perimeter.tau_s = 8.0 * coarse.step_s();
    EXPECT_FALSE(is_taken_at_once(coarse));
    coarse.config.perimeter.tau_s = 12.0 * coarse.step_s();
    EXPECT_TRUE(is_taken_at_once(coarse));
}

}  // namespace zlg::twin::analog_loop_test
