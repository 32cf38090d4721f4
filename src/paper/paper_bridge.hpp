#pragma once
// The paper's oscillation, the error of a substituted gap on it by theory and by the print, and the twin's points.
//
// The error is (18), final minus true, summed over the gap. Its sign is that at a minimum of the rate, and at a zero
// crossing at which the rate falls; half a period later it is the opposite.

#include <array>
#include <vector>

#include <zlg/design/substitution.hpp>
#include <zlg/paper/substitution_experiment.hpp>

#include "paper_trial.hpp"

namespace zlg::paper {

inline constexpr std::array order_names{"constant", "linear", "quadratic"};

// The upper end of the paper's band, 0.1/T.
[[nodiscard]] double paper_frequency_hz(double tick_s);

// Of the rate in the middle of the gap.
enum class Region { crossing, extremum };

// One gap in the oscillation.
struct BridgeCase {
    int n = paper_gap_ticks;
    double frequency_hz = 0.0;
    double amplitude_arcsec_s = paper_amplitude_arcsec_s;
    double tick_s = 0.0;
    Region region = Region::extremum;
};

[[nodiscard]] double exact_error_arcsec(const BridgeCase& c, design::Fit fit, int order);

// How (20) can be read as an error: its terms above the polynomial, at the nearest measured tick, over the whole gap.
// The linear term counts as 0 for a constant, as in the paper.
[[nodiscard]] double series_error_arcsec(const BridgeCase& c, int order);
[[nodiscard]] double series_error_as_printed_arcsec(const BridgeCase& c, int order);

// All experiments on the twin that the figures need.
struct BridgePoints {
    double tick_s = 0.0;
    std::vector<SubstitutionResult> by_frequency;                 // n = 3
    std::vector<SubstitutionResult> by_length;                    // n = 1, 2, ... at the paper's frequency
    std::array<std::vector<SubstitutionResult>, 3> by_amplitude;  // n = 1, 2, 3
    std::vector<SubstitutionResult> of_noise;                     // n = 1, 2, ... without oscillation
};

[[nodiscard]] BridgePoints measure_bridge(const PaperTask& task);

// A component of a point, with the sign of this file, and its standard error.
struct Measured {
    double arcsec = 0.0;
    double error = 0.0;
};
[[nodiscard]] Measured measured(const SubstitutionPoint& point, Region region);
[[nodiscard]] const SubstitutionPoint& point_of(const SubstitutionResult& result, design::Fit fit, int order);

// All points that the figures show, of motion and of noise.
[[nodiscard]] ChiSquare agreement_of_all(const BridgePoints& points);

[[nodiscard]] std::vector<PaperItem> paper_figure_8(const BridgePoints& points);
[[nodiscard]] std::vector<PaperItem> paper_figures_9_and_10(const BridgePoints& points);
[[nodiscard]] PaperItem paper_figure_11(const PaperTask& task, const BridgePoints& points);

}  // namespace zlg::paper
