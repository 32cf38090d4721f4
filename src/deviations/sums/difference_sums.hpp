#pragma once
// Sums of squares of differences of a record, for the averaging times of one kind of deviation.

#include <cstdint>
#include <span>
#include <vector>

#include <zlg/deviations/angle_record.hpp>

namespace zlg::deviations {

// Sum of squares over so many terms. Of differences of mean rates in units of a sample: of the angle, divided by m.
struct TermSum {
    double sum = 0.0;
    std::int64_t terms = 0;

    void add(const TermSum& other) {
        sum += other.sum;
        terms += other.terms;
    }
};

// The arrays of a record, and how much of a window must be known.
struct RecordView {
    const double* angle = nullptr;
    const std::uint32_t* known = nullptr;  // none: all known, or phase with NaN
    bool may_be_missing = false;           // an angle may be NaN
    std::int64_t n_intervals = 0;          // entries less one
    double least_known_ratio = 1.0;
};

[[nodiscard]] RecordView view_of(const AngleRecord& record, double least_known_ratio);

// Known intervals that a window of m needs.
[[nodiscard]] double min_known(std::int64_t m, double ratio);

// Terms begin .. end-1 of one averaging time, `order` 2 or 3: those that begin at border i.
[[nodiscard]] TermSum difference_sum(const RecordView& view, int order, std::int64_t m, std::int64_t begin,
                                     std::int64_t end);

// All terms of all averaging times.
[[nodiscard]] std::vector<TermSum> difference_sums(const RecordView& view, int order,
                                                   std::span<const std::int64_t> factors, int threads);

// Terms that begin at 0, m, 2m, ...
[[nodiscard]] TermSum side_by_side_sum(const RecordView& view, int order, std::int64_t m);

// Mean squares of second differences of the averaged angle: the modified Allan variance.
//
// Of differences of rates, as TermSum says; terms begin at every border.
//
//   D_i = 1/m sum_{j<m} d_{i+j},  d_j = (x_{j+2m} - 2 x_{j+m} + x_j)/m
//
// Increments and rates with gaps: each half of D_i is a mean of the known samples under the triangular weights that it
// has without gaps; it counts where least_known_ratio of the weights is known. Phase: D_i is the mean of the d_j that
// are known, where least_known_ratio of them is.
[[nodiscard]] std::vector<TermSum> averaged_sums(const RecordView& view, std::span<const std::int64_t> factors,
                                                 int threads);

// Terms begin .. end-1 of one averaging time.
[[nodiscard]] TermSum averaged_sum(const RecordView& view, std::int64_t m, std::int64_t begin, std::int64_t end);

// Second differences about every border but the first and the last; the angle is doubly reflected: the rate goes on
// backwards at both ends. Of more than half the record there is none.
[[nodiscard]] TermSum total_sum(const RecordView& view, std::int64_t m);

}  // namespace zlg::deviations
