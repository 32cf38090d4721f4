#pragma once
// From the two detector signals to a count: comparators with hysteresis and the up/down logic behind them.
//
//   s = sum_m A_m sin psi_m,  c = sum_m A_m cos psi_m
//
// A phasor that turns forward through (s, c) = (0, A) counts up, four counts a turn; one count a turn is the same
// counter without its two lowest bits.

#include <cstdint>

#include <zlg/twin/beat_phase.hpp>

namespace zlg::twin {

struct Signals {
    double s = 0.0;
    double c = 0.0;
};

// The electronics as they are: sample by sample. Needs several samples a turn.
class QuadratureDecoder {
public:
    // threshold  a comparator goes high above +threshold and low below -threshold.
    QuadratureDecoder(double threshold, std::int64_t quarters) : threshold_{threshold}, quarters_{quarters} {
        set_quadrant(static_cast<int>(quarters & 3));
    }

    void see(const Signals& signals);

    [[nodiscard]] std::int64_t quarters() const { return quarters_; }
    [[nodiscard]] int quadrant() const { return s_high_ ? (c_high_ ? 0 : 1) : (c_high_ ? 3 : 2); }
    // Both comparators changed at once, so the direction is unknown and two counts are lost.
    [[nodiscard]] std::int64_t n_ambiguous() const { return n_ambiguous_; }

private:
    void set_quadrant(int quadrant) {
        s_high_ = quadrant < 2;
        c_high_ = quadrant == 0 || quadrant == 3;
    }

    double threshold_;
    std::int64_t quarters_;
    std::int64_t n_ambiguous_ = 0;
    bool s_high_ = true;
    bool c_high_ = true;
};

// What the decoder would show, from the phase of the phasor at its turning points only.
//
// A comparator of threshold h switches late by asin(h/A): the count follows the phase like a body with play, and a
// phase that rocks by less than the play moves nothing.
class QuarterTurns {
public:
    explicit QuarterTurns(const Turns& phase) : quarters_{floor_of(phase)} {}

    // lag_turns  asin(h/A)/(2 pi), below 1/8: A > 1.42 h.
    void see(const Turns& phase, double lag_turns);

    [[nodiscard]] std::int64_t value() const { return quarters_; }
    void set(std::int64_t quarters) { quarters_ = quarters; }

    [[nodiscard]] static std::int64_t floor_of(const Turns& phase);

private:
    std::int64_t quarters_;
};

}  // namespace zlg::twin
