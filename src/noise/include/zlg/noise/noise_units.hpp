#pragma once
// Noise as data sheets, processors and other tools write it: see docs/noise.md.
//
// Continuous forms are spectra, and do not depend on a sampling rate; discrete forms are what one sample of a given
// rate has. They differ in number and in unit, and so do their names.

#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

// As in a data sheet. 1 deg/h = 1 arcsec/s.
struct DataSheet {
    double quantisation_arcsec = 0.0;
    double angle_random_walk_deg_sqrt_h = 0.0;
    double bias_instability_deg_h = 0.0;  // B; the floor of the Allan deviation is 0.664 B
    double rate_random_walk_deg_h_sqrt_h = 0.0;
    double ramp_deg_h_h = 0.0;
};

[[nodiscard]] DataSheet data_sheet(const NoiseTerms& terms);
[[nodiscard]] NoiseTerms terms_of(const DataSheet& sheet);

// Of one sample at a rate.
struct DiscreteNoise {
    double white_rate_arcsec_s = 0.0;          // standard deviation of the rate's white part: N sqrt(rate)
    double white_increment_arcsec = 0.0;       // of an increment's: N/sqrt(rate)
    double walk_step_arcsec_s = 0.0;           // of the step of the bias from sample to sample: K/sqrt(rate)
    double angle_error_arcsec = 0.0;           // of the quantised angle, white: Q
    double ramp_step_arcsec_s = 0.0;           // R/rate
    std::vector<double> markov_factor;         // b_{k+1} = factor b_k + step: exp(-1/(rate T))
    std::vector<double> markov_step_arcsec_s;  // standard deviation of the step: s sqrt(1 - factor^2)
};

// errors  SeriesError: rate not positive.
[[nodiscard]] DiscreteNoise discrete_noise(const NoiseTerms& terms, double rate_hz);

// The gyro's part of Kalibr's imu.yaml, both continuous.
struct KalibrGyro {
    double noise_density_rad_s_sqrt_hz = 0.0;  // gyroscope_noise_density: N
    double random_walk_rad_s2_sqrt_hz = 0.0;   // gyroscope_random_walk: K
    double update_rate_hz = 0.0;               // update_rate
    bool random_walk_is_limit = false;         // none was found: no more than this
};

// Kalibr's model has two terms; the others are lost.
[[nodiscard]] KalibrGyro kalibr_gyro(const NoiseTerms& terms, double rate_hz);

}  // namespace zlg::noise
