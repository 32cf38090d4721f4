#include <zlg/choice/paper_rules.hpp>

#include "test.hpp"

namespace zlg::paper_rules_test {

using namespace choice;

// 88.5 s is the least of (7) as printed for ten minutes and 10 arcsec a switch; found apart from this code on a grid.
TEST(PaperRules, give_the_papers_interval_and_figure_5) {
    const Requirement r = parse_requirement("[require]\nrun_s = 600\ndrift_arcsec_s = 0.3\n", "r.toml");
    const Answer a = by_paper_rules(r);
    EXPECT_NEAR(a.proof.candidate.interval_s, 88.5, 0.05);
    // sqrt(Om dP/t) twice, and A/2 of the first pair, less nm: 2 sqrt(0.7 * 10/600) + 0.01.
    EXPECT_NEAR(a.least_arcsec / 600.0, 0.226, 0.005);
    EXPECT_TRUE(a.met);
    const report::Page page = paper_rules_page(r, a);
    const report::Figure& figure = page.sections.at(0).figures.at(0);
    EXPECT_EQ(figure.id, "figure-5");
    EXPECT_TRUE(std::ranges::is_sorted(figure.series.at(0).y)) << "a longer run has a longer interval";
}

TEST(PaperRules, do_not_meet_what_their_budget_leaves_open) {
    EXPECT_FALSE(by_paper_rules(parse_requirement("[require]\nrun_s = 600\ndrift_arcsec_s = 0.2\n", "r.toml")).met);
}

}  // namespace zlg::paper_rules_test
