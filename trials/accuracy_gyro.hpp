#pragma once
// A gyro without physics: half-periods, light and truth straight from formulas, a few hundred times faster than the twin.
//
// The counter runs free and truncates. After a gap the bias lacks chi f0 dl^2 along the exact course of the loop; light
// samples read the same course with noise. In the gap the counter reads nonsense, and no magnetic drift is taken.

#include <array>
#include <cstdint>
#include <vector>

#include <zlg/core/records.hpp>

#include "accuracy_law.hpp"
#include "accuracy_loop.hpp"
#include "accuracy_motion.hpp"

namespace zlg::trials {

struct SyntheticHalf {
    core::HalfRecord record{};
    core::LightSamples light{};    // until the next half
    double true_arcsec = 0.0;      // rotation of the case
    double magnetic_arcsec = 0.0;  // drift that adds to it
    double false_arcsec = 0.0;     // by the bias that is lacking
    double rounding_arcsec = 0.0;  // counter less phase, at the end of the half
};

class SyntheticGyro {
public:
    SyntheticGyro(const GyroLaw& law, const MotionLaw& motion, std::uint64_t seed);

    // The next half begins a gap and another helicity; to be called between ticks.
    void open();

    SyntheticHalf advance();

private:
    void blind(SyntheticHalf& half);
    void watch(SyntheticHalf& half);
    void shine(SyntheticHalf& half, std::size_t k);
    [[nodiscard]] double magnetic_arcsec_s() const;

    GyroLaw law_;
    CaseMotion motion_;
    numeric::Draw draw_;
    std::vector<LoopHalfCourse> course_;
    std::int64_t half_ = 0;
    int blind_left_ = 0;  // halves
    std::int8_t first_sign_, mode_ = 1;
    double miss_lambda_ = 0.0;  // with the sign of this switch
    std::int64_t since_closing_;
    double phase_counts_;  // of what the counter counts
    std::array<float, core::max_light_samples> light_a_{}, light_b_{};
};

// (A - B)/(A + B) per wavelength that its light has.
inline constexpr double synthetic_discriminator_per_lambda = 0.332;

}  // namespace zlg::trials
