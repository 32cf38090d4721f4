#pragma once
// A gyro that is watched while it runs: its signals, and several compensations of the same counts against the truth, as
// rows of numbers for a page.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/switch_window.hpp>

#include "error_track.hpp"
#include "loop_run.hpp"
#include "queue.hpp"

namespace zlg::lab {

// The page's views of the gyro. Each holds rows, one number a column, until `forget`.
enum class View { signals, angles, switches };

class LiveRun {
public:
    // hand  turns that are added to the motion, in the order of their times, later ones while the gyro runs.
    //
    // errors  as LoopRun.
    LiveRun(const config::Config& config, std::shared_ptr<const HandTurns> hand);

    // One half-period of bias, and the rows that are settled by it.
    //
    // errors  as LoopRun.
    void advance();

    //   signals   a row a tick: time at its end, s; true and measured rate, arcsec/s; detuning, lambda; piezo voltage,
    //             V; light of beam A and B; mode; 1 where the loop is closed; bits of health
    //   angles    a row a tick, some ticks later: tick; its true, read, delivered and final increment, arcsec; error of
    //             the angle, arcsec: as read, by the paper, as configured
    //   switches  a row for each switch and compensation (0 as read, 1 by the paper, 2 as configured): compensation;
    //             first tick; ticks of the gap; last tick; mode after; error, arcsec
    [[nodiscard]] const std::vector<double>& rows(View view) const { return rows_[static_cast<std::size_t>(view)]; }
    void forget();

    // The half before: rate of the case, arcsec/s; counts; detuning, lambda; piezo voltage, V; light of beam A and B;
    // mode; sign of the bias; 1 where the loop is closed; phase of the switch; seconds to the next switch by plan; bits
    // of health.
    [[nodiscard]] const std::array<double, 12>& now() const { return now_; }

    [[nodiscard]] std::string fingerprint() const { return run_.fingerprint(); }
    [[nodiscard]] const LoopRun& run() const { return run_; }

private:
    struct Compared {
        rig::Replay replay;
        ErrorTrack track;
    };
    struct WaitingTick {
        double true_arcsec = 0.0;
        double read_arcsec = 0.0;
        double rounding_arcsec = 0.0;
    };

    void see(const rig::LoopHalf& half);
    void end_tick(const rig::LoopHalf& first, const rig::LoopHalf& second);
    void add_signals(const rig::LoopHalf& first, const rig::LoopHalf& second);
    void take_rows(ErrorTrack& track, const std::vector<core::AngleRow>& rows);
    void add_angles();
    void add_switches();
    [[nodiscard]] WaitingTick& waiting(std::int64_t tick) {
        return waiting_[static_cast<std::size_t>(tick) % waiting_.size()];
    }

    config::Config config_;
    LoopRun run_;
    ErrorTrack configured_;
    std::array<Compared, 2> compared_;  // as read, by the paper
    study::SwitchFinder switches_;
    std::optional<rig::LoopHalf> first_;  // of the tick that has begun
    std::array<WaitingTick, core::history_ticks> waiting_{};
    Queue<core::AngleRow> final_;  // of the configured compensation, whose errors are not all known
    std::array<std::vector<double>, 3> rows_;
    std::array<double, 12> now_{};
};

}  // namespace zlg::lab
