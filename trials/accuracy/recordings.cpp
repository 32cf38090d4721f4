#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include <Eigen/Dense>

#include <zlg/numeric/parallel.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/motion.hpp>

#include "parts.hpp"
#include "synthetic/vehicles.hpp"

namespace zlg::trials {
namespace {

constexpr int fit_ticks = 8;  // on each side of a gap, of the least-squares fit

struct Column {
    std::vector<double> true_arcsec;   // of each row
    std::vector<std::int64_t> counts;  // what a free-running, truncating counter reads of them
};

// What the counter makes of these increments.
Column counted(const Recording& r, const std::vector<double>& increment_arcsec) {
    Column c{.true_arcsec = increment_arcsec};
    double angle_counts = 0.0;
    std::int64_t read = 0;
    for (double increment : increment_arcsec) {
        angle_counts += increment / r.count_arcsec;
        // A recording in whole counts stays whole, whatever its scale does to the last digit.
        const auto now = static_cast<std::int64_t>(std::floor(angle_counts + 1e-5));
        c.counts.push_back(now - read);
        read = now;
    }
    return c;
}

std::vector<double> column_of(const Recording& r, int column) {
    config::Config config;
    config.motion = {.kind = config::MotionKind::file,
                     .path = r.path,
                     .column = std::to_string(column),
                     .column_holds = r.holds_rate ? config::ColumnHolds::rate : config::ColumnHolds::increment,
                     .scale_arcsec = r.scale_arcsec,
                     .rate_hz = r.rate_hz,
                     .comment = r.comment,
                     .skip_lines = r.skip_lines};
    const twin::Motion motion = recorded::motion(config);
    std::vector<double> increments(static_cast<std::size_t>(std::llround(motion.duration_s() * r.rate_hz)));
    for (std::size_t k = 0; k < increments.size(); ++k) {
        const auto t = static_cast<double>(k);
        increments[k] = motion.increment_arcsec(t / r.rate_hz, (t + 1.0) / r.rate_hz);
    }
    return increments;
}

std::vector<std::int64_t> gaps_of(const Recording& r, std::size_t rows) {
    std::vector<std::int64_t> gaps;
    const auto last = static_cast<std::int64_t>(rows) - r.gap_ticks - 64;
    for (std::int64_t t = r.first_gap_tick; t < last; t += r.every_ticks) gaps.push_back(t);
    return gaps;
}

// The two halves of a row, its counts split between them, with a bias that each has with the other sign.
std::array<core::HalfRecord, 2> halves_of(std::int64_t row, std::int64_t counts, int mode, bool open) {
    constexpr std::int64_t bias_counts = 150;  // of 60 kHz in a half of 2.5 ms
    std::array<core::HalfRecord, 2> halves{};
    const std::int64_t first = counts >= 0 ? counts / 2 : -((1 - counts) / 2);
    for (int h = 0; h < 2; ++h) {
        core::HalfRecord& half = halves[static_cast<std::size_t>(h)];
        half.half = 2 * row + h;
        half.bias_sign = h == 0 ? 1 : -1;
        half.mode = static_cast<std::int8_t>(mode);
        half.loop_closed = !open;
        half.counts = open ? 0 : (h == 0 ? first : counts - first) + half.bias_sign * mode * bias_counts;
        half.detuning_lambda = std::nan("");
        half.detuning_sq_lambda2 = std::nan("");
        half.temperature_c = std::nan("");
    }
    return halves;
}

// The gap in which a row lies, or -1.
std::int64_t gap_at(const Recording& r, std::int64_t n_gaps, std::int64_t row) {
    if (row < r.first_gap_tick) return -1;
    const std::int64_t k = (row - r.first_gap_tick) / r.every_ticks;
    return k < n_gaps && (row - r.first_gap_tick) % r.every_ticks < r.gap_ticks ? k : -1;
}

std::vector<SwitchError> errors_of(const Recording& r, const Column& column, std::size_t n_gaps,
                                   const core::GyroCompensationConfig& config) {
    std::vector<SwitchError> errors(n_gaps);
    const auto in_gap = [&](std::int64_t row) { return gap_at(r, static_cast<std::int64_t>(n_gaps), row); };
    const auto add_row = [&](const core::AngleRow& row) {
        if (const std::int64_t k = in_gap(row.tick); k >= 0)
            errors[static_cast<std::size_t>(k)].error_arcsec +=
                row.dtheta_final_arcsec - column.true_arcsec[static_cast<std::size_t>(row.tick)];
    };
    const auto add_gap = [&](const core::GapReport& gap) {
        if (const std::int64_t k = in_gap(gap.first_tick); k >= 0)
            errors[static_cast<std::size_t>(k)].sigma_arcsec = gap.sigma_sum_arcsec;
    };
    rig::Replay replay{config};
    int mode = 1;
    bool was_open = false;
    for (std::size_t k = 0; k < column.counts.size(); ++k) {
        const auto row = static_cast<std::int64_t>(k);
        const bool open = in_gap(row) >= 0;
        if (open && !was_open) mode = -mode;
        was_open = open;
        for (const core::HalfRecord& half : halves_of(row, column.counts[k], mode, open))
            replay.take(half, {}, add_row, add_gap);
    }
    return errors;
}

// The gap that would begin at a row, and the rows around it.
Eigen::VectorXd around(const Recording& r, const Column& c, std::int64_t gap) {
    Eigen::VectorXd z{2 * fit_ticks};
    for (int k = 0; k < fit_ticks; ++k) {
        z[k] = r.count_arcsec * static_cast<double>(c.counts[static_cast<std::size_t>(gap - fit_ticks + k)]);
        z[fit_ticks + k] =
            r.count_arcsec * static_cast<double>(c.counts[static_cast<std::size_t>(gap + r.gap_ticks + k)]);
    }
    return z;
}

double true_gap(const Recording& r, const Column& c, std::int64_t gap) {
    double sum = 0.0;
    for (int k = 0; k < r.gap_ticks; ++k) sum += c.true_arcsec[static_cast<std::size_t>(gap + k)];
    return sum;
}

// rms at the gaps, of the weights that are best on average over all places of the whole recording.
double fit_rms(const Recording& r, const Column& c, const std::vector<std::int64_t>& gaps) {
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(2 * fit_ticks, 2 * fit_ticks);
    Eigen::VectorXd products = Eigen::VectorXd::Zero(2 * fit_ticks);
    const auto last = static_cast<std::int64_t>(c.counts.size()) - r.gap_ticks - fit_ticks;
    for (std::int64_t t = fit_ticks; t <= last; ++t) {
        const Eigen::VectorXd z = around(r, c, t);
        squares += z * z.transpose();
        products += z * true_gap(r, c, t);
    }
    const Eigen::VectorXd weights = squares.ldlt().solve(products);
    double sum = 0.0;
    for (std::int64_t gap : gaps) {
        const double error = weights.dot(around(r, c, gap)) - true_gap(r, c, gap);
        sum += error * error;
    }
    return gaps.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(gaps.size()));
}

// Bridges alone: a recording of motion knows of no re-lock.
std::vector<AccuracyMethod> bridges_for(const Recording& r) {
    config::Config config;
    config.gyro.tick_s = 1.0 / r.rate_hz;
    config.gyro.scale_arcsec = r.count_arcsec;
    std::vector<AccuracyMethod> methods;
    const auto add = [&](const char* name, core::BridgeMethod bridge) {
        methods.push_back({name, rig::compensation_config(config, core::RelockMethod::none, bridge)});
    };
    add("auto", core::BridgeMethod::automatic);
    add("constant", core::BridgeMethod::constant);
    add("linear", core::BridgeMethod::linear);
    add("quadratic", core::BridgeMethod::quadratic);
    return methods;
}

// By bridge, then by gap.
std::vector<std::vector<SwitchError>> errors_of_bridges(const Recording& r, const Column& column, std::size_t n_gaps) {
    std::vector<std::vector<SwitchError>> errors;
    for (const AccuracyMethod& method : bridges_for(r)) errors.push_back(errors_of(r, column, n_gaps, method.config));
    return errors;
}

AxisFigures measure_axis(const Recording& r, int number, const std::vector<double>& increment_arcsec) {
    const Column column = counted(r, increment_arcsec);
    const std::vector<std::int64_t> gaps = gaps_of(r, column.counts.size());
    AxisFigures axis{.column = number, .fit_rms_arcsec = fit_rms(r, column, gaps)};
    const std::vector<AccuracyMethod> methods = bridges_for(r);
    const auto errors = errors_of_bridges(r, column, gaps.size());
    for (std::size_t m = 0; m < errors.size(); ++m)
        axis.methods.push_back({.method = methods[m].name, .of_paper = m > 0, .whole = figures_of(errors[m])});
    return axis;
}

// rms of the gaps named.
double rms(const std::vector<SwitchError>& errors, std::span<const std::size_t> gaps) {
    double sum = 0.0;
    for (const std::size_t k : gaps) sum += errors[k].error_arcsec * errors[k].error_arcsec;
    return std::sqrt(sum / static_cast<double>(gaps.size()));
}

GapLengthFigures measure_gap_length(const Recording& r, int number, const Column& column) {
    const std::size_t n = gaps_of(r, column.counts.size()).size();
    const auto errors = errors_of_bridges(r, column, n);
    std::vector<std::size_t> gaps(n);
    std::iota(gaps.begin(), gaps.end(), std::size_t{0});
    std::ranges::stable_sort(gaps, {}, [&](std::size_t k) { return std::abs(errors[0][k].error_arcsec); });
    const auto usual = std::span{gaps}.first(n - n / 100);
    GapLengthFigures f{.recording = r.name,
                       .column = number,
                       .gap_ticks = r.gap_ticks,
                       .n = static_cast<std::int64_t>(n),
                       .rms_arcsec = rms(errors[0], gaps),
                       .best_arcsec = 1e300,
                       .usual_rms_arcsec = rms(errors[0], usual),
                       .usual_best_arcsec = 1e300,
                       .nev = figures_of(errors[0]).nev};
    for (std::size_t m = 1; m < errors.size(); ++m) {
        f.best_arcsec = std::min(f.best_arcsec, rms(errors[m], gaps));
        f.usual_best_arcsec = std::min(f.usual_best_arcsec, rms(errors[m], usual));
    }
    return f;
}

}  // namespace

RecordingFigures measure_recording(const Recording& recording) {
    RecordingFigures figures{.name = recording.name};
    for (int number : recording.columns)
        figures.axes.push_back(measure_axis(recording, number, column_of(recording, number)));
    return figures;
}

std::vector<RecordingFigures> measure_vehicles(const AccuracyTask& task) {
    const std::vector<VehicleRecord> all = vehicle_records(task.quick, task.seed);
    std::vector<RecordingFigures> figures(all.size());
    numeric::in_parallel(all.size(), task.threads, [&](std::size_t k) {
        const Recording r{.name = all[k].name, .rate_hz = all[k].rate_hz};
        figures[k].name = r.name;
        figures[k].real = false;
        for (const auto& axis : all[k].increment_arcsec)
            figures[k].axes.push_back(measure_axis(r, static_cast<int>(figures[k].axes.size()) + 1, axis));
    });
    return figures;
}

std::vector<GapLengthFigures> measure_gap_lengths(const AccuracyTask& task) {
    if (task.quick) return {};
    std::vector<GapLengthFigures> figures;
    for (const Recording& r : task.recordings) {
        for (int number : r.columns) {
            const Column column = counted(r, column_of(r, number));
            std::vector<GapLengthFigures> of_column(10);
            numeric::in_parallel(of_column.size(), task.threads, [&](std::size_t k) {
                Recording with_gaps = r;
                with_gaps.gap_ticks = static_cast<int>(k) + 1;
                of_column[k] = measure_gap_length(with_gaps, number, column);
            });
            figures.insert(figures.end(), of_column.begin(), of_column.end());
        }
    }
    return figures;
}

}  // namespace zlg::trials
