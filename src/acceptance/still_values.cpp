// Bias and noise of records at rest.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/noise/mean_error.hpp>
#include <zlg/noise/noise_terms.hpp>
#include <zlg/study/term_text.hpp>

#include "values.hpp"

namespace zlg::acceptance {
namespace {

using noise::FittedTerm;
using noise::NoiseKind;
using study::AxisResult;

constexpr double significance = 0.05;

double known_s(const AxisResult& axis) { return static_cast<double>(axis.n_known) / axis.rate_hz; }

// Of a coefficient with this relative standard error, as a standard deviation with so many degrees of freedom has it.
double degrees_of(double relative) { return 0.5 / (relative * relative); }

// Of a switched gyro the residuals of the segments tell the error: as they stand, or in means of four where these
// scatter by more than independent ones could (an F test), as correlated noise makes them.
noise::MeanError scatter_of(const noise::ModeSplit& split) {
    constexpr std::size_t together = 4;
    std::vector<double> left, means;
    for (const noise::ModeSegment& s : split.segments)
        left.push_back(s.rate_arcsec_s - split.nonmagnetic_arcsec_s.value - s.mode * split.magnetic_at(s.time_s));
    for (std::size_t k = 0; k + together <= left.size(); k += together)
        means.push_back((left[k] + left[k + 1] + left[k + 2] + left[k + 3]) / together);
    const auto error = [](const std::vector<double>& x, double lost) {
        double squares = 0.0;
        for (const double each : x) squares += each * each;
        const auto n = static_cast<double>(x.size());
        return noise::MeanError{std::sqrt(squares / (n - lost) / n), n - lost};
    };
    const noise::MeanError one = error(left, split.fitted_time_s > 0.0 ? 4.0 : 2.0);
    if (means.size() < 4) return one;
    const noise::MeanError four = error(means, 1.0);
    const boost::math::fisher_f law(four.degrees, one.degrees);
    const double bound = boost::math::quantile(boost::math::complement(law, significance));
    return std::pow(four.sigma / one.sigma, 2) > bound ? four : one;
}

Value noise_value(const char* name, NoiseKind kind, const StillAxis& of) {
    const AxisResult& axis = of.result;
    if (!axis.fit)
        return not_determined(name, fmt::format("run {}: no terms are fitted: {}", of.run->number, axis.no_fit));
    const auto term = std::ranges::find(axis.fit->fitted, kind, &FittedTerm::kind);
    const double factor = study::shown_term(kind).factor;
    Value v{.name = name, .determined = true, .hours = known_s(axis) / 3600.0};
    if (term->found) {
        v.value = term->value * factor;
        v.uncertainty = term->sigma * factor;
        if (kind == NoiseKind::ramp) return v;
        v.law = Law::chi;
        v.degrees = degrees_of(term->sigma / term->value);
    } else if (std::isfinite(term->limit)) {
        v.value = 0.0;
        v.uncertainty = term->limit * factor / z_95;
        v.reason = fmt::format("not found; 95 % of such gyros have less than {:.2g}", term->limit * factor);
    } else {
        return not_determined(
            name, fmt::format(
                      "run {}: the terms do not describe the record: the gyro was moved, or has noise of another kind",
                      of.run->number));
    }
    if (!axis.fit->describes) v.reason = "the terms do not describe the record well: the error is widened";
    return v;
}

}  // namespace

bool scatters(double squares, double degrees) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), squares)) < significance;
}

Value repeatability(std::string_view name, const std::vector<Value>& runs, const char* missing) {
    const auto open = std::ranges::find(runs, false, &Value::determined);
    if (open != runs.end() || runs.size() < 2) return not_determined(name, runs.size() < 2 ? missing : open->reason);
    calibration::Moments spread;
    double hours = 0.0;
    for (const Value& run : runs) spread.add(run.value), hours += run.hours;
    Value v = deviation(name, std::sqrt(spread.variance()), static_cast<double>(runs.size()) - 1.0, hours);
    v.reason = fmt::format("of {} records, their noise included", runs.size());
    return v;
}

Value largest(const std::vector<Value>& runs) {
    const auto open = std::ranges::find(runs, false, &Value::determined);
    return open != runs.end() ? *open : *std::ranges::max_element(runs, {}, &Value::value);
}

Value together(const std::vector<Value>& runs) {
    if (const auto open = std::ranges::find(runs, false, &Value::determined); open != runs.end()) return *open;
    Value v = runs.front();
    if (runs.size() == 1) return v;
    const auto n = static_cast<double>(runs.size());
    double within = 0.0, own_degrees = 0.0, scatter = 0.0, tested = 0.0, moved = 0.0;
    v.value = v.hours = 0.0;
    for (const Value& run : runs) v.value += run.value / n, v.hours += run.hours;
    for (const Value& run : runs) {
        const double squared = run.uncertainty * run.uncertainty;
        within += squared;
        own_degrees += squared * squared / run.degrees;
        moved += squared * run.moves * run.moves;
        scatter += std::pow(run.value - v.value, 2) / (n - 1.0);
        tested += std::pow(run.value - v.value, 2) / squared;
    }
    const bool differ = scatters(tested, n - 1.0);
    v.uncertainty = std::sqrt(differ ? scatter / n : within) / (differ ? 1.0 : n);
    v.degrees = differ ? n - 1.0 : within * within / own_degrees;
    v.moves = differ ? 1.0 : std::sqrt(moved / within);
    v.longer = differ ? Longer::adds_degrees : std::ranges::max_element(runs, {}, &Value::longer)->longer;
    v.reason += fmt::format("{}mean of {} records{}", v.reason.empty() ? "" : ", ", n,
                            differ ? ", which differ by more than their noise" : "");
    return v;
}

Value bias_of(const Plan& plan, const StillAxis& of) {
    const AxisResult& axis = of.result;
    Value v{.name = "bias.deg_h",
            .determined = true,
            .value = axis.mean_arcsec_s,
            .uncertainty = axis.mean_sigma_arcsec_s,
            .degrees = axis.mean_degrees};
    v.hours = known_s(axis) / 3600.0;
    v.longer = axis.mean_white > 0.5 ? Longer::keeps_degrees : Longer::helps_not;
    v.moves = axis.mean_white_sigma_arcsec_s / v.uncertainty;
    if (axis.modes && axis.modes->segments.size() > 1) {
        const numeric::Estimate& part = axis.modes->nonmagnetic_arcsec_s;
        if (!part.determined) return not_determined(v.name, fmt::format("run {}: {}", of.run->number, part.reason));
        const noise::MeanError scatter = scatter_of(*axis.modes);
        v.value = part.value;
        v.uncertainty = scatter.sigma;
        v.degrees = scatter.degrees;
        v.longer = Longer::adds_degrees;
        v.moves = 1.0;
        v.reason = "non-magnetic drift of a switched gyro";
    }
    if (const auto earth = earth_about(plan.unit, of.run->axis)) {
        v.value -= *earth;
        v.reason = fmt::format("{}less the Earth's {:.3f} deg/h", v.reason.empty() ? "" : v.reason + ", ", *earth);
    } else if (plan.unit.latitude_deg) {
        v.reason +=
            fmt::format("{}the Earth's rotation is in it: axis names no direction", v.reason.empty() ? "" : ", ");
    }
    if (!std::isfinite(v.uncertainty))
        return not_determined(v.name, fmt::format("run {}: too short for an error of its mean", of.run->number));
    return v;
}

std::string wrong_way(const Plan& plan, const StillAxis& axis) {
    const auto earth = earth_about(plan.unit, axis.run->axis);
    const double mean = axis.result.mean_arcsec_s;
    if (!earth || std::abs(*earth) < 1.0 || std::abs(mean + *earth) > 0.25 * std::abs(*earth)) return {};
    return fmt::format("the mean rate is {:.3f} deg/h where the Earth turns by {:+.3f}: axis or sign is the wrong one",
                       mean, *earth);
}

std::vector<Value> still_values(const Plan& plan, const std::vector<StillAxis>& axes) {
    std::vector<Value> biases;
    for (const StillAxis& axis : axes) biases.push_back(bias_of(plan, axis));
    std::vector<Value> all{together(biases),
                           repeatability("bias_repeatability.deg_h", biases, "needs two static records or more")};
    const auto longest = std::ranges::max_element(axes, {}, [](const StillAxis& a) { return known_s(a.result); });
    all.push_back(noise_value("bias_instability.deg_h", NoiseKind::bias_instability, *longest));
    all.push_back(noise_value("angle_random_walk.deg_sqrt_h", NoiseKind::angle_random_walk, *longest));
    all.push_back(noise_value("rate_random_walk.deg_h_sqrt_h", NoiseKind::rate_random_walk, *longest));
    all.push_back(noise_value("ramp.deg_h_h", NoiseKind::ramp, *longest));
    all.push_back(noise_value("quantisation.arcsec", NoiseKind::quantisation, *longest));
    return all;
}

}  // namespace zlg::acceptance
