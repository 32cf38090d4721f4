// The experiments behind figures 8 to 11.

#include <cmath>
#include <complex>
#include <iterator>

#include <zlg/design/taylor.hpp>

#include "paper_bridge.hpp"

namespace zlg::paper {
namespace {

using design::Tone;

constexpr int longest_gap_ticks = 8;

// Products of the replaced time and the frequency: twice the paper's band at three ticks.
constexpr std::array products{0.05, 0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40};
constexpr std::array amplitudes_arcsec_s{3000.0, 6000.0, 9000.0, 12000.0, 15000.0, 18000.0};

// Fast enough that a count turns over several times within a tick, and slow enough to be far below any oscillation.
constexpr double noise_rate_arcsec_s = 3000.0;

double remainder_arcsec(const BridgeCase& c, const design::RateSeries& series, int order) {
    return std::abs(series.above(std::max(order, 1))) * c.n * c.tick_s;
}

class Bench {
public:
    explicit Bench(const PaperTask& task) : task_{task} {}

    SubstitutionExperiment next(int n, double frequency_hz, double amplitude_arcsec_s) {
        constexpr std::uint64_t seeds_per_run = 1000;
        return {.gap_ticks = n,
                .frequency_hz = frequency_hz,
                .amplitude_arcsec_s = amplitude_arcsec_s,
                .slow_rate_arcsec_s = noise_rate_arcsec_s,
                .switches = task_.switches_per_point,
                .seed = static_cast<std::uint64_t>(task_.config.run.seed) % (1ULL << 50) * seeds_per_run + n_made_++,
                .base = task_.config};
    }

    std::vector<SubstitutionResult> results(const std::vector<SubstitutionExperiment>& experiments) const {
        return run_substitution(experiments, task_.threads);
    }

private:
    const PaperTask& task_;
    std::uint64_t n_made_ = 0;
};

}  // namespace

double paper_frequency_hz(double tick_s) { return 0.1 / tick_s; }

double exact_error_arcsec(const BridgeCase& c, design::Fit fit, int order) {
    const auto response =
        design::ErrorResponse({.fit = fit, .order = order, .n = c.n, .points = {}, .tick_s = c.tick_s});
    const std::complex<double> h = response(c.frequency_hz);
    return -c.amplitude_arcsec_s * (c.region == Region::extremum ? h.real() : h.imag());
}

double series_error_arcsec(const BridgeCase& c, int order) {
    const Tone tone{.amplitude_arcsec_s = c.amplitude_arcsec_s, .frequency_hz = c.frequency_hz};
    const double x_s = design::figure_time_s(c.n, c.tick_s);
    const auto series =
        c.region == Region::extremum ? design::series_at_extremum(tone, x_s) : design::series_at_zero(tone, x_s);
    return remainder_arcsec(c, series, order);
}

double series_error_as_printed_arcsec(const BridgeCase& c, int order) {
    if (c.region == Region::extremum) return series_error_arcsec(c, order);
    const Tone tone{.amplitude_arcsec_s = c.amplitude_arcsec_s, .frequency_hz = c.frequency_hz};
    return remainder_arcsec(c, design::series_at_zero_as_printed(tone, design::figure_time_s(c.n, c.tick_s)), order);
}

BridgePoints measure_bridge(const PaperTask& task) {
    const double tick_s = task.config.gyro.tick_s;
    const double frequency_hz = paper_frequency_hz(tick_s);
    Bench bench{task};
    auto report = [&task, step = 0]() mutable {
        constexpr double steps = 6.0;
        if (task.on_progress) task.on_progress(++step / steps);
    };
    BridgePoints out{.tick_s = tick_s};

    std::vector<SubstitutionExperiment> experiments;
    for (const double product : products)
        experiments.push_back(bench.next(paper_gap_ticks, product / design::figure_time_s(paper_gap_ticks, tick_s),
                                         paper_amplitude_arcsec_s));
    out.by_frequency = bench.results(experiments);
    report();

    experiments.clear();
    for (int n = 1; n <= longest_gap_ticks; ++n)
        experiments.push_back(bench.next(n, frequency_hz, paper_amplitude_arcsec_s));
    out.by_length = bench.results(experiments);
    report();

    for (std::size_t k = 0; k < out.by_amplitude.size(); ++k) {
        experiments.clear();
        for (const double amplitude : amplitudes_arcsec_s)
            experiments.push_back(bench.next(static_cast<int>(k) + 1, frequency_hz, amplitude));
        out.by_amplitude[k] = bench.results(experiments);
        report();
    }

    experiments.clear();
    for (int n = 1; n <= longest_gap_ticks; ++n) experiments.push_back(bench.next(n, frequency_hz, 0.0));
    out.of_noise = bench.results(experiments);
    report();
    return out;
}

Measured measured(const SubstitutionPoint& point, Region region) {
    if (region == Region::extremum) return {-point.extremum.arcsec, point.extremum.error};
    return {-point.crossing.arcsec, point.crossing.error};
}

const SubstitutionPoint& point_of(const SubstitutionResult& result, design::Fit fit, int order) {
    const auto& points = fit == design::Fit::interpolation ? result.interpolation : result.extrapolation;
    return points[static_cast<std::size_t>(order)];
}

SubstitutionFigures paper_figures_8_to_11(const PaperTask& task) {
    const BridgePoints points = measure_bridge(task);
    const ChiSquare agreement = agreement_of_all(points);
    SubstitutionFigures out{
        .items = paper_figure_8(points), .chi2_per_dof = agreement.per_dof, .degrees_of_freedom = agreement.dof};
    std::vector<PaperItem> more = paper_figures_9_and_10(points);
    out.items.insert(out.items.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    out.items.push_back(paper_figure_11(task, points));
    return out;
}

}  // namespace zlg::paper
