#include <zlg/rig/place_check.hpp>

#include "test.hpp"

namespace zlg::place_check_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A gyro at the angle angle(t) counts at the end of half t, with 150.3 counts of bias; place(t, right) stands in the
// column.
std::string complaint(const std::function<double(int)>& angle, const std::function<double(int, double)>& place,
                      int n_halves = 6000, const std::function<void(int, core::HalfRecord&)>& change = {}) {
    rig::PlaceCheck check;
    double before = 0.0;
    for (int t = 0; t < n_halves; ++t) {
        const double at = angle(t) + (t % 2 == 0 ? 150.3 : 0.0);
        const double whole = std::floor(at);
        const double shown = place(t, at - whole);
        core::HalfRecord half{.half = t, .counts = static_cast<std::int64_t>(whole - before)};
        half.fringe = static_cast<float>(std::isnan(shown) ? shown : std::floor(shown * 65536.0));
        if (change) change(t, half);
        before = whole;
        check.take(half);
    }
    return check.complaint("raw.csv");
}

double right(int, double p) { return p; }
double stuck(int, double) { return 0.4; }

std::function<double(int, double)> random_place() {
    return [random = std::mt19937_64{7}](int, double) mutable { return std::uniform_real_distribution<>{}(random); };
}

// 18 counts a tick at most, 20 Hz of a gyro with ticks of 5 ms.
double shaking(int t) { return 29.0 * std::sin(2.0 * M_PI * 0.05 * t) + 0.0057 * t; }
double earth(int t) { return 0.0115 * t; }
// A tenth of a count every half, so that counts move in one tick of five.
double slow(int t) { return 0.1003 * t; }

TEST(PlaceCheck, right_places_agree_with_the_counts_whatever_the_motion) {
    std::mt19937_64 random{3};
    std::normal_distribution<> gauss{0.0, 2.0};
    const auto shaken = [&](int t) { return slow(t) + gauss(random); };
    // A quarter of the rate of the ticks: four places, again and again.
    const auto quarter = [](int t) { return 2.9 * std::sin(0.25 * M_PI * t) + 0.0011 * t; };
    for (const auto& motion : std::initializer_list<std::function<double(int)>>{shaking, earth, slow, shaken, quarter})
        EXPECT_EQ(complaint(motion, right), "");
}

TEST(PlaceCheck, noise_is_found_moving_or_at_rest) {
    for (const auto& motion : {shaking, earth, slow})
        zlg::test::expect_contains(complaint(motion, random_place()), "contradicts the counts in 2 of 2 stretches");
}

double halved(int, double p) { return 0.5 * p; }
double inverted(int, double p) { return 0.999 - 0.999 * p; }
double coarse(int, double p) { return std::floor(16.0 * p) / 16.0; }
double periodic(int, double p) { return std::fmod(1.0 + p + 0.05 * std::sin(2.0 * M_PI * p), 1.0); }

std::function<double(int, double)> one_in_ten() {
    return [random = std::mt19937_64{7}](int, double p) mutable {
        std::uniform_real_distribution<> even{};
        return even(random) < 0.1 ? even(random) : p;
    };
}

TEST(PlaceCheck, a_scaled_inverted_coarse_or_partly_random_place_is_found_in_a_motion) {
    for (const auto& [of_sine, hertz] : {std::pair{400.0, 0.0032}, std::pair{29.0, 0.0503}}) {
        const auto motion = [amplitude = of_sine, frequency = hertz](int t) {
            return amplitude * std::sin(2.0 * M_PI * frequency * t) + 0.0057 * t;
        };
        EXPECT_EQ(complaint(motion, right, 16 + 4096), "");
        for (const std::function<double(int, double)>& place :
             {std::function<double(int, double)>{halved}, std::function<double(int, double)>{inverted},
              std::function<double(int, double)>{coarse}, std::function<double(int, double)>{periodic}, one_in_ten()})
            EXPECT_NE(complaint(motion, place, 16 + 4096), "");
    }
}

// Fast, of a fraction of a count or of some, at an angle that drifts slowly; places that are read to 0.05 counts.
TEST(PlaceCheck, right_places_agree_in_every_fast_vibration) {
    std::mt19937_64 random{5};
    std::normal_distribution<> gauss{0.0, 0.05};
    for (const double frequency : {0.05, 0.08, 0.11, 0.151, 0.2003, 0.237, 0.31})
        for (const double amplitude : {0.1, 0.3, 0.6, 1.0, 2.3})
            for (const double drift : {0.0003, 0.0012, 0.0115})
                for (const double from : {0.01, 0.3, 0.7}) {
                    const auto motion = [&](int t) {
                        return from + drift * t + amplitude * std::sin(2.0 * M_PI * frequency * t);
                    };
                    const auto read = [&](int, double p) { return std::clamp(p + gauss(random), 0.0, 0.9999); };
                    EXPECT_EQ(complaint(motion, right, 16 + 4096), "") << frequency << ' ' << amplitude << ' ' << drift;
                    EXPECT_EQ(complaint(motion, read, 16 + 4096), "") << frequency << ' ' << amplitude << ' ' << drift;
                }
}

TEST(PlaceCheck, places_that_stand_still_are_found_where_the_counts_move) {
    EXPECT_NE(complaint(shaking, stuck), "");
    EXPECT_NE(complaint(slow, stuck), "");
    const auto rest = [](int) { return 0.2; };
    EXPECT_EQ(complaint(rest, stuck), "");
}

// Stretches of 4096 differences, after the 16 halves that the first one needs. That in which it begins, at half 9000,
// is right for a fifth, and nothing is decided there.
TEST(PlaceCheck, says_where_it_begins_and_in_how_much_of_the_log) {
    const auto from_there = [](int t, double p) { return t >= 9000 ? 0.4 : p; };
    const std::string said = complaint(shaking, from_there, 16 + 4 * 4096);
    zlg::test::expect_contains(said, "raw.csv: the column fringe contradicts the counts in 1 of 3");
    zlg::test::expect_contains(said, "first before half-period 16399");
}

// Of a jerk of 200 counts at rest, which moves counts and places once.
TEST(PlaceCheck, a_jerk_decides_nothing) {
    const auto jerk = [](int t) { return t < 3000 ? 0.2 : 200.4; };
    EXPECT_EQ(complaint(jerk, right), "");
    EXPECT_EQ(complaint(jerk, stuck), "");
}

TEST(PlaceCheck, nothing_is_decided_by_few_halves_without_places_or_in_a_rough_motion) {
    EXPECT_EQ(complaint(shaking, random_place(), 16 + 511), "");
    EXPECT_NE(complaint(shaking, random_place(), 16 + 512), "");
    EXPECT_EQ(complaint(shaking, [](int, double) { return nan; }), "");
    std::mt19937_64 random{3};
    std::normal_distribution<> gauss{0.0, 20.0};
    EXPECT_EQ(complaint([&](int t) { return shaking(t) + gauss(random); }, random_place()), "");
}

// Every 16 halves something is missing: no difference is whole.
TEST(PlaceCheck, differences_reach_over_measured_halves_alone) {
    const std::initializer_list<std::function<void(core::HalfRecord&)>> lacking{
        [](auto& h) { h.loop_closed = false; }, [](auto& h) { h.valid = false; }, [](auto& h) { h.span = 2; },
        [](auto& h) { h.fringe = std::nanf(""); }};
    for (const auto& change : lacking) {
        EXPECT_EQ(complaint(shaking, random_place(), 6000,
                            [&](int t, auto& h) {
                                if (t % 16 == 0) change(h);
                            }),
                  "");
        EXPECT_NE(complaint(shaking, random_place(), 6000,
                            [&](int t, auto& h) {
                                if (t % 100 == 0) change(h);
                            }),
                  "");
    }
}

}  // namespace zlg::place_check_test
