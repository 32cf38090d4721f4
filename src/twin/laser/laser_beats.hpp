#pragma once
// From perimeter and field to counts: the laser's light drives the beats of both helicities.

#include <array>
#include <cstdint>

#include <zlg/twin/laser_config.hpp>
#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/optical_beats.hpp>

namespace zlg::twin {

// Start, middle and end of a stretch of time.
using StartMiddleEnd = std::array<double, 3>;

// Simpson's rule.
[[nodiscard]] constexpr double mean_of(const StartMiddleEnd& c) { return (c[0] + 4.0 * c[1] + c[2]) / 6.0; }

struct Stretch {
    StartMiddleEnd perimeter_lambda{};
    StartMiddleEnd field_g{};
    double duration_s = 0.0;
    double common_hz = 0.0;    // drive of both helicities: rotation and the drift that no field makes
    double pulled_hz = 0.0;    // what the gas takes from the rotation of an undetuned beat, added to common_hz
    double rotation_g = 0.0;   // field that shifts the lines of a left mode as rotation shifts its waves, negative
    double helicity_hz = 0.0;  // drive times helicity: the drift that a constant field makes
    double cw_part = 1.0;      // what faults leave of the light
    double ccw_part = 1.0;
};

// What the counter followed in a stretch.
struct Followed {
    int helicity = 0;      // 0: no beat, or two of nearly equal size
    double bias_hz = 0.0;  // mean bias of that helicity
};

class LaserBeats {
public:
    // seed  of the phases that the beats start with.
    LaserBeats(const LaserConfig& config, std::uint64_t seed, const LaserTable& table);

    // The bias hardly changes: each beat has its mean throughout.
    Followed plateau(const Stretch& stretch);
    // The field goes through a part of a reversal: each beat's drive is a chord with the right mean.
    Followed edge(const Stretch& stretch);

    // What spontaneous emission has done to the phases of the lit beats within a time, of the light as it is now.
    //
    // deviate  of the left and the right beat: zero mean, unit variance.
    void diffuse(double duration_s, double left_deviate, double right_deviate);

    [[nodiscard]] std::uint64_t latch() const;
    // Of the sum of the beats, over the amplitude of one at the centre.
    [[nodiscard]] Signals signals() const;
    [[nodiscard]] const OpticalBeats& beats() const { return beats_; }

private:
    struct Lights {
        LaserLight start, middle, end;
    };

    [[nodiscard]] Lights lights(const Stretch& stretch);
    [[nodiscard]] Beat beat(const Stretch& stretch, const Lights& lights, int helicity, double slant) const;
    Followed live(const Stretch& stretch, double slant);

    LaserTable table_;
    Backscatter left_;
    Backscatter right_;
    double threshold_;
    double min_light_;
    double usual_amplitude_;
    double walk_turns_;
    bool counts_quarters_;
    OpticalBeats beats_;

    // Where the last stretch ended, the next one begins.
    double end_perimeter_ = 0.0;
    double end_field_ = 0.0;
    LaserLight end_light_;
};

}  // namespace zlg::twin
