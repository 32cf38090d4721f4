#pragma once
// A gyro whose motion is known meets a gap and, at the same time, a manoeuvre that it has never seen.
//
// One gyro moves evenly and without gaps, and its compensations learn; from it, every few ticks, a copy is taken for
// each kind of manoeuvre, which then has one gap. So every manoeuvre is the first one.

#include <optional>
#include <vector>

#include <zlg/trials/accuracy.hpp>

#include "synthetic/laws.hpp"
#include "trial.hpp"

namespace zlg::trials {

// How the rate goes from 0 to its final value within a duration T; a pulse returns to 0.
//
//   ramp (1 - cos(pi t/T))/2    linear t/T    exponential 1 - exp(-3 t/T)    pulse (1 - cos(2 pi t/T))/2
enum class ManoeuvreLaw { ramp, linear, exponential, pulse };

// Where a manoeuvre begins: anywhere within eight ticks before the gap, in it, or within eight ticks after it; `ended`:
// it ends within eight ticks before the gap.
enum class ManoeuvrePlace { ended, before, in, after };

struct Manoeuvre {
    ManoeuvreLaw law = ManoeuvreLaw::ramp;
    ManoeuvrePlace place = ManoeuvrePlace::in;
    double rate_arcsec_s = 0.0;  // 0: nothing happens
    double duration_s = 0.05;
    std::optional<MotionLaw> next{};  // the motion of the case is this one from the opening of the gap on
};

// Angle of a manoeuvre of unit rate until t_s after its beginning, s.
[[nodiscard]] double manoeuvre_angle(ManoeuvreLaw law, double duration_s, double t_s);

struct ManoeuvreTrial {
    GyroLaw gyro;
    MotionLaw motion;
    std::vector<Manoeuvre> manoeuvres;
    int gaps = 100;                   // of each manoeuvre
    std::int64_t learn_ticks = 3000;  // before the first of them
    std::uint64_t seed = 1;
};

// By manoeuvre, then by method, then by gap.
[[nodiscard]] std::vector<std::vector<std::vector<SwitchError>>> run_manoeuvres(
    const ManoeuvreTrial& trial, const std::vector<AccuracyMethod>& methods);

}  // namespace zlg::trials
