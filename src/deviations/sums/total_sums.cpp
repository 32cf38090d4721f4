#include "difference_sums.hpp"

#include <algorithm>
#include <vector>

#include <zlg/numeric/parallel.hpp>

#include "lane_sum.hpp"

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
    if (m >= last) return {};
    // Centres whose windows lie within the record are the terms of the overlapping deviation.
    const std::int64_t first_inside = std::min(m, last), past_inside = std::max(first_inside, last - m + 1);
    TermSum total;
    for (std::int64_t centre = 1; centre < std::min(first_inside, last); ++centre)
        total.add(mirrored_term(view, m, centre));
    constexpr std::int64_t block = 1 << 16;
    for (std::int64_t begin = 0; begin < past_inside - first_inside; begin += block)
        total.add(difference_sum(view, 2, m, begin, std::min(begin + block, past_inside - first_inside)));
    for (std::int64_t centre = past_inside; centre < last; ++centre) total.add(mirrored_term(view, m, centre));
    return total;
}

namespace {

constexpr std::int64_t pieces_of_task = 64;

// Work space for one piece of L = 3m values.
//
// Continued evenly at both ends it has the period 2L, and the differences that begin at s and at -L - s are equal; so
// of the 2L starts only those from -L/2 to L/2 are computed. With Q the running sum of the continued piece,
//
//   D_s = (Q(s+3m) - 3 Q(s+2m) + 3 Q(s+m) - Q(s))/m
class Piece {
public:
    explicit Piece(std::int64_t m)
        : m_(m),
          length_(3 * m),
          value_(static_cast<std::size_t>(length_)),
          sum_(static_cast<std::size_t>(2 * length_ + 2)) {}

    [[nodiscard]] double* values() { return value_.data(); }

    // Mean square of D over one period.
    [[nodiscard]] double mean_square() {
        remove_line();
        continue_sum();
        const std::int64_t half = length_ / 2;
        const double* q = sum_.data();
        const double inside = squares(q, m_, 2 * half + 1);
        const double ends = length_ % 2 == 0 ? 0.5 * (squares(q, m_, 1) + squares(q + 2 * half, m_, 1)) : 0.0;
        const double whole = static_cast<double>(m_);
        return (inside - ends) / (whole * whole * static_cast<double>(length_));
    }

private:
    ZLG_VECTOR_WIDTHS static double squares(const double* q, std::int64_t m, std::int64_t n) {
        const double* r = q + m;
        const double* s = r + m;
        const double* t = s + m;
        return lane_sum(
            n, [=](std::int64_t i) __attribute__((always_inline)) {
                const double middle = s[i] - r[i];
                const double d = ((t[i] - s[i]) - middle) - (middle - (r[i] - q[i]));
                return d * d;
            });
    }

    // The line through the means of both halves; of an odd number the middle value belongs to none.
    ZLG_VECTOR_WIDTHS static void remove_line(double* value, std::int64_t length) {
        const std::int64_t half = length / 2, second = length - half;
        const double origin = value[half];
        for (std::int64_t k = 0; k < length; ++k) value[k] -= origin;
        const double early = lane_sum(half, [=](std::int64_t k) { return value[k]; });
        const double late = lane_sum(half, [=](std::int64_t k) { return value[second + k]; });
        const double slope = (late - early) / (static_cast<double>(half) * static_cast<double>(second));
        const double mean = (early + late) / static_cast<double>(2 * half);
        const double centre = 0.5 * static_cast<double>(length - 1);
        for (std::int64_t k = 0; k < length; ++k) value[k] -= mean + slope * (static_cast<double>(k) - centre);
    }
    void remove_line() { remove_line(value_.data(), length_); }

    // sum_[half + k] = Q(k), k = -half .. length + half.
    void continue_sum() {
        const std::int64_t half = length_ / 2;
        double* q = sum_.data() + half;
        q[0] = 0.0;
        for (std::int64_t k = 0; k < length_; ++k) q[k + 1] = q[k] + value_[static_cast<std::size_t>(k)];
        for (std::int64_t k = 1; k <= half; ++k) q[-k] = -q[k];
        for (std::int64_t k = 1; k <= half; ++k) q[length_ + k] = 2.0 * q[length_] - q[length_ - k];
    }

    std::int64_t m_, length_;
    std::vector<double> value_, sum_;
};

// Whether the piece that begins at a place has all its values.
class Completeness {
public:
    Completeness(const RecordView& view, PieceOf what, std::int64_t m)
        : view_(view), intervals_(3 * m - (what == PieceOf::angle ? 1 : 0)) {
        if (!view.may_be_missing) return;
        missing_.push_back(0);
        for (std::int64_t k = 0; k <= view.n_intervals; ++k)
            missing_.push_back(missing_.back() + (view.angle[k] == view.angle[k] ? 0U : 1U));
    }
    [[nodiscard]] bool operator()(std::int64_t begin) const {
        const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(begin + intervals_);
        if (view_.known != nullptr)
            return view_.known[last] - view_.known[first] == static_cast<std::uint32_t>(intervals_);
        return missing_.empty() || missing_[last + 1] == missing_[first];
    }

private:
    const RecordView& view_;
    std::int64_t intervals_;
    std::vector<std::uint32_t> missing_;
};

void fill(Piece& piece, const RecordView& view, PieceOf what, std::int64_t m, std::int64_t begin) {
    const double* x = view.angle + begin;
    double* value = piece.values();
    if (what == PieceOf::angle)
        std::copy(x, x + 3 * m, value);
    else
        for (std::int64_t k = 0; k < 3 * m; ++k) value[k] = x[k + 1] - x[k];
}

}  // namespace

TermSum mirrored_pieces_sum(const RecordView& view, PieceOf what, std::int64_t m, int threads) {
    const std::int64_t n_values = view.n_intervals + (what == PieceOf::angle ? 1 : 0);
    const std::int64_t n_pieces = std::max<std::int64_t>(0, n_values - 3 * m + 1);
    const std::int64_t n_tasks = (n_pieces + pieces_of_task - 1) / pieces_of_task;
    const Completeness complete(view, what, m);
    std::vector<TermSum> of_task(static_cast<std::size_t>(n_tasks));
    numeric::in_parallel(static_cast<std::size_t>(n_tasks), threads, [&](std::int64_t task) {
        Piece piece(m);
        for (std::int64_t n = task * pieces_of_task; n < std::min(n_pieces, (task + 1) * pieces_of_task); ++n) {
            if (!complete(n)) continue;
            fill(piece, view, what, m, n);
            of_task[static_cast<std::size_t>(task)].add({piece.mean_square(), 1});
        }
    });
    TermSum total;
    for (const auto& sum : of_task) total.add(sum);
    if (what == PieceOf::angle) total.sum /= static_cast<double>(m) * static_cast<double>(m);
    return total;
}

}  // namespace zlg::deviations
