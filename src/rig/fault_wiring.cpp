#include "fault_wiring.hpp"

#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::rig {
namespace {

using config::ConfigError;

void add_random(const config::Config& config, std::vector<twin::Fault>& faults) {
    const config::Faults& f = config.faults;
    if (f.random_per_hour == 0.0) return;
    if (!config.run.duration_s && config.motion.kind == config::MotionKind::file)
        throw ConfigError{"faults.random_per_hour: with a motion file, run.duration_s must say how long they come"};
    try {
        const auto random = twin::random_faults(f.random_per_hour, config.run.duration_s.value_or(default_duration_s),
                                                f.random_seed, f.random_kinds);
        faults.insert(faults.end(), random.begin(), random.end());
    } catch (const std::invalid_argument& error) {
        throw ConfigError{fmt::format("faults.random_per_hour: {}", error.what())};
    }
}

}  // namespace

std::vector<twin::Fault> faults_of(const config::Config& config) {
    const config::Faults& f = config.faults;
    std::vector<twin::Fault> faults;
    for (std::size_t k = 0; k < f.kind.size(); ++k)
        faults.push_back({f.kind[k], f.at_s[k], f.duration_s[k], f.size[k]});
    add_random(config, faults);
    return faults;
}

}  // namespace zlg::rig
