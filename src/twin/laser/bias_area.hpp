#pragma once
// What the alternating bias contributes to the fringe phase of one half-period.
//
//   cycles = sign p int helicity (1 - chi dl^2 - h(dl)) shape dt,   h = sum of h_k dl^(2 k + 4)
//
// The reversal is a trapezoid through zero, centred on the border of two halves: each end of a half loses the area
// t_e/4 of the plateau, weighted with the detuning that the end has.

#include <array>
#include <cstddef>
#include <span>

#include "laser.hpp"

namespace zlg::twin {

class BiasArea {
public:
    // higher  h_k; it outlives this.
    explicit BiasArea(std::span<const double> higher = {}) : higher_{higher} {}

    // A stretch of time over which the detuning is smooth: its start, middle and end.
    // return  false when the light was not two-way, or changed its mode, within the stretch: no count can be trusted.
    bool add(const Mode& start, const Mode& middle, const Mode& end, double duration_s) {
        const bool one_mode = start.centre_half_lambda == middle.centre_half_lambda &&
                              middle.centre_half_lambda == end.centre_half_lambda;
        if (!one_mode || !start.two_way() || !middle.two_way() || !end.two_way()) return false;
        const double simpson = (square(start) + 4.0 * square(middle) + square(end)) / 6.0;
        const double signed_s = middle.helicity() * duration_s;
        lit_s_ += duration_s;
        helicity_s_ += signed_s;
        shaped_s_ += signed_s;
        shaped_square_ += signed_s * simpson;
        shaped_higher_ += signed_s * (of_higher(start) + 4.0 * of_higher(middle) + of_higher(end)) / 6.0;
        return true;
    }

    // A whole stretch in one mode that is two-way throughout.
    //
    // length_lambda  at the ends and middles of equal pieces: an odd number of them.
    void add_whole(const Mode& mode, std::span<const double> length_lambda, double duration_s) {
        const double signed_s = mode.helicity() * duration_s;
        lit_s_ += duration_s;
        helicity_s_ += signed_s;
        shaped_s_ += signed_s;
        const double centre_lambda = 0.5 * static_cast<double>(mode.centre_half_lambda);
        shaped_square_ += signed_s * mean_square(length_lambda, centre_lambda);
        if (higher_.empty()) return;
        const double third_s = signed_s / (3.0 * static_cast<double>(length_lambda.size() - 1));
        for (std::size_t k = 0; k < length_lambda.size(); ++k) {
            const bool is_end = k == 0 || k + 1 == length_lambda.size();
            shaped_higher_ += (is_end       ? 1.0
                               : k % 2 == 0 ? 2.0
                                            : 4.0) *
                              third_s * of_higher(length_lambda[k] - centre_lambda);
        }
    }

    // Take away what a reversal at this end of the half costs.
    void subtract_edge(const Mode& mode, double edge_s) {
        if (!mode.two_way()) return;
        const double lost_s = 0.25 * edge_s * mode.helicity();
        shaped_s_ -= lost_s;
        shaped_square_ -= lost_s * square(mode);
        shaped_higher_ -= lost_s * of_higher(mode);
    }

    [[nodiscard]] double lit_s() const { return lit_s_; }
    [[nodiscard]] double helicity_s() const { return helicity_s_; }        // int helicity dt
    [[nodiscard]] double shaped_s() const { return shaped_s_; }            // int helicity shape dt
    [[nodiscard]] double shaped_square() const { return shaped_square_; }  // int helicity dl^2 shape dt
    [[nodiscard]] double shaped_higher() const { return shaped_higher_; }  // int helicity h shape dt

private:
    // Simpson's rule: the ends of the pieces with 2, their middles with 4, the outer ends with 1, over 6 for each
    // piece. The sums of ends and of middles, in two lanes each, are sums of whole vectors.
    static double mean_square(std::span<const double> length_lambda, double centre_lambda) {
        const auto sq = [&](std::size_t k) {
            return (length_lambda[k] - centre_lambda) * (length_lambda[k] - centre_lambda);
        };
        const std::size_t last = length_lambda.size() - 1;
        std::array<double, 4> sum{};  // of ends, middles, ends, middles
        const double* x = length_lambda.data();
        std::size_t left = last;
        for (; left >= 4; left -= 4, x += 4) {
            std::array<double, 4> from_centre;
            for (std::size_t lane = 0; lane < 4; ++lane) from_centre[lane] = x[lane] - centre_lambda;
            for (std::size_t lane = 0; lane < 4; ++lane) sum[lane] += from_centre[lane] * from_centre[lane];
        }
        for (std::size_t k = last - left; k < last; ++k) sum[k % 2] += sq(k);
        const double ends = 2.0 * (sum[0] + sum[2]) + (sq(last) - sq(0));
        return (ends + 4.0 * (sum[1] + sum[3])) / (3.0 * static_cast<double>(last));
    }

    static double square(const Mode& mode) { return mode.detuning_lambda * mode.detuning_lambda; }

    [[nodiscard]] double of_higher(double dl) const {
        double sum = 0.0;
        for (std::size_t k = higher_.size(); k > 0; --k) sum = dl * dl * (higher_[k - 1] + sum);
        return dl * dl * sum;
    }
    [[nodiscard]] double of_higher(const Mode& mode) const { return of_higher(mode.detuning_lambda); }

    std::span<const double> higher_;
    double shaped_higher_ = 0.0;
    double lit_s_ = 0.0;
    double helicity_s_ = 0.0;
    double shaped_s_ = 0.0;
    double shaped_square_ = 0.0;
};

}  // namespace zlg::twin
