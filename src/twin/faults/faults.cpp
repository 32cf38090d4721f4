#include <zlg/twin/faults.hpp>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "noise.hpp"

namespace zlg::twin {
namespace {

constexpr double huge = 1e9;
constexpr double lambdas = 10.0;  // of perimeter, in one fault

// A random fault is one that a gyro may meet: neither one that no angle feels nor one that breaks the block.
constexpr std::array<FaultFacts, n_fault_kinds> table{{
    {"laser_off", "", -huge, huge, 0.0, 0.0, false, 0.02, 1.0},
    {"beam_fades", "", 0.0, 1.0, 0.3, 1.0, false, 0.1, 1.0},
    {"mode_hop", "lambda", -lambdas, lambdas, 0.45, 0.55, true, 0.0005, 0.005},
    {"switch_wrong_mode", "lambda", -lambdas, lambdas, 0.45, 0.55, true, 1.0, 4.0},
    {"switch_no_mode", "lambda", -lambdas, lambdas, 0.22, 0.28, true, 1.0, 4.0},
    {"half_wave_error", "", -0.9, lambdas, 0.1, 0.2, true, 2.0, 5.0},
    {"perimeter_ramp", "lambda/s", -100.0, 100.0, 0.3, 0.8, true, 3.0, 5.0},
    {"piezo_step", "lambda", -lambdas, lambdas, 0.02, 0.15, true, 0.001, 0.3},
    {"light_stuck", "", 0.0, 2.0, 0.0, 2.0, false, 0.02, 1.0},
    {"light_noisy", "", 0.0, huge, 0.02, 0.5, false, 0.02, 1.0},
    {"light_saturated", "", 0.0, huge, 0.3, 0.95, false, 0.02, 1.0},
    {"light_nan", "", -huge, huge, 0.0, 0.0, false, 0.001, 1.0},
    {"piezo_adc_stuck", "", -huge, huge, 0.0, 0.0, false, 0.02, 4.0},
    {"piezo_adc_nan", "", -huge, huge, 0.0, 0.0, false, 0.02, 4.0},
    {"temperature_nan", "", -huge, huge, 0.0, 0.0, false, 0.02, 4.0},
    {"counter_bit_stuck", "", 0.0, 63.0, 0.0, 12.0, false, 0.02, 1.0},
    {"frame_missed", "", -huge, huge, 0.0, 0.0, false, 0.0025, 0.25},
    {"frame_repeated", "", -huge, huge, 0.0, 0.0, false, 0.0025, 0.25},
    {"frame_late", "", -huge, huge, 0.0, 0.0, false, 0.0025, 0.25},
    {"bias_lost", "", 0.0, 1.0, 0.02, 1.0, false, 0.02, 1.0},
    {"bias_asymmetric", "", -1.0, 1.0, 0.003, 0.1, true, 0.02, 1.0},
    {"field_pulse", "Hz", -1e6, 1e6, 0.3, 30.0, true, 0.1, 2.0},
    {"thermal_shock", "C", -1000.0, 1000.0, 5.0, 30.0, true, 0.5, 3.0},
    {"vibration", "lambda", -lambdas, lambdas, 0.005, 0.1, false, 0.2, 2.0},
    {"shock", "lambda", -lambdas, lambdas, 0.02, 0.3, true, 0.003, 0.02},
    {"overspeed", "arcsec/s", -huge, huge, 1.6e6, 3e6, true, 1.5, 3.0},
}};

bool counts_things(FaultKind kind) { return kind == FaultKind::light_stuck || kind == FaultKind::counter_bit_stuck; }

}  // namespace

const FaultFacts& facts(FaultKind kind) { return table.at(static_cast<std::size_t>(kind)); }

Fault random_fault(FaultKind kind, double at_s, std::uint64_t seed) {
    const FaultFacts& f = facts(kind);
    NoiseStream draw{seed, NoiseCause::faults};
    const double duration_s = f.least_s * std::pow(f.most_s / f.least_s, draw.uniform());
    double size = f.least_size + (f.most_size - f.least_size) * draw.uniform();
    if (counts_things(kind)) size = std::floor(f.least_size + (f.most_size - f.least_size + 1.0) * draw.uniform());
    if (f.either_sign && draw.uniform() < 0.5) size = -size;
    return {kind, at_s, duration_s, size};
}

std::vector<Fault> random_faults(double per_hour, double until_s, std::uint64_t seed,
                                 std::span<const FaultKind> kinds) {
    constexpr double too_many = 1e6;
    if (!(per_hour >= 0.0 && until_s >= 0.0 && per_hour * until_s / 3600.0 < too_many)) {
        throw std::invalid_argument(
            fmt::format("random faults: {} an hour for {} s, allowed is 0 or more, and less than {} faults", per_hour,
                        until_s, too_many));
    }
    constexpr auto all = all_fault_kinds();
    if (kinds.empty()) kinds = all;
    std::vector<Fault> made;
    if (per_hour == 0.0) return made;
    NoiseStream draw{seed, NoiseCause::fault_times};
    const auto wait_s = [&] { return -std::log1p(-draw.uniform()) * 3600.0 / per_hour; };
    for (double at_s = wait_s(); at_s < until_s; at_s += wait_s()) {
        const auto k = static_cast<std::size_t>(draw.uniform() * static_cast<double>(kinds.size()));
        made.push_back(random_fault(kinds[k], at_s, scrambled(seed) + made.size()));
    }
    return made;
}

}  // namespace zlg::twin
