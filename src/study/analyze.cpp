#include <zlg/study/analyze.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/noise/mean_error.hpp>

#include "axis_curves.hpp"

namespace zlg::study {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t course_bins = 1500;

void count_known(const AxisRecord& record, AxisResult& axis) {
    std::size_t gap_from = 0;
    bool in_gap = false;
    const auto close = [&](std::size_t end) {
        if (!in_gap) return;
        ++axis.n_gaps;
        if (axis.gaps.size() < max_gaps)
            axis.gaps.push_back(
                {static_cast<double>(gap_from) / record.rate_hz, static_cast<double>(end) / record.rate_hz});
        in_gap = false;
    };
    for (std::size_t k = 0; k < record.rates_arcsec_s.size(); ++k) {
        const double r = record.rates_arcsec_s[k];
        if (std::isfinite(r)) {
            ++axis.n_known;
            axis.mean_arcsec_s += (r - axis.mean_arcsec_s) / static_cast<double>(axis.n_known);
            close(k);
        } else if (!in_gap) {
            in_gap = true;
            gap_from = k;
        }
    }
    close(record.rates_arcsec_s.size());
}

// Means over equal stretches; one of which half is missing is a gap.
std::vector<TimeBin> time_bins_of(const AxisRecord& record) {
    const std::size_t n = record.rates_arcsec_s.size();
    const std::size_t length = std::max<std::size_t>(1, (n + course_bins - 1) / course_bins);
    std::vector<TimeBin> time_bins;
    for (std::size_t from = 0; from < n; from += length) {
        const std::size_t to = std::min(n, from + length);
        double mean = 0.0, known = 0.0;
        for (std::size_t k = from; k < to; ++k)
            if (std::isfinite(record.rates_arcsec_s[k]))
                known += 1.0, mean += (record.rates_arcsec_s[k] - mean) / known;
        const bool is_gap = 2.0 * known < static_cast<double>(to - from) || known == 0.0;
        time_bins.push_back({0.5 * static_cast<double>(from + to) / record.rate_hz, is_gap ? no_value : mean});
    }
    return time_bins;
}

// On the straight line in log-log between the neighbours.
std::optional<double> read_curve(const deviations::DeviationCurve& curve, double tau_s) {
    const auto& p = curve.points;
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        if (!(p[k].tau_s <= tau_s && tau_s <= p[k + 1].tau_s)) continue;
        if (!(p[k].deviation > 0.0) || !(p[k + 1].deviation > 0.0)) return std::nullopt;
        const double share = std::log(tau_s / p[k].tau_s) / std::log(p[k + 1].tau_s / p[k].tau_s);
        return std::exp((1.0 - share) * std::log(p[k].deviation) + share * std::log(p[k + 1].deviation));
    }
    return std::nullopt;
}

// At 1 s, at the least value, and where each term is read.
std::vector<Readout> readouts_of(const AxisResult& axis) {
    std::vector<Readout> out;
    const auto& curve = axis.allan;
    if (curve.points.empty()) return out;
    const auto add = [&](std::string what, double tau_s) {
        if (const auto value = read_curve(curve, tau_s)) out.push_back({std::move(what), tau_s, *value});
    };
    add("at 1 s", 1.0);
    const auto least = std::ranges::min_element(curve.points, {}, &deviations::DeviationPoint::deviation);
    out.push_back({"least", least->tau_s, least->deviation});
    if (!axis.fit) return out;
    for (const noise::FittedTerm& term : axis.fit->fitted)
        if (term.found && std::isfinite(term.read_at_s) && term.read_at_s != 1.0)
            add(fmt::format("where {} is read", noise::name_of(term.kind)), term.read_at_s);
    return out;
}

void take_modes(const AnalysisTask& task, AxisRecord& record, AxisResult& axis) {
    if (record.mode.empty()) return;
    axis.modes = noise::split_modes({.rate_hz = record.rate_hz,
                                     .rates_arcsec_s = record.rates_arcsec_s,
                                     .bridged_arcsec_s = record.bridged_arcsec_s,
                                     .mode = record.mode},
                                    task.settling_samples);
    std::vector<double>{}.swap(record.bridged_arcsec_s);
    if (!task.with_mode_curves) return;
    for (const int mode : {1, -1}) {
        std::vector<double> one = record.rates_arcsec_s;
        for (std::size_t k = 0; k < one.size(); ++k)
            if (record.mode[k] != mode) one[k] = no_value;
        try {
            axis.mode_curves.push_back(octave_oadev(task, record_of(one, record.rate_hz)));
        } catch (const deviations::SeriesError&) {
            // Never in this mode, or not long enough: no curve.
            axis.mode_curves.push_back(
                {.kind = deviations::DeviationKind::oadev, .confidence = task.config.confidence, .points = {}});
        }
    }
}

std::size_t piece_of(std::size_t n) {
    std::size_t piece = 8;
    while (2 * piece <= n / 8) piece *= 2;
    return piece;
}

void take_spectra(const AxisRecord& record, AxisResult& axis) {
    const std::size_t n = record.rates_arcsec_s.size();
    try {
        axis.spectrum = noise::welch_spectrum(record.rates_arcsec_s, record.rate_hz, piece_of(n));
    } catch (const deviations::SeriesError&) {
        // Too short, or too little known: the page goes without.
        axis.spectrum = {};
    }
}

// Of a switched gyro the curve without the sawtooth of its magnetic drift.
void take_curve_left(const AnalysisTask& task, AxisRecord& record, AxisResult& axis) {
    noise::take_out_magnetic(*axis.modes, record.mode, record.rate_hz, record.rates_arcsec_s);
    if (axis.modes->segments.size() < 2 || !task.with_mode_curves) return;
    axis.mode_curves.push_back(octave_oadev(task, record_of(record.rates_arcsec_s, record.rate_hz)));
}

double mean_of(std::span<const double> rates) {
    double mean = 0.0, n = 0.0;
    for (const double r : rates)
        if (std::isfinite(r)) n += 1.0, mean += (r - mean) / n;
    return mean;
}

// Where only the temperature is not known the rate is as at its mean.
void add_drift(double factor, AxisRecord& record, const noise::BiasTemperature& law) {
    for (std::size_t k = 0; k < record.temperature_c.size(); ++k)
        if (std::isfinite(record.temperature_c[k]))
            record.rates_arcsec_s[k] += factor * law.drift_arcsec_s(record.temperature_c[k]);
}

void take_temperature(AxisRecord& record, AxisResult& axis) {
    if (record.temperature_c.empty()) return;
    axis.temperature =
        noise::bias_temperature({.rates_arcsec_s = record.rates_arcsec_s, .temperature_c = record.temperature_c});
    add_drift(-1.0, record, *axis.temperature);
}

// Takes out of the rates what is no noise, and the sinusoids out of the mean: over gaps and parts of a period they
// would leave much more there than its error says.
void take_fit(const AnalysisTask& task, AxisRecord& record, AxisResult& axis) {
    std::vector<double>& rates = record.rates_arcsec_s;
    try {
        if (axis.modes) take_curve_left(task, record, axis);
        const double mean = axis.modes || axis.temperature ? mean_of(rates) : axis.mean_arcsec_s;
        axis.fit = noise::fit_noise_in_place(rates, record.rate_hz, {.threads = task.threads});
        if (!axis.fit->terms.sines.empty()) axis.mean_arcsec_s += mean_of(rates) - mean;
        if (task.with_page && (axis.modes || !axis.fit->terms.sines.empty()))
            axis.spectrum_left = noise::welch_spectrum(rates, record.rate_hz, piece_of(rates.size()));
    } catch (const deviations::SeriesError& error) {
        if (axis.fit) return;
        const bool is_switched = axis.modes && axis.modes->segments.size() > 1;
        axis.no_fit = fmt::format("{}{}", is_switched ? "without the magnetic drift: " : "", error.what());
    }
}

// Of the rates that the fit left, without sinusoids and magnetic drift; what follows the temperature is in the mean.
void take_mean_error(AxisRecord& record, AxisResult& axis) {
    if (axis.temperature) add_drift(1.0, record, *axis.temperature);
    std::vector<double> half_periods;
    if (axis.fit)
        for (const noise::SineTerm& sine : axis.fit->terms.sines)
            half_periods.push_back(2.0 * static_cast<double>(axis.n_samples) / axis.rate_hz * sine.frequency_hz);
    const noise::MeanError error = noise::mean_error(record.rates_arcsec_s, half_periods);
    axis.mean_sigma_arcsec_s = error.sigma;
    axis.mean_degrees = error.degrees;
    axis.mean_white = error.white;
    axis.mean_white_sigma_arcsec_s = error.white_sigma;
}

AxisResult analyzed(const AnalysisTask& task, AxisRecord record) {
    AxisResult axis{.name = record.name, .group = record.group, .holds = record.holds, .rate_hz = record.rate_hz};
    axis.is_error = record.is_error;
    axis.warnings = record.warnings;
    axis.n_samples = std::ssize(record.rates_arcsec_s);
    count_known(record, axis);
    if (task.with_page) axis.time_bins = time_bins_of(record);
    // The modes first: they are what the bridged rates are needed for.
    take_modes(task, record, axis);
    take_curves(task, record, axis);
    if (task.with_page) take_spectra(record, axis);
    take_temperature(record, axis);
    take_fit(task, record, axis);
    axis.readouts = readouts_of(axis);
    take_mean_error(record, axis);
    return axis;
}

}  // namespace

AxisResult analyze_axis(const AnalysisTask& task, AxisRecord record) {
    if (task.config.deviations.empty()) throw config::ConfigError("analysis.deviations = []: allowed is one or more");
    const std::string name = record.name;
    try {
        return analyzed(task, std::move(record));
    } catch (const deviations::SeriesError& error) {
        throw deviations::SeriesError(fmt::format("{}: {}", name, error.what()));
    }
}

}  // namespace zlg::study
