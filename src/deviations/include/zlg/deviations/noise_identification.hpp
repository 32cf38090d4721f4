#pragma once
// Which power law f^noise the rate's spectrum follows around an averaging time.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <zlg/deviations/angle_record.hpp>

namespace zlg::deviations {

// Moments of a sequence and of its first and second differences: all that the lag-1 autocorrelation needs.
class LagOne {
public:
    // Not finite: missing; what follows is no neighbour of what came before.
    void add(double value);

    [[nodiscard]] std::int64_t count() const { return level_[0].n; }

    // Of a sequence with spectrum |2 sin(pi f)|^e, e itself.
    //
    //   r1 = lag-1 autocorrelation, delta = r1/(1 + r1); while delta >= 1/4 the sequence is differenced; e = -2 (delta + d)
    //
    // absent  fewer than 30 values, or constant.
    // source  W. Riley, C. Greenhall, "Power law noise identification using the lag 1 autocorrelation", EFTF 2004.
    [[nodiscard]] std::optional<double> exponent() const;

private:
    struct Level {
        std::int64_t n = 0, pairs = 0;
        double origin = 0.0, sum = 0.0, square = 0.0, product = 0.0, head = 0.0, tail = 0.0;
        double previous = 0.0;
        bool has_previous = false;
    };
    void add_to(std::size_t order, double value);

    std::array<Level, 3> level_;
};

// The exponent found from means over m intervals.
struct NoiseStep {
    std::int64_t m = 1;
    std::int64_t means = 0;
    double noise = 0.0;  // 2 ... -4, between whole numbers where laws mix
};

// At m = 1, 2, 4, ... as long as there are 30 means.
//
// The lag-1 exponent of the mean rates is not the spectrum's own: averaging over m leaves -1.45 for -1, -2.40 for -2, -3.93
// for -3, -4.57 for -4, and in these numbers the scale is bent straight. White and flicker angle noise are distinguished from the
// angle averaged over m, for which sampling at distance m would make them alike; with gaps from the rates as well as may be.
[[nodiscard]] std::vector<NoiseStep> noise_steps(const AngleRecord& record, double least_known_ratio);

// At any m: the mean of the three steps up to m, each with the weight of its number of means, so that chance in the few means of
// a long averaging does not decide; beyond the last step, there. absent  no step.
[[nodiscard]] std::optional<double> noise_exponent(std::span<const NoiseStep> steps, std::int64_t m);

}  // namespace zlg::deviations
