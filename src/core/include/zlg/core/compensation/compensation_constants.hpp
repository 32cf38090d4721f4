#pragma once
// What compensation presumes of the gyro and of its record: each constant that more than one module needs, and the laws
// of the bias and of the light with it.

#include <array>

#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

// The loss of the bias beyond its square: f = f0 (1 - chi (x^2 + b_0 x^4 + b_1 x^6 + b_2 x^8)), x = dl - centre.
// Without terms the parabola.
struct LossBend {
    std::array<double, 3> term{};

    friend constexpr bool operator==(const LossBend&, const LossBend&) = default;
};

// What it is over chi at a square x^2, and how it goes on from there.
struct Loss {
    double value = 0.0;      // L = x^2 + b_0 x^4 + ...
    double slope = 1.0;      // over that of x^2
    double curvature = 1.0;  // half of the second derivative by x
};

[[nodiscard]] constexpr Loss loss_at(const LossBend& bend, double sq) noexcept {
    const auto& [b0, b1, b2] = bend.term;
    return {.value = sq * (1.0 + sq * (b0 + sq * (b1 + sq * b2))),
            .slope = 1.0 + sq * (2.0 * b0 + sq * (3.0 * b1 + sq * 4.0 * b2)),
            .curvature = 1.0 + sq * (6.0 * b0 + sq * (15.0 * b1 + sq * 28.0 * b2))};
}
// Its value with no term less than 0: as much as a part of it may be.
[[nodiscard]] double most_loss(const LossBend& bend, double sq_lambda2) noexcept;

struct CompensationConstants {
    Seconds tick{0.005};                         // T, 1e-9..1e9
    Arcsec scale{3.263};                         // K, per count, 1e-9..1e9
    ArcsecPerRootSecond random_walk{0.14};       // of the angle, 0..1e6
    Hertz bias{60e3};                            // f0 at the reference temperature, > 0, up to 1e15
    double chi = 3.6;                            // +-1e6
    LossBend bend{};                             // each +-1e15
    double temperature_coefficient_per_c = 0.0;  // of the bias, +-1
    Celsius reference_temperature{20.0};         // +-1e6
    Wavelengths centre{0.0};                     // detuning of the largest bias, +-1

    // Edges of the bias, where they are shifted.
    Hertz timer{1e7};            // ticks of the timer per second, 1..1e15
    double plateau_ratio = 1.0;  // plateau of the bias over its mean in an even half, 1..2: 1/(1 - t_e/T), linear edges

    // Light, as it was read and recorded.
    Wavelengths light_noise{0.0033};  // of one light sample, 0..10
    int light_samples = 16;           // a half, >= 1

    double fringe_noise_counts = 0.0016;  // of a place within the count, where it was read, rms, 0..1

    DiscriminatorCurve record_curve{};   // for recorded detunings that the linear law has read; none: they are right
    DiscriminatorCurve control_curve{};  // that they have come through already: it scales their noise
};

// Of a configuration of the compensation. The numbers of the enumerators are sent over the gyro's line (docs/wire.md)
// and do not change. Of the constants, those of timer and plateau are `edges`, that of the random walk is
// `random_walk`, the others are `relock`.
enum class GyroCompensationFault : unsigned char {
    none,
    relock,
    edges,
    bridge,
    random_walk,
    magnetic,
    profile,
    lock_in
};

[[nodiscard]] GyroCompensationFault check(const CompensationConstants& gyro) noexcept;

// Twice the covariance of two neighbouring ticks, without its sign, and the variance of one: of the rounding of the
// counter's readings, each uniform over a count.
[[nodiscard]] constexpr double rounding_arcsec2(const CompensationConstants& gyro) noexcept {
    return gyro.scale.value() * gyro.scale.value() / 6.0;
}

// Variance of a tick by the random walk of the angle.
[[nodiscard]] constexpr double walk_arcsec2(const CompensationConstants& gyro) noexcept {
    return gyro.random_walk.value() * gyro.random_walk.value() * gyro.tick.value();
}

// u = chi f0 K T/2: false angle of a tick for each square of a wavelength by which the mean squares of its halves
// differ.
[[nodiscard]] constexpr double arcsec_per_lambda2(const CompensationConstants& gyro, Hertz bias) noexcept {
    return 0.5 * gyro.chi * bias.value() * gyro.scale.value() * gyro.tick.value();
}

// Variance of the detuning within a half, without that of the noise of its samples.
[[nodiscard]] double spread_lambda2(const CompensationConstants& gyro, const TrueMoments& seen) noexcept;

// Mean of b_0 x^4 + ... over a half whose motion is that of two equal groups of samples (discriminator_curve.hpp), of
// which part of the variance counts.
[[nodiscard]] double beyond_square(const CompensationConstants& gyro, const TrueMoments& seen,
                                   double part = 1.0) noexcept;

// f0 at a temperature; one beyond +-1e6 is none, like NaN: at the reference temperature.
[[nodiscard]] Hertz bias_at(const CompensationConstants& gyro, Celsius temperature) noexcept;

}  // namespace zlg::core
