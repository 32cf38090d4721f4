#pragma once
// Mixture of models of the motion beside one gap (Bayesian model averaging).
//
// What was learnt of the motion says nothing of a manoeuvre that it has never met. So the points themselves are asked:
// beside the learnt covariance C (with that of the re-lock errors, E) stand models in which something is added,
//
//   V_m = C + E + s^2 R                                                                                  (1)
//
//   R  random walk of the rate or of the acceleration, over the whole window; and either walk beginning only p ticks
//      past the gap, or ending p ticks before it: a manoeuvre that leaves the gap itself alone
//   s  one of a geometric series
//
// Model m has the prior probability 0.8 where nothing is added, the others share 0.2 evenly (one whose walk begins behind
// the last point is left out), and the restricted likelihood of the points z (constant rate unknown, H = 1)
//
//   log p(z|m) = -1/2 (z^T P_m z + log |V_m| + log H^T V_m^-1 H) + const                                 (2)
//
// With the weights w_m ~ prior p(z|m) the estimate is t = sum of w_m t_m and its variance sum of c_m (v_m + (t_m - t)^2);
// t_m, v_m as in optimal_bridge.hpp (3), (4); gap_final.cpp enlarges v_m where something happened. Points are whole ticks.
//
// A manoeuvre is none of the models: its points are so exact that (2) decides between models which are all wrong, and one
// alone says nothing of how wrong it is. So in the variance the evidence among those in which something is added counts only
// in part, a fourth root, while they keep their weight together:
//
//   c_m = (1 - q) w_m + q (1 - w_0) w_m^(1/4)/(sum of w_k^(1/4), k > 0);   c_0 = w_0                      (3)
//   q = 1 - w_0/0.6, at least 0: how far the weights speak against the learnt motion alone
//
// Where nothing was learnt the models hold every motion, and c_m = w_m.
//
// Computation: C + E = L L^T is factored once. In coordinates y = L^-1 z every model of one shape R is I + s^2 W, W =
// L^-1 R L^-T, and after one reduction of W to tridiagonal form by reflections each s costs some n operations. A walk that
// begins at point j changes the coordinates from j on alone.
//
// Method: restricted likelihood, Patterson and Thompson, Biometrika 58 (1971); model averaging, Hoeting et al., Statist. Sci.
// 14 (1999); a power of the likelihood where no model is true, Miller and Dunson, J. Am. Stat. Assoc. 114 (2019);
// tridiagonal form, Golub and Van Loan, Matrix Computations, sec. 8.3.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/cholesky.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

namespace zlg::core {

inline constexpr std::size_t mixture_unknowns = 2 * max_points_a_side;
using MixtureColumn = ColumnOf<mixture_unknowns>;

inline constexpr int quiet_shapes = 8;      // that begin past the gap, or end before it
inline constexpr int most_full_shapes = 7;  // that cover the window
inline constexpr double prior_of_nothing = 0.8;
inline constexpr double prior_of_rest = 0.4;  // where nothing was learnt

// More weight than this of the learnt motion alone is no evidence against it: roundings that repeat with a steady motion
// shift the weights a little. By trial on zlg_sigma_campaign.
inline constexpr double most_of_nothing = 0.6;

// The points: whole ticks.
struct MixturePoints {
    int n_gap = 0, n_side = 0, n = 0;                   // the window begins n_side ticks before the gap
    std::array<std::int8_t, mixture_unknowns> place{};  // of each, in ticks from the start of the window
    MixtureColumn value{};                              // less the level, arcsec
    MixtureColumn error_with_all{};                     // covariance of each point's e with the sum of all e
    double error_variance = 0.0;                        // of that sum

    friend bool operator==(const MixturePoints&, const MixturePoints&) = default;
};

// One model.
struct MixtureModel {
    double log_evidence = 0.0;  // 2 log of (2), without the factor |C + E|
    double rate = 0.0;          // b
    double value = 0.0;         // t, of the angle of the switch
    double variance = 0.0;      // v

    friend bool operator==(const MixtureModel&, const MixtureModel&) = default;
};

// Sums over the models in which something is added, each with its weight w.
struct MixtureSums {
    double log_unit =
        0.0;  // weights are those of prior and (2), over that where nothing is added, times exp(-log_unit)
    double weight = 0.0;
    double off = 0.0;               // of t_m - t_0, the angle of the whole switch, 0: nothing added
    double off_sq = 0.0;            // of its square
    double variance = 0.0;          // of v_m
    double rate = 0.0;              // of b_m
    MixtureColumn dual{};           // of L^T u_m, u = P z
    MixtureColumn reversed_dual{};  // of u_m, of the models in reversed time, once they are done
    std::array<MixtureColumn, most_full_shapes> added{};  // of s^2 L^T u_m, by shape that covers the window
    // With the weights c_m, not normalised: of 1, t_m - t_0, its square, v_m.
    double coarse_weight = 0.0, coarse_off = 0.0, coarse_off_sq = 0.0, coarse_variance = 0.0;

    friend bool operator==(const MixtureSums&, const MixtureSums&) = default;
};

struct MixtureEstimate {
    bool known = false;
    double nothing = 1.0;  // weight of the model in which nothing is added
    // Of the other models together, times their weight:
    double off_arcsec = 0.0;  // t_m - t_0
    double coarse_off_arcsec = 0.0,
           coarse_off_arcsec2 = 0.0;                    // the same with the weights of the variance, and its square
    double variance_arcsec2 = 0.0;                      // v_m, so too
    std::array<double, max_solved_gap> value_arcsec{};  // ticks of the gap, less the level
    MixtureColumn dual{};                               // u

    friend bool operator==(const MixtureEstimate&, const MixtureEstimate&) = default;
};

// q of (3).
[[nodiscard]] constexpr double against_nothing(const MixtureEstimate& estimate) noexcept {
    return estimate.nothing < most_of_nothing ? 1.0 - estimate.nothing / most_of_nothing : 0.0;
}

// Products of H, z and g, the covariance with the angle of the switch, under V^-1.
struct MixtureProducts {
    double hh = 0.0, hz = 0.0, zz = 0.0, hg = 0.0, gz = 0.0, gg = 0.0;

    friend bool operator==(const MixtureProducts&, const MixtureProducts&) = default;
};

// A symmetric matrix reduced to tridiagonal form: T, and the reflections that made it.
struct Reflections {
    std::array<MixtureColumn, mixture_unknowns> of{};
    MixtureColumn factor{};

    friend bool operator==(const Reflections&, const Reflections&) = default;
};
struct Tridiagonal {
    MixtureColumn diagonal{}, beside{};  // (i, i), (i + 1, i)

    friend bool operator==(const Tridiagonal&, const Tridiagonal&) = default;
};

// The columns of one shape in the coordinates in which its W is tridiagonal, from its first point on.
struct ShapeColumns {
    unsigned first = 0;  // point that the shape changes
    unsigned n = 0;      // and how many from there on
    Reflections reflections{};
    Tridiagonal w{};
    MixtureColumn ones{}, value{}, with_sum{}, more_with_sum{};  // g = with_sum + s^2 more_with_sum
    double more_variance = 0.0;                                  // of the angle, for s = 1
    MixtureProducts before{};                                    // of the coordinates before

    friend bool operator==(const ShapeColumns&, const ShapeColumns&) = default;
};

// The mixture, stage by stage: the models in reversed time, then those in the order of time, then the estimate.
struct GapMixture {
    bool learnt = true;  // C is that of a learnt motion; else of the readings alone
    int stage = 0;
    bool failed = false;
    bool reversed = false;  // the factor and its columns are of the points in reversed time
    MixturePoints points{};
    std::array<double, mixture_unknowns*(mixture_unknowns + 1) / 2> covariance{};  // C + E of the points, by rows
    CholeskyFactorOf<mixture_unknowns> factor{};
    MixtureColumn ones{}, value{}, with_sum{};  // L^-1 of H, z and k, the covariance with the angle of the switch
    double sum_variance = 0.0;                  // of that angle
    double smallest = 0.0;                      // least variance of a point, the earlier ones given
    MixtureModel nothing{};                     // where nothing is added
    ShapeColumns shape{};                       // at hand
    MixtureSums sums{};
    MixtureEstimate estimate{};

    friend bool operator==(const GapMixture&, const GapMixture&) = default;
};

[[nodiscard]] bool is_done(const GapMixture& mixture) noexcept;

// The i-th point in the order of the factor; its place: from the start of the window, in reversed time from the end of the gap.
[[nodiscard]] constexpr unsigned point_of(const GapMixture& m, unsigned i) noexcept {
    return m.reversed ? static_cast<unsigned>(m.points.n) - 1 - i : i;
}
[[nodiscard]] constexpr int place_of(const GapMixture& m, unsigned i) noexcept {
    const int place = m.points.place[point_of(m, i)];
    return m.reversed ? m.points.n_side + m.points.n_gap - 1 - place : place;
}

// Add a point, in order of place, before the first stage.
//
// error  covariance of its error e with those of the earlier points and, last, with itself.
void add_point(const MotionCovariance& covariance, GapMixture& mixture, int place, double value_arcsec,
               const MixtureColumn& error) noexcept;

// Work of the next stage, in thousands of instructions of the gyro's processor.
[[nodiscard]] int cost_of_stage(const GapMixture& mixture) noexcept;

// Advance by one stage: a shape with all its s; one that covers the window in two.
void advance(const MotionCovariance& covariance, GapMixture& mixture) noexcept;

}  // namespace zlg::core
