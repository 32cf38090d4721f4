#pragma once
// What the estimate of the detuning after a gap remembers, and what it finds.

#include <array>
#include <cstdint>

#include <zlg/core/records.hpp>

namespace zlg::core {

inline constexpr int profile_halves = 16;  // after the loop is closed

// Mean square detuning, from that of the largest bias, of the first halves after a gap, with the covariance of their
// errors.
struct RelockProfile {
    bool known = false;
    std::array<double, profile_halves> mean_sq_lambda2{};  // without that of the noise
    std::array<std::array<double, profile_halves>, profile_halves> covariance_lambda4{};

    friend bool operator==(const RelockProfile&, const RelockProfile&) = default;
};

// What the samples y of one half leave behind: sums over u = 0..1, the time within the half.
struct RelockHalf {
    std::array<double, 4> moments{};  // of y u^p
    double sum_sq = 0.0;              // of y^2
    double rough_sq = 0.0;  // sum of squared second differences of y over 6: of the noise alone, however dl changes
    double weight = 1.0;    // noise variance of the configuration over that of these samples

    friend bool operator==(const RelockHalf&, const RelockHalf&) = default;
};

// The cubic term of a half, as the samples of this half and the later ones decide it: offset + by_state (value, slope,
// half the second derivative at its start), with its variance in units of that of a sample.
struct RelockGain {
    std::array<double, 3> by_state{};
    double offset = 0.0;
    double variance = 0.0;

    friend bool operator==(const RelockGain&, const RelockGain&) = default;
};

// Information of this and later samples on z at the start of a half, in units of the information of one sample: the
// log-likelihood is -(z^T matrix z - 2 vector^T z)/(2 sigma^2) + const.
struct RelockInformation {
    std::array<std::array<double, 3>, 3> matrix{};
    std::array<double, 3> vector{};
    double fitted_sq = 0.0;  // part of the sum of squares that the eliminated cubic terms explain

    friend bool operator==(const RelockInformation&, const RelockInformation&) = default;
};

// Weighted sums over the onsets so far, of the five numbers m_0, m_1 and z after the first tick.
struct RelockMixture {
    double log_best = 0.0;  // log-likelihood of the best onset, by whose likelihood the weights are divided
    double weight = 0.0;
    std::array<double, 5> sum{};
    std::array<std::array<double, 5>, 5> sum_sq{};  // of their products
    std::array<std::array<double, 5>, 5> within{};  // of their covariance for a given onset

    friend bool operator==(const RelockMixture&, const RelockMixture&) = default;
};

// Sums over the samples after an onset; w < 0 counts halves until the tick, or its first half, ends.
struct RelockTail {
    std::array<double, 7> powers{};   // of w^p
    std::array<double, 4> moments{};  // of y w^p
    double before_weight = 0.0;       // of the samples before it
    double before_sum = 0.0;
    std::int32_t n_before = 0;

    friend bool operator==(const RelockTail&, const RelockTail&) = default;
};

// Smoothed estimate of z at the start of a half.
struct RelockLink {
    std::array<double, 3> state{};
    std::array<std::array<double, 3>, 3> within{};   // covariance by the noise, averaged over the onsets
    std::array<std::array<double, 3>, 3> between{};  // covariance of the estimates over the onsets

    friend bool operator==(const RelockLink&, const RelockLink&) = default;
};

struct RelockProfileState {
    bool armed = false;  // a gap has been seen, and this is within its first halves
    std::int32_t n_halves = 0;
    std::int32_t n_samples = 0;      // a half; 0: the light cannot be used
    bool columns_known = false;      // of every half so far
    double noise_sq_lambda2 = 0.0;   // of one sample: as configured, or larger where the samples say so
    double scale_lambda = 0.0;       // size of the detuning at first
    std::array<double, 7> powers{};  // sums of u^p over the samples of a half
    std::array<std::array<double, max_light_samples>, 2> first_tick_lambda{};  // its samples
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

}  // namespace zlg::core
