#include <zlg/design/initial_miss.hpp>

#include <algorithm>
#include <cmath>

#include "range_check.hpp"

namespace zlg::design {
namespace {

constexpr std::string_view where = "initial miss";
constexpr double move_lambda = 0.5;

void check(const MissCauses& c) {
    require_positive(where, "half_wave_v", c.half_wave_v);
    require_not_negative(where, "half_wave_error_ratio", c.half_wave_error_ratio);
    require_positive(where, "range_v", c.range_v);
    require(c.dac_bits >= 1 && c.dac_bits <= 32, where, "dac_bits", c.dac_bits, "1..32");
    require_not_negative(where, "hysteresis_ratio", c.hysteresis_ratio);
    require(c.hysteresis_stroke_v >= c.half_wave_v && std::isfinite(c.hysteresis_stroke_v), where,
            "hysteresis_stroke_v", c.hysteresis_stroke_v, fmt::format("from half_wave_v = {}", c.half_wave_v));
    require_not_negative(where, "creep_ratio_per_decade", c.creep_ratio_per_decade);
    require_positive(where, "settling_s", c.settling_s);
    require(c.dwell_s >= c.settling_s && std::isfinite(c.dwell_s), where, "dwell_s", c.dwell_s,
            fmt::format("from settling_s = {}", c.settling_s));
}

}  // namespace

InitialMiss initial_miss(const MissCauses& c) {
    check(c);
    const double lambda_per_v = move_lambda / c.half_wave_v;
    const double part_of_stroke = c.half_wave_v / c.hysteresis_stroke_v;
    InitialMiss miss;
    miss.part = {{
        {"half wave", move_lambda * c.half_wave_error_ratio},
        {"DAC step", 0.5 * std::ldexp(c.range_v, -c.dac_bits) * lambda_per_v},
        {"hysteresis", c.hysteresis_ratio * c.hysteresis_stroke_v * lambda_per_v * part_of_stroke * part_of_stroke},
        {"creep", move_lambda * c.creep_ratio_per_decade * std::log10(c.dwell_s / c.settling_s)},
    }};
    for (const MissPart& part : miss.part) {
        miss.root_sum_square_lambda = std::hypot(miss.root_sum_square_lambda, part.lambda);
        miss.worst_lambda += part.lambda;
    }
    return miss;
}

double voltage_of_miss_v(double miss_lambda, double half_wave_v) {
    require_finite(where, "miss_lambda", miss_lambda);
    require_positive(where, "half_wave_v", half_wave_v);
    return miss_lambda * half_wave_v / move_lambda;
}

double TwoModeDetector::operator()(double detuning_lambda) const {
    const double dl = std::abs(detuning_lambda);
    if (dl > dark_from_lambda && dl < dark_to_lambda) return 0.0;
    return std::copysign(per_lambda * std::min(dl, 0.5 - dl), detuning_lambda);
}

double capture_range_lambda(const Detector& detector, double threshold) {
    require_not_negative("capture range", "threshold", threshold);
    constexpr int n_steps = 2500;
    const auto pulls = [&](double dl) { return detector(dl) > threshold && detector(-dl) < -threshold; };
    int first = 1;
    while (first < n_steps && !pulls(0.5 * first / n_steps)) ++first;
    if (first == n_steps) return 0.0;
    int last = first;
    while (last < n_steps && pulls(0.5 * (last + 1) / n_steps)) ++last;
    double inside = 0.5 * last / n_steps;
    double outside = std::min(0.5, 0.5 * (last + 1) / n_steps);
    while (outside - inside > 1e-10) {
        const double middle = 0.5 * (inside + outside);
        (pulls(middle) ? inside : outside) = middle;
    }
    return inside;
}

}  // namespace zlg::design
