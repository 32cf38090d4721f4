#include <zlg/calibration/lock_in_law.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <zlg/core/compensation/lock_in.hpp>

#include "pieces.hpp"

namespace zlg::calibration {
namespace {

// A beat below this part of the bias may stand for some of the time.
constexpr double min_beat_ratio = 0.01;
constexpr std::int64_t min_dof = 3;
// A square that is known to a third of itself or worse says no more than that the threshold is not larger.
constexpr double min_significance = 3.0;

// Means of a tick over one log in one mode.
struct Stage {
    std::size_t log = 0;
    int mode = 1;
    double rate_arcsec_s = 0.0;
    double n_ticks = 0.0;
    double counts = 0.0;
    double difference = 0.0;  // what the bias adds to one half less what it adds to the other

    [[nodiscard]] double first() const { return 0.5 * (counts + difference); }
    [[nodiscard]] double second() const { return 0.5 * (counts - difference); }
};

std::vector<Stage> stages_of(std::span<const LabLog> logs, std::span<const double> rates_arcsec_s) {
    std::vector<Stage> stages;
    for (const Piece& p : pieces_of(logs, 0.0)) {
        auto stage = std::ranges::find_if(stages, [&](const Stage& s) { return s.log == p.log && s.mode == p.mode; });
        if (stage == stages.end()) {
            stages.push_back({.log = p.log, .mode = p.mode, .rate_arcsec_s = rates_arcsec_s[p.log]});
            stage = stages.end() - 1;
        }
        stage->n_ticks += p.length_s / logs[p.log].tick_s;
        stage->counts += p.counts;
        stage->difference += p.difference;
    }
    for (Stage& s : stages) {
        s.counts /= s.n_ticks;
        s.difference /= s.n_ticks;
    }
    std::erase_if(stages, [](const Stage& s) {
        const double least = std::min(std::abs(s.first()), std::abs(s.second()));
        return !(least > min_beat_ratio * 0.5 * std::abs(s.difference));
    });
    return stages;
}

struct SquareFit {
    double square_counts2 = 0.0;  // of the threshold, as counts in a half
    double variance = 0.0;        // of that
    double scatter_counts = 0.0;
    std::int64_t dof = 0;
};

// What a threshold of so many counts in half a tick takes from a tick.
double lost(const Stage& s, double tick_s, double edge_ratio, double threshold_counts) {
    const double ratio = 1.0 / (1.0 - edge_ratio);
    const core::CompensationConstants gyro{
        .tick = core::Seconds{tick_s}, .bias = core::Hertz{std::abs(s.difference) / tick_s}, .plateau_ratio = ratio};
    const core::LockInConfig config{.threshold = core::Hertz{2.0 * threshold_counts / tick_s}};
    return core::lost_to_lock_in(gyro, config, s.first(), s.second()).value;
}

bool has_both_modes(const std::vector<Stage>& stages) {
    return std::ranges::any_of(stages, [&](const Stage& s) { return s.mode != stages.front().mode; });
}

std::optional<SquareFit> fit_of(const std::vector<Stage>& stages, double tick_s, double edge_ratio) {
    if (stages.empty()) return std::nullopt;
    const Eigen::Index n_laws = has_both_modes(stages) ? 4 : 3;
    const Eigen::Index n = std::ssize(stages);
    if (n - n_laws < min_dof) return std::nullopt;
    double largest = 0.0;
    for (const Stage& s : stages) largest = std::max(largest, std::abs(s.rate_arcsec_s));
    if (!(largest > 0.0)) return std::nullopt;
    Eigen::MatrixXd laws(n, n_laws);
    Eigen::VectorXd counts(n);
    double threshold = 0.1;  // to begin with: so small that the law is its first term
    SquareFit fit{.dof = n - n_laws};
    for (int turn = 0; turn < 8; ++turn) {
        for (Eigen::Index k = 0; k < n; ++k) {
            const Stage& s = stages[static_cast<std::size_t>(k)];
            laws(k, 0) = -lost(s, tick_s, edge_ratio, threshold) / (threshold * threshold);
            laws(k, 1) = s.rate_arcsec_s / largest;
            laws(k, 2) = 1.0;
            if (n_laws == 4) laws(k, 3) = s.mode;
            counts[k] = s.counts;
        }
        const double shape = laws.col(0).cwiseAbs().maxCoeff();
        if (!(shape > 0.0)) return std::nullopt;
        laws.col(0) /= shape;
        const Eigen::MatrixXd normal = laws.transpose() * laws;
        const Eigen::FullPivLU<Eigen::MatrixXd> solver{normal};
        if (!(solver.rcond() > 1e-10)) return std::nullopt;
        const Eigen::VectorXd found = solver.solve(laws.transpose() * counts);
        const double mean_sq = (counts - laws * found).squaredNorm() / static_cast<double>(fit.dof);
        fit.square_counts2 = found[0] / shape;
        fit.variance = mean_sq * solver.inverse()(0, 0) / (shape * shape);
        fit.scatter_counts = std::sqrt(mean_sq);
        if (!(fit.square_counts2 > 0.0)) return fit;
        threshold = std::sqrt(fit.square_counts2);
    }
    return fit;
}

std::vector<Stage> without(std::vector<Stage> stages, std::size_t log) {
    std::erase_if(stages, [log](const Stage& s) { return s.log == log; });
    return stages;
}

// Of the square, by leaving out one log at a time; infinite where one log alone tells it.
double jackknife_variance(const std::vector<Stage>& stages, std::size_t n_logs, double tick_s, double edge_ratio) {
    double sum = 0.0, square = 0.0, n = 0.0;
    for (std::size_t log = 0; log < n_logs; ++log) {
        const std::vector<Stage> rest = without(stages, log);
        if (rest.size() == stages.size()) continue;
        const std::optional<SquareFit> fit = fit_of(rest, tick_s, edge_ratio);
        if (!fit) return std::numeric_limits<double>::infinity();
        n += 1.0;
        sum += fit->square_counts2;
        square += fit->square_counts2 * fit->square_counts2;
    }
    return n > 1.0 ? (n - 1.0) * std::max(0.0, square / n - (sum / n) * (sum / n))
                   : std::numeric_limits<double>::infinity();
}

// Half of what the thresholds of both modes differ by; 0 of a single mode, none where a mode alone has too few rates.
std::optional<double> half_difference(const std::vector<Stage>& stages, double tick_s, double edge_ratio) {
    std::vector<double> threshold;
    for (const int mode : {1, -1}) {
        std::vector<Stage> of_mode = stages;
        std::erase_if(of_mode, [mode](const Stage& s) { return s.mode != mode; });
        if (of_mode.empty()) continue;
        const std::optional<SquareFit> fit = fit_of(of_mode, tick_s, edge_ratio);
        if (!fit) return std::nullopt;
        threshold.push_back(std::sqrt(std::max(0.0, fit->square_counts2)));
    }
    return threshold.size() == 2 ? 0.5 * std::abs(threshold[0] - threshold[1]) : 0.0;
}

double nearest_ratio(const std::vector<Stage>& stages) {
    double nearest = 1.0;
    for (const Stage& s : stages)
        nearest =
            std::min(nearest, std::min(std::abs(s.first()), std::abs(s.second())) / (0.5 * std::abs(s.difference)));
    return nearest;
}

}  // namespace

LockInLaw find_lock_in_law(std::span<const LabLog> logs, std::span<const double> rates_arcsec_s,
                           const LockInGyro& gyro) {
    LockInLaw law;
    std::vector<double> distinct(rates_arcsec_s.begin(), rates_arcsec_s.end());
    std::ranges::sort(distinct);
    const std::int64_t n_rates = std::unique(distinct.begin(), distinct.end()) - distinct.begin();
    const std::vector<Stage> stages = stages_of(logs, rates_arcsec_s);
    const double tick_s = logs.front().tick_s;
    const double edge_ratio = std::min(gyro.edge_s / tick_s, 0.5);
    const std::optional<SquareFit> fit = n_rates < 5 ? std::nullopt : fit_of(stages, tick_s, edge_ratio);
    const std::optional<double> between_modes = fit ? half_difference(stages, tick_s, edge_ratio) : std::nullopt;
    if (!between_modes) {
        law.threshold_hz = numeric::refused(
            fmt::format("{} known rate{} of {} log{}; 6 or more logs in each of its modes at 5 or more "
                        "different rates are needed, some of them within a fifth "
                        "of the rate that cancels the bias",
                        n_rates, n_rates == 1 ? "" : "s", logs.size(), logs.size() == 1 ? "" : "s"));
        return law;
    }
    law.dof = fit->dof;
    double largest_counts = 0.0;
    for (const Stage& s : stages) largest_counts = std::max(largest_counts, std::abs(s.counts));
    law.scatter_ppm = 1e6 * fit->scatter_counts / largest_counts;
    const double variance = std::max(fit->variance, jackknife_variance(stages, logs.size(), tick_s, edge_ratio));
    const double sigma = numeric::widened(std::sqrt(variance), static_cast<double>(fit->dof));
    if (!(fit->square_counts2 > min_significance * sigma)) {
        law.threshold_hz = numeric::refused(fmt::format(
            "its square comes out as {:.3g} +- {:.3g} Hz^2: the rates do not tell it. The beat of a half falls to "
            "{:.2g} of the bias "
            "at the nearest one; nearer or longer logs would tell more",
            fit->square_counts2 * 4.0 / (tick_s * tick_s), sigma * 4.0 / (tick_s * tick_s), nearest_ratio(stages)));
        return law;
    }
    const double counts = std::sqrt(fit->square_counts2);
    const double to_hz = 2.0 / tick_s / gyro.counts_per_turn;
    law.threshold_hz = numeric::estimated(to_hz * counts, to_hz * std::hypot(0.5 * sigma / counts, *between_modes));
    return law;
}

}  // namespace zlg::calibration
