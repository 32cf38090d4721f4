#pragma once
// Records through the compensation, and what comes out: live, from a log, from a gyro outside.

#include <cstdint>
#include <string>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/bias_check.hpp>
#include <zlg/rig/leap.hpp>
#include <zlg/rig/place_check.hpp>

namespace zlg::rig {

// Takes any argument and does nothing.
inline constexpr auto ignored = [](const auto&) {};

// The final row and the gap that a sample holds, each where there is one.
template <class OnRow, class OnGap = decltype(ignored)>
void hand_over(const core::AngleSample& sample, const OnRow& on_row, const OnGap& on_gap = ignored) {
    if (sample.has_final) on_row(sample.final_row);
    if (sample.has_gap) on_gap(sample.gap);
}

// What is still open at the end of the records.
//
// drain  gives one more core::DrainOutput at each call, until there is neither row nor gap in it.
template <class Drain, class OnRow, class OnGap = decltype(ignored)>
void hand_over_rest(const Drain& drain, const OnRow& on_row, const OnGap& on_gap = ignored) {
    for (core::DrainOutput out = drain(); out.has_row || out.has_gap; out = drain()) {
        if (out.has_row) on_row(out.row);
        if (out.has_gap) on_gap(out.gap);
    }
}

// One compensation and its state. Every tick of two halves gives one final row, in the order of the ticks: some ticks
// later, or at `end`.
class Replay {
public:
    // config  passed `check`.
    explicit Replay(const core::GyroCompensationConfig& config) : config_{config}, bias_{config.gyro} {}

    // The next half.
    //
    // on_row, on_gap  called with the core::AngleRow and the core::GapReport that are settled by it.
    // return          all that the compensation says of it, the same row and gap among it.
    template <class OnRow = decltype(ignored), class OnGap = decltype(ignored)>
    core::CompensationOutput take(const core::HalfRecord& half, core::LightSamples light = {},
                                  const OnRow& on_row = ignored, const OnGap& on_gap = ignored) {
        const core::CompensationOutput out = core::step(config_, state_, half, light);
        places_.take(half);
        bias_.take(half);
        if (!half.loop_closed) ++n_open_;
        ++halves_;
        if (!out.has_sample) return out;
        angle_arcsec_ = out.angle_arcsec;
        hand_over(out.sample, on_row, on_gap);
        return out;
    }

    // Halves are leapt over, at the border of two ticks, with no gap open: the rows until then.
    //
    // return  the angle of the leap.
    template <class OnRow = decltype(ignored)> double leap(const Leap& leap, const OnRow& on_row = ignored) {
        end(on_row);
        halves_ += leap.halves;
        const double arcsec = rig::leap(config_, state_, leap);
        angle_arcsec_ = state_.angle.value_arcsec(config_.gyro.scale.value());
        return arcsec;
    }

    // There are no more halves: the rows and gaps that are still open.
    template <class OnRow, class OnGap = decltype(ignored)>
    void end(const OnRow& on_row, const OnGap& on_gap = ignored) {
        hand_over_rest([this] { return core::drain(config_, state_); }, on_row, on_gap);
    }

    // One line on a last half whose other half is missing; empty where every half has one.
    [[nodiscard]] std::string odd_half(const std::string& log_name) const;

    // One line where the loop was opened and no false drift after it is subtracted; empty otherwise.
    [[nodiscard]] std::string uncorrected(const std::string& log_name) const;

    // One line for each kind of columns that contradict the counts, or each other: mode and bias_sign, fringe,
    // loop_closed.
    [[nodiscard]] std::vector<std::string> contradictions(const std::string& log_name) const;

    [[nodiscard]] double angle_arcsec() const { return angle_arcsec_; }  // accumulated, up to the last whole tick
    [[nodiscard]] std::int64_t halves() const { return halves_; }
    [[nodiscard]] const core::GyroCompensationConfig& config() const { return config_; }
    [[nodiscard]] const core::GyroCompensationState& state() const { return state_; }

private:
    core::GyroCompensationConfig config_;
    core::GyroCompensationState state_{};
    PlaceCheck places_{};
    BiasCheck bias_;
    double angle_arcsec_ = 0.0;
    std::int64_t halves_ = 0;
    std::int64_t n_open_ = 0;  // halves
};

}  // namespace zlg::rig
