#pragma once
// One configured gyro in its closed loop, with the compensation that its configuration asks for beside it.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/fingerprint.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::lab {

// The defaults, over them each `section.key=value` as the program's --set reads it, the later over the earlier.
//
// errors  config::ConfigError, with the program's own message.
[[nodiscard]] config::Config asked(std::span<const std::string> settings);

// The same, and what [laser] says of the constants that the processor presumes.
[[nodiscard]] config::Config configured(std::span<const std::string> settings);

using HandTurns = std::vector<twin::RateStep>;

class LoopRun {
public:
    // hand    turns that are added to the motion of the configuration, while the gyro runs; null: none.
    // errors  config::ConfigError where the configuration makes no gyro; here a motion file makes none, and the best
    //         interval is not sought.
    explicit LoopRun(const config::Config& config, std::shared_ptr<const HandTurns> hand = nullptr);

    // One half-period of bias; `on_row` is called with the core::AngleRow that is settled by it, where there is one.
    //
    // errors  config::ConfigError where the rate is beyond any counter.
    template <class OnRow> rig::LoopHalf advance(const OnRow& on_row) {
        const rig::LoopHalf half = loop_.advance();
        fingerprint_.take(half, loop_.sensor());
        replay_.take(half.record, loop_.light(), [&](const core::AngleRow& row) {
            fingerprint_.take(row);
            on_row(row);
        });
        return half;
    }

    // That of a run which ends here, with the rows that are still open.
    [[nodiscard]] std::string fingerprint() const {
        rig::Fingerprint at_end = fingerprint_;
        rig::Replay rest = replay_;
        rest.end([&](const core::AngleRow& row) { at_end.take(row); });
        return at_end.text();
    }

    // Of the half before, until the next `advance`.
    [[nodiscard]] core::LightSamples light() const { return loop_.light(); }
    [[nodiscard]] const rig::Replay& replay() const { return replay_; }
    [[nodiscard]] const core::GyroControlState& control() const { return loop_.control(); }

    [[nodiscard]] std::int64_t halves() const { return replay_.halves(); }
    [[nodiscard]] std::int64_t run_halves() const { return run_halves_; }  // of run.duration_s
    [[nodiscard]] double time_s() const { return 0.5 * tick_s_ * static_cast<double>(replay_.halves()); }

private:
    double tick_s_;
    std::int64_t run_halves_;
    rig::ClosedLoop loop_;
    rig::Replay replay_;
    rig::Fingerprint fingerprint_;
};

}  // namespace zlg::lab
