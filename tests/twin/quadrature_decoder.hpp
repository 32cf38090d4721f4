#pragma once
// The comparators with hysteresis and the up/down logic behind them, to judge the count by.

#include <cstdint>

#include <zlg/twin/quadrature.hpp>

namespace zlg::twin {

[[nodiscard]] inline bool switched(bool high, double signal, double threshold) {
    if (signal > threshold) return true;
    if (signal < -threshold) return false;
    return high;
}

// The electronics as they are: sample by sample. Needs several samples a turn.
class QuadratureDecoder {
public:
    // threshold  a comparator goes high above +threshold and low below -threshold.
    QuadratureDecoder(double threshold, std::int64_t quarters) : threshold_{threshold}, quarters_{quarters} {
        set_quadrant(static_cast<int>(quarters & 3));
    }

    void see(const Signals& signals) {
        const int before = quadrant();
        s_high_ = switched(s_high_, signals.s, threshold_);
        c_high_ = switched(c_high_, signals.c, threshold_);
        switch ((quadrant() - before) & 3) {
            case 1:
                ++quarters_;
                break;
            case 2:
                ++n_ambiguous_;
                break;
            case 3:
                --quarters_;
                break;
            default:
                break;
        }
    }

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

}  // namespace zlg::twin
