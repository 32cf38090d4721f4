#include "paper_words.hpp"
#include "test.hpp"

namespace zlg::paper::paper_words_test {

TEST(PaperWords, numbers_stand_in_their_places_as_the_page_shows_them) {
    EXPECT_EQ(filled("{} is {:.2f}, {}", {12.3456, 0.125, "so"}), "12.3 is 0.12, so");
    EXPECT_EQ(filled("{:+.1f} {:.2e} {:.1f}", {2.0, 1234.0, -0.01}), "+2.0 1.23e+03 0.0");
    EXPECT_EQ(filled("{:.1f}", {std::numeric_limits<double>::quiet_NaN()}), "none");
}

TEST(PaperWords, every_place_has_its_number_and_every_number_its_place) {
    EXPECT_THROW((void)filled("{} and {}", {1.0}), std::logic_error);
    EXPECT_THROW((void)filled("none", {1.0}), std::logic_error);
    EXPECT_THROW((void)words("figure-12"), std::logic_error);
}

TEST(PaperWords, a_claim_has_the_finding_of_its_own_place) {
    std::vector<Finding> found(1, {.where = "eq (1)", .values = {}});
    EXPECT_THROW((void)claims_of(found), std::logic_error) << "there are more claims";
}

}  // namespace zlg::paper::paper_words_test
