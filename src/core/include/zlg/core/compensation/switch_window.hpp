#pragma once
// What the estimate of a switch is given: the halves around its gap, and what is known of the gyro and of its motion.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>

#include <zlg/core/compensation/light_spline.hpp>
#include <zlg/core/compensation/walk_kernel.hpp>

namespace zlg::core {

inline constexpr int most_window_halves = 136;  // 8 ticks, a gap of 40, and 20 after it
// Rows with a reading, on either side: 8 ticks by halves, and 12 as wholes.
inline constexpr int most_points_before = 16;
inline constexpr int most_points_after = 28;
inline constexpr int most_window_points = most_points_before + most_points_after;
inline constexpr int most_rows_without = 16;
inline constexpr int most_window_rows = most_window_points + most_rows_without;

// A stretch of the window whose angle was read, or is wanted, as one number. The rows follow one another without a
// hole.
struct WindowRow {
    Stretch halves{};
    bool read = false;             // its angle was read: a point
    bool wanted = false;           // its angle is part of what is asked for
    bool after_gap = false;        // on that side of it
    double y_arcsec = 0.0;         // as read, without the bias
    double recorded_arcsec = 0.0;  // false angle by the record of the light, as d_r, where it is not that of `light`
    // Standard deviation of an error that all rows with one have in common, with its sign: of a light that is read far
    // from the centre.
    double common_arcsec = 0.0;
    double error_arcsec2 = 0.0;  // variance of what else it may hold, which stays in the angle if it is wanted

    friend bool operator==(const WindowRow&, const WindowRow&) = default;
};

struct SwitchWindow {
    int n_halves = 0;
    Stretch gap{};
    int n_rows = 0;
    std::array<WindowRow, most_window_rows> row{};
    std::array<std::int8_t, most_window_halves> bias_sign{};  // of each half, mode included
    bool with_phase = false;                                  // readings by phase, not of whole counts
    // Variance of the magnetic drift in a tick, as far as it is not known and steps at the gap.
    double magnetic_variance_arcsec2 = 0.0;
    // Variance of what was taken off a half as the bias, beyond what the bias errs by itself: a mean of readings that
    // repeat.
    double bias_variance_arcsec2 = 0.0;
    // Halves from `light_start` on whose false angle is corrected; none where `light` is empty.
    int light_start = 0;
    LightSums light{};

    friend bool operator==(const SwitchWindow&, const SwitchWindow&) = default;
};

[[nodiscard]] constexpr const WindowRow& row_of(const SwitchWindow& window, int r) noexcept {
    return window.row[static_cast<unsigned>(r)];
}

[[nodiscard]] constexpr double width(const WindowRow& row) noexcept { return row.halves.last - row.halves.first; }

// Windows of so many steps: that of a gap of 16 ticks, by halves. Those of longer gaps are learnt by ticks.
inline constexpr int most_moment_steps = 88;

// Second moments of the motion over windows of steps, alike in both directions of time: C_ij = C_ji = C_(L-1-j)(L-1-i).
struct MotionMoments {
    int length = 0;          // L
    int step_halves = 1;     // or 2
    double n_windows = 0.0;  // effective number
    // Sums over the windows, of i <= j <= L - 1 - i, by rows.
    std::array<double, most_moment_steps*(most_moment_steps + 2) / 4> sum{};

    friend bool operator==(const MotionMoments&, const MotionMoments&) = default;
};

// Windows from which on the learnt motion is known.
inline constexpr double few_windows = 25.0;

[[nodiscard]] constexpr std::size_t moment_place(int length, int i, int j) noexcept {
    if (i > j) return moment_place(length, j, i);
    if (i + j > length - 1) return moment_place(length, length - 1 - j, length - 1 - i);
    return static_cast<std::size_t>(i * (length + 1 - i) + j - i);
}

// chi f0 as the switches show it, over what the configuration says, less 1.
struct RelockScale {
    double value = 0.0;
    double variance = 0.01;  // known to a tenth at first: how far constants of a data sheet err

    friend bool operator==(const RelockScale&, const RelockScale&) = default;
};

}  // namespace zlg::core
