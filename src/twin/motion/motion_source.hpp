#pragma once
// What a Motion draws on: one class per way of giving the angle of the case.

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <zlg/twin/motion.hpp>

namespace zlg::twin {

class Motion::Source {
public:
    Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    virtual ~Source() = default;
    [[nodiscard]] virtual double increment_arcsec(double t0_s, double t1_s) const = 0;
    virtual void increments_arcsec(double t0_s, double step_s, std::span<double> out) const {
        for (std::size_t k = 0; k < out.size(); ++k) {
            const auto n = static_cast<double>(k);
            out[k] = increment_arcsec(t0_s + n * step_s, t0_s + (n + 1.0) * step_s);
        }
    }
    [[nodiscard]] virtual double duration_s() const { return std::numeric_limits<double>::infinity(); }
    [[nodiscard]] virtual double fastest_arcsec_s() const { return std::numeric_limits<double>::infinity(); }
    [[nodiscard]] virtual bool is_even() const { return false; }
};

std::shared_ptr<const Motion::Source> make_sines(double rate_arcsec_s, const std::vector<Sine>& sines);
std::shared_ptr<const Motion::Source> make_steps(std::shared_ptr<const Motion::Source> base,
                                                 std::shared_ptr<const std::vector<RateStep>> steps);
std::shared_ptr<const Motion::Source> make_sampled(std::vector<double> increment_arcsec, double rate_hz);

}  // namespace zlg::twin
