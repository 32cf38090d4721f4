// Expectations in closed form for each kind of noise, and what the deviations are to one another.

#include <zlg/deviations/deviation.hpp>

#include "test.hpp"

namespace zlg::deviations::deviation_laws_test {

constexpr int records = 200;
constexpr int n = 420;

std::vector<double> rates_of_law(int noise, std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    std::vector<double> values(n);
    for (auto& value : values) value = normal(engine);
    if (noise == 2) std::adjacent_difference(values.begin(), values.end(), values.begin());
    if (noise == -2) std::partial_sum(values.begin(), values.end(), values.begin());
    return values;
}

struct Law {
    DeviationKind kind;
    int noise;
    double (*variance)(double m);
};

// White noise of the angle (each difference of it twice), of the rate, and a random walk of the rate; of variance 1.
const std::vector<Law> laws{
    {DeviationKind::adev, 2, [](double m) { return 3.0 / (m * m); }},
    {DeviationKind::oadev, 2, [](double m) { return 3.0 / (m * m); }},
    {DeviationKind::mdev, 2, [](double m) { return 3.0 / (m * m * m); }},
    {DeviationKind::tdev, 2, [](double m) { return 1.0 / m; }},
    {DeviationKind::hdev, 2, [](double m) { return 10.0 / (3.0 * m * m); }},
    {DeviationKind::ohdev, 2, [](double m) { return 10.0 / (3.0 * m * m); }},
    {DeviationKind::adev, 0, [](double m) { return 1.0 / m; }},
    {DeviationKind::oadev, 0, [](double m) { return 1.0 / m; }},
    {DeviationKind::mdev, 0, [](double m) { return (m * m + 1.0) / (2.0 * m * m * m); }},
    {DeviationKind::hdev, 0, [](double m) { return 1.0 / m; }},
    {DeviationKind::ohdev, 0, [](double m) { return 1.0 / m; }},
    {DeviationKind::totdev, 0, [](double m) { return 1.0 / m; }},
    {DeviationKind::adev, -2, [](double m) { return (2.0 * m * m + 1.0) / (6.0 * m); }},
    {DeviationKind::oadev, -2, [](double m) { return (2.0 * m * m + 1.0) / (6.0 * m); }},
    {DeviationKind::ohdev, -2, [](double m) { return (m * m + 1.0) / (6.0 * m); }},
};

TEST(DeviationLaws, have_the_expectations_that_each_noise_has_in_closed_form) {
    for (const auto& law : laws)
        for (const std::int64_t m : {1, 5, 20}) {
            std::mt19937_64 engine(41);
            double sum = 0.0, edf = 0.0;
            for (int r = 0; r < records; ++r) {
                const auto values = rates_of_law(law.noise, engine);
                const std::array factors{m};
                const auto point =
                    deviation(AngleRecord(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values}), law.kind,
                              factors, {.noise = law.noise})
                        .points.at(0);
                sum += point.deviation * point.deviation;
                edf = point.law.edf;
            }
            const double expected = law.variance(static_cast<double>(m));
            // Five standard deviations of the mean over all records.
            EXPECT_NEAR(sum / records / expected, 1.0, 5.0 * std::sqrt(2.0 / (edf * records)))
                << name_of(law.kind) << " f^" << law.noise << " m " << m;
        }
}

// Mirroring biases by a known factor; freed of it the total variance agrees with the plain one.
TEST(DeviationLaws, of_the_total_deviation_are_those_of_the_plain_one) {
    std::mt19937_64 engine(42);
    double total = 0.0, plain = 0.0;
    for (int r = 0; r < 300; ++r) {
        const auto values = rates_of_law(-2, engine);
        const AngleRecord record(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values});
        const std::array<std::int64_t, 1> factors{20};
        const double a = deviation(record, DeviationKind::totdev, factors, {.noise = -2}).points[0].deviation;
        const double b = deviation(record, DeviationKind::oadev, factors, {.noise = -2}).points[0].deviation;
        total += a * a;
        plain += b * b;
    }
    EXPECT_NEAR(total / plain, 1.0, 0.05);
}

// A drift R of the rate: R tau/sqrt 2.
TEST(DeviationLaws, of_a_drift_is_exact) {
    std::vector<double> values(200);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 3.0 + 0.25 * static_cast<double>(k);
    const AngleRecord record(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values});
    const std::array<std::int64_t, 3> factors{1, 7, 30};
    for (const auto kind : {DeviationKind::adev, DeviationKind::oadev, DeviationKind::mdev})
        for (const auto& point : deviation(record, kind, factors).points)
            EXPECT_NEAR(point.deviation, 0.25 * point.tau_s / std::sqrt(2.0), 1e-10) << name_of(kind);
}

// White noise with a tenth of the samples missing keeps its expectation.
TEST(DeviationLaws, of_white_noise_hold_with_gaps) {
    for (const auto kind : {DeviationKind::oadev, DeviationKind::ohdev, DeviationKind::totdev}) {
        std::mt19937_64 engine(43);
        std::bernoulli_distribution missing(0.1);
        double sum = 0.0;
        const std::array<std::int64_t, 1> factors{10};
        for (int r = 0; r < 1000; ++r) {
            auto values = rates_of_law(0, engine);
            for (auto& value : values)
                if (missing(engine)) value = std::nan("");
            const auto point =
                deviation(AngleRecord(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values}), kind,
                          factors, {.least_known_ratio = 0.5, .noise = 0})
                    .points.at(0);
            sum += point.deviation * point.deviation;
        }
        EXPECT_NEAR(sum / 1000 * 10.0, 1.0, 0.025) << name_of(kind);
    }
}

}  // namespace zlg::deviations::deviation_laws_test
