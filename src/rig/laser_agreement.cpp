#include <zlg/rig/laser_agreement.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

// 5 % of chi is 2 arcsec of a false angle of 40, half of what it may err by.
constexpr double bias_tolerance = 0.02;
constexpr double chi_tolerance = 0.05;
constexpr double slope_tolerance = 0.05;
constexpr double reading_tolerance_lambda = 0.01;
// Such a miss is 0.08 wavelength, and leaves in 3.5 ticks of an exponential loop 2 arcsec for this much of the centre.
constexpr double centre_tolerance_lambda = 0.001;
constexpr auto centre_key = "perimeter.discriminator_centre_lambda";
// The circle encloses most, the triangle least of the rings in use; of a square of the same perimeter.
constexpr double min_scale = 0.25 * std::numbers::pi * 0.995;
constexpr double max_scale = 0.75 * std::numbers::sqrt3 * 1.005;

// Two constants of one key, and whether they agree.
struct Comparison {
    const char* key;
    double presumed;
    double by_laser;
    double min_ratio;
    double max_ratio;

    [[nodiscard]] bool agrees() const {
        const double ratio = presumed / by_laser;
        return ratio >= min_ratio && ratio <= max_ratio;
    }
};

Comparison within(const char* key, double presumed, double by_laser, double tolerance) {
    return {key, presumed, by_laser, 1.0 - tolerance, 1.0 + tolerance};
}

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

std::vector<Comparison> comparisons(const config::Config& presumed, const config::Config& by_laser) {
    const config::Gyro& mine = presumed.gyro;
    const config::Gyro& its = by_laser.gyro;
    return {within("gyro.bias_hz", mine.bias_hz, its.bias_hz, bias_tolerance),
            within("gyro.discriminator_per_lambda", mine.discriminator_per_lambda, its.discriminator_per_lambda,
                   slope_tolerance),
            {"gyro.scale_arcsec", mine.scale_arcsec, its.scale_arcsec, min_scale, max_scale}};
}

// Largest error, up to a detuning, of what the processor reads from light of a known curve.
double reading_error_lambda(const config::Config& presumed, const config::Perimeter& light, double to_lambda) {
    const double slope = presumed.gyro.discriminator_per_lambda;
    const core::DiscriminatorCurve curve = discriminator_curve(presumed, slope);
    double worst_lambda = 0.0;
    for (std::size_t k = 0; k < light.discriminator_signal.size(); ++k) {
        const double dl = light.discriminator_detuning_lambda[k];
        if (std::abs(dl) > to_lambda) continue;
        const double read = core::true_detuning(curve, light.discriminator_signal[k] / slope).detuning_lambda;
        worst_lambda = std::max(worst_lambda, std::abs(read - dl));
    }
    return worst_lambda;
}

// The tolerance of a bias that is no parabola is that of the paper's.
bool losses_agree(const config::Gyro& mine, const config::Gyro& its, double to_lambda) {
    const bool is_parabola = its.bias_chi_higher.empty();
    const double chi = is_parabola ? std::abs(its.bias_chi) : config::Gyro{}.bias_chi;
    for (int k = 1; k <= 10; ++k) {
        const double dl = 0.1 * k * to_lambda;
        const double off = is_parabola ? (mine.bias_chi - its.bias_chi) * dl * dl : loss(mine, dl) - loss(its, dl);
        if (!(std::abs(off) <= chi_tolerance * chi * dl * dl)) return false;
    }
    return true;
}

std::string curve_contradiction(const config::Config& presumed, double error_lambda) {
    return fmt::format("perimeter.discriminator_signal {}: it misreads the light of [laser] by up to {:.2g} wavelength",
                       presumed.perimeter.discriminator_signal.empty() ? "is unset" : "is presumed", error_lambda);
}

bool centres_agree(const config::Config& presumed, const config::Config& by_laser) {
    return std::abs(presumed.perimeter.discriminator_centre_lambda - by_laser.perimeter.discriminator_centre_lambda) <=
           centre_tolerance_lambda;
}

void take_missing(const config::Config& by_laser, LaserAgreement& made) {
    config::Config& c = made.config;
    std::string list;
    const auto take = [&](const char* key, double& value, double its) {
        if (config::is_given(made.config, key)) return;
        value = its;
        list += fmt::format("{}{} = {:.6g}", list.empty() ? "" : ", ", key, its);
    };
    const bool takes_higher = !by_laser.gyro.bias_chi_higher.empty() && !config::is_given(c, "gyro.bias_chi");
    take("gyro.bias_hz", c.gyro.bias_hz, by_laser.gyro.bias_hz);
    take("gyro.bias_chi", c.gyro.bias_chi, by_laser.gyro.bias_chi);
    if (takes_higher) {
        c.gyro.bias_chi_higher = by_laser.gyro.bias_chi_higher;
        list += fmt::format("{}gyro.bias_chi_higher", list.empty() ? "" : ", ");
    }
    take("gyro.discriminator_per_lambda", c.gyro.discriminator_per_lambda, by_laser.gyro.discriminator_per_lambda);
    if (by_laser.gyro.scale_arcsec != c.gyro.scale_arcsec)
        take("gyro.scale_arcsec", c.gyro.scale_arcsec, by_laser.gyro.scale_arcsec);
    if (c.perimeter.discriminator_signal.empty()) {
        c.perimeter.discriminator_detuning_lambda = by_laser.perimeter.discriminator_detuning_lambda;
        c.perimeter.discriminator_signal = by_laser.perimeter.discriminator_signal;
        list += fmt::format("{}perimeter.discriminator_signal", list.empty() ? "" : ", ");
    }
    // The detunings of the points count from where the loop settles, and so does the place of the largest bias.
    if (by_laser.perimeter.discriminator_centre_lambda != c.perimeter.discriminator_centre_lambda)
        take(centre_key, c.perimeter.discriminator_centre_lambda, by_laser.perimeter.discriminator_centre_lambda);
    // Where every other constant is given, the given random walk stays too.
    if (list.empty()) return;
    const double walk = walk_of_laser(c);
    if (std::abs(walk - c.drift.random_walk_arcsec_sqrt_s) > 0.05 * c.drift.random_walk_arcsec_sqrt_s)
        take("drift.random_walk_arcsec_sqrt_s", c.drift.random_walk_arcsec_sqrt_s, walk);
    made.notes.push_back(fmt::format("gyro.fidelity = laser: what is not given is taken from [laser]: {}", list));
}

void agree(LaserAgreement& made) {
    const LaserCalibration calibration = calibration_of_laser(made.config);
    config::Config by_laser = calibration.config;
    by_laser.gyro.scale_arcsec = scale_of_square(made.config);
    std::vector<std::string> off;
    bool is_contradicted = false;
    for (const Comparison& c : comparisons(made.config, by_laser)) {
        if (c.agrees()) continue;
        off.push_back(fmt::format("{} = {:.6g} is presumed, [laser] makes {:.6g}", c.key, c.presumed, c.by_laser));
        is_contradicted = is_contradicted || config::is_given(made.config, c.key);
    }
    const config::Gyro& mine = made.config.gyro;
    if (!losses_agree(mine, by_laser.gyro, calibration.third_wave_lambda)) {
        off.push_back(fmt::format("gyro.bias_chi = {:.6g} is presumed, [laser] makes {:.6g}{}", mine.bias_chi,
                                  by_laser.gyro.bias_chi,
                                  by_laser.gyro.bias_chi_higher.empty() ? "" : " and gyro.bias_chi_higher"));
        is_contradicted = is_contradicted || config::is_given(made.config, "gyro.bias_chi") ||
                          config::is_given(made.config, "gyro.bias_chi_higher");
    }
    if (!mine.bias_chi_higher.empty() && by_laser.gyro.bias_chi_higher.empty()) {
        off.emplace_back("gyro.bias_chi_higher is presumed, [laser] makes none");
        is_contradicted = true;
    }
    // A third wave bends the curve where readings are good for their sign only.
    const double error_lambda = reading_error_lambda(made.config, by_laser.perimeter, calibration.third_wave_lambda);
    if (error_lambda > reading_tolerance_lambda) {
        off.push_back(curve_contradiction(made.config, error_lambda));
        // A slope that is given without points is the whole law.
        is_contradicted = is_contradicted || !made.config.perimeter.discriminator_signal.empty() ||
                          config::is_given(made.config, "gyro.discriminator_per_lambda");
    }
    if (!centres_agree(made.config, by_laser)) {
        off.push_back(fmt::format("{} = {:.6g} is presumed, [laser] makes {:.6g}", centre_key,
                                  made.config.perimeter.discriminator_centre_lambda,
                                  by_laser.perimeter.discriminator_centre_lambda));
        is_contradicted = is_contradicted || config::is_given(made.config, centre_key);
    }
    if (!is_contradicted) {
        take_missing(by_laser, made);
        return;
    }
    for (std::string& line : off) made.warnings.push_back(std::move(line));
    made.warnings.emplace_back(
        "the processor is calibrated for another laser, and nothing is taken from [laser]: zlg calibrate --from-laser "
        "writes what agrees");
}

// Linear up to its limit on both sides, and the bias largest where the loop settles: the light of the averaged gyro.
void examine_linear(LaserAgreement& made) {
    const double centre_lambda = made.config.perimeter.discriminator_centre_lambda;
    if (std::abs(centre_lambda) > centre_tolerance_lambda)
        made.warnings.push_back(
            fmt::format("{} = {:.6g} is presumed, but the bias of gyro.fidelity = averaged is largest at 0", centre_key,
                        centre_lambda));
    if (made.config.perimeter.discriminator_signal.empty()) return;
    config::Perimeter light;
    for (int k = -20; k <= 20; ++k) {
        light.discriminator_detuning_lambda.push_back(0.01 * k);
        light.discriminator_signal.push_back(made.config.gyro.discriminator_per_lambda * 0.01 * k);
    }
    const double error_lambda = reading_error_lambda(made.config, light, 0.205);
    if (error_lambda > reading_tolerance_lambda)
        made.warnings.push_back(fmt::format(
            "perimeter.discriminator_signal is presumed, but the light of gyro.fidelity = averaged follows the "
            "slope gyro.discriminator_per_lambda = {:.6g} alone: it is misread by up to {:.2g} wavelength",
            made.config.gyro.discriminator_per_lambda, error_lambda));
}

}  // namespace

LaserAgreement agreed_with_laser(const config::Config& config) {
    LaserAgreement made{.config = config};
    if (config.gyro.fidelity == config::Fidelity::laser)
        agree(made);
    else
        examine_linear(made);
    return made;
}

}  // namespace zlg::rig
