#pragma once
// What calibration keeps of one raw log: sums over settled ticks, the halves after every re-lock, and the voltages at
// which the perimeter rested.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <zlg/calibration/angle_scatter.hpp>
#include <zlg/core/compensation/border.hpp>
#include <zlg/core/records.hpp>

namespace zlg::calibration {

inline constexpr std::int64_t settled_after_ticks = 40;  // of a re-lock: counts are at rest, to 1e-4 of the bias
inline constexpr std::int64_t block_ticks = 50;
inline constexpr std::int64_t window_ticks = 20;  // of the voltage at either end of a segment
inline constexpr std::size_t relock_halves = 80;  // kept after a gap

// Up to `block_ticks` settled ticks in a row.
struct Block {
    std::int64_t segment = 0;
    std::int64_t first_tick = 0;
    std::int64_t n_ticks = 0;
    std::int8_t mode = 1;
    std::int8_t first_sign = 1;   // bias_sign mode in the first half of each tick
    std::int64_t counts = 0;      // sum over the ticks, both halves
    std::int64_t difference = 0;  // sum of bias_sign mode counts over the halves: what the bias contributed
    double temperature_sum_c = 0.0;
    double first_temperature_c = 0.0;
    double last_temperature_c = 0.0;
};

// Mean voltage over a window.
struct PiezoLevel {
    double voltage_v = 0.0;
    double temperature_c = 0.0;
    double middle_ticks = 0.0;
    std::int64_t n = 0;  // readings
};

// A run of ticks with the loop closed and the counts good, in one mode.
struct Segment {
    std::int8_t mode = 1;
    bool after_gap = false;
    std::int64_t first_tick = 0;
    std::int64_t n_ticks = 0;
    std::int64_t n_settled = 0;
    PiezoLevel at_start;  // first window at rest; no readings where the segment ends before it
    PiezoLevel at_end;    // last settled window before the readings by which a switch was directed
};

// Drift of the voltage from the first window to the last; 0 where they overlap.
[[nodiscard]] double slope_v_per_tick(const Segment& segment);

// The first halves of a segment that follows a gap.
struct Relock {
    std::int64_t segment = 0;
    std::vector<core::HalfRecord> halves;
    core::Border before = {};  // at the start of the first of them
};

// All halves to be kept are there, with a number in this column.
[[nodiscard]] bool is_whole(const Relock& relock, double core::HalfRecord::*column);

// Mean and scatter of a quantity that is not measured everywhere.
struct Moments {
    std::int64_t n = 0;
    double mean = 0.0;
    double sum_sq = 0.0;  // of the deviations from the mean

    void add(double x) {
        ++n;
        const double before = x - mean;
        mean += before / static_cast<double>(n);
        sum_sq += before * (x - mean);
    }
    void add(const Moments& other);
    [[nodiscard]] double variance() const { return n > 1 ? sum_sq / static_cast<double>(n - 1) : 0.0; }
};

struct LabLog {
    std::string name;
    double tick_s = 0.005;
    std::int64_t n_ticks = 0;
    std::vector<Segment> segments;
    std::vector<Block> blocks;
    std::vector<Relock> relocks;
    AngleScatter scatter;                                              // of settled ticks
    Moments square;                                                    // detuning_sq_lambda2 of settled halves
    double rest_after_ticks = settled_after_ticks;                     // of a re-lock: what the voltage needs
    double piezo_variance_v2 = 0.0;                                    // of one reading in a settled window
    double piezo_quantum_v = std::numeric_limits<double>::infinity();  // least step between readings
    double temperature_min_c = std::numeric_limits<double>::infinity();
    double temperature_max_c = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool has_temperature() const { return temperature_min_c <= temperature_max_c; }
    [[nodiscard]] bool has_piezo() const { return piezo_quantum_v != std::numeric_limits<double>::infinity(); }
    [[nodiscard]] bool has_square() const { return square.n > 0; }
};

}  // namespace zlg::calibration
