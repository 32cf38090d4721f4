#pragma once
// A gyro of closed formulas instead of physics: half-periods, light and truth, a few hundred times faster than the
// twin.
//
// With the phase phi of the beat in counts, K the scale factor, s = +1 or -1 the sign of bias and mode, over one
// half-period:
//
//   phi += (dtheta + m Om_m T/2)/K + s (f0 - chi f0 <dl^2>) T/2,    counts = floor(phi) - floor(phi before)
//
// with <dl^2> the mean square of the detuning in the half, whose decay after the gap is a formula (relock_decay.hpp).
// Light samples are the linear discriminator at the same detuning with white noise. In the gap the counter and the
// light are random numbers, and there is no magnetic drift; but its last halves may be lit: they are as those after it,
// at the full miss.
//
// With photodiodes the place within the count is read at the end of each half through the core's own correction of
// their ellipse (fringe_reader.hpp).

#include <array>
#include <cstdint>
#include <vector>

#include <zlg/core/records.hpp>

#include "fringe_reader.hpp"
#include "laws.hpp"
#include "motion.hpp"
#include "relock_decay.hpp"

namespace zlg::trials {

struct SyntheticHalf {
    core::HalfRecord record{};
    core::LightSamples light{};    // until the next half
    double true_arcsec = 0.0;      // rotation of the case
    double magnetic_arcsec = 0.0;  // drift that adds to it
    double false_arcsec = 0.0;     // false rotation: of the loss of bias by detuning
    double walk_arcsec = 0.0;      // random walk that adds to it
    double rounding_arcsec = 0.0;  // what is read less the phase, at the end of the half
};

class SyntheticGyro {
public:
    SyntheticGyro(const GyroLaw& law, const MotionLaw& motion, std::uint64_t seed);

    // The next half begins a gap and another helicity; to be called between ticks.
    void open();

    // The motion of the case from the next half on.
    void move_by(const MotionLaw& motion, std::uint64_t seed) {
        motion_ = SyntheticMotion{motion, 0.5 * law_.tick_s, {seed, chance::Cause::synthetic_motion}};
    }

    // more_arcsec  rotation in this half beyond the motion of the case.
    SyntheticHalf advance(double more_arcsec = 0.0);

    // Noise and nonsense counts from here on are those of another seed: for a copy that is to differ from its original.
    void draw_anew(std::uint64_t seed) { draw_ = chance::Draw{seed, chance::Cause::synthetic_gyro}; }

private:
    void in_gap(SyntheticHalf& half);
    void measure(SyntheticHalf& half);
    void sample_light(SyntheticHalf& half, const std::vector<double>& ratios);
    void read_count(SyntheticHalf& half, bool settled);
    [[nodiscard]] double magnetic_arcsec_s() const;

    GyroLaw law_;
    SyntheticMotion motion_;
    chance::Draw draw_;
    std::vector<DecayHalf> decay_;
    std::int64_t half_ = 0;
    int gap_left_ = 0;  // halves
    std::int8_t first_sign_, mode_ = 1;
    double miss_lambda_ = 0.0;  // with the sign of this switch
    std::int64_t since_closing_;
    double phase_counts_;  // of what the counter counts
    FringeReader fringe_;
    std::array<float, core::max_light_samples> light_a_{}, light_b_{};
};

// (A - B)/(A + B) per wavelength that its light has.
inline constexpr double synthetic_discriminator_per_lambda = 0.332;

}  // namespace zlg::trials
