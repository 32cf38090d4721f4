#include <zlg/noise/noise_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <zlg/deviations/angle_record.hpp>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>

#include "bandwidth.hpp"
#include "noise_selection.hpp"
#include "ramp.hpp"
#include "sinusoids.hpp"
#include "term_sets.hpp"

namespace zlg::noise {
namespace {

// The octaves up to a sixth of it are four averaging times, as many as there are smooth terms without a Markov time.
constexpr std::int64_t min_intervals = 64;
// The longest averaging time fits into the record so many times; beyond it a variance has one degree of freedom, too
// few for a weight.
constexpr std::int64_t min_lengths = 6;
constexpr double ramp_chance = 0.002;   // of a ramp in noise alone: one record of 500, as of a line of the spectrum
constexpr double most_missing = 0.05;   // of the samples, where the fit is that of a whole record
constexpr double one_sided_95 = 1.645;  // quantile of the normal law

// read_at_s is where the Allan deviation of the term alone has the value of its coefficient: the tau at which its
// variance is 1 for a coefficient of 1 (3 Q^2/tau^2, N^2/tau, K^2 tau/3, R^2 tau^2/2).
struct KindFacts {
    std::string_view name, unit;
    double read_at_s = FittedTerm::none;
};
constexpr std::array<KindFacts, 7> kinds{{{"quantisation", "arcsec", std::numbers::sqrt3},
                                          {"angle random walk", "arcsec/sqrt(s)", 1.0},
                                          {"bias instability", "arcsec/s"},
                                          {"rate random walk", "arcsec/s/sqrt(s)", 3.0},
                                          {"ramp", "arcsec/s^2", std::numbers::sqrt2},
                                          {"exponentially correlated", "arcsec/s"},
                                          {"sinusoid", "arcsec/s"}}};

const KindFacts& facts(NoiseKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

// Of a counter that hardly counts what one count is worth as a rate: all rates lie on a few steps of one size, and the
// turn of one sample is near a whole number of them, so that its rounding goes on from sample to sample as the turn
// does, and is no noise of single angles. 0: it is none.
double coarse_step(std::span<const double> rates) {
    constexpr double most_steps = 8.0, near = 0.05;
    double first = FittedTerm::none, step = std::numeric_limits<double>::infinity(), low = 0.0, high = 0.0;
    double mean = 0.0, n = 0.0;
    for (const double rate : rates) {
        if (!std::isfinite(rate)) continue;
        if (std::isnan(first)) first = rate;
        const double above = rate - first;
        if (above != 0.0) step = std::min(step, std::abs(above));
        low = std::min(low, above);
        high = std::max(high, above);
        if (high - low > most_steps * step) return 0.0;
        n += 1.0;
        mean += (rate - mean) / n;
    }
    const auto part = [step](double rate) { return std::abs(rate / step - std::round(rate / step)); };
    const auto is_step = [&](double rate) { return !std::isfinite(rate) || part(rate - first) < 1e-3; };
    return std::ranges::all_of(rates, is_step) && part(first) < 1e-3 && part(mean) < near ? step : 0.0;
}

// Where samples are missing all over, few long means are known but for a tenth: those of which less is known count
// there.
deviations::DeviationCurve hadamard_curve(const deviations::AngleRecord& record, double missing_ratio,
                                          const NoiseFitOptions& options) {
    const std::int64_t n = record.n_intervals();
    const auto curve_of = [&](double least_known_ratio) {
        return deviation(record, deviations::DeviationKind::ohdev,
                         deviations::octave_factors(std::max<std::int64_t>(1, n / min_lengths)),
                         {.least_known_ratio = least_known_ratio, .noise = 0, .threads = options.threads});
    };
    const auto curve = curve_of(options.least_known_ratio);
    if (missing_ratio <= most_missing) return curve;
    auto wide = curve_of(std::max(0.1, 1.0 - 2.0 * missing_ratio));
    constexpr std::int64_t fewest = 100;  // of the differences one in so many
    for (deviations::DeviationPoint& point : wide.points)
        for (const deviations::DeviationPoint& known : curve.points)
            if (known.m == point.m && fewest * known.terms > n - 3 * known.m) point = known;
    return wide;
}

// step  of a counter that hardly counts, 0: it is none.
HadamardPoints hadamard_points(std::vector<double>& rates, double rate_hz, double step,
                               const NoiseFitOptions& options) {
    const auto n = std::ssize(rates);
    double missing_ratio = 0.0;
    deviations::DeviationCurve curve;
    deviations::use_in_place(rates, rate_hz, [&](const deviations::AngleRecord& record) {
        missing_ratio = 1.0 - static_cast<double>(record.n_known()) / static_cast<double>(n);
        curve = hadamard_curve(record, missing_ratio, options);
    });
    // What rounding may add to a variance, whose four angles it shifts by up to a count, is a small part of it.
    constexpr double small_part = 0.1, most_rounding = 0.6;
    const double rounding = most_rounding / small_part * std::pow(step / rate_hz, 2);
    HadamardPoints points{.tau_0_s = 1.0 / rate_hz, .n_intervals = n};
    for (std::size_t k = 1; k < rates.size(); ++k)
        if (std::isfinite(rates[k - 1]) && !std::isfinite(rates[k]))
            points.gap_rate_hz += rate_hz / static_cast<double>(rates.size());
    // A mean is that of what is known of its time.
    if (missing_ratio > most_missing) points.gap_rate_hz /= 1.0 - missing_ratio;
    std::vector<double> value, tau, scarcity;
    for (const deviations::DeviationPoint& p : curve.points) {
        if (!(p.deviation > 0.0) || p.deviation * p.deviation * p.tau_s * p.tau_s < rounding) continue;
        points.m.push_back(p.m);
        tau.push_back(p.tau_s);
        value.push_back(p.deviation * p.deviation);
        scarcity.push_back(static_cast<double>(n - 3 * p.m + 1) / static_cast<double>(p.terms));
    }
    if (points.m.size() < 4)
        throw deviations::SeriesError(
            fmt::format("fit: {} averaging times of which variances are known{}, 4 or more are needed", points.m.size(),
                        rounding > 0.0 ? ", and more than what the rounding to whole counts may leave" : ""));
    const auto as_vector = [](const std::vector<double>& v) {
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v)));
    };
    points.value = as_vector(value);
    points.tau_s = as_vector(tau);
    points.scarcity = as_vector(scarcity);
    return points;
}

// Of Markov noise and of a sinusoid the peak: the zeros of the derivatives by tau lie at 1.89 T and where tan x = 2 x,
// x = pi f tau, at 0.371/f.
double read_at(NoiseKind kind, double second) {
    if (kind == NoiseKind::markov) return 1.89 * second;
    return kind == NoiseKind::sine ? 0.371 / second : facts(kind).read_at_s;
}

FittedTerm smooth_term(const SmoothFit& fit, std::size_t index) {
    FittedTerm term{.kind = index == markov_index ? NoiseKind::markov : static_cast<NoiseKind>(index)};
    term.found = fit.found[index];
    const double sigma2 = fit.square_sigma[index];
    if (!term.found) {
        // None where no set has it beside those found: it cannot be told from what a filter does.
        if (sigma2 > 0.0) term.limit = std::sqrt(fit.square_freed[index] + one_sided_95 * sigma2);
        return term;
    }
    term.value = std::sqrt(fit.square[index]);
    const double relative = 0.5 * sigma2 / fit.square[index];
    term.sigma = term.value * relative;
    if (index == markov_index) {
        term.second = fit.markov_time_s;
        term.second_sigma = fit.markov_time_sigma_s;
    }
    return term;
}

FittedTerm ramp_term(std::span<const double> rates, double rate_hz, const SmoothFit& fit) {
    const Ramp ramp = find_ramp(rates, rate_hz, terms_of(fit.mean_square, fit.markov_time_s, fit.filter_time_s));
    FittedTerm term{.kind = NoiseKind::ramp};
    term.found = ramp.chance < ramp_chance;
    if (term.found) {
        term.value = ramp.slope_arcsec_s2;
        term.sigma = ramp.sigma;
    } else {
        term.limit = std::abs(ramp.slope_arcsec_s2) + one_sided_95 * ramp.sigma;
    }
    return term;
}

// Where the shortest averaging times are not white noise, what cuts it off.
void take_bandwidth(std::span<const double> rates, double rate_hz, const SmoothFit& smooth, NoiseFit& fit) {
    FittedTerm& white = fit.fitted[white_index];
    if (!white.found || smooth.filter_time_s == 0.0) return;
    const Bandwidth b = find_bandwidth(rates, rate_hz, fit.terms, std::max(smooth.filter_time_s, 1.0 / rate_hz));
    white.second = b.hz;
    white.second_sigma = b.sigma_hz;
}

void take_points(const HadamardPoints& points, const SmoothFit& smooth, NoiseFit& fit) {
    for (Eigen::Index i = 0; i < points.tau_s.size(); ++i)
        fit.points.push_back({.m = points.m[static_cast<std::size_t>(i)],
                              .tau_s = points.tau_s[i],
                              .measured = points.value[i],
                              .fitted = smooth.fitted[i],
                              .degrees = smooth.degrees[i]});
    fit.from_tau_s = points.tau_s[static_cast<Eigen::Index>(smooth.skipped)];
    fit.chi2 = smooth.chi2;
    fit.dof = smooth.dof;
}

void take_sinusoids(const std::vector<Sinusoid>& sines, NoiseFit& fit) {
    for (const Sinusoid& s : sines) {
        fit.terms.sines.push_back({.amplitude_arcsec_s = s.amplitude_arcsec_s, .frequency_hz = s.frequency_hz});
        fit.fitted.push_back({.kind = NoiseKind::sine,
                              .found = true,
                              .value = s.amplitude_arcsec_s,
                              .sigma = s.amplitude_sigma,
                              .second = s.frequency_hz,
                              .second_sigma = s.frequency_sigma_hz});
    }
    if (sines.empty()) fit.fitted.push_back({.kind = NoiseKind::sine});
}

double probability_of(const SmoothFit& smooth) {
    if (smooth.dof <= 0) return 1.0;
    if (!(smooth.chi2 >= 0.0))
        throw deviations::SeriesError(
            "fit: squares of the record, or of its sampling rate, overflow or vanish; allowed are samples and rates "
            "whose fourth power is a number");
    const boost::math::chi_squared law(static_cast<double>(smooth.dof));
    return boost::math::cdf(boost::math::complement(law, smooth.chi2));
}

// Allows the least error of the model with which chance explains the rest, 20 % at the most.
SmoothFit select(const HadamardPoints& points, bool with_markov, NoiseFit& fit) {
    constexpr double min_probability = 1e-3;
    SmoothFit smooth;
    for (const double model_error : {0.0, 0.02, 0.05, 0.1, 0.2}) {
        smooth = select_terms(points, with_markov, model_error);
        fit.model_error = model_error;
        fit.probability = probability_of(smooth);
        fit.describes = fit.probability >= min_probability;
        if (fit.describes) break;
    }
    return smooth;
}

// The mean fourth power of what rates differ from their mean by, of the square of the mean square: 3 of normal noise.
double kurtosis(std::span<const double> rates) {
    double n = 0.0, mean = 0.0, squares = 0.0, fourths = 0.0;
    for (const double rate : rates)
        if (std::isfinite(rate)) n += 1.0, mean += (rate - mean) / n;
    for (const double rate : rates) {
        if (!std::isfinite(rate)) continue;
        const double square = (rate - mean) * (rate - mean);
        squares += square;
        fourths += square * square;
    }
    return n * fourths / (squares * squares);
}

// Noise of single angles is most at the shortest averaging time. Where less was measured there, and not because a
// counter counts seldom, what was found of it is what a low pass leaves of other noise.
void leave_filter(std::span<const double> rates, const HadamardPoints& points, SmoothFit& smooth) {
    if (!smooth.found[quantised_index] || smooth.skipped == 0) return;
    const double quantised =
        hadamard_variance({.quantisation_arcsec = std::sqrt(smooth.square[quantised_index])}, points.tau_s[0]);
    if (points.value[0] > 0.5 * quantised || kurtosis(rates) > 4.0) return;
    smooth.found[quantised_index] = false;
    smooth.square[quantised_index] = smooth.mean_square[quantised_index] = smooth.square_sigma[quantised_index] = 0.0;
}

// Terms that do not describe the record give no limit of one that is not among them.
void widen(NoiseFit& fit) {
    if (fit.describes) return;
    const double wider = std::sqrt(fit.chi2 / static_cast<double>(fit.dof));
    for (FittedTerm& term : fit.fitted) {
        term.limit = FittedTerm::none;
        if (term.kind == NoiseKind::sine) continue;
        term.sigma *= wider;
        term.second_sigma *= wider;
    }
}

void check_known(std::span<const double> rates) {
    const auto n = std::count_if(rates.begin(), rates.end(), [](double r) { return std::isfinite(r); });
    if (n < min_intervals)
        throw deviations::SeriesError(fmt::format("fit: {} known samples, {} or more are needed", n, min_intervals));
}

}  // namespace

std::string_view name_of(NoiseKind kind) { return facts(kind).name; }
std::string_view unit_of(NoiseKind kind) { return facts(kind).unit; }

std::vector<double> rates_arcsec_s(const deviations::Series& series) {
    check(series);
    const bool phase = series.what.kind == deviations::DataKind::phase;
    const double scale =
        in_arcsec(series.what.unit) * (series.what.kind == deviations::DataKind::rate ? 1.0 : series.what.rate_hz);
    std::vector<double> rates;
    rates.reserve(series.values.size());
    const auto at = [&](std::size_t k) {
        const bool known = std::isfinite(series.values[k]) && (series.valid.empty() || series.valid[k] != 0);
        return known ? series.values[k] : FittedTerm::none;
    };
    for (std::size_t k = phase ? 1 : 0; k < series.values.size(); ++k)
        rates.push_back(scale * (phase ? at(k) - at(k - 1) : at(k)));
    return rates;
}

NoiseFit fit_noise(const deviations::Series& series, const NoiseFitOptions& options) {
    std::vector<double> rates = rates_arcsec_s(series);
    return fit_noise_in_place(rates, series.what.rate_hz, options);
}

NoiseFit fit_noise_in_place(std::vector<double>& rates, double rate_hz, const NoiseFitOptions& options) {
    check(
        deviations::Series{.what = {deviations::DataKind::rate, deviations::Unit::arcsec_s, rate_hz}, .values = rates});
    check_known(rates);
    NoiseFit fit;
    const double step = coarse_step(rates);
    auto sines = take_out_sinusoids(rates, rate_hz, options.most_sines);
    const HadamardPoints points = hadamard_points(rates, rate_hz, step, options);
    // A saw of a count's height has lines of 2 f counts.
    std::erase_if(sines,
                  [&](const Sinusoid& s) { return s.amplitude_arcsec_s < 2.2 * s.frequency_hz * step / rate_hz; });
    SmoothFit smooth = select(points, options.markov, fit);
    leave_filter(rates, points, smooth);
    fit.terms = terms_of(smooth.square, smooth.markov_time_s, smooth.filter_time_s);
    for (std::size_t index = 0; index < markov_index; ++index) fit.fitted.push_back(smooth_term(smooth, index));
    fit.fitted.push_back(ramp_term(rates, rate_hz, smooth));
    if (fit.fitted.back().found) fit.terms.ramp_arcsec_s2 = fit.fitted.back().value;
    fit.fitted.push_back(smooth_term(smooth, markov_index));
    take_bandwidth(rates, rate_hz, smooth, fit);
    take_sinusoids(sines, fit);
    for (FittedTerm& term : fit.fitted) term.read_at_s = read_at(term.kind, term.second);
    take_points(points, smooth, fit);
    widen(fit);
    return fit;
}

}  // namespace zlg::noise
