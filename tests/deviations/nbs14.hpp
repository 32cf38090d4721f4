#pragma once
// The two test sets of rates of NBS Monograph 140, Annex 8.E, and NIST Special Publication 1065, section 12.4.

#include "test.hpp"

namespace zlg::deviations {

inline std::vector<double> nbs14_small() { return {892.0, 809.0, 823.0, 798.0, 671.0, 644.0, 883.0, 903.0, 677.0}; }

// n_{i+1} = 16807 n_i mod 2147483647, n_0 = 1234567890, each over the modulus.
inline std::vector<double> nbs14_large() {
    std::vector<double> rates;
    std::uint64_t n = 1234567890;
    for (int k = 0; k < 1000; ++k) {
        rates.push_back(static_cast<double>(n) / 2147483647.0);
        n = n * 16807 % 2147483647;
    }
    return rates;
}

}  // namespace zlg::deviations
