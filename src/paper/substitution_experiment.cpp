#include <zlg/paper/substitution_experiment.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/design/error.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

#include "phase_regression.hpp"
#include "random_phase_motion.hpp"
#include "substitution_theory.hpp"

namespace zlg::paper {
namespace {

constexpr std::array methods{core::BridgeMethod::constant, core::BridgeMethod::linear, core::BridgeMethod::quadratic};

// What a caller of `zlg.paper` says; the rest is the paper's, or follows from a configuration that was checked.
void require(bool good, const char* name, int value, const char* allowed) {
    if (!good)
        throw design::DesignError{
            fmt::format("substitution experiment: {} is {}, allowed is {}", name, value, allowed)};
}

// The stage slews over half of the gap and settles within twenty time constants, so that what is left of the step is
// far below the light noise: a miss is no part of this experiment.
config::Config gyro_of(const SubstitutionExperiment& e, const SwitchGrid& grid) {
    config::Config c = e.base;
    c.run.seed = e.seed;
    c.perimeter.miss_lambda = 0.0;
    const double gap_s = grid.n * grid.tick_s;
    c.piezo.slew_v_s = std::max(c.piezo.slew_v_s, 2.0 * c.piezo.half_wave_v / gap_s);
    c.piezo.rc_s = std::min(c.piezo.rc_s, gap_s / 20.0);
    c.switching = {.interval_s = static_cast<double>(grid.interval_ticks) * grid.tick_s, .gap_ticks = grid.n};
    constexpr design::Points of_the_paper;
    c.compensation.extrapolation_points = of_the_paper.extrapolation;
    c.compensation.points_before = of_the_paper.before;
    c.compensation.points_after = of_the_paper.after;
    return c;
}

// Errors of one order, switch by switch.
struct Errors {
    explicit Errors(const SwitchGrid& grid)
        : interpolation(static_cast<std::size_t>(grid.switches)), extrapolation(interpolation) {}

    std::vector<double> interpolation;
    std::vector<double> extrapolation;
};

// One run of the twin, its records through a compensation of each order.
class Run {
public:
    Run(const SubstitutionExperiment& e, const SwitchGrid& grid)
        : grid_{grid}, gyro_{gyro_of(e, grid)}, errors_{Errors{grid}, Errors{grid}, Errors{grid}} {
        for (const core::BridgeMethod method : methods)
            replays_.emplace_back(rig::compensation_config(gyro_, core::RelockMethod::mean_square, method));
    }

    const std::array<Errors, 3>& errors(const RandomPhaseMotion& motion) {
        rig::ClosedLoop loop{gyro_, twin::Motion::from_increments(motion.increments_arcsec(), 2.0 / grid_.tick_s)};
        for (std::int64_t tick = 0; tick < grid_.ticks(); ++tick) {
            const rig::LoopHalf first = loop.advance();
            const rig::LoopHalf second = loop.advance();
            take_truth(tick, first.truth.dtheta_arcsec + second.truth.dtheta_arcsec);
            for (std::size_t order = 0; order < methods.size(); ++order) {
                replays_[order].take(first.record);
                const core::AngleSample sample = replays_[order].take(second.record).sample;
                if (sample.has_final) take_row(order, sample.final_row);
                if (sample.has_gap && order == 0) check_gap(sample.gap);
            }
        }
        check_all_switched();
        return errors_;
    }

private:
    void take_truth(std::int64_t tick, double true_arcsec) {
        const std::int64_t k = grid_.switch_of(tick);
        if (k == 0) return;
        for (Errors& of_order : errors_) {
            of_order.interpolation[static_cast<std::size_t>(k - 1)] -= true_arcsec;
            of_order.extrapolation[static_cast<std::size_t>(k - 1)] -= true_arcsec;
        }
    }

    void take_row(std::size_t order, const core::AngleRow& row) {
        const std::int64_t k = grid_.switch_of(row.tick);
        if (k == 0) return;
        errors_[order].interpolation[static_cast<std::size_t>(k - 1)] += row.dtheta_final_arcsec;
        errors_[order].extrapolation[static_cast<std::size_t>(k - 1)] += row.dtheta_arcsec;
    }

    // No bridge of a switch rests on such ticks.
    [[nodiscard]] bool is_away_from_switches(const core::GapReport& gap) const {
        const std::int64_t since_opening = gap.first_tick % grid_.interval_ticks;
        return since_opening > grid_.n + core::max_fit_points &&
               since_opening + gap.n_ticks < grid_.interval_ticks - core::max_fit_points;
    }

    void check_gap(const core::GapReport& gap) {
        // Between two switches the phase jumps to that of the next one, which the control may report as a fault.
        if (!gap.mode_changed && is_away_from_switches(gap)) return;
        ++switched_;
        const std::int64_t due = switched_ * grid_.interval_ticks;
        if (gap.first_tick == due && gap.n_ticks == grid_.n && gap.mode_changed) return;
        throw config::ConfigError{
            fmt::format("substitution experiment: gap {} is at tick {}, {} ticks long, with{} a change of mode; "
                        "allowed is tick {}, {} ticks, with one",
                        switched_, gap.first_tick, gap.n_ticks, gap.mode_changed ? "" : "out", due, grid_.n)};
    }

    void check_all_switched() const {
        if (switched_ == grid_.switches) return;
        throw config::ConfigError{fmt::format(
            "substitution experiment: the gyro switched {} times, allowed is {}: it was not locked again in {} ticks",
            switched_, grid_.switches, recovery_ticks)};
    }

    SwitchGrid grid_;
    config::Config gyro_;
    std::vector<rig::Replay> replays_;
    std::array<Errors, 3> errors_;
    std::int64_t switched_ = 0;
};

SubstitutionPoint point_of(const SubstitutionExperiment& e, const PhaseRegression& found, const Estimate& rms,
                           const SubstitutionTheory& theory) {
    return {.n = e.gap_ticks,
            .frequency_hz = e.amplitude_arcsec_s > 0.0 ? e.frequency_hz : 0.0,
            .amplitude_arcsec_s = e.amplitude_arcsec_s,
            .switches = e.switches,
            .extremum = {found.extremum.value, found.extremum.error, theory.extremum_arcsec},
            .crossing = {found.crossing.value, found.crossing.error, theory.crossing_arcsec},
            .mean = {found.mean.value, found.mean.error, theory.mean_arcsec},
            .noise = {found.noise, 0.0, theory.noise_arcsec},
            .rms = {rms.value, rms.error, theory.rms_arcsec}};
}

SubstitutionResult run_one(const SubstitutionExperiment& e) {
    require(e.switches >= 100 && e.switches <= 100'000, "switches", e.switches, "100..100000");
    const SwitchGrid grid = grid_of(e);
    const RandomPhaseMotion motion{e, grid};
    std::vector<Quadratures> at;
    for (std::int64_t k = 1; k <= grid.switches; ++k) at.push_back(motion.at(k));

    Run run{e, grid};
    const std::array<Errors, 3>& errors = run.errors(motion);
    const auto point = [&](design::Fit fit, std::size_t order, const std::vector<double>& of_switch) {
        const SubstitutionTheory theory = substitution_theory(e, grid, fit, static_cast<int>(order));
        SubstitutionPoint made = point_of(e, regress(of_switch, at), root_mean_square(of_switch), theory);
        made.fit = fit;
        made.order = static_cast<int>(order);
        return made;
    };
    SubstitutionResult result;
    for (std::size_t order = 0; order < methods.size(); ++order) {
        result.interpolation[order] = point(design::Fit::interpolation, order, errors[order].interpolation);
        result.extrapolation[order] = point(design::Fit::extrapolation, order, errors[order].extrapolation);
    }
    return result;
}

void add(ChiSquare& chi2, const Component& c) {
    if (!(c.error > 0.0)) return;
    const double deviation = (c.arcsec - c.theory) / c.error;
    ++chi2.dof;
    chi2.per_dof += (deviation * deviation - chi2.per_dof) / chi2.dof;
}

}  // namespace

std::vector<SubstitutionResult> run_substitution(std::span<const SubstitutionExperiment> experiments, int threads) {
    require(threads >= 1, "threads", threads, "1 or more");
    std::vector<SubstitutionResult> results(experiments.size());
    numeric::in_parallel(experiments.size(), threads, [&](std::size_t k) { results[k] = run_one(experiments[k]); });
    return results;
}

ChiSquare chi2_per_dof(std::span<const SubstitutionPoint> points) {
    ChiSquare chi2;
    for (const SubstitutionPoint& p : points) {
        add(chi2, p.extremum);
        add(chi2, p.crossing);
    }
    return chi2;
}

ChiSquare rms_chi2_per_dof(std::span<const SubstitutionPoint> points) {
    ChiSquare chi2;
    for (const SubstitutionPoint& p : points) add(chi2, p.rms);
    return chi2;
}

}  // namespace zlg::paper
