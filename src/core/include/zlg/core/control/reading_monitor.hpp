#pragma once
// The counter's readings: over how many halves a difference goes, and which reading is that of the gyro.
//
// The counter runs freely and its readings are absolute. A reading that was missed, or that is wrong, does not affect
// the next one: the difference of two good readings is the rotation between them, with the bias of the halves
// between.
//
//   T = R_h - R_0,  m halves        R_0: the last good reading
//   P = m r + s b (m odd)           what the gyro would have turned at the rate r of the last good half
//
// A half whose counts are out of the bias's band may hold a rotation or a wrong reading. The next readings decide:
//
//   returned  |T - P| is small again: the reading between was wrong, this one is good
//   proven    the readings stay apart, and four in a row agree with each other: it was a rotation
//
// Either way T is what the counter has turned: nothing is lost, and an error of the readings that stays for a while, as
// of a stuck bit, is in the angle for that while and leaves it with the step back. But a step of more counts than the
// gyro can make is none of its rotation; and one in which the counter may have lost counts, at the end of its range, is
// held for so long, over switches too, that no gap keeps a finite sigma.

#include <cstdint>

namespace zlg::core {

struct ReadingMonitorState {
    std::uint64_t good = 0;       // R_0
    std::int32_t n_since = 0;     // halves since it
    std::int8_t mode = 1;         // helicity at it
    bool countable = true;        // in all of these halves the counter counted the rotation and the bias
    bool suspected = false;       // one of them had a reading that may be wrong
    bool over_range = false;      // in one of them the counter may have lost counts
    std::uint64_t last = 0;       // the last reading at all
    bool has_last = true;         // of the half before
    std::int32_t n_agreeing = 0;  // readings in a row, each in step with the one before
    std::int32_t n_watched = 0;   // readings since the suspicion
    std::int32_t n_lost = 0;      // halves in a row with less than half of the bias
    bool impossible = false;      // the first step was more than a gyro can turn in a half
    bool rate_known = false;
    double rate_counts = 0.0;    // r, of a half
    double change_counts = 0.0;  // size of its last change

    friend constexpr bool operator==(const ReadingMonitorState&, const ReadingMonitorState&) = default;
};

struct ReadingMonitorInput {
    bool read = false;        // the reading is that of the end of this half
    bool follows = true;      // no half was lost between: where not, nothing before counts
    bool countable = false;   // the loop was closed; where a frame came, with light and the right coil current
    std::int8_t mode = 1;     // helicity
    bool suspicious = false;  // counts out of the bias's band, or beyond any rate
    bool agrees = false;      // in step with the reading before, whatever that is worth
    bool bias_lost = false;   // less than half of the bias, or that of the other helicity
    std::uint64_t reading = 0;
    double max_counts = 0.0;    // that the counter can make in a half
    double bias_counts = 0.0;   // b
    std::int8_t beat_sign = 1;  // s
};

struct ReadingMonitorOutput {
    bool trusted = false;     // the counts below are those of the gyro
    std::int32_t span = 1;    // halves
    std::int64_t counts = 0;  // over them
    bool continues = false;   // nothing was given up: they go on from the last good reading
};

// Advance by one half-period.
//
// latency  of a wrong reading that comes back: until two readings in step have come; of a rotation four halves from its
//          end; where the readings never agree so long, or of what is held, the first half in step after 36.
// limit    counts below 2^63: a rate of 1e9 counts/s takes 292 years.
[[nodiscard]] ReadingMonitorOutput step(ReadingMonitorState& state, const ReadingMonitorInput& input) noexcept;

// The half of that output, which continues, turned out not to be valid: the next good one gets its counts.
void leave_to_next(ReadingMonitorState& state, const ReadingMonitorOutput& output) noexcept;

}  // namespace zlg::core
