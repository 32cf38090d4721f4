#pragma once
// The detuning after the perimeter loop is closed again, free-form in time, from the light samples of all halves together.
//
// In each half-period the detuning is a cubic of time; value, slope and curvature go on from half to half. At an unknown
// moment of the first tick the loop begins to act: before it the detuning stands still. All such moments are tried, and
// averaged with the likelihood of their samples as weights (docs/compensation.md).

#include <array>
#include <cstdint>

#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr int profile_halves = 16;  // after the loop is closed

// Mean square detuning, from that of the largest bias, of the first halves after a gap, with the covariance of their errors.
struct RelockProfile {
    bool known = false;
    std::array<double, profile_halves> mean_sq_lambda2{};  // without that of the noise
    std::array<std::array<double, profile_halves>, profile_halves> covariance_lambda4{};

    friend bool operator==(const RelockProfile&, const RelockProfile&) = default;
};

struct RelockProfileConfig {
    double discriminator_per_lambda = 0.332;  // of (A - B)/(A + B); size 1e-6..1e6, either sign
    DiscriminatorCurve curve{};               // of the light; none: the linear law
    DiscriminatorCurve record_curve{};  // of recorded detunings that the linear law has read; none: they are right
    Wavelengths centre{0.0};            // detuning of the largest bias, +-1
    Wavelengths light_noise{0.0033};    // of one sample of both beams, 0..1000
    int light_samples = 16;             // behind the recorded detunings of a half, >= 1
};

enum class RelockProfileFault : unsigned char { none, discriminator, curve, centre, light_noise, light_samples };

[[nodiscard]] RelockProfileFault check(const RelockProfileConfig& config) noexcept;

// What the samples y of one half leave behind: sums over u = 0..1, the time within the half.
struct RelockHalf {
    std::array<double, 4> moments{};  // of y u^p
    double sum_sq = 0.0;              // of y^2
    double rough_sq = 0.0;  // of second differences of y, a sixth of their squares: the noise's, whatever the course
    double weight = 1.0;    // noise variance of the configuration over that of these samples

    friend bool operator==(const RelockHalf&, const RelockHalf&) = default;
};

// The cubic term of a half, as the samples of this half and the later ones decide it: offset + by_state (value, slope,
// curvature at its start), with its variance in units of that of a sample.
struct RelockGain {
    std::array<double, 3> by_state{};
    double offset = 0.0;
    double variance = 0.0;

    friend bool operator==(const RelockGain&, const RelockGain&) = default;
};

// All that later samples say of value, slope and curvature at the start of a half, in units of one sample.
struct RelockInformation {
    std::array<std::array<double, 3>, 3> matrix{};
    std::array<double, 3> vector{};
    double fitted_sq = 0.0;  // of the sum of squares, what is explained already

    friend bool operator==(const RelockInformation&, const RelockInformation&) = default;
};

// Weighted sums over the moments tried so far. Of m_0, m_1 and of value, slope and curvature after one tick:
struct RelockMixture {
    double log_best = 0.0;  // likelihood of the best one, by which the weights are divided
    double weight = 0.0;
    std::array<double, 5> sum{};
    std::array<std::array<double, 5>, 5> sum_sq{};  // of their products
    std::array<std::array<double, 5>, 5> within{};  // of the covariance that each moment leaves

    friend bool operator==(const RelockMixture&, const RelockMixture&) = default;
};

// Sums over the samples that lie after the moment that is tried; w < 0 counts halves until the tick or its first half ends.
struct RelockTail {
    std::array<double, 7> powers{};   // of w^p
    std::array<double, 4> moments{};  // of y w^p
    double before_weight = 0.0;       // of the samples before it
    double before_sum = 0.0;
    std::int32_t n_before = 0;

    friend bool operator==(const RelockTail&, const RelockTail&) = default;
};

// The estimate at the start of a half: value, slope and curvature.
struct RelockLink {
    std::array<double, 3> state{};
    std::array<std::array<double, 3>, 3> within{};   // covariance that the noise leaves
    std::array<std::array<double, 3>, 3> between{};  // covariance from moment to moment

    friend bool operator==(const RelockLink&, const RelockLink&) = default;
};

inline constexpr int max_profile_samples = 64;

struct RelockProfileState {
    bool armed = false;  // a gap has been seen, and this is within its first halves
    std::int32_t n_halves = 0;
    std::int32_t n_samples = 0;      // a half; 0: the light cannot be used
    bool columns_known = false;      // of every half so far
    double noise_sq_lambda2 = 0.0;   // of one sample: as configured, or larger where the samples say so
    double scale_lambda = 0.0;       // size of the detuning at first
    std::array<double, 7> powers{};  // sums of u^p over the samples of a half
    std::array<std::array<double, max_profile_samples>, 2> first_tick_lambda{};  // its samples
    std::array<RelockHalf, profile_halves> halves{};
    RelockInformation information{};
    RelockTail tail{};
    RelockMixture mixture{};
    std::array<RelockGain, profile_halves> gains{};
    RelockLink link{};
    std::array<std::array<double, 3>, profile_halves> with_half{};  // covariance of the link with each half before it
    RelockProfile profile{};

    friend bool operator==(const RelockProfileState&, const RelockProfileState&) = default;
};

// A gap: what was known of the last one is forgotten, and the next half that is taken is the first one after it.
void enter_gap(RelockProfileState& state) noexcept;

// Take one half with the loop closed, in order of time; those beyond the first 16 are ignored.
//
// light    both beams; one beam alone needs the half's recorded mean and has sqrt(2) times the noise; 4..64 samples, as many
//          in each half. Where there is none, or where it is damaged (not finite, dark, stuck, no smooth course), the
//          profile comes from the recorded mean squares, and is known with the 16th half; without these it is not known.
// cost     with the fifth half all moments are tried, with the 16th the profile is smoothed.
void take(const RelockProfileConfig& config, RelockProfileState& state, const HalfRecord& half,
          LightSamples light) noexcept;

}  // namespace zlg::core
