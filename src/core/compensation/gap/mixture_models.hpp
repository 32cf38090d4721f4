#pragma once
// The models of one shape of added motion, I + s^2 W in the coordinates of the learnt motion (gap_mixture.hpp).

#include <zlg/core/compensation/gap_mixture.hpp>

#include "motion_shapes.hpp"
#include "tridiagonal.hpp"

namespace zlg::core {

// Row i of the factor, with the reciprocal of the diagonal.
[[nodiscard]] inline const double* row_of(const CholeskyFactorOf<mixture_unknowns>& f, unsigned i) noexcept {
    return f.lower.data() + i * (i + 1) / 2;
}

// C + E of the i-th and k-th point in the order of the factor, k <= i.
[[nodiscard]] inline double covariance_of(const GapMixture& m, unsigned i, unsigned k) noexcept {
    const unsigned row = m.reversed ? point_of(m, k) : i;
    const unsigned column = m.reversed ? point_of(m, i) : k;
    return m.covariance[row * (row + 1) / 2 + column];
}

// What one shape adds, at the points from `first` on, whose places count from `origin`.
struct Added {
    const Shape& shape;
    int origin = 0;
    unsigned first = 0;

    [[nodiscard]] double of(int place_a, int place_b) const noexcept {
        return shape.table[(place_a - origin) * shape.row + place_b - origin];
    }
};

[[nodiscard]] Added added_by(const Shape& shape, const GapMixture& m) noexcept;

[[nodiscard]] MixtureModel nothing_added(const GapMixture& m) noexcept;

// The shape at hand becomes this one: its W first, then H, z and g in the same coordinates.
void reduce(const Shape& shape, GapMixture& m) noexcept;
void prepare(const Shape& shape, GapMixture& m) noexcept;

// I + s^2 W = B D B^T, B unit lower bidiagonal.
struct Bidiagonal {
    MixtureColumn below{}, inverse{};
};

[[nodiscard]] MixtureModel solve(const GapMixture& m, double s2, Bidiagonal& b) noexcept;

// L^T u of a model, in the coordinates of its shape.
void dual_of(const ShapeColumns& c, const Bidiagonal& b, double rate, MixtureColumn& y) noexcept;

}  // namespace zlg::core
