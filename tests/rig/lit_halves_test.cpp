// Which halves of a gap are lit, what is recorded of them, and what they are worth: the twin of either fidelity.

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::lit_halves_test {

config::Config gyro(config::Fidelity fidelity) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_s = 2.0;
    c.gyro.fidelity = fidelity;
    return fidelity == config::Fidelity::laser ? rig::calibrated_by_laser(c) : c;
}

std::vector<rig::LoopHalf> first_gap(const config::Config& c) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    rig::LoopHalf half = loop.advance();
    while (half.record.loop_closed) half = loop.advance();
    std::vector<rig::LoopHalf> halves{half};
    while (!(half = loop.advance()).record.loop_closed) halves.push_back(half);
    return halves;
}

TEST(LitHalves, AreTheLastThreeOfSixInEveryLoop) {
    for (const auto fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
        for (const auto loop : {config::Loop::exponential, config::Loop::analog, config::Loop::digital}) {
            for (const double miss : {0.0, 0.05, 0.22}) {
                config::Config c = gyro(fidelity);
                c.perimeter.loop = loop;
                c.perimeter.miss_lambda = miss;
                std::string lit;
                for (const rig::LoopHalf& half : first_gap(c)) lit += half.record.lit ? '1' : '0';
                EXPECT_EQ(lit, "000111") << static_cast<int>(fidelity) << static_cast<int>(loop) << miss;
            }
        }
    }
}

// The mean square that is recorded makes the false angle that the gyro had.
TEST(LitHalves, HaveTheMeanSquareOfTheirDetuning) {
    for (const auto fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
        const config::Config c = gyro(fidelity);
        const double unit = c.gyro.bias_chi * c.gyro.bias_hz * c.gyro.scale_arcsec * 0.5 * c.gyro.tick_s;
        int n = 0;
        for (const rig::LoopHalf& half : first_gap(c)) {
            if (!half.record.lit) continue;
            const double true_sq = std::abs(half.truth.false_relock_arcsec) / unit;
            EXPECT_NEAR(half.record.detuning_sq_lambda2, true_sq, 3.0 * 2.0 * 0.22 * 0.0033 / 4.0) << n;
            EXPECT_TRUE(half.record.valid);
            ++n;
        }
        EXPECT_EQ(n, 3);
    }
}

// Tones without number between 5 and 80 Hz, of 8000 arcsec/s rms together.
twin::Motion vibration(double seconds) {
    constexpr int n = 150;
    constexpr double rate_hz = 1600.0;
    std::mt19937 bits{7};
    const auto draw = [&bits] { return static_cast<double>(bits()) / 4294967296.0; };
    std::vector<double> increments(static_cast<std::size_t>(seconds * rate_hz));
    for (int k = 0; k < n; ++k) {
        const double w = 2.0 * std::numbers::pi * (5.0 + 75.0 * (k + draw()) / n);
        const double phase = 2.0 * std::numbers::pi * draw();
        const double amplitude = 8000.0 * std::sqrt(2.0 / n) / w;
        for (std::size_t i = 0; i < increments.size(); ++i) {
            const double t = static_cast<double>(i) / rate_hz;
            increments[i] += amplitude * (std::sin(w * (t + 1.0 / rate_hz) + phase) - std::sin(w * t + phase));
        }
    }
    return twin::Motion::from_increments(std::move(increments), rate_hz);
}

struct Method {
    core::RelockMethod relock;
    core::BridgeMethod bridge;
    bool lit;
};

// Rms of the permanent error over all switches, and the mean square of it over sigma.
struct Errors {
    double rms_arcsec = 0.0;
    double normalised = 0.0;
};

std::vector<Errors> errors(const config::Config& c, double seconds, const std::vector<Method>& methods) {
    struct Track {
        core::GyroCompensationConfig config;
        core::GyroCompensationState state{};
        std::vector<double> final_arcsec;
        std::vector<core::GapReport> gaps;
    };
    std::vector<Track> tracks;
    for (const Method& m : methods) tracks.push_back({.config = rig::compensation_config(c, m.relock, m.bridge)});
    rig::ClosedLoop loop{c, vibration(seconds + 1.0)};
    std::vector<double> truth;
    const auto n_halves = static_cast<int>(2.0 * seconds / c.gyro.tick_s);
    for (int h = 0; h < n_halves; ++h) {
        const rig::LoopHalf half = loop.advance();
        if (h % 2 == 0) truth.push_back(0.0);
        truth.back() += half.truth.dtheta_arcsec;
        for (std::size_t k = 0; k < methods.size(); ++k) {
            core::HalfRecord record = half.record;
            record.lit = record.lit && methods[k].lit;
            const core::AngleSample sample = step(tracks[k].config, tracks[k].state, record, loop.light()).sample;
            if (sample.has_final) tracks[k].final_arcsec.push_back(sample.final_row.dtheta_final_arcsec);
            if (sample.has_gap) tracks[k].gaps.push_back(sample.gap);
        }
    }
    std::vector<Errors> all;
    for (const Track& track : tracks) {
        Errors e;
        int n = 0;
        for (const core::GapReport& gap : track.gaps) {
            const std::int64_t end = gap.first_tick + gap.n_ticks + 25;
            if (gap.first_tick < 3000 || end > static_cast<std::int64_t>(track.final_arcsec.size())) continue;
            double error = 0.0;
            for (auto t = static_cast<std::size_t>(gap.first_tick - 10); t < static_cast<std::size_t>(end); ++t)
                error += track.final_arcsec[t] - truth[t];
            e.rms_arcsec += error * error;
            e.normalised += std::pow(error / gap.sigma_sum_arcsec, 2);
            ++n;
        }
        all.push_back({std::sqrt(e.rms_arcsec / n), e.normalised / n});
    }
    return all;
}

TEST(LitHalves, NarrowTheErrorOfASwitchOverVibration) {
    for (const auto fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
        const std::vector<Errors> e = errors(gyro(fidelity), 120.0,
                                             {{core::RelockMethod::joint, core::BridgeMethod::automatic, false},
                                              {core::RelockMethod::joint, core::BridgeMethod::automatic, true},
                                              {core::RelockMethod::mean_square, core::BridgeMethod::automatic, false},
                                              {core::RelockMethod::mean_square, core::BridgeMethod::automatic, true}});
        EXPECT_GT(e[0].rms_arcsec, 4.0 * e[1].rms_arcsec);
        EXPECT_GT(e[2].rms_arcsec, 4.0 * e[3].rms_arcsec);
        // 50 switches: +-3 standard deviations of a mean of squares about 1, and sigma not more than 1.5 times too
        // large.
        for (const Errors& each : e) {
            EXPECT_GT(each.normalised, 0.4);
            EXPECT_LT(each.normalised, 1.6);
        }
    }
}

}  // namespace zlg::lit_halves_test
