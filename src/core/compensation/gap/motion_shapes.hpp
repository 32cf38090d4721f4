#pragma once
// What may be added to the learnt motion: covariances R of two ticks, for s = 1, in arcsec^2 of a tick.
//
// A walk begins at rest at time 0, with t in ticks. Its rate has the covariance, for s <= t,
//
//   walk of the rate          s                of the acceleration   s^2 (3 t - s)/6                    (1)
//
// and the angle of a tick is the integral of the rate over it, or over the part of it after the beginning.

#include <array>
#include <cstddef>
#include <span>

#include <zlg/core/compensation/gap_mixture.hpp>
#include <zlg/core/compensation/motion_moments.hpp>

namespace zlg::core {

enum class Walk : unsigned char { of_rate, of_acceleration };

// (1) integrated over ticks a..a+1 and b..b+1, a <= b; of the first only what lies after 0.
constexpr double walk_covariance(Walk walk, double a, double b) noexcept {
    const double c = a > 0.0 ? a : 0.0;
    const double d = a + 1.0;
    const double length = d - c;
    if (walk == Walk::of_rate)
        return b > a ? 0.5 * (d * d - c * c) : c * length * length + length * length * length / 3.0;
    const auto power = [](double x, int n) {
        double y = 1.0;
        for (int k = 0; k < n; ++k) y *= x;
        return y;
    };
    const auto cubes = [&](int n) { return power(d, n) - power(c, n); };
    if (b > a) return (b + 0.5) * cubes(3) / 6.0 - cubes(4) / 24.0;
    return d * d * cubes(3) / 6.0 - d * cubes(4) / 12.0 - cubes(5) / 30.0;
}

// Between ticks i and j of a walk that begins `before_first` ticks before tick 0; negative: within it.
template <std::size_t ticks>
constexpr auto walk_table(Walk walk, double before_first) noexcept {
    std::array<std::array<double, ticks>, ticks> table{};
    for (unsigned i = 0; i < ticks; ++i)
        for (unsigned j = i; j < ticks; ++j)
            table[i][j] = table[j][i] = walk_covariance(walk, i + before_first, j + before_first);
    return table;
}

inline constexpr auto rate_walk = walk_table<window_ticks>(Walk::of_rate, 0.0);
inline constexpr auto acceleration_walk = walk_table<window_ticks>(Walk::of_acceleration, 0.0);
inline constexpr auto rate_walk_amid = walk_table<max_points_a_side>(Walk::of_rate, -0.5);
inline constexpr auto acceleration_walk_amid = walk_table<max_points_a_side>(Walk::of_acceleration, -0.5);

// One shape R and its sizes: s^2 = least times powers of `step`, over the smallest variance of a point.
struct Shape {
    const double* table;  // of two ticks, by rows; or by their distance, from the middle of the table on
    int row;              // its length; -1: by distance
    int quiet_ticks;      // past the gap, before it begins; -1: it covers the window
    double least;
    double step;
    int n;
};

inline constexpr int most_sizes = 13;

// 6 sizes of a walk that begins past the gap.
template <std::size_t ticks>
constexpr Shape quiet(const std::array<std::array<double, ticks>, ticks>& table, int quiet_ticks) noexcept {
    return {table[0].data(), static_cast<int>(ticks), quiet_ticks, 0.25, 64.0, 6};
}

// 13 sizes of what covers the window: up to 100 deg/s within 20 ms, read by phase, where the steps are 8.
constexpr Shape full(const std::array<std::array<double, window_ticks>, window_ticks>& table, double least,
                     double step) noexcept {
    return {table[0].data(), window_ticks, -1, least, step, most_sizes};
}

// Stationary motion of unit variance of a tick, by the distance of two ticks: a flat spectrum of the rate from 0 to c,
//
//   R(k) ~ integral from 0 to c of sinc^2(f) cos(2 pi f k),   f in cycles a tick                          (2)
//
// where a narrow band lies below c it is interpolated as well as a whole one, up to the noise of the readings.
using ByDistance = std::array<double, 2 * window_ticks - 1>;
constexpr ByDistance by_distance(const std::array<double, window_ticks>& covariance) noexcept {
    ByDistance table{};
    for (unsigned k = 0; k < window_ticks; ++k)
        table[window_ticks - 1 + k] = table[window_ticks - 1 - k] = covariance[k];
    return table;
}

// c = 0.05.
inline constexpr ByDistance below_0_05_a_tick = by_distance(
    {1, 0.98366746408924377, 0.93562955834588768, 0.85869826928722226, 0.75734162056754173, 0.63737322113463835,
     0.50555115072421375, 0.3691164625542645, 0.23530591034745157, 0.11087509150717319, 0.0016669340432088793,
     -0.087743531692615589, -0.15430353663206159, -0.19661968993367404, -0.21497081908487117, -0.21119924019738129,
     -0.1884924976129459, -0.15107579276764366, -0.10384171146989089});
// c = 0.1.
inline constexpr ByDistance below_0_1_a_tick = by_distance(
    {1, 0.93605024967561012, 0.7588859488954881, 0.50855095969012687, 0.23960754309008872, 0.0066708327832372769,
     -0.14946312968909378, -0.21116456852445198, -0.18633668232551553, -0.10352218724948177, -0.0016476585878919721,
     0.082197001302517822, 0.12316804962321665, 0.11430166860864767, 0.066094085137734654, 0.00073067400809300473,
     -0.056708062816058419, -0.086967300002171719, -0.082453557488629314});
// c = 0.15.
inline constexpr ByDistance below_0_15_a_tick = by_distance(
    {1, 0.8611332062887429, 0.51354949197367383, 0.12354674872966044, -0.14137530997588857, -0.20306998184542321,
     -0.10293980910819378, 0.041541142055215162, 0.11948032408614713, 0.092063030356935041, 0.0016156373144746647,
     -0.073534412324270215, -0.080416786312798139, -0.024919273246487135, 0.041739548783359684, 0.067327726102851843,
     0.037607227632154419, -0.017824703521620411, -0.05319590602267938});
// c = 0.225.
inline constexpr ByDistance below_0_225_a_tick = by_distance(
    {1, 0.71142409967375908, 0.14138680405962076, -0.18194043460772455, -0.10140006851606426, 0.085239379961754944,
     0.08788826172680439, -0.038195580504373147, -0.075882387121610245, 0.0090963599344952, 0.063156653444114363,
     0.010239313696934493, -0.049704410746432261, -0.022857273865767819, 0.036011619656443866, 0.03023577328872587,
     -0.022696989169626591, -0.03331651151470217, 0.010381017217385029});

inline constexpr ByDistance independent_ticks = by_distance({1.0});

constexpr Shape stationary(const ByDistance& table, double step, int n) noexcept {
    return {table.data() + window_ticks - 1, -1, -1, 0.3, step, n};
}

// A walk begins 2, 3, 4.5 or 6 ticks past the gap. By trial on zlg_manoeuvre_campaign.
inline constexpr std::array<Shape, quiet_shapes> quiet_motion{quiet(rate_walk, 2),
                                                              quiet(rate_walk, 3),
                                                              quiet(rate_walk_amid, 4),
                                                              quiet(rate_walk, 6),
                                                              quiet(acceleration_walk, 2),
                                                              quiet(acceleration_walk, 3),
                                                              quiet(acceleration_walk_amid, 4),
                                                              quiet(acceleration_walk, 6)};
inline constexpr std::array<Shape, 2> full_motion{full(rate_walk, 1.0 / 16.0, 8.0),
                                                  full(acceleration_walk, 1.0 / 1024.0, 8.0)};

// What a gyro may do of which nothing is known yet. By trial on zlg_sigma_campaign and on tones of 5 to 40 Hz.
inline constexpr std::array<Shape, most_full_shapes> any_motion{full(rate_walk, 1.0 / 16.0, 6.0),
                                                                full(acceleration_walk, 1.0 / 1024.0, 6.0),
                                                                stationary(independent_ticks, 9.0, most_sizes),
                                                                stationary(below_0_05_a_tick, 14.0, 11),
                                                                stationary(below_0_1_a_tick, 14.0, 11),
                                                                stationary(below_0_15_a_tick, 14.0, 11),
                                                                stationary(below_0_225_a_tick, 14.0, 11)};

// Models in which something is added.
constexpr int models_of(std::span<const Shape> shapes) noexcept {
    int n = 0;
    for (const Shape& shape : shapes) n += shape.n;
    return n;
}
inline constexpr int n_models = 2 * models_of(quiet_motion) + models_of(full_motion);
inline constexpr int n_models_of_any = models_of(any_motion);

}  // namespace zlg::core
