#pragma once

#include <array>

namespace zlg::twin {

inline constexpr int n_waves = 4;

// Waves that share a gas:  dI_i/dt ~ I_i (net_gain_i - sum_j saturation_ij I_j).
struct Competition {
    std::array<double, n_waves> net_gain{};                         // of the unsaturated gas, less the loss
    std::array<std::array<double, n_waves>, n_waves> saturation{};  // symmetric, positive semidefinite
};

// A state in which exactly the waves of `lit` (bit i: wave i) have their gain saturated to zero.
//
// value  lit wave: its intensity, negative where it could not live; dark wave: the intensity that its spare gain would
//        feed if it were alone, positive where it would grow.
// margin of the worst wave; the state is the steady one where it is >= 0.
struct Balance {
    unsigned lit = 0;
    std::array<double, n_waves> value{};
};

inline double margin(unsigned lit, const double* value) {
    double worst = lit & 1U ? value[0] : -value[0];
    for (unsigned i = 1; i < n_waves; ++i) {
        const double mine = lit >> i & 1U ? value[i] : -value[i];
        if (mine < worst) worst = mine;
    }
    return worst;
}

// The balance of a given set, whose entries are analytic in gains and saturations.
//
// return  false where the set's matrix is singular: its waves then saturate each other exactly as themselves.
[[nodiscard]] bool balance_of(const Competition& competition, unsigned lit, Balance& balance);

// The steady state: the solution of the linear complementarity problem
//
//   I_i >= 0,  net_gain_i - sum_j saturation_ij I_j <= 0,  one of both zero for every i
//
// which is unique, stable and reached from any start where the matrix is positive definite. Found among the 16 sets.
// cost  0.2 us to 1 us.
[[nodiscard]] Balance steady_state(const Competition& competition);

}  // namespace zlg::twin
