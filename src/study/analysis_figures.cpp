#include <cmath>

#include <zlg/report/number_text.hpp>

#include "analysis_view.hpp"

namespace zlg::study {
namespace {

using namespace report;

constexpr std::size_t max_shaded_gaps = 60;  // more would merge into one grey

// Means over even steps of the logarithm, so that the many bins of high frequencies are no black band.
Series spectrum_series(const View& v, const noise::Spectrum& spectrum, std::string name) {
    const double scale = v.shown(1.0) * v.shown(1.0), step = std::pow(10.0, 1.0 / 80.0);
    Series s = blank_series(std::move(name));
    double edge = 0.0, sum = 0.0, frequency = 0.0, n = 0.0;
    const auto close = [&] {
        if (n == 0.0) return;
        add_point(s, frequency / n, scale * sum / n);
        sum = frequency = n = 0.0;
    };
    for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
        if (spectrum.frequency_hz[k] > edge) {
            close();
            edge = spectrum.frequency_hz[k] * step;
        }
        sum += spectrum.density[k];
        frequency += spectrum.frequency_hz[k];
        n += 1.0;
    }
    close();
    return s;
}

}  // namespace

Figure course_figure(const View& v) {
    Figure f = report::blank_figure(
        v.id("course"), fmt::format("Course of {}", v.axis.name),
        "Mean rate over short stretches; where half of a stretch was not measured the line is broken. Shaded: gaps.",
        "time, s", fmt::format("rate, {}", v.unit()));
    Series s = blank_series("mean rate");
    for (const TimeBin& b : v.axis.time_bins) add_point(s, b.time_s, v.shown(b.mean_arcsec_s));
    f.series.push_back(std::move(s));
    if (v.axis.gaps.size() <= max_shaded_gaps)
        for (const Gap& g : v.axis.gaps) f.bands.push_back({.x0 = g.from_s, .x1 = g.to_s, .name = ""});
    return f;
}

Figure spectrum_figure(const View& v) {
    Figure f = report::blank_figure(
        v.id("spectrum"), fmt::format("Spectrum of {}", v.axis.name),
        fmt::format("One-sided, by Welch's method over {} pieces; missing samples weigh nothing. Dashed: "
                    "the fitted terms without sinusoids.",
                    v.axis.spectrum.pieces),
        "frequency, Hz", fmt::format("({})^2/Hz", v.unit()));
    f.log_x = f.log_y = true;
    f.series.push_back(spectrum_series(v, v.axis.spectrum, "measured"));
    if (!v.axis.spectrum_left.density.empty())
        f.series.push_back(spectrum_series(
            v, v.axis.spectrum_left, v.axis.modes ? "sinusoids and magnetic part taken out" : "sinusoids taken out"));
    if (!v.axis.fit) return f;
    Series fitted = blank_series("fitted", Mark::line, true);
    for (const double frequency : f.series.front().x)
        add_point(
            fitted, frequency,
            2.0 * v.shown(1.0) * v.shown(1.0) * noise::rate_spectrum(v.axis.fit->terms, frequency, v.axis.rate_hz));
    f.series.push_back(std::move(fitted));
    return f;
}

Figure split_figure(const View& v) {
    const noise::ModeSplit& m = *v.axis.modes;
    Figure f = report::blank_figure(
        v.id("split"), fmt::format("Magnetic and non-magnetic drift of {}", v.axis.name),
        "Half-difference and half-sum of neighbouring segments. Dashed: the warming law that fits best.", "time, s",
        "deg/h");
    Series magnetic = blank_series("magnetic", Mark::points), rest = blank_series("non-magnetic", Mark::points),
           fit = blank_series("magnetic, fitted", Mark::line, true);
    fit.colour = 0;
    for (const auto& p : m.points) {
        add_point(magnetic, p.time_s, p.magnetic_arcsec_s);
        add_point(rest, p.time_s, p.nonmagnetic_arcsec_s);
        add_point(fit, p.time_s, m.magnetic_at(p.time_s));
    }
    f.series = {std::move(magnetic), std::move(rest), std::move(fit)};
    return f;
}

Figure switch_figure(const View& v) {
    Figure f = report::blank_figure(
        v.id("switches"), fmt::format("Errors of the switches of {}", v.axis.name),
        "The angle over each gap and the settling after it, less that of the segments beside it: at "
        "rest the error of the switch.",
        "time, s", "arcsec");
    Series s = blank_series("error of a switch", Mark::points);
    for (const auto& one : v.axis.modes->switches) add_point(s, one.time_s, one.error_arcsec);
    f.series = {std::move(s)};
    return f;
}

}  // namespace zlg::study
