#include <fmt/format.h>

#include "accuracy_loop.hpp"
#include "accuracy_parts.hpp"

namespace zlg::trials {
namespace {

using Cases = std::vector<AccuracyCase>;

constexpr double x1 = 3.263;
constexpr double x4 = 0.81575;

const char* count_name(double scale) { return scale > 1.0 ? "x1" : "x4"; }

std::vector<std::string> main_methods() {
    return {method_name::optimal,  method_name::automatic, method_name::automatic_ticks,
            method_name::constant, method_name::linear,    method_name::quadratic};
}

std::vector<std::string> all_methods() {
    std::vector<std::string> names = main_methods();
    names.insert(names.end(), {method_name::flat, method_name::detuning_constant, method_name::detuning_quadratic,
                               method_name::frequency_quadratic, method_name::uncorrected});
    return names;
}

// The same gyro, its fringes counted once or four times.
GyroLaw counted(double scale) {
    GyroLaw g;
    g.bias_hz *= g.scale_arcsec / scale;
    g.scale_arcsec = scale;
    return g;
}

MotionLaw tone(double frequency_hz = 20.06, double amplitude_arcsec_s = 12000.0) {
    MotionLaw m;
    m.tones = {{frequency_hz, amplitude_arcsec_s}};
    return m;
}

AccuracyCase make(char group, const std::string& name, const GyroLaw& gyro, const MotionLaw& motion, int switches) {
    return {.group = group,
            .name = fmt::format("{}, {}", name, count_name(gyro.scale_arcsec)),
            .gyro = gyro,
            .motion = motion,
            .switches = switches,
            .methods = main_methods()};
}

void add_paper_case(Cases& cases, bool quick) {
    for (double scale : {x1, x4}) {
        cases.push_back(make('a', "20.06 Hz, 12 000 \"/s", counted(scale), tone(), quick ? 300 : 3000));
        cases.back().methods = all_methods();
    }
}

void add_loops(Cases& cases, bool quick) {
    for (LoopShape loop : {LoopShape::exponential, LoopShape::slew, LoopShape::second_order, LoopShape::underdamped,
                           LoopShape::dead_time}) {
        for (double scale : {x1, x4}) {
            GyroLaw g = counted(scale);
            g.loop = loop;
            cases.push_back(make('f', loop_name(loop), g, tone(), quick ? 200 : 1500));
            cases.back().methods.push_back(method_name::detuning_quadratic);
        }
    }
    for (double wrong : {-0.01, 0.01}) {
        for (double scale : {x1, x4}) {
            GyroLaw g = counted(scale);
            g.chi_error_ratio = wrong;
            cases.push_back(
                make('f', fmt::format("chi f0 wrong by {:+.0f} %", 100.0 * wrong), g, tone(), quick ? 200 : 1500));
        }
    }
}

void add_motion_grid(Cases& cases) {
    for (double scale : {x1, x4})
        for (double frequency : {0.5, 2.0, 5.0, 7.03, 10.0, 15.0, 18.3, 20.0, 25.0, 30.0, 40.0})
            cases.push_back(make('b', fmt::format("{:.2f} Hz", frequency), counted(scale), tone(frequency), 400));
    for (double scale : {x1, x4})
        for (double amplitude : {10.0, 100.0, 1000.0, 60000.0})
            cases.push_back(make('b', fmt::format("20.06 Hz, {:.0f} \"/s", amplitude), counted(scale),
                                 tone(20.06, amplitude), 400));
    for (double amplitude : {100.0, 1000.0})
        cases.push_back(
            make('b', fmt::format("7.03 Hz, {:.0f} \"/s", amplitude), counted(x1), tone(7.03, amplitude), 400));
}

void add_gyro_grid(Cases& cases) {
    for (int gap : {1, 2, 4, 5}) {
        for (double scale : {x1, x4}) {
            GyroLaw g = counted(scale);
            g.gap_ticks = gap;
            cases.push_back(make('b', fmt::format("gap of {} ticks", gap), g, tone(), 400));
        }
    }
    for (double noise : {0.001, 0.01}) {
        GyroLaw g = counted(x1);
        g.light_noise_lambda = noise;
        cases.push_back(make('b', fmt::format("light noise {}", noise), g, tone(), 400));
    }
    for (double miss : {0.0, 0.05, 0.1, 0.3}) {
        GyroLaw g = counted(x1);
        g.miss_lambda = miss;
        cases.push_back(make('b', fmt::format("miss {}", miss), g, tone(), 400));
    }
    for (int samples : {8, 64}) {
        GyroLaw g = counted(x1);
        g.light_samples = samples;
        cases.push_back(make('b', fmt::format("{} light samples", samples), g, tone(), 400));
    }
}

void add_broadband(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    const auto add = [&](const char* name, std::vector<Band> bands, double scale) {
        MotionLaw m;
        m.bands = std::move(bands);
        cases.push_back(make('c', name, counted(scale), m, n));
    };
    for (double scale : {x1, x4}) {
        add("flat to 20 Hz, 8485 \"/s", {{0.0, 20.0, 8485.0}}, scale);
        if (quick) continue;
        add("flat to 5 Hz, 1000 \"/s", {{0.0, 5.0, 1000.0}}, scale);
        add("flat to 60 Hz, 500 \"/s", {{0.0, 60.0, 500.0}}, scale);
        add("vehicle: sway, body and frame",
            {{0.05, 0.5, 800.0}, {1.0, 3.0, 1500.0}, {8.0, 15.0, 600.0}, {25.0, 45.0, 100.0}}, scale);
        add("narrow, 17 to 18 Hz, 5000 \"/s", {{17.0, 18.0, 5000.0}}, scale);
    }
}

void add_coning_and_shock(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    for (double scale : {x1, x4}) {
        MotionLaw coning = tone(4.7, 9000.0);
        coning.tones.insert(coning.tones.end(), {{4.57, 3000.0}, {4.83, 3000.0}, {9.4, 300.0}});
        coning.rate_arcsec_s = 40.0;
        cases.push_back(make('d', "coning, waxing and waning", counted(scale), coning, n));
        MotionLaw shock;
        shock.rate_spread_arcsec_s = 15.0;
        shock.shocks = {.per_s = 2.0, .rate_arcsec_s = 4000.0, .ring_hz = 12.0, .decay_s = 0.05};
        cases.push_back(make('d', "shocks, 12 Hz ringing for 50 ms", counted(scale), shock, n));
        if (quick) continue;
        shock.shocks = {.per_s = 0.3, .rate_arcsec_s = 20000.0, .ring_hz = 35.0, .decay_s = 0.02};
        cases.push_back(make('d', "rare shocks, 35 Hz for 20 ms", counted(scale), shock, n));
        shock.bands = {{0.0, 10.0, 300.0}};
        cases.push_back(make('d', "rare shocks on vibration", counted(scale), shock, n));
    }
}

void add_warm_up_and_rest(Cases& cases, bool quick) {
    const int n = quick ? 160 : 600;
    for (double scale : {x1, x4}) {
        for (double thermal : {0.7, 14.0}) {
            GyroLaw g = counted(scale);
            g.magnetic_arcsec_s = 0.7;
            g.magnetic_thermal_arcsec_s = thermal;
            cases.push_back(make('g', fmt::format("warm-up with A = {} \"/s", thermal), g, tone(), n));
        }
        MotionLaw rest;
        rest.rate_spread_arcsec_s = 15.0;
        cases.push_back(make('h', "rest", counted(scale), rest, n));
        cases.back().has_bound = false;
    }
}

}  // namespace

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
