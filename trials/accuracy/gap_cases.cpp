// Cases of gaps of all lengths, and of the first gap of a log.

#include <array>

#include <fmt/format.h>

#include "parts.hpp"

namespace zlg::trials {
namespace {

struct Moving {
    const char* name;
    MotionLaw motion;
};

const std::vector<Moving>& motions() {
    static const std::vector<Moving> all{{"rest", {.rate_spread_arcsec_s = 15.0}},
                                         {"20.06 Hz", {.tones = {{20.06, 12000.0}}}},
                                         {"7.03 and 23.71 Hz", {.tones = {{7.03, 12000.0}, {23.71, 12000.0}}}}};
    return all;
}

// Ours beside the paper's, without the two that are nearly ours.
std::vector<std::string> few_methods() {
    return {method_name::automatic, method_name::constant, method_name::linear, method_name::quadratic};
}

void add_lengths(std::vector<AccuracyCase>& cases, bool quick) {
    for (const char* readout : {readouts[0], readouts[1]}) {
        for (const Moving& moving : motions()) {
            for (int gap = 1; gap <= 10; ++gap) {
                if (quick && (gap != 1 && gap != 6 && gap != 10)) continue;
                AccuracyCase c = make_case(CaseGroup::gap_lengths, fmt::format("{}, gap of {} ticks", moving.name, gap),
                                           readout, moving.motion, quick ? 60 : 400);
                c.gyro.gap_ticks = gap;
                c.interval_ticks = 600;
                c.has_bound = moving.motion.rate_spread_arcsec_s == 0.0;
                c.methods = few_methods();
                if (quick) c.min_start = c.max_start = 2000;
                cases.push_back(std::move(c));
            }
        }
    }
}

struct Start {
    std::int64_t least, most;  // ticks
};

constexpr std::array starts{Start{10, 30}, Start{30, 60}, Start{60, 300}};

void add_first_gaps(std::vector<AccuracyCase>& cases, bool quick) {
    for (const char* readout : readouts) {
        std::vector<Moving> all = motions();
        all.push_back({"flat to 20 Hz, 8485 \"/s", {.bands = {{0.0, 20.0, 8485.0}}}});
        for (const Moving& moving : all) {
            for (const Start& start : starts) {
                AccuracyCase c =
                    make_case(CaseGroup::first_gap,
                              fmt::format("{}, first gap at {} to {} ticks", moving.name, start.least, start.most),
                              readout, moving.motion, quick ? 60 : 400);
                c.switches_of_trial = 1;
                c.min_start = start.least;
                c.max_start = start.most;
                c.has_bound = false;
                c.methods = few_methods();
                cases.push_back(std::move(c));
            }
        }
    }
}

}  // namespace

std::vector<AccuracyCase> gap_cases(bool quick) {
    std::vector<AccuracyCase> cases;
    add_lengths(cases, quick);
    add_first_gaps(cases, quick);
    return cases;
}

}  // namespace zlg::trials
