#include "difference_sums.hpp"

#include <algorithm>
#include <cstring>

#include <zlg/numeric/parallel.hpp>
#include "lane_sum.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t shortest_chunk = 1 << 16;

// Eight numbers at once, on any machine: what it has no such registers for the compiler takes apart.
constexpr std::int64_t width = 8;
using Eight = double __attribute__((vector_size(width * sizeof(double))));

ZLG_INLINE void load(Eight& to, const double* from) { std::memcpy(&to, from, sizeof to); }

ZLG_VECTOR_WIDTHS double sum_of_second_differences(const double* a, std::int64_t m) {
    const double* b = a + m;
    const double* c = b + m;
    return lane_sum(
        m, [=](std::int64_t i) __attribute__((always_inline)) { return (c[i] - b[i]) - (b[i] - a[i]); });
}

// Squares of D over n starts, n a multiple of 8; `first` is D at their beginning and becomes D at their end. D_i
// follows from the one before by what enters and what leaves: running sums of eight in three steps.
ZLG_VECTOR_WIDTHS double squares_of_eights(const double* a, std::int64_t m, std::int64_t n, double& first) {
    const Eight zero = {};
    Eight before = zero + first, squares = zero;
    for (std::int64_t i = 0; i < n; i += width) {
        Eight x, y, z, w;
        load(x, a + i);
        load(y, a + i + m);
        load(z, a + i + 2 * m);
        load(w, a + i + 3 * m);
        const Eight middle = z - y;
        Eight sum = ((w - z) - middle) - (middle - (y - x));
        sum += __builtin_shufflevector(sum, zero, 8, 0, 1, 2, 3, 4, 5, 6);
        sum += __builtin_shufflevector(sum, zero, 8, 8, 0, 1, 2, 3, 4, 5);
        sum += __builtin_shufflevector(sum, zero, 8, 8, 8, 8, 0, 1, 2, 3);
        const Eight d = before + __builtin_shufflevector(sum, zero, 8, 0, 1, 2, 3, 4, 5, 6);
        squares += d * d;
        before += __builtin_shufflevector(sum, sum, 7, 7, 7, 7, 7, 7, 7, 7);
    }
    first = before[0];
    return ((squares[0] + squares[4]) + (squares[2] + squares[6])) +
           ((squares[1] + squares[5]) + (squares[3] + squares[7]));
}

double remaining_squares(const double* a, std::int64_t m, std::int64_t n, double d) {
    double squares = 0.0;
    for (std::int64_t i = 0; i < n; ++i) {
        squares += d * d;
        if (i + 1 < n) {
            const double middle = a[i + 2 * m] - a[i + m];
            d += ((a[i + 3 * m] - a[i + 2 * m]) - middle) - (middle - (a[i + m] - a[i]));
        }
    }
    return squares;
}

TermSum sum_without_gaps(const double* a, std::int64_t m, std::int64_t n) {
    double d = sum_of_second_differences(a, m);
    // The last start has nothing behind it.
    const std::int64_t eights = (n - 1) / width * width;
    double squares = squares_of_eights(a, m, eights, d);
    squares += remaining_squares(a + eights, m, n - eights, d);
    const double whole = static_cast<double>(m);
    return {squares / (whole * whole * whole * whole), n};
}

// Sum over a window that moves on by one, and the weight that is known in it.
struct MovingWindow {
    double sum = 0.0;
    double known = 0.0;  // a whole number
};

// Angle turned over each of the m intervals that begin in a window, and how many of their samples are known.
struct Turned {
    const RecordView& view;
    std::int64_t m;

    void add(MovingWindow& window, std::int64_t i, double sign) const {
        window.sum += sign * (view.angle[i + m] - view.angle[i]);
        window.known += sign * (static_cast<double>(view.known[i + m]) - static_cast<double>(view.known[i]));
    }
    [[nodiscard]] MovingWindow whole(std::int64_t begin) const {
        MovingWindow window;
        for (std::int64_t i = begin; i < begin + m; ++i) add(window, i, 1.0);
        return window;
    }
};

TermSum sum_of_weighted_means(const RecordView& view, std::int64_t m, std::int64_t begin, std::int64_t end) {
    const Turned turned{view, m};
    const double whole = static_cast<double>(m);
    const double least = view.least_known_ratio * whole * whole * (1.0 - 1e-12);
    auto early = turned.whole(begin), late = turned.whole(begin + m);
    TermSum total;
    for (std::int64_t i = begin; i < end; ++i) {
        const double n1 = early.known, n2 = late.known;
        if (n1 >= least && n2 >= least && n1 > 0.0 && n2 > 0.0) {
            const double d = late.sum / n2 - early.sum / n1;
            total.add({d * d * (2.0 * n1 * n2) / (whole * whole * (n1 + n2)), 1});
        }
        if (i + 1 == end) break;
        turned.add(early, i + m, 1.0);
        turned.add(early, i, -1.0);
        turned.add(late, i + 2 * m, 1.0);
        turned.add(late, i + m, -1.0);
    }
    return total;
}

TermSum sum_of_known_phase(const RecordView& view, std::int64_t m, std::int64_t begin, std::int64_t end) {
    const double* x = view.angle;
    MovingWindow window;
    const auto move = [&](std::int64_t j, bool in) {
        const double d = (x[j + 2 * m] - x[j + m]) - (x[j + m] - x[j]);
        if (!(d == d)) return;
        window.sum += in ? d : -d;
        window.known += in ? 1.0 : -1.0;
    };
    for (std::int64_t j = begin; j < begin + m; ++j) move(j, true);
    const double least = min_known(m, view.least_known_ratio);
    const double whole = static_cast<double>(m);
    TermSum total;
    for (std::int64_t i = begin; i < end; ++i) {
        if (window.known >= least) {
            const double d = window.sum / (window.known * whole);
            total.add({d * d, 1});
        }
        if (i + 1 == end) break;
        move(i + m, true);
        move(i, false);
    }
    return total;
}

}  // namespace

TermSum averaged_sum(const RecordView& view, std::int64_t m, std::int64_t begin, std::int64_t end) {
    const std::int64_t last = std::min(end, view.n_intervals - 3 * m + 2);
    if (last <= begin) return {};
    if (view.known != nullptr) return sum_of_weighted_means(view, m, begin, last);
    if (view.may_be_missing) return sum_of_known_phase(view, m, begin, last);
    return sum_without_gaps(view.angle + begin, m, last - begin);
}

std::vector<TermSum> averaged_sums(const RecordView& view, std::span<const std::int64_t> factors, int threads) {
    struct Piece {
        std::size_t factor;
        std::int64_t begin, end;
    };
    // Each piece begins with the sum over one window: so it is long beside it.
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const std::int64_t length = std::max(shortest_chunk, 4 * factors[k]);
        for (std::int64_t begin = 0; begin < view.n_intervals - 3 * factors[k] + 2; begin += length)
            pieces.push_back({k, begin, begin + length});
    }
    // One place after the other: what several averaging times read there stays in the cache.
    std::ranges::stable_sort(pieces, {}, &Piece::begin);
    std::vector<TermSum> of_piece(pieces.size());
    numeric::in_parallel(pieces.size(), threads, [&](std::int64_t p) {
        const auto& piece = pieces[static_cast<std::size_t>(p)];
        of_piece[static_cast<std::size_t>(p)] = averaged_sum(view, factors[piece.factor], piece.begin, piece.end);
    });
    std::vector<TermSum> total(factors.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) total[pieces[p].factor].add(of_piece[p]);
    return total;
}

}  // namespace zlg::deviations
