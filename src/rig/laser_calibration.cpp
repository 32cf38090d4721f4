#include <zlg/rig/laser_calibration.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/discriminator_range.hpp>
#include <zlg/twin/four_wave.hpp>
#include <zlg/twin/laser_zones.hpp>

namespace zlg::rig {
namespace {

// Nodes up to the detuning at which a third wave bends the curve, and beyond, closest at the bend on both sides.
constexpr int n_before_kink = 20;
constexpr int n_beyond_kink = 11;
static_assert(n_before_kink + n_beyond_kink == core::max_side_nodes);

std::vector<double> nodes(double kink_lambda, double max_lambda) {
    const double first = std::min(kink_lambda, max_lambda);
    std::vector<double> at;
    for (int k = 1; k <= n_before_kink; ++k)
        at.push_back(first * core::maths::sin(0.5 * std::numbers::pi * k / n_before_kink));
    if (!(max_lambda > first)) return at;
    for (int k = 1; k <= n_beyond_kink; ++k) {
        at.push_back(first + (max_lambda - first) * k * k / (n_beyond_kink * n_beyond_kink));
    }
    return at;
}

// Signal and bias about the place where the loop settles, which unequal isotopes move away from the middle; the bias is
// then largest at yet another one.
class Settled {
public:
    Settled(const twin::FourWave& laser, double field_g, const twin::AveragedLaser& averaged)
        : laser_{laser}, field_g_{field_g}, settled_lambda_{averaged.settled_lambda}, chi_{averaged.bias_chi} {
        if (settled_lambda_ != 0.0) vertex_lambda_ = largest_bias();
        max_bias_hz_ = bias_hz(vertex_lambda_);
        centre_lambda_ = 0.0 - from_centre(0.0);
    }

    [[nodiscard]] double signal(double dl) const { return light(dl).discriminator(); }
    [[nodiscard]] double max_bias_hz() const { return max_bias_hz_; }
    // Of the largest bias, on the scale of `detuning`.
    [[nodiscard]] double centre_lambda() const { return centre_lambda_; }
    // Detuning on the scale on which chi (detuning - centre)^2 is the relative loss of the bias.
    [[nodiscard]] double detuning(double dl) const { return centre_lambda_ + from_centre(dl); }

private:
    [[nodiscard]] twin::LaserLight light(double dl) const { return laser_.at(settled_lambda_ + dl, field_g_); }
    [[nodiscard]] double bias_hz(double dl) const { return light(dl).left.bias_hz; }

    [[nodiscard]] double from_centre(double dl) const {
        if (dl == vertex_lambda_) return 0.0;
        const double deficit = std::max(0.0, 1.0 - bias_hz(dl) / max_bias_hz_);
        return std::copysign(std::sqrt(deficit / chi_), dl - vertex_lambda_);
    }

    // The root of the slope of a bias that is a parabola, nearly: far more exact than the place of its highest value.
    [[nodiscard]] double largest_bias() const {
        constexpr double step = 1e-3;
        const auto rises = [&](double dl) { return bias_hz(dl + step) > bias_hz(dl - step); };
        double low = -farthest_lambda;
        double high = farthest_lambda;
        while (high - low > 1e-9) {
            const double middle = 0.5 * (low + high);
            (rises(middle) ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    static constexpr double farthest_lambda = 0.1;

    const twin::FourWave& laser_;
    double field_g_;
    double settled_lambda_;
    double chi_;
    double vertex_lambda_ = 0.0;
    double max_bias_hz_ = 0.0;
    double centre_lambda_ = 0.0;
};

// From the middle of the mode to the first wave of the other one on this side.
double third_wave_lambda(const twin::FourWave& laser, double field_g, double sign) {
    constexpr double quarter = 0.25;
    double nearest = quarter;
    for (const twin::LaserZone& zone : twin::laser_zones(laser, field_g, -quarter, quarter)) {
        const double inner = sign > 0.0 ? zone.from_lambda : -zone.to_lambda;
        const double outer = sign > 0.0 ? zone.to_lambda : -zone.from_lambda;
        if (zone.right_lit() && outer > 0.0) nearest = std::min(nearest, std::max(0.0, inner));
    }
    return nearest;
}

// Of one side, outwards: what the curve is fitted to, and where a third wave bends it.
struct Side {
    double sign;
    double kink_lambda;
    double max_lambda;
};

void add_nodes(const Settled& laser, const Side& side, config::Perimeter& perimeter) {
    for (const double dl : nodes(side.kink_lambda, side.max_lambda)) {
        perimeter.discriminator_detuning_lambda.push_back(laser.detuning(side.sign * dl));
        perimeter.discriminator_signal.push_back(laser.signal(side.sign * dl));
    }
}

// Largest error of the curve between two detunings of a side.
double curve_error_lambda(const config::Config& config, const Settled& laser, double from_lambda, double to_lambda) {
    constexpr int n_probes = 150;
    const double slope = config.gyro.discriminator_per_lambda;
    const core::DiscriminatorCurve curve = discriminator_curve(config, slope);
    double worst_lambda = 0.0;
    for (int k = 0; k < n_probes; ++k) {
        const double dl = from_lambda + (to_lambda - from_lambda) * (k + 0.5) / n_probes;
        const double read = core::true_detuning(curve, laser.signal(dl) / slope).detuning_lambda;
        worst_lambda = std::max(worst_lambda, std::abs(read - laser.detuning(dl)));
    }
    return worst_lambda;
}

LaserCalibration calibrate(const config::Config& config) {
    LaserCalibration made{.config = config};
    const twin::FourWave laser{config.laser};
    const double field_g = config.laser.bias_field_g;
    const twin::AveragedLaser averaged = twin::averaged_laser(laser, field_g);
    const twin::GyroConfig equivalent = twin::with_laser(config.gyro, config.laser.quadrature, averaged);
    made.config.gyro.bias_hz = equivalent.bias_hz;
    made.config.gyro.bias_chi = equivalent.bias_chi;
    made.config.gyro.bias_chi_higher.clear();
    made.config.gyro.discriminator_per_lambda = equivalent.discriminator_per_lambda;

    const Settled settled{laser, field_g, averaged};
    made.config.gyro.bias_hz *= settled.max_bias_hz() / averaged.bias_hz;
    const twin::DiscriminatorRange range = twin::discriminator_range(laser, field_g);
    const double at = averaged.settled_lambda;
    const Side above{1.0, third_wave_lambda(laser, field_g, 1.0) - at, range.max_detuning_lambda - at};
    const Side below{-1.0, third_wave_lambda(laser, field_g, -1.0) + at, at - range.min_detuning_lambda};
    config::Perimeter& perimeter = made.config.perimeter;
    perimeter.discriminator_detuning_lambda.clear();
    perimeter.discriminator_signal.clear();
    perimeter.discriminator_centre_lambda = settled.centre_lambda();
    if (at != 0.0) {
        add_nodes(settled, below, perimeter);
        std::vector<double>& detuning = perimeter.discriminator_detuning_lambda;
        std::vector<double>& signal = perimeter.discriminator_signal;
        std::reverse(detuning.begin(), detuning.end());
        std::reverse(signal.begin(), signal.end());
    }
    add_nodes(settled, above, perimeter);

    made.third_wave_lambda = std::min({above.kink_lambda, above.max_lambda, below.kink_lambda, below.max_lambda});
    for (const Side& side : {above, below}) {
        const double kink_lambda = std::min(side.kink_lambda, side.max_lambda);
        made.curve_error_lambda =
            std::max(made.curve_error_lambda, curve_error_lambda(made.config, settled, 0.0, side.sign * kink_lambda));
        made.curve_error_beyond_lambda =
            std::max(made.curve_error_beyond_lambda,
                     curve_error_lambda(made.config, settled, side.sign * kink_lambda, side.sign * side.max_lambda));
    }
    made.chi_error_ratio = averaged.bias_residual_ratio;
    return made;
}

}  // namespace

LaserCalibration calibration_of_laser(const config::Config& config) {
    try {
        return calibrate(config);
    } catch (const std::logic_error& error) {
        throw config::ConfigError{named(config, error.what())};
    } catch (const config::ConfigError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw config::ConfigError{named(config, fmt::format("[laser] does not make a gyro: {}", error.what()))};
    }
}

config::Config calibrated_by_laser(const config::Config& config) { return calibration_of_laser(config).config; }

}  // namespace zlg::rig
