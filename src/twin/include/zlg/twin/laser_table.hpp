#pragma once
// The four-wave laser, tabulated over perimeter and field for use in a loop.
//
// Which waves are lit changes at zone edges, where intensities have kinks and would spoil any interpolation. But the
// balance of one given set of waves is analytic, on both sides of its zone's edges. So each set has a grid of its own,
// read by bicubic interpolation, and the edge is where the interpolated balances change sign: kinks stay sharp.

#include <limits>
#include <memory>

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin {

class LaserGrid;

class LaserTable {
public:
    // max_field_g  the table spans -max_field_g..max_field_g and all perimeters, which repeat after one wavelength,
    // with
    //              the helicities exchanged after half of one.
    // errors       std::invalid_argument as validate(LaserConfig), or max_field_g not within 1e-6..1e5;
    //              std::runtime_error where even the finest grid errs by more than max_error.
    // cost         20 ms to 150 ms, 2 MB to 10 MB; the default gas needs the least.
    LaserTable(const LaserConfig& config, double max_field_g);

    static constexpr double max_error = 1e-4;
    static constexpr double aimed_error = 1e-6;  // the grid is refined until it is met or the finest grid is reached

    // The same as FourWave::at; a field beyond the table is answered by that function itself. No allocation.
    //
    // cost  about 40 ns, some 15 ns more beside a zone edge.
    [[nodiscard]] LaserLight at(double perimeter_lambda, double field_g) const;

    // Largest error found when the table was made, at two points of every cell: intensities in parts of the centre
    // intensity, biases in parts of the near mode's largest bias.
    [[nodiscard]] double error() const { return error_; }

    [[nodiscard]] double max_field_g() const { return max_field_g_; }
    [[nodiscard]] const FourWave& exact() const { return exact_; }

private:
    FourWave exact_;
    double max_field_g_;
    double shift_per_g_;  // in the gas's own unit of frequency
    double error_ = std::numeric_limits<double>::infinity();
    std::shared_ptr<const LaserGrid> grid_;
};

}  // namespace zlg::twin
