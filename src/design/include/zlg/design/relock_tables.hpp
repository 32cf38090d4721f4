#pragma once
// Tables 1 and 2 of the paper: their arithmetic recomputed, models of the loop fitted to the measured drift, and what
// the corrections by eqs (11) and (13) give on such a loop.
//
// A model is a decay of the detuning d(t) = dl/dl0 and the deficit G0 = scale f0 chi dl0^2 at the closing. Per tick i,
// with the means over its first and second half, and the sign of the tables (drift above 0):
//
//   drift_i   = (G0/2)(<d^2>_first - <d^2>_second)
//   deficit_i = (G0/2)(<d^2>_first + <d^2>_second)        f0 - f_i, scaled

#include <array>
#include <string_view>

namespace zlg::design {

inline constexpr int table_ticks = 4;
inline constexpr double table_tick_s = 0.005;
using TickDrifts = std::array<double, table_ticks>;  // arcsec/s, the same number as deg/h

// The measured drift of both tables and their computed columns. Table 1 has nothing for tick 1.
inline constexpr TickDrifts measured_arcsec_s{4056.0, 2956.0, 1306.0, 207.0};
inline constexpr TickDrifts table1_computed_arcsec_s{0.0, 2399.0, 497.0, 178.0};
inline constexpr TickDrifts table2_computed_arcsec_s{3720.0, 2385.0, 1480.0, 278.0};

// What the last rows of the tables sum up.
struct TableSummary {
    TickDrifts residual_arcsec_s{};  // measured - computed
    double mean_arcsec_s = 0.0;
    double angle_arcsec = 0.0;  // over the four ticks
    double angle_without_first_arcsec = 0.0;
    double rms_arcsec_s = 0.0;
};
[[nodiscard]] TableSummary summarise(const TickDrifts& measured, const TickDrifts& computed);

// 2T/ln(drift_i/drift_(i+1)): the time constant that an exponential loop would need, from each pair of ticks.
[[nodiscard]] std::array<double, table_ticks - 1> local_time_constants_s(const TickDrifts& drift);

enum class Decay {
    exponential,  // e^(-t/time)
    slew,         // 1 - t/time, then 0
    slew_tail,    // slope -min(1/time, d/tail): slew, then exponential of time constant tail
    critical,     // (1 + t/time) e^(-t/time), critically damped second order
};

struct RelockModel {
    Decay decay = Decay::exponential;
    double deficit_arcsec_s = 0.0;  // G0, >= 0
    double time_s = 0.0;            // > 0
    double tail_s = 0.0;            // slew_tail only, > 0
};

// Means of d and d^2 over half h = 0, 1, ... in closed form.
struct HalfMeans {
    double d = 0.0;
    double d_square = 0.0;
};
[[nodiscard]] HalfMeans half_means(const RelockModel& model, int half, double tick_s = table_tick_s);

[[nodiscard]] TickDrifts drift_arcsec_s(const RelockModel& model);
[[nodiscard]] TickDrifts deficit_arcsec_s(const RelockModel& model);

// Least squares of a model to four drifts, finite. The deficit is linear in them; the times are searched within
// T/20..50 T.
struct RelockFit {
    std::string_view name;
    RelockModel model;
    TickDrifts drift_arcsec_s{};
    double rms_arcsec_s = 0.0;  // root mean square of the four differences
};
[[nodiscard]] RelockFit fit_relock(Decay decay, const TickDrifts& measured);

// What the corrections, which presume an exponential loop, compute on any of these loops.
//
//   (11)  drift_i = deficit_i (1 - q)/(1 + q), q = (deficit_i/deficit_1)^(1/(2(i-1)));  tick 1, which the paper leaves
//         uncorrected, with the q of tick 2 as soon as it is known
//   (13)  drift_i = (G0/4) (-ln rho) (<d>_first + <d>_second)^2, rho = <d>_second/<d>_first
//
// NaN where the formula has no answer: a ratio outside (0, 1).
[[nodiscard]] TickDrifts corrected_by_frequency_arcsec_s(const RelockModel& model);
[[nodiscard]] TickDrifts corrected_by_detuning_arcsec_s(const RelockModel& model);

}  // namespace zlg::design
