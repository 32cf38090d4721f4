#include "log_compensation.hpp"

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

#include "failure.hpp"
#include "options.hpp"

namespace zlg::cli {
namespace {

// The inverse discriminators of a log's detunings: the one that they have come through in the control, and, where there was
// none, that of [perimeter], which they come through here.
struct Curves {
    core::DiscriminatorCurve here;
    core::DiscriminatorCurve control;
};

Curves curves_of(const config::Config& config, const logs::RawHeader& header, const std::string& path) {
    const config::Config recorded = as_recorded(config, header.settings, path);
    const double slope = recorded.gyro.discriminator_per_lambda;
    const config::Perimeter& with = recorded.perimeter;
    const config::Perimeter& asked = config.perimeter;
    if (with.discriminator_signal.empty()) return {.here = rig::discriminator_curve(config, slope), .control = {}};
    const bool asks_for_another = with.discriminator_signal != asked.discriminator_signal ||
                                  with.discriminator_detuning_lambda != asked.discriminator_detuning_lambda;
    if (asks_for_another && !asked.discriminator_signal.empty())
        complain(
            fmt::format("warning: {}: its detunings were read through a discriminator curve of its own; the other "
                        "one, of perimeter.discriminator_signal, is not applied to them",
                        path));
    return {.here = {}, .control = rig::discriminator_curve(recorded, slope)};
}

}  // namespace

core::RelockMethod choose_relock(const config::Config& config, const logs::RawHeader& header, const std::string& path) {
    using core::RelockMethod;
    if (!config.compensation.relock) return header.has_detuning_sq ? RelockMethod::mean_square : RelockMethod::none;
    const RelockMethod asked = *config.compensation.relock;
    const auto refuse = [&](const char* method, const char* column) {
        throw config::ConfigError{
            fmt::format("compensation.relock = \"{}\" needs the column {}, which {} lacks; "
                        "allowed without it: \"none\", \"frequency\"",
                        method, column, path)};
    };
    if (asked == RelockMethod::detuning && !header.has_detuning) refuse("detuning", "detuning_lambda");
    if (asked == RelockMethod::mean_square && !header.has_detuning_sq) refuse("mean_square", "detuning_sq_lambda2");
    if (asked == RelockMethod::joint) {
        if (!header.has_detuning_sq) refuse("joint", "detuning_sq_lambda2");
        if (header.light_samples == 0)
            complain(
                fmt::format("note: {}: holds no light samples; compensation.relock = \"joint\" takes the mean "
                            "squares of the detuning instead",
                            path));
    }
    return asked;
}

core::GyroCompensationConfig compensation_of(const config::Config& config, core::RelockMethod relock,
                                             const logs::RawHeader& header, const std::string& path) {
    auto made = rig::compensation_config(config, relock, config.compensation.bridge);
    const Curves curves = curves_of(config, header, path);
    made.relock.curve = made.profile.record_curve = curves.here;
    made.relock.control_curve = curves.control;
    if (!header.has_edge_offset) return made;
    const config::Gyro& g = config.gyro;
    if (!(g.bias_edge_s < 0.5 * g.tick_s)) {
        throw config::ConfigError{
            fmt::format("gyro.bias_edge_s = {}: allowed is below half of gyro.tick_s = {}, where "
                        "edges are shifted",
                        g.bias_edge_s, g.tick_s)};
    }
    made.timer = core::Hertz{header.timer_hz};
    return made;
}

}  // namespace zlg::cli
