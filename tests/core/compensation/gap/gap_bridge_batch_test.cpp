// A batch in memory and a stream that stops and goes on give the same bits.

#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {
namespace gap_bridge_batch_test {

// Numbers that look random and are the same everywhere.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_{seed} {}
    std::uint32_t below(std::uint32_t n) {
        state_ = 1664525u * state_ + 1013904223u;
        return (state_ >> 8) % n;
    }

private:
    std::uint32_t state_;
};

// Gaps of 1 to 20 ticks, with 1 to 30 measured ticks between.
std::vector<TickInput> ticks_with_gaps(std::uint32_t seed, std::size_t n) {
    Random random{seed};
    std::vector<TickInput> ticks;
    bool measured = random.below(2) == 0;
    while (ticks.size() < n) {
        const std::uint32_t length = 1 + random.below(measured ? 30 : 20);
        for (std::uint32_t k = 0; k < length; ++k) {
            TickInput tick{.measured = measured, .value_arcsec = 3.263 * random.below(2000), .variance_arcsec2 = 1.77};
            tick.amend_previous = measured && k == 1 && random.below(2) == 0;
            tick.amend_arcsec = 0.01 * random.below(100);
            ticks.push_back(tick);
        }
        measured = !measured;
    }
    return ticks;
}

struct Result {
    std::vector<AngleRow> rows;
    std::vector<double> delivered;
    std::vector<GapReport> gaps;

    friend bool operator==(const Result&, const Result&) = default;
};

void take(const AngleSample& sample, Result& result) {
    result.delivered.push_back(sample.dtheta_arcsec);
    if (sample.has_final) result.rows.push_back(sample.final_row);
    if (sample.has_gap) result.gaps.push_back(sample.gap);
}

void finish(const GapBridgeConfig& config, GapBridgeState& state, Result& result) {
    for (auto out = drain({}, config, state); out.has_row || out.has_gap; out = drain({}, config, state)) {
        if (out.has_gap) result.gaps.push_back(out.gap);
        if (out.has_row) result.rows.push_back(out.row);
    }
}

Result batch(const GapBridgeConfig& config, const std::vector<TickInput>& ticks) {
    Result result;
    GapBridgeState state;
    for (const TickInput& tick : ticks) take(step({}, config, state, tick), result);
    finish(config, state, result);
    return result;
}

// Tick by tick, in a state that is put away after each and taken up again.
Result stream(const GapBridgeConfig& config, const std::vector<TickInput>& ticks) {
    Result result;
    std::optional<GapBridgeState> kept{GapBridgeState{}};
    for (const TickInput& tick : ticks) {
        GapBridgeState state = *kept;
        kept.reset();
        take(step({}, config, state, tick), result);
        kept = state;
    }
    finish(config, *kept, result);
    return result;
}

class EachConfig : public testing::TestWithParam<GapBridgeConfig> {};

TEST_P(EachConfig, StreamAndBatchGiveTheSameBits) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const std::vector<TickInput> ticks = ticks_with_gaps(seed, 2000);
        const Result whole = batch(GetParam(), ticks);
        ASSERT_EQ(whole.rows.size(), ticks.size());
        ASSERT_GT(whole.gaps.size(), 50u);
        EXPECT_TRUE(whole == stream(GetParam(), ticks)) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(
    GapBridgeBatch, EachConfig,
    testing::Values(GapBridgeConfig{}, GapBridgeConfig{.method = BridgeMethod::linear},
                    GapBridgeConfig{.extrapolation_points = 8, .points_before = 8, .points_after = 8},
                    GapBridgeConfig{.extrapolation_points = 8, .points_before = 5, .points_after = 1}));

}  // namespace gap_bridge_batch_test
}  // namespace zlg::core
