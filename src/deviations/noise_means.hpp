#pragma once
// Means over m entries, side by side, as noise identification takes them from a record or a stream.

#include <cstdint>
#include <optional>

#include <zlg/deviations/noise_identification.hpp>

#include "difference_sums.hpp"

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
    // m_intervals  the same averaging, for the result.
    [[nodiscard]] std::optional<NoiseStep> step(std::int64_t m_intervals) const;

private:
    std::int64_t m_;
    bool has_gaps_ = false;
    LagOne rate_, angle_;
};

}  // namespace zlg::deviations
