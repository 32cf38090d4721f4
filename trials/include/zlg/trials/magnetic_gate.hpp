#pragma once
// The magnetic estimator on bases that move: what is left of the sawtooth with it and without.
//
// A gyro with 0.7 arcsec/s that grow by 0.7 with 3000 s, and a random walk of 0.14 arcsec/sqrt(s). Only the magnetic
// part of the angle is judged, over the last two intervals of a run that ends at draw.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/chance/draw.hpp>
#include <zlg/core/compensation/magnetic_drift.hpp>
#include <zlg/core/control/switch_schedule.hpp>

namespace zlg::trials {

struct MagneticGate {
    double interval_s = 45.0;
    double run_s = 3600.0;
    core::ScheduleKind schedule = core::ScheduleKind::fixed;  // others: from interval_s to longest_s
    double longest_s = 45.0;
    core::FirstSegment first_segment = core::FirstSegment::half;
    double count_arcsec = 3.263;
    core::MagneticDriftConfig estimator{.method = core::MagneticMethod::estimate};
};

// Rate of the base, arcsec/s, at increasing times; one that knows the mode takes it.
using BaseRate = std::function<double(double t_s, int mode)>;

struct MovingBase {
    std::string name;
    std::function<BaseRate(chance::Draw draw, std::uint64_t seed)> make;
};

// Rest, motion at random, oscillations; motion in step with the switches, whose phase is that of the switches for odd
// seeds and opposite for even ones.
[[nodiscard]] std::vector<MovingBase> moving_bases(const MagneticGate& gate);

struct GateResult {
    double without_arcsec = 0.0;  // rms of the magnetic angle
    double with_arcsec = 0.0;     // of what the estimator leaves
    double error_arcsec_s = 0.0;  // of the drift, at the end
    double trust = 0.0;
};

[[nodiscard]] GateResult gate_result(const MagneticGate& gate, const MovingBase& base, std::uint64_t seed);

}  // namespace zlg::trials
