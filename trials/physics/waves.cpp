// What the four-wave laser gives at one field: light of the four waves, zones, bias.

#include <algorithm>
#include <bit>
#include <cmath>

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/laser_zones.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using namespace report;

constexpr double field_g = 15.0;

std::string name_of(const twin::LaserZone& zone) {
    if (zone.dark()) return "dark";
    const int n = std::popcount(static_cast<unsigned>(zone.lit));
    if (zone.one_way()) return "one way";
    if (n == 2) return zone.lit == 3U ? "2: left" : "2: right";
    return fmt::format("{}", n);
}

// The curves have their kinks at the ends of zones, so that is where points must lie.
std::vector<double> places(const std::vector<twin::LaserZone>& zones, double step) {
    std::vector<double> at;
    for (const twin::LaserZone& zone : zones) {
        const int n = std::max(1, static_cast<int>(std::ceil((zone.to_lambda - zone.from_lambda) / step)));
        for (int k = 0; k <= n; ++k) at.push_back(zone.from_lambda + (zone.to_lambda - zone.from_lambda) * k / n);
    }
    return at;
}

}  // namespace

void add_waves(PhysicsPictures& made) {
    const twin::FourWave laser{twin::LaserConfig{}};
    const auto zones = twin::laser_zones(laser, field_g, 0.0, 0.5);
    Figure figure{.id = "waves",
                  .title = "Light of the four waves",
                  .caption =
                      "Steady intensities from the centre of a left mode to that of the next right one, at a "
                      "field of 15 G. The shades are the zones with the same waves lit.",
                  .x_label = "perimeter from the centre of a left mode, wavelengths",
                  .y_label = "intensity, parts of the centre intensity without field",
                  .series = {blank_series("left cw"), blank_series("left ccw"), blank_series("right cw"),
                             blank_series("right ccw")}};
    for (const double p : places(zones, 0.004)) {
        const twin::LaserLight light = laser.at(p, field_g);
        const double values[] = {light.left.cw, light.left.ccw, light.right.cw, light.right.ccw};
        for (std::size_t i = 0; i < 4; ++i) add_point(figure.series[i], p, values[i] / laser.centre_intensity());
    }
    for (const twin::LaserZone& zone : zones) figure.bands.push_back({zone.from_lambda, zone.to_lambda, name_of(zone)});
    made.pictures.push_back({"waves", {std::move(figure)}});

    std::vector<double> edges;
    for (std::size_t k = 1; k < zones.size(); ++k) edges.push_back(zones[k].from_lambda);
    read(made, "edges of the zones at 15 G: from 2 waves to 3, 4, 3, 2", edges, 4, "wavelength");
    const twin::LaserTable table{twin::LaserConfig{}, field_g};
    made.readings.push_back({"error of the table", fmt::format("{:.1e}", table.error()), "parts"});
}

void add_bias(PhysicsPictures& made) {
    const twin::FourWave laser{twin::LaserConfig{}};
    const twin::AveragedLaser law = twin::averaged_laser(laser, field_g);
    Figure bias{.id = "bias",
                .title = "Bias against detuning",
                .caption = "The bias of a left mode at 15 G and the parabola fitted to it within 0.1 wavelength.",
                .x_label = "detuning of the left mode, wavelengths",
                .y_label = "bias, kHz",
                .series = {blank_series("four waves"), blank_series("f0 (1 - chi dl^2)", Mark::line, true)}};
    Figure residual{.id = "bias-rest",
                    .title = "What the parabola leaves",
                    .caption = "Bias less parabola, in parts of the bias at the centre.",
                    .x_label = "detuning of the left mode, wavelengths",
                    .y_label = "bias less parabola, % of f0",
                    .series = {blank_series("")}};
    double worst = 0.0;
    for (int k = -100; k <= 100; ++k) {
        const double dl = 0.0025 * k;
        const double bias_hz = laser.at(dl, field_g).left.bias_hz;
        const double parabola_hz = law.bias_hz * (1.0 - law.bias_chi * dl * dl);
        add_point(bias.series[0], dl, 1e-3 * bias_hz);
        add_point(bias.series[1], dl, 1e-3 * parabola_hz);
        add_point(residual.series[0], dl, 100.0 * (bias_hz - parabola_hz) / law.bias_hz);
        if (std::abs(dl) <= 0.2) worst = std::max(worst, std::abs(bias_hz - parabola_hz) / law.bias_hz);
    }
    made.pictures.push_back({"bias", {std::move(bias), std::move(residual)}});
    read(made, "chi, fitted within 0.1 wavelength", {law.bias_chi}, 3, "1/wavelength^2");
    read(made, "largest departure of the bias from that parabola within 0.2 wavelength", {100.0 * worst}, 2, "% of f0");
}

}  // namespace zlg::trials
