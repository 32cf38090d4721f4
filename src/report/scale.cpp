#include "scale.hpp"

#include <algorithm>

namespace zlg::report {
namespace {

// Beyond these a span or a power of ten leaves the range of a double.
constexpr double largest = 1e300;
constexpr double smallest = 1e-300;

Extent widened_linear(double centre) {
    const double half = std::fabs(centre) < smallest ? 1.0 : 0.1 * std::fabs(centre);
    return {centre - half, centre + half};
}

}  // namespace

void Extent::add(double value) {
    if (!std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
}

double on_axis(double value, bool log) {
    if (!log) return value;
    return value > 0.0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
}

Extent limits(Extent data, bool log) {
    if (data.empty()) return {0.0, 1.0};
    const double bound = log ? std::log10(largest) : largest;
    const double lo = std::clamp(data.lo, -bound, bound);
    const double hi = std::clamp(data.hi, -bound, bound);
    const double size = std::max(std::fabs(lo), std::fabs(hi));
    const double too_small = log ? 1e-9 : std::max(1e-12 * size, smallest);
    if (!(hi - lo > too_small)) return log ? Extent{lo - 0.5, hi + 0.5} : widened_linear(0.5 * lo + 0.5 * hi);
    const double air = 0.04 * (hi - lo);
    return {lo - air, hi + air};
}

double Scale::at_axis(double axis_value) const {
    const double held = std::clamp(axis_value, limits.lo, limits.hi);
    return at_lo + (held - limits.lo) / (limits.hi - limits.lo) * (at_hi - at_lo);
}

double Scale::at(double value) const {
    const double axis_value = on_axis(value, log);
    return at_axis(std::isnan(axis_value) ? limits.lo : axis_value);
}

}  // namespace zlg::report
