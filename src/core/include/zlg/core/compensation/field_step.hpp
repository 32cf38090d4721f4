#pragma once
// Steps of the magnetic drift: an outer field that came, changed or went, distinguished from a
// rotation by the next switch.
//
// In mode m = +1 or -1 a gyro reads b + m Om, b the rotation and Om the magnetic drift. A step of the rate in a segment, from r0
// to r1, is one of the rotation, or of the drift by d = m (r1 - r0). At the switch that ends the segment the mode turns its
// sign, and the rate goes from r1 to r2. With the drift Om before the step
//
//   nu = m (r1 - r2)/2 - Om           0 after a rotation, d after a field                                     (1)
//
// Where nu is not 0 and agrees with d, the drift has stepped: its angle since then, the sum of (rate - r0) T over the rest of
// the segment, was no rotation, and m d T of each tick to come is none. What r1 - r0 and (1) say of d counts by its variance.
//
// A field that came and went between two switches leaves (1) at 0, as a rotation does: nothing in the data distinguishes them.
// docs/faults.md says how often that is.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>

namespace zlg::core {

inline constexpr int field_blocks = 96;

struct SegmentBlock {
    std::int64_t n_ticks = 0;
    double arcsec = 0.0;

    friend constexpr bool operator==(const SegmentBlock&, const SegmentBlock&) = default;
};

// The present segment as sums over blocks, the last ones of a tenth of a second and the earlier ones longer, the longer the
// earlier: the place of a step is known to a part of the time since then, however long the segment is.
struct SegmentBlocks {
    int n = 0;
    std::array<SegmentBlock, field_blocks> block{};
    SegmentBlock growing{};

    friend constexpr bool operator==(const SegmentBlocks&, const SegmentBlocks&) = default;
};

// Add a tick; returns whether a block has ended.
bool accumulate(const CompensationConstants& gyro, SegmentBlocks& blocks, double angle_arcsec) noexcept;

// What a finished segment says.
struct SegmentStep {
    double length_s = 0.0;
    bool known = false;          // its last rate
    bool stepped = false;        // there was one step, significant and lasting up to the end
    double rate_arcsec_s = 0.0;  // after the step, and its variance
    double rate_variance = 0.0;
    double step_arcsec_s = 0.0;  // r1 - r0, and the variance of r0
    double before_variance = 0.0;
    double excess_arcsec = 0.0;  // angle beyond r0 since the step
    double excess_variance = 0.0;
    // Motion about these rates beyond the noise: (arcsec/s)^2 if it is slow, arcsec^2 at either end of a stretch if it is fast.
    double slow_motion = 0.0;
    double fast_motion = 0.0;

    friend constexpr bool operator==(const SegmentStep&, const SegmentStep&) = default;
};

// The rates on both sides of one step at an unknown place, by least squares; the block in which it falls counts for neither.
//
// sway_arcsec_s  rms of the motion of the base from one stretch to another, beyond what noise explains.
[[nodiscard]] SegmentStep step_of(const CompensationConstants& gyro, const SegmentBlocks& blocks, bool with_phase,
                                  double sway_arcsec_s) noexcept;

struct FieldStepState {
    std::int8_t mode = 0;  // of the present segment; 0: none yet
    SegmentBlocks blocks{};
    bool paused = false;          // a gap has begun; it ends the segment where the mode is another one after it
    SegmentStep finished{};       // the segment up to that gap
    SegmentStep before{};         // the segment before this one
    bool waits = false;           // until it is decided whether a field began there
    std::int64_t n_ticks = 0;     // of this segment
    double drift_arcsec_s = 0.0;  // Om by the switches, and its variance; 0: not started
    double drift_variance = 0.0;
    bool is_open = false;          // the last switch was neither of the field nor of a rotation
    double unseen_arcsec_s = 0.0;  // the part of it that came where no step was seen, at a moment unknown
    double field_arcsec_s = 0.0;   // the part of it that came in steps, and is subtracted
    double change_variance = 0.0;  // of that part, by this tick's measurement
    double waiting_arcsec = 0.0;   // angle that is still to be subtracted, over some seconds
    double waiting_arcsec2 = 0.0;  // variance that is still to be added to ticks, over some seconds

    friend constexpr bool operator==(const FieldStepState&, const FieldStepState&) = default;
};

// What is presumed of Om, and what is known of the base.
struct FieldStepPrior {
    double drift_arcsec_s = 0.0;
    double drift_variance = 100.0;
    double sway_arcsec_s = 0.5;  // as in `step_of`
};

struct FieldStepTick {
    std::int8_t mode = 1;
    double angle_arcsec = 0.0;  // as read, re-lock corrected
    bool settled = true;        // no re-lock is corrected in it: rates are made of such ticks
    bool with_phase = false;
};

struct FieldStepOutput {
    double subtract_arcsec = 0.0;   // from this tick
    double variance_arcsec2 = 0.0;  // more of this tick
};

// A gap begins.
//
// return  the segment has a step in it.
// cost    some 3000 instructions.
bool pause(const CompensationConstants& gyro, const FieldStepPrior& prior, FieldStepState& state,
           bool with_phase) noexcept;

// Advance by one measured tick.
//
// Whether a field began in the last segment is decided by (1), from one second after the re-lock on. Where it is not decided
// in four seconds, the angle since the step may be rotation or not, and its square is added to the variance of the
// ticks that follow; so is what a field that is subtracted may have been wrong by in that segment, and the variance of an angle that
// is subtracted. All come with a time constant of 256 ticks.
//
// Without a step (1) is a better mean of the drift. Where one switch left it open and the next one has the same (1), the field
// follows, if there is one.
//
// cost  25 instructions a tick; some 300 where a block ends.
[[nodiscard]] FieldStepOutput step(const CompensationConstants& gyro, const FieldStepPrior& prior,
                                   FieldStepState& state, const FieldStepTick& tick) noexcept;

}  // namespace zlg::core
