#include <fmt/format.h>

#include "paper_parts.hpp"
#include "test.hpp"

namespace zlg::paper_claims_test {

using paper::Claim;
using paper::Verdict;

const std::vector<Claim>& claims() {
    static const std::vector<Claim> all = paper::paper_claims({});
    return all;
}

// The findings of everything that stands at one place.
std::string findings(const std::string& where) {
    std::string text;
    for (const Claim& c : claims())
        if (c.where == where) text += c.finding + "\n";
    EXPECT_FALSE(text.empty()) << where;
    return text;
}

void expect_numbers(const std::string& where, const std::vector<std::string>& numbers) {
    const std::string text = findings(where);
    for (const auto& number : numbers) EXPECT_NE(text.find(number), std::string::npos) << where << ": " << number;
}

TEST(PaperClaims, every_equation_and_both_tables_are_judged) {
    std::string places;
    for (const Claim& c : claims()) places += c.where + ";";
    for (int k = 1; k <= 20; ++k) {
        if (k == 17) continue;  // within (16) to (18)
        EXPECT_NE(places.find(fmt::format("({})", k)), std::string::npos) << k;
    }
    for (const char* place : {"abstract", "figure 3", "figure 4", "figure 5", "table 1", "table 2", "figures 8 to 10",
                              "figure 11", "conclusion 1", "conclusion 2", "conclusion 3", "closing"})
        EXPECT_NE(places.find(place), std::string::npos) << place;
}

TEST(PaperClaims, every_claim_has_its_finding_and_no_two_are_the_same) {
    std::set<std::string> seen;
    for (const Claim& c : claims()) {
        EXPECT_FALSE(c.where.empty() || c.claim.empty() || c.finding.empty());
        EXPECT_TRUE(seen.insert(c.where + c.claim).second) << c.claim;
        for (const char* bad : {"nan", "inf,", "none,", "{}"})
            EXPECT_EQ(c.finding.find(bad), std::string::npos) << c.finding;
    }
}

TEST(PaperClaims, verdicts_are_those_of_the_checked_equations) {
    std::map<std::string, Verdict> of;
    for (const Claim& c : claims()) of.emplace(c.where, c.verdict);
    for (const char* right : {"eq (2)", "eq (3)", "eq (5)", "eq (8)", "eq (13)", "eqs (14), (16) to (18)", "eq (19)",
                              "eq (20), extremum", "after eq (9)", "after eq (11)", "table 2"})
        EXPECT_EQ(of.at(right), Verdict::agrees) << right;
    for (const char* typo : {"eq (4)", "eq (6)", "before eq (7)", "eq (11)", "before eq (12)", "eq (15)",
                             "eq (20), t = 0", "after figure 11", "table 1"})
        EXPECT_EQ(of.at(typo), Verdict::misprint) << typo;
    for (const char* wrong : {"eq (1)", "eq (7)", "eq (9)", "eq (12)", "abstract", "conclusion 2"})
        EXPECT_EQ(of.at(wrong), Verdict::wrong) << wrong;
    EXPECT_EQ(of.at("eq (10)"), Verdict::not_supported);
}

TEST(PaperClaims, they_are_about_the_paper_whatever_gyro_the_page_is_for) {
    paper::PaperTask other;
    other.config.drift.magnetic_arcsec_s = 5.0;
    other.config.perimeter.miss_lambda = 0.01;
    other.config.gyro.tick_s = 0.01;
    const auto of_other = paper::paper_claims(other);
    ASSERT_EQ(of_other.size(), claims().size());
    for (std::size_t i = 0; i < claims().size(); ++i) EXPECT_EQ(of_other[i].finding, claims()[i].finding);
}

TEST(PaperClaims, drift_budget) {
    expect_numbers("eq (7)", {"0.084", "586.5", "0.121", "294.8", "0.276"});
    expect_numbers("after eq (7)", {"0.30"});
    expect_numbers("parameters of figure 4", {"14 deg/h", "54.1", "66.7"});
    expect_numbers("figure 4", {"88.7", "106.7", "195.2", "586.5"});
    expect_numbers("eq (8)", {"183.3"});
    expect_numbers("eq (9)", {"232.2", "183.3", "183.5", "14978", "2033"});
    expect_numbers("after eq (9)", {"226.8", "3.01", "7.33"});
    expect_numbers("figure 5", {"297.5", "717"});
}

// (4) over the first pair: -int int of the thermal part, A tau/(2L) (1 - e^(-L/tau))^2 with A = 0.7, tau = 3000, L
// = 90.
TEST(PaperClaims, first_pair_of_segments) {
    const double warmed = 1.0 - std::exp(-0.03);
    const std::string known = fmt::format("{:.5f}", 0.7 * 3000.0 / 180.0 * warmed * warmed);
    expect_numbers("eq (4)", {known});
    const double mean = 0.7 * 3000.0 / 3600.0 * std::tanh(0.015) * (1.0 - std::exp(-1.2));
    expect_numbers("eq (6)", {known, fmt::format("{:.5f}", mean)});
}

// At 90 s in an hour: -(A tau/2 w^2 + dP)/L^2 + A/L w e^(-L/tau) + Om/t, w = 1 - e^(-L/tau).
TEST(PaperClaims, derivative_and_difference_are_the_same_number) {
    const double w = 1.0 - std::exp(-0.03);
    const double slope = -(1050.0 * w * w + 10.0) / 8100.0 + 0.7 / 90.0 * w * std::exp(-0.03) + 0.7 / 3600.0;
    const std::string known = fmt::format("{:.4e}", slope);
    const std::string text = findings("eq (8)");
    const std::size_t first = text.find(known);
    ASSERT_NE(first, std::string::npos) << known;
    EXPECT_NE(text.find(known, first + 1), std::string::npos) << "by differences of (7)";
}

TEST(PaperClaims, relock) {
    expect_numbers("eq (10)", {"31.6", "12.2", "5.4", "406", "117", "95", "151"});
    expect_numbers("table 1", {"1362.75", "42.6", "27.3", "22.3", "7.0"});
    expect_numbers("table 2", {"165.5", "3.31", "344"});
    expect_numbers("tables 1 and 2, eq (3)", {"42.6"});
    // A quarter of a tick of the acceleration of 12000 "/s at 20 Hz.
    expect_numbers("after eq (11)",
                   {fmt::format("{:.0f}", 0.25 * 0.005 * 12000.0 * 2.0 * std::numbers::pi * 20.0), "1885"});
    expect_numbers("eq (2)", {"0.22 wavelengths"});
    expect_numbers("eq (11)", {"26.0"});
}

// Means of e^(-t/tau), tau = 3.5 ticks, over the first halves of ticks 2 and 4 by the midpoint rule.
TEST(PaperClaims, exponents_of_equation_12) {
    const auto mean = [](int tick) {
        double sum = 0.0;
        for (int k = 0; k < 1000; ++k) sum += std::exp(-(tick - 1 + 0.5 * (k + 0.5) / 1000.0) / 3.5) / 1000.0;
        return fmt::format("{:.3f}", sum);
    };
    expect_numbers("eq (12)", {mean(2), mean(4)});
    EXPECT_EQ(findings("eq (12)").find(mean(3)), std::string::npos);
}

TEST(PaperClaims, substitution) {
    expect_numbers("eqs (14), (16) to (18)", {"259, 312 and 260"});
    expect_numbers("figures 8 to 10", {"154.51", "26.85", "0.10, 0.15 and 0.20"});
    expect_numbers("figures 9 and 10", {"26.0, 77.6 and 154.5", "1.4, 8.2 and 26.8"});
    expect_numbers("figure 11", {"2.4 arcsec", "1.39", "1.94 to 2.54", "2.45 to 3.29", "5.57 to 12.1"});
    expect_numbers("eq (15)", {"26.3 and 35.9", "17.3 and 47.9", "3.4 and 1.3"});
    expect_numbers("before eq (14)",
                   {"15.3 Hz", "4.4 Hz", "1.33", "4.96 arcsec/s with ticks of 10 ms", "0.08 of 2 ms", "reads 5.02"});
    expect_numbers("conclusion 2", {"1.50", "4.93"});
}

TEST(PaperClaims, series_about_the_zero_crossing) {
    const double u = 2.0 * std::numbers::pi * 20.0 * 0.003;
    const double cubic = 12000.0 * u * u * u / 8.0;  // with a coefficient of 1 of (pi nu x)^3
    const double printed = 12000.0 * (u + std::pow(u, 5) / 120.0) - cubic;
    expect_numbers("eq (20), t = 0",
                   {fmt::format("{:.0f} deg/h", 12000.0 * std::sin(u)), fmt::format("{:.0f} as printed", printed)});
    expect_numbers("eq (20), extremum", {fmt::format("{:.1f} deg/h", 12000.0 * std::cos(u))});
}

// One mode: 0.05 + 0.7 + 0.7 (1 - (tau/t)(1 - e^(-t/tau))), over the least of (7c).
TEST(PaperClaims, gain_of_the_regime) {
    const auto gain = [](double t, double least) {
        return (0.75 + 0.7 * (1.0 - 3000.0 / t * (1.0 - std::exp(-t / 3000.0)))) / least;
    };
    const std::string text = findings("closing");
    zlg::test::expect_contains(text, fmt::format("{:.1f} times in an hour", gain(3600.0, 0.1524)));
    zlg::test::expect_contains(text, fmt::format("{:.0f} times in ten hours", gain(36000.0, 0.0841)));
}

}  // namespace zlg::paper_claims_test
