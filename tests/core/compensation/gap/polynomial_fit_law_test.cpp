// Laws of the fit at random points: against normal equations solved in 113 bits, and as properties.
#include <rapidcheck/gtest.h>
#include <zlg/core/compensation/polynomial_fit.hpp>

#include "compensation/compensation_support.hpp"

namespace zlg::core::polynomial_fit_law_test {

using namespace compensation_test;

constexpr std::int32_t farthest = 64;

// A weight rounds an integer numerator, an integer denominator and their ratio: at most 1.5 units in the last place.
constexpr double weight_tolerance = 3.0 * 0x1p-53;

PolynomialFit fit_of(const std::vector<std::int32_t>& positions, int order) {
    std::array<std::int32_t, max_fit_points> position{};
    for (std::size_t k = 0; k < positions.size(); ++k) position[k] = positions[k];
    return {position, static_cast<int>(positions.size()), order};
}

std::vector<std::int32_t> random_positions(Random& random, int n, int reach) {
    std::set<std::int32_t> chosen;
    while (static_cast<int>(chosen.size()) < n) chosen.insert(random.index(-reach, reach));
    return {chosen.begin(), chosen.end()};
}

// Solution of the normal equations of an order below the number of points, by elimination with the largest pivot.
std::vector<Quad> brute_force_weights(const std::vector<std::int32_t>& positions, int order, int j) {
    const int size = order + 1;
    Quad table[3][4] = {};
    Quad power_j = 1;
    for (int r = 0; r < size; ++r, power_j *= j) {
        table[r][size] = power_j;
        for (int c = 0; c < size; ++c)
            for (const std::int32_t x : positions) table[r][c] += std::pow(static_cast<double>(x), r + c);
    }
    for (int pivot = 0; pivot < size; ++pivot) {
        int best = pivot;
        for (int r = pivot; r < size; ++r)
            if (magnitude(table[r][pivot]) > magnitude(table[best][pivot])) best = r;
        std::swap(table[pivot], table[best]);
        for (int r = 0; r < size; ++r) {
            if (r == pivot) continue;
            const Quad factor = table[r][pivot] / table[pivot][pivot];
            for (int c = pivot; c <= size; ++c) table[r][c] -= factor * table[pivot][c];
        }
    }
    std::vector<Quad> weights;
    for (const Quad x : positions) {
        Quad sum = 0;
        for (int r = size - 1; r >= 0; --r) sum = sum * x + table[r][size] / table[r][r];
        weights.push_back(sum);
    }
    return weights;
}

// So they sum to one, meet every polynomial up to their order, and do not change when points and tick are shifted.
TEST(PolynomialFitLaw, WeightsAreThoseOfTheNormalEquations) {
    Random random{1};
    for (int trial = 0; trial < 20'000; ++trial) {
        const int n = random.index(1, max_fit_points);
        const int order = random.index(0, max_fit_order);
        const auto positions = random_positions(random, n, random.chance(0.5) ? farthest : 10);
        const int j = random.index(-farthest, farthest);
        const FitWeights w = fit_of(positions, order).weights(j);
        const auto exact = brute_force_weights(positions, order < n ? order : n - 1, j);
        for (unsigned k = 0; k < exact.size(); ++k)
            ASSERT_TRUE(magnitude(Quad{w[k]} - exact[k]) <= weight_tolerance * magnitude(exact[k]) + Quad{1e-24})
                << "n " << n << " order " << order << " j " << j << " point " << k;
        for (std::size_t k = exact.size(); k < w.size(); ++k) ASSERT_EQ(w[k], 0.0);
    }
}

rc::Gen<std::vector<std::int32_t>> positions_generator() {
    return rc::gen::suchThat(
        rc::gen::unique<std::vector<std::int32_t>>(rc::gen::inRange(-32, 33)),
        [](const auto& positions) { return !positions.empty() && positions.size() <= max_fit_points; });
}

RC_GTEST_PROP(PolynomialFitLaw, MirroringPointsAndTickChangesNothing, ()) {
    auto positions = *positions_generator();
    const int order = *rc::gen::inRange(0, max_fit_order + 1);
    const std::int32_t j = *rc::gen::inRange(-64, 65);
    const FitWeights before = fit_of(positions, order).weights(j);
    for (std::int32_t& x : positions) x = -x;
    RC_ASSERT(fit_of(positions, order).weights(-j) == before);
}

}  // namespace zlg::core::polynomial_fit_law_test
