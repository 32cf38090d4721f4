#pragma once
// Motion for an experiment on switches: an oscillation whose phase is drawn anew about every gap, in exact increments.

#include <cstdint>
#include <vector>

#include <zlg/paper/substitution_experiment.hpp>

namespace zlg::paper {

// Switch k = 1, 2, ... opens at tick k * interval_ticks.
struct SwitchGrid {
    int n = 0;  // ticks of a gap
    std::int64_t interval_ticks = 0;
    int switches = 0;
    double tick_s = 0.0;

    // Runs to the opening that would come after the last switch.
    [[nodiscard]] std::int64_t ticks() const { return (switches + 1) * interval_ticks; }
    // Number of the switch to whose gap a tick belongs, 0 for none.
    [[nodiscard]] std::int64_t switch_of(std::int64_t tick) const {
        return tick % interval_ticks < n ? tick / interval_ticks : 0;
    }
};

// Long enough to be locked again before the next switch, and to know the final angle of the last gap.
inline constexpr std::int64_t recovery_ticks = 64;

[[nodiscard]] inline SwitchGrid grid_of(const SubstitutionExperiment& e) {
    return {e.gap_ticks, e.gap_ticks + recovery_ticks, e.switches, e.base.gyro.tick_s};
}

// The motion about one gap over its amplitude: rate and, a quarter of a period later, the other quadrature.
struct Quadratures {
    double sine = 0.0;
    double cosine = 0.0;
};

class RandomPhaseMotion {
public:
    RandomPhaseMotion(const SubstitutionExperiment& experiment, const SwitchGrid& grid);

    // Of switch k.
    [[nodiscard]] const Quadratures& at(std::int64_t k) const { return about_gap_[static_cast<std::size_t>(k)]; }

    // Rotation of the case in each half-period of the run.
    [[nodiscard]] std::vector<double> increments_arcsec() const;

private:
    SwitchGrid grid_;
    double amplitude_arcsec_s_;
    double frequency_hz_;
    std::vector<Quadratures> about_gap_;  // by number of the switch; 0 is the start, the last is after the last gap
};

}  // namespace zlg::paper
