#pragma once
// One compensation of a gyro that runs, held against the truth: its error of the angle tick by tick, and of its
// switches.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>

#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/variant.hpp>

#include "queue.hpp"

namespace zlg::lab {

class ErrorTrack {
public:
    explicit ErrorTrack(const config::Config& config) : meter_{config.gyro.tick_s, no_curve, study::RunDrift{config}} {}

    // Once a tick, after its records: what the compensation has taken of the magnetic drift until then.
    void end_tick(std::int64_t tick, const rig::Replay& replay) {
        const double sum_arcsec = replay.state().magnetic.subtracted_arcsec;
        taken_out_arcsec_[place(tick)] = sum_arcsec - taken_out_sum_arcsec_;
        taken_out_sum_arcsec_ = sum_arcsec;
    }

    // A final row, and what is true of its tick.
    void take(const core::AngleRow& row, double true_arcsec, double rounding_arcsec,
              const std::deque<study::SwitchWindow>& switches) {
        meter_.take(row, {true_arcsec, taken_out_arcsec_[place(row.tick)], rounding_arcsec}, switches);
        waiting_arcsec_.push_back(meter_.angle_error_arcsec());
    }

    // The error of the angle after each tick, until it is taken from the front.
    [[nodiscard]] Queue<double>& waiting_arcsec() { return waiting_arcsec_; }

    // The next switch whose error is known since this was asked last; null where there is none.
    [[nodiscard]] const study::SwitchError* next_switch() {
        if (n_reported_ < meter_.switches().size()) return &meter_.switches()[n_reported_++];
        meter_.forget_switches();
        n_reported_ = 0;
        return nullptr;
    }

private:
    static constexpr std::int64_t no_curve = std::numeric_limits<std::int64_t>::max();

    static std::size_t place(std::int64_t tick) { return static_cast<std::size_t>(tick) % core::history_ticks; }

    study::ErrorMeter meter_;
    std::array<double, core::history_ticks> taken_out_arcsec_{};
    double taken_out_sum_arcsec_ = 0.0;
    Queue<double> waiting_arcsec_;
    std::size_t n_reported_ = 0;
};

}  // namespace zlg::lab
