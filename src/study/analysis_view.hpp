#pragma once
// One axis as the page of an analysis shows it, and its figures.

#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/study/analyze.hpp>

namespace zlg::study {

struct View {
    const config::Analysis& config;
    const AxisResult& axis;
    std::size_t index;

    [[nodiscard]] double shown(double arcsec_s) const { return shown_rate(config.unit, arcsec_s); }
    [[nodiscard]] std::string unit() const { return shown_unit(config.unit); }
    [[nodiscard]] std::string id(const char* what) const { return fmt::format("{}-{}", what, index + 1); }
};

[[nodiscard]] inline report::Series curve_series(const View& v, const deviations::DeviationCurve& curve,
                                                 std::string name) {
    report::Series s = report::blank_series(std::move(name), report::Mark::points);
    for (const auto& p : curve.points) {
        if (!(p.deviation > 0.0)) continue;
        report::add_point(s, p.tau_s, v.shown(p.deviation));
        s.y_error.push_back(v.shown(p.high - p.deviation));
        s.y_error_down.push_back(v.shown(p.deviation - p.low));
    }
    return s;
}

// The deviation with its intervals and the fitted terms.
[[nodiscard]] report::Figure sigma_figure(const View& v);

[[nodiscard]] report::Figure course_figure(const View& v);
[[nodiscard]] report::Figure spectrum_figure(const View& v);

// The result in one sentence an axis, of the first three.
[[nodiscard]] std::string analysis_verdict(const config::Analysis& config, const AnalysisResult& result);

// Of a switched gyro.
[[nodiscard]] report::Figure split_figure(const View& v);
[[nodiscard]] report::Figure switch_figure(const View& v);

}  // namespace zlg::study
