#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <zlg/report/number_text.hpp>

#include "analysis_view.hpp"

namespace zlg::study {
namespace {

using namespace report;

constexpr double not_shown = std::numeric_limits<double>::quiet_NaN();

struct Span {
    double low, high;
};

Span taus_of(const deviations::DeviationCurve& curve) {
    return {curve.points.front().tau_s, curve.points.back().tau_s};
}

std::vector<double> log_steps(const Span& span, int n) {
    std::vector<double> x;
    for (int k = 0; k <= n; ++k) x.push_back(span.low * std::pow(span.high / span.low, static_cast<double>(k) / n));
    return x;
}

Series law(const View& v, const Span& span, std::string name, bool dashed, double floor,
           const std::function<double(double)>& variance) {
    Series s = blank_series(std::move(name), Mark::line, dashed);
    if (!(span.high > span.low)) return s;
    for (const double tau_s : log_steps(span, 240)) {
        const double y = v.shown(std::sqrt(std::max(0.0, variance(tau_s))));
        add_point(s, tau_s, y > floor ? y : not_shown);
    }
    return s;
}

// One fitted term alone.
noise::NoiseTerms only(const noise::FittedTerm& term) {
    using noise::NoiseTerms;
    // Of the kinds with one coefficient, in the order of the enumerators.
    constexpr std::array coefficients{&NoiseTerms::quantisation_arcsec, &NoiseTerms::angle_random_walk_arcsec_sqrt_s,
                                      &NoiseTerms::bias_instability_arcsec_s,
                                      &NoiseTerms::rate_random_walk_arcsec_s_sqrt_s, &NoiseTerms::ramp_arcsec_s2};
    NoiseTerms t;
    if (term.kind == noise::NoiseKind::markov)
        t.markov.push_back({.deviation_arcsec_s = term.value, .time_s = term.second});
    else if (term.kind == noise::NoiseKind::sine)
        t.sines.push_back({.amplitude_arcsec_s = term.value, .frequency_hz = term.second});
    else
        t.*coefficients.at(static_cast<std::size_t>(term.kind)) = term.value;
    return t;
}

double min_of(const Series& s) {
    double least = std::numeric_limits<double>::infinity();
    for (const double y : s.y) least = std::min(least, y);
    return least;
}

// The deviation of a sinusoid swings faster than a line can show; it is compared where it was measured.
Series sum_with_sines(const View& v, const noise::NoiseTerms& terms) {
    Series s = blank_series("fitted terms together", Mark::points);
    for (const auto& p : v.axis.curves.front().points)
        add_point(s, p.tau_s, v.shown(std::sqrt(noise::allan_variance(terms, p.tau_s))));
    return s;
}

void add_terms(const View& v, const Span& span, double floor, Figure& f) {
    if (!v.axis.fit) return;
    const noise::NoiseTerms all = v.axis.fit->terms;
    f.series.push_back(all.sines.empty() ? law(v, span, "fitted terms together", false, floor,
                                               [&all](double tau_s) { return noise::allan_variance(all, tau_s); })
                                         : sum_with_sines(v, all));
    for (const noise::FittedTerm& term : v.axis.fit->fitted) {
        if (!term.found || term.kind == noise::NoiseKind::sine) continue;
        const noise::NoiseTerms one = only(term);
        f.series.push_back(law(v, span, std::string{noise::name_of(term.kind)}, true, floor,
                               [&one](double tau_s) { return noise::allan_variance(one, tau_s); }));
    }
}

}  // namespace

Figure sigma_figure(const View& v) {
    const auto& curve = v.axis.curves.front();
    const std::string name{deviations::name_of(curve.kind)};
    Figure f = report::blank_figure(
        v.id("sigma"), fmt::format("{} of {}", name, v.axis.name),
        fmt::format("Points: {} with intervals of {:g} %. Dashed: each fitted term alone, as it stands in the Allan "
                    "deviation; full, or points at the averaging times of the record where an oscillation was found: "
                    "their sum.",
                    name, 100.0 * curve.confidence),
        "averaging time, s", fmt::format("deviation, {}", v.unit()));
    if (v.axis.fit && !v.axis.fit->terms.sines.empty() && v.axis.n_gaps > 0)
        f.caption += " In a window with a gap an oscillation does not average out: such points lie above the sum.";
    f.log_x = f.log_y = true;
    Series measured = curve_series(v, curve, name);
    double least = min_of(measured);
    f.series.push_back(std::move(measured));
    for (std::size_t k = 1; k < v.axis.curves.size(); ++k)
        if (v.axis.curves[k].kind != deviations::DeviationKind::tdev)
            f.series.push_back(
                curve_series(v, v.axis.curves[k], std::string{deviations::name_of(v.axis.curves[k].kind)}));
    // The terms are fitted to what is left without the switching.
    if (v.axis.mode_curves.size() > 2) {
        Series left = curve_series(v, v.axis.mode_curves[2], "magnetic part taken out");
        least = std::min(least, min_of(left));
        f.caption += " The terms are fitted to what is left without the magnetic part.";
        f.series.push_back(std::move(left));
    }
    add_terms(v, taus_of(curve), 0.2 * least, f);
    return f;
}

}  // namespace zlg::study
