#include <zlg/deviations/deviation.hpp>

#include <zlg/deviations/averaging.hpp>

#include "direct_deviation.hpp"
#include "records.hpp"
#include "sums/difference_sums.hpp"
#include "sums/lane_sum.hpp"

namespace zlg::deviations::deviation_test {

double at(const AngleRecord& record, DeviationKind kind, std::int64_t m,
          const DeviationOptions& options = {.noise = 0}) {
    const std::array factors{m};
    return deviation(record, kind, factors, options).points.at(0).deviation;
}

std::vector<double> random_record(std::mt19937_64& engine, int n, bool with_gaps) {
    std::normal_distribution<double> noise(5.0, 2.0);
    std::vector<double> values(static_cast<std::size_t>(n));
    double walk = 0.0;
    for (auto& value : values) value = noise(engine) + (walk += 0.05 * noise(engine) - 0.25);
    if (!with_gaps) return values;
    std::uniform_int_distribution<std::size_t> place(0, values.size() - 1), length(1, 9);
    for (int gap = 0; gap < n / 60; ++gap) {
        const auto begin = place(engine);
        for (auto k = begin; k < std::min(values.size(), begin + length(engine)); ++k) values[k] = not_a_number;
    }
    return values;
}

// A mean of 12 digits is compared with one of 18: what is left is the rounding of the samples' running sum.
constexpr double agreement = 1e-12;

void expect_definition(const AngleRecord& record, DeviationKind kind, std::int64_t m, double ratio,
                       const direct::Result& expected) {
    SCOPED_TRACE(testing::Message() << name_of(kind) << " m " << m << " ratio " << ratio);
    const std::array factors{m};
    const DeviationOptions options{.least_known_ratio = ratio, .noise = 0};
    const auto point = deviation(record, kind, factors, options).points.at(0);
    const double factor = kind == DeviationKind::tdev ? static_cast<double>(m) / std::sqrt(3.0) : 1.0;
    const double value = factor * static_cast<double>(std::sqrt(expected.variance));
    EXPECT_EQ(point.terms, expected.terms);
    EXPECT_NEAR(point.as_computed, value, agreement * value);
}

TEST(Deviation, agrees_with_the_definition_on_random_records) {
    std::mt19937_64 engine(1);
    for (int trial = 0; trial < 4; ++trial) {
        const bool with_gaps = trial % 2 == 1;
        const auto values = random_record(engine, 200 + 13 * trial, with_gaps);
        const auto record = record_of(values);
        for (const double ratio : {1.0, 0.9, 0.5})
            for (const auto kind : all_kinds)
                for (const std::int64_t m : {1, 2, 3, 8, 21, 40, 66}) {
                    const auto expected = direct::variance(kind, {values}, m, static_cast<long double>(ratio));
                    const std::array factors{m};
                    const DeviationOptions options{.least_known_ratio = ratio, .noise = 0};
                    if (expected.terms == 0) {
                        EXPECT_THROW(deviation(record, kind, factors, options), SeriesError);
                        continue;
                    }
                    expect_definition(record, kind, m, ratio, expected);
                }
    }
}

TEST(Deviation, uses_single_known_angles_of_a_phase_record) {
    std::mt19937_64 engine(2);
    for (int trial = 0; trial < 6; ++trial) {
        auto phase = random_record(engine, 300, false);
        double angle = 0.0;
        for (auto& x : phase) x = angle += x;
        if (trial > 0)
            for (std::size_t k = 3; k < phase.size(); k += static_cast<std::size_t>(7 + 5 * trial))
                phase[k] = not_a_number;
        const auto record = record_of(phase, DataKind::phase, 1.0);
        for (const auto kind : {DeviationKind::adev, DeviationKind::oadev, DeviationKind::mdev, DeviationKind::hdev,
                                DeviationKind::ohdev, DeviationKind::totdev})
            for (const std::int64_t m : {1, 2, 5, 30, 80}) {
                const auto expected = direct::variance_of_phase(kind, phase, m, 0.5L);
                ASSERT_GT(expected.terms, 0);
                expect_definition(record, kind, m, 0.5, expected);
            }
    }
}

// Long enough for several blocks, slabs and threads.
TEST(Deviation, agrees_with_the_definition_on_a_long_record) {
    std::mt19937_64 engine(3);
    for (const bool with_gaps : {false, true}) {
        const auto values = random_record(engine, 150000, with_gaps);
        const auto record = record_of(values);
        for (const auto kind : {DeviationKind::oadev, DeviationKind::ohdev, DeviationKind::mdev, DeviationKind::totdev})
            for (const std::int64_t m : {1, 17, 300}) {
                if (kind != DeviationKind::oadev && m == 300) continue;
                const auto expected = direct::variance(kind, {values}, m, 0.5L);
                expect_definition(record, kind, m, 0.5, expected);
            }
    }
}

TEST(Deviation, has_the_same_bits_on_any_number_of_threads) {
    std::mt19937_64 engine(4);
    for (const bool with_gaps : {false, true}) {
        const auto record = record_of(random_record(engine, 300000, with_gaps));
        const std::array<std::int64_t, 4> factors{1, 10, 1000, 50000};
        for (const auto kind : {DeviationKind::oadev, DeviationKind::mdev, DeviationKind::ohdev}) {
            const auto one = deviation(record, kind, factors, {.noise = 0, .threads = 1});
            const auto three = deviation(record, kind, factors, {.noise = 0, .threads = 3});
            ASSERT_EQ(one.points.size(), three.points.size());
            for (std::size_t k = 0; k < one.points.size(); ++k)
                EXPECT_EQ(one.points[k].deviation, three.points[k].deviation);
        }
    }
}

// The sums here are compiled for the plainest processor; those of the library for the one that runs.
TEST(Deviation, has_the_same_bits_with_any_width_of_vectors) {
    std::mt19937_64 engine(10);
    for (const bool with_gaps : {false, true}) {
        const auto record = record_of(random_record(engine, 4000, with_gaps));
        const auto view = view_of(record, 0.5);
        for (const std::int64_t m : {1, 13, 200}) {
            const auto* x = record.angle().data();
            const auto whole = static_cast<double>(m);
            const double sum = lane_sum(3001, [&](std::int64_t i) {
                const double late = x[i + 2 * m] - x[i + m], early = x[i + m] - x[i];
                if (!with_gaps) return (late - early) * (late - early);
                const double n1 =
                    record.known()[static_cast<std::size_t>(i + m)] - record.known()[static_cast<std::size_t>(i)];
                const double n2 = record.known()[static_cast<std::size_t>(i + 2 * m)] -
                                  record.known()[static_cast<std::size_t>(i + m)];
                const double d = late / n2 - early / n1;
                const bool known = n1 >= min_known(m, 0.5) && n2 >= min_known(m, 0.5);
                return known ? d * d * (2.0 * n1 * n2) / (whole * (n1 + n2)) : 0.0;
            });
            EXPECT_EQ(difference_sum(view, 2, m, 0, 3001).sum, with_gaps ? sum : sum / (whole * whole)) << "m " << m;
        }
    }
}

// What the record is called decides what is computed: the same angle given in the three ways.
TEST(Deviation, is_the_same_from_increments_rate_and_phase) {
    std::mt19937_64 engine(5);
    std::vector<double> increments = random_record(engine, 400, false), rate, phase{0.0};
    constexpr double rate_hz = 200.0;
    for (const double d : increments) {
        rate.push_back(d * rate_hz);
        phase.push_back(phase.back() + d);
    }
    for (const auto kind : all_kinds) {
        const double a = at(record_of(increments, DataKind::increments, rate_hz), kind, 7);
        EXPECT_NEAR(at(record_of(rate, DataKind::rate, rate_hz), kind, 7), a, 1e-11 * a) << name_of(kind);
        EXPECT_NEAR(at(record_of(phase, DataKind::phase, rate_hz), kind, 7), a, 1e-11 * a) << name_of(kind);
    }
}

// A constant rate, and for the Hadamard deviations a constant drift, are not noise: nor do gaps make them so.
TEST(Deviation, does_not_see_what_its_differences_remove) {
    std::vector<double> values;
    std::mt19937_64 engine(7);
    std::normal_distribution<double> noise;
    for (int k = 0; k < 500; ++k) values.push_back(noise(engine));
    std::vector<double> turned = values, drifting = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
        turned[k] += 1000.0;
        drifting[k] += 1000.0 + 0.5 * static_cast<double>(k);
        if (k % 50 == 7) values[k] = turned[k] = not_a_number;
    }
    for (const auto kind : {DeviationKind::oadev, DeviationKind::mdev, DeviationKind::ohdev, DeviationKind::totdev}) {
        const double a = at(record_of(values), kind, 20);
        EXPECT_NEAR(at(record_of(turned), kind, 20), a, 1e-10 * a) << name_of(kind);
    }
    std::vector<double> whole(values.size());
    for (std::size_t k = 0; k < whole.size(); ++k) whole[k] = drifting[k] - 1000.0 - 0.5 * static_cast<double>(k);
    for (const auto kind : {DeviationKind::hdev, DeviationKind::ohdev}) {
        const double a = at(record_of(whole), kind, 20);
        EXPECT_NEAR(at(record_of(drifting), kind, 20), a, 1e-9 * a) << name_of(kind);
    }
}

TEST(Deviation, leaves_out_samples_that_are_flagged_as_it_leaves_out_nan) {
    std::mt19937_64 engine(8);
    auto flagged = random_record(engine, 300, false), nans = flagged;
    std::vector<std::uint8_t> valid(flagged.size(), 1);
    for (std::size_t k = 10; k < flagged.size(); k += 45) {
        flagged[k] = 1e6;
        nans[k] = not_a_number;
        valid[k] = 0;
    }
    const AngleRecord by_flag(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = flagged, .valid = valid});
    for (const auto kind : all_kinds) EXPECT_EQ(at(by_flag, kind, 5), at(record_of(nans), kind, 5)) << name_of(kind);
    EXPECT_EQ(by_flag.n_known(), 300 - 7);
}

TEST(Deviation, says_in_one_line_why_it_has_no_answer) {
    const auto message = [](auto&& work) -> std::string {
        const std::string text = test::message_of<SeriesError>(work);
        EXPECT_EQ(text.find('\n'), std::string::npos);
        return text;
    };
    const std::vector<double> one{1.0}, two{1.0, 2.0}, constant(50, 3.0), none(50, not_a_number),
        good{1.0, 2.0, 0.5, 3.0, 2.0};
    const std::array<std::int64_t, 1> m1{1}, m0{0}, m9{9};
    test::expect_contains(message([&] { (void)deviation(record_of(one), DeviationKind::oadev, m1); }), "1 intervals");
    test::expect_contains(message([&] { (void)record_of(constant); }), "all 50 valid samples are 3");
    test::expect_contains(message([&] { (void)record_of(none); }), "none of its 50 samples");
    const std::vector<double> straight{1.0, 2.0, 3.0, 4.0};
    test::expect_contains(
        message([&] { (void)deviation(record_of(straight, DataKind::phase), DeviationKind::oadev, m1); }), "no noise");
    test::expect_contains(message([&] { (void)record_of({}); }), "0 samples");
    test::expect_contains(message([&] { (void)record_of(good, DataKind::rate, 0.0); }), "0 Hz");
    test::expect_contains(message([&] { (void)record_of(good, DataKind::rate, not_a_number); }), "nan Hz");
    test::expect_contains(message([&] { (void)deviation(record_of(two), DeviationKind::ohdev, m1); }), "no difference");
    test::expect_contains(message([&] { (void)deviation(record_of(good), DeviationKind::oadev, m0); }), "0 intervals");
    test::expect_contains(message([&] { (void)deviation(record_of(good), DeviationKind::oadev, m9); }),
                          "no difference");
    test::expect_contains(
        message([&] { (void)deviation(record_of(good), DeviationKind::oadev, m1, {.confidence = not_a_number}); }),
        "nan");
    test::expect_contains(
        message([&] { (void)deviation(record_of(good), DeviationKind::oadev, m1, {.least_known_ratio = 0.0}); }),
        "least known ratio: 0");
}

TEST(Deviation, leaves_out_averaging_times_that_have_no_term) {
    std::mt19937_64 engine(9);
    const auto record = record_of(random_record(engine, 100, false));
    const std::array<std::int64_t, 4> factors{40, 1, 60, 1};
    const auto curve = deviation(record, DeviationKind::oadev, factors);
    ASSERT_EQ(curve.points.size(), 2U);
    EXPECT_EQ(curve.points[0].m, 1);
    EXPECT_EQ(curve.points[1].m, 40);
    for (const auto& point : curve.points) {
        EXPECT_LT(point.low, point.deviation);
        EXPECT_GT(point.high, point.deviation);
    }
}

}  // namespace zlg::deviations::deviation_test
