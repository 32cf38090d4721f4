#pragma once
// The estimate of a switch: the angle of its gap and of the false rotation after it, once, from all that is known.
//
// The model is linear and Gaussian, over half-ticks. Row r of the window was read as
//
//   y_r = motion_r + e_f s_r - d_r + rounding at its end - rounding at its start
//
// e_f  an error of the bias, on either side of the gap its own; s_r the sum of its signs over the row
// d_r  the false angle while the loop closes, from the light: known but for its error and the scale of chi f0
//
//   V = C + E + D R D^T          C motion, learnt; E bias, false angles and their scale; R roundings by their law
//   V_m = V + s_m^2 K_m          the bank: nothing, or a walk that was not learnt (walk_kernel.hpp)
//
// Each member gives the generalised least-squares estimate of what is wanted, with an unknown constant rate; the
// members are weighed by their restricted likelihood and a prior, and the estimate is the mean of the mixture (Searle,
// Casella and McCulloch, Variance Components, 1992, ch. 6; kriging with an unknown mean: Stein, Interpolation of
// Spatial Data, 1999).
//
// The mixture decides the angle of all that is wanted. How it is spread over the rows follows from the covariance of
// the likeliest member, given that sum: as of Gaussian variables whose sum is known.
//
// A pure function: no state, no stages. The scale of chi f0 goes in and out by value.

#include <array>
#include <span>

#include <zlg/core/common/triangle.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/switch_window.hpp>

namespace zlg::core {

// A row that is wanted: its angle, with the error of the re-lock taken off if it was read.
struct RowEstimate {
    double angle_arcsec = 0.0;
    double variance_arcsec2 = 0.0;
    double with_before_arcsec2 = 0.0;  // covariance with the row before it, if that is wanted too
    double share = 0.0;                // its covariance with the angle of all that is wanted, over the variance of that

    friend bool operator==(const RowEstimate&, const RowEstimate&) = default;
};

struct SwitchEstimate {
    bool known = false;         // false: the factor that gives the unit failed, or no member has finite evidence
    double angle_arcsec = 0.0;  // of all rows that are wanted
    double variance_arcsec2 = 0.0;
    RelockScale scale{};
    std::array<RowEstimate, most_window_rows> row{};

    friend bool operator==(const SwitchEstimate&, const SwitchEstimate&) = default;
};

// Of the light, of the rows that are read.
using LightHalves = std::array<LightHalf, 64>;

// Room to work in, of the caller: what it holds before and after is of no account.
struct EstimateRoom {
    friend constexpr bool operator==(const EstimateRoom&, const EstimateRoom&) noexcept { return true; }

    std::array<double, triangle_size(most_window_rows)> covariance{};  // V of all rows
    std::array<double, triangle_size(most_points_after)> errors{};     // E of the points after the gap
    union {
        std::array<double, triangle_size(most_window_points)> factor{};  // of V_m of the points
        LightHalves halves;                                              // while E is made
    };
};

// Called some hundred times while an estimate is made, by one who has more to do.
using Pause = void (*)() noexcept;

// bank  of at most as many members as `motion_bank`.
[[nodiscard]] SwitchEstimate estimate(const CompensationConstants& gyro, const SwitchWindow& window,
                                      const MotionMoments& motion, const RelockScale& scale, EstimateRoom& room,
                                      std::span<const BankMember> bank = motion_bank, Pause pause = nullptr) noexcept;

}  // namespace zlg::core
