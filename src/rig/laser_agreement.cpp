#include <zlg/rig/laser_agreement.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

// What is given may differ by so much from what the laser makes before it is named.
//
// 5 % of chi is 2 arcsec of a false angle of 40, half of what it may err by. Of rings in use the circle encloses most,
// the triangle least of a square of the same perimeter.
constexpr double bias_tolerance = 0.02;
constexpr double chi_tolerance = 0.05;
constexpr double slope_tolerance = 0.05;
constexpr double scale_tolerance = 0.31;
constexpr double centre_tolerance = 0.1;
constexpr double walk_tolerance = 0.05;

// K = 4 lambda/L of a square ring, by the default gyro, over the counts of a fringe.
double scale_of_square(const config::Config& config) {
    const double per_fringe = config::Gyro{}.scale_arcsec * config::Laser{}.perimeter_m / config.laser.perimeter_m;
    return per_fringe / counts_per_turn(config.laser.quadrature);
}

// (K/2 pi) delta/sqrt(T) with delta = 2 pi f_L sqrt(t_e/(2 f0)), and quantum noise: docs/physics.md.
double walk_of_laser(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    const int counts = counts_per_turn(config.laser.quadrature);
    const double lock_hz =
        core::maths::hypot(config.laser.lock_in_left_hz, config.laser.lock_in_right_hz) / std::numbers::sqrt2;
    const double slips = lock_hz * std::sqrt(0.5 * g.bias_edge_s * counts / g.bias_hz / g.tick_s);
    return g.scale_arcsec * counts * core::maths::hypot(slips, twin::quantum_walk_turns(config.laser));
}

}  // namespace

LaserAgreement agreed_with_laser(const config::Config& config) {
    LaserAgreement made{.config = config};
    if (config.gyro.fidelity != config::Fidelity::laser) return made;
    const config::Config by_laser = calibrated_by_laser(config);
    config::Gyro& gyro = made.config.gyro;
    config::Perimeter& perimeter = made.config.perimeter;
    std::string list;
    const auto add = [&list](std::string what) { list += (list.empty() ? "" : ", ") + std::move(what); };
    const auto take = [&](const char* key, double& value, double its, double tolerance) {
        if (!config::is_given(config, key)) {
            value = its;
            add(fmt::format("{} = {:.6g}", key, its));
        } else if (!(std::abs(value / its - 1.0) <= tolerance)) {
            made.warnings.push_back(fmt::format("{} = {:.6g} is presumed, [laser] makes {:.6g}", key, value, its));
        }
    };
    take("gyro.bias_hz", gyro.bias_hz, by_laser.gyro.bias_hz, bias_tolerance);
    take("gyro.bias_chi", gyro.bias_chi, by_laser.gyro.bias_chi, chi_tolerance);
    take("gyro.discriminator_per_lambda", gyro.discriminator_per_lambda, by_laser.gyro.discriminator_per_lambda,
         slope_tolerance);
    if (const double scale = scale_of_square(config); scale != gyro.scale_arcsec)
        take("gyro.scale_arcsec", gyro.scale_arcsec, scale, scale_tolerance);
    // A slope that is given without points is the whole law.
    if (perimeter.discriminator_signal.empty() && !config::is_given(config, "gyro.discriminator_per_lambda")) {
        perimeter.discriminator_detuning_lambda = by_laser.perimeter.discriminator_detuning_lambda;
        perimeter.discriminator_signal = by_laser.perimeter.discriminator_signal;
        add("perimeter.discriminator_signal");
    }
    // The detunings of the points count from where the loop settles, and so does the place of the largest bias.
    if (by_laser.perimeter.discriminator_centre_lambda != perimeter.discriminator_centre_lambda)
        take("perimeter.discriminator_centre_lambda", perimeter.discriminator_centre_lambda,
             by_laser.perimeter.discriminator_centre_lambda, centre_tolerance);
    // Where every other constant is given, the given random walk stays too.
    if (list.empty()) return made;
    const double walk = walk_of_laser(made.config);
    double& presumed = made.config.drift.random_walk_arcsec_sqrt_s;
    if (std::abs(walk - presumed) > walk_tolerance * presumed)
        take("drift.random_walk_arcsec_sqrt_s", presumed, walk, std::numeric_limits<double>::infinity());
    made.notes.push_back(fmt::format("gyro.fidelity = laser: what is not given is taken from [laser]: {}", list));
    return made;
}

}  // namespace zlg::rig
