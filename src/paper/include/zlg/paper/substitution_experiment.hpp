#pragma once
// The twin as an experiment on the substitution of a gap, held against its theory.
//
// One experiment is a run of many switches. From the middle between two switches to the middle of the next interval the
// case oscillates with a phase of its own, drawn for that switch, so the errors of the switches are independent
// samples. Nothing but the motion and the noise is left to make them: the miss is the natural one, re-lock is corrected
// by mean squares, and the high-voltage stage is made fast enough to arrive within the gap.
//
// The motion makes an error A (Re H sin phase + Im H cos phase), phase in the middle of the gap
// (design::ErrorResponse). A regression on the two quadratures separates it from the noise. What the noise should be:
// the rounding of the count, the random walk, the light noise of the re-lock correction and the magnetic drift, which
// is not the same on the two sides of a gap, each through the weights of the sum. Slow motion leaves the roundings of
// neighbouring ticks correlated; that is in the theory too.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/design/substitution.hpp>

namespace zlg::paper {

struct SubstitutionExperiment {
    int gap_ticks = 3;           // 1..16
    double frequency_hz = 20.0;  // finite; > 0 unless the amplitude is 0
    double amplitude_arcsec_s = 12000.0;
    // Where the amplitude is 0: the rate is constant about each switch, uniform within this on either side, > 0. A gyro
    // at rest in all but the rounding of its count, which would otherwise be the same at each tick.
    double slow_rate_arcsec_s = 0.0;
    int switches = 2000;     // 100..100 000
    std::uint64_t seed = 1;  // of the twin and of the phases
    config::Config base{};   // its run, switching, motion and perimeter miss are not used, nor its points
};

// One number of a fit: measured, standard error (0 where there is none), theory.
struct Component {
    double arcsec = 0.0;
    double error = 0.0;
    double theory = 0.0;

    friend bool operator==(const Component&, const Component&) = default;
};

// One fit of one experiment. "extremum" and "crossing" are the errors of motion, less noise, at a switch with an
// extremum (phase pi/2) and with a rising zero crossing (phase 0) of the rate in the middle of the gap. At a constant
// rate "extremum" is the error at the highest rate; "crossing" is then 0 with standard error 0.
struct SubstitutionPoint {
    design::Fit fit = design::Fit::interpolation;  // extrapolation: what is delivered in real time
    int order = 0;
    int n = 0;
    double frequency_hz = 0.0;
    double amplitude_arcsec_s = 0.0;
    int switches = 0;

    Component extremum{};
    Component crossing{};
    Component mean{};   // of the noise: its theory is the drift that passes through the fit into the substituted ticks
    Component noise{};  // standard deviation about the regression
    Component rms{};    // of all errors, motion and noise

    friend bool operator==(const SubstitutionPoint&, const SubstitutionPoint&) = default;
};

// Index of the arrays: order of the polynomial, 0..2.
struct SubstitutionResult {
    std::array<SubstitutionPoint, 3> interpolation{};  // error (18), which stays in the angle
    std::array<SubstitutionPoint, 3> extrapolation{};  // sum of the values (14) less the truth

    friend bool operator==(const SubstitutionResult&, const SubstitutionResult&) = default;
};

// Run experiments side by side; results in their order, the same for any number of threads.
//
// threads  >= 1.
// errors   design::DesignError for a number of switches or of threads that is out of range; config::ConfigError for a
//          base that makes no gyro, or one that does not switch when and for as long as it should. Of several failures
//          the one that is first in order.
// cost     about 0.3 s for 2000 switches.
[[nodiscard]] std::vector<SubstitutionResult> run_substitution(std::span<const SubstitutionExperiment> experiments,
                                                               int threads);

struct ChiSquare {
    double per_dof = 0.0;  // 0 without degrees of freedom
    int dof = 0;
};

// Squared deviation from theory over squared standard error: of the extremum and of the crossing, and of the rms.
//
// Points of one experiment share its noise, and with symmetric points constant and linear are one estimator.
// Independent are points of one fit and one order from different experiments. Components without a standard error are
// left out.
[[nodiscard]] ChiSquare chi2_per_dof(std::span<const SubstitutionPoint> points);
[[nodiscard]] ChiSquare rms_chi2_per_dof(std::span<const SubstitutionPoint> points);

}  // namespace zlg::paper
