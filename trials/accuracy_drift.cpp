#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <zlg/numeric/parallel.hpp>

#include "accuracy_gyro.hpp"
#include "accuracy_parts.hpp"

namespace zlg::trials {
namespace {

struct DriftRun {
    GyroLaw gyro;
    MotionLaw motion;
    double interval_s = 90.0;  // the first segment is half of it
    std::vector<double> times_s;
    std::uint64_t seed = 1;
};

// By method, then by time: (delivered less true angle)/time.
std::vector<std::vector<double>> drift_of(const DriftRun& run, const std::vector<AccuracyMethod>& methods) {
    SyntheticGyro gyro{run.gyro, run.motion, run.seed};
    std::vector<core::GyroCompensationState> states(methods.size());
    std::vector<std::vector<double>> drift(methods.size());
    const auto in_ticks = [&](double t_s) { return static_cast<std::int64_t>(std::llround(t_s / run.gyro.tick_s)); };
    const std::int64_t interval = in_ticks(run.interval_s);
    std::int64_t next_switch = interval / 2;
    core::ExactSum truth;
    std::size_t at_time = 0;
    for (std::int64_t tick = 1; at_time < run.times_s.size(); ++tick) {
        std::vector<double> angle(methods.size());
        for (int h = 0; h < 2; ++h) {
            const SyntheticHalf half = gyro.advance();
            truth.add(half.true_arcsec);
            for (std::size_t m = 0; m < methods.size(); ++m)
                angle[m] = step(methods[m].config, states[m], half.record, half.light).angle_arcsec;
        }
        if (tick == in_ticks(run.times_s[at_time])) {
            for (std::size_t m = 0; m < methods.size(); ++m)
                drift[m].push_back((angle[m] - truth.value()) / run.times_s[at_time]);
            ++at_time;
        }
        if (tick != next_switch) continue;
        gyro.open();
        next_switch += interval;
    }
    return drift;
}

// One of the combinations that are asked for, in many runs.
struct DriftCourse {
    double thermal_arcsec_s = 0.0;
    double interval_s = 0.0;
};

// Every length of run is a whole number of these intervals: it ends in the middle of a segment, where the sawtooth is zero.
constexpr DriftCourse courses[] = {{0.7, 50.0}, {0.7, 100.0}, {14.0, 50.0}};

const std::vector<std::string>& drift_methods() {
    static const std::vector<std::string> names{method_name::automatic, method_name::optimal, method_name::quadratic,
                                                method_name::detuning_quadratic};
    return names;
}

DriftRun run_of(const DriftCourse& course, bool quick, std::uint64_t seed) {
    DriftRun run{.gyro = {}, .motion = {}, .interval_s = course.interval_s, .times_s = {600.0, 900.0}, .seed = seed};
    if (!quick) run.times_s.push_back(3600.0);
    // No whole number of periods in an interval.
    run.motion.tones = {{20.0623, 12000.0}};
    run.gyro.magnetic_arcsec_s = 0.7;
    run.gyro.magnetic_thermal_arcsec_s = course.thermal_arcsec_s;
    return run;
}

// By run, by method, by time.
using DriftOfRuns = std::vector<std::vector<std::vector<double>>>;

std::vector<double> rms_of(const DriftOfRuns& runs, std::size_t first, std::size_t n, std::size_t method) {
    std::vector<double> rms;
    for (std::size_t t = 0; t < runs[first][method].size(); ++t) {
        double sum = 0.0;
        for (std::size_t r = first; r < first + n; ++r) sum += runs[r][method][t] * runs[r][method][t];
        rms.push_back(std::sqrt(sum / static_cast<double>(n)));
    }
    return rms;
}

}  // namespace

std::vector<SwitchingDrift> measure_drift(const AccuracyTask& task) {
    const std::size_t n_runs = task.quick ? 4 : 12;
    DriftOfRuns runs(std::size(courses) * n_runs);
    numeric::in_parallel(runs.size(), task.threads, [&](std::size_t k) {
        const std::uint64_t seed = (task.seed << 40) + (std::uint64_t{1} << 39) + k;
        const DriftRun run = run_of(courses[k / n_runs], task.quick, seed);
        runs[k] = drift_of(run, methods_for(run.gyro, drift_methods()));
    });
    std::vector<SwitchingDrift> figures;
    for (std::size_t c = 0; c < std::size(courses); ++c) {
        for (std::size_t m = 0; m < drift_methods().size(); ++m) {
            figures.push_back({.name = fmt::format("A = {} \"/s, a switch every {} s", courses[c].thermal_arcsec_s,
                                                   courses[c].interval_s),
                               .method = drift_methods()[m],
                               .of_paper = is_of_paper(drift_methods()[m]),
                               .runs = static_cast<int>(n_runs),
                               .rms_arcsec_s = rms_of(runs, c * n_runs, n_runs, m)});
        }
    }
    return figures;
}

}  // namespace zlg::trials
