#include "row_rules.hpp"

#include <fmt/format.h>

namespace zlg::logs {

std::string out_of_order(std::int64_t value, std::int64_t expected) {
    return fmt::format("{}; expected {}", value > expected ? "leaves a hole" : "is a repetition", expected);
}

std::string not_alternating(std::int64_t value) {
    return fmt::format("as in the row before; expected {:+d}: it must alternate", -value);
}

std::string out_of_range(std::string_view allowed) { return fmt::format("is out of range; allowed is {}", allowed); }

std::string beyond_missed(const MissedRows& missed) {
    return fmt::format(
        "is out of range; allowed is 1..{}: this row and the {} directly before it with valid 0, counts 0, span 1",
        missed.n() + 1, missed.n());
}

std::string no_detuning(double lambda) {
    if (!is_finite(lambda)) return std::string{not_finite};
    return out_of_range(fmt::format("{:g}..{:g} wavelengths", -max_detuning_lambda, max_detuning_lambda));
}

std::string no_detuning_sq(double lambda2, double mean_lambda) {
    if (!is_finite(lambda2)) return std::string{not_finite};
    const double least = min_detuning_sq(mean_lambda);
    if (!(least > 0.0)) return out_of_range(fmt::format("0..{:g} wavelengths^2", max_detuning_sq_lambda2));
    return out_of_range(
        fmt::format("0 (not known) or {:.4g}..{:g} wavelengths^2, for the mean, detuning_lambda, is {:g}", least,
                    max_detuning_sq_lambda2, mean_lambda));
}

std::string range(std::int64_t min, std::int64_t max) { return fmt::format("{}..{}", min, max); }

}  // namespace zlg::logs
