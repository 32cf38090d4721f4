#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gas.hpp"
#include "laser_frame.hpp"

namespace zlg::twin {

// The largest |detuning| of the mode nearest to the line.
inline constexpr double max_near_lambda = 0.25;

// Steady states on a grid of detuning and shift, in the frame of the near mode.
class LaserGrid {
public:
    // max_shift  the grid spans shifts 0..max_shift; negative ones exchange cw and ccw.
    LaserGrid(const Gas& gas, double max_shift, std::size_t n_detuning, std::size_t n_shift);

    // near_lambda  |near_lambda| <= max_near_lambda; shift: |shift| <= max_shift.
    [[nodiscard]] FrameLight at(double near_lambda, double shift) const;

    // Largest differences from the exact state at two points of every cell.
    struct Error {
        double intensity = 0.0;
        double bias_hz = 0.0;
    };
    [[nodiscard]] Error error(const Gas& gas) const;

private:
    // Balance of the four waves, then bias of near and far mode.
    static constexpr std::size_t n_values = n_waves + 2;
    using Node = std::array<double, n_values>;
    using SetsOfWaves = std::uint16_t;  // bit s: the set s of lit waves, 0..15

    // Detunings of one sign: there the far mode lies always on the same side.
    struct Half {
        std::array<std::vector<Node>, 16> grid;  // of each set of waves; empty for a set that is nowhere lit
        std::vector<SetsOfWaves> candidates;     // of each cell
    };

    struct Place {
        std::size_t cell;
        std::size_t first_node;
        std::array<double, 4> detuning_weight;
        std::array<double, 4> shift_weight;
    };

    void fill(Half& half, double sign, const Gas& gas) const;
    [[nodiscard]] std::vector<SetsOfWaves> candidates(const std::vector<unsigned>& lit) const;
    [[nodiscard]] Place place(double detuning_lambda, double shift) const;
    [[nodiscard]] Node read(const std::vector<Node>& grid, const Place& place) const;
    [[nodiscard]] FrameLight state(const Half& half, const Place& place) const;

    std::size_t n_detuning_;  // cells
    std::size_t n_shift_;
    std::size_t shift_nodes_;  // per detuning: one more than cells, and one beyond either end
    double cells_per_lambda_;
    double cells_per_shift_;
    std::array<Half, 2> half_;  // detuning >= 0, < 0
};

}  // namespace zlg::twin
