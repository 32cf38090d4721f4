#include <stdexcept>

#include <zlg/rig/wiring.hpp>

#include "parts.hpp"
#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

using core::BridgeMethod;
using core::RelockMethod;

struct Recipe {
    const char* name;
    RelockMethod relock;
    BridgeMethod bridge;
    bool of_paper;
};

constexpr Recipe recipes[] = {
    {method_name::automatic, RelockMethod::joint, BridgeMethod::automatic, false},
    {method_name::automatic_ticks, RelockMethod::mean_square, BridgeMethod::automatic, false},
    {method_name::constant, RelockMethod::mean_square, BridgeMethod::constant, true},
    {method_name::linear, RelockMethod::mean_square, BridgeMethod::linear, true},
    {method_name::quadratic, RelockMethod::mean_square, BridgeMethod::quadratic, true},
    {method_name::detuning_constant, RelockMethod::detuning, BridgeMethod::constant, true},
    {method_name::detuning_quadratic, RelockMethod::detuning, BridgeMethod::quadratic, true},
    {method_name::frequency_quadratic, RelockMethod::frequency, BridgeMethod::quadratic, true},
    {method_name::uncorrected, RelockMethod::none, BridgeMethod::quadratic, true},
    {method_name::uncorrected_automatic, RelockMethod::none, BridgeMethod::automatic, false},
};

const Recipe& recipe_of(const std::string& name) {
    for (const Recipe& r : recipes)
        if (name == r.name) return r;
    throw std::invalid_argument("no such method: " + name);
}

}  // namespace

config::Config config_of(const GyroLaw& law) {
    config::Config c;
    c.gyro.tick_s = law.tick_s;
    c.gyro.scale_arcsec = law.scale_arcsec;
    c.gyro.bias_hz = law.bias_hz;
    c.gyro.bias_chi = law.chi;
    c.gyro.light_noise_lambda = law.light_noise_lambda;
    c.gyro.light_samples = law.light_samples;
    c.gyro.discriminator_per_lambda = synthetic_discriminator_per_lambda;
    c.drift.random_walk_arcsec_sqrt_s = law.random_walk_arcsec_sqrt_s;
    if (law.photodiodes.reads) {
        c.gyro.readout = config::Readout::phase;
        c.photodiodes.noise = law.photodiodes.noise;
        c.photodiodes.adc_bits = law.photodiodes.adc_bits;
    }
    return c;
}

bool is_of_paper(const std::string& method) { return recipe_of(method).of_paper; }

std::vector<AccuracyMethod> methods_for(const config::Config& gyro, const std::vector<std::string>& names) {
    std::vector<AccuracyMethod> methods;
    for (const std::string& name : names) {
        const Recipe& recipe = recipe_of(name);
        methods.push_back({name, rig::compensation_config(gyro, recipe.relock, recipe.bridge)});
    }
    return methods;
}

const MethodFigures* find_method(const std::vector<MethodFigures>& methods, const std::string& name) {
    for (const MethodFigures& m : methods)
        if (m.method == name) return &m;
    return nullptr;
}

}  // namespace zlg::trials
