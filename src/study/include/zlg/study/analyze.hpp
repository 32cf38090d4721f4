#pragma once
// Noise analysis of recorded gyros: what `zlg analyze` computes and shows.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <zlg/calibration/rate_table.hpp>
#include <zlg/config/config.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/report/figure.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/axis.hpp>

namespace zlg::study {

inline constexpr std::size_t max_gaps = 400;

// The Earth's rate as seen by axes at right angles.
struct EarthLine {
    std::string group;
    int n_axes = 0;
    double norm_arcsec_s = 0.0;  // of the mean rates
    double sigma_arcsec_s = 0.0;
};

// A rate-table test of one axis.
struct TableResult {
    std::string name, holds;
    calibration::RateTable table;
    std::optional<noise::BiasTemperature> temperature{};
    std::vector<std::string> warnings{};  // values that may be no measurements, a line each
};

struct AnalysisResult {
    std::vector<AxisResult> axes;
    std::vector<EarthLine> earth;  // of groups of three axes
    std::vector<TableResult> tables;
    std::optional<report::Section> made{};  // how the page was made, where more is known than the settings
};

// What is written for Kalibr of these axes: the largest angle random walk and rate random walk of them; where none has
// rate random walk the largest of its 95 % limits, for Kalibr refuses 0. An axis whose error stands behind it does not
// count, the error does.
//
// errors  deviations::SeriesError: no terms are fitted to an axis or they do not describe it; no axis has angle random
// walk; no rate random walk and no limit of it.
[[nodiscard]] noise::KalibrGyro kalibr_gyro(const std::vector<AxisResult>& axes);

inline constexpr double earth_rate_arcsec_s = 15.041067;

// errors  deviations::SeriesError, with the axis' name: nothing known, all equal, too short for a deviation, a tau that
// it does not have.
[[nodiscard]] AxisResult analyze_axis(const AnalysisTask& task, AxisRecord record);

// Axes that are errors are passed over.
[[nodiscard]] std::vector<EarthLine> earth_lines(const std::vector<AxisResult>& axes);

// The Allan deviation of what was fitted, term by term and together, is drawn beside what was measured.
[[nodiscard]] report::Page analysis_page(const config::Analysis& config, const AnalysisResult& result);

// What the page shows of one axis: its course, its deviation with the fitted terms and, of a switched gyro, the drift
// by mode and the errors of the switches. `index` makes their names different from those of another axis.
[[nodiscard]] std::vector<report::Figure> axis_figures(const config::Analysis& config, const AxisResult& axis,
                                                       std::size_t index);

// What the configuration says of a rate table, for a record of n samples.
[[nodiscard]] calibration::RateTableOptions table_options(const config::Analysis& config, double rate_hz,
                                                          std::size_t n);

// The residuals of a rate table at each stage.
[[nodiscard]] report::Figure residual_figure(const config::Analysis& config, const calibration::RateTable& table,
                                             const std::string& of, std::size_t index);

// A rate in the unit that the configuration shows, and its name.
[[nodiscard]] double shown_rate(config::ShownRate unit, double arcsec_s);
[[nodiscard]] std::string shown_unit(config::ShownRate unit);

}  // namespace zlg::study
