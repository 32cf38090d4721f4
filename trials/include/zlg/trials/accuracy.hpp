#pragma once
// How accurate is the angle across a switch: every method on the same records, beside the least error that is possible.
//
// The gyro of these trials is made of formulas, not of the twin: motion integrated exactly, a counter that truncates, a bias
// that lacks chi f0 dl^2 along the loop's true course, light samples of that course with noise. Bounds come from dense
// covariances of the motion and the noise, never from what a method believes of itself.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/report/page.hpp>
#include <zlg/trials/drift_campaign.hpp>

namespace zlg::trials {

struct ErrorFigures {
    std::int64_t n = 0;
    std::int64_t claimed = 0;  // with a finite sigma
    double mean_arcsec = 0.0;
    double bias_arcsec = 0.0;     // mean with the sign of the false angle
    double standard_error = 0.0;  // of either
    double rms_arcsec = 0.0;
    double sd_arcsec = 0.0;  // about the bias
    double worst_arcsec = 0.0;
    double nev = 0.0;                   // mean of (error/sigma)^2 of those claimed
    double within_3_sigma_ratio = 0.0;  // of those claimed
};

struct MethodFigures {
    std::string method;
    bool of_paper = false;
    ErrorFigures whole;   // permanent error of the angle, one switch
    ErrorFigures relock;  // of the false angle alone, as far as the method states one
};

// Least rms errors of one switch, arcsec; 0 where no bound is known.
struct BoundFigures {
    double ticks = 0.0;       // from ticks, constant rate unknown
    double halves = 0.0;      // from halves
    double known_rate = 0.0;  // from halves, constant rate known
    double relock = 0.0;      // false angle by the light alone
};

struct CaseFigures {
    char group =
        'a';  // (a) the paper's case, (b) grid, (c) broadband, (d) coning and shock, (f) loops, (g) warm-up, (h) rest
    std::string name;
    BoundFigures bound;
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
    bool real = true;  // false: made up for these trials
    std::vector<AxisFigures> axes;
};

// The false angle of the first eight ticks after closing by the light alone, less the true one.
struct RelockFigures {
    std::string name;
    double bound_arcsec = 0.0;  // a spline with knots half a tick apart
    ErrorFigures error;
};

// Drift beyond the true rotation after some time, in many runs.
struct SwitchingDrift {
    std::string name;
    std::string method;
    bool of_paper = false;
    int runs = 0;
    std::vector<double> rms_arcsec_s;  // by `run_lengths_s`
};

inline const std::vector<double> accuracy_run_lengths_s{600.0, 900.0, 3600.0};

// Something that is wanted, and what became of it.
// What chance may explain is neither: the limit is exceeded, but by less than two standard errors.
enum class Verdict : unsigned char { met, within_chance, missed };

struct Criterion {
    std::string number;
    std::string wanted;
    std::string got;
    Verdict verdict = Verdict::missed;
};

struct AccuracyTask {
    bool quick = false;      // a tenth of the trials and the main cases only: a minute or two
    double share = 1.0;      // of the trials of each case
    bool long_runs = false;  // the twin in closed loop over 36 000 s as well: half an hour of one processor
    std::uint64_t seed = 1;
    int threads = 2;
    std::vector<Recording> recordings;
    std::function<void(double)> on_progress;  // optional; 0..1
};

struct Accuracy {
    AccuracyTask task;
    std::vector<CaseFigures> cases;
    std::vector<RecordingFigures> recordings;
    std::vector<RelockFigures> relock;
    std::vector<SwitchingDrift> drift;
    std::vector<DriftFigures> long_runs;  // the twin in closed loop over 36 000 s, where asked for
    std::vector<Criterion> criteria;
};

// The figures do not depend on the number of threads.
//
// errors  std::runtime_error, std::invalid_argument for a recording that cannot be read.
[[nodiscard]] Accuracy measure_accuracy(const AccuracyTask& task);

[[nodiscard]] RecordingFigures measure_recording(const Recording& recording);

[[nodiscard]] std::string markdown(const Accuracy& accuracy);
[[nodiscard]] report::Page accuracy_page(const Accuracy& accuracy);

}  // namespace zlg::trials
