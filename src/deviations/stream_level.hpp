#pragma once
// One level of a stream: every s-th border of it, and what is computed from these.

#include <cstdint>
#include <vector>

#include <zlg/deviations/deviation_kind.hpp>
#include <zlg/deviations/noise_identification.hpp>

#include "noise_means.hpp"
#include "sums/difference_sums.hpp"

namespace zlg::deviations {

// The last entries of a sequence, with the count of known intervals beside each.
class RecentEntries {
public:
    explicit RecentEntries(std::int64_t capacity);

    void push(double angle, double known) {
        angle_[static_cast<std::size_t>(n_)] = angle;
        known_[static_cast<std::size_t>(n_)] = known;
        ++n_;
    }
    [[nodiscard]] bool is_full() const { return n_ == static_cast<std::int64_t>(angle_.size()); }
    void forget_to(std::int64_t kept);

    [[nodiscard]] std::int64_t first() const { return first_; }  // number of the oldest entry since the beginning
    [[nodiscard]] std::int64_t n() const { return n_; }
    [[nodiscard]] const double* angle() const { return angle_.data(); }
    [[nodiscard]] const double* known() const { return known_.data(); }
    [[nodiscard]] std::size_t memory_bytes() const { return 2 * sizeof(double) * angle_.size(); }

private:
    std::vector<double> angle_, known_;
    std::int64_t first_ = 0, n_ = 0;
};

// Sums of one kind at one averaging time of m entries.
struct Track {
    DeviationKind kind;
    std::int64_t m;
    std::int64_t next = 0;  // number of the start that comes next
    TermSum sum{};
};

// Means of m entries, side by side, as they come. Of a long stream runs of them at doubling distances: they tell
// enough.
struct NoiseTrack {
    NoiseMeans means;
    std::int64_t next = 0;
};

// How the entries are to be taken.
struct StreamGaps {
    bool is_phase = false;
    bool any = false;  // so far
    double least_known_ratio = 1.0;
};

class StreamLevel {
public:
    // stride  intervals between entries; window: longest averaging, in entries.
    StreamLevel(std::int64_t stride, std::int64_t window, bool has_averages);

    void add_factor(std::int64_t m, const std::vector<DeviationKind>& kinds);
    void add_noise(std::int64_t m) { noise_.push_back({NoiseMeans(m)}); }

    // A border of the stream at this stride, and the sum over the borders from here to the next entry, when it is
    // known.
    void push_border(double angle, double known, const StreamGaps& gaps);
    void push_average(double angle_sum, double known_sum, const StreamGaps& gaps);

    [[nodiscard]] std::int64_t stride() const { return stride_; }
    // All terms so far, also of what has not been summed up yet.
    [[nodiscard]] TermSum sum_of(DeviationKind kind, std::int64_t m, const StreamGaps& gaps) const;
    // What is known of the noise, appended with rising m.
    void append_steps(std::vector<NoiseStep>& steps, const StreamGaps& gaps) const;
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    void take_all(const RecentEntries& entries, bool averages, const StreamGaps& gaps);

    std::int64_t stride_, window_;
    bool has_averages_;
    RecentEntries borders_, averages_;
    std::vector<Track> tracks_;
    std::vector<NoiseTrack> noise_;
};

}  // namespace zlg::deviations
