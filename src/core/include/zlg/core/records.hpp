#pragma once
// The records that pass between the parts: plant to control, control to plant, control to compensation, and out.
//
// Plain data with the unit in every name. These records and `units.hpp` are all that the twin and the logs know of
// the core.

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace zlg::core {

inline constexpr int max_light_samples = 64;
inline constexpr int max_set_points = 16;

// Also true of two NaN.
[[nodiscard]] constexpr bool same_bits(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
[[nodiscard]] constexpr bool same_bits(float a, float b) noexcept {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// What the gyro's electronics latch at the end of half-period h.
struct SensorFrame {
    std::uint32_t sequence = 0;     // counts frames, wraps
    std::uint64_t timer_ticks = 0;  // stamp of the latch, free-running
    std::uint64_t counter = 0;      // fringe counter, free-running, wraps; absolute, never a difference
    std::int8_t bias_sign = 1;      // echo of the bias sign in force during h: +1 or -1
    std::int8_t polarity = 1;       // echo of the reference polarity in force during h: the helicity that is held
    bool loop_closed = true;        // echo of the loop state in force during h
    std::uint8_t n_light = 0;       // samples in light_a, and in light_b where present; 1..max_light_samples
    bool has_light_b = false;
    std::array<float, max_light_samples> light_a{};  // photodiode of beam A, any unit proportional to its light
    std::array<float, max_light_samples> light_b{};  // photodiode of beam B, same unit
    double piezo_v = 0.0;                            // high voltage at the piezo mirrors, by ADC
    double coil_current_a = 0.0;
    double temperature_c = 0.0;
    std::uint32_t status = 0;  // bits of SensorStatus
    // Both photodiodes of the beat, a quarter of a turn apart, sampled at the latch: any unit; a beat that counts up
    // turns from fringe_c to fringe_s. And the quarter of the turn in which the counter's comparators stood, 0..3.
    bool has_fringe = false;
    std::uint8_t fringe_quarter = 0;
    float fringe_c = 0.0f;
    float fringe_s = 0.0f;
};

enum SensorStatus : std::uint32_t {
    frame_missed = 1u << 0,  // nothing was received for this half: every other field is stale
};

// What the processor commands at the end of half-period h, in force from the start of h + 1.
struct ActuatorFrame {
    bool loop_closed = true;
    std::int8_t polarity = 1;                          // reference of the synchronous detector: the helicity to hold
    std::uint8_t n_set_points = 1;                     // 1..max_set_points, equally spaced over the half
    std::array<double, max_set_points> set_point_v{};  // second input of the high-voltage stage
    std::int32_t edge_offset_ticks = 0;                // shift of the bias reversal that ends h + 1, timer ticks

    friend bool operator==(const ActuatorFrame&, const ActuatorFrame&) = default;
};

// One row of the raw log: all that compensation knows of half-period `half`.
//
// A detuning or mean square that was not measured is 0 where control recorded the half. What a log has no column for is
// NaN.
struct HalfRecord {
    std::int64_t half = 0;
    std::int64_t counts = 0;           // counter difference over `span` halves, positive for positive rotation
    double detuning_lambda = 0.0;      // mean over the half
    double detuning_sq_lambda2 = 0.0;  // mean of the squared samples over the half
    double piezo_v = 0.0;
    double temperature_c = 0.0;
    std::int8_t bias_sign = 1;
    std::int8_t mode = 1;  // helicity commanded
    bool loop_closed = true;
    bool valid = true;  // light in both directions, frame received
    // Shift of the reversal that ends this half, ticks of the timer; positive is later.
    std::int32_t edge_offset_ticks = 0;
    // `counts` are those of so many halves, this one the last; those before have valid 0, counts 0, span 1.
    std::int32_t span = 1;
    // Place within the count at the end of the half, 0..65535, 1/65536: the angle there is (sum of counts +
    // fringe/65536) counts.
    float fringe = __builtin_nanf("");
    bool late = false;  // where a correction is due: its estimate was not ready, and the polynomial stands in
    bool lit = false;   // both beams were lit and steady throughout the half: its counts are good, in an open loop too

    // The same bits, so that a quantity that was not measured is equal to itself.
    friend constexpr bool operator==(const HalfRecord& a, const HalfRecord& b) noexcept {
        return a.half == b.half && a.counts == b.counts && same_bits(a.detuning_lambda, b.detuning_lambda) &&
               same_bits(a.detuning_sq_lambda2, b.detuning_sq_lambda2) && same_bits(a.piezo_v, b.piezo_v) &&
               same_bits(a.temperature_c, b.temperature_c) && a.bias_sign == b.bias_sign && a.mode == b.mode &&
               a.loop_closed == b.loop_closed && a.valid == b.valid && a.edge_offset_ticks == b.edge_offset_ticks &&
               a.span == b.span && same_bits(a.fringe, b.fringe) && a.lit == b.lit && a.late == b.late;
    }
};

inline constexpr std::int32_t count_parts = 65536;  // of which `fringe` tells the number

[[nodiscard]] constexpr bool has_fringe(const HalfRecord& half) noexcept {
    return half.fringe >= 0.0f && half.fringe < static_cast<float>(count_parts);
}

// The counts are the angle of this half, in a closed loop.
[[nodiscard]] constexpr bool is_measured(const HalfRecord& half) noexcept {
    return half.loop_closed && half.valid && half.span == 1;
}

// The same of the tick that both halves make.
[[nodiscard]] constexpr bool is_measured(const HalfRecord& first, const HalfRecord& second) noexcept {
    return is_measured(first) && is_measured(second);
}

// Light samples of one half-period as they were latched, beside its record; empty where there are none.
struct LightSamples {
    std::span<const float> a{};  // beam A, up to max_light_samples
    std::span<const float> b{};  // beam B, as many, or none
};

// Provenance of one tick of the angle log, a sum of bits. eq (n) here: of the paper, see docs/compensation.md.
enum AngleFlag : std::uint32_t {
    flag_switching = 1u << 0,     // in a gap, and the commanded helicity has changed since it began
    flag_extrapolated = 1u << 1,  // in a gap: dtheta comes from earlier ticks alone; 0 before the first measured tick
    flag_interpolated = 1u << 2,  // in a gap: dtheta_final comes from both sides
    flag_correction = 1u << 3,    // dtheta contains the correction of earlier ticks, eq (17)
    flag_relock_corrected = 1u << 4,    // false drift after re-lock was subtracted
    flag_relock_uncorrected = 1u << 5,  // it should have been, but the data did not allow it
    flag_lower_order = 1u << 6,         // too few measured ticks for the order asked for
    flag_unrepaired = 1u << 7,          // gap too long or without a measured tick: constant, sigma unknown
    flag_loop_unlocked = 1u << 8,       // perimeter control was open in a half of this tick
    flag_invalid = 1u << 9,             // the counts of a half of this tick cannot be trusted
    flag_mode_mixed = 1u << 10,         // the halves have different helicity, so the bias does not cancel
};

inline constexpr std::array<const char*, 11> angle_flag_names{
    "switching",   "extrapolated", "interpolated",  "correction", "relock_corrected", "relock_uncorrected",
    "lower_order", "unrepaired",   "loop_unlocked", "invalid",    "mode_mixed"};

// One row of the angle log.
struct AngleRow {
    std::int64_t tick = 0;
    double dtheta_arcsec = 0.0;        // as delivered in real time
    double dtheta_final_arcsec = 0.0;  // the best increment known afterwards
    double sigma_arcsec = 0.0;         // one standard deviation of dtheta_final; infinite where unknown
    double relock_arcsec = 0.0;        // false angle that was subtracted in dtheta_final; diagnostic, not logged
    std::int8_t mode = 1;
    std::uint32_t flags = 0;

    friend bool operator==(const AngleRow&, const AngleRow&) = default;
};

// How one gap was bridged.
struct GapReport {
    std::int64_t first_tick = 0;  // j = 1
    std::int64_t n_ticks = 0;
    std::int8_t sign_after = 1;  // bias_sign * mode in the first half after the gap: the sign of the false drift
    std::int8_t mode_after = 1;
    bool mode_changed = false;
    double dp_arcsec = 0.0;         // eq (16): extrapolated minus final, over the gap
    double sigma_sum_arcsec = 0.0;  // one standard deviation of the gap's final angle

    friend bool operator==(const GapReport&, const GapReport&) = default;
};

// What compensation delivers at the end of every tick.
struct AngleSample {
    std::int64_t tick = 0;
    double dtheta_arcsec = 0.0;  // causal increment of this tick
    std::uint32_t flags = 0;     // as far as known at delivery
    bool has_final = false;
    AngleRow final_row{};  // of the tick `final_delay_ticks` ago
    bool has_gap = false;
    GapReport gap{};  // of a gap that was resolved in this tick
};

// What compensation knows of switches and drift; 0: not known.
struct SwitchAdvice {
    double switch_error_arcsec = 0.0;  // rms of the angle that a switch leaves
    double magnetic_arcsec_s = 0.0;    // drift that changes its sign with the mode and is still in the angle

    friend constexpr bool operator==(const SwitchAdvice&, const SwitchAdvice&) = default;
};

}  // namespace zlg::core
