#include <fmt/format.h>

#include "parts.hpp"
#include "synthetic/relock_decay.hpp"

namespace zlg::trials {
namespace {

using Cases = std::vector<AccuracyCase>;

constexpr const char* x1 = readouts[0];
constexpr const char* x4 = readouts[1];

std::vector<std::string> main_methods() {
    return {method_name::automatic, method_name::automatic_ticks, method_name::constant, method_name::linear,
            method_name::quadratic};
}

std::vector<std::string> all_methods() {
    std::vector<std::string> names = main_methods();
    names.insert(names.end(), {method_name::detuning_constant, method_name::detuning_quadratic,
                               method_name::frequency_quadratic, method_name::uncorrected});
    return names;
}

MotionLaw tone(double frequency_hz = 20.06, double amplitude_arcsec_s = 12000.0) {
    return {.tones = {{frequency_hz, amplitude_arcsec_s}}};
}

// The paper's case with one thing of the gyro changed, for each way of counting.
template <class Change>
void add_gyros(Cases& cases, CaseGroup group, const std::string& name, std::initializer_list<const char*> counts,
               int switches, const Change& change) {
    for (const char* readout : counts) {
        cases.push_back(make_case(group, name, readout, tone(), switches));
        change(cases.back().gyro);
    }
}

void add_paper_case(Cases& cases, bool quick) {
    for (const char* readout : {x1, x4}) {
        cases.push_back(make_case(CaseGroup::paper, "20.06 Hz, 12 000 \"/s", readout, tone(), quick ? 300 : 3000));
        cases.back().methods = all_methods();
    }
}

void add_loops(Cases& cases, bool quick) {
    const int n = quick ? 200 : 1500;
    for (LoopShape loop : loop_shapes) {
        const std::size_t first = cases.size();
        add_gyros(cases, CaseGroup::loops, loop_name(loop), {x1, x4}, n, [&](GyroLaw& g) { g.loop = loop; });
        for (std::size_t k = first; k < cases.size(); ++k) cases[k].methods.push_back(method_name::detuning_quadratic);
    }
    for (double wrong : {-0.1, 0.1})
        add_gyros(cases, CaseGroup::loops, fmt::format("chi f0 wrong by {:+.0f} %", 100.0 * wrong), {x1, x4}, n,
                  [&](GyroLaw& g) { g.chi_error_ratio = wrong; });
}

void add_motion_grid(Cases& cases) {
    const auto add = [&](const std::string& name, const char* readout, const MotionLaw& motion) {
        cases.push_back(make_case(CaseGroup::grid, name, readout, motion, 400));
    };
    for (const char* readout : {x1, x4}) add_sweep(cases, CaseGroup::grid, readout);
    for (const char* readout : {x1, x4})
        for (double amplitude : {10.0, 100.0, 1000.0, 60000.0})
            add(fmt::format("20.06 Hz, {:.0f} \"/s", amplitude), readout, tone(20.06, amplitude));
    for (double amplitude : {100.0, 1000.0})
        add(fmt::format("7.03 Hz, {:.0f} \"/s", amplitude), x1, tone(7.03, amplitude));
}

void add_gyro_grid(Cases& cases) {
    const auto add = [&](const std::string& name, std::initializer_list<const char*> counts, const auto& change) {
        add_gyros(cases, CaseGroup::grid, name, counts, 400, change);
    };
    for (int gap : {1, 2, 4, 5})
        add(fmt::format("gap of {} ticks", gap), {x1, x4}, [&](GyroLaw& g) { g.gap_ticks = gap; });
    for (double noise : {0.001, 0.01})
        add(fmt::format("light noise {}", noise), {x1}, [&](GyroLaw& g) { g.light_noise_lambda = noise; });
    for (double miss : {0.0, 0.05, 0.1, 0.3})
        add(fmt::format("miss {}", miss), {x1}, [&](GyroLaw& g) { g.miss_lambda = miss; });
    for (int samples : {8, 64})
        add(fmt::format("{} light samples", samples), {x1}, [&](GyroLaw& g) { g.light_samples = samples; });
}

void add_broadband(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    const auto add = [&](const char* name, std::vector<Band> bands, const char* readout) {
        cases.push_back(make_case(CaseGroup::broadband, name, readout, {.bands = std::move(bands)}, n));
    };
    for (const char* readout : {x1, x4}) {
        add("flat to 20 Hz, 8485 \"/s", {{0.0, 20.0, 8485.0}}, readout);
        if (quick) continue;
        add("flat to 5 Hz, 1000 \"/s", {{0.0, 5.0, 1000.0}}, readout);
        add("flat to 60 Hz, 500 \"/s", {{0.0, 60.0, 500.0}}, readout);
        add("vehicle: sway, body and frame",
            {{0.05, 0.5, 800.0}, {1.0, 3.0, 1500.0}, {8.0, 15.0, 600.0}, {25.0, 45.0, 100.0}}, readout);
        add("narrow, 17 to 18 Hz, 5000 \"/s", {{17.0, 18.0, 5000.0}}, readout);
    }
}

void add_coning_and_shock(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    for (const char* readout : {x1, x4}) {
        const auto add = [&](const char* name, const MotionLaw& motion) {
            cases.push_back(make_case(CaseGroup::non_stationary, name, readout, motion, n));
        };
        // Neighbouring frequencies: a beat of 0.13 Hz.
        add("coning, amplitude modulated",
            {.rate_arcsec_s = 40.0, .tones = {{4.7, 9000.0}, {4.57, 3000.0}, {4.83, 3000.0}, {9.4, 300.0}}});
        MotionLaw shock{.rate_spread_arcsec_s = 15.0};
        shock.shocks = {.per_s = 2.0, .rate_arcsec_s = 4000.0, .ring_hz = 12.0, .decay_s = 0.05};
        add("shocks, 12 Hz ringing for 50 ms", shock);
        if (quick) continue;
        shock.shocks = {.per_s = 0.3, .rate_arcsec_s = 20000.0, .ring_hz = 35.0, .decay_s = 0.02};
        add("rare shocks, 35 Hz for 20 ms", shock);
        shock.bands = {{0.0, 10.0, 300.0}};
        add("rare shocks on vibration", shock);
    }
}

void add_warm_up_and_rest(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    for (const char* readout : {x1, x4}) {
        for (double thermal : {0.7, 14.0})
            add_gyros(cases, CaseGroup::warm_up, fmt::format("warm-up with A = {} \"/s", thermal), {readout}, n,
                      [&](GyroLaw& g) {
                          g.magnetic_arcsec_s = 0.7;
                          g.magnetic_thermal_arcsec_s = thermal;
                      });
        cases.push_back(make_case(CaseGroup::rest, "rest", readout, {.rate_spread_arcsec_s = 15.0}, n));
        cases.back().has_bound = false;
    }
}

}  // namespace

GyroLaw gyro_of(const std::string& readout) {
    GyroLaw g;
    if (readout == x4) {
        g.bias_hz *= 4.0;
        g.scale_arcsec /= 4.0;
    }
    g.photodiodes.reads = readout == readouts[2];
    return g;
}

AccuracyCase make_case(CaseGroup group, const std::string& name, const std::string& readout, const MotionLaw& motion,
                       int switches) {
    return {.group = group,
            .name = fmt::format("{}, {}", name, readout),
            .gyro = gyro_of(readout),
            .motion = motion,
            .switches = switches,
            .methods = main_methods()};
}

void add_sweep(std::vector<AccuracyCase>& cases, CaseGroup group, const char* readout) {
    for (const double frequency : {0.5, 2.0, 5.0, 7.03, 10.0, 15.0, 18.3, 20.0, 25.0, 30.0, 40.0})
        cases.push_back(make_case(group, fmt::format("{:.2f} Hz", frequency), readout, tone(frequency), 400));
}

std::vector<AccuracyCase> accuracy_cases(bool quick) {
    Cases cases;
    add_paper_case(cases, quick);
    if (!quick) {
        add_motion_grid(cases);
        add_gyro_grid(cases);
    }
    add_broadband(cases, quick);
    add_coning_and_shock(cases, quick);
    add_loops(cases, quick);
    add_warm_up_and_rest(cases, quick);
    return cases;
}

}  // namespace zlg::trials
