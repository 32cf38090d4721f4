#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/replay.hpp>

#include "parts.hpp"
#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

struct Combination {
    double thermal_arcsec_s = 0.0;
    double interval_s = 0.0;  // the first segment is half of it
};

// Every length of run is a whole number of these intervals: it ends in the middle of a segment, where the sawtooth is
// zero.
constexpr Combination combinations[] = {{0.7, 50.0}, {0.7, 100.0}, {14.0, 50.0}};

const std::vector<std::string>& drift_methods() {
    static const std::vector<std::string> names{method_name::automatic, method_name::quadratic,
                                                method_name::detuning_quadratic};
    return names;
}

// By method, then by time: (delivered less true angle)/time.
std::vector<std::vector<double>> drift_of(const Combination& c, const std::vector<double>& times_s,
                                          std::uint64_t seed) {
    const GyroLaw law{.magnetic_arcsec_s = 0.7, .magnetic_thermal_arcsec_s = c.thermal_arcsec_s};
    // No whole number of periods in an interval.
    SyntheticGyro gyro{law, {.tones = {{20.0623, 12000.0}}}, seed};
    std::vector<rig::Replay> replays;
    for (const AccuracyMethod& m : methods_for(config_of(law), drift_methods())) replays.emplace_back(m.config);
    std::vector<std::vector<double>> drift(replays.size());
    const auto in_ticks = [&](double t_s) { return std::llround(t_s / law.tick_s); };
    const std::int64_t interval = in_ticks(c.interval_s);
    core::ExactSum truth;
    std::int64_t tick = 0;
    for (const double time_s : times_s) {
        while (tick < in_ticks(time_s)) {
            if (tick % interval == interval / 2) gyro.open();
            for (int h = 0; h < 2; ++h) {
                const SyntheticHalf half = gyro.advance();
                truth.add(half.true_arcsec);
                for (rig::Replay& replay : replays) replay.take(half.record, half.light);
            }
            ++tick;
        }
        for (std::size_t m = 0; m < replays.size(); ++m)
            drift[m].push_back((replays[m].angle_arcsec() - truth.value()) / time_s);
    }
    return drift;
}

}  // namespace

std::vector<SwitchingDrift> measure_drift(const AccuracyTask& task) {
    const std::size_t n_runs = task.quick ? 4 : 12;
    std::vector<double> times_s = accuracy_run_lengths_s;
    if (task.quick) times_s.pop_back();
    std::vector<std::vector<std::vector<double>>> drift(std::size(combinations) * n_runs);  // by run, method and time
    numeric::in_parallel(drift.size(), task.threads, [&](std::size_t k) {
        drift[k] = drift_of(combinations[k / n_runs], times_s, (task.seed << 40) + (std::uint64_t{1} << 39) + k);
    });
    std::vector<SwitchingDrift> figures;
    for (std::size_t c = 0; c < std::size(combinations); ++c) {
        for (std::size_t m = 0; m < drift_methods().size(); ++m) {
            SwitchingDrift f{.name = fmt::format("A = {} \"/s, a switch every {} s", combinations[c].thermal_arcsec_s,
                                                 combinations[c].interval_s),
                             .method = drift_methods()[m],
                             .of_paper = is_of_paper(drift_methods()[m]),
                             .runs = static_cast<int>(n_runs),
                             .rms_arcsec_s = std::vector<double>(times_s.size())};
            for (std::size_t t = 0; t < times_s.size(); ++t) {
                for (std::size_t r = c * n_runs; r < (c + 1) * n_runs; ++r)
                    f.rms_arcsec_s[t] += drift[r][m][t] * drift[r][m][t];
                f.rms_arcsec_s[t] = std::sqrt(f.rms_arcsec_s[t] / static_cast<double>(n_runs));
            }
            figures.push_back(std::move(f));
        }
    }
    return figures;
}

}  // namespace zlg::trials
