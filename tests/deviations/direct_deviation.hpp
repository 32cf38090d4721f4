#pragma once
// The deviations from their definitions, one term after another, in extended precision: what the fast paths must agree
// with.

#include <zlg/deviations/deviation_kind.hpp>

#include "test.hpp"

namespace zlg::deviations::direct {

using Real = long double;

// Increments in order; NaN: missing.
struct Increments {
    std::vector<double> value;
    [[nodiscard]] std::int64_t n() const { return static_cast<std::int64_t>(value.size()); }
    // Continued backwards at both ends.
    [[nodiscard]] double at(std::int64_t k) const {
        if (k < 0) k = -1 - k;
        if (k >= n()) k = 2 * n() - 1 - k;
        return value[static_cast<std::size_t>(k)];
    }
};

struct Result {
    Real variance = 0;  // of the rate, in units of an increment
    std::int64_t terms = 0;
};

// Mean of what is known under the weights of a window, and what share of the weights that is.
struct Mean {
    Real value = 0, share = 0;
};

inline Mean mean_from(const Increments& y, std::int64_t begin, std::int64_t m) {
    Real sum = 0, known = 0;
    for (std::int64_t k = begin; k < begin + m; ++k)
        if (!std::isnan(y.at(k))) {
            sum += static_cast<Real>(y.at(k));
            ++known;
        }
    return {known > 0 ? sum / known : 0, known / static_cast<Real>(m)};
}

// The angle averaged over m and then differenced weights the increments by a triangle.
inline Mean triangle_from(const Increments& y, std::int64_t begin, std::int64_t m) {
    Real sum = 0, known = 0;
    for (std::int64_t k = 0; k < 2 * m - 1; ++k) {
        const auto weight = static_cast<Real>(k < m ? k + 1 : 2 * m - 1 - k);
        if (!std::isnan(y.at(begin + k))) {
            sum += weight * static_cast<Real>(y.at(begin + k));
            known += weight;
        }
    }
    return {known > 0 ? sum / known : 0, known / static_cast<Real>(m * m)};
}

class Accumulator {
public:
    explicit Accumulator(Real least) : least_(least * (1 - 1e-12L)) {}
    void two(const Mean& a, const Mean& b) {
        if (a.share < least_ || b.share < least_ || a.share <= 0 || b.share <= 0) return;
        const Real d = b.value - a.value;
        add(d * d * 2 * a.share * b.share / (a.share + b.share) / 2);
    }
    void three(const Mean& a, const Mean& b, const Mean& c) {
        if (a.share < least_ || b.share < least_ || c.share < least_ || a.share <= 0 || b.share <= 0 || c.share <= 0)
            return;
        const Real d = c.value - 2 * b.value + a.value;
        add(d * d / (1 / a.share + 4 / b.share + 1 / c.share));
    }
    void add(Real square) {
        sum_ += square;
        ++terms_;
    }
    [[nodiscard]] Result result() const { return {terms_ > 0 ? sum_ / static_cast<Real>(terms_) : 0, terms_}; }

private:
    Real least_;
    Real sum_ = 0;
    std::int64_t terms_ = 0;
};

// step  between the starts of overlapping terms.
inline Result variance(DeviationKind kind, const Increments& y, std::int64_t m, Real least_known_ratio,
                       std::int64_t step = 1) {
    Accumulator all(least_known_ratio);
    const std::int64_t n = y.n();
    switch (kind) {
        case DeviationKind::adev:
        case DeviationKind::oadev:
            for (std::int64_t i = 0; i + 2 * m <= n; i += kind == DeviationKind::adev ? m : step)
                all.two(mean_from(y, i, m), mean_from(y, i + m, m));
            break;
        case DeviationKind::hdev:
        case DeviationKind::ohdev:
            for (std::int64_t i = 0; i + 3 * m <= n; i += kind == DeviationKind::hdev ? m : step)
                all.three(mean_from(y, i, m), mean_from(y, i + m, m), mean_from(y, i + 2 * m, m));
            break;
        case DeviationKind::mdev:
        case DeviationKind::tdev:
            for (std::int64_t i = 0; i + 3 * m - 1 <= n; i += step)
                all.two(triangle_from(y, i, m), triangle_from(y, i + m, m));
            break;
        case DeviationKind::totdev:
            for (std::int64_t i = 1; i < n; ++i) all.two(mean_from(y, i - m, m), mean_from(y, i, m));
            break;
    }
    return all.result();
}

// From angles, NaN: missing; the kinds that use single angles.
inline Result variance_of_phase(DeviationKind kind, const std::vector<double>& x, std::int64_t m,
                                Real least_known_ratio) {
    const auto n = static_cast<std::int64_t>(x.size());
    const int order = difference_order(kind);
    const auto at = [&](std::int64_t k) {
        if (k < 0) return 2 * static_cast<Real>(x[0]) - static_cast<Real>(x[static_cast<std::size_t>(-k)]);
        if (k >= n)
            return 2 * static_cast<Real>(x[static_cast<std::size_t>(n - 1)]) -
                   static_cast<Real>(x[static_cast<std::size_t>(2 * (n - 1) - k)]);
        return static_cast<Real>(x[static_cast<std::size_t>(k)]);
    };
    const auto second = [&](std::int64_t i) { return (at(i + 2 * m) - 2 * at(i + m) + at(i)) / static_cast<Real>(m); };
    const auto third = [&](std::int64_t i) {
        return (at(i + 3 * m) - 3 * at(i + 2 * m) + 3 * at(i + m) - at(i)) / static_cast<Real>(m);
    };
    Accumulator all(1);
    const auto add = [&](Real d) {
        if (!std::isnan(d)) all.add(d * d / (order == 2 ? 2 : 6));
    };
    const std::int64_t step = kind == DeviationKind::adev || kind == DeviationKind::hdev ? m : 1;
    if (kind == DeviationKind::totdev)
        for (std::int64_t i = 1; i < n - 1; ++i) add(second(i - m));
    else if (kind == DeviationKind::mdev || kind == DeviationKind::tdev)
        for (std::int64_t i = 0; i + 3 * m <= n; ++i) {
            Real sum = 0, known = 0;
            for (std::int64_t j = i; j < i + m; ++j)
                if (!std::isnan(second(j))) {
                    sum += second(j);
                    ++known;
                }
            if (known > 0 && known >= least_known_ratio * static_cast<Real>(m) * (1 - 1e-12L)) add(sum / known);
        }
    else
        for (std::int64_t i = 0; i + order * m < n; i += step) add(order == 2 ? second(i) : third(i));
    return all.result();
}

}  // namespace zlg::deviations::direct
