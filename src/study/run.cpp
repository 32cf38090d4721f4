#include <zlg/study/run.hpp>

#include <array>
#include <bit>
#include <future>
#include <map>

#include <fmt/format.h>

#include <zlg/core/health.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/fingerprint.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/reading_error.hpp>

#include "magnifier.hpp"
#include "relock_profile.hpp"
#include "run_variant.hpp"

namespace zlg::study {
namespace {

constexpr std::int64_t curve_points = 2000;  // at most about twice as many: what a figure can show
constexpr int profile_ticks = 8;             // after closing, of which the mean false drift is reported

// Which bits of the health of one half are trouble, and not a sound gyro at work. A switch darkens the beams and finds
// the perimeter far off, in every gyro.
constexpr std::uint32_t trouble_bits(std::uint32_t health) {
    using namespace core;
    constexpr std::uint32_t at_work = health_switching | health_recentring | health_warming_up | health_edges_shifted;
    constexpr std::uint32_t of_a_switch = health_light_lost | health_detuning_over_limit;
    const bool is_switching = (health & health_switching) != 0;
    return health & ~at_work & ~(is_switching ? of_a_switch : 0u);
}

std::int64_t curve_stride(const RunTask& task, std::int64_t ticks) {
    return task.has_figures ? std::max<std::int64_t>(1, ticks / curve_points) : ticks + 1;
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
          variants_{variants(task.config, curve_stride(task, ticks), task.variants)},
          switches_{task.config.compensation.relock_ticks},
          fingerprint_{task.config.gyro.fidelity == config::Fidelity::events} {}

    // The first half of a tick, while its frame and its light are there.
    void first_half(const rig::LoopHalf& first, const core::SensorFrame& sensor, const core::LightSamples& light) {
        fingerprint_.take(first, sensor);
        for (Variant& v : variants_) v.replay.take(first.record, light);
    }

    void tick(std::int64_t tick, const rig::LoopHalf& first, const rig::LoopHalf& second,
              const core::SensorFrame& sensor_second, const core::LightSamples& light_second) {
        fingerprint_.take(second, sensor_second);
        switches_.take(tick, first.record, second.record);
        profile_.take(first.record, second.record, first.truth.false_relock_arcsec + second.truth.false_relock_arcsec);
        WaitingTick& waiting = waiting_[static_cast<std::size_t>(tick) % waiting_.size()];
        waiting.true_arcsec = first.truth.dtheta_arcsec + second.truth.dtheta_arcsec;
        waiting.rounding_arcsec = reading_error_arcsec(task_.config, second);
        if (task_.has_figures) waiting.shown = shown_tick(tick, task_.config.gyro.scale_arcsec, first, second);
        count_whole(first, second);
        for (const rig::LoopHalf* half : {&first, &second}) {
            take_health(*half);
            count_.take(*half);
            count_health(*half);
            if (half->control.has_event) events_[half->control.event.tick_opened] = *half;
        }
        for (Variant& v : variants_) {
            rig::hand_over(
                stepped(v, tick, second, light_second), [&](const core::AngleRow& row) { take_row(v, row); },
                [&](const core::GapReport& gap) { take_gap(v, gap); });
        }
    }

    void leap(const rig::Leap& leap) {
        fingerprint_.take(leap);
        for (Variant& v : variants_) {
            const double arcsec = v.replay.leap(leap, [&](const core::AngleRow& row) { take_row(v, row); });
            v.meter.leap(leap.ticks(), arcsec - leap.dtheta_arcsec);
        }
    }

    void end() {
        for (Variant& v : variants_) {
            const auto on_row = [&](const core::AngleRow& row) { take_row(v, row); };
            const auto on_gap = [&](const core::GapReport& gap) { take_gap(v, gap); };
            v.replay.end(on_row, on_gap);
        }
    }

    void report(RunResult& result) const {
        for (const Variant& v : variants_) result.variants.push_back(v.result());
        if (is_wanted(task_.variants, magnetic_estimate)) take_out_magnetic(result);
        add_bridge_quadratic(result);
        result.fingerprint = fingerprint_.text();
        result.health_raised = health_raised_;
        result.invalid_ticks = invalid_ticks_;
        if (lost_ticks_ > 0)
            result.warnings.push_back(
                fmt::format("{} of {} ticks are lost (flag unrepaired): what the gyro turned in them is not known",
                            lost_ticks_, result.ticks));
        result.switches = switch_lines();
        result.tally = count_.tally();
        result.whole_count_ticks = whole_count_ticks_;
        result.fringe_lost_ticks = fringe_lost_ticks_;
        result.magnified = magnifier_.ticks();
        result.relock_false_drift_deg_h = profile_.mean_deg_h(task_.config.gyro.tick_s);
        result.health = health_times();
    }

private:
    [[nodiscard]] bool is_configured(const Variant& v) const { return &v == &variants_.back(); }

    static void take_out_magnetic(RunResult& result) {
        const auto found = std::ranges::find(result.variants, magnetic_estimate, &VariantResult::name);
        if (found == result.variants.end()) {
            result.magnetic_estimate = result.variants.back();
            result.magnetic_estimate.name = magnetic_estimate;
        } else {
            result.magnetic_estimate = std::move(*found);
            result.variants.erase(found);
        }
    }

    void add_bridge_quadratic(RunResult& result) const {
        if (!is_wanted(task_.variants, bridge_quadratic) || !is_wanted(task_.variants, relock_detuning)) return;
        VariantResult same = *std::ranges::find(result.variants, relock_detuning, &VariantResult::name);
        same.name = bridge_quadratic;
        result.variants.insert(result.variants.end() - 1, std::move(same));
    }

    static core::AngleSample stepped(Variant& v, std::int64_t tick, const rig::LoopHalf& second,
                                     const core::LightSamples& light) {
        const double before_arcsec = v.replay.state().magnetic.subtracted_arcsec;
        const core::AngleSample sample = v.replay.take(second.record, light).sample;
        v.taken_out_arcsec[static_cast<std::size_t>(tick) % v.taken_out_arcsec.size()] =
            v.replay.state().magnetic.subtracted_arcsec - before_arcsec;
        return sample;
    }

    void take_gap(const Variant& v, const core::GapReport& gap) {
        if (is_configured(v)) switches_.take(gap);
    }

    void take_row(Variant& v, const core::AngleRow& row) {
        const WaitingTick& waiting = waiting_[static_cast<std::size_t>(row.tick) % waiting_.size()];
        const auto place = static_cast<std::size_t>(row.tick) % v.taken_out_arcsec.size();
        v.meter.take(row, {waiting.true_arcsec, v.taken_out_arcsec[place], waiting.rounding_arcsec},
                     switches_.windows());
        if (!is_configured(v)) return;
        fingerprint_.take(row);
        switches_.take(row);
        if ((row.flags & core::flag_invalid) != 0 && (row.flags & core::flag_switching) == 0) ++invalid_ticks_;
        lost_ticks_ += (row.flags & core::flag_unrepaired) != 0;
        if (task_.has_figures) magnify(waiting.shown, row);
        if (task_.on_row) task_.on_row(row, waiting.true_arcsec);
    }

    void magnify(MagnifiedTick shown, const core::AngleRow& row) {
        shown.dtheta_arcsec = row.dtheta_arcsec;
        shown.final_arcsec = row.dtheta_final_arcsec;
        magnifier_.take(shown, switches_.windows());
    }

    [[nodiscard]] std::vector<SwitchLine> switch_lines() const {
        std::map<std::int64_t, double> errors_arcsec;
        for (const SwitchError& e : variants_.back().meter.switches())
            errors_arcsec[e.window.first_tick] = e.error_arcsec;
        std::vector<SwitchLine> lines = switches_.lines();
        for (SwitchLine& line : lines) {
            if (const auto error = errors_arcsec.find(line.tick); error != errors_arcsec.end())
                line.true_error_arcsec = error->second;
            const auto event = events_.find(line.tick);
            if (event == events_.end()) continue;
            line.half_wave_v = event->second.half_wave_v;
            line.half_wave_sigma_v = event->second.half_wave_sigma_v;
        }
        return lines;
    }

    void count_health(const rig::LoopHalf& half) {
        for (std::uint32_t bits = half.control.health; bits != 0; bits &= bits - 1) {
            auto& [first, n] = halves_of_bit_[static_cast<std::size_t>(std::countr_zero(bits))];
            if (n++ == 0) first = half.record.half;
        }
    }

    [[nodiscard]] std::vector<HealthTime> health_times() const {
        const double half_s = 0.5 * task_.config.gyro.tick_s;
        std::vector<HealthTime> out;
        for (std::size_t bit = 0; bit < halves_of_bit_.size(); ++bit) {
            if (const auto& [first, n] = halves_of_bit_[bit]; n > 0)
                out.push_back({core::health_bit_names.at(bit), static_cast<double>(first) * half_s,
                               static_cast<double>(n) * half_s});
        }
        std::ranges::stable_sort(out, {}, &HealthTime::first_s);
        return out;
    }

    // A tick lies between the borders at the ends of its halves.
    void count_whole(const rig::LoopHalf& first, const rig::LoopHalf& second) {
        const bool reads = task_.config.gyro.readout == config::Readout::phase;
        if (!reads || !core::is_measured(first.record, second.record) || core::has_fringe(second.record)) return;
        ++whole_count_ticks_;
        if ((second.control.health & core::health_fringe_lost) != 0) ++fringe_lost_ticks_;
    }

    void take_health(const rig::LoopHalf& half) {
        health_raised_ |= trouble_bits(half.control.health);
        if (!task_.on_health || (half.record.half > 0 && half.control.health == health_)) return;
        health_ = half.control.health;
        task_.on_health(half.record.half, health_);
    }

    const RunTask& task_;
    rig::SwitchCount count_;
    std::vector<Variant> variants_;
    SwitchTable switches_;
    rig::Fingerprint fingerprint_;
    RelockProfile profile_{profile_ticks};
    Magnifier magnifier_;
    std::array<WaitingTick, core::history_ticks> waiting_{};  // by tick modulo the size: a final row comes sooner
    std::uint32_t health_ = 0;
    std::uint32_t health_raised_ = 0;
    std::int64_t invalid_ticks_ = 0;
    std::int64_t lost_ticks_ = 0;  // without a sigma
    std::int64_t whole_count_ticks_ = 0, fringe_lost_ticks_ = 0;
    std::map<std::int64_t, rig::LoopHalf> events_;  // by the first tick of the gap: the half in which its lock was seen
    // By bit of health: the first half, and how many.
    std::array<std::pair<std::int64_t, std::int64_t>, core::health_bit_names.size()> halves_of_bit_{};
};

// Where the interval is shorter than what the loop needs to lock anew.
std::optional<std::string> late_switches(const config::Config& config, const std::vector<SwitchLine>& switches) {
    const config::Switching& asked = config.switching;
    if (asked.schedule != config::Schedule::fixed || switches.size() < 4) return {};
    std::vector<std::int64_t> ticks;
    for (std::size_t k = 1; k < switches.size(); ++k) ticks.push_back(switches[k].tick - switches[k - 1].tick);
    std::ranges::nth_element(ticks, ticks.begin() + static_cast<std::ptrdiff_t>(ticks.size() / 2));
    const double reached_s = static_cast<double>(ticks[ticks.size() / 2]) * config.gyro.tick_s;
    if (!(reached_s > asked.interval_s + config.gyro.tick_s)) return {};
    return fmt::format(
        "switching.interval_s = {}: the gyro switched every {:g} s (median), for a switch waits until the loop is "
        "locked after the one before",
        asked.interval_s, reached_s);
}

std::optional<std::string> lived_after_all(const config::Config& config, const twin::Motion& motion) {
    if (config.gyro.fidelity != config::Fidelity::events) return {};
    const std::string why = rig::why_lived(config, motion);
    if (why.empty()) return {};
    return fmt::format("gyro.fidelity = \"events\": the whole run is simulated half by half, for {}", why);
}

// The same gyro without switching: its error is what switching is to remove. It is a run of its own in any case, so
// what is quiet in it is leapt over, by the same leaps whether a figure is asked for or not.
VariantResult one_mode(const RunTask& task, const twin::Motion& motion, std::int64_t ticks) {
    config::Config unswitched = rig::without_switching(task.config);
    if (unswitched.gyro.fidelity == config::Fidelity::averaged) unswitched.gyro.fidelity = config::Fidelity::events;
    rig::ClosedLoop loop{unswitched, motion};
    Variant variant{
        "one_mode", "the same gyro, never switched",
        rig::Replay{rig::compensation_config(unswitched, core::RelockMethod::none, unswitched.compensation.bridge)},
        ErrorMeter{unswitched.gyro.tick_s, curve_stride(task, ticks), RunDrift{unswitched}}};
    std::array<double, core::history_ticks> truth{};
    const std::deque<SwitchWindow> no_windows;
    const auto take = [&](const core::AngleRow& row) {
        variant.meter.take(row, {truth[static_cast<std::size_t>(row.tick) % truth.size()], 0.0}, no_windows);
    };
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        if (const auto leap = loop.leap(2 * (ticks - tick), ticks / curve_points)) {
            const double arcsec = variant.replay.leap(*leap, take);
            variant.meter.leap(leap->ticks(), arcsec - leap->dtheta_arcsec);
            tick += leap->ticks() - 1;
            continue;
        }
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
    rig::ClosedLoop loop{task.config, motion};
    Experiment experiment{task, ticks};
    // About two hundred reports, and one every 100 000 ticks at least.
    const std::int64_t progress_stride = std::clamp<std::int64_t>(ticks / 200, 1, 100'000);
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        if (const auto leap = loop.leap(2 * (ticks - tick))) {
            experiment.leap(*leap);
            tick += leap->ticks() - 1;
            continue;
        }
        const rig::LoopHalf first = advance(loop, task);
        experiment.first_half(first, loop.sensor(), loop.light());
        const rig::LoopHalf second = advance(loop, task);
        experiment.tick(tick, first, second, loop.sensor(), loop.light());
        if (task.on_progress && tick % progress_stride == 0)
            task.on_progress(static_cast<double>(tick) / static_cast<double>(ticks));
    }
    experiment.end();
    experiment.report(result);
}

}  // namespace

RunResult run(const RunTask& task) {
    const twin::Motion motion = task.motion ? *task.motion : recorded::motion(task.config);
    const std::int64_t ticks = rig::run_ticks(task.config, motion);
    RunResult result{.tick_s = task.config.gyro.tick_s, .ticks = ticks, .warnings = task.warnings};
    if (auto lived = lived_after_all(task.config, motion)) result.warnings.push_back(std::move(*lived));
    std::future<VariantResult> unswitched;
    if (is_wanted(task.variants, "one_mode"))
        unswitched = std::async(task.threads > 1 ? std::launch::async : std::launch::deferred,
                                [&] { return one_mode(task, motion, ticks); });
    switching_run(task, motion, ticks, result);
    if (auto late = late_switches(task.config, result.switches)) result.warnings.push_back(std::move(*late));
    if (unswitched.valid()) result.variants.insert(result.variants.begin(), unswitched.get());
    return result;
}

}  // namespace zlg::study
