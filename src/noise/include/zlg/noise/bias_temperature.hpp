#pragma once
// How the bias of a gyro, and its scale factor where it is turned, follow the temperature.
//
//   rate = b_0 + b_1 x + ... + b_p x^p + h d + input (s_0 + s_1 x + ... + s_p x^p)
//
// x is the temperature less its mean, d +1 while it rises and -1 while it falls. Generalised least squares over means
// of equal stretches, whose errors are white noise and a random walk, averaged over their ratio by the restricted
// likelihood (Patterson and Thompson, 1971): a bias that walks passes for none of the temperature. p is the highest
// order up to 3 whose own coefficient is above three of its errors.

#include <span>
#include <vector>

#include <zlg/numeric/estimate.hpp>

namespace zlg::noise {

struct TemperatureRecord {
    std::span<const double> rates_arcsec_s;    // NaN: not measured, as in what follows
    std::span<const double> temperature_c;     // as many
    std::span<const double> input_arcsec_s{};  // of a rate table, as many; empty: the gyro stood
};

struct BiasTemperature {
    double mean_c = 0.0, least_c = 0.0, most_c = 0.0;
    std::vector<numeric::Estimate> bias;    // b_k, arcsec/s/C^k, at least up to b_1
    std::vector<numeric::Estimate> scale;   // s_k, 1/C^k, as many; empty where the gyro stood
    numeric::Estimate hysteresis_arcsec_s;  // 2 h: the bias while it warms less that while it cools
    int order = 0;                          // p; 0: it follows no temperature

    // By which the bias differs from that at the mean temperature; 0 where the order is 0.
    [[nodiscard]] double drift_arcsec_s(double temperature_c) const;
};

// errors  deviations::SeriesError: lengths differ, fewer than 16 stretches are known, the temperature does not change.
[[nodiscard]] BiasTemperature bias_temperature(const TemperatureRecord& record);

}  // namespace zlg::noise
