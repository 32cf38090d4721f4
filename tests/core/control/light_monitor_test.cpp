#include <zlg/core/control/light_monitor.hpp>

#include "common/expansive_curve.hpp"

#include "support.hpp"

namespace zlg::core::light_monitor_test {

constexpr MonitorLimits config{.light_noise = Wavelengths{0.0033}, .bias_chi = 3.6};

constexpr double slope = 0.332;  // signal by wavelength

struct Judged : LightMonitorOutput {
    bool usable = false;
    Wavelengths detuning{};
};

// Light of both beams, as a detector reads it.
struct Lit {
    SyncDetectorInput light;
    SyncDetectorOutput read{.light = 2000.0, .readable = true, .two_way = true, .usable = true};
    bool closed = false;
    bool settled = false;
    double deficit_ratio = 0.0;
    SyncDetectorConfig detector{.discriminator_per_lambda = slope};

    Lit(std::span<const float> a, std::span<const float> b, int sign, double detuning_lambda, double mean_sq_lambda2)
        : light{.light_a = a, .light_b = b, .sign = sign, .beats = true} {
        read.detuning = Wavelengths{detuning_lambda};
        read.mean_sq_lambda2 = mean_sq_lambda2;
    }
    Judged seen_by(const MonitorLimits& c, LightMonitorState& state) const {
        SyncDetectorOutput left = read;
        const LightMonitorOutput out = step(c, state, {detector, light, left, closed, settled, deficit_ratio});
        return {out, left.usable, left.detuning};
    }
};

// Two beams of 1000, their noise, and what a detector makes of them.
class Light {
public:
    double detuning_lambda = 0.0;
    double noise_lambda = 0.0033;
    double share_a = 1.0;  // of beam A that is left
    double share = 1.0;    // of both beams
    bool stuck = false;
    bool two_way = true;
    bool dark = false;
    bool beats = true;
    bool settled = true;
    double deficit_ratio = 0.0;

    explicit Light(int n = 0) { (void)halves(n); }

    Judged half(const MonitorLimits& c = config) {
        sign_ = -sign_;
        if (!stuck) shine();
        double sum = 0.0, squares = 0.0;
        for (std::size_t k = 0; k < a_.size(); ++k) {
            const double a = static_cast<double>(a_[k]), b = static_cast<double>(b_[k]);
            const double x = sign_ * (a - b) / (a + b) / slope;
            sum += x;
            squares += x * x;
        }
        Lit in(a_, b_, sign_, sum / 16.0, squares / 16.0);
        in.closed = true;
        in.settled = settled;
        in.light.beats = beats;
        in.deficit_ratio = deficit_ratio;
        in.read.two_way = in.read.usable = two_way;
        in.read.dark = dark;
        return in.seen_by(c, state);
    }
    Judged halves(int n) {
        Judged out;
        for (int k = 0; k < n; ++k) out = half();
        return out;
    }

    LightMonitorState state;

private:
    void shine() {
        const double noise = std::sqrt(2.0) * 1000.0 * slope * noise_lambda;
        for (std::size_t k = 0; k < a_.size(); ++k) {
            const double signal = sign_ * slope * detuning_lambda;
            a_[k] = static_cast<float>(share * share_a * 1000.0 * (1.0 + signal) + noise * normal_(random_));
            b_[k] = static_cast<float>(share * 1000.0 * (1.0 - signal) + noise * normal_(random_));
        }
    }

    int sign_ = -1;
    std::array<float, 16> a_{}, b_{};
    std::mt19937 random_{11};
    std::normal_distribution<double> normal_;
};

constexpr MonitorLimits quiet{.light_noise = Wavelengths{3e-4}, .bias_chi = 3.6};

// To a lock.
Light on_the_way(double detuning_lambda) {
    Light light;
    light.settled = false;
    light.detuning_lambda = detuning_lambda;
    return light;
}

TEST(LightMonitor, OrdinaryLightIsLeftAsItIs) {
    Light light;
    for (int k = 0; k < 100000; ++k) {
        light.detuning_lambda = 0.01 * std::sin(0.01 * k);
        const Judged out = light.half();
        ASSERT_FALSE(out.stuck || out.noisy || out.unbalanced || out.contradicted) << k;
        ASSERT_TRUE(out.usable && out.has_mean_square) << k;
        ASSERT_NEAR(out.detuning.value(), light.detuning_lambda, 0.006) << k;
    }
}

TEST(LightMonitor, LightWithoutNoiseMayStandStill) {
    Light light;
    light.noise_lambda = 0.0;
    for (int k = 0; k < 100; ++k) {
        const Judged out = light.half({});
        ASSERT_TRUE(out.usable && out.has_mean_square && !out.stuck);
    }
}

TEST(LightMonitor, AConverterThatStandsStillIsSeenInTwoHalvesAndSteersNothing) {
    Light light{100};
    light.stuck = true;
    (void)light.halves(17);  // its samples still differ within the half: it is held as a whole
    light.stuck = false;
    EXPECT_FALSE(light.half().stuck);

    LightMonitorState s;
    const std::vector<float> still(16, 870.0f);
    const Lit in(still, still, 1, 0.0, 0.0);
    (void)in.seen_by(config, s);
    EXPECT_FALSE(in.seen_by(config, s).stuck);
    const Judged out = in.seen_by(config, s);
    EXPECT_TRUE(out.stuck && !out.usable && !out.has_mean_square);
}

TEST(LightMonitor, NoiseIsSeenInTwoHalvesAndMakesNoMeanSquare) {
    Light light{100};
    light.noise_lambda = 0.045;
    int k = 0;
    while (!light.half().noisy) ASSERT_LT(++k, 10);
    light.noise_lambda = 0.2;
    EXPECT_FALSE(light.halves(3).has_mean_square);
    light.noise_lambda = 0.0033;
    EXPECT_FALSE(light.half().has_mean_square);  // it may hold some of it
    EXPECT_TRUE(light.halves(30).has_mean_square);
}

TEST(LightMonitor, APerimeterThatSwingsIsNoNoise) {
    Light light;
    for (int k = 0; k < 1000; ++k) {
        light.detuning_lambda = 0.1 * std::sin(2.7 * k);
        ASSERT_FALSE(light.half().noisy) << k;
    }
}

// It may look so for a moment, as after a switch: but what a faded beam adds keeps its side.
TEST(LightMonitor, APerimeterThatSwingsDoesNotStayAFadedBeam) {
    Light light(10);
    light.state.is_unbalanced = true;
    light.state.n_side = 0;
    int n_unbalanced = 0;
    for (int k = 0; k < 200; ++k) {
        light.detuning_lambda = 0.04 * std::sin(0.9 * std::numbers::pi * k);
        const Judged half = light.half();
        n_unbalanced += half.unbalanced;
        EXPECT_TRUE(half.unbalanced || half.has_mean_square);
    }
    EXPECT_LE(n_unbalanced, 20);  // a period of its beat with the bias
    light.share_a = 0.8;
    EXPECT_TRUE(light.halves(24).unbalanced);
}

TEST(LightMonitor, ABeamThatFadedLeavesTheDetuningAsTheMeanOfTwoHalves) {
    Light light{100};
    light.detuning_lambda = 0.01;
    light.share_a = 0.95;  // of 1.95: the reading is off by 0.077
    const Judged out = light.halves(12);
    EXPECT_TRUE(out.unbalanced && out.usable && !out.has_mean_square);
    EXPECT_NEAR(out.detuning.value(), 0.01, 0.003);
    light.share_a = 1.0;
    const Judged again = light.halves(12);
    EXPECT_TRUE(!again.unbalanced && again.has_mean_square);
}

// There what a beam has lost stands in the mean square, times the detuning.
TEST(LightMonitor, ABeamThatFadesOnTheWayToALockIsSeenWithinAHalf) {
    Light light = on_the_way(0.2);
    for (int k = 0; k < 400; ++k) ASSERT_FALSE(light.half().unbalanced) << k;
    for (const double lost : {0.03, 0.1, 0.3}) {
        Light fading = on_the_way(0.2);
        (void)fading.halves(10);
        fading.share_a = 1.0 - lost;
        const Judged out = fading.half();
        EXPECT_TRUE(out.unbalanced && !out.has_mean_square) << lost;
        // It has come back, but the loop has not locked yet.
        fading.share_a = 1.0;
        EXPECT_TRUE(fading.halves(8).unbalanced) << lost;
    }
}

// The field, the detuning and the isotopes change the light of a healthy laser by 0.3 %, however quiet its converters
// are.
TEST(LightMonitor, LightThatFallsByAThirdOfAPercentIsNoFadedBeam) {
    for (const double lost : {0.003, 0.01}) {
        Light light = on_the_way(0.03);
        light.noise_lambda = 3e-4;
        for (int k = 0; k < 10; ++k) ASSERT_FALSE(light.half(quiet).unbalanced);
        light.share = 1.0 - lost;
        EXPECT_EQ(light.half(quiet).unbalanced, lost > 0.005) << lost;
    }
}

// Halves of few samples on a way to a lock that decays to a sixth in each.
bool is_unbalanced_on_the_way(std::size_t n_samples, double start_lambda, double lost) {
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    LightMonitorState state;
    bool unbalanced = false;
    for (int h = 0; h < 6; ++h) {
        const int sign = h % 2 == 0 ? 1 : -1;
        const double left = h >= 3 ? 1.0 - lost : 1.0;  // of beam A
        std::vector<float> a, b;
        for (std::size_t k = 0; k < n_samples; ++k) {
            const double time = h + (static_cast<double>(k) + 0.5) / static_cast<double>(n_samples);
            const double signal = sign * 0.332 * start_lambda * std::exp(-1.8 * time);
            const auto noise = [&] { return std::sqrt(2.0) * 332.0 * 3e-4 * normal(random); };
            a.push_back(static_cast<float>(left * 1000.0 * (1.0 + signal) + noise()));
            b.push_back(static_cast<float>(1000.0 * (1.0 - signal) + noise()));
        }
        Lit in(a, b, sign, 0.01, 1e-4);
        in.closed = true;
        unbalanced = unbalanced || in.seen_by(quiet, state).unbalanced;
    }
    return unbalanced;
}

TEST(LightMonitor, AFastWayToALockIsNoFadedBeamHoweverFewTheSamples) {
    for (const std::size_t n_samples : {8u, 9u, 11u, 13u, 16u, 32u}) {
        for (const double start_lambda : {-0.05, 0.03, 0.05})
            EXPECT_FALSE(is_unbalanced_on_the_way(n_samples, start_lambda, 0.0)) << n_samples << " " << start_lambda;
        EXPECT_TRUE(is_unbalanced_on_the_way(n_samples, 0.05, 0.1)) << n_samples;
    }
}

// Less than one jump shows above the noise.
TEST(LightMonitor, ABeamThatFadedUnseenIsSeenByAFewJumps) {
    Light light = on_the_way(0.2);
    light.share_a = 0.992;
    EXPECT_TRUE(light.halves(12).unbalanced);
}

TEST(LightMonitor, ADetuningThatTakesNothingFromTheBiasIsOfABeam) {
    for (const double deficit_ratio : {0.0, 3.6 * 0.12 * 0.12}) {
        Light light{100};
        light.detuning_lambda = 0.12;
        light.deficit_ratio = deficit_ratio;
        EXPECT_EQ(light.halves(2).unbalanced, deficit_ratio == 0.0);
    }
}

// It takes from the beat in one half what it adds in the next; the light knows nothing of it.
TEST(LightMonitor, ARotationThatChangesIsNoFadedBeam) {
    Light light{100};
    for (int k = 0; k < 40; ++k) {
        light.deficit_ratio = k % 2 == 0 ? 0.2 : -0.2;
        const Judged out = light.half();
        EXPECT_TRUE(!out.unbalanced && out.has_mean_square) << k;
    }
}

TEST(LightMonitor, TheBeatOverrulesTheLightAfterEightHalvesUnlessItIsDark) {
    Light light{100};
    light.two_way = false;
    EXPECT_FALSE(light.halves(7).contradicted);
    const Judged out = light.half();
    EXPECT_TRUE(out.contradicted && !out.usable);
    light.dark = true;
    EXPECT_FALSE(light.half().contradicted);
    light.dark = false;
    EXPECT_TRUE(light.halves(8).contradicted);
    light.beats = false;
    EXPECT_FALSE(light.half().contradicted);
}

// The next mode is half a wavelength away, read with the noise: four deviations of 0.0033 beyond it.
TEST(LightMonitor, ADetuningUpToTheNextModeIsUsedWithItsNoise) {
    for (const double sign : {1.0, -1.0}) {
        for (const auto& [detuning_lambda, usable] : {std::pair{0.499, true}, {0.51, true}, {0.516, false}}) {
            Light light;
            light.noise_lambda = 0.0001;
            light.detuning_lambda = sign * detuning_lambda;
            light.deficit_ratio = 10.0;
            EXPECT_EQ(light.halves(3).usable, usable) << sign * detuning_lambda;
        }
    }
}

TEST(LightMonitor, WhatItRemembersOfDamagedLightAreNumbers) {
    LightMonitorState state;
    const std::array<float, 4> damaged{std::numeric_limits<float>::quiet_NaN(), 1.0f, 1.0f, 1.0f};
    const std::array<float, 4> endless{std::numeric_limits<float>::infinity(), 1.0f, 1.0f, 1.0f};
    Lit in(damaged, endless, 1, 0.0, 0.0);
    in.read = {};
    (void)in.seen_by(config, state);
    EXPECT_EQ(state, LightMonitorState{state});
    EXPECT_TRUE(state.last_a == 0.0f && state.last_b == 0.0f);
}

// A beam that fades and comes back within a few halves is still on its way in the first half that is lit again.
TEST(LightMonitor, TheFirstLightAfterADarkHalfIsNoDetuning) {
    Light light;
    EXPECT_TRUE(light.halves(20).has_mean_square);
    light.two_way = false;
    EXPECT_FALSE(light.halves(3).usable);
    light.two_way = true;
    light.share_a = 0.97;
    const Judged first = light.half();
    EXPECT_TRUE(first.unbalanced && !first.has_mean_square && !first.usable);
    light.share_a = 1.0;
    (void)light.half();
    const Judged later = light.half();
    EXPECT_TRUE(later.has_mean_square && later.usable && !later.unbalanced);
}

// A half on its way to a lock, of which the loop takes a part in every sample from `corner` on, through such a
// discriminator.
Judged relocking_half(double start_lambda, double part, std::size_t corner, double noise_lambda, const MonitorLimits& c,
                      std::mt19937& random) {
    static const DiscriminatorCurve curve = test::expansive_curve(31);
    std::normal_distribution<double> normal;
    std::array<float, 16> a{};
    std::array<float, 16> b{};
    double dl = start_lambda;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double signal = 0.332 * (test::expansive(dl) + noise_lambda * normal(random));
        a[k] = static_cast<float>(1000.0 * (1.0 + signal));
        b[k] = static_cast<float>(1000.0 * (1.0 - signal));
        if (k >= corner) dl *= 1.0 - part;
    }
    LightMonitorState state;
    Lit in(a, b, 1, 0.1, 0.01);
    in.detector.curve = curve;
    return in.seen_by(c, state);
}

// However quiet the converters are: the same motion is no noise, and noise is no motion.
TEST(LightMonitor, AFastWayToALockIsNoNoiseHoweverQuietTheLight) {
    std::mt19937 random{5};
    for (const double noise_lambda : {1e-2, 3.3e-3, 1e-3, 5e-4, 2e-4, 1e-4}) {
        const MonitorLimits c{.light_noise = Wavelengths{noise_lambda}, .bias_chi = 3.6};
        int noisy = 0;
        for (const double start_lambda : {-0.22, -0.16, -0.1, 0.05, 0.16, 0.2, 0.22}) {
            for (const double part : {0.0, 0.05, 0.12, 0.2}) {
                for (const std::size_t corner : {0U, 3U, 8U, 11U}) {
                    const Judged out = relocking_half(start_lambda, part, corner, noise_lambda, c, random);
                    EXPECT_TRUE(out.has_mean_square && !out.withheld)
                        << noise_lambda << " from " << start_lambda << " by " << part << " from sample " << corner;
                    noisy += relocking_half(0.3 * start_lambda, part, corner, 20.0 * noise_lambda, c, random).withheld;
                }
            }
        }
        if (noise_lambda <= 1e-3) EXPECT_GT(noisy, 100) << "of 112, at " << noise_lambda;
    }
}

}  // namespace zlg::core::light_monitor_test
