#pragma once
// Noise analysis of recorded gyros: what `zlg analyze` computes and shows.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/calibration/rate_table.hpp>
#include <zlg/config/config.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/noise/spectrum.hpp>
#include <zlg/report/page.hpp>

namespace zlg::study {

// One axis as it was read.
struct AxisRecord {
    std::string name;   // "unit.txt, column 2"
    std::string group;  // axes of one group stand at right angles: those of one file
    std::string holds;  // "increments of 0.1 arcsec"
    double rate_hz = 1.0;
    std::vector<double> rates_arcsec_s;    // NaN where nothing was measured
    std::vector<std::int8_t> mode;         // of a switched gyro, as many
    std::vector<double> bridged_arcsec_s;  // the same with the gaps as compensation filled them, or empty
    // Where angles were recorded, not what was turned between them: those, one more than rates. The deviations are taken of
    // them, so that one that is missing harms no longer averaging time.
    std::vector<double> phase_arcsec{};
    bool is_error = false;  // of the axis before it, whose truth is known: no rotation of its own
};

// A stretch of time over which the record's mean is drawn.
struct TimeBin {
    double time_s = 0.0;
    double mean_arcsec_s = 0.0;  // NaN: a gap
};

struct Gap {
    double from_s = 0.0;
    double to_s = 0.0;
};

// The Allan deviation at a time, between two points of its curve.
struct Readout {
    std::string what;
    double tau_s = 0.0;
    double deviation_arcsec_s = 0.0;
};

struct AxisResult {
    std::string name, group, holds;
    double rate_hz = 1.0;
    std::int64_t n_samples = 0;
    std::int64_t n_known = 0;
    std::int64_t n_gaps = 0;
    double mean_arcsec_s = 0.0;  // without the sinusoids that were found
    // What the noise lets it differ by: see docs/noise.md, "Mean rate and the Earth". NaN: not known.
    double mean_sigma_arcsec_s = 0.0;
    std::vector<deviations::DeviationCurve> curves;  // those asked for
    // What readouts and the error of the mean are taken from: the first of oadev, adev, totdev that was asked for, or else oadev
    // at octaves. Without points where the record has none.
    deviations::DeviationCurve allan;
    std::optional<noise::NoiseFit> fit;
    std::string no_fit;  // why there is none
    std::vector<Readout> readouts;
    std::optional<noise::ModeSplit> modes;
    std::vector<deviations::DeviationCurve> mode_curves;  // mode +1, mode -1, with the magnetic part taken out
    std::vector<TimeBin> course;
    std::vector<Gap> gaps;  // the first `most_gaps`
    noise::Spectrum spectrum;
    noise::Spectrum spectrum_left;  // without sinusoids, and the magnetic part, where there are any
    noise::Spectrogram spectrogram;
    bool is_error = false;  // as of its record
};

inline constexpr std::size_t most_gaps = 400;

// The Earth's rate as seen by axes at right angles.
struct EarthLine {
    std::string group;
    int n_axes = 0;
    double norm_arcsec_s = 0.0;  // of the mean rates
    double sigma_arcsec_s = 0.0;
};

// Noise that somebody presumes, to be drawn beside what was measured.
struct PresumedNoise {
    std::string name;
    noise::NoiseTerms terms;
};

// A rate-table test of one axis.
struct TableResult {
    std::string name, holds;
    calibration::RateTable table;
};

struct AnalysisResult {
    std::vector<AxisResult> axes;
    std::vector<EarthLine> earth;  // of groups of three axes
    std::optional<PresumedNoise> presumed;
    std::vector<TableResult> tables;
};

// What Kalibr would be told of these axes: the largest angle random walk and rate random walk of them; where none has rate random
// walk the largest of its 95 % limits, for Kalibr refuses 0. An axis whose error stands behind it does not count, the error does.
//
// errors  deviations::SeriesError: no terms are fitted to an axis or they do not describe it; no axis has angle random walk; no rate
// random walk and no limit of it.
[[nodiscard]] noise::KalibrGyro kalibr_gyro(const std::vector<AxisResult>& axes);

inline constexpr double earth_rate_arcsec_s = 15.041067;

// The projections at a latitude: on the vertical, and the largest on a horizontal axis.
[[nodiscard]] double earth_vertical_arcsec_s(double latitude_deg);
[[nodiscard]] double earth_horizontal_arcsec_s(double latitude_deg);

struct AnalysisTask {
    config::Analysis config;
    std::int64_t settling_samples = 20;  // after a switch
    int threads = 1;
};

// errors  config::ConfigError: no deviation is asked for, or mtotdev or htotdev at averaging times that take many minutes and are not
// in taus_s; deviations::SeriesError, with the axis' name: nothing known, all equal, too short for a deviation, a tau that it does not have.
[[nodiscard]] AxisResult analyze_axis(const AnalysisTask& task, AxisRecord record);

// Axes that are errors are passed over.
[[nodiscard]] std::vector<EarthLine> earth_lines(const std::vector<AxisResult>& axes);

// The Allan deviation of what was fitted, term by term and together, is drawn beside what was measured.
[[nodiscard]] report::Page analysis_page(const config::Analysis& config, const AnalysisResult& result);

// A rate in the unit that the configuration shows, and its name.
[[nodiscard]] double shown_rate(config::ShownRate unit, double arcsec_s);
[[nodiscard]] std::string shown_unit(config::ShownRate unit);

}  // namespace zlg::study
