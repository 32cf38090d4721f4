#pragma once
// The exponent of noise from means, side by side, of a record.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sums/difference_sums.hpp"

namespace zlg::deviations {

// Of fewer values nothing is said.
inline constexpr std::int64_t min_means = 30;

// Moments of a sequence and of its first and second differences: all that the lag-1 autocorrelation needs.
class LagOne {
public:
    // Not finite: missing; what follows is no neighbour of what came before.
    void add(double value);

    [[nodiscard]] std::int64_t count() const { return level_[0].n; }

    // Of a sequence with spectrum |2 sin(pi f)|^e, e itself.
    //
    //   r1 = lag-1 autocorrelation, delta = r1/(1 + r1); while delta >= 1/4 the sequence is differenced; e = -2 (delta
    //   + d)
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

// Means over m entries, side by side, as noise identification takes them.
class NoiseMeans {
public:
    // m  entries of the array.
    explicit NoiseMeans(std::int64_t m) : m_(m) {}

    // The mean that begins at entry i; entry i + m must be there.
    void add(const RecordView& view, std::int64_t i);
    // What follows is no neighbour of what came before.
    void interrupt();

    [[nodiscard]] std::int64_t count() const { return rate_.count(); }
    // Of the rate's spectrum, absent where LagOne has none.
    [[nodiscard]] std::optional<double> exponent() const;

private:
    std::int64_t m_;
    bool has_gaps_ = false;
    LagOne rate_, angle_;
};

}  // namespace zlg::deviations
