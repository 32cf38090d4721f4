#include <fmt/format.h>

#include "parts.hpp"

namespace zlg::trials {
namespace {

std::vector<DriftGyro> gyros() {
    const DriftMethod paper{"(13), quadratic",
                            {.relock = core::RelockMethod::detuning, .bridge = core::BridgeMethod::quadratic}};
    const DriftMethod ours{"joint, auto", {.relock = core::RelockMethod::joint}};
    const DriftMethod magnetic{"joint, auto, magnetic",
                               {.relock = core::RelockMethod::joint, .magnetic = core::MagneticMethod::estimate}};
    std::vector<DriftGyro> all;
    config::Config c;
    c.motion.frequency_hz = {20.06};
    // No whole numbers of periods of the vibration, with which errors would add up instead of averaging out.
    for (double interval_s : {91.7, 251.3}) {
        c.switching.interval_s = interval_s;
        all.push_back({fmt::format("fixed, {} s", interval_s), c, {paper}});
    }
    c.switching.interval_s = 61.3;
    c.switching.first_segment = config::FirstSegment::half;
    all.push_back({"fixed, 61.3 s, first half", c, {ours, magnetic}});
    c.switching.schedule = config::Schedule::measured;
    all.push_back({"measured, first half", c, {magnetic}});
    return all;
}

}  // namespace

std::vector<DriftFigures> measure_long_runs(const AccuracyTask& task) {
    return run(DriftCampaign{.gyros = gyros(),
                             .times_s = {600.0, 900.0, 3600.0, 36000.0},
                             .seeds = 3,
                             .first_seed = task.seed,
                             .threads = task.threads});
}

}  // namespace zlg::trials
