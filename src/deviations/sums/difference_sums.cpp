#include "difference_sums.hpp"

#include <algorithm>
#include <cmath>

#include <zlg/numeric/parallel.hpp>
#include "lane_sum.hpp"

namespace zlg::deviations {
namespace {

// Terms that are summed at once: what averaging times share stays in the cache.
constexpr std::int64_t block_starts = 4096;
constexpr std::int64_t chunk_starts = 16 * block_starts;  // of one thread

// Of the angle, between entries m apart.
template <int order> ZLG_INLINE double difference(const double* a, std::int64_t m, std::int64_t i) {
    const double* b = a + m;
    const double* c = b + m;
    const double middle = c[i] - b[i];
    if constexpr (order == 2)
        return middle - (b[i] - a[i]);
    else
        return (((c + m)[i] - c[i]) - middle) - (middle - (b[i] - a[i]));
}

template <int order> ZLG_INLINE double squares(const double* a, std::int64_t m, std::int64_t n) {
    return lane_sum(
        n, [=](std::int64_t i) __attribute__((always_inline)) {
            const double d = difference<order>(a, m, i);
            return d * d;
        });
}

template <int order> ZLG_INLINE TermSum squares_of_known(const double* a, std::int64_t m, std::int64_t n) {
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double d = difference<order>(a, m, i);
            square = d == d ? d * d : 0.0;
            one = d == d ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

ZLG_VECTOR_WIDTHS TermSum squares_of(const double* a, bool may_be_missing, int order, std::int64_t m, std::int64_t n) {
    if (may_be_missing) return order == 2 ? squares_of_known<2>(a, m, n) : squares_of_known<3>(a, m, n);
    return {order == 2 ? squares<2>(a, m, n) : squares<3>(a, m, n), n};
}

// Windows are shorter than 2^31, and to that a processor converts many at a time.
ZLG_INLINE double between(std::uint32_t before, std::uint32_t after) {
    return static_cast<std::int32_t>(after - before);
}

// Means of what is known in each window; times 2/m over 1/n1 + 1/n2, so that white noise keeps its expectation.
template <int order>
ZLG_INLINE TermSum squares_of_means(const double* a, const std::uint32_t* p, std::int64_t m, std::int64_t n,
                                    double least) {
    const auto whole = static_cast<double>(m);
    const double* b = a + m;
    const double* c = b + m;
    const std::uint32_t* q = p + m;
    const std::uint32_t* r = q + m;
    const auto sums = lane_sums(
        n, [=](std::int64_t i, double& square, double& one) __attribute__((always_inline)) {
            const double n1 = between(p[i], q[i]), n2 = between(q[i], r[i]);
            const double early = (b[i] - a[i]) / n1, middle = (c[i] - b[i]) / n2;
            bool known = n1 >= least && n2 >= least;
            if constexpr (order == 2) {
                const double d = middle - early;
                square = d * d * (2.0 * n1 * n2) / (whole * (n1 + n2));
            } else {
                const double n3 = between(r[i], (r + m)[i]);
                const double d = (((c + m)[i] - c[i]) / n3 - middle) - (middle - early);
                known = known && n3 >= least;
                square = d * d * 6.0 / (whole * (1.0 / n1 + 4.0 / n2 + 1.0 / n3));
            }
            square = known ? square : 0.0;
            one = known ? 1.0 : 0.0;
        });
    return {sums[0], static_cast<std::int64_t>(sums[1])};
}

ZLG_VECTOR_WIDTHS TermSum squares_of_means(const double* a, const std::uint32_t* p, int order, std::int64_t m,
                                           std::int64_t n, double least) {
    return order == 2 ? squares_of_means<2>(a, p, m, n, least) : squares_of_means<3>(a, p, m, n, least);
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
    if (view.known != nullptr)
        return squares_of_means(a, view.known + begin, order, m, n, min_known(m, view.least_known_ratio));
    TermSum sum = squares_of(a, view.may_be_missing, order, m, n);
    const auto whole = static_cast<double>(m);
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
