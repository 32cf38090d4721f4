#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

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

// sin(x)/x. Its Taylor series where seven terms leave less than half a unit in the last place.
double sinc(double x) {
    if (!(std::abs(x) < 0.5)) return core::maths::sin(x) / x;
    const double z = x * x;
    const double zz = z * z;
    return (1.0 - z / 6.0) +
           zz * ((1.0 / 120.0 - z / 5040.0) + zz * ((1.0 / 362880.0 - z / 39916800.0) + zz / 6227020800.0));
}

//   int A sin(w t + p) dt = A (t1 - t0) sinc(w (t1 - t0)/2) sin(w (t0 + t1)/2 + p)
//
// A product, not a difference of two angles: nothing cancels, however short the step.
class Sines final : public Motion::Source {
public:
    Sines(double rate_arcsec_s, const std::vector<Sine>& sines) : rate_arcsec_s_{rate_arcsec_s} {
        require_finite("rate_arcsec_s", rate_arcsec_s_);
        for (const Sine& sine : sines) {
            require_finite("amplitude_arcsec_s", sine.amplitude_arcsec_s);
            require_finite("frequency_hz", sine.frequency_hz);
            require_finite("phase_deg", sine.phase_deg);
            waves_.push_back({.amplitude_arcsec_s = sine.amplitude_arcsec_s,
                              .rad_s = 2.0 * std::numbers::pi * sine.frequency_hz,
                              .phase_rad = sine.phase_deg * (std::numbers::pi / 180.0)});
        }
    }

    [[nodiscard]] double increment_arcsec(double t0_s, double t1_s) const override {
        const double dt_s = t1_s - t0_s;
        const double middle_s = 0.5 * (t0_s + t1_s);
        double sum = rate_arcsec_s_ * dt_s;
        for (const Wave& wave : waves_) {
            sum += wave.amplitude_arcsec_s * dt_s * sinc(0.5 * wave.rad_s * dt_s) *
                   core::maths::sin(wave.rad_s * middle_s + wave.phase_rad);
        }
        return sum;
    }

    // The phase of a wave turns on from step to step, anew from its sine at every 64th.
    void increments_arcsec(double t0_s, double step_s, std::span<double> out) const override {
        for (double& x : out) x = rate_arcsec_s_ * step_s;
        for (const Wave& wave : waves_) {
            const double size = wave.amplitude_arcsec_s * step_s * sinc(0.5 * wave.rad_s * step_s);
            const double turn = wave.rad_s * step_s;
            const double turn_sin = core::maths::sin(turn), turn_cos = core::maths::cos(turn);
            double sine = 0.0, cosine = 0.0;
            for (std::size_t k = 0; k < out.size(); ++k) {
                if (k % 64 == 0) {
                    const double phase = wave.rad_s * (t0_s + (static_cast<double>(k) + 0.5) * step_s) + wave.phase_rad;
                    sine = size * core::maths::sin(phase);
                    cosine = size * core::maths::cos(phase);
                }
                out[k] += sine;
                const double next = sine * turn_cos + cosine * turn_sin;
                cosine = cosine * turn_cos - sine * turn_sin;
                sine = next;
            }
        }
    }

    [[nodiscard]] double fastest_arcsec_s() const override {
        double sum = std::abs(rate_arcsec_s_);
        for (const Wave& wave : waves_) sum += std::abs(wave.amplitude_arcsec_s);
        return sum;
    }

    [[nodiscard]] bool is_even() const override { return waves_.empty(); }

private:
    struct Wave {
        double amplitude_arcsec_s;
        double rad_s;
        double phase_rad;
    };

    double rate_arcsec_s_;
    std::vector<Wave> waves_;
};

}  // namespace

std::shared_ptr<const Motion::Source> make_sines(double rate_arcsec_s, const std::vector<Sine>& sines) {
    return std::make_shared<Sines>(rate_arcsec_s, sines);
}

}  // namespace zlg::twin
