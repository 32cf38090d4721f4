#include <zlg/deviations/deviation_stream.hpp>

#include <zlg/deviations/averaging.hpp>

#include "direct_deviation.hpp"
#include "records.hpp"

namespace zlg::deviations::deviation_stream_test {

const std::vector<DeviationKind> streamed_kinds{DeviationKind::oadev, DeviationKind::mdev, DeviationKind::tdev,
                                                DeviationKind::ohdev};

std::vector<double> random_rates(int n, bool with_gaps, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(3.0, 1.0);
    std::bernoulli_distribution missing(with_gaps ? 0.02 : 0.0);
    std::vector<double> values;
    for (int k = 0; k < n; ++k) values.push_back(missing(engine) ? not_a_number : noise(engine));
    return values;
}

StreamConfig config_of(std::vector<std::int64_t> factors, DataKind kind = DataKind::rate, std::int64_t window = 64) {
    return {.what = {kind, Unit::one, 1.0},
            .kinds = streamed_kinds,
            .factors = std::move(factors),
            .window = window,
            .least_known_ratio = 0.7};
}

// Up to the window it is the deviation of the whole record; beyond, that of every s-th start, in both cases by
// definition.
TEST(DeviationStream, agrees_with_the_definition) {
    for (const bool with_gaps : {false, true}) {
        const auto values = random_rates(3000, with_gaps, 11);
        DeviationStream stream(config_of({1, 3, 64, 65, 100, 200, 333, 700}));
        stream.add(values);
        for (const auto kind : streamed_kinds)
            for (const auto& point : stream.curve(kind, {.noise = 0}).points) {
                std::int64_t stride = 1;
                while (64 * stride < point.m) stride *= 2;
                const auto expected = direct::variance(kind, {values}, point.m, 0.7L, stride);
                const double factor = kind == DeviationKind::tdev ? point.tau_s / std::sqrt(3.0) : 1.0;
                const double value = factor * static_cast<double>(std::sqrt(expected.variance));
                EXPECT_EQ(point.terms, expected.terms) << name_of(kind) << " m " << point.m << " gaps " << with_gaps;
                EXPECT_NEAR(point.deviation, value, 1e-12 * value) << name_of(kind) << " m " << point.m;
            }
    }
}

TEST(DeviationStream, rounds_a_long_averaging_to_its_stride) {
    DeviationStream stream(config_of({1, 65, 333}));
    stream.add(random_rates(2000, false, 12));
    const auto points = stream.curve(DeviationKind::oadev).points;
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[1].m, 66);
    EXPECT_EQ(points[2].m, 336);
    EXPECT_DOUBLE_EQ(points[2].tau_s, 336.0);
}

TEST(DeviationStream, does_not_depend_on_how_the_samples_are_handed_over) {
    const auto values = random_rates(2500, true, 13);
    const auto config = config_of(octave_factors(600));
    DeviationStream whole(config), pieces(config);
    whole.add(values);
    // The first piece decides what is taken off every sample.
    for (std::size_t k = 0; k < values.size();) {
        const std::size_t n = std::min<std::size_t>(values.size() - k, k % 97 + 1);
        pieces.add(std::span(values).subspan(k, n));
        k += n;
    }
    const auto a = whole.curve(DeviationKind::mdev).points, b = pieces.curve(DeviationKind::mdev).points;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].terms, b[k].terms);
        EXPECT_EQ(a[k].noise, b[k].noise);
        EXPECT_NEAR(a[k].deviation, b[k].deviation, 1e-12 * a[k].deviation);
    }
}

TEST(DeviationStream, can_be_asked_at_any_time_and_goes_on) {
    const auto values = random_rates(1500, false, 14);
    const auto config = config_of(octave_factors(256));
    DeviationStream asked(config), silent(config);
    for (std::size_t k = 0; k < values.size(); ++k) {
        asked.add(std::span(values).subspan(k, 1));
        silent.add(std::span(values).subspan(k, 1));
        if (k % 111 == 20) (void)asked.curve(DeviationKind::oadev);
    }
    const auto a = asked.curve(DeviationKind::oadev).points, b = silent.curve(DeviationKind::oadev).points;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].deviation, b[k].deviation);
}

TEST(DeviationStream, takes_phase_with_missing_angles) {
    std::vector<double> phase;
    double angle = 0.0;
    for (const double d : random_rates(2000, false, 15)) phase.push_back(angle += d);
    for (std::size_t k = 5; k < phase.size(); k += 40) phase[k] = not_a_number;
    DeviationStream stream(config_of({1, 10, 60, 128, 256}, DataKind::phase));
    stream.add(phase);
    const AngleRecord record(Series{.what = {DataKind::phase, Unit::one, 1.0}, .values = phase});
    for (const auto& point : stream.curve(DeviationKind::oadev, {.noise = 0}).points) {
        if (point.m > 64) continue;
        const auto expected = direct::variance_of_phase(DeviationKind::oadev, phase, point.m, 0.7L);
        const double value = static_cast<double>(std::sqrt(expected.variance));
        EXPECT_EQ(point.terms, expected.terms);
        EXPECT_NEAR(point.deviation, value, 1e-12 * value);
    }
    EXPECT_EQ(stream.n_known(), 2000 - 50);
}

TEST(DeviationStream, needs_memory_that_does_not_grow_with_the_stream) {
    DeviationStream stream(config_of(octave_factors(1 << 12)));
    const auto before = stream.memory_bytes();
    for (int k = 0; k < 20; ++k) stream.add(random_rates(5000, true, 16));
    EXPECT_EQ(stream.memory_bytes(), before);
    EXPECT_LT(before, 200U * 64U * 7U);
    EXPECT_EQ(stream.n_samples(), 100000);
}

TEST(DeviationStream, reads_a_source_to_its_end) {
    const auto values = random_rates(200000, false, 17);
    std::size_t at = 0;
    DeviationStream stream(config_of({1, 10}, DataKind::rate, 1024)), whole(config_of({1, 10}, DataKind::rate, 1024));
    read_into(stream, [&](std::span<double> to, std::span<std::uint8_t> valid) {
        const std::size_t n = std::min({to.size(), values.size() - at, std::size_t{777}});
        for (std::size_t k = 0; k < n; ++k) {
            to[k] = values[at + k];
            valid[k] = (at + k) % 1000 == 3 ? 0 : 1;
        }
        at += n;
        return n;
    });
    EXPECT_EQ(stream.n_samples(), 200000);
    EXPECT_EQ(stream.n_known(), 200000 - 200);
}

TEST(DeviationStream, refuses_what_it_cannot_do) {
    const auto with = [](auto change) {
        auto config = config_of({1});
        change(config);
        return config;
    };
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.window = 100; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.window = 32; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.factors = {}; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.factors = {0}; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.kinds = {DeviationKind::totdev}; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.kinds = {}; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.what.rate_hz = 0.0; })), SeriesError);
    EXPECT_THROW(DeviationStream(with([](auto& c) { c.least_known_ratio = not_a_number; })), SeriesError);
    DeviationStream stream(with([](auto& c) { c.kinds = {DeviationKind::oadev}; }));
    EXPECT_THROW((void)stream.curve(DeviationKind::oadev), SeriesError);  // nothing yet
    EXPECT_THROW((void)stream.curve(DeviationKind::mdev), SeriesError);
    const std::vector<double> two{1.0, 2.0};
    const std::vector<std::uint8_t> one{1};
    EXPECT_THROW(stream.add(two, one), SeriesError);
}

}  // namespace zlg::deviations::deviation_stream_test
