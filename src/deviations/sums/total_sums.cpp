#include "difference_sums.hpp"

#include <algorithm>

namespace zlg::deviations {
namespace {

// The sum of the increments, or the count of the known ones, continued as if the record ran backwards before its
// beginning and after its end.
double mirrored(const double* sum, std::int64_t k, std::int64_t last) {
    if (k < 0) return 2.0 * sum[0] - sum[-k];
    if (k > last) return 2.0 * sum[last] - sum[2 * last - k];
    return sum[k];
}

double mirrored(const std::uint32_t* count, std::int64_t k, std::int64_t last) {
    if (k < 0) return -static_cast<double>(count[-k]);
    if (k > last) return 2.0 * count[last] - static_cast<double>(count[2 * last - k]);
    return count[k];
}

TermSum mirrored_term(const RecordView& view, std::int64_t m, std::int64_t centre) {
    const std::int64_t last = view.n_intervals;
    const double before = view.angle[centre] - mirrored(view.angle, centre - m, last);
    const double after = mirrored(view.angle, centre + m, last) - view.angle[centre];
    const double whole = static_cast<double>(m);
    if (view.known == nullptr) {
        const double d = (after - before) / whole;
        return d == d ? TermSum{d * d, 1} : TermSum{};
    }
    const double here = view.known[centre];
    const double n1 = here - mirrored(view.known, centre - m, last), n2 = mirrored(view.known, centre + m, last) - here;
    const double least = min_known(m, view.least_known_ratio);
    if (!(n1 >= least && n2 >= least)) return {};
    const double d = after / n2 - before / n1;
    return {d * d * (2.0 * n1 * n2) / (whole * (n1 + n2)), 1};
}

}  // namespace

TermSum total_sum(const RecordView& view, std::int64_t m) {
    const std::int64_t last = view.n_intervals;
    if (2 * m > last) return {};
    // Centres whose windows lie within the record are the terms of the overlapping deviation.
    const std::int64_t past_inside = last - m + 1;
    TermSum total;
    for (std::int64_t centre = 1; centre < m; ++centre) total.add(mirrored_term(view, m, centre));
    constexpr std::int64_t block = 1 << 16;
    for (std::int64_t begin = 0; begin < past_inside - m; begin += block)
        total.add(difference_sum(view, 2, m, begin, std::min(begin + block, past_inside - m)));
    for (std::int64_t centre = past_inside; centre < last; ++centre) total.add(mirrored_term(view, m, centre));
    return total;
}

}  // namespace zlg::deviations
