#pragma once
// One experiment on the substitution of a gap, as it is asked for.

#include <cstdint>

#include <zlg/config/config.hpp>
#include <zlg/design/substitution.hpp>

namespace zlg::paper {

struct SubstitutionExperiment {
    int gap_ticks = 3;           // 1..16
    double frequency_hz = 20.0;  // finite; > 0 unless the amplitude is 0
    double amplitude_arcsec_s = 12000.0;
    // Where the amplitude is 0: the rate is constant about each switch, uniform within this on either side, > 0. A gyro
    // at rest in all but the rounding of its count, which would otherwise be the same at each tick.
    double slow_rate_arcsec_s = 0.0;
    int switches = 2000;     // 100..100 000
    std::uint64_t seed = 1;  // of the twin and of the phases
    design::Points points{};
    config::Config base{};  // its run, switching, motion, compensation points and perimeter miss are not used
};

}  // namespace zlg::paper
