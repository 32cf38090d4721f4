#pragma once
// What the synchronous detector of the electronics makes of a laser's light: the discriminator, in parts of its slope.
//
//   s(perimeter) = A(perimeter, plateau)/A'(settled)         A = (cw - ccw)/(cw + ccw), light of both modes
//
// For small detunings it is the detuning itself, negative for the right mode; the reference polarity is the caller's.

#include <cmath>
#include <cstddef>
#include <vector>

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/laser_table.hpp>

namespace zlg::twin {

class ErrorSignal {
public:
    // errors  as averaged_laser.
    ErrorSignal(const LaserTable& table, double plateau_g);

    // perimeter_lambda  within +-1e15.
    // accuracy          1e-4 of the largest signal beside a kink, 1e-7 elsewhere.
    [[nodiscard]] double at(double perimeter_lambda) const {
        const double place = (perimeter_lambda - std::floor(perimeter_lambda)) * n_lines;
        const auto k = static_cast<std::size_t>(place);
        return value_[k] + (place - static_cast<double>(k)) * (value_[k + 1] - value_[k]);
    }

    // Where the signal is zero, as detuning of either mode.
    [[nodiscard]] double settled_lambda() const { return averaged_.settled_lambda; }
    // So far from there it is straight to 2e-4.
    [[nodiscard]] double straight_lambda() const { return straight_lambda_; }
    [[nodiscard]] const AveragedLaser& averaged() const { return averaged_; }

private:
    static constexpr std::size_t n_lines = 16384;

    AveragedLaser averaged_;
    std::vector<double> value_;
    double straight_lambda_ = 0.0;
};

}  // namespace zlg::twin
