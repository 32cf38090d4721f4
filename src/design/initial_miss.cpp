#include <zlg/design/initial_miss.hpp>

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

}  // namespace zlg::design
