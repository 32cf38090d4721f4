#include <zlg/choice/choice_page.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::choice_page_test {

using namespace choice;

// Twenty gyros with errors of 1, 2, ... 20 arcsec, of which 15 are allowed.
Answer made(const Requirement& r) {
    Answer a{.met = true, .probability = 0.75, .probability_sigma = 0.09};
    a.proof.candidate = {.interval_s = 45.0};
    for (int k = 1; k <= 20; ++k)
        a.proof.trials.push_back({.state = TrialState::good, .error_arcsec = static_cast<double>(k)});
    a.gyro = with(r.base, a.proof.candidate);
    a.parts = {{"switch errors", 3.0}, {"all", 3.0}};
    a.budget = {{"switches", 12.0}};
    a.binding = "switch errors";
    a.reasons = {"It is simple."};
    return a;
}

Requirement required() {
    return parse_requirement("[require]\nrun_s = 600\nangle_error_arcsec = 15\nconfidence = 0.7\n", "r.toml");
}

TEST(ChoicePage, has_the_pictures_that_decide) {
    const Requirement r = required();
    const report::Page page = choice_page(r, made(r));
    std::vector<std::string> ids;
    for (const report::Section& section : page.sections)
        for (const report::Figure& figure : section.figures) ids.push_back(figure.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"error-interval"}));
    EXPECT_NE(page.verdict.find("at most 15 arcsec after 600 s in 0.750 +- 0.090 of 20 gyros"), std::string::npos)
        << page.verdict;
    const report::Series& share = page.sections[1].figures[1].series[0];
    EXPECT_EQ(share.x[14], 15.0);
    EXPECT_DOUBLE_EQ(share.y[14], 0.75);
}

TEST(ChoicePage, says_when_nothing_meets_it_and_when_it_was_interrupted) {
    const Requirement r = required();
    Answer a = made(r);
    a.met = false;
    EXPECT_EQ(verdict(r, a).find("Nothing meets"), 0u);
    a.is_interrupted = true;
    EXPECT_EQ(verdict(r, a).find("Interrupted"), 0u);
}

TEST(ChoicePage, its_configuration_is_one) {
    const Requirement r = required();
    config::Config read;
    config::apply_toml(read, toml_text(r, made(r)), "chosen.toml");
    EXPECT_EQ(read.switching.interval_s, 45.0);
    EXPECT_EQ(read.run.duration_s, 600.0);
    EXPECT_EQ(read.compensation.bridge, core::BridgeMethod::quadratic);
}

}  // namespace zlg::choice_page_test
