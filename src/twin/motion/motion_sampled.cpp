#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "motion_source.hpp"

namespace zlg::twin {
namespace {

// The angle passes exactly through the sum of the increments at every row border and is a cubic between them, whose
// slope at a border is the mean of the two rows that meet there (Catmull-Rom on the cumulative angle). The first and
// the last row are continued as they are.
//
// Angles are measured from the border of their own row, so hours of rotation take no digits from an increment.
// cost  of increment_arcsec: one addition per row that it spans.
class Sampled final : public Motion::Source {
public:
    Sampled(std::vector<double> increment_arcsec, double rate_hz)
        : increment_{std::move(increment_arcsec)}, rate_hz_{rate_hz} {
        if (!(rate_hz_ > 0.0 && std::isfinite(rate_hz_))) {
            throw std::invalid_argument(fmt::format("motion: rate_hz is {}, allowed is finite and > 0", rate_hz_));
        }
        if (increment_.empty()) throw std::invalid_argument("motion: 0 increments, allowed is 1 or more");
        for (std::size_t row = 0; row < increment_.size(); ++row) {
            if (!std::isfinite(increment_[row])) {
                throw std::invalid_argument(
                    fmt::format("motion: increment {} is {}, allowed is a finite number", row, increment_[row]));
            }
        }
    }

    [[nodiscard]] double increment_arcsec(double t0_s, double t1_s) const override {
        if (t1_s < t0_s) return -increment_arcsec(t1_s, t0_s);
        const Place from = place(t0_s);
        const Place to = place(t1_s);
        double whole_rows = 0.0;
        for (std::size_t row = from.row; row < to.row; ++row) whole_rows += increment_[row];
        return whole_rows + (within_row(to) - within_row(from));
    }

    [[nodiscard]] double duration_s() const override { return static_cast<double>(increment_.size()) / rate_hz_; }

    // The slope of the cubic between two rows is at most twice that of the steeper one.
    [[nodiscard]] double fastest_arcsec_s() const override {
        double most = 0.0;
        for (const double increment : increment_) most = std::max(most, std::abs(increment));
        return 2.0 * most * rate_hz_;
    }

private:
    struct Place {
        std::size_t row;
        double fraction;  // of the row, 0..1
    };

    [[nodiscard]] Place place(double t_s) const {
        const auto n_rows = static_cast<double>(increment_.size());
        const double x = std::min(std::max(0.0, t_s * rate_hz_), n_rows);
        const double row = std::min(std::floor(x), n_rows - 1.0);
        return {static_cast<std::size_t>(row), x - row};
    }

    // Rotation from the start of the row to the place in it.
    [[nodiscard]] double within_row(Place at) const {
        const double here = increment_[at.row];
        const double before = at.row > 0 ? increment_[at.row - 1] : here;
        const double after = at.row + 1 < increment_.size() ? increment_[at.row + 1] : here;
        const double slope_start = 0.5 * (before + here);
        const double slope_end = 0.5 * (here + after);
        const double s = at.fraction;
        return s * (slope_start +
                    s * (3.0 * here - 2.0 * slope_start - slope_end + s * (slope_start + slope_end - 2.0 * here)));
    }

    std::vector<double> increment_;
    double rate_hz_;
};

}  // namespace

std::shared_ptr<const Motion::Source> make_sampled(std::vector<double> increment_arcsec, double rate_hz) {
    return std::make_shared<Sampled>(std::move(increment_arcsec), rate_hz);
}

}  // namespace zlg::twin
