#pragma once
// The synchronous detector: light samples of one half-period in, detuning of the perimeter out.
//
// The reversal of the bias modulates the light of each beam in proportion to the detuning, with a phase that the
// helicity sets (eq 1). Both beams normalise each other; one beam alone needs its own level, tracked meanwhile.

#include <cstdint>
#include <span>

#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct SyncDetectorConfig {
    // (A - B)/(A + B) per wavelength of detuning; positive where A > B for bias_sign * helicity * detuning > 0.
    double discriminator_per_lambda = 0.332;  // size 1e-6..1e6, either sign
    double dark_fraction = 0.5;               // of its share of the level: a beam below it is dark; 0..1 exclusive
    double level_min = 0.0;                   // least light that counts as a level; unit of the samples, >= 0
    std::int32_t level_ticks = 200;           // time constant of the tracked level, 1..2^30
    DiscriminatorCurve curve{};               // F, of what the slope alone would read; none: the linear law
};

[[nodiscard]] constexpr bool is_allowed(const SyncDetectorConfig& c) noexcept {
    const double slope = __builtin_fabs(c.discriminator_per_lambda);
    return slope >= 1e-6 && slope <= 1e6 && c.dark_fraction > 0.0 && c.dark_fraction < 1.0 && c.level_min >= 0.0 &&
           c.level_min < 1e30 && c.level_ticks >= 1 && c.level_ticks <= 1 << 30 && check(c.curve) == CurveFault::none;
}

// The light of an undisturbed gyro, learnt and followed.
struct LightLevel {
    double level = 0.0;        // 0: not learnt
    double candidate = 0.0;    // last observation that could be a level
    std::int32_t n_agree = 0;  // candidates in a row within a factor of two of each other
    std::int32_t n_faint = 0;  // observations in a row of too little light, while there was a beat

    friend constexpr bool operator==(const LightLevel&, const LightLevel&) = default;
};

struct SyncDetectorState {
    LightLevel both{};       // sum of both beams
    LightLevel single{};     // beam A over a whole tick, for a gyro with one photodiode
    double mean_a = 0.0;     // beam A in the previous half, where `sign_a` is not 0
    std::int8_t sign_a = 0;  // sign of the modulation in that half

    friend constexpr bool operator==(const SyncDetectorState&, const SyncDetectorState&) = default;
};

// Beam B as it is compared with beam A: w (B - o) of light_balance.hpp.
struct BeamWeight {
    double weight = 1.0;
    double beyond = 0.0;  // w o

    template <class Number> [[nodiscard]] constexpr Number of(Number beam_b) const noexcept {
        return weight * beam_b - beyond;
    }
};

struct SyncDetectorInput {
    std::span<const float> light_a{};  // 1..64 samples of the half
    std::span<const float> light_b{};  // as many, or none: one beam only
    int sign = 1;                      // bias_sign * polarity in force during the half: +1 or -1
    bool settled = false;              // loop closed and settled: the level may follow the light
    bool beats = false;                // the counts show the bias: there is light in both directions
    BeamWeight weight_b{};
};

struct SyncDetectorOutput {
    Wavelengths detuning{};        // mean over the half; 0 unless usable
    double mean_sq_lambda2 = 0.0;  // mean of the squared samples; 0 unless usable
    double light = 0.0;            // mean over the half: the sum of both beams, or the one; 0 unless readable
    double signal = 0.0;           // mean of (A - B)/(A + B); 0 unless usable, or with one beam
    bool readable = false;         // there are samples, and all are finite
    bool two_way = false;          // light in both directions throughout the half
    bool dark = false;             // a sample of a beam is below a tenth of its share of the level
    bool usable = false;           // the detuning was measured
};

// Detect one half-period.
//
//   both beams:  dl_k = sign F((A_k - B_k)/(A_k + B_k)/K)
//   one beam:    dl_k = sign F((A_k - level)/level/K)
//
// two_way  both beams: every sample is above dark_fraction/2 of the level, and of the present sum. One beam: every
//          sample is above dark_fraction and below 2 - dark_fraction of its level (one-way light brightens the
//          remaining beam). A single sample that fails decides for the half, because its counts are then partly wrong.
// level    learnt from four observations in a row that agree within a factor of two, then followed with the time
//          constant level_ticks while settled. An observation is the sum of a half, or the mean of one beam over two
//          halves of opposite modulation. Four in a row above 2 - dark_fraction of the level are learnt anew. A loss of
//          light is not, unless the beat stays for 64 observations: then the light, or its converter, has faded. Until
//          learnt, one beam gives no detuning.
// config   passed `check`.
// accuracy that of the curve, sample by sample; the one-beam mean square leaves out the droop of the beam in dl^2.
[[nodiscard]] SyncDetectorOutput step(const SyncDetectorConfig& config, SyncDetectorState& state,
                                      const SyncDetectorInput& input) noexcept;

}  // namespace zlg::core
