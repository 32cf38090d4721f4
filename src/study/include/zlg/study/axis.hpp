#pragma once
// One axis of an analysis: what was read, what is asked, what came of it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/noise/bias_temperature.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/spectrum.hpp>

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
    // Where angles were recorded, not what was turned between them: those, one more than rates. The deviations are
    // taken of them, so that one that is missing harms no longer averaging time.
    std::vector<double> phase_arcsec{};
    std::vector<double> temperature_c{};  // as many as rates, where it was measured
    bool is_error = false;                // of the axis before it, whose truth is known: no rotation of its own
    std::vector<std::string> warnings{};  // values that may be no measurements, a line each
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
    double mean_degrees = 1.0;                       // of freedom of that
    double mean_white = 0.0;                         // probability that its noise is white alone
    double mean_white_sigma_arcsec_s = 0.0;          // what it may differ by if it is
    std::vector<deviations::DeviationCurve> curves;  // those asked for
    // What readouts are taken from: the first of oadev, adev, totdev that was asked for, or else oadev at octaves.
    // Without points where the record has none.
    deviations::DeviationCurve allan;
    std::optional<noise::NoiseFit> fit;
    std::string no_fit;                                 // why there is none
    std::optional<noise::BiasTemperature> temperature;  // what was taken out of the rates before the fit
    std::vector<Readout> readouts;
    std::optional<noise::ModeSplit> modes;
    std::vector<deviations::DeviationCurve>
        mode_curves;                 // where asked for: mode +1, mode -1, with the magnetic part taken out
    std::vector<TimeBin> time_bins;  // empty without a page, as the spectra are
    std::vector<Gap> gaps;           // the first `max_gaps`
    noise::Spectrum spectrum;
    noise::Spectrum spectrum_left;      // without sinusoids, and the magnetic part, where there are any
    bool is_error = false;              // as of its record
    std::vector<std::string> warnings;  // as of its record
};

struct AnalysisTask {
    config::Analysis config;
    std::int64_t settling_samples = 20;  // after a switch
    int threads = 1;
    bool with_page = true;         // time bins and spectra too, which only the page shows
    bool with_mode_curves = true;  // which page and JSON show
};

}  // namespace zlg::study
