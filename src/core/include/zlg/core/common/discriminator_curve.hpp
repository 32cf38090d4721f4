#pragma once
// The inverse discriminator: from the detuning that the linear law reads out of the light to the true one.
//
//   apparent = signal / K        detuning = F(apparent)        F monotone, F(0) = 0
//
// The discriminator of a laser is expansive: at 0.2 wavelength its signal is several times that of the linear law. F is
// a table through the origin with a monotone cubic between its nodes: of one side, and odd, or of both, which unequal
// isotopes make unlike. The same table holds a calibration of the bias deficit G(apparent) = (f0 - f)/f0: its detuning
// is the one of which chi (dl - centre)^2 is that deficit.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr std::int32_t max_side_nodes = 31;  // besides the origin
inline constexpr std::int32_t max_curve_nodes = 2 * max_side_nodes + 1;

// Filled by the functions below. Without nodes it is the linear law, F(x) = x.
struct DiscriminatorCurve {
    std::int32_t n_nodes = 0;  // the first is the origin, or those of the other side are before it
    std::array<double, max_curve_nodes> apparent_lambda{};
    std::array<double, max_curve_nodes> detuning_lambda{};
    std::array<double, max_curve_nodes> slope{};  // dF/dx at the node

    friend constexpr bool operator==(const DiscriminatorCurve&, const DiscriminatorCurve&) = default;
};

// Nodes before the origin; 0 where one side stands for both, or where there is no origin.
[[nodiscard]] constexpr std::size_t nodes_below(const DiscriminatorCurve& c) noexcept {
    const auto n = static_cast<std::size_t>(c.n_nodes);
    for (std::size_t k = 0; k < n; ++k)
        if (c.apparent_lambda[k] == 0.0) return k;
    return 0;
}

enum class CurveFault : unsigned char { none, size, node, slope };

// node   the origin is one; apparent and true detunings grow strictly and are within +-1000 wavelengths
// slope  within 0..3 times the steps on both sides, which keeps every piece monotone
[[nodiscard]] constexpr CurveFault check(const DiscriminatorCurve& c) noexcept {
    constexpr double max_lambda = 1e3;
    constexpr double max_slope = 3.0 * (1.0 + 1e-9);
    const auto is_within = [](double x) { return x >= -max_lambda && x <= max_lambda; };
    if (c.n_nodes == 0) return CurveFault::none;
    if (!(c.n_nodes >= 2 && c.n_nodes <= max_curve_nodes)) return CurveFault::size;
    const auto n = static_cast<std::size_t>(c.n_nodes);
    const std::size_t below = nodes_below(c);
    if (!(c.apparent_lambda[below] == 0.0 && c.detuning_lambda[below] == 0.0)) return CurveFault::node;
    if (below > max_side_nodes || n - below > max_side_nodes + 1 || n - below < 2) return CurveFault::size;
    if (!(is_within(c.apparent_lambda[0]) && is_within(c.detuning_lambda[0]))) return CurveFault::node;
    for (std::size_t k = 1; k < n; ++k) {
        if (!(is_within(c.apparent_lambda[k]) && is_within(c.detuning_lambda[k]))) return CurveFault::node;
        const double width = c.apparent_lambda[k] - c.apparent_lambda[k - 1];
        const double rise = c.detuning_lambda[k] - c.detuning_lambda[k - 1];
        if (!(width > 0.0 && rise > 0.0)) return CurveFault::node;
        for (const double slope : {c.slope[k - 1], c.slope[k]}) {
            if (!(slope >= 0.0 && slope * width <= max_slope * rise)) return CurveFault::slope;
        }
    }
    return CurveFault::none;
}

// The curve through 1..31 nodes besides the origin: pairs of apparent and true detuning, both positive and growing; the
// other side is their mirror image. With negative ones before them, up to 31 too, each side has its own.
//
//   slope    of the parabola through a node and its neighbours (at the origin of one side: of the odd cubic through two
//            nodes), limited for monotony
// accuracy third order of the distance between nodes: halving it leaves an eighth of the error
// return   the linear law where there are no nodes; a curve that `check` refuses where they are not as said
[[nodiscard]] DiscriminatorCurve discriminator_curve(std::span<const double> apparent_lambda,
                                                     std::span<const double> detuning_lambda) noexcept;

struct CurvePoint {
    double detuning_lambda = 0.0;
    double slope = 1.0;
};

// F and its slope. Beyond the outermost nodes F stays at its value there: such light is not of this mode. NaN gives
// NaN.
//
// curve  passed `check`.
// cost   about 10 ns.
[[nodiscard]] CurvePoint true_detuning(const DiscriminatorCurve& curve, double apparent_lambda) noexcept;

// Slope of F where it has this value, of the chord between two nodes; beyond the outermost ones that of the last piece.
[[nodiscard]] double slope_behind(const DiscriminatorCurve& curve, double detuning_lambda) noexcept;

// What a half would have read through F, from the moments that it read through the linear law.
struct TrueMoments {
    double mean_lambda = 0.0;
    double mean_sq_lambda2 = 0.0;  // noise included, as F passes it
    double slope = 1.0;            // by which light noise grows
};

// The motion within the half is represented by two equal groups of samples, one standard deviation off the mean on
// either side: right for moments up to the second, to third order in the motion for F.
//
// noise_sq_lambda2  variance of one sample, part of mean_sq_lambda2. A spread below it counts as negative.
[[nodiscard]] TrueMoments true_moments(const DiscriminatorCurve& curve, double mean_lambda, double mean_sq_lambda2,
                                       double noise_sq_lambda2) noexcept;

// The bias may be largest at another detuning than where the loop settles: f = f0 (1 - chi (dl - centre)^2).
inline constexpr Wavelengths max_centre{1.0};

// Mean square of the detuning from there. About 0 it needs no mean.
[[nodiscard]] constexpr double about(Wavelengths centre, const TrueMoments& m) noexcept {
    const double c = centre.value();
    return c == 0.0 ? m.mean_sq_lambda2 : m.mean_sq_lambda2 + c * (c - 2.0 * m.mean_lambda);
}

}  // namespace zlg::core
