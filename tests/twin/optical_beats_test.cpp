#include <zlg/twin/optical_beats.hpp>

#include "test.hpp"
#include "turns_from.hpp"

namespace zlg::twin::optical_beats_test {

using std::numbers::pi;

Beat steady(double drive_hz, double amplitude) { return {drive_hz, drive_hz, {}, amplitude}; }
const Beat dark{};

// Winding of the sum, by unwrapping it in steps so small that none turns it by half a turn unless it passes zero.
class DenseWinding {
public:
    void see(std::complex<double> z) {
        if (known_) total_ += std::arg(z / last_) / (2.0 * pi);
        last_ = z;
        known_ = true;
    }
    [[nodiscard]] double total() const { return total_; }

private:
    bool known_ = false;
    std::complex<double> last_{1.0, 0.0};
    double total_ = 0.0;
};

TEST(OpticalBeats, OneBeatCountsItsOwnTurns) {
    OpticalBeats beats{0.0, turns(0.2), turns(0.6)};
    beats.advance(steady(60e3, 1.0), dark, 0.0);
    beats.advance(steady(60e3, 1.0), dark, 1e-3);
    EXPECT_EQ(beats.latch_turns(), 60u);
    EXPECT_EQ(beats.latch_quarters(), 240u);
    beats.advance({60e3, -60e3, {}, 1.0}, dark, 50e-6);
    EXPECT_EQ(beats.latch_quarters(), 240u);
    beats.advance(steady(-60e3, 1.0), dark, 2e-3);
    EXPECT_EQ(beats.latch_turns(), static_cast<std::uint64_t>(-60));
}

TEST(OpticalBeats, TheDarkOneRests) {
    OpticalBeats beats{0.0, turns(0.2), turns(0.6)};
    beats.advance(steady(60e3, 1.0), steady(-60e3, 0.0), 1e-3);
    EXPECT_EQ(beats.right().minus(turns(0.6)), 0.0);
    beats.advance(dark, dark, 1.0);
    EXPECT_NEAR(beats.left().minus(turns(60.2)), 0.0, 1e-9);
    EXPECT_EQ(beats.latch_turns(), 60u);
}

TEST(OpticalBeats, TheSumTurnsWithItsLargerPart) {
    for (const double right : {0.0, 0.3, 0.9, 0.999}) {
        OpticalBeats beats{0.0, turns(0.2), turns(0.6)};
        beats.advance(steady(60e3, 1.0), steady(-57e3, right), 0.0);
        const Turns before = beats.winding();
        beats.advance(steady(60e3, 1.0), steady(-57e3, right), 1.0);
        EXPECT_NEAR(beats.winding().minus(before), 60e3, 0.5) << right;
        OpticalBeats mirrored{0.0, turns(0.2), turns(0.6)};
        mirrored.advance(steady(60e3, right), steady(-57e3, 1.0), 0.0);
        const Turns mirrored_before = mirrored.winding();
        mirrored.advance(steady(60e3, right), steady(-57e3, 1.0), 1.0);
        EXPECT_NEAR(mirrored.winding().minus(mirrored_before), -57e3, 0.5) << right;
    }
}

// Amplitudes that exchange the lead, drives that reverse: the closed form against dense unwrapping.
TEST(OpticalBeats, WindAsTheUnwrappedSumDoes) {
    std::mt19937_64 engine{7};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    for (int trial = 0; trial < 50; ++trial) {
        const double l0 = uniform(engine), r0 = uniform(engine);
        OpticalBeats beats{0.0, turns(l0), turns(r0)};
        DenseWinding dense;
        double l = l0, r = r0;
        double offset = 0.0;
        for (int stretch = 0; stretch < 40; ++stretch) {
            const Beat left{1e4 * (uniform(engine) - 0.5), 1e4 * (uniform(engine) - 0.5), {}, uniform(engine)};
            const Beat right{1e4 * (uniform(engine) - 0.5), 1e4 * (uniform(engine) - 0.5), {}, uniform(engine)};
            const double duration = 1e-3 * uniform(engine);
            beats.advance(left, right, duration);
            const int n = 4000;
            for (int i = 0; i <= n; ++i) {
                const double x = static_cast<double>(i) / n;
                const auto at = [&](const Beat& b, double from) {
                    return 2.0 * pi * (from + duration * x * (b.start_hz + 0.5 * x * (b.end_hz - b.start_hz)));
                };
                dense.see(std::polar(left.amplitude, at(left, l)) + std::polar(right.amplitude, at(right, r)));
            }
            l += 0.5 * (left.start_hz + left.end_hz) * duration;
            r += 0.5 * (right.start_hz + right.end_hz) * duration;
            const double apart = beats.winding().minus(Turns{}) - dense.total();
            if (stretch == 0) offset = apart;
            ASSERT_NEAR(apart, offset, 1e-6) << trial << " " << stretch;
        }
    }
}

// Sampled electronics with the same threshold, over the same stretch.
std::int64_t decoded(double threshold, double left_hz, double right_hz, double left, double right, double duration_s) {
    QuadratureDecoder decoder{threshold, 0};
    const int n = static_cast<int>(200.0 * std::abs(left_hz) * duration_s);
    for (int i = 0; i <= n; ++i) {
        const double t = duration_s * i / n;
        const double l = 2.0 * pi * (0.1 + left_hz * t), r = 2.0 * pi * (0.1 + right_hz * t);
        decoder.see({left * std::sin(l) + right * std::sin(r), left * std::cos(l) + right * std::cos(r)});
    }
    return decoder.quarters();
}

TEST(OpticalBeats, CountWhatTheElectronicsCount) {
    const double threshold = 0.1;
    for (const double right : {0.0, 0.4, 0.8, 1.25, 3.0}) {
        OpticalBeats beats{threshold, turns(0.1), turns(0.1)};
        beats.advance(steady(60e3, 1.0), steady(-57e3, right), 5e-3);
        const auto counted = static_cast<std::int64_t>(beats.latch_quarters());
        EXPECT_NEAR(static_cast<double>(counted),
                    static_cast<double>(decoded(threshold, 60e3, -57e3, 1.0, right, 5e-3)), 1.0)
            << right;
    }
}

TEST(OpticalBeats, NearlyEqualBeatsCountGarbage) {
    const double threshold = 0.1;
    int neither = 0;
    for (const double right : {0.95, 0.99, 1.01, 1.05}) {
        OpticalBeats beats{threshold, turns(0.1), turns(0.1)};
        beats.advance(steady(60e3, 1.0), steady(-57e3, right), 20e-3);
        const double counted = static_cast<double>(static_cast<std::int64_t>(beats.latch_quarters())) / 4.0;
        EXPECT_LT(std::abs(counted), 1200.0);
        if (std::abs(counted - 1200.0) > 30.0 && std::abs(counted + 1140.0) > 30.0) ++neither;
        // The counter goes on from there: a beat that leads again is counted without loss.
        const std::uint64_t before = beats.latch_quarters();
        beats.advance(steady(60e3, 1.0), dark, 1.0);
        EXPECT_NEAR(static_cast<double>(static_cast<std::int64_t>(beats.latch_quarters() - before)), 240e3, 3.0);
    }
    EXPECT_GE(neither, 2);
}

// Forward by three quarters of a turn and back: from there the comparators stand where the way back has left them.
TEST(OpticalBeats, TheCounterHasSeenTheTurningPoint) {
    for (const bool is_left : {true, false}) {
        OpticalBeats beats{0.2, turns(is_left ? 0.24 : 0.0), turns(is_left ? 0.0 : 0.24)};
        const Beat moving{60e3, -60e3, {}, 1.0}, resting{0.0, 0.0, {}, 1.0};
        beats.advance(is_left ? resting : dark, is_left ? dark : resting, 0.0);
        const std::uint64_t before = beats.latch_quarters();
        beats.advance(is_left ? moving : dark, is_left ? dark : moving, 50e-6);
        EXPECT_EQ(beats.latch_quarters() - before, 1u);
    }
}

TEST(OpticalBeats, LightBelowTheThresholdIsNotCounted) {
    OpticalBeats beats{0.1, turns(0.1), turns(0.1)};
    beats.advance(steady(60e3, 1.0), dark, 1e-3);
    const std::uint64_t before = beats.latch_quarters();
    beats.advance(steady(60e3, 0.05), dark, 1e-3);
    EXPECT_EQ(beats.latch_quarters(), before);
}

}  // namespace zlg::twin::optical_beats_test
