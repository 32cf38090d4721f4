#include <zlg/acceptance/verdict.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace zlg::acceptance {
namespace {

bool is_exact(const Value& v) { return v.law == Law::without_error || v.uncertainty == 0.0; }

double student_above(double distance, double degrees) {
    if (!std::isfinite(degrees) || degrees > 1e6) return 0.5 * std::erfc(distance / std::sqrt(2.0));
    const boost::math::students_t law(std::max(degrees, 1.0));
    return boost::math::cdf(boost::math::complement(law, distance));
}

// boost::math overflows at less than 1e-12 of a large order, where nothing is left.
double not_too_far(double x, double order) { return std::max(x, 1e-9 * order); }

// degrees s^2/truth^2 follows chi-square: the truth is above x where that is below degrees s^2/x^2.
double chi_above(const Value& v, double x) {
    if (!(x > 0.0)) return 1.0;
    const double half = 0.5 * std::min(v.degrees, 1e8);
    return boost::math::gamma_p(half, not_too_far(half * std::pow(v.value / x, 2), half));
}

double poisson_above(const Value& v, double x) {
    if (!(x > 0.0)) return x < 0.0 || v.value > 0.0 ? 1.0 : 0.0;
    const double order = std::round(v.value * v.hours) + 1.0;
    return boost::math::gamma_q(order, not_too_far(x * v.hours, order));
}

// A magnitude is below 0 with no probability, whatever its error; a value without one is where it is.
double probability_below(const Value& v, double x) {
    if (x <= 0.0 && is_magnitude(v.name)) return 0.0;
    if (is_exact(v)) return v.value < x ? 1.0 : 0.0;
    return 1.0 - probability_above(v, x);
}

double beyond(const Value& v, const Limit& limit) {
    return std::min(1.0, (limit.max ? probability_above(v, *limit.max) : 0.0) +
                             (limit.min ? probability_below(v, *limit.min) : 0.0));
}

std::optional<Verdict> verdict_of(const Value& v, const Limit& limit, double risk) {
    const double p = beyond(v, limit);
    if (p <= risk) return Verdict::pass;
    return 1.0 - p <= risk ? Verdict::fail : Verdict::undecided;
}

// Whether a record `longer` times as long decides as probably as not, to 1 %: its value is normal about the present one
// with the variance that is lost of what the value scatters by (the predictive law; of a mean over noise that goes on
// as white noise that is less than its uncertainty, which slow noise that may be hidden widens).
bool is_even_chance(const Value& v, const Limit& limit, double risk, double longer) {
    Value later = v;
    later.hours *= longer;
    later.uncertainty /= std::sqrt(longer);
    if (v.longer == Longer::adds_degrees) later.degrees *= longer;
    const boost::math::normal moves(v.value, v.moves * v.uncertainty * std::sqrt(1.0 - 1.0 / longer));
    int decided = 0;
    for (int k = 0; k < 100; ++k) {
        later.value = boost::math::quantile(moves, (k + 0.5) / 100.0);
        if (is_magnitude(v.name)) later.value = std::max(0.0, later.value);
        decided += verdict_of(later, limit, risk) != Verdict::undecided ? 1 : 0;
    }
    return decided >= 50;
}

// The least time by halving, to 1 %.
std::optional<double> hours_of_even_chance(const Value& v, const Limit& limit, double risk) {
    constexpr double longest = 1000.0;
    const auto decides = [&](double longer) { return is_even_chance(v, limit, risk, longer); };
    if (!(v.hours > 0.0 && std::isfinite(v.uncertainty)) || is_exact(v) || v.longer == Longer::helps_not)
        return std::nullopt;
    if (!decides(longest)) return std::nullopt;
    double low = 1.0, high = longest;
    while (high > 1.01 * low) (decides(std::sqrt(low * high)) ? high : low) = std::sqrt(low * high);
    return (high - 1.0) * v.hours;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
    constexpr std::array<std::string_view, 4> names{"pass", "fail", "undecided", "not determined"};
    return names.at(static_cast<std::size_t>(verdict));
}

double probability_above(const Value& v, double x) {
    if (v.law == Law::chi) return chi_above(v, x);
    if (v.law == Law::poisson) return poisson_above(v, x);
    if (is_exact(v)) return v.value > x ? 1.0 : 0.0;
    return student_above((x - v.value) / v.uncertainty, v.degrees);
}

Judged judge(const Value& value, const std::optional<Limit>& limit, double risk) {
    Judged judged{.value = value, .limit = limit, .verdict = {}, .more_hours = {}};
    if (!value.determined) judged.verdict = Verdict::not_determined;
    if (!value.determined || !limit) return judged;
    judged.verdict = verdict_of(value, *limit, risk);
    if (judged.verdict == Verdict::pass) judged.risk = beyond(value, *limit);
    if (judged.verdict == Verdict::undecided) judged.more_hours = hours_of_even_chance(value, *limit, risk);
    return judged;
}

double unit_risk(const std::vector<Judged>& all) {
    double none = 1.0;
    for (const Judged& one : all) none *= 1.0 - one.risk;
    return 1.0 - none;
}

}  // namespace zlg::acceptance
