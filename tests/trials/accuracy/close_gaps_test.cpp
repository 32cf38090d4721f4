// Sigma of the angle and of each tick where a missed frame lies beside a switch, before it or after it, so that their
// gaps share points, light and time; and of a pulse that the lit halves of a gap show.

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/wiring.hpp>

#include "accuracy/parts.hpp"
#include "synthetic/gyro.hpp"
#include "test.hpp"

namespace zlg::trials::close_gaps_test {

constexpr std::int64_t learning_ticks = 600;
constexpr std::int64_t opening = 30;  // of the switch, in ticks of a trial
constexpr std::int64_t trial_ticks = 120;

struct Setting {
    std::string readout;
    core::RelockMethod relock;
    core::BridgeMethod bridge;
    int gap_ticks;
    int lit_halves = 3;
    std::vector<Tone> tones{{20.06, 12000.0}};
};

// What one trial leaves, over what it claims.
struct Errors {
    double angle_arcsec = 0.0, angle_variance = 0.0;
    double worst_tick = 0.0;  // error over sigma
    bool repaired = true;
};

struct Trial {
    core::GyroCompensationConfig config;
    core::GyroCompensationState state;
    SyntheticGyro gyro;
};

Trial learnt(const Setting& s, std::uint64_t seed) {
    GyroLaw law = gyro_of(s.readout);
    law.gap_ticks = s.gap_ticks;
    law.lit_halves = s.lit_halves;
    law.photodiodes.learnt = law.photodiodes.reads;
    Trial t{rig::compensation_config(config_of(law), s.relock, s.bridge), {}, {law, {.tones = s.tones}, seed}};
    for (std::int64_t half = 0; half < 2 * learning_ticks; ++half) {
        const SyntheticHalf now = t.gyro.advance();
        (void)core::step(t.config, t.state, now.record, now.light);
    }
    return t;
}

// A switch at `opening`; `missed`: the half, counted from there, whose frame is missed, or none where it is far;
// `pulse` in halves counted from there.
Errors errors_of(Trial t, std::uint64_t seed, int missed, const std::vector<double>& pulse = {}, int pulse_at = 0) {
    t.gyro.draw_anew(seed);
    const std::int64_t start = t.state.bridge.next_tick;
    std::vector<double> truth;
    Errors out;
    std::int64_t lost = 0;
    double sum = 0.0;
    const auto take = [&](const core::AngleRow& row) {
        const auto k = row.tick - start;
        if (k < 0 || k >= trial_ticks - 40) return;
        const double error = row.dtheta_final_arcsec - truth[static_cast<std::size_t>(k)];
        sum += error;
        if (!std::isfinite(row.sigma_arcsec))
            out.repaired = false;
        else
            out.worst_tick = std::max(out.worst_tick, std::abs(error) / row.sigma_arcsec);
    };
    for (std::int64_t half = 0; half < 2 * trial_ticks; ++half) {
        const auto h = static_cast<int>(half - 2 * opening);
        if (h == 0) t.gyro.open();
        const auto in_pulse = static_cast<std::size_t>(h - pulse_at);
        SyntheticHalf now = t.gyro.advance(h >= pulse_at && in_pulse < pulse.size() ? pulse[in_pulse] : 0.0);
        if (half % 2 == 0) truth.push_back(0.0);
        truth.back() += now.true_arcsec;
        if (h == missed) {
            lost = now.record.counts;
            now.record.counts = 0;
            now.record.valid = false;
            now.record.fringe = -1.0f;
            now.light = {};
            now.record.detuning_sq_lambda2 = 0.0;
        } else if (h == missed + 1) {
            now.record.counts += lost;
            now.record.span = 2;
        }
        const core::CompensationOutput c = core::step(t.config, t.state, now.record, now.light);
        if (!c.has_sample) continue;
        if (c.sample.has_gap) out.angle_variance += std::pow(c.sample.gap.sigma_sum_arcsec, 2);
        if (c.sample.has_final) take(c.sample.final_row);
    }
    for (core::DrainOutput d = drain(t.config, t.state); d.has_gap || d.has_row; d = drain(t.config, t.state))
        if (d.has_row) take(d.row);
    out.angle_arcsec = sum;
    return out;
}

constexpr int far_away = 1000;

// Mean square of the angle's error over sigma, and the worst of all.
struct Figures {
    double nev = 0.0, worst_angle = 0.0, worst_tick = 0.0;
    int n = 0, unrepaired = 0;

    void add(const Errors& e) {
        if (!e.repaired) return void(++unrepaired);
        const double off = e.angle_arcsec * e.angle_arcsec / e.angle_variance;
        nev += (off - nev) / ++n;
        worst_angle = std::max(worst_angle, std::sqrt(off));
        worst_tick = std::max(worst_tick, e.worst_tick);
    }
};

struct CloseGaps : testing::TestWithParam<const char*> {};

TEST_P(CloseGaps, SigmaHoldsAMissedFrameBesideASwitch) {
    for (const core::RelockMethod relock : {core::RelockMethod::joint, core::RelockMethod::mean_square})
        for (const core::BridgeMethod bridge : {core::BridgeMethod::automatic})
            for (const int gap_ticks : {1, 2, 3, 5, 8, 12}) {
                const Trial trial = learnt({GetParam(), relock, bridge, gap_ticks}, 11);
                Figures f;
                for (int missed = -40; missed < 2 * gap_ticks + 40; ++missed) {
                    const Errors e = errors_of(trial, static_cast<std::uint64_t>(1000 + missed), missed);
                    f.add(e);
                }
                SCOPED_TRACE(testing::Message()
                             << "joint " << (relock == core::RelockMethod::joint) << ", auto "
                             << (bridge == core::BridgeMethod::automatic) << ", gap of " << gap_ticks);
                EXPECT_EQ(f.unrepaired, 0);
                EXPECT_LT(f.nev, 2.0);
                EXPECT_LT(f.worst_angle, 6.0);
                // By phase the two ticks of a counted stretch err by up to eight sigma where it lies five ticks after
                // closing.
                EXPECT_LT(f.worst_tick, 8.0);
            }
}

TEST_P(CloseGaps, SigmaOfAnyLengthHoldsTheMotion) {
    for (const core::BridgeMethod bridge : {core::BridgeMethod::automatic})
        for (int gap_ticks = 1; gap_ticks <= 20; ++gap_ticks) {
            Figures f;
            constexpr unsigned n_gyros = 6, n_seeds = 60;
            for (unsigned gyro = 1; gyro <= n_gyros; ++gyro) {
                const Trial trial = learnt({GetParam(), core::RelockMethod::mean_square, bridge, gap_ticks, 0}, gyro);
                for (unsigned seed = gyro; seed <= n_seeds; seed += n_gyros) f.add(errors_of(trial, seed, far_away));
            }
            SCOPED_TRACE(testing::Message()
                         << "auto " << (bridge == core::BridgeMethod::automatic) << ", gap of " << gap_ticks);
            EXPECT_EQ(f.unrepaired, gap_ticks > core::max_polynomial_gap ? int{n_seeds} : 0);
            EXPECT_LT(f.nev, 3.0);
            EXPECT_LT(f.worst_tick, 7.0);
        }
}

INSTANTIATE_TEST_SUITE_P(Readouts, CloseGaps, testing::Values("x1", "phase"));

// A pulse over two halves, at rest, that lies in the lit ones. One that begins in the last dark half is not noticed
// (docs/compensation.md).
TEST(LitHalves, APulseThatContradictsThemIsInSigma) {
    for (const char* readout : {"x1", "phase"}) {
        Trial trial = learnt({readout, core::RelockMethod::joint, core::BridgeMethod::automatic, 3, 3, {}}, 5);
        // As the switches before have shown chi f0 (a tenth off at the first one, which then may take the pulse for
        // that).
        trial.state.bridge.scale.variance = 1e-5;
        for (const double size : {18.0, 25.0, 40.0})
            for (int at = 3; at <= 4; ++at) {
                const Errors e = errors_of(trial, 77, far_away, {0.5 * size, 0.5 * size}, at);
                EXPECT_LT(e.angle_arcsec * e.angle_arcsec, 25.0 * e.angle_variance)
                    << readout << " " << size << " " << at;
                EXPECT_LT(e.worst_tick, 7.0) << readout << " " << size << " " << at;
            }
    }
}

}  // namespace zlg::trials::close_gaps_test
