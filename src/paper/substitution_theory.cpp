#include "substitution_theory.hpp"

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include <boost/math/special_functions/bessel.hpp>

#include <zlg/design/substitution_noise.hpp>
#include <zlg/study/design_study.hpp>

namespace zlg::paper {
namespace {

double square(double x) { return x * x; }

struct Weights {
    std::vector<int> at;  // ticks, counted from the one before the gap
    std::vector<double> weight;
};

// Motion as a random variable: rate = amplitude * shape, shape = sin(phase) or uniform within +-1.
struct Swing {
    explicit Swing(const SubstitutionExperiment& e)
        : oscillates{e.amplitude_arcsec_s > 0.0},
          amplitude_arcsec_s{oscillates ? e.amplitude_arcsec_s : e.slow_rate_arcsec_s},
          frequency_hz{oscillates ? e.frequency_hz : 0.0} {}

    [[nodiscard]] double mean_square_shape() const { return oscillates ? 1.0 / 2.0 : 1.0 / 3.0; }
    // Greatest rotation over a time.
    [[nodiscard]] double rotation_arcsec(double time_s) const {
        const double turn = std::numbers::pi * frequency_hz * time_s;
        return amplitude_arcsec_s * time_s * (turn > 0.0 ? std::abs(std::sin(turn)) / turn : 1.0);
    }
    // <cos(x shape)>
    [[nodiscard]] double mean_cosine(double x) const {
        if (oscillates) return boost::math::cyl_bessel_j(0, x);
        return x > 0.0 ? std::sin(x) / x : 1.0;
    }

    bool oscillates;
    double amplitude_arcsec_s;
    double frequency_hz;
};

// Half-way through the run.
double magnetic_arcsec_s(const SubstitutionExperiment& e, const SwitchGrid& grid) {
    const double middle_s = 0.5 * static_cast<double>(grid.ticks()) * grid.tick_s;
    return design::magnetic_rate_arcsec_s(study::drift_case(e.base, 1.0).gyro, middle_s);
}

// Covariance of the roundings of two readings of the count, counts^2. With a uniform fraction at the first reading it
// is <B2({d})>/2, B2(x) = x^2 - x + 1/6, d the counts between them; as a Fourier series
//
//   sum_m <cos(2 pi m d)>/(2 pi^2 m^2),    d = motion + drift, whose magnetic part has either sign, + random walk
//
// 1/12 for d = 0, nothing for fast motion.
double rounding_covariance(const SubstitutionExperiment& e, const SwitchGrid& grid, double time_s) {
    constexpr int max_terms = 10'000;  // without a random walk they fall as 1/m^2 or faster
    const Swing swing{e};
    const double turns = 2.0 * std::numbers::pi / e.base.gyro.scale_arcsec;
    const double motion = turns * swing.rotation_arcsec(time_s);
    const double constant = turns * e.base.drift.nonmagnetic_arcsec_s * time_s;
    const double alternating = turns * magnetic_arcsec_s(e, grid) * time_s;
    const double walk = square(turns * e.base.drift.random_walk_arcsec_sqrt_s) * time_s;
    double sum = 0.0;
    for (int m = 1; m <= max_terms; ++m) {
        const double blurred = std::exp(-0.5 * walk * m * m);
        if (blurred < 1e-9) break;
        sum += swing.mean_cosine(m * motion) * std::cos(m * constant) * std::cos(m * alternating) * blurred /
               (2.0 * square(std::numbers::pi * m));
    }
    return sum;
}

// What the rounding variance of design::sum_gain lacks, arcsec^2: it presumes independent readings. Those on the two
// sides of a gap are, since what is counted while the light goes from mode to mode is garbage.
double correlated_rounding_variance(const SubstitutionExperiment& e, const SwitchGrid& grid, const Weights& w) {
    std::map<int, double> edges[2];  // before and after the gap: by the tick that a reading ends
    for (std::size_t k = 0; k < w.at.size(); ++k) {
        auto& side = edges[w.at[k] <= 0 ? 0 : 1];
        side[w.at[k]] += w.weight[k];
        side[w.at[k] - 1] -= w.weight[k];
    }
    std::map<int, double> products;  // by ticks between the readings
    for (const auto& side : edges)
        for (const auto& [a, weight_a] : side)
            for (const auto& [b, weight_b] : side)
                if (b > a) products[b - a] += 2.0 * weight_a * weight_b;
    double counts2 = 0.0;
    for (const auto& [ticks, product] : products)
        counts2 += product * rounding_covariance(e, grid, ticks * grid.tick_s);
    return square(e.base.gyro.scale_arcsec) * counts2;
}

// Of the correction by mean squares of a tick without detuning: n samples of light noise s in each half.
//
//   (K T chi f0/2)^2 Var(<e^2>_2 - <e^2>_1),   Var = 4 s^4/n
double relock_variance(const config::Gyro& gyro) {
    const double arcsec_per_lambda2 = gyro.scale_arcsec * gyro.tick_s * 0.5 * gyro.bias_chi * gyro.bias_hz;
    return square(arcsec_per_lambda2) * 4.0 * square(square(gyro.light_noise_lambda)) /
           static_cast<double>(gyro.light_samples);
}

// Whether a tick is among those corrected after the last gap before it.
bool relock_corrected(const SubstitutionExperiment& e, const SwitchGrid& grid, int tick) {
    const std::int64_t since_gap = tick > 0 ? tick - grid.n : grid.interval_ticks - grid.n + tick;
    return since_gap <= e.base.compensation.relock_ticks;
}

double noise_variance(const SubstitutionExperiment& e, const SwitchGrid& grid, const design::Substitution& s,
                      const Weights& w) {
    const config::Gyro& gyro = e.base.gyro;
    const double independent =
        design::counter_tick_sigma_arcsec(gyro.scale_arcsec) * design::sum_gain(s, design::TickNoise::counter);
    double variance = square(independent) + correlated_rounding_variance(e, grid, w);
    const double walk = square(e.base.drift.random_walk_arcsec_sqrt_s) * gyro.tick_s;
    for (std::size_t k = 0; k < w.at.size(); ++k)
        variance += square(w.weight[k]) * (walk + (relock_corrected(e, grid, w.at[k]) ? relock_variance(gyro) : 0.0));
    // Independent roundings less their correlation may cancel to nothing but rounding of our own.
    return std::fmax(0.0, variance);
}

// The drift of its ticks as it passes through the fit: the constant part, and the part that changes sign with the mode.
struct TakenDrift {
    double constant_arcsec = 0.0;
    double alternating_arcsec = 0.0;
};

TakenDrift taken_drift(const SubstitutionExperiment& e, const SwitchGrid& grid, const Weights& w) {
    TakenDrift taken;
    for (std::size_t k = 0; k < w.at.size(); ++k) {
        taken.constant_arcsec += w.weight[k] * e.base.drift.nonmagnetic_arcsec_s * grid.tick_s;
        taken.alternating_arcsec +=
            (w.at[k] <= 0 ? 1.0 : -1.0) * w.weight[k] * magnetic_arcsec_s(e, grid) * grid.tick_s;
    }
    return taken;
}

}  // namespace

SubstitutionTheory substitution_theory(const SubstitutionExperiment& e, const SwitchGrid& grid, design::Fit fit,
                                       int order) {
    const design::Substitution s{.fit = fit, .order = order, .n = grid.n, .tick_s = grid.tick_s};
    const Weights w{design::positions(s), design::sum_weights(s)};
    const Swing swing{e};
    const std::complex<double> answer = swing.amplitude_arcsec_s * design::ErrorResponse(s)(swing.frequency_hz);
    const TakenDrift drift = taken_drift(e, grid, w);
    const double noise = noise_variance(e, grid, s, w) + square(drift.alternating_arcsec);
    const double rms_square = std::norm(answer) * swing.mean_square_shape() + noise + square(drift.constant_arcsec);
    return {.extremum_arcsec = answer.real(),
            .crossing_arcsec = swing.oscillates ? answer.imag() : 0.0,
            .mean_arcsec = drift.constant_arcsec,
            .noise_arcsec = std::sqrt(noise),
            .rms_arcsec = std::sqrt(rms_square)};
}

}  // namespace zlg::paper
