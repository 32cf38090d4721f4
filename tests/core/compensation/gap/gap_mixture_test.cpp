// The mixture against the same models by dense matrices, and its limits.

#include <zlg/core/compensation/gap_mixture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace zlg::core {
namespace gap_mixture_test {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// A motion of a given covariance: a decaying wave, with the rounding of a counter.
struct Given {
    CompensationConstants gyro{.scale = Arcsec{2.0}};
    OptimalBridgeConfig config{.learns = false};
    MotionMomentsState moments{};

    Given() {
        for (std::size_t k = 0; k < config.prior_arcsec2.size(); ++k) {
            const auto lag = static_cast<double>(k);
            config.prior_arcsec2[k] = 3.0 * std::exp(-0.05 * lag) * std::cos(0.4 * lag);
        }
    }
    [[nodiscard]] MotionCovariance covariance() const { return {gyro, config, moments, fast_memory}; }
};

struct Points {
    int n_gap = 3, n_side = 8;
    std::vector<int> place;
    Vector value;
    Matrix error;
};

Points points_of(int n_gap, int n_side, double (*value)(int place)) {
    Points p{.n_gap = n_gap, .n_side = n_side, .place = {}, .value = {}, .error = {}};
    for (int k = 0; k < 2 * n_side; ++k)
        if (k != 1) p.place.push_back(k < n_side ? k : k + n_gap);  // one is missing
    const auto n = static_cast<Eigen::Index>(p.place.size());
    p.value.resize(n);
    p.error = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        p.value[i] = value(p.place[static_cast<std::size_t>(i)]);
        for (Eigen::Index j = 0; j < n; ++j)
            if (p.place[static_cast<std::size_t>(std::min(i, j))] >= n_side + n_gap)
                p.error(i, j) = 0.5 * std::pow(-0.6, std::abs(static_cast<double>(i - j)));
    }
    return p;
}

MixtureEstimate estimate_of(const MotionCovariance& covariance, const Points& p, bool learnt = true) {
    GapMixture m;
    m.learnt = learnt;
    m.points.n_gap = p.n_gap;
    m.points.n_side = p.n_side;
    for (std::size_t k = 0; k < p.place.size(); ++k) {
        MixtureColumn error{};
        for (std::size_t i = 0; i <= k; ++i)
            error[i] = p.error(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i));
        m.points.error_with_all[k] = p.error.row(static_cast<Eigen::Index>(k)).sum();
        add_point(covariance, m, p.place[k], p.value[static_cast<Eigen::Index>(k)], error);
    }
    m.points.error_variance = p.error.sum();
    while (!is_done(m)) advance(covariance, m);
    EXPECT_FALSE(m.failed);
    return m.estimate;
}

// Covariance of two ticks of a walk that begins at 0, by Gauss's rule of three places, which is exact for its polynomials: of one tick
// over the triangle s < t, of two over the square.
double walk(bool of_acceleration, double a, double b) {
    if (a > b) return walk(of_acceleration, b, a);
    constexpr std::array<double, 3> place{0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array<double, 3> weight{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
    const auto covariance = [&](double s, double t) { return of_acceleration ? s * s * (3.0 * t - s) / 6.0 : s; };
    if (b + 1.0 <= 0.0 || a + 1.0 <= 0.0) return 0.0;
    const double from = std::max(0.0, a);
    const double length = a + 1.0 - from;
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double later = place[i] * length;
            if (a == b)
                sum += 2.0 * weight[i] * weight[j] * length * later * covariance(from + later * place[j], from + later);
            else
                sum += weight[i] * weight[j] * length * covariance(from + later, b + place[j]);
        }
    }
    return sum;
}

// Covariance of two ticks of a motion with a flat spectrum of the rate up to c cycles a tick, over that of one tick, by Simpson's
// rule over the frequencies.
double below(double c, int distance) {
    constexpr int n = 2000;
    long double sum = 0.0L;
    long double one = 0.0L;
    for (int k = 0; k <= n; ++k) {
        const long double x = std::numbers::pi_v<long double> * c * k / n;
        const long double power = k == 0 ? 1.0L : std::pow(std::sin(x) / x, 2.0L);
        const long double weight = k == 0 || k == n ? 1.0L : (k % 2 == 0 ? 2.0L : 4.0L);
        sum += weight * power * std::cos(2.0L * x * distance);
        one += weight * power;
    }
    return static_cast<double>(sum / one);
}

// Every model, with explicit inverses in long double. Where nothing was learnt: walks, white motion and bands.
MixtureEstimate dense(const MotionCovariance& covariance, const Points& p, bool was_learnt = true) {
    using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    using Column = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
    const auto n = static_cast<Eigen::Index>(p.place.size());
    const int width = 2 * p.n_side + p.n_gap;
    // Points, then the ticks of the gap.
    std::vector<int> place = p.place;
    for (int j = 0; j < p.n_gap; ++j) place.push_back(p.n_side + j);
    const auto all = static_cast<Eigen::Index>(place.size());
    Wide learnt(all, all);
    for (Eigen::Index i = 0; i < all; ++i)
        for (Eigen::Index j = 0; j < all; ++j)
            learnt(i, j) = covariance.of_ticks(place[static_cast<std::size_t>(i)], place[static_cast<std::size_t>(j)]);
    learnt.topLeftCorner(n, n) += p.error.cast<long double>();

    struct Case {
        Wide added;
        bool reversed;
        double least, step;
        int sizes;
    };
    std::vector<Case> cases;
    const auto add = [&](bool reversed, double least, double step, int sizes, auto&& of) {
        Wide added = Wide::Zero(all, all);
        for (Eigen::Index i = 0; i < all; ++i) {
            for (Eigen::Index j = 0; j < all; ++j) {
                const auto at = [&](Eigen::Index k) {
                    const int own = place[static_cast<std::size_t>(k)];
                    return reversed ? width - 1 - own : own;
                };
                added(i, j) = of(at(i), at(j));
            }
        }
        cases.push_back({added, reversed, least, step, sizes});
    };
    for (const bool of_acceleration : {false, true}) {
        for (const bool reversed : {true, false})
            for (const double quiet : {2.0, 3.0, 4.5, 6.0}) {
                const double onset = p.n_side + p.n_gap + quiet;
                if (was_learnt)
                    add(reversed, 0.25, 64.0, 6,
                        [&](int i, int j) { return walk(of_acceleration, i - onset, j - onset); });
            }
        add(false, of_acceleration ? 1.0 / 1024.0 : 1.0 / 16.0, was_learnt ? 8.0 : 6.0, 13,
            [&](int i, int j) { return walk(of_acceleration, i, j); });
    }
    if (!was_learnt) {
        add(false, 0.3, 9.0, 13, [](int i, int j) { return i == j ? 1.0 : 0.0; });
        for (const double c : {0.05, 0.1, 0.15, 0.225}) {
            std::vector<double> by_distance;
            for (int k = 0; k < width; ++k) by_distance.push_back(below(c, k));
            add(false, 0.3, 14.0, 11,
                [&](int i, int j) { return by_distance[static_cast<std::size_t>(std::abs(i - j))]; });
        }
    }
    int models = 0;
    for (const Case& c : cases) models += c.sizes;

    // Least variance of a point, the earlier ones given, in the order of the factor in which a shape is treated: both orders.
    const auto smallest_of = [&](bool reversed) {
        Matrix v = learnt.topLeftCorner(n, n).cast<double>();
        if (reversed) v = v.reverse().eval();
        const Matrix l = v.llt().matrixL();
        return std::pow(l.diagonal().minCoeff(), 2);
    };
    struct Found {
        long double log_weight, value, variance, rate;
        Column dual, ticks;
    };
    const auto solve = [&](const Wide& added, long double s2) {
        const Wide v = learnt + s2 * added;
        const Wide inverse = v.topLeftCorner(n, n).inverse();
        const Column h = Column::Ones(n);
        const Column z = p.value.cast<long double>();
        const long double information = h.dot(inverse * h);
        Found f;
        f.rate = h.dot(inverse * z) / information;
        f.dual = inverse * (z - f.rate * h);
        f.ticks = v.bottomLeftCorner(all - n, n) * f.dual + f.rate * Column::Ones(all - n);
        Column k = v.topRightCorner(n, all - n).rowwise().sum();
        k -= p.error.cast<long double>().rowwise().sum();
        const long double gain = p.n_gap - h.dot(inverse * k);
        f.value = k.dot(f.dual) + p.n_gap * f.rate;
        f.variance = v.bottomRightCorner(all - n, all - n).sum() + p.error.sum() - k.dot(inverse * k) +
                     gain * gain / information;
        f.log_weight = -0.5L * (z.dot(f.dual) + std::log(v.topLeftCorner(n, n).determinant()) + std::log(information));
        return f;
    };
    const Found nothing = solve(Wide::Zero(all, all), 0.0L);
    const long double prior = was_learnt ? 0.8L : 0.4L;
    MixtureEstimate e{.known = true};
    long double total = prior;
    Column ticks = Column::Zero(all - n);
    Column dual = Column::Zero(n);
    long double off = 0.0L;
    long double coarse = 0.0L;
    long double coarse_off = 0.0L;
    long double coarse_off_sq = 0.0L;
    long double variance = 0.0L;
    long double off_sq = 0.0L;
    long double fine_variance = 0.0L;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        // A walk that begins behind the last point adds nothing and is left out.
        if (cases[c].added.topLeftCorner(n, n).isZero(0.0L)) continue;
        long double s2 = cases[c].least * smallest_of(cases[c].reversed);
        for (int k = 0; k < cases[c].sizes; ++k, s2 *= cases[c].step) {
            const Found f = solve(cases[c].added, s2);
            const long double weight = (1.0L - prior) / models * std::exp(f.log_weight - nothing.log_weight);
            total += weight;
            ticks += weight * f.ticks;
            dual += weight * f.dual;
            off += weight * (f.value - nothing.value);
            off_sq += weight * (f.value - nothing.value) * (f.value - nothing.value);
            fine_variance += weight * f.variance;
            const long double in_variance = was_learnt ? std::pow(weight, 0.25L) : weight;
            coarse += in_variance;
            coarse_off += in_variance * (f.value - nothing.value);
            coarse_off_sq += in_variance * (f.value - nothing.value) * (f.value - nothing.value);
            variance += in_variance * f.variance;
        }
    }
    e.nothing = static_cast<double>(prior / total);
    e.off_arcsec = static_cast<double>(off / total);
    const long double others = (total - prior) / total;
    // How far the weights speak against the model in which nothing is added.
    const long double q = std::max(0.0L, 1.0L - prior / total / 0.6L);
    const auto both = [&](long double in_part, long double in_full) {
        return static_cast<double>(q * others * in_part / coarse + (1.0L - q) * in_full / total);
    };
    e.coarse_off_arcsec = both(coarse_off, off);
    e.coarse_off_arcsec2 = both(coarse_off_sq, off_sq);
    e.variance_arcsec2 = both(variance, fine_variance);
    for (int j = 0; j < p.n_gap; ++j)
        e.value_arcsec[static_cast<std::size_t>(j)] = static_cast<double>(ticks[j] / total);
    for (Eigen::Index i = 0; i < n; ++i) e.dual[static_cast<std::size_t>(i)] = static_cast<double>(dual[i] / total);
    return e;
}

double ramp(int place) { return place < 9 ? 0.3 * ((place * 7) % 5) : 4.0 * (place - 9) + 0.3 * ((place * 7) % 5); }
double rest(int place) { return 0.3 * ((place * 7) % 5); }
double begins_late(int place) { return rest(place) + (place < 14 ? 0.0 : 9.0 * (place - 13)); }
double wave(int place) { return rest(place) + 10.0 * std::cos(0.63 * place); }
double has_ended(int place) { return rest(place) + (place > 4 ? 30.0 : 6.0 * place); }

// unit: of what is compared where it is nearly 0.
void expect_near(const MixtureEstimate& got, const MixtureEstimate& wanted, const Points& p, double unit) {
    ASSERT_TRUE(got.known);
    const auto near = [unit](double a, double b) { EXPECT_NEAR(a, b, 1e-6 * std::abs(b) + 1e-7 * unit); };
    near(got.nothing, wanted.nothing);
    near(got.off_arcsec, wanted.off_arcsec);
    near(got.coarse_off_arcsec, wanted.coarse_off_arcsec);
    near(got.coarse_off_arcsec2, wanted.coarse_off_arcsec2);
    near(got.variance_arcsec2, wanted.variance_arcsec2);
    for (std::size_t j = 0; j < static_cast<std::size_t>(p.n_gap); ++j)
        near(got.value_arcsec[j], wanted.value_arcsec[j]);
    for (std::size_t k = 0; k < p.place.size(); ++k) near(got.dual[k], wanted.dual[k]);
}

struct MixtureLaw : testing::TestWithParam<double (*)(int)> {};

TEST_P(MixtureLaw, IsThatOfDenseMatrices) {
    const Given given;
    const MotionCovariance covariance = given.covariance();
    for (const auto& [n_gap, n_side] : {std::pair{3, 8}, std::pair{1, 8}, std::pair{6, 6}}) {
        const Points p = points_of(n_gap, n_side, GetParam());
        expect_near(estimate_of(covariance, p), dense(covariance, p), p, 1.0);
    }
}

// The readings alone, and six points a side.
TEST_P(MixtureLaw, WithoutALearntMotionIsThatOfDenseMatrices) {
    const Given given;
    const OptimalBridgeConfig readings{.learns = false};
    const MotionCovariance covariance{given.gyro, readings, given.moments, fast_memory};
    for (const auto& [n_gap, n_side] : {std::pair{3, 6}, std::pair{1, 6}, std::pair{7, 6}, std::pair{15, 2}}) {
        const Points p = points_of(n_gap, n_side, GetParam());
        expect_near(estimate_of(covariance, p, false), dense(covariance, p, false), p, 10.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Motions, MixtureLaw, testing::Values(&ramp, &rest, &begins_late, &has_ended, &wave));

TEST(GapMixture, NothingIsFoundWhereTheMotionIsTheLearntOne) {
    const Given given;
    const MotionCovariance covariance = given.covariance();
    EXPECT_GT(estimate_of(covariance, points_of(3, 8, rest)).nothing, prior_of_nothing);
    EXPECT_LT(estimate_of(covariance, points_of(3, 8, ramp)).nothing, 1e-3);
}

// A manoeuvre that begins behind the gap says nothing of the gap: the points before it, which are at rest, do.
TEST(GapMixture, AManoeuvreBehindTheGapLeavesItAlone) {
    const Given given;
    const MotionCovariance covariance = given.covariance();
    const auto sudden = [](int place) { return place < 13 ? 0.0 : 1e3 * (place - 12); };
    const MixtureEstimate e = estimate_of(covariance, points_of(3, 8, sudden));
    EXPECT_LT(e.nothing, 1e-9);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(e.value_arcsec[j], 0.0, 10.0);
}

TEST(GapMixture, TwoPointsAreTooFew) {
    const Given given;
    const MotionCovariance covariance = given.covariance();
    GapMixture m;
    m.points.n_gap = 3;
    m.points.n_side = 8;
    add_point(covariance, m, 7, 1.0, {});
    add_point(covariance, m, 11, 1.0, {});
    while (!is_done(m)) advance(covariance, m);
    EXPECT_TRUE(m.failed);
    EXPECT_FALSE(m.estimate.known);
}

// A covariance that is not positive definite ends the mixture, and so does what is not a number.
TEST(GapMixture, AMatrixWithoutAFactorEndsIt) {
    const Given given;
    const MotionCovariance covariance = given.covariance();
    for (const double wrong : {-1e6, std::nan("")}) {
        GapMixture m;
        m.points.n_gap = 3;
        m.points.n_side = 8;
        for (int k = 0; k < 4; ++k) {
            MixtureColumn error{};
            if (k == 2) error[2] = wrong;
            add_point(covariance, m, k, 1.0, error);
        }
        while (!is_done(m)) advance(covariance, m);
        EXPECT_TRUE(m.failed);
        EXPECT_FALSE(m.estimate.known);
    }
}

}  // namespace gap_mixture_test
}  // namespace zlg::core
