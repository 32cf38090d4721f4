// The estimate of a gap with lit halves against generalised least squares with dense matrices, from the records alone.

#include <zlg/core/gyro_compensation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "gyro_compensation_support.hpp"

namespace gyro_compensation_lit_test {

using namespace zlg::core;
using namespace gyro_compensation_support;

constexpr int gap_tick = 40;
constexpr int gap_ticks = 3;
constexpr double miss_sq = 0.0484;

// A line at 20 Hz and a band about 60 Hz as the given covariance of half-ticks.
double prior(int lag) {
    const double x = 2.0 * std::numbers::pi * 0.0025 * lag;
    return 400.0 * std::cos(20.0 * x) + 60.0 * std::cos(60.0 * x) * std::exp(-0.02 * lag * lag);
}

GyroCompensationConfig config_of(RelockMethod relock) {
    GyroCompensationConfig c;
    c.gyro.random_walk = ArcsecPerRootSecond{0.0};
    c.relock = {.method = relock};
    c.bridge.method = BridgeMethod::optimal;
    c.bridge.optimal = {.learns = false, .halves = true};
    for (int k = 0; k < max_window; ++k) c.bridge.optimal.prior_arcsec2[static_cast<unsigned>(k)] = prior(k);
    return c;
}

Halves records(const GyroCompensationConfig& config, bool lit) {
    Halves all;
    Recorder recorder{config, 1, 1};
    for (int h = 0; h < 160; ++h) {
        const double t = 0.0025 * h;
        const double motion = 28.0 * std::cos(2.0 * std::numbers::pi * 20.0 * t) + 11.0 * std::cos(377.0 * t + 1.0);
        const bool open = h >= 2 * gap_tick && h < 2 * (gap_tick + gap_ticks);
        HalfRecord r = recorder.half(motion, open ? miss_sq : 0.0);
        r.detuning_sq_lambda2 += 0.0033 * 0.0033;
        r.loop_closed = !open;
        r.lit = lit && h >= 2 * gap_tick + 3;
        if (open && h < 2 * gap_tick + 3) r.counts += 60 - 17 * (h % 3);  // dark
        all.push_back(r);
    }
    return all;
}

// x of A x = b, A symmetric positive definite or not: elimination with pivots.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t p = k;
        for (std::size_t i = k; i < n; ++i)
            if (std::abs(a[i][k]) > std::abs(a[p][k])) p = i;
        std::swap(a[k], a[p]);
        std::swap(b[k], b[p]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double f = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
            b[i] -= f * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

struct Reference {
    std::vector<double> ticks;
};

// Kriging with the unknown rate and the alternation of either side, as one bordered system.
Reference reference(const GyroCompensationConfig& config, const Halves& halves, const std::vector<double>& bias) {
    const double k_arcsec = config.gyro.scale.value();
    const double rounding = k_arcsec * k_arcsec / 6.0;
    const auto covariance = [&](int a, int b) {
        const int lag = std::abs(a - b);
        return prior(lag) + (lag == 0 ? rounding : lag == 1 ? -0.5 * rounding : 0.0);
    };
    const int begin = 2 * gap_tick;
    const int end = begin + 2 * gap_ticks;
    const double unit = 3.6 * 60e3 * k_arcsec * 0.0025;
    const double d = unit * miss_sq;
    const double noise_sq = 0.0033 * 0.0033;
    const double variance = unit * unit * (4.0 * miss_sq * noise_sq + 2.0 * noise_sq * noise_sq) / 16.0;
    const double common_sq = std::pow(0.015 * d, 2) + std::pow(unit * 2.0 * 0.22 * 0.002, 2) + 1e-4 * d * d;
    std::vector<int> at;
    std::vector<double> z;
    for (int h = begin - 16; h < end + 16; ++h) {
        const HalfRecord& r = halves[static_cast<std::size_t>(h)];
        if (!r.loop_closed && !r.lit) continue;
        const int sign = r.bias_sign * r.mode;
        at.push_back(h);
        z.push_back(k_arcsec * static_cast<double>(r.counts) - sign * bias[static_cast<std::size_t>(h / 2)] +
                    (r.loop_closed ? 0.0 : sign * d));
    }
    const std::size_t n = at.size();
    std::vector<std::vector<double>> a(n + 3, std::vector<double>(n + 3, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            a[i][j] = covariance(at[i], at[j]);
            const bool both_lit = at[i] >= begin && at[i] < end && at[j] >= begin && at[j] < end;
            const double turn = (at[i] - at[j]) % 2 == 0 ? 1.0 : -1.0;
            if (both_lit) a[i][j] += turn * common_sq + (i == j ? variance : 0.0);
        }
        a[i][n] = a[n][i] = 1.0;
        const double turn = at[i] % 2 == 0 ? 1.0 : -1.0;
        a[i][n + 1] = a[n + 1][i] = at[i] < begin ? turn : 0.0;
        a[i][n + 2] = a[n + 2][i] = at[i] < begin ? 0.0 : turn;
    }
    Reference out;
    for (int t = 0; t < gap_ticks; ++t) {
        std::vector<double> b(n + 3, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            b[i] = covariance(at[i], begin + 2 * t) + covariance(at[i], begin + 2 * t + 1);
        b[n] = 2.0;
        const std::vector<double> w = solved(a, b);
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i) sum += w[i] * z[i];
        out.ticks.push_back(sum);
    }
    return out;
}

struct Outcome {
    Delivered all;
    std::vector<double> bias;  // by tick
};

Outcome outcome(const GyroCompensationConfig& config, const Halves& halves) {
    Outcome out;
    GyroCompensationState state;
    for (const HalfRecord& half : halves) {
        step_into(config, state, half, out.all);
        if (half.half % 2 != 0) out.bias.push_back(state.bias_arcsec);
    }
    drain_into(config, state, out.all);
    return out;
}

TEST(GyroCompensationLit, IsTheEstimateByDenseMatrices) {
    const GyroCompensationConfig config = config_of(RelockMethod::none);
    const Halves halves = records(config, true);
    const Outcome found = outcome(config, halves);
    const Reference expected = reference(config, halves, found.bias);
    ASSERT_EQ(found.all.gaps.size(), 1u);
    for (int t = 0; t < gap_ticks; ++t)
        EXPECT_NEAR(found.all.rows[static_cast<std::size_t>(gap_tick + t)].dtheta_final_arcsec,
                    expected.ticks[static_cast<std::size_t>(t)], 1e-6)
            << t;
}

TEST(GyroCompensationLit, TheyNarrowTheGap) {
    for (const RelockMethod relock : {RelockMethod::none, RelockMethod::mean_square}) {
        const GyroCompensationConfig config = config_of(relock);
        const Outcome with = outcome(config, records(config, true));
        const Outcome without = outcome(config, records(config, false));
        ASSERT_EQ(with.all.gaps.size(), 1u);
        EXPECT_LT(with.all.gaps[0].sigma_sum_arcsec, without.all.gaps[0].sigma_sum_arcsec);
        // In the last tick of the gap both halves were read.
        double read = 0.0;
        double truth = 0.0;
        for (int h = 2 * gap_tick + 4; h < 2 * gap_tick + 6; ++h) {
            const double t = 0.0025 * h;
            truth += 28.0 * std::cos(2.0 * std::numbers::pi * 20.0 * t) + 11.0 * std::cos(377.0 * t + 1.0);
        }
        read = with.all.rows[gap_tick + 2].dtheta_final_arcsec;
        EXPECT_NEAR(read, truth, 4.0 * config.gyro.scale.value() / std::sqrt(6.0));
    }
}

// Delivered and final values have the same sum, with lit halves too.
TEST(GyroCompensationLit, TheSumsOfBothColumnsAreEqual) {
    const GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    const Outcome found = outcome(config, records(config, true));
    double delivered = 0.0;
    double final = 0.0;
    for (const AngleRow& row : found.all.rows) {
        delivered += row.dtheta_arcsec;
        final += row.dtheta_final_arcsec;
    }
    EXPECT_NEAR(delivered, final, 1e-9);
}

// Lit halves that turn by nonsense are refused: the angle is that without them, to the last bit. It may be a rotation, and
// sigma holds it.
TEST(GyroCompensationLit, NonsenseThatIsCalledLitIsRefused) {
    const GyroCompensationConfig config = config_of(RelockMethod::none);
    Halves bad = records(config, true);
    Halves none = records(config, false);
    for (std::size_t h = 2 * gap_tick; h < 2 * (gap_tick + gap_ticks); ++h) {
        bad[h].counts = none[h].counts = static_cast<std::int64_t>(h * 7919 % 400) - 200;
        bad[h].lit = true;
    }
    const Outcome a = outcome(config, bad);
    const Outcome b = outcome(config, none);
    ASSERT_EQ(a.all.rows.size(), b.all.rows.size());
    for (std::size_t k = 0; k < a.all.rows.size(); ++k) {
        EXPECT_EQ(a.all.rows[k].dtheta_final_arcsec, b.all.rows[k].dtheta_final_arcsec);
        const bool in_gap = k >= gap_tick && k < gap_tick + gap_ticks;
        if (in_gap)
            EXPECT_GT(a.all.rows[k].sigma_arcsec, 100.0);
        else
            EXPECT_EQ(a.all.rows[k].sigma_arcsec, b.all.rows[k].sigma_arcsec);
    }
}

}  // namespace gyro_compensation_lit_test
