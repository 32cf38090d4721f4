#include "ramps.hpp"

#include <memory>
#include <utility>
#include <vector>

#include <zlg/chance/draw.hpp>

#include "forecast.hpp"

namespace zlg::choice {

twin::Motion with_ramps(const Requirement& requirement, const config::Config& gyro, twin::Motion base) {
    const double slope = requirement.angular_acceleration_arcsec_s2;
    if (slope == 0.0) return base;
    chance::Draw draw{gyro.run.seed, chance::Cause::sweep_parameter, 0, chance::thing_of("ramps")};
    const config::Switching& s = gyro.switching;
    const bool is_fixed = s.schedule == config::Schedule::fixed;
    const double run_s = gyro.run.duration_s.value_or(requirement.run_s);
    const double begin_s =
        is_fixed ? first_switch_s({.interval_s = s.interval_s, .first_segment = s.first_segment}) : draw.uniform();
    const double period_s = is_fixed ? s.interval_s : ramp_s;
    std::vector<twin::RateStep> steps;
    bool is_up = true;
    for (std::int64_t k = 0;; ++k) {
        const double at_s = begin_s + static_cast<double>(k) * period_s - (is_fixed ? ramp_s * draw.uniform() : 0.0);
        if (at_s > run_s) break;
        const double peak = slope * ramp_s;
        steps.push_back({at_s, is_up ? 0.0 : peak, is_up ? slope : -slope});
        if (is_fixed) steps.push_back({at_s + ramp_s, is_up ? peak : 0.0, 0.0});
        is_up = !is_up;
    }
    steps.push_back({run_s + 2.0 * ramp_s, 0.0, 0.0});
    return twin::Motion::with_steps(std::move(base),
                                    std::make_shared<const std::vector<twin::RateStep>>(std::move(steps)));
}

}  // namespace zlg::choice
