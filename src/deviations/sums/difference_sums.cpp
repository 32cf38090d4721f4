#include "difference_sums.hpp"

#include <algorithm>
#include <cmath>

#include <zlg/numeric/parallel.hpp>
#include "lane_sum.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t chunk_starts = 16 * block_starts;  // of one thread

ZLG_VECTOR_WIDTHS double second_squares(const double* a, std::int64_t m, std::int64_t n) {
    const double* b = a + m;
    const double* c = b + m;
    return lane_sum(
        n, [=](std::int64_t i) __attribute__((always_inline)) {
            const double d = (c[i] - b[i]) - (b[i] - a[i]);
            return d * d;
        });
}

ZLG_VECTOR_WIDTHS double third_squares(const double* a, std::int64_t m, std::int64_t n) {
    const double* b = a + m;
    const double* c = b + m;
    const double* e = c + m;
    return lane_sum(
        n, [=](std::int64_t i) __attribute__((always_inline)) {
            const double middle = c[i] - b[i];
            const double d = ((e[i] - c[i]) - middle) - (middle - (b[i] - a[i]));
            return d * d;
        });
}

ZLG_VECTOR_WIDTHS TermSum second_squares_of_known(const double* a, std::int64_t m, std::int64_t n) {
    const double* b = a + m;
    const double* c = b + m;
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double d = (c[i] - b[i]) - (b[i] - a[i]);
            square = d == d ? d * d : 0.0;
            one = d == d ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

ZLG_VECTOR_WIDTHS TermSum third_squares_of_known(const double* a, std::int64_t m, std::int64_t n) {
    const double* b = a + m;
    const double* c = b + m;
    const double* e = c + m;
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double middle = c[i] - b[i];
            const double d = ((e[i] - c[i]) - middle) - (middle - (b[i] - a[i]));
            square = d == d ? d * d : 0.0;
            one = d == d ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

// Windows are shorter than 2^31, and to that a processor converts many at a time.
ZLG_INLINE double between(std::uint32_t before, std::uint32_t after) {
    return static_cast<std::int32_t>(after - before);
}
ZLG_INLINE double between(double before, double after) { return after - before; }

// Means of what is known in each window; times 2/m over 1/n1 + 1/n2, so that white noise keeps its expectation.
//
// whole  intervals in a window of m entries.
template <class Count>
ZLG_INLINE TermSum second_squares_of_means(const double* a, const Count* p, std::int64_t m, std::int64_t n,
                                           double least, double whole) {
    const double* b = a + m;
    const double* c = b + m;
    const Count* q = p + m;
    const Count* r = q + m;
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double n1 = between(p[i], q[i]), n2 = between(q[i], r[i]);
            const double d = (c[i] - b[i]) / n2 - (b[i] - a[i]) / n1;
            const bool known = n1 >= least && n2 >= least;
            square = known ? d * d * (2.0 * n1 * n2) / (whole * (n1 + n2)) : 0.0;
            one = known ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

template <class Count>
ZLG_INLINE TermSum third_squares_of_means(const double* a, const Count* p, std::int64_t m, std::int64_t n, double least,
                                          double whole) {
    const double* b = a + m;
    const double* c = b + m;
    const double* e = c + m;
    const Count* q = p + m;
    const Count* r = q + m;
    const Count* s = r + m;
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double n1 = between(p[i], q[i]), n2 = between(q[i], r[i]), n3 = between(r[i], s[i]);
            const double middle = (c[i] - b[i]) / n2;
            const double d = ((e[i] - c[i]) / n3 - middle) - (middle - (b[i] - a[i]) / n1);
            const bool known = n1 >= least && n2 >= least && n3 >= least;
            square = known ? d * d * 6.0 / (whole * (1.0 / n1 + 4.0 / n2 + 1.0 / n3)) : 0.0;
            one = known ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

ZLG_VECTOR_WIDTHS TermSum squares_of_means(const double* a, const std::uint32_t* p, int order, std::int64_t m,
                                           std::int64_t n, double least, double whole) {
    return order == 2 ? second_squares_of_means(a, p, m, n, least, whole)
                      : third_squares_of_means(a, p, m, n, least, whole);
}

ZLG_VECTOR_WIDTHS TermSum squares_of_means_in_stream(const double* a, const double* p, int order, std::int64_t m,
                                                     std::int64_t n, double least, double whole) {
    return order == 2 ? second_squares_of_means(a, p, m, n, least, whole)
                      : third_squares_of_means(a, p, m, n, least, whole);
}

}  // namespace

RecordView view_of(const AngleRecord& record, double least_known_ratio) {
    return {.angle = record.angle().data(),
            .known = record.known().empty() ? nullptr : record.known().data(),
            .may_be_missing = record.what().kind == DataKind::phase && record.has_gaps(),
            .n_intervals = record.n_intervals(),
            .least_known_ratio = least_known_ratio};
}

double min_known(std::int64_t m, double ratio) {
    // Rounding of ratio * m must not ask for one more than ratio says.
    return std::max(1.0, std::ceil(ratio * static_cast<double>(m) * (1.0 - 1e-12)));
}

TermSum difference_sum(const RecordView& view, int order, std::int64_t m, std::int64_t begin, std::int64_t end) {
    const std::int64_t n = std::min(end, view.n_intervals - order * m + 1) - begin;
    if (n <= 0) return {};
    const double* a = view.angle + begin;
    const std::int64_t intervals = m * view.stride;
    const double least = min_known(intervals, view.least_known_ratio), whole = static_cast<double>(intervals);
    if (view.known != nullptr) return squares_of_means(a, view.known + begin, order, m, n, least, whole);
    if (view.known_real != nullptr)
        return squares_of_means_in_stream(a, view.known_real + begin, order, m, n, least, whole);
    TermSum sum;
    if (view.may_be_missing)
        sum = order == 2 ? second_squares_of_known(a, m, n) : third_squares_of_known(a, m, n);
    else
        sum = {order == 2 ? second_squares(a, m, n) : third_squares(a, m, n), n};
    sum.sum /= whole * whole;
    return sum;
}

std::vector<TermSum> difference_sums(const RecordView& view, int order, std::span<const std::int64_t> factors,
                                     int threads) {
    if (factors.empty()) return {};
    const std::int64_t starts = std::max<std::int64_t>(0, view.n_intervals - order * std::ranges::min(factors) + 1);
    const std::int64_t n_chunks = (starts + chunk_starts - 1) / chunk_starts;
    std::vector<TermSum> of_chunk(static_cast<std::size_t>(n_chunks) * factors.size());
    numeric::in_parallel(static_cast<std::size_t>(n_chunks), threads, [&](std::int64_t chunk) {
        TermSum* sums = of_chunk.data() + static_cast<std::size_t>(chunk) * factors.size();
        for (std::int64_t begin = chunk * chunk_starts; begin < (chunk + 1) * chunk_starts; begin += block_starts)
            for (std::size_t k = 0; k < factors.size(); ++k)
                sums[k].add(difference_sum(view, order, factors[k], begin, begin + block_starts));
    });
    std::vector<TermSum> total(factors.size());
    for (std::size_t k = 0; k < of_chunk.size(); ++k) total[k % factors.size()].add(of_chunk[k]);
    return total;
}

TermSum side_by_side_sum(const RecordView& view, int order, std::int64_t m) {
    TermSum total;
    for (std::int64_t begin = 0; begin + order * m <= view.n_intervals; begin += m)
        total.add(difference_sum(view, order, m, begin, begin + 1));
    return total;
}

}  // namespace zlg::deviations
