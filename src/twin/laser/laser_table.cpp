#include <zlg/twin/laser_table.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "gas.hpp"
#include "laser_frame.hpp"
#include "laser_grid.hpp"
#include "refusal.hpp"

namespace zlg::twin {
namespace {

// The coarsest grid; each refinement halves its steps.
constexpr std::size_t first_n_detuning = 50;
constexpr double first_shift_step_hz = 2e6;
constexpr std::size_t max_cells = 60'000;

}  // namespace

LaserTable::LaserTable(const LaserConfig& config, double max_field_g)
    : exact_{config}, max_field_g_{max_field_g}, shift_per_g_{config.zeeman_hz_per_g / config.doppler_half_width_hz} {
    if (!(max_field_g >= 1e-6 && max_field_g <= 1e5))
        refuse("laser table: laser.bias_field_g", max_field_g, "1e-6..1e5");
    const Gas gas{config};
    const double max_shift = gas.shift_of(max_field_g);
    if (!(max_shift >= 1e-12)) {
        refuse("laser table: laser.zeeman_hz_per_g", config.zeeman_hz_per_g,
               fmt::format("a shift of 1e-12 Doppler widths or more at {} G", max_field_g));
    }
    const double largest_bias_hz = std::abs(gas.at(0.0, -0.5, max_shift).near_bias_hz);
    const auto parts = [](double error, double whole) { return whole > 0.0 ? error / whole : error; };
    auto n_detuning = first_n_detuning;
    auto n_shift = static_cast<std::size_t>(std::ceil(max_field_g * config.zeeman_hz_per_g / first_shift_step_hz)) + 1;
    for (; !(error_ <= aimed_error) && n_detuning * n_shift <= max_cells; n_detuning *= 2, n_shift *= 2) {
        grid_ = std::make_shared<const LaserGrid>(gas, max_shift, n_detuning, n_shift);
        const LaserGrid::Error error = grid_->error(gas);
        error_ = std::max(parts(error.intensity, exact_.centre_intensity()), parts(error.bias_hz, largest_bias_hz));
    }
    if (grid_ == nullptr) {
        throw std::runtime_error(fmt::format("laser table: {} G need {} x {} cells, allowed are {}", max_field_g,
                                             n_detuning, n_shift, max_cells));
    }
    if (!(error_ <= max_error)) {
        throw std::runtime_error(
            fmt::format("laser table: error is {:.2g} of the centre intensity on the finest grid, allowed is {:.2g}",
                        error_, max_error));
    }
}

LaserLight LaserTable::at(double perimeter_lambda, double field_g) const {
    if (!(std::abs(field_g) <= max_field_g_)) return exact_.at(perimeter_lambda, field_g);
    const LaserFrame frame{perimeter_lambda, field_g};
    return frame.light(grid_->at(frame.near_lambda, frame.field_g * shift_per_g_));
}

}  // namespace zlg::twin
