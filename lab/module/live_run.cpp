// A gyro that is watched while it runs.
#include "live_run.hpp"

#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <zlg/rig/wiring.hpp>
#include <zlg/study/reading_error.hpp>

#include "compared.hpp"

namespace zlg::lab {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double mean(std::span<const float> samples) {
    if (samples.empty()) return unknown;
    return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

rig::Replay replay_of(const config::Config& config, core::RelockMethod relock, core::BridgeMethod bridge) {
    return rig::Replay{rig::compensation_config(with_points_of_paper(config), relock, bridge)};
}

}  // namespace

LiveRun::LiveRun(const config::Config& config, std::shared_ptr<const HandTurns> hand)
    : config_{config},
      run_{config, std::move(hand)},
      configured_{config},
      compared_{
          Compared{replay_of(config, core::RelockMethod::none, core::BridgeMethod::none), ErrorTrack{config}},
          Compared{replay_of(config, core::RelockMethod::detuning, core::BridgeMethod::quadratic), ErrorTrack{config}}},
      switches_{config.compensation.relock_ticks} {}

void LiveRun::advance() {
    const bool ends_tick = first_.has_value();
    std::vector<core::AngleRow> rows;
    const rig::LoopHalf half = run_.advance([&rows](const core::AngleRow& row) { rows.push_back(row); });
    see(half);
    if (ends_tick) end_tick(*first_, half);
    for (Compared& each : compared_) {
        std::vector<core::AngleRow> theirs;
        each.replay.take(half.record, run_.light(), [&theirs](const core::AngleRow& row) { theirs.push_back(row); });
        if (ends_tick) each.track.end_tick(half.record.half / 2, each.replay);
        take_rows(each.track, theirs);
    }
    if (ends_tick) configured_.end_tick(half.record.half / 2, run_.replay());
    take_rows(configured_, rows);
    for (const core::AngleRow& row : rows) final_.push_back(row);
    if (ends_tick)
        first_.reset();
    else
        first_ = half;
    add_angles();
    add_switches();
}

void LiveRun::see(const rig::LoopHalf& half) {
    const core::LightSamples light = run_.light();
    const core::GyroControlState& control = run_.control();
    const double half_s = 0.5 * config_.gyro.tick_s;
    const double to_switch_s = static_cast<double>(2 * control.schedule.next_tick - control.half) * half_s;
    now_ = {half.truth.dtheta_arcsec / half_s,
            static_cast<double>(half.record.counts),
            half.record.detuning_lambda,
            half.record.piezo_v,
            mean(light.a),
            mean(light.b),
            static_cast<double>(half.record.mode),
            static_cast<double>(half.record.bias_sign),
            half.record.loop_closed ? 1.0 : 0.0,
            static_cast<double>(control.mode_switch.phase),
            to_switch_s,
            static_cast<double>(half.control.health)};
}

void LiveRun::end_tick(const rig::LoopHalf& first, const rig::LoopHalf& second) {
    const std::int64_t tick = second.record.half / 2;
    const auto counts = static_cast<double>(first.record.counts + second.record.counts);
    waiting(tick) = {first.truth.dtheta_arcsec + second.truth.dtheta_arcsec, config_.gyro.scale_arcsec * counts,
                     study::reading_error_arcsec(config_, second)};
    switches_.take(tick, first.record, second.record);
    add_signals(first, second);
}

void LiveRun::add_signals(const rig::LoopHalf& first, const rig::LoopHalf& second) {
    const double tick_s = config_.gyro.tick_s;
    const std::int64_t tick = second.record.half / 2;
    const WaitingTick& seen = waiting(tick);
    const core::LightSamples light = run_.light();
    const std::array<double, 10> row{static_cast<double>(tick + 1) * tick_s,
                                     seen.true_arcsec / tick_s,
                                     seen.read_arcsec / tick_s,
                                     second.record.detuning_lambda,
                                     second.record.piezo_v,
                                     mean(light.a),
                                     mean(light.b),
                                     static_cast<double>(second.record.mode),
                                     first.record.loop_closed && second.record.loop_closed ? 1.0 : 0.0,
                                     static_cast<double>(first.control.health | second.control.health)};
    std::vector<double>& rows = rows_[static_cast<std::size_t>(View::signals)];
    rows.insert(rows.end(), row.begin(), row.end());
}

void LiveRun::take_rows(ErrorTrack& track, const std::vector<core::AngleRow>& rows) {
    for (const core::AngleRow& row : rows) {
        const WaitingTick& seen = waiting(row.tick);
        track.take(row, seen.true_arcsec, seen.rounding_arcsec, switches_.windows());
    }
}

void LiveRun::add_angles() {
    Queue<double>& read = compared_[0].track.waiting_arcsec();
    Queue<double>& paper = compared_[1].track.waiting_arcsec();
    Queue<double>& configured = configured_.waiting_arcsec();
    std::vector<double>& rows = rows_[static_cast<std::size_t>(View::angles)];
    while (!read.empty() && !paper.empty() && !configured.empty()) {
        const core::AngleRow row = final_.take_front();
        const WaitingTick& seen = waiting(row.tick);
        const std::array<double, 8> numbers{
            static_cast<double>(row.tick), seen.true_arcsec,  seen.read_arcsec,   row.dtheta_arcsec,
            row.dtheta_final_arcsec,       read.take_front(), paper.take_front(), configured.take_front()};
        rows.insert(rows.end(), numbers.begin(), numbers.end());
    }
}

void LiveRun::add_switches() {
    std::vector<double>& rows = rows_[static_cast<std::size_t>(View::switches)];
    double which = 0.0;
    for (ErrorTrack* track : {&compared_[0].track, &compared_[1].track, &configured_}) {
        while (const study::SwitchError* error = track->next_switch()) {
            const study::SwitchWindow& window = error->window;
            const std::array<double, 6> row{which,
                                            static_cast<double>(window.first_tick),
                                            static_cast<double>(window.n_ticks),
                                            static_cast<double>(window.last_tick),
                                            static_cast<double>(window.mode_after),
                                            error->error_arcsec};
            rows.insert(rows.end(), row.begin(), row.end());
        }
        which += 1.0;
    }
}

void LiveRun::forget() {
    for (std::vector<double>& rows : rows_) rows.clear();
}

}  // namespace zlg::lab
