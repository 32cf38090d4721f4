#pragma once
// What is drawn for each gyro of a sweep, as a function of the seed of the sweep and the number of the gyro alone.
//
// Every number has an address (zlg/chance/address.hpp) made of the seed, the parameter's keys and the gyro: neither
// order, threads and parts nor other parameters change it. Of latin and grid, all gyros together make the design.

#include <cstdint>
#include <vector>

#include <zlg/sweep/description.hpp>

namespace zlg::sweep {

// run.seed of a gyro: 63 random bits, positive.
[[nodiscard]] std::int64_t gyro_seed(const Description& description, std::int64_t gyro);

class Draws {
public:
    explicit Draws(const Description& description);

    // One value for each parameter, of a gyro in 0..n_gyros-1.
    //
    // grid         gyro k has the point k modulo their number; the last parameter runs fastest
    // list         value k modulo their number
    // uniform      within [min, max); log_uniform: evenly in the logarithm
    // normal       mean and sd; truncated: the same, drawn again until it lies within [min, max]
    // latin        Latin hypercube (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21, 1979, 239): each of
    // n_gyros equal
    //              parts of [min, max) has one gyro, at an even place within
    // sobol        Sobol's sequence with the direction numbers of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30, 2008,
    // 2635), one
    //              dimension for each parameter that is drawn so, in their order; gyro k has the point k in the order
    //              of Gray's code; with sobol_shift the bits of each dimension are added modulo 2 to 64 random ones
    [[nodiscard]] std::vector<Value> values(std::int64_t gyro) const;

private:
    [[nodiscard]] double number(std::size_t parameter, std::int64_t gyro) const;
    [[nodiscard]] double latin(std::size_t parameter, std::int64_t gyro) const;
    [[nodiscard]] std::vector<double> sobol_places(std::int64_t gyro) const;
    [[nodiscard]] static std::vector<std::uint64_t> sobol_point(std::int64_t index, std::size_t n_dimensions);

    Description description_;
    std::vector<std::vector<std::uint32_t>> order_;  // by parameter: of the parts of latin
    std::vector<std::uint64_t> shift_;               // by parameter: of sobol
    std::size_t n_sobol_ = 0;
};

}  // namespace zlg::sweep
