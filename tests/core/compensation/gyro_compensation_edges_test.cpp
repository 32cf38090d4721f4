// Compensation of records whose bias edges were shifted against lock-in: as if they had stood still.
#include <zlg/core/control/edge_dither.hpp>
#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_edges_test {

using namespace gyro_compensation_support;

constexpr std::int64_t half_ticks = 25000;

// Bias and rotation of whole counts per tick of the timer, so that no count is rounded wherever an edge stands.
constexpr std::int64_t bias_per_tick = 2;

GyroCompensationConfig config_of(RelockMethod relock, BridgeMethod bridge) {
    GyroCompensationConfig config;
    config.relock.method = relock;
    config.gyro.scale = Arcsec{3.263e-3};
    config.gyro.bias = Hertz{static_cast<double>(bias_per_tick) * config.gyro.timer.value()};
    config.bridge.method = bridge;
    return config;
}

struct Gyro {
    std::int64_t rate_per_tick = 3;
    std::int8_t first_sign = 1;
    DitherMethod dither = DitherMethod::none;
    std::int64_t deficit_per_mille = 0;  // of the bias after a gap, 7/10 of it in the next half

    // A switch at the start of each tick of `switches`, three ticks long.
    [[nodiscard]] Halves log(int n_ticks, const std::vector<int>& switches = {}) const {
        EdgeDitherState edges;
        const EdgeDitherConfig law{.method = dither};
        Halves halves;
        std::int8_t mode = 1;
        std::int32_t start = 0, end = 0;
        int open_until = 0;
        double deficit = 0.0;
        for (int k = 0; k < 2 * n_ticks; ++k) {
            if (k % 2 == 0 && std::ranges::count(switches, k / 2) > 0) {
                mode = static_cast<std::int8_t>(-mode);
                open_until = k + 6;
                deficit = 1e-3 * static_cast<double>(deficit_per_mille);
            }
            HalfRecord half{.half = k, .edge_offset_ticks = end};
            half.bias_sign = k % 2 == 0 ? first_sign : static_cast<std::int8_t>(-first_sign);
            half.mode = mode;
            half.loop_closed = k >= open_until;
            half.detuning_lambda = half.detuning_sq_lambda2 = half.piezo_v = half.temperature_c = not_a_number;
            const std::int64_t length = half_ticks + end - start;
            const auto lost = half.loop_closed ? std::llround(deficit * bias_per_tick * half_ticks) : 0;
            half.counts = rate_per_tick * length + half.bias_sign * half.mode * (bias_per_tick * length - lost);
            if (half.loop_closed) deficit *= 0.7;
            start = end;
            end = step(law, edges, static_cast<std::int8_t>(-half.bias_sign), {});
            halves.push_back(half);
        }
        return halves;
    }
};

const std::vector<int> switches{40, 90, 131};

TEST(GyroCompensationEdges, EveryTickIsAsIfTheEdgesStoodStill) {
    for (const DitherMethod law : {DitherMethod::paired, DitherMethod::random}) {
        for (const std::int8_t first_sign : {std::int8_t{1}, std::int8_t{-1}}) {
            for (const BridgeMethod bridge : {BridgeMethod::none, BridgeMethod::linear, BridgeMethod::quadratic}) {
                const auto config = config_of(RelockMethod::none, bridge);
                const Gyro still{.first_sign = first_sign}, moved{.first_sign = first_sign, .dither = law};
                const Delivered expected = run(config, still.log(200, switches));
                const Delivered got = run(config, moved.log(200, switches));
                ASSERT_EQ(got.rows.size(), 200u);
                for (std::size_t k = 0; k < got.rows.size(); ++k) {
                    EXPECT_NEAR(got.rows[k].dtheta_arcsec, expected.rows[k].dtheta_arcsec, 1e-9) << k;
                    EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, expected.rows[k].dtheta_final_arcsec, 1e-9) << k;
                    EXPECT_EQ(got.rows[k].flags, expected.rows[k].flags);
                    EXPECT_EQ(got.rows[k].sigma_arcsec, expected.rows[k].sigma_arcsec);
                }
                EXPECT_NEAR(got.samples.back().angle_arcsec, expected.samples.back().angle_arcsec, 1e-9);
            }
        }
    }
}

// `frequency` reads the bias's deficit from the difference of the halves, to which the shifts add theirs.
TEST(GyroCompensationEdges, TheDeficitAfterASwitchIsNotMistaken) {
    const auto config = config_of(RelockMethod::frequency, BridgeMethod::quadratic);
    Gyro gyro{.deficit_per_mille = 100};
    const Delivered expected = run(config, gyro.log(200, switches));
    gyro.dither = DitherMethod::random;
    const Delivered got = run(config, gyro.log(200, switches));
    int n_corrected = 0;
    for (std::size_t k = 0; k < got.rows.size(); ++k) {
        EXPECT_EQ(got.rows[k].flags, expected.rows[k].flags) << k;
        if (expected.rows[k].relock_arcsec != 0.0) ++n_corrected;
        // The rate within a tick is known but for the false drift itself, 4e-4 of which is in the shifted ends.
        EXPECT_NEAR(got.rows[k].relock_arcsec, expected.rows[k].relock_arcsec,
                    2e-3 * std::abs(expected.rows[k].relock_arcsec) + 1e-6)
            << k;
    }
    EXPECT_GT(n_corrected, 10);
}

TEST(GyroCompensationEdges, AShiftThatCannotBeMakesBothHalvesBesideItInvalid) {
    for (const unsigned at : {50u, 51u}) {
        Halves halves = Gyro{.dither = DitherMethod::random}.log(60);
        halves[at].edge_offset_ticks = 12500;
        const Delivered got = run(config_of(RelockMethod::none, BridgeMethod::quadratic), halves);
        for (unsigned k = 0; k < 60; ++k) {
            const bool lost = k == 25 || (at == 51 && k == 26);
            EXPECT_EQ((got.rows[k].flags & flag_invalid) != 0, lost) << k;
            EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, 3.263e-3 * 150000, 1e-9) << k;
        }
    }
}

}  // namespace zlg::core::gyro_compensation_edges_test
