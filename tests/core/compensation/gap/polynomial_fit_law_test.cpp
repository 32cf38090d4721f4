// Laws of the fit at random points: against normal equations solved in 113 bits, and as properties.
#include <zlg/core/compensation/polynomial_fit.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "compensation/compensation_support.hpp"

namespace polynomial_fit_law_test {

using namespace zlg::core;
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

TEST(PolynomialFitLaw, PolynomialsUpToItsOrderAreMetAtEveryTick) {
    Random random{2};
    for (int n = 1; n <= max_fit_points; ++n)
        for (int order = 0; order <= max_fit_order && order < n; ++order)
            for (int trial = 0; trial < 5; ++trial) {
                const auto positions = random_positions(random, n, farthest);
                const PolynomialFit fit = fit_of(positions, order);
                std::int64_t coefficient[3] = {};
                for (int r = 0; r <= order; ++r) coefficient[r] = random.integer(-1000, 1000);
                const auto value = [&](std::int64_t x) {
                    return static_cast<double>(coefficient[0] + coefficient[1] * x + coefficient[2] * x * x);
                };
                for (int j = -farthest; j <= farthest; ++j) {
                    const FitWeights w = fit.weights(j);
                    double sum = 0.0;
                    double size = 0.0;
                    for (unsigned k = 0; k < positions.size(); ++k) {
                        sum += w[k] * value(positions[k]);
                        size += std::fabs(w[k] * value(positions[k]));
                    }
                    ASSERT_NEAR(sum, value(j), 5e-15 * size) << "n " << n << " order " << order << " j " << j;
                }
            }
}

TEST(PolynomialFitLaw, WeightsSumToOne) {
    Random random{3};
    for (int trial = 0; trial < 20'000; ++trial) {
        const auto positions = random_positions(random, random.index(1, max_fit_points), farthest);
        const FitWeights w =
            fit_of(positions, random.index(0, max_fit_order)).weights(random.index(-farthest, farthest));
        Quad sum = 0;
        Quad size = 0;
        for (const double x : w) {
            sum += x;
            size += std::fabs(x);
        }
        ASSERT_TRUE(magnitude(sum - 1) <= weight_tolerance * size);
    }
}

// Half the reach, so that a shifted or mirrored set is still allowed.
rc::Gen<std::vector<std::int32_t>> positions_generator() {
    return rc::gen::suchThat(
        rc::gen::unique<std::vector<std::int32_t>>(rc::gen::inRange(-32, 33)),
        [](const auto& positions) { return !positions.empty() && positions.size() <= max_fit_points; });
}

bool close(double a, double b) { return std::fabs(a - b) <= 2.0 * weight_tolerance * std::fabs(a); }

RC_GTEST_PROP(PolynomialFitLaw, ShiftingPointsAndTickShiftsNothing, ()) {
    auto positions = *positions_generator();
    const int order = *rc::gen::inRange(0, max_fit_order + 1);
    const std::int32_t j = *rc::gen::inRange(-32, 33);
    const std::int32_t shift = *rc::gen::inRange(-32, 33);
    const FitWeights before = fit_of(positions, order).weights(j);
    for (std::int32_t& x : positions) x += shift;
    const FitWeights after = fit_of(positions, order).weights(j + shift);
    for (unsigned k = 0; k < positions.size(); ++k) RC_ASSERT(close(before[k], after[k]));
}

RC_GTEST_PROP(PolynomialFitLaw, MirroringPointsAndTickChangesNothing, ()) {
    auto positions = *positions_generator();
    const int order = *rc::gen::inRange(0, max_fit_order + 1);
    const std::int32_t j = *rc::gen::inRange(-64, 65);
    const FitWeights before = fit_of(positions, order).weights(j);
    for (std::int32_t& x : positions) x = -x;
    RC_ASSERT(fit_of(positions, order).weights(-j) == before);
}

RC_GTEST_PROP(PolynomialFitLaw, TheOrderOfThePointsDoesNotMatter, ()) {
    auto positions = *positions_generator();
    const int order = *rc::gen::inRange(0, max_fit_order + 1);
    const std::int32_t j = *rc::gen::inRange(-64, 65);
    const FitWeights before = fit_of(positions, order).weights(j);
    const std::size_t n = positions.size();
    const FitWeights after = fit_of({positions.rbegin(), positions.rend()}, order).weights(j);
    for (std::size_t k = 0; k < n; ++k) RC_ASSERT(after[k] == before[n - 1 - k]);
}

}  // namespace polynomial_fit_law_test
