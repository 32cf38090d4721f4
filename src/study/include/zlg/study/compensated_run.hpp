#pragma once
// A run of the configured gyro with its configured compensation, of which only the errors are kept.

#include <array>
#include <cstdint>
#include <functional>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/switch_window.hpp>
#include <zlg/study/variant.hpp>

namespace zlg::study {

// The configured compensation beside a loop, and its errors. Several may follow one loop.
class MeteredCompensation {
public:
    // Both optional: what else is done with a final row and what is true of its tick, and with a gap.
    std::function<void(const core::AngleRow&, const TickTruth&)> on_row;
    std::function<void(const core::GapReport&)> on_gap;

    // stride  ticks between two points of the curve of the error.
    //
    // errors  config::ConfigError.
    MeteredCompensation(const config::Config& config, std::int64_t stride);

    // The next half of the loop and the light samples of it.
    void take(const rig::LoopHalf& half, core::LightSamples light);

    // A leap of the loop, between two ticks.
    void leap(const rig::Leap& leap);

    // So many ticks of a loop, lived and leapt over.
    void follow(rig::ClosedLoop& loop, std::int64_t ticks);

    // As delivered up to the last whole tick.
    [[nodiscard]] double angle_arcsec() const { return replay_.angle_arcsec(); }

    // There are no more halves.
    [[nodiscard]] const ErrorMeter& end();

private:
    void take(const core::AngleRow& row);
    void take(const core::GapReport& gap) const;

    config::Config config_;
    rig::Replay replay_;
    SwitchFinder finder_;
    ErrorMeter meter_;
    std::array<TickTruth, core::history_ticks> truth_{};
    core::HalfRecord first_{};  // of the present tick, and its true rotation
    double first_arcsec_ = 0.0;
    std::int64_t tick_ = 0;
    bool is_second_ = false;
};

// stride  as above.
//
// errors  config::ConfigError; those of a motion file.
[[nodiscard]] ErrorMeter compensated_run(const config::Config& config, std::int64_t ticks, std::int64_t stride);

}  // namespace zlg::study
