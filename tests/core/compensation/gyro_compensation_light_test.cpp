// The light samples of a switch: `joint` estimates it by them, whatever the recorded mean squares say.

#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace gyro_compensation_light_test {

using namespace zlg::core;
using namespace gyro_compensation_support;

constexpr int gap_tick = 400;
constexpr int gap_ticks = 3;
constexpr int n_samples = 16;
constexpr double discriminator_per_lambda = 0.332;

GyroCompensationConfig joint() {
    GyroCompensationConfig c;
    c.gyro.scale = Arcsec{0.01};  // its roundings are of no account
    c.gyro.random_walk = ArcsecPerRootSecond{0.0};
    c.relock = {.method = RelockMethod::joint};
    c.bridge.method = BridgeMethod::automatic;
    return c;
}

// A rotation that nobody foretells, with a detuning that decays from 0.2 wavelengths after the gap. What is recorded of
// it is half as much again as it was.
//
// return  sum of the corrected ticks after the gap: what the correction is off by.
double error_after_gap(bool with_samples) {
    const GyroCompensationConfig config = joint();
    Recorder recorder{config, 1, 1};
    compensation_test::Random random{11};
    double truth = 0.0;
    GyroCompensationState state;
    Delivered all;
    for (int h = 0; h < 2 * gap_tick + 160; ++h) {
        const int since = h - 2 * (gap_tick + gap_ticks);
        const bool open = h >= 2 * gap_tick && since < 0;
        const auto detuning = [&](double time) { return open ? 0.2 : since < 0 ? 0.0 : 0.2 * std::exp(-0.4 * time); };
        std::array<float, n_samples> a{}, b{};
        double mean_sq = 0.0;
        for (unsigned k = 0; k < n_samples; ++k) {
            // A converter's least bit moves.
            const double dl = detuning(since + (k + 0.5) / n_samples) + 1e-6 * (k % 2);
            mean_sq += dl * dl / n_samples;
            a[k] = static_cast<float>(1.0 + discriminator_per_lambda * dl);
            b[k] = static_cast<float>(1.0 - discriminator_per_lambda * dl);
        }
        const double rotation = 2.0 * random.normal();
        if (since >= 0 && since < 40) truth += rotation;
        HalfRecord record = recorder.half(rotation, mean_sq);
        record.detuning_sq_lambda2 *= 1.5;
        record.loop_closed = !open;
        const CompensationOutput out =
            step(config, state, record, with_samples ? LightSamples{.a = a, .b = b} : LightSamples{});
        if (out.has_sample && out.sample.has_final) all.rows.push_back(out.sample.final_row);
    }
    EXPECT_EQ(is_complete(state.bridge.light), with_samples);
    drain_into(config, state, all);
    double sum = -truth;
    for (int t = gap_tick + gap_ticks; t < gap_tick + gap_ticks + 20; ++t)
        sum += all.rows[static_cast<std::size_t>(t)].dtheta_final_arcsec;
    return sum;
}

TEST(GyroCompensationLight, JointEstimatesASwitchByTheSamples) {
    const double by_records = error_after_gap(false);
    EXPECT_GT(std::abs(by_records), 0.03);
    // The mean of the bias, over 256 ticks of that rotation, leaves some of it.
    EXPECT_LT(std::abs(error_after_gap(true)), 0.6 * std::abs(by_records));
}

// A bias that reverses within 0.06 T weighs the detuning by a trapezoid; recorded are means and mean squares that do
// not. The rotation is one that nobody foretells, and the detuning falls in first halves alone: of one that decays the
// scale of chi would take up what is amiss.
//
// return  sum of the corrected ticks after the gap: what the correction is off by.
double error_of_a_slow_reversal(double presumed_edge_ratio) {
    GyroCompensationConfig config = joint();
    config.gyro.plateau_ratio = 1.0 / (1.0 - presumed_edge_ratio);
    config.gyro.light_noise = Wavelengths{1e-7};
    config.gyro.bias = Hertz{1e9};  // the rounding of counts is beyond the digits looked at
    Recorder recorder{config, 1, 1};
    compensation_test::Random random{11};
    double truth = 0.0;
    GyroCompensationState state;
    Delivered all;
    for (int h = 0; h < 2 * gap_tick + 160; ++h) {
        const int since = h - 2 * (gap_tick + gap_ticks);
        const bool open = h >= 2 * gap_tick && since < 0;
        double mean = 0.0, even = 0.0, weighed = 0.0, weights = 0.0;
        for (int k = 0; k < 2000; ++k) {
            const double x = (k + 0.5) / 2000.0, to_border = std::min(x, 1.0 - x);
            const double dl = open        ? 0.2
                              : since < 0 ? 0.0
                                          : std::max(0.0, 0.2 - 0.05 * (since / 2 + (since % 2 == 0 ? x : 1.0)));
            const double weight = std::min(1.0, to_border / 0.06);
            mean += dl / 2000.0;
            even += dl * dl / 2000.0;
            weighed += weight * dl * dl;
            weights += weight;
        }
        const double rotation = 0.02 * random.normal();
        if (since >= 0 && since < 40) truth += rotation;
        HalfRecord record = recorder.half(rotation, weighed / weights);
        record.detuning_lambda = mean;
        record.detuning_sq_lambda2 = even;
        record.loop_closed = !open;
        const CompensationOutput out = step(config, state, record);
        if (out.has_sample && out.sample.has_final) all.rows.push_back(out.sample.final_row);
    }
    drain_into(config, state, all);
    double sum = -truth;
    for (int t = gap_tick + gap_ticks; t < gap_tick + gap_ticks + 20; ++t)
        sum += all.rows[static_cast<std::size_t>(t)].dtheta_final_arcsec;
    return std::abs(sum);
}

TEST(GyroCompensationLight, JointWeighsRecordedSquaresAsABiasThatReversesSlowly) {
    EXPECT_GT(error_of_a_slow_reversal(0.0), 5.0);
    EXPECT_LT(error_of_a_slow_reversal(0.06), 0.1 * error_of_a_slow_reversal(0.0));
}

// At rest in the centre no decay is seen, and `frequency` has nothing to correct by.
TEST(GyroCompensationLight, ATickThatCouldNotBeCorrectedKeepsItsFlag) {
    GyroCompensationConfig config = joint();
    config.relock.method = RelockMethod::frequency;
    Recorder recorder{config, 1, 1};
    Halves halves;
    for (int t = 0; t < gap_tick + 80; ++t) recorder.tick_into(halves, 0.0, t < gap_tick || t >= gap_tick + gap_ticks);
    const Delivered all = run(config, halves);
    int n_uncorrected = 0;
    for (std::size_t t = 0; t < all.rows.size(); ++t) {
        const std::uint32_t flags = all.rows[t].flags;
        if ((all.samples[t].sample.flags & flag_relock_uncorrected) == 0) continue;
        ++n_uncorrected;
        EXPECT_NE(flags & flag_relock_uncorrected, 0u) << t;
        EXPECT_EQ(flags & flag_relock_corrected, 0u) << t;
    }
    EXPECT_GT(n_uncorrected, 10);
}

}  // namespace gyro_compensation_light_test
