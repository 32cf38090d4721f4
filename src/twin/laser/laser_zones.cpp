#include <zlg/twin/laser_zones.hpp>

#include <cmath>
#include <cstddef>

#include "refusal.hpp"

namespace zlg::twin {
namespace {

constexpr double scan_step_lambda = 1e-4;
constexpr double edge_width_lambda = 1e-9;

struct Sample {
    double at_lambda;
    unsigned lit;
};

// Halves the stretch from the last zone's end to `b` until every change of light is an edge; a zone between two
// others comes out of it as well.
void add_edges(const FourWave& laser, double field_g, Sample a, Sample b, std::vector<LaserZone>& zones) {
    if (a.lit == b.lit) return;
    const double middle = 0.5 * (a.at_lambda + b.at_lambda);
    if (b.at_lambda - a.at_lambda <= edge_width_lambda) {
        zones.back().to_lambda = middle;
        zones.push_back({middle, middle, b.lit});
        return;
    }
    const Sample m{middle, laser.at(middle, field_g).lit()};
    add_edges(laser, field_g, a, m, zones);
    add_edges(laser, field_g, m, b, zones);
}

}  // namespace

std::vector<LaserZone> laser_zones(const FourWave& laser, double field_g, double from_lambda, double to_lambda) {
    require_within("laser zones: field_g", field_g, -1e5, 1e5);
    require_within("laser zones: from_lambda", from_lambda, -1e6, 1e6);
    require_within("laser zones: to_lambda - from_lambda", to_lambda - from_lambda, edge_width_lambda, 10.0);
    const auto n = static_cast<std::size_t>(std::ceil((to_lambda - from_lambda) / scan_step_lambda));
    const double step = (to_lambda - from_lambda) / static_cast<double>(n);
    Sample last{from_lambda, laser.at(from_lambda, field_g).lit()};
    std::vector<LaserZone> zones{{from_lambda, from_lambda, last.lit}};
    for (std::size_t k = 1; k <= n; ++k) {
        const double at_lambda = from_lambda + static_cast<double>(k) * step;
        const Sample next{at_lambda, laser.at(at_lambda, field_g).lit()};
        add_edges(laser, field_g, last, next, zones);
        last = next;
    }
    zones.back().to_lambda = to_lambda;
    return zones;
}

}  // namespace zlg::twin
