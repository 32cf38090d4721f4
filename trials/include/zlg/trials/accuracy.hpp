#pragma once
// How accurate is the angle across a switch: every method on the same records, beside the least error that is possible.
//
// The gyro of these trials is made of formulas, not of the twin: motion integrated exactly, a counter that truncates, a
// bias that lacks chi f0 dl^2 along the true decay of the detuning, light samples of that decay with noise. Bounds come
// from dense covariances of the motion and the noise, never from a method's own estimate of its error.

#include <cstdint>
#include <string>
#include <vector>

namespace zlg::trials {

struct ErrorFigures {
    std::int64_t n = 0;
    std::int64_t claimed = 0;     // with a finite sigma
    double bias_arcsec = 0.0;     // mean with the sign of the false angle
    double standard_error = 0.0;  // of either
    double rms_arcsec = 0.0;
    double sd_arcsec = 0.0;  // about the bias
    double worst_arcsec = 0.0;
    double nev = 0.0;                   // normalised error squared: mean of (error/sigma)^2 of those claimed
    double nev_standard_error = 0.0;    // of that mean, by the scatter of what it is a mean of
    double within_3_sigma_ratio = 0.0;  // of those claimed
};

struct MethodFigures {
    std::string method;
    bool of_paper = false;
    ErrorFigures whole;  // permanent error of the angle, one switch
};

// Least rms errors of one switch; 0 where no bound is known.
struct SwitchBound {
    double ticks_arcsec = 0.0;   // from ticks, constant rate unknown
    double halves_arcsec = 0.0;  // from half-periods, constant rate unknown
    double relock_arcsec = 0.0;  // false angle by the light alone
};

enum class CaseGroup : unsigned char {
    paper,
    grid,
    broadband,
    non_stationary,
    loops,
    warm_up,
    rest,
    gap_lengths,
    first_gap,
    phase,
    lit
};

struct CaseFigures {
    CaseGroup group = CaseGroup::paper;
    std::string name;
    SwitchBound bound;
    std::vector<MethodFigures> methods;
};

// A recording of motion, and the gaps that are made in it.
struct Recording {
    std::string name;
    std::string path;
    std::vector<int> columns{1, 2, 3};  // the first is 1
    std::string comment = "%";
    int skip_lines = 0;
    bool holds_rate = false;
    double rate_hz = 100.0;
    double scale_arcsec = 1.0;  // of a unit of the column
    double count_arcsec = 0.1;  // of the counter that reads it
    int gap_ticks = 3;
    std::int64_t first_gap_tick = 2040;
    std::int64_t every_ticks = 97;
};

struct AxisFigures {
    int column = 0;
    std::vector<MethodFigures> methods;
    double fit_rms_arcsec = 0.0;  // weights of 8 + 8 ticks by least squares over the whole recording
};

struct RecordingFigures {
    std::string name;
    bool real = true;  // false: simulated for these trials
    std::vector<AxisFigures> axes;
};

// One axis of a recording, its gaps of one length: `auto` beside the best polynomial of all gaps.
struct GapLengthFigures {
    std::string recording;
    int column = 0;
    int gap_ticks = 0;
    std::int64_t n = 0;
    double rms_arcsec = 0.0, best_arcsec = 0.0;
    double usual_rms_arcsec = 0.0, usual_best_arcsec = 0.0;  // without the 1 % of the gaps in which it errs most
    double nev = 0.0;
};

// The false angle of the first eight ticks after closing by the light alone, less the true one.
struct RelockFigures {
    std::string name;
    double bound_arcsec = 0.0;  // a spline with knots half a tick apart
    ErrorFigures error;
};

// First manoeuvres of one kind, each at a gap of a gyro whose motion before was known.
struct ManoeuvreFigures {
    std::string base;       // the motion before
    std::string manoeuvre;  // empty: nothing happens
    std::vector<MethodFigures> methods;
};

// A limit and the figure held against it.
//
// within_chance  the limit is exceeded, but by less than two standard errors.
enum class Verdict : unsigned char { met, within_chance, missed };

struct Criterion {
    std::string table;  // in which the figures stand
    std::string wanted;
    std::string got;
    Verdict verdict = Verdict::missed;
};

struct AccuracyTask {
    bool quick = false;  // a tenth of the trials and the main cases only: a minute or two
    double share = 1.0;  // of the trials of each case
    std::uint64_t seed = 1;
    int threads = 2;
    std::vector<Recording> recordings;
};

struct Accuracy {
    AccuracyTask task;
    std::vector<CaseFigures> cases;
    std::vector<RecordingFigures> recordings;
    std::vector<RelockFigures> relock;
    std::vector<ManoeuvreFigures> manoeuvres;
    std::vector<ManoeuvreFigures> changes;
    std::vector<GapLengthFigures> gap_lengths;
    std::vector<Criterion> criteria;
};

// The figures do not depend on the number of threads.
//
// errors  std::runtime_error, std::invalid_argument for a recording that cannot be read.
[[nodiscard]] Accuracy measure_accuracy(const AccuracyTask& task);

// gaps  of each kind.
[[nodiscard]] std::vector<ManoeuvreFigures> measure_manoeuvres(int gaps, bool quick, std::uint64_t seed, int threads);

// The same families, and first gaps some 20 and 60 ticks after the start, each with the whole bank of the estimate and
// then without one member of it after the other (walk_kernel.hpp).
[[nodiscard]] std::vector<ManoeuvreFigures> measure_members(int gaps, std::uint64_t seed, int threads);

// The motion is another one from the opening of the gap on; `manoeuvre` says which.
[[nodiscard]] std::vector<ManoeuvreFigures> measure_changes(int gaps, bool quick, std::uint64_t seed, int threads);

[[nodiscard]] RecordingFigures measure_recording(const Recording& recording);

// Of the default, over that of the paper's polynomial that errs least in all of these gaps.
[[nodiscard]] double over_best_polynomial(const ManoeuvreFigures& figures);

[[nodiscard]] std::string markdown(const Accuracy& accuracy);

}  // namespace zlg::trials
