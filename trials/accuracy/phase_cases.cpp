// Cases of the phase of the fringe, and of halves of a gap that are lit.

#include <fmt/format.h>

#include "parts.hpp"

namespace zlg::trials {
namespace {

const MotionLaw rest{.rate_spread_arcsec_s = 15.0};
const MotionLaw tone{.tones = {{20.06, 12000.0}}};
const MotionLaw two_tones{.tones = {{7.03, 12000.0}, {23.71, 12000.0}}};
const MotionLaw band{.bands = {{0.0, 20.0, 8485.0}}};
const MotionLaw vibration{.bands = {{5.0, 80.0, 8000.0}}};

void add_phase(std::vector<AccuracyCase>& cases, bool quick) {
    const auto add = [&](const char* name, const MotionLaw& motion) -> AccuracyCase& {
        cases.push_back(make_case(CaseGroup::phase, name, readouts[2], motion, quick ? 100 : 1000));
        cases.back().interval_ticks = 1000;
        return cases.back();
    };
    add(main_case::tone, tone);
    add(main_case::band, band);
    AccuracyCase& learnt = add(main_case::learnt_band, band);
    learnt.min_start = learnt.max_start = 40000;
    if (quick) return;
    add(main_case::rest, rest).has_bound = false;
    add(main_case::two_tones, two_tones);
    add(main_case::vibration, vibration);
    add(main_case::tone_with_walk, tone).gyro.random_walk_arcsec_sqrt_s = 0.14;
    add("20.06 Hz, 12 000 \"/s, chi f0 wrong by +10 %", tone).gyro.chi_error_ratio = 0.1;
    for (int gap : {1, 10})
        add(fmt::format("20.06 Hz, 12 000 \"/s, gap of {} ticks", gap).c_str(), tone).gyro.gap_ticks = gap;
}

void add_lit(std::vector<AccuracyCase>& cases, bool quick) {
    for (const char* readout : {readouts[0], readouts[1]}) {
        for (const bool lit : {false, true}) {
            const auto add = [&](const char* name, const MotionLaw& motion) {
                cases.push_back(make_case(CaseGroup::lit, fmt::format("{}{}", name, lit ? lit_halves_name : ""),
                                          readout, motion, quick ? 100 : 1000));
                cases.back().interval_ticks = 1000;
                if (lit) cases.back().gyro.lit_halves = 3;
            };
            add(main_case::vibration, vibration);
            add(main_case::tone, tone);
        }
    }
}

}  // namespace

std::vector<AccuracyCase> phase_cases(bool quick) {
    std::vector<AccuracyCase> cases;
    add_phase(cases, quick);
    add_lit(cases, quick);
    if (!quick) add_sweep(cases, CaseGroup::phase, readouts[2]);
    return cases;
}

}  // namespace zlg::trials
