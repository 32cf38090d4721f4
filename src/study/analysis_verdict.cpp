#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/report/number_text.hpp>
#include <zlg/study/term_text.hpp>

#include "analysis_view.hpp"

namespace zlg::study {
namespace {

using report::short_number;

std::string term_of(const noise::NoiseFit& fit, noise::NoiseKind kind, const char* words) {
    const auto term = std::ranges::find(fit.fitted, kind, &noise::FittedTerm::kind);
    return term == fit.fitted.end() ? "" : fmt::format("{} {}", words, value_text(*term));
}

// Those that were taken out before the fit: the gyro was shaken.
std::string sines_of(const noise::NoiseFit& fit) {
    const auto n = std::ranges::count_if(
        fit.fitted, [](const noise::FittedTerm& t) { return t.kind == noise::NoiseKind::sine && t.found; });
    if (n == 0) return "";
    const auto first = std::ranges::find_if(
        fit.fitted, [](const noise::FittedTerm& t) { return t.kind == noise::NoiseKind::sine && t.found; });
    return fmt::format(", beside {} at {} Hz,", n == 1 ? "an oscillation" : fmt::format("{} oscillations, one", n),
                       short_number(first->second));
}

std::string verdict_of(const config::Analysis& config, const AxisResult& axis) {
    if (!axis.fit) {
        const auto least = std::ranges::min_element(axis.readouts, {}, &Readout::deviation_arcsec_s);
        std::string text = fmt::format("no terms of noise are fitted, for {}", axis.no_fit);
        if (least != axis.readouts.end())
            text += fmt::format("; the Allan deviation goes down to {} {} at {} s",
                                short_number(shown_rate(config.unit, least->deviation_arcsec_s)),
                                shown_unit(config.unit), short_number(least->tau_s));
        return text;
    }
    const noise::NoiseFit& fit = *axis.fit;
    const std::string terms =
        fmt::format("{}, {}", term_of(fit, noise::NoiseKind::angle_random_walk, "angle random walk"),
                    term_of(fit, noise::NoiseKind::bias_instability, "bias instability"));
    if (!fit.describes)
        return fmt::format(
            "{}; but the fitted terms do not describe the record: it was moved, or has noise of another kind", terms);
    const std::string within =
        fit.model_error > 0.0 ? fmt::format(" to {:g} % of each variance", 100.0 * fit.model_error) : "";
    return fmt::format("{}; the fitted terms{} describe the record{}", terms, sines_of(fit), within);
}

}  // namespace

std::string analysis_verdict(const config::Analysis& config, const AnalysisResult& result) {
    constexpr std::size_t most_named = 3;
    std::vector<std::string> parts;
    for (const AxisResult& axis : result.axes)
        if (parts.size() < most_named && !axis.is_error)
            parts.push_back(fmt::format("{}: {}", axis.name, verdict_of(config, axis)));
    for (const TableResult& test : result.tables)
        if (parts.size() < most_named)
            parts.push_back(fmt::format("{}: scale factor {} units per arcsec, straight to {} ppm", test.name,
                                        with_error(test.table.scale_factor.value, test.table.scale_factor.sigma),
                                        short_number(test.table.nonlinearity_ppm)));
    return parts.empty() ? "" : fmt::format("{}.", fmt::join(parts, ". "));
}

}  // namespace zlg::study
