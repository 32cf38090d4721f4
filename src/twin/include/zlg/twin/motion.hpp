#pragma once
// Rotation of the gyro's case, as an angle that is a function of time.
//
// Increments are exact differences of that angle, so they add up to it whatever the steps.

#include <memory>
#include <span>
#include <vector>

namespace zlg::twin {

struct Sine {
    double amplitude_arcsec_s = 0.0;
    double frequency_hz = 0.0;
    double phase_deg = 0.0;  // rate = amplitude * sin(2 pi frequency t + phase)
};

// From an instant on the case turns at this rate, which grows by a slope, until the next step.
struct RateStep {
    double at_s = 0.0;
    double rate_arcsec_s = 0.0;
    double slope_arcsec_s2 = 0.0;
};

class Motion {
public:
    static Motion rest();
    // A constant rate plus any number of sines. Numbers that are not finite: std::invalid_argument.
    static Motion sines(double rate_arcsec_s, const std::vector<Sine>& sines);
    // increment k is the rotation from k/rate_hz to (k + 1)/rate_hz; the angle between is a smooth cubic.
    // errors  std::invalid_argument: no increments, one that is not finite, a rate that is not positive.
    static Motion from_increments(std::vector<double> increment_arcsec, double rate_hz);

    // `base`, and added to it a rate in steps, 0 before the first. Steps may be added at any time, as by a hand that
    // turns the gyro while it runs, each later than the one before.
    static Motion with_steps(Motion base, std::shared_ptr<const std::vector<RateStep>> steps);

    // Rotation from t0_s to t1_s. Beyond the end of sampled motion the case rests.
    [[nodiscard]] double increment_arcsec(double t0_s, double t1_s) const;

    // Those of equal steps from t0_s on, to 1e-12 of the fastest.
    void increments_arcsec(double t0_s, double step_s, std::span<double> out) const;

    // Length of sampled motion; infinite for analytic motion.
    [[nodiscard]] double duration_s() const;

    // No rate is larger; infinite where no bound is known.
    [[nodiscard]] double fastest_arcsec_s() const;
    // One rate for ever.
    [[nodiscard]] bool is_even() const;

    class Source;

private:
    explicit Motion(std::shared_ptr<const Source> source);
    std::shared_ptr<const Source> source_;
};

}  // namespace zlg::twin
