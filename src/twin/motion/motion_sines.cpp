#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <zlg/core/common/maths.hpp>

#include "motion_source.hpp"

namespace zlg::twin {
namespace {

void require_finite(const char* what, double value) {
    if (!std::isfinite(value)) {
        throw std::invalid_argument(fmt::format("motion: {} is {}, allowed is a finite number", what, value));
    }
}

//   int A sin(w t + p) dt = A (t1 - t0) sinc(w (t1 - t0)/2) sin(w (t0 + t1)/2 + p)
//
// A product, not a difference of two angles: nothing cancels, however short the step.
class Sines final : public Motion::Source {
public:
    Sines(double rate_arcsec_s, std::vector<Sine> sines) : rate_arcsec_s_{rate_arcsec_s}, sines_{std::move(sines)} {
        require_finite("rate_arcsec_s", rate_arcsec_s_);
        for (const Sine& sine : sines_) {
            require_finite("amplitude_arcsec_s", sine.amplitude_arcsec_s);
            require_finite("frequency_hz", sine.frequency_hz);
            require_finite("phase_deg", sine.phase_deg);
        }
    }

    [[nodiscard]] double increment_arcsec(double t0_s, double t1_s) const override {
        const double dt_s = t1_s - t0_s;
        const double middle_s = 0.5 * (t0_s + t1_s);
        double sum = rate_arcsec_s_ * dt_s;
        for (const Sine& sine : sines_) {
            const double w = 2.0 * std::numbers::pi * sine.frequency_hz;
            const double half_turn = 0.5 * w * dt_s;
            const double sinc = half_turn == 0.0 ? 1.0 : core::maths::sin(half_turn) / half_turn;
            const double phase = sine.phase_deg * (std::numbers::pi / 180.0);
            sum += sine.amplitude_arcsec_s * dt_s * sinc * core::maths::sin(w * middle_s + phase);
        }
        return sum;
    }

private:
    double rate_arcsec_s_;
    std::vector<Sine> sines_;
};

}  // namespace

std::shared_ptr<const Motion::Source> make_sines(double rate_arcsec_s, std::vector<Sine> sines) {
    return std::make_shared<Sines>(rate_arcsec_s, std::move(sines));
}

}  // namespace zlg::twin
