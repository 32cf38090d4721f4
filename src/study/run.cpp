#include <zlg/study/run.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <map>
#include <thread>

#include <zlg/core/common/maths.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/rig/wiring.hpp>

#include "gyro_drift.hpp"
#include "magnifier.hpp"
#include "relock_profile.hpp"

namespace zlg::study {
namespace {

using core::BridgeMethod;
using core::RelockMethod;

constexpr std::int64_t curve_points = 2000;
constexpr int profile_ticks = 8;

std::int64_t curve_stride(std::int64_t ticks) { return std::max<std::int64_t>(1, ticks / curve_points); }

// One compensation of the records, with its error meter.
struct Variant {
    std::string name;
    rig::Replay replay;
    ErrorMeter meter;
    std::array<double, core::history_ticks> taken_out_arcsec{};  // of the magnetic drift, by tick

    [[nodiscard]] VariantResult result() const {
        return {name,
                meter.drift_arcsec_s(),
                meter.angle_error_arcsec(),
                statistics(meter.switches()),
                meter.switches(),
                meter.curve()};
    }
};

std::vector<Variant> variants(const config::Config& config, std::int64_t stride) {
    struct Choice {
        const char* name;
        RelockMethod relock;
        BridgeMethod bridge;
    };
    const std::array choices{
        Choice{"switching", RelockMethod::none, BridgeMethod::none},
        Choice{"relock_frequency", RelockMethod::frequency, BridgeMethod::quadratic},
        Choice{"relock_detuning", RelockMethod::detuning, BridgeMethod::quadratic},
        Choice{"relock_mean_square", RelockMethod::mean_square, BridgeMethod::quadratic},
        Choice{"bridge_constant", RelockMethod::detuning, BridgeMethod::constant},
        Choice{"bridge_linear", RelockMethod::detuning, BridgeMethod::linear},
        Choice{"bridge_quadratic", RelockMethod::detuning, BridgeMethod::quadratic},
        Choice{"configured", rig::asked_relock(config), config.compensation.bridge},
    };
    // The named variants are the paper's, with its points; only the last takes those of the configuration.
    config::Config paper = config;
    const config::Compensation points;
    paper.compensation.extrapolation_points = points.extrapolation_points;
    paper.compensation.points_before = points.points_before;
    paper.compensation.points_after = points.points_after;

    std::vector<Variant> all;
    for (const Choice& c : choices) {
        const config::Config& of = &c == &choices.back() ? config : paper;
        all.push_back({c.name, rig::Replay{rig::compensation_config(of, c.relock, c.bridge)},
                       ErrorMeter{config.gyro.tick_s, stride, gyro_drift(config)}});
    }
    return all;
}

// A tick between its records and its final row.
struct WaitingTick {
    double true_arcsec = 0.0;
    double rounding_arcsec = 0.0;
    MagnifiedTick shown;
};

class Experiment {
public:
    Experiment(const RunTask& task, std::int64_t ticks)
        : task_{task},
          count_{task.config},
          variants_{variants(task.config, curve_stride(ticks))},
          finder_{task.config.compensation.relock_ticks} {}

    // The first half of a tick, while its light is there.
    void first_half(const rig::LoopHalf& first, const core::LightSamples& light) {
        for (Variant& v : variants_)
            if (is_stepped(v)) v.replay.take(first.record, light);
    }

    void tick(std::int64_t tick, const rig::LoopHalf& first, const rig::LoopHalf& second,
              const core::LightSamples& light_second) {
        finder_.take(tick, first.record, second.record);
        forget_windows(tick);
        remember_switch();
        profile_.take(first.record, second.record, first.truth.false_relock_arcsec + second.truth.false_relock_arcsec);
        const MagnifiedTick shown = shown_tick(tick, task_.config.gyro.scale_arcsec, first, second);
        waiting_[static_cast<std::size_t>(tick) % waiting_.size()] = {shown.true_arcsec, second.truth.rounding_arcsec,
                                                                      shown};
        for (const rig::LoopHalf* half : {&first, &second}) {
            take_health(*half);
            count_.take(*half);
            if (half->control.has_event) events_[half->control.event.tick_opened] = *half;
        }
        for (Variant& v : variants_) {
            rig::hand_over(
                step_here_or_outside(v, tick, second, light_second),
                [&](const core::AngleRow& row) { take_row(v, row); },
                [&](const core::GapReport& gap) { take_gap(v, gap); });
        }
    }

    void end() {
        for (Variant& v : variants_) {
            const auto on_row = [&](const core::AngleRow& row) { take_row(v, row); };
            const auto on_gap = [&](const core::GapReport& gap) { take_gap(v, gap); };
            if (is_outside(v))
                rig::hand_over_rest([this] { return task_.processor->drain(); }, on_row, on_gap);
            else
                v.replay.end(on_row, on_gap);
        }
    }

    void report(RunResult& result) const {
        for (const Variant& v : variants_) result.variants.push_back(v.result());
        result.switches = switch_lines();
        result.tally = count_.tally();
        result.magnified = magnifier_.ticks();
        result.relock_false_drift_deg_h = profile_.mean_deg_h(task_.config.gyro.tick_s);
    }

private:
    [[nodiscard]] bool is_configured(const Variant& v) const { return &v == &variants_.back(); }

    // Its compensation runs in a processor outside.
    [[nodiscard]] bool is_outside(const Variant& v) const { return task_.processor != nullptr && is_configured(v); }

    // Of a processor outside no more is known than its rows: what it takes out of the angle is what ours would.
    [[nodiscard]] bool is_stepped(const Variant& v) const {
        return !is_outside(v) || v.replay.config().magnetic.method == core::MagneticMethod::estimate;
    }

    core::AngleSample step_here_or_outside(Variant& v, std::int64_t tick, const rig::LoopHalf& second,
                                           const core::LightSamples& light) {
        core::AngleSample sample;
        if (is_stepped(v)) {
            const double before_arcsec = v.replay.state().magnetic.subtracted_arcsec;
            sample = v.replay.take(second.record, light).sample;
            v.taken_out_arcsec[static_cast<std::size_t>(tick) % v.taken_out_arcsec.size()] =
                v.replay.state().magnetic.subtracted_arcsec - before_arcsec;
        }
        return is_outside(v) ? second.compensation.value_or(core::CompensationOutput{}).sample : sample;
    }

    void take_gap(const Variant& v, const core::GapReport& gap) {
        if (is_configured(v)) gaps_[gap.first_tick] = gap;
    }

    void take_row(Variant& v, const core::AngleRow& row) {
        const WaitingTick& waiting = waiting_[static_cast<std::size_t>(row.tick) % waiting_.size()];
        const auto place = static_cast<std::size_t>(row.tick) % v.taken_out_arcsec.size();
        v.meter.take(row, {waiting.true_arcsec, v.taken_out_arcsec[place], waiting.rounding_arcsec}, finder_.windows());
        if (!is_configured(v)) return;
        MagnifiedTick shown = waiting.shown;
        shown.dtheta_arcsec = row.dtheta_arcsec;
        shown.final_arcsec = row.dtheta_final_arcsec;
        magnifier_.take(shown, finder_.windows());
        if (task_.on_row) task_.on_row(row, waiting.true_arcsec);
    }

    // A window is needed until every variant has given the final row of its last tick.
    void forget_windows(std::int64_t tick) {
        auto& windows = finder_.windows();
        while (!windows.empty() && windows.front().gap_is_over() &&
               windows.front().last_tick < tick - core::history_ticks)
            windows.pop_front();
    }

    [[nodiscard]] std::vector<SwitchLine> switch_lines() const {
        std::map<std::int64_t, SwitchError> errors;
        for (const SwitchError& e : variants_.back().meter.switches()) errors[e.window.first_tick] = e;
        std::vector<SwitchLine> lines;
        for (const auto& [tick, window] : switches_) {
            SwitchLine line{.tick = tick, .mode = window.mode_after, .gap_ticks = window.n_ticks};
            const auto error = errors.find(tick);
            line.relock_arcsec = error != errors.end() ? error->second.relock_arcsec : unknown;
            line.true_error_arcsec = error != errors.end() ? error->second.error_arcsec : unknown;
            const auto gap = gaps_.find(tick);
            line.dp_arcsec = gap != gaps_.end() ? gap->second.dp_arcsec : unknown;
            line.sigma_arcsec = gap != gaps_.end() ? gap->second.sigma_sum_arcsec : core::infinity;
            add_event(tick, line);
            lines.push_back(line);
        }
        return lines;
    }

    void add_event(std::int64_t tick, SwitchLine& line) const {
        const auto found = events_.find(tick);
        const bool known = found != events_.end();
        line.miss_lambda =
            known && found->second.control.event.has_miss ? found->second.control.event.miss_lambda : unknown;
        line.half_wave_v = known ? found->second.half_wave_v : unknown;
        line.half_wave_sigma_v = known ? found->second.half_wave_sigma_v : core::infinity;
    }

    // Once its gap is over a switch is one, whatever of its re-lock the run still sees.
    void remember_switch() {
        if (finder_.windows().empty() || !finder_.windows().back().gap_is_over()) return;
        const SwitchWindow& window = finder_.windows().back();
        switches_[window.first_tick] = window;
    }

    void take_health(const rig::LoopHalf& half) {
        if (!task_.on_health || (half.record.half > 0 && half.control.health == health_)) return;
        health_ = half.control.health;
        task_.on_health(half.record.half, health_);
    }

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    const RunTask& task_;
    rig::SwitchCount count_;
    std::vector<Variant> variants_;
    SwitchFinder finder_;
    RelockProfile profile_{profile_ticks};
    Magnifier magnifier_;
    std::array<WaitingTick, core::history_ticks> waiting_{};
    std::map<std::int64_t, SwitchWindow> switches_;
    std::map<std::int64_t, core::GapReport> gaps_;
    std::uint32_t health_ = 0;
    std::map<std::int64_t, rig::LoopHalf> events_;  // the half in which the lock that ends a switch was seen
};

// The same gyro without switching: its error is what the regime is for.
VariantResult one_mode(const config::Config& config, const twin::Motion& motion, std::int64_t ticks) {
    const config::Config still = rig::without_switching(config);
    rig::ClosedLoop loop{still, motion};
    Variant variant{"one_mode",
                    rig::Replay{rig::compensation_config(still, RelockMethod::none, still.compensation.bridge)},
                    ErrorMeter{still.gyro.tick_s, curve_stride(ticks), gyro_drift(still)}};
    std::array<double, core::history_ticks> truth{};
    const std::deque<SwitchWindow> no_windows;
    const auto take = [&](const core::AngleRow& row) {
        variant.meter.take(row, {truth[static_cast<std::size_t>(row.tick) % truth.size()], 0.0}, no_windows);
    };
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        const rig::LoopHalf first = loop.advance();
        const rig::LoopHalf second = loop.advance();
        truth[static_cast<std::size_t>(tick) % truth.size()] = first.truth.dtheta_arcsec + second.truth.dtheta_arcsec;
        variant.replay.take(first.record);
        variant.replay.take(second.record, {}, take);
    }
    variant.replay.end(take);
    return variant.result();
}

rig::LoopHalf advance(rig::ClosedLoop& loop, const RunTask& task) {
    rig::LoopHalf half = loop.advance();
    if (task.on_record) task.on_record(half.record, loop.light());
    return half;
}

void switching_run(const RunTask& task, const twin::Motion& motion, std::int64_t ticks, RunResult& result) {
    rig::ClosedLoop loop{task.config, motion, task.processor};
    Experiment experiment{task, ticks};
    const std::int64_t progress_stride = std::clamp<std::int64_t>(ticks / 200, 1, 100'000);
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        const rig::LoopHalf first = advance(loop, task);
        experiment.first_half(first, loop.light());
        const rig::LoopHalf second = advance(loop, task);
        experiment.tick(tick, first, second, loop.light());
        if (task.on_progress && tick % progress_stride == 0)
            task.on_progress(static_cast<double>(tick) / static_cast<double>(ticks));
    }
    experiment.end();
    experiment.report(result);
}

}  // namespace

RunResult run(const RunTask& task) {
    const twin::Motion motion = rig::motion(task.config);
    const std::int64_t ticks = rig::run_ticks(task.config, motion);
    RunResult result{.tick_s = task.config.gyro.tick_s, .ticks = ticks, .warnings = task.warnings};
    VariantResult still;
    if (task.threads > 1) {
        std::exception_ptr failure;
        std::jthread beside{[&] {
            try {
                still = one_mode(task.config, motion, ticks);
            } catch (...) {
                failure = std::current_exception();
            }
        }};
        switching_run(task, motion, ticks, result);
        beside.join();
        if (failure) std::rethrow_exception(failure);
    } else {
        switching_run(task, motion, ticks, result);
        still = one_mode(task.config, motion, ticks);
    }
    result.variants.insert(result.variants.begin(), std::move(still));
    return result;
}

}  // namespace zlg::study
