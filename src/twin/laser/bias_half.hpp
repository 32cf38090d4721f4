#pragma once
// The bias field through one half, between two reversals.
//
// A reversal is linear in time and centred on its moment, through zero. Times count from the nominal start of the half.

#include <algorithm>

namespace zlg::twin {

class BiasHalf {
public:
    // plateau_g  with the sign that it has in this half.
    BiasHalf(double plateau_g, double edge_s, double start_s, double end_s)
        : plateau_g_{plateau_g}, half_edge_s_{0.5 * edge_s}, start_s_{start_s}, end_s_{end_s} {}

    // Also beyond the reversals, where the plateau of the neighbour is.
    [[nodiscard]] double at(double time_s) const {
        const double inside_s = std::min(time_s - start_s_, end_s_ - time_s);
        if (inside_s >= half_edge_s_) return plateau_g_;
        if (inside_s <= -half_edge_s_) return -plateau_g_;
        return plateau_g_ * inside_s / half_edge_s_;
    }

    [[nodiscard]] double plateau_g() const { return plateau_g_; }
    [[nodiscard]] double half_edge_s() const { return half_edge_s_; }
    [[nodiscard]] double start_s() const { return start_s_; }
    [[nodiscard]] double end_s() const { return end_s_; }
    [[nodiscard]] double plateau_start_s() const { return start_s_ + half_edge_s_; }
    [[nodiscard]] double plateau_end_s() const { return end_s_ - half_edge_s_; }

private:
    double plateau_g_;
    double half_edge_s_;
    double start_s_;
    double end_s_;
};

}  // namespace zlg::twin
