#pragma once
// Means over m entries, side by side, as noise identification takes them from a record or a stream.

#include <cstdint>
#include <optional>

#include "lag_one.hpp"
#include "sums/difference_sums.hpp"

namespace zlg::deviations {

class NoiseMeans {
public:
    // m  entries of the array.
    explicit NoiseMeans(std::int64_t m) : m_(m) {}

    // The mean that begins at entry i; entry i + m must be there.
    void add(const RecordView& view, std::int64_t i);
    // What follows is no neighbour of what came before.
    void interrupt();

    [[nodiscard]] std::int64_t m() const { return m_; }
    [[nodiscard]] std::int64_t count() const { return rate_.count(); }
    // Of the rate's spectrum, absent where LagOne has none. m_intervals  the averaging in intervals of the record.
    [[nodiscard]] std::optional<double> exponent(std::int64_t m_intervals) const;

private:
    std::int64_t m_;
    bool has_gaps_ = false;
    LagOne rate_, angle_;
};

}  // namespace zlg::deviations
