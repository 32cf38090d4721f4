#include <zlg/core/compensation/counted_stretch.hpp>

#include "support.hpp"

namespace zlg::core::counted_stretch_test {

constexpr CompensationConstants config{};

HalfRecord missed(std::int8_t sign) { return {.bias_sign = sign, .valid = false}; }
HalfRecord read(std::int8_t sign, std::int64_t counts, std::int32_t span = 1) {
    return {.counts = counts, .bias_sign = sign, .span = span};
}

// What the last tick says, of ticks in a row that were not measured.
CountedStretch after(const std::vector<HalfRecord>& halves, CountedStretchState& state) {
    CountedStretch out;
    for (std::size_t h = 0; h + 1 < halves.size(); h += 2) {
        EdgeShiftState edges;
        out = step(config, state, halves[h], halves[h + 1], Hertz{60e3}, {}, edges);
    }
    return out;
}

CountedStretch after(const std::vector<HalfRecord>& halves) {
    CountedStretchState state;
    return after(halves, state);
}

void expect(const CountedStretch& out, std::int64_t n_ticks, std::int64_t counts) {
    EXPECT_EQ(out.n_ticks, n_ticks);
    EXPECT_EQ(out.angle_arcsec, n_ticks > 0 ? 3.263 * static_cast<double>(counts) : 0.0);
}

TEST(CountedStretch, WholeTicksHaveTheSumOfTheirCounts) {
    expect(after({missed(1), read(-1, 7, 2)}), 1, 7);
    expect(after({read(1, 150), missed(-1), missed(1), read(-1, -100, 3)}), 2, 50);
    // A span that ends in the first half of a tick has the tick's second half beside it.
    expect(after({read(1, 150), missed(-1), read(1, 30, 2), read(-1, -150)}), 2, 30);
    expect(after({missed(1), missed(-1), read(1, 160, 3), read(-1, -145)}), 2, 15);
    // Two spans, and no reading at the border between them.
    expect(after({missed(1), missed(-1), read(1, 10, 3), missed(-1), missed(1), read(-1, -4, 3)}), 3, 6);
}

TEST(CountedStretch, BeginsAnewAtEveryReadingAtABorder) {
    expect(after({missed(1), read(-1, 7, 2), missed(1), read(-1, 9, 2)}), 1, 9);
}

TEST(CountedStretch, NothingIsKnownUntilAReadingCoversAll) {
    expect(after({missed(1), missed(-1)}), 0, 0);
    expect(after({missed(1), missed(-1), read(1, 3, 3), missed(-1)}), 0, 0);
    expect(after({missed(1), missed(-1), missed(1), read(-1, 3, 2)}), 0, 0);
    expect(after({missed(1), read(-1, 3, 1)}), 0, 0);
    expect(after({read(1, 150), read(-1, 3, 2)}), 0, 0);
}

TEST(CountedStretch, AnOpenLoopOrAnotherModeHidesTheBias) {
    for (int what = 0; what < 2; ++what) {
        std::vector<HalfRecord> halves{missed(1), missed(-1), missed(1), read(-1, 3, 4)};
        if (what == 0)
            halves[1].loop_closed = false;
        else
            halves[2].mode = halves[3].mode = -1;
        expect(after(halves), 0, 0);
    }
}

TEST(CountedStretch, AfterAnOpenLoopTheFalseDriftIsNotBoundedBeforeATickWasMeasured) {
    CountedStretchState state;
    EdgeShiftState edges;
    HalfRecord open = read(1, 0);
    open.loop_closed = false;
    (void)step(config, state, open, open, Hertz{60e3}, {}, edges);
    expect(after({missed(1), read(-1, 7, 2)}, state), 0, 0);
    begin_anew(state, 0.0);
    expect(after({missed(1), read(-1, 7, 2)}, state), 1, 7);
}

// <dl^2> is the mean square without that of the light's noise; half after half it counts with the sign of the bias.
TEST(CountedStretch, WhatTheDetuningTakesFromTheBiasIsSummedWhereTheLightWasRead) {
    const double noise = config.light_noise.value() * config.light_noise.value();
    const auto seen = [&](HalfRecord half, double sq_lambda2) {
        half.detuning_sq_lambda2 = sq_lambda2 + noise;
        half.detuning_lambda = std::sqrt(sq_lambda2);
        return half;
    };
    std::vector<HalfRecord> halves{seen(missed(1), 0.04), seen(missed(-1), 0.03), seen(missed(1), 0.02),
                                   seen(read(-1, 7, 4), 0.005)};
    CountedStretchState state;
    EXPECT_EQ(after(halves, state).n_ticks, 2);
    EXPECT_TRUE(state.seen);
    EXPECT_NEAR(state.deficit_lambda2, 0.04 - 0.03 + 0.02 - 0.005, 1e-12);
    EXPECT_NEAR(state.deficit_variance_lambda4, (4.0 * 0.095 + 2.0 * 4.0 * noise) * noise / 16.0, 1e-12);
    halves[2].detuning_sq_lambda2 = 0.0;
    EXPECT_EQ(after(halves, state).n_ticks, 2);
    EXPECT_FALSE(state.seen);
}

TEST(CountedStretch, AfterAnOpenLoopTheSumIsKnownWhereTheLightWasReadThroughout) {
    CountedStretchState state;
    state.known_before = false;
    HalfRecord first = missed(1), second = read(-1, 7, 2);
    first.detuning_sq_lambda2 = second.detuning_sq_lambda2 = 0.01;
    expect(after({first, second}, state), 1, 7);
    first.detuning_sq_lambda2 = 0.0;
    expect(after({first, second}, state), 0, 0);
}

// 2.5 us more of plateau at 60 kHz is .15 counts, in each half of its own sign.
TEST(CountedStretch, ShiftedEdgesTakeTheirArea) {
    CountedStretchState state;
    EdgeShiftState edges;
    HalfRecord first = missed(1);
    first.edge_offset_ticks = 25;
    const CountedStretch out = step(config, state, first, read(-1, 100, 2), Hertz{60e3}, {}, edges);
    EXPECT_NEAR(out.angle_arcsec, 3.263 * (100 - 2 * 0.15), 1e-9);
}

}  // namespace zlg::core::counted_stretch_test
