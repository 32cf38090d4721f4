#include "run_variant.hpp"

#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/gyro_drift.hpp>

namespace zlg::study {

std::vector<Variant> variants(const config::Config& config, std::int64_t stride,
                              const std::optional<std::vector<std::string>>& wanted) {
    using core::BridgeMethod;
    using core::RelockMethod;
    struct Choice {
        const char* name;
        const char* meaning;
        RelockMethod relock;
        BridgeMethod bridge;
    };
    const std::array choices{
        Choice{"switching", "switched; gaps and re-lock as read", RelockMethod::none, BridgeMethod::none},
        Choice{"relock_frequency", "re-lock by bias frequency, gap by quadratic", RelockMethod::frequency,
               BridgeMethod::quadratic},
        Choice{relock_detuning, "re-lock by detuning, gap by quadratic", RelockMethod::detuning,
               BridgeMethod::quadratic},
        Choice{"relock_mean_square", "re-lock by mean square detuning, gap by quadratic", RelockMethod::mean_square,
               BridgeMethod::quadratic},
        Choice{"bridge_constant", "re-lock by detuning, gap by constant", RelockMethod::detuning,
               BridgeMethod::constant},
        Choice{"bridge_linear", "re-lock by detuning, gap by straight line", RelockMethod::detuning,
               BridgeMethod::linear},
        Choice{bridge_quadratic, "re-lock by detuning, gap by quadratic", RelockMethod::detuning,
               BridgeMethod::quadratic},
    };
    // The named variants are the paper's, with its points; only the last takes those of the configuration.
    config::Config paper = config;
    const config::Compensation points;
    paper.compensation.extrapolation_points = points.extrapolation_points;
    paper.compensation.points_before = points.points_before;
    paper.compensation.points_after = points.points_after;

    config::Config estimating = config;
    estimating.compensation.magnetic = core::MagneticMethod::estimate;

    std::vector<Variant> all;
    const auto add = [&](const config::Config& of, const Choice& c) {
        all.push_back({c.name, c.meaning, rig::Replay{rig::compensation_config(of, c.relock, c.bridge)},
                       ErrorMeter{config.gyro.tick_s, stride, RunDrift{config}}});
    };
    for (const Choice& c : choices)
        if (is_wanted(wanted, c.name) && !(c.name == bridge_quadratic && is_wanted(wanted, relock_detuning)))
            add(paper, c);
    const RelockMethod relock = rig::asked_relock(config);
    const BridgeMethod bridge = config.compensation.bridge;
    if (config.compensation.magnetic != core::MagneticMethod::estimate && is_wanted(wanted, magnetic_estimate))
        add(estimating, {magnetic_estimate, "as configured, with the magnetic drift estimated", relock, bridge});
    add(config, {"configured", "as the configuration says", relock, bridge});
    return all;
}

}  // namespace zlg::study
