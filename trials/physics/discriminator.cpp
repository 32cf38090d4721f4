// The discriminator, its inverse, and how field and gain set it.

#include <algorithm>

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/discriminator_curve.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using namespace report;

constexpr double field_g = 15.0;

Figure both_helicities(const twin::FourWave& laser, double slope) {
    Figure figure{.id = "discriminator",
                  .title = "Discriminator of either helicity",
                  .caption =
                      "(cw - ccw)/(cw + ccw) of the light of both modes, at a field of +15 G; dashed, the line of "
                      "its slope at the centre.",
                  .x_label = "detuning of the nearest mode, wavelengths",
                  .y_label = "(I1 - I2)/(I1 + I2)",
                  .series = {blank_series("nearest mode is left"), blank_series("nearest mode is right"),
                             blank_series("slope, left", Mark::line, true, 0),
                             blank_series("slope, right", Mark::line, true, 1)}};
    for (const std::size_t mode : {std::size_t{0}, std::size_t{1}}) {
        sample(figure.series[mode], -0.25, 0.002, 250, [&](double dl) {
            // At a quarter of a wavelength neither mode is nearer.
            const double inside = std::clamp(dl, -0.25 + 1e-9, 0.25 - 1e-9);
            return laser.at(0.5 * static_cast<double>(mode) + inside, field_g).discriminator();
        });
        const double sign = mode == 0 ? 1.0 : -1.0;
        sample(figure.series[2 + mode], -0.25, 0.5, 1, [&](double dl) { return sign * slope * dl; });
    }
    return figure;
}

Figure inverse(const twin::DiscriminatorCurve& curve, double slope) {
    Figure figure{.id = "discriminator-inverse",
                  .title = "Detuning from the signal",
                  .caption =
                      "The inverse curve of a left mode at +15 G, up to where the signal turns; dashed, what the "
                      "slope alone makes of the same signal.",
                  .x_label = "signal (I1 - I2)/(I1 + I2)",
                  .y_label = "detuning, wavelengths",
                  .series = {blank_series("inverse curve"), blank_series("slope alone", Mark::line, true)}};
    const double max_signal = curve.signal.back();
    sample(figure.series[0], -max_signal, max_signal / 100.0, 200,
           [&](double signal) { return curve.detuning_of(signal); });
    sample(figure.series[1], -0.3 * slope, 0.6 * slope, 1, [&](double signal) { return signal / slope; });
    return figure;
}

double slope_at(const twin::FourWave& laser, double g) {
    constexpr double h = 1e-5;
    return laser.at(h, g).discriminator() / h;
}

}  // namespace

void add_discriminator(PhysicsPictures& made) {
    const twin::FourWave laser{twin::LaserConfig{}};
    const double slope = twin::averaged_laser(laser, field_g).discriminator_per_lambda;
    const twin::DiscriminatorCurve curve = twin::discriminator_curve(laser, field_g);
    made.pictures.push_back({"discriminator", {both_helicities(laser, slope), inverse(curve, slope)}});
    std::vector<double> growth;
    for (const double dl : {0.05, 0.10, 0.15, 0.20})
        growth.push_back(laser.at(dl, field_g).discriminator() / (slope * dl));
    read(made, "signal over its linear law at 0.05, 0.10, 0.15, 0.20 wavelength", growth, 2);
    read(made, "detuning up to which the signal can be inverted", {curve.max_detuning_lambda()}, 3, "wavelength");
}

void add_field(PhysicsPictures& made) {
    Figure bias{.id = "field-bias",
                .title = "Bias against field",
                .caption = "Bias at zero detuning for three ratios of unsaturated gain to loss.",
                .x_label = "field, G",
                .y_label = "bias f0, kHz"};
    Figure slope{.id = "field-slope",
                 .title = "Slope of the discriminator against field",
                 .caption = "At zero detuning, for the same ratios of gain to loss.",
                 .x_label = "field, G",
                 .y_label = "slope of (I1 - I2)/(I1 + I2), 1/wavelength"};
    std::vector<double> bias_hz;
    std::vector<double> per_lambda;
    for (const double gain_loss : {1.1, 1.2, 1.3}) {
        const twin::FourWave laser{twin::LaserConfig{.gain_loss_ratio = gain_loss}};
        Series f0 = blank_series(fmt::format("G/mu = {}", gain_loss));
        Series steep = f0;
        sample(f0, 0.0, 1.0, 30, [&](double g) { return 1e-3 * laser.at(0.0, g).left.bias_hz; });
        sample(steep, 0.0, 1.0, 30, [&](double g) { return slope_at(laser, g); });
        bias.series.push_back(std::move(f0));
        slope.series.push_back(std::move(steep));
        bias_hz.push_back(laser.at(0.0, field_g).left.bias_hz);
        per_lambda.push_back(slope_at(laser, field_g));
    }
    made.pictures.push_back({"field", {std::move(bias), std::move(slope)}});
    read(made, "bias f0 at 15 G, G/mu = 1.1, 1.2, 1.3", bias_hz, 0, "Hz");
    read(made, "slope of the discriminator at 15 G, G/mu = 1.1, 1.2, 1.3", per_lambda, 3, "1/wavelength");
}

}  // namespace zlg::trials
